//! Joints in the substep: pushed before the drift, relaxed after it, before the contacts, and in turn with those of joined
//! bodies.
//!
//! Runs where there are joints, and costs a comparison where there are none. What a joint is like is found once per step, its
//! rows and their masses at the pose of the moment in each phase. Joints that hang together are solved at once, by a sparse
//! factorization in which a chain or a tree has no fill: a weight of any size at the end of a rope of any length. After the drift
//! each rigid row is exact to rounding, which makes pendulums and linkages of second order, see [`row`].
//!
//! A contact is solved as if its bodies were free, and what it does to them is spread over the joints by a solve of these; then
//! the contact is solved again. That is block Gauss-Seidel on one convex problem: each turn takes from what is left the share of
//! the mass that the contact feels which is that of its own bodies. The joints have the last word.

mod factor;
mod finish;
mod gaps;
mod geometry;
mod kinds;
mod loops;
mod plan;
mod row;
mod solve;
mod steps;
mod take_up;

use core::ops::Range;

use crate::body::NONE;
use crate::compute::BodyState;
use crate::math::Vec2;
use crate::resolution::constraint_graph::GraphIndex;
use crate::resolution::integrate::Kicks;
use crate::resolution::joint::geometry::{Base, JointBody, V3};
use crate::resolution::joint::plan::{Island, Place};
pub(super) use crate::resolution::joint::row::Phase;
use crate::resolution::joint::row::Row;
use crate::resolution::scheme::Scheme;

/// The joints of a step, and the bodies they move.
#[derive(Debug, Default)]
pub(crate) struct JointSolver {
    /// The ground, and the bodies of joints that have a row.
    bodies: Vec<JointBody>,
    /// By slot, the place of a body among them; 0 for none.
    place_of_slot: Vec<u32>,
    bases: Vec<Base>,
    rows: Vec<Row>,
    places: Vec<Place>,
    /// Length of the substep, s.
    h: f64,
    /// Scratch: the bodies as the substep began, and their velocities as the last step did.
    starts: Vec<JointBody>,
    velocities: Vec<V3>,
    /// Those for which the islands were planned.
    planned: Vec<Place>,
    islands: Vec<Island>,
    /// Contacts of the bodies that are swept over.
    contacts: Vec<GraphIndex>,
    /// Joints that bore more than they can, by their index.
    broken: Vec<u32>,
}

// As long as the joints are the same, a step begins with what the last one has found of their islands.
clone_into_buffers!(JointSolver { planned, islands } scratch {
    bodies, place_of_slot, bases, rows, places, h, starts, velocities, contacts, broken
});

/// How a row answers to what pushes its bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Acting {
    /// Its speed per velocity of each of the two bodies, as far as impulses change that: what does not turn is not turned.
    pub(super) j: [V3; 2],
    /// J M⁻¹ Jᵀ, and what it yields by beside, 1/kg.
    pub(super) k: f64,
    pub(super) softness: f64,
    /// By how much its impulse may change, N s.
    pub(super) range: [f64; 2],
    /// How fast its coordinate is off the speed that makes it bear anything, m/s or rad/s: 0 but for a limit that is not met yet.
    pub(super) slack: f64,
}

impl JointSolver {
    /// Whether no joint acts in this step.
    pub(super) fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// The joints that broke in the last step, by ascending index.
    pub(crate) fn broken(&self) -> &[u32] {
        &self.broken
    }

    /// Forgets them.
    pub(crate) fn forget_broken(&mut self) {
        self.broken.clear();
    }

    /// The contacts of joined bodies.
    pub(super) fn contacts(&self) -> &[GraphIndex] {
        &self.contacts
    }

    /// The rows of the joint with this index, and the rows of its bodies among the states; `None` where it does not act.
    pub(super) fn rows_of_joint(&self, index: u32) -> Option<(Range<u32>, [u32; 2])> {
        let place = self.places.binary_search_by_key(&index, |place| place.joint).ok()?;
        let Place { rows: [first, end], ends, .. } = self.places[place];
        Some((first..end, ends.map(|end| self.bodies[end as usize].row)))
    }

    /// Whether joints connect the bodies in two slots, with each other or by way of others that they move.
    pub(super) fn connects(&self, slots: [u32; 2]) -> bool {
        if self.is_empty() {
            return false;
        }
        let island_of = |slot: u32| {
            let place = self.place_of_slot.get(slot as usize).copied().unwrap_or_default();
            self.bodies[place as usize].island
        };
        let [a, b] = slots.map(island_of);
        a != NONE && a == b
    }

