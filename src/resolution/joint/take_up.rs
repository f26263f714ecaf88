//! Taking up the joints of a step: their bodies, rows, and where they are when it begins.

use crate::body::{Bodies, NONE};
use crate::collision::Contacts;
use crate::compute::GROUND_ROW;
use crate::joint::{End, JointRecord, Joints, Pace};
use crate::math::{Point, Rot, Vec2, atan2_f64};
use crate::resolution::constraint_graph::ConstraintGraph;
use crate::resolution::joint::JointSolver;
use crate::resolution::joint::geometry::{Base, JointBody, nearest, rotate};
use crate::resolution::joint::kinds::{Inverse, rows_of};
use crate::resolution::joint::plan::{Place, plan};

/// Joints are taken for no smaller than this, m: at the centres of its bodies one has no size but rounding, and nothing would be
/// exact to a share of that.
const SMALLEST: f64 = 1e-3;

impl JointSolver {
    /// Takes up the joints of which a body is moved.
    pub(in crate::resolution) fn prepare(&mut self, joints: &mut Joints, bodies: &Bodies) {
        self.broken.clear();
        self.places.clear();
        if joints.len() == 0 {
            return;
        }
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
            let is_moved = |slot: u32| slot != NONE && bodies.is_dynamic(slot);
            let acts = record.description.enabled && slots.into_iter().any(is_moved);
            if !acts {
                // What does not act bears nothing.
                if !record.description.enabled {
                    record.state.loads = Default::default();
                }
                record.state.force = Vec2::ZERO;
                record.state.torque = 0.0;
            } else if record.moves_one_that_is_awake(bodies) {
                // What sleeps goes on to bear what it bore as it fell asleep.
                self.add(index, record, bodies);
            }
        }
        if self.planned != self.places {
            self.planned.clone_from(&self.places);
            self.islands = plan(&self.places, self.bodies.len());
        }
        for (number, island) in (0..).zip(&mut self.islands) {
            for &place in &island.bodies {
                let body = &mut self.bodies[place as usize];
                body.island = if body.inverse_mass > 0.0 { number } else { NONE };
            }
            let paces =
                island.joints.iter().map(|&joint| joints.all[self.places[joint as usize].joint].state.pace);
            island.pace = paces.fold(Pace::default(), Pace::finer);
        }
    }

    /// Finds the contacts of the bodies of joints that are swept over.
    pub(in crate::resolution) fn find_contacts(
        &mut self,
        bodies: &Bodies,
        contacts: &Contacts,
        graph: &ConstraintGraph,
    ) {
        self.contacts.clear();
        if self.is_empty() {
            return;
        }
        for island in &mut self.islands {
            island.touches = false;
        }
        let is_joined = |slot: u32| {
            bodies.is_dynamic(slot) && self.place_of_slot.get(slot as usize).is_some_and(|&place| place != 0)
        };
        for body in self.bodies[1..].iter().filter(|body| body.inverse_mass > 0.0) {
            let (slot, island) =
                (bodies.slot_of_row(body.row as usize), &mut self.islands[body.island as usize]);
            for index in contacts.of_body(bodies, slot) {
                // A contact of two such bodies is in the lists of both.
                let first = contacts[index].slots[0];
                let is_first = slot == first || !is_joined(first);
                let Some(home) = graph.home(index) else { continue };
                island.touches = true;
                self.contacts.extend((is_first && !home.is_solved_directly()).then_some(home));
            }
        }
        self.contacts.sort_unstable();
    }

    fn add(&mut self, index: u32, record: &mut JointRecord, bodies: &Bodies) {
        let base = base_of(record, bodies);
        let places = record.slots().map(|slot| self.place_of(slot, bodies));
        let [a, b] = places.map(|place| self.bodies[place as usize]);
        let inverse =
            Inverse { mass: a.inverse_mass + b.inverse_mass, inertia: a.inverse_inertia + b.inverse_inertia };
        let first = self.rows.len();
        rows_of(record, inverse, &mut self.rows);
        for (row, load) in self.rows[first..].iter_mut().zip(record.state.loads) {
            row.joint = self.places.len() as u32;
            row.bodies = places;
            row.load = f64::from(load);
            row.scale = row.coordinate.size(&base).max(SMALLEST);
        }
        let movable = |place: u32| if self.bodies[place as usize].inverse_mass > 0.0 { place } else { 0 };
        self.places.push(Place {
            joint: index,
            rows: [first as u32, self.rows.len() as u32],
            bodies: places.map(movable),
            ends: places,
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
}

/// A body at the beginning of a step.
fn body_of(row: u32, inverse: Option<[f32; 2]>) -> JointBody {
    let [inverse_mass, inverse_inertia] = inverse.unwrap_or_default().map(f64::from);
    JointBody {
        row,
        island: NONE,
        inverse_mass,
        inverse_inertia,
        stiffness: [0.0; 2],
        velocity: [0.0; 3],
        missed: [0.0; 3],
        kept: [0.0; 3],
        shift: [0.0; 2],
        turn: [1.0, 0.0],
        angle: 0.0,
        unclosed: [0.0; 3],
        closing: [0.0; 3],
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
    let rope = |wheel: Point, center: Point, r: [f64; 2]| {
        let [x, y] = between(wheel, center);
        [x + r[0], y + r[1]]
    };
    let ropes = record
        .description
        .wheels
        .map(|[wheel_a, wheel_b]| [rope(wheel_a, pose_a.center, r_a), rope(wheel_b, center_b, r_b)]);
    Base {
        gap: [offset[0] + r_b[0] - r_a[0], offset[1] + r_b[1] - r_a[1]],
        r_a,
        r_b,
        axis: rotate(q_a, wide(record.axis)),
        ropes: ropes.unwrap_or_default(),
        angles: [angle_a, angle_b - record.reference],
    }
}
