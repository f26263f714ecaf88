//! Joints in the substep: pushed before the drift, relaxed after it, before the contacts.
//!
//! Runs where there are joints, and costs a comparison where there are none. What a joint is like is found once per step, its
//! rows and their masses at the pose of the moment in each phase. Joints that hang together are solved at once, by a sparse
//! factorization in which a chain or a tree has no fill: a weight of any size at the end of a rope of any length. After the drift
//! each rigid row is exact to rounding, which makes pendulums and linkages of second order, see [`row`].

mod factor;
mod geometry;
mod kinds;
mod plan;
mod row;
mod solve;

use crate::body::{Bodies, NONE};
use crate::compute::{BodyState, GROUND_ROW};
use crate::joint::{End, JointRecord, Joints, Pace};
use crate::math::{Point, Rot, Vec2, atan2_f64};
use crate::resolution::integrate::Kicks;
use crate::resolution::joint::geometry::{Base, JointBody, V3, dot, nearest, rotate};
use crate::resolution::joint::kinds::{Inverse, rows_of};
use crate::resolution::joint::plan::{Cluster, Place, plan};
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

/// The joints of a step, and the bodies they move.
#[derive(Clone, Debug, Default)]
pub(crate) struct JointSolver {
    /// The ground, and the bodies of joints that have a row.
    bodies: Vec<JointBody>,
    /// By slot, the place of a body among them; 0 for none.
    place_of_slot: Vec<u32>,
    bases: Vec<Base>,
    rows: Vec<Row>,
    places: Vec<Place>,
    /// Length of the substep, s, and times of the last step in it.
    h: f64,
    times: Times,
    pace: Pace,
    /// Scratch: the bodies as the substep began, and their velocities as the last step did.
    starts: Vec<JointBody>,
    velocities: Vec<V3>,
    /// Those for which the clusters were planned.
    planned: Vec<Place>,
    clusters: Vec<Cluster>,
    /// Joints that bore more than they can, by their index.
    broken: Vec<u32>,
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

    /// Takes up the joints of which a body is moved.
    pub(super) fn prepare(&mut self, joints: &mut Joints, bodies: &Bodies) {
        self.broken.clear();
        self.places.clear();
        if joints.len() == 0 {
            return;
        }
        self.pace = joints.pace;
        self.bodies.clear();
        self.bodies.push(body_of(GROUND_ROW, None));
        self.bases.clear();
        self.rows.clear();
        self.place_of_slot.clear();
        self.place_of_slot.resize(bodies.motions.len(), 0);
        for index in 0..joints.all.place_count() as u32 {
            if joints.all.at(index).is_none() {
                continue;
            }
            let record = &mut joints.all[index];
            let slots = record.slots();
            let is_moved = |slot: u32| slot != NONE && bodies.is_dynamic(slot) && bodies.is_awake(slot);
            if record.description.enabled && slots.into_iter().any(is_moved) {
                self.add(index, record, bodies);
            } else {
                // What does not act bears nothing.
                if !record.description.enabled {
                    record.state.loads = Default::default();
                }
                record.state.force = Vec2::ZERO;
                record.state.torque = 0.0;
            }
        }
        if self.planned != self.places {
            self.planned.clone_from(&self.places);
            self.clusters = plan(&self.places, self.bodies.len());
        }
    }

    fn add(&mut self, index: u32, record: &mut JointRecord, bodies: &Bodies) {
        let base = base_of(record, bodies);
        let places = record.slots().map(|slot| self.place_of(slot, bodies));
        let [a, b] = places.map(|place| self.bodies[place as usize]);
        let inverse =
            Inverse { mass: a.inverse_mass + b.inverse_mass, inertia: a.inverse_inertia + b.inverse_inertia };
        let first = self.rows.len();
        rows_of(record, inverse, &mut self.rows);
        let length = |v| dot(v, v).sqrt();
        let size = length(base.r_a) + length(base.r_b) + length(base.gap);
        for (row, load) in self.rows[first..].iter_mut().zip(record.state.loads) {
            row.joint = self.places.len() as u32;
            row.bodies = places;
            row.load = f64::from(load);
            row.scale = if row.coordinate.is_angle() || size == 0.0 { 1.0 } else { size };
            if let (true, Role::Rigid) = (row.coordinate.is_angle(), row.role) {
                row.zero = record.zero_angle();
            }
        }
        let movable = |place: u32| if self.bodies[place as usize].inverse_mass > 0.0 { place } else { 0 };
        self.places.push(Place {
            joint: index,
            rows: [first as u32, self.rows.len() as u32],
            bodies: places.map(movable),
        });
        self.bases.push(base);
    }