    /// How a row acts, as it was solved last; `None` where it bears nothing that could change.
    pub(super) fn acting(&self, row: u32) -> Option<Acting> {
        let row = &self.rows[row as usize];
        let [a, b] = row.bodies.map(|body| &self.bodies[body as usize]);
        let slack = if row.acts { 0.0 } else { row.speed(a, b) - row.met_at? };
        let mut j = row.j;
        for (j, place) in j.iter_mut().zip(row.bodies) {
            if self.bodies[place as usize].inverse_inertia == 0.0 {
                j[2] = 0.0;
            }
        }
        Some(Acting { j, k: row.k, softness: row.softness, range: row.range_of_change(), slack })
    }

    /// Has a row bear what the direct solve hands over to it in this phase, N s in all: its bodies have been given it.
    pub(super) fn hand_over(&mut self, row: u32, impulse: f64) {
        let row = &mut self.rows[row as usize];
        row.impulse += impulse - row.handed;
        row.handed = impulse;
    }

    /// Takes back what the direct solve has had a row bear in the push, N s: its bodies have it no more.
    pub(super) fn take_back(&mut self, row: u32, impulse: f64) {
        self.hand_over(row, 0.0);
        self.rows[row as usize].taken_back = impulse;
    }

    /// Reads where the bodies are, before anything strikes them in this substep: what strikes moves them too.
    pub(super) fn begin_substep(&mut self, states: &[BodyState]) {
        for body in &mut self.bodies {
            let state = &states[body.row as usize];
            if !body.is_where(state) {
                body.read_place(state, body.angle + self.h * body.mean_velocity()[2]);
            }
        }
    }

    /// Reads how fast the bodies are, before contacts begin with half of what they bore: [`Self::push`], which follows, takes what they gain by
    /// that for a load.
    pub(super) fn begin_push(&mut self, states: &[BodyState]) {
        for body in &mut self.bodies {
            body.read_velocity(&states[body.row as usize]);
        }
    }

    /// Before the bodies move: what is rigid is exact when they have. The load of their contacts acts over the whole substep, as forces do:
    /// half of it has been applied, and the other half follows after the move. Given at once, in the first of several steps, it would make
    /// links swing that stand.
    pub(super) fn push(&mut self, scheme: &Scheme, kicks: &Kicks, states: &mut [BodyState]) {
        let (h, kick) = (f64::from(scheme.substep_time()), f64::from(scheme.kick_time()));
        self.h = h;
        for body in &mut self.bodies {
            let state = &states[body.row as usize];
            let before = body.velocity;
            body.read_velocity(state);
            body.read_missed(state, h);
            let Vec2 { x, y } = kicks.acceleration(body.row);
            let by_forces = [x, y, kicks.angular_acceleration(body.row)].map(f64::from);
            let by_loads = difference(body.velocity, before).map(|gain| gain / kick);
            let all = [0, 1, 2].map(|index| by_forces[index] + by_loads[index]);
            body.acceleration = if scheme.split_kick && body.inverse_mass > 0.0 { all } else { [0.0; 3] };
            // Forces act step by step.
            body.accelerate(-kick);
        }
        self.starts.clone_from(&self.bodies);
        for row in &mut self.rows {
            row.load_before = row.load;
        }
        self.for_each_island(|solver, island| solver.push_island(island, scheme));
        self.write(states);
    }

    /// After they have: what is rigid does not part.
    pub(super) fn relax(&mut self, scheme: &Scheme, states: &mut [BodyState]) {
        if scheme.split_kick {
            self.read(states, Phase::Relax);
            for body in &mut self.bodies {
                body.velocity = [0, 1, 2].map(|index| body.velocity[index] + body.ahead[index]);
            }
            self.for_each_island(|solver, island| solver.run(island, Phase::Relax));
            self.write(states);
        }
    }

    /// Passes on over the joints what others have pushed their bodies by since this was last done, in islands where it is more than so much,
    /// m/s; returns whether there was one. Where an island goes through the move in steps, which are dear, it is only spread, and
    /// [`Self::solve_again`] has to follow.
    pub(super) fn pass_on(&mut self, phase: Phase, states: &mut [BodyState], more_than: f64) -> bool {
        self.answer_pushes(states, |solver, island, by| {
            if by <= more_than {
                return false;
            }
            if solver.is_divided(island, phase) {
                solver.spread(island);
            } else {
                island.pushed = 0.0;
                solver.solve_rows(island, phase, false);
            }
            true
        })
    }

