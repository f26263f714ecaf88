//! Islands of joints on their way through a substep: in one step, or in several where a link swings too fast for one.

use crate::joint::Pace;
use crate::resolution::joint::JointSolver;
use crate::resolution::joint::geometry::JointBody;
use crate::resolution::joint::plan::Island;
use crate::resolution::joint::row::{Phase, Role, Row, Times};
use crate::resolution::scheme::Scheme;

/// A step in which a body swings by more than this, rad, is taken back, and made in halves: at 2 it would explode.
const MOST_PHASE: f64 = 1.0;

/// Steps are made longer again when bodies have swung by less than this in twice their length, rad, for `CALM` seconds. A swing
/// of a metre takes two: a step that changed within a swing would take energy from it, as way and way back would not be alike.
const SLOW_PHASE: f64 = 0.5;
const CALM: f64 = 4.0;

/// A substep is divided into no more steps than this: a chain that whips a ball of 672 of its links takes them for moments. Of a
/// ball of 5,000 links it would take more, and such a chain still explodes.
const MOST_STEPS: f64 = 256.0;

/// The same of islands whose bodies are in contacts, which go through their steps again when these have pushed them. With four, 3 of 120
/// chains that whip a ball into crates part by millimetres, with this none; with 256, ragdolls that are shot at take a third longer, for
/// nothing.
const MOST_STEPS_IN_CONTACT: f64 = 16.0;

/// What is left of a substep is so many steps, no unit, but for this: it is what the steps before have left, and rounded.
const ROUNDING: f64 = 1e-6;

/// By how much a load may grow from step to step that is to be followed.
const GROWTH: f64 = 4.0;

impl JointSolver {
    /// Takes an island through the substep from its start.
    ///
    /// The last step ends as a single one would: the velocity that it leaves is the way of all steps over the length of the substep,
    /// and its relax comes when the bodies have moved.
    pub(super) fn push_island(&mut self, island: &mut Island, scheme: &Scheme) {
        let (h, kick) = (self.h, f64::from(scheme.kick_time()));
        for &place in &island.bodies {
            self.bodies[place as usize] = self.starts[place as usize];
        }
        for &joint in &island.joints {
            let [first, end] = self.places[joint as usize].rows;
            for row in &mut self.rows[first as usize..end as usize] {
                (row.load, row.in_substep) = (row.load_before, [0.0; 3]);
            }
        }
        let most = match (scheme.split_kick, island.touches) {
            (false, _) => 1.0,
            (true, false) => MOST_STEPS,
            (true, true) => MOST_STEPS_IN_CONTACT,
        };
        let shortest = h / most;
        island.swing = 0.0;
        let mut rest = h;
        loop {
            let steps = (rest / island.pace.step.max(shortest) - ROUNDING).ceil().max(1.0);
            island.times = Times { h: rest / steps, kick: kick / h * (rest / steps), closing: 0.0 };
            self.push_for_a_step(island, shortest);
            let Times { h: step, .. } = island.times;
            if step >= rest {
                break;
            }
            for &place in &island.bodies {
                let body = &mut self.bodies[place as usize];
                *body = body.after(step);
                body.velocity = [0, 1, 2].map(|index| body.velocity[index] - body.closing[index]);
                body.accelerate(0.5 * step);
            }
            self.run(island, Phase::Relax);
            self.note_loads(island, scheme);
            rest -= step;
        }
        for &place in &island.bodies {
            let (body, start) = (&mut self.bodies[place as usize], &self.starts[place as usize]);
            *body = of_the_whole(body, start, island.times.h, h);
        }
    }

    /// Pushes for a step. If what that takes makes a body swing too fast, it is taken back, and made for a half of it, and so on, down to the
    /// `shortest`, s: the times of the island are those of the step that was made.
    fn push_for_a_step(&mut self, island: &mut Island, shortest: f64) {
        self.velocities.clear();
        self.velocities.extend(island.bodies.iter().map(|&place| self.bodies[place as usize].velocity));
        loop {
            let Times { h: step, kick, .. } = island.times;
            for (&place, velocity) in island.bodies.iter().zip(&self.velocities) {
                let body = &mut self.bodies[place as usize];
                body.velocity = *velocity;
                body.accelerate(0.5 * step);
            }
            self.run(island, Phase::Push);
            let swing = self.fastest_swing(island, |row| lasting(row.load, row.impulse / kick));
            let is_followed = swing * step <= MOST_PHASE && !island.diverges;
            if is_followed || step < 2.0 * shortest {
                island.swing = island.swing.max(swing);
                return;
            }
            island.times = Times { h: 0.5 * step, kick: 0.5 * kick, closing: 0.0 };
            island.pace = Pace { step: 0.5 * step, calm: 0.0 };
        }
    }

    /// How fast the fastest of the bodies swings by what the rows bear, N, rad/s.
    fn fastest_swing(&mut self, island: &Island, load: impl Fn(&Row) -> f64) -> f64 {
        let flying_by = self.find_swings(island, load);
        island.bodies.iter().map(|&place| self.bodies[place as usize].swing()).fold(flying_by, f64::max)
    }