    /// The place of the body in a slot, which gets one if it has a row.
    fn place_of(&mut self, slot: u32, bodies: &Bodies) -> u32 {
        if slot == NONE || !bodies.is_awake(slot) {
            return 0;
        }
        let place = &mut self.place_of_slot[slot as usize];
        if *place == 0 {
            *place = self.bodies.len() as u32;
            let motion = &bodies.motions[slot as usize];
            self.bodies.push(body_of(motion.row, Some([motion.inverse_mass, motion.inverse_inertia])));
        }
        *place
    }

    /// Before the bodies move: what is rigid is exact when they have.
    ///
    /// Where a link swings too fast for the substep, the bodies of joints go through it in several steps, each with push, drift
    /// and relax. The last ends as a single one would: its drift is the way of all, its relax comes when the bodies have moved.
    pub(super) fn push(&mut self, scheme: &Scheme, kicks: &Kicks, states: &mut [BodyState]) {
        let (h, kick) = (f64::from(scheme.substep_time()), f64::from(scheme.kick_time()));
        self.h = h;
        self.read(states, Phase::Push);
        for body in &mut self.bodies {
            let Vec2 { x, y } = kicks.acceleration(body.row);
            let all = [x, y, kicks.angular_acceleration(body.row)].map(f64::from);
            body.acceleration = if scheme.split_kick && body.inverse_mass > 0.0 { all } else { [0.0; 3] };
            // Forces act step by step.
            body.accelerate(-kick);
        }
        self.starts.clone_from(&self.bodies);
        let (mut rest, mut fastest) = (h, 0.0_f64);
        loop {
            let steps =
                if scheme.split_kick { (rest / self.pace.step).ceil().clamp(1.0, MOST_STEPS) } else { 1.0 };
            self.times = Times { h: rest / steps, kick: kick / h * (rest / steps) };
            let swing = self.push_for_a_step(scheme.split_kick);
            fastest = fastest.max(swing);
            let Times { h: step, .. } = self.times;
            if step >= rest {
                break;
            }
            for body in &mut self.bodies {
                *body = body.after(step);
                body.accelerate(0.5 * step);
            }
            self.run(Phase::Relax);
            self.note_loads(scheme);
            rest -= step;
        }
        self.pace.after(h, fastest);
        for (body, start) in self.bodies.iter_mut().zip(&self.starts) {
            let end = body.after(self.times.h);
            let way = [end.shift[0] - start.shift[0], end.shift[1] - start.shift[1], end.angle - start.angle];
            let is_one_step = self.times.h == h;
            let average = if is_one_step { body.velocity } else { way.map(|way| way / h) };
            // The second kick of the substep is longer than that of the last step.
            let less = 0.5 * (self.times.h - h);
            body.ahead = [0, 1, 2]
                .map(|index| body.velocity[index] - average[index] + less * body.acceleration[index]);
            *body = JointBody { velocity: average, ahead: body.ahead, ..*start };
        }
        self.write(states);
    }

    /// Pushes for a step, or for a half of it, and so on, if what that takes makes a body swing too fast. Returns how fast the
    /// fastest swings, rad/s.
    fn push_for_a_step(&mut self, may_be_divided: bool) -> f64 {
        self.velocities.clear();
        self.velocities.extend(self.bodies.iter().map(|body| body.velocity));
        loop {
            let Times { h: step, kick } = self.times;
            for (body, velocity) in self.bodies.iter_mut().zip(&self.velocities) {
                body.velocity = *velocity;
                body.accelerate(0.5 * step);
            }
            self.run(Phase::Push);
            let swing = self.fastest_swing(|row| row.impulse / kick);
            if swing * step <= MOST_PHASE || !may_be_divided || step < 2.0 * self.h / MOST_STEPS {
                return swing;
            }
            self.times = Times { h: 0.5 * step, kick: 0.5 * kick };
            self.pace = Pace { step: 0.5 * step, calm: 0.0 };
        }
    }