    /// Solves those islands in full whose bodies others have pushed since they last were: the end of a phase.
    pub(super) fn solve_again(&mut self, phase: Phase, scheme: &Scheme, states: &mut [BodyState]) {
        self.answer_pushes(states, |solver, island, _| {
            if island.pushed <= 0.0 {
                return false;
            }
            island.pushed = 0.0;
            if solver.is_divided(island, phase) {
                solver.push_island(island, scheme);
            } else {
                solver.solve_rows(island, phase, false);
            }
            true
        });
    }

    /// Lets islands answer to what their bodies were pushed by since this was last asked, m/s; returns whether one did.
    fn answer_pushes(
        &mut self,
        states: &mut [BodyState],
        mut answer: impl FnMut(&mut Self, &mut Island, f64) -> bool,
    ) -> bool {
        let mut has_answered = false;
        self.for_each_island(|solver, island| {
            let by = solver.read_changes(island, states);
            island.pushed += by;
            has_answered |= answer(solver, island, by);
        });
        if has_answered {
            self.write(states);
        }
        has_answered
    }

    /// Whether an island goes through the move in several steps.
    fn is_divided(&self, island: &Island, phase: Phase) -> bool {
        phase == Phase::Push && island.times.h < self.h
    }

    /// The end of a substep: takes note of what the rows have borne.
    pub(super) fn end_substep(&mut self, scheme: &Scheme) {
        let h = self.h;
        self.for_each_island(|solver, island| {
            solver.note_loads(island, scheme);
            island.pace.after(h, island.swing);
        });
        for row in &mut self.rows {
            row.in_step = [0, 1, 2].map(|index| row.in_step[index] + row.in_substep[index]);
        }
    }

    fn for_each_island(&mut self, mut act: impl FnMut(&mut Self, &mut Island)) {
        for index in 0..self.islands.len() {
            let mut island = std::mem::take(&mut self.islands[index]);
            act(self, &mut island);
            self.islands[index] = island;
        }
    }

    /// Reads where the bodies are, and how fast.
    fn read(&mut self, states: &[BodyState], phase: Phase) {
        for body in &mut self.bodies {
            let state = &states[body.row as usize];
            let expected =
                body.angle + if phase == Phase::Relax { self.h * body.mean_velocity()[2] } else { 0.0 };
            body.read_velocity(state);
            body.read_place(state, expected);
            body.missed = [0.0; 3];
        }
    }

    /// Reads the bodies of an island that others have pushed or struck, and keeps what their velocities were before; returns by how much, m/s.
    fn read_changes(&mut self, island: &Island, states: &[BodyState]) -> f64 {
        let mut most = 0.0_f64;
        for &place in &island.bodies {
            let body = &mut self.bodies[place as usize];
            let state = &states[body.row as usize];
            body.kept = body.velocity;
            if body.inverse_mass <= 0.0 {
                continue;
            }
            let (before, missed) = (body.velocity, body.missed);
            body.read_missed(state, self.h);
            // As it was written.
            if is_at(state, before) && body.missed == missed {
                continue;
            }
            body.read_velocity(state);
            let change = difference(body.velocity, before);
            let start = &mut self.starts[place as usize];
            start.velocity = [0, 1, 2].map(|index| start.velocity[index] + change[index]);
            start.missed = body.missed;
            most = most.max(body.pace_of(change)).max(body.pace_of(difference(body.missed, missed)));
        }
        most
    }

    /// Writes how fast the bodies are. A number that is not finite, of a world beyond all bounds, is left out.
    fn write(&self, states: &mut [BodyState]) {
        for body in &self.bodies[1..] {
            let velocity = body.velocity.map(|v| v as f32);
            if body.inverse_mass > 0.0 && velocity.iter().all(|v| v.is_finite()) {
                let state = &mut states[body.row as usize];
                state.velocity = Vec2::new(velocity[0], velocity[1]).into();
                state.angular_velocity = velocity[2];
            }
        }
    }
}

fn difference(a: V3, b: V3) -> V3 {
    [0, 1, 2].map(|index| a[index] - b[index])
}

/// Whether the velocity of a body is this one, m/s and rad/s, but for rounding.
fn is_at(state: &BodyState, velocity: V3) -> bool {
    [state.velocity.x, state.velocity.y, state.angular_velocity] == velocity.map(|v| v as f32)
}