    /// Finds how stiffly the bodies are pulled and turned back by what the rows bear, N. Returns how fast they fly by the wheels of pulleys, rad/s.
    fn find_swings(&mut self, island: &Island, load: impl Fn(&Row) -> f64) -> f64 {
        let mut flying_by = 0.0_f64;
        for &place in &island.bodies {
            let body = &mut self.bodies[place as usize];
            (body.stiffness, body.held) = ([0.0; 2], 0);
        }
        for &joint in &island.joints {
            let (place, base) = (&self.places[joint as usize], &self.bases[joint as usize]);
            let rows = &self.rows[place.rows[0] as usize..place.rows[1] as usize];
            let Some(first) = rows.first() else { continue };
            let [a, b] = first.bodies.map(|body| self.bodies[body as usize]);
            let at = base.at(&a, &b);
            if let Some(arms) = first.coordinate.arms(&at) {
                for (body, arm) in first.bodies.into_iter().zip(arms) {
                    let body = &mut self.bodies[body as usize];
                    (body.held, body.arm) = (body.held + 1, arm);
                }
            }
            for row in rows {
                if row.impulse != 0.0 {
                    flying_by = flying_by.max(row.coordinate.fly_by_rate(&at, &a, &b));
                }
                let stiffness = row.coordinate.geometric_stiffness(&at, load(row));
                for (body, [pull, turn]) in row.bodies.into_iter().zip(stiffness) {
                    let body = &mut self.bodies[body as usize];
                    body.stiffness = [body.stiffness[0] + pull, body.stiffness[1] + turn];
                }
            }
        }
        flying_by
    }

    /// Begins a phase, and solves it.
    pub(super) fn run(&mut self, island: &mut Island, phase: Phase) {
        self.begin(island, phase);
        self.solve_island(island, phase);
    }

    /// Brings the rows to where the bodies are, and applies what they bore before.
    fn begin(&mut self, island: &Island, phase: Phase) {
        for &joint in &island.joints {
            let (place, base) = (&self.places[joint as usize], &self.bases[joint as usize]);
            let rows = &mut self.rows[place.rows[0] as usize..place.rows[1] as usize];
            let Some(first) = rows.first() else { continue };
            let [a, b] = first.bodies.map(|body| self.bodies[body as usize]);
            let at = base.at(&a, &b);
            for row in rows {
                if phase == Phase::Relax {
                    row.pushed = row.impulse;
                    row.note_impulse();
                }
                row.begin(&at, &a, &b, phase, island.times);
                for (body, j) in row.bodies.into_iter().zip(row.j) {
                    self.bodies[body as usize].push(j, row.impulse);
                }
            }
        }
    }

    /// Takes note of what the rows of an island have borne in the last step.
    pub(super) fn note_loads(&mut self, island: &Island, scheme: &Scheme) {
        for &joint in &island.joints {
            let [first, end] = self.places[joint as usize].rows;
            for row in &mut self.rows[first as usize..end as usize] {
                row.note_impulse();
                let load = (row.pushed + row.impulse) / island.times.h;
                let is_kept = scheme.warm_starting || matches!(row.role, Role::Spring { .. });
                // Beyond all bounds nothing is known.
                row.load = if is_kept && (load as f32).is_finite() { load } else { 0.0 };
            }
        }
    }
}

/// The part of a load, N, that bodies may swing by: none after it has changed its sign, as a blow is over before anything swings by
/// it; at most [`GROWTH`] times what it was `before`, as one that whips grows from step to step.
fn lasting(before: f64, now: f64) -> f64 {
    if before * now > 0.0 { now.abs().min(GROWTH * before.abs()).copysign(now) } else { 0.0 }
}

/// A body that has gone through the substep of length `h`, s, in steps, the last of length `step`, as the substep is to take it.
fn of_the_whole(body: &JointBody, start: &JointBody, step: f64, h: f64) -> JointBody {
    if body.inverse_mass <= 0.0 {
        return *start;
    }
    let end = body.after(step);
    let way = [end.shift[0] - start.shift[0], end.shift[1] - start.shift[1], end.angle - start.angle];
    let average =
        if step == h { body.velocity } else { [0, 1, 2].map(|index| way[index] / h - body.missed[index]) };
    // The second kick of the substep is longer than that of the last step.
    let less = 0.5 * (step - h);
    let ahead = [0, 1, 2].map(|index| {
        body.velocity[index] - body.closing[index] - average[index] + less * body.acceleration[index]
    });
    JointBody { velocity: average, ahead, ..*start }
}

impl Pace {
    /// For the next substep, after one of length `h`, s, in which the fastest body swung at `swing`, rad/s.
    pub(super) fn after(&mut self, h: f64, swing: f64) {
        self.calm = if 2.0 * self.step * swing < SLOW_PHASE { self.calm + h } else { 0.0 };
        if self.calm > CALM && self.step < f64::INFINITY {
            *self =
                if 2.0 * self.step < h { Self { step: 2.0 * self.step, calm: 0.0 } } else { Self::default() };
        }
    }

    /// The one of the shorter steps.
    pub(super) fn finer(self, other: Self) -> Self {
        Self { step: self.step.min(other.step), calm: self.calm.min(other.calm) }
    }
}