    /// After they have: what is rigid does not part.
    pub(super) fn relax(&mut self, scheme: &Scheme, states: &mut [BodyState]) {
        if scheme.split_kick {
            self.read(states, Phase::Relax);
            for body in &mut self.bodies {
                body.velocity = [0, 1, 2].map(|index| body.velocity[index] + body.ahead[index]);
            }
            self.run(Phase::Relax);
            self.write(states);
        }
        self.note_loads(scheme);
    }

    /// Takes note of what the rows have borne in the last step.
    fn note_loads(&mut self, scheme: &Scheme) {
        for row in &mut self.rows {
            let load = (row.pushed + row.impulse) / self.times.h;
            let is_kept = scheme.warm_starting || matches!(row.role, Role::Spring { .. });
            // Beyond all bounds nothing is known.
            row.load = if is_kept && (load as f32).is_finite() { load } else { 0.0 };
        }
    }

    fn run(&mut self, phase: Phase) {
        self.begin(phase, self.times);
        self.solve_clusters(phase, self.times);
    }

    /// Reads where the bodies are, and how fast.
    fn read(&mut self, states: &[BodyState], phase: Phase) {
        for body in &mut self.bodies {
            let state = &states[body.row as usize];
            let expected = body.angle + if phase == Phase::Relax { self.h * body.velocity[2] } else { 0.0 };
            body.velocity = [state.velocity.x, state.velocity.y, state.angular_velocity].map(f64::from);
            body.shift = [state.delta_position.x, state.delta_position.y].map(f64::from);
            body.turn = [state.delta_rotation.c, state.delta_rotation.s].map(f64::from);
            body.unwrap_angle(expected);
        }
    }

    /// How fast the fastest of the bodies swings by what the rows bear, N, rad/s.
    fn fastest_swing(&mut self, load: impl Fn(&Row) -> f64) -> f64 {
        for body in &mut self.bodies {
            (body.stiffness, body.held) = ([0.0; 2], 0);
        }
        for (place, base) in self.places.iter().zip(&self.bases) {
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
                let stiffness = row.coordinate.geometric_stiffness(&at, load(row));
                for (body, [pull, turn]) in row.bodies.into_iter().zip(stiffness) {
                    let body = &mut self.bodies[body as usize];
                    body.stiffness = [body.stiffness[0] + pull, body.stiffness[1] + turn];
                }
            }
        }
        self.bodies.iter().map(JointBody::swing).fold(0.0, f64::max)
    }

    /// Brings the rows to where the bodies are, and applies what they bore before.
    fn begin(&mut self, phase: Phase, times: Times) {
        for (place, base) in self.places.iter().zip(&self.bases) {
            let rows = &mut self.rows[place.rows[0] as usize..place.rows[1] as usize];
            let Some(first) = rows.first() else { continue };
            let [a, b] = first.bodies.map(|body| self.bodies[body as usize]);
            let at = base.at(&a, &b);
            for row in rows {
                if phase == Phase::Relax {
                    row.pushed = row.impulse;
                }
                row.begin(&at, &a, &b, phase, times);
                for (body, j) in row.bodies.into_iter().zip(row.j) {
                    self.bodies[body as usize].push(j, row.impulse);
                }
            }
        }
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

    /// Writes back what the joints bore, and how far they are off; finds those that broke.
    pub(super) fn finish(&mut self, scheme: &Scheme, joints: &mut Joints, states: &[BodyState]) {
        if self.is_empty() {
            return;
        }
        joints.pace = self.pace;
        self.read(states, if scheme.split_kick { Phase::Push } else { Phase::Relax });
        for (place, base) in self.places.iter().zip(&self.bases) {
            let record = &mut joints.all[place.joint];
            let rows = &self.rows[place.rows[0] as usize..place.rows[1] as usize];
            if finish_joint(record, base, rows, &self.bodies) {
                self.broken.push(place.joint);
            }
        }
    }
}

impl Pace {
    /// After a substep of length `h`, s, in which the fastest body swung at `swing`, rad/s.
    fn after(&mut self, h: f64, swing: f64) {
        self.calm = if 2.0 * self.step * swing < SLOW_PHASE { self.calm + h } else { 0.0 };
        if self.calm > CALM && self.step < f64::INFINITY {
            *self =
                if 2.0 * self.step < h { Self { step: 2.0 * self.step, calm: 0.0 } } else { Self::default() };
        }
    }
}

/// Writes back what a joint bore; whether it was too much.
fn finish_joint(record: &mut JointRecord, base: &Base, rows: &[Row], bodies: &[JointBody]) -> bool {
    let state = &mut record.state;
    let (mut force, mut torque) = ([0.0; 2], 0.0);
    (state.gap, state.angle_gap) = (0.0, 0.0);
    let Some(first) = rows.first() else { return false };
    let [a, b] = first.bodies.map(|body| &bodies[body as usize]);
    let at = base.at(a, b);
    for (row, load) in rows.iter().zip(&mut state.loads) {
        let is_finite = row.load.is_finite() && (row.load as f32).is_finite();
        *load = if is_finite { row.load as f32 } else { 0.0 };
        if row.coordinate.is_angle() {
            torque += row.j[1][2] * row.load;
        } else {
            force = [force[0] + row.j[1][0] * row.load, force[1] + row.j[1][1] * row.load];
        }
        let x = row.coordinate.value(&at) - row.zero;
        let gap = match row.role {
            Role::Rigid => x.abs(),
            Role::Limits([lower, upper]) => (lower - x).max(x - upper).max(0.0),
            _ => 0.0,
        };
        let worst = if row.coordinate.is_angle() { &mut state.angle_gap } else { &mut state.gap };
        *worst = worst.max(gap as f32);
    }
    let finite = |x: f64| (x as f32).clamp(f32::MIN, f32::MAX);
    state.force = Vec2::new(finite(force[0]), finite(force[1]));
    state.torque = finite(torque);
    state.turned([a.angle, b.angle]);
    record.pass_teeth();
    record.bears_too_much()
}

/// A body at the beginning of a step.
fn body_of(row: u32, inverse: Option<[f32; 2]>) -> JointBody {
    let [inverse_mass, inverse_inertia] = inverse.unwrap_or_default().map(f64::from);
    JointBody {
        row,
        inverse_mass,
        inverse_inertia,
        stiffness: [0.0; 2],
        velocity: [0.0; 3],
        shift: [0.0; 2],
        turn: [1.0, 0.0],
        angle: 0.0,
        ahead: [0.0; 3],
        acceleration: [0.0; 3],
        held: 0,
        arm: 0.0,
    }
}

/// What a joint is like when the step begins; its angles are brought to those of the bodies, which may have been turned by hand.
fn base_of(record: &mut JointRecord, bodies: &Bodies) -> Base {
    let wide = |v: Vec2| [f64::from(v.x), f64::from(v.y)];
    let rotation = |rotation: Rot| [f64::from(rotation.c), f64::from(rotation.s)];
    let pose_a = bodies.motions[record.slot_a as usize].pose;
    let (q_a, anchor_a) = (rotation(pose_a.rotation), wide(record.anchor_a));
    let r_a = rotate(q_a, anchor_a);
    let (r_b, q_b, center_b) = match record.end {
        End::Body(slot, anchor) => {
            let pose = bodies.motions[slot as usize].pose;
            let q_b = rotation(pose.rotation);
            (rotate(q_b, wide(anchor)), q_b, pose.center)
        }
        End::World(point) => ([0.0; 2], [1.0, 0.0], point),
    };
    let between = |a: Point, b: Point| [b.x - a.x, b.y - a.y];
    let offset = between(pose_a.center, center_b);
    for (angle, q) in record.state.angles.iter_mut().zip([q_a, q_b]) {
        *angle = nearest(atan2_f64(q[1], q[0]), *angle);
    }
    let [angle_a, angle_b] = record.state.angles;
    Base {
        gap: [offset[0] + r_b[0] - r_a[0], offset[1] + r_b[1] - r_a[1]],
        r_a,
        r_b,
        axis: rotate(q_a, wide(record.axis)),
        angles: [angle_a, angle_b - record.reference],
    }
}
