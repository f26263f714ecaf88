//! Mass scaling: what is pressed too hard for the length of a substep turns as if its moment of inertia were greater.
//!
//! A load F presses a body at a place whose core, what corners are round about, is at c from its centre. As the body turns, F goes on in its direction n,
//! and gets a lever: per radian it exerts the torque F c · n, the geometric stiffness of the contact (M. Tournier et al., "Stable Constrained
//! Dynamics", 2015). So the body rocks, or topples, with
//!
//! ```text
//! ω² = Σ F |c · n| / I
//! ```
//!
//! If ω h is too large for substeps of length h, light bodies in a heap jitter, and shake their load: heaps neither come to rest nor bear what lies on them
//! without sinking in. How fast such a body turns does not matter, as its inertia is little beside what presses it. So the inertia is raised until ω h is
//! at the limit, for a step (the mass scaling of explicit finite elements; L. Olovsson, K. Simonsson & M. Unosson, "Selective mass scaling for explicit
//! finite element analyses", 2005). What is raised gives off as many times more spin than it has. Circles have no such stiffness, as they roll
//! (c = 0), and what is joined is left as it is, as its springs go by its inertia.
//!
//! Only loads count that are [steady and notable](super::load), in islands that are swept: what is solved directly does not jitter. Where settings do not
//! adapt there are none.

use crate::body::Bodies;
use crate::collision::{Contact, Contacts};
use crate::joint::Joints;
use crate::math::Vec2;
use crate::resolution::constraint_graph::ConstraintGraph;
use crate::resolution::load::Loads;

/// Substeps follow what turns no faster than this, ω h, no unit. With 1.5 one of eight heaps of 300 bodies with densities 20 : 1 is 13 mm deep after
/// twenty seconds, instead of 6 mm; with 0.35 nine of 24 such heaps are still awake, instead of one, as what turns too slowly is in the way.
const FASTEST_TURNING: f32 = 0.75;

/// A moment of inertia is taken for no more than so many times what it is, no unit. Heaps with densities of up to 1,000 : 1 ask for less. What walls squeeze asks
/// for any: with 64 times, a box that a press holds trembles at 1 mm/s for ever, and with 300 at 1 cm/s.
const GREATEST_SCALE: f32 = 16.0;

/// The bodies that are scaled in a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct MassScaling {
    /// By slot: Σ J |c · n| of the impulses J of loads in a substep, N m s. 0 between steps.
    torques: Vec<f32>,
    /// The slots of those that are pressed, and 1/I as it is in truth, 1/(kg m²).
    pressed: Vec<(u32, f32)>,
}

impl MassScaling {
    /// Scales what was pressed too hard in the last step for substeps of length `h`, s.
    pub(crate) fn begin(
        &mut self,
        loads: &Loads,
        contacts: &Contacts,
        graph: &ConstraintGraph,
        bodies: &mut Bodies,
        joints: &Joints,
        h: f32,
    ) {
        self.torques.resize(bodies.motions.len(), 0.0);
        for &index in &loads.notable {
            if graph.sweeps(index) && loads.of_contact[index as usize].is_steady() {
                self.add(&contacts[index], bodies, joints);
            }
        }
        self.scale(bodies, h);
    }

    /// Scales those of which a load was added.
    fn scale(&mut self, bodies: &mut Bodies, h: f32) {
        for &(slot, inverse_inertia) in &self.pressed {
            let turning_square = inverse_inertia * core::mem::take(&mut self.torques[slot as usize]) * h;
            let scale = turning_square / (FASTEST_TURNING * FASTEST_TURNING);
            if scale > 1.0 {
                bodies.motions[slot as usize].inverse_inertia /= scale.min(GREATEST_SCALE);
            }
        }
    }

    /// Adds the load of a contact.
    fn add(&mut self, contact: &Contact, bodies: &Bodies, joints: &Joints) {
        let [radius_a, radius_b] =
            contact.colliders.map(|collider| bodies.shapes[collider as usize].corner_radius());
        let normal = contact.manifold.normal;
        let lever = |anchor: Vec2, radius: f32| (anchor.dot(normal).abs() - radius).max(0.0);
        let points = || contact.manifold.points().iter();
        let torque_on_a =
            points().map(|point| point.normal_impulse * lever(point.anchor_a, radius_a)).sum::<f32>();
        let torque_on_b =
            points().map(|point| point.normal_impulse * lever(point.anchor_b, radius_b)).sum::<f32>();
        for (slot, torque) in contact.slots.into_iter().zip([torque_on_a, torque_on_b]) {
            let inverse_inertia = bodies.motions[slot as usize].inverse_inertia;
            if torque > 0.0 && inverse_inertia > 0.0 && !joints.hold(slot) {
                let sum = &mut self.torques[slot as usize];
                if *sum == 0.0 {
                    self.pressed.push((slot, inverse_inertia));
                }
                *sum += torque;
            }
        }
    }

    /// Gives the bodies back their moments of inertia, as the step ends.
    pub(crate) fn end(&mut self, bodies: &mut Bodies) {
        for (slot, inverse_inertia) in self.pressed.drain(..) {
            bodies.motions[slot as usize].inverse_inertia = inverse_inertia;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Body, BodyId, Mixed};
    use crate::collision::{FeatureId, Manifold, ManifoldPoint};
    use crate::joint::Joint;
    use crate::shape::Shape;

    const H: f32 = 1.0 / 240.0;

    /// By how much the inertia of a body of 1 kg and 1 m is raised that an impulse, N s, presses to the ground at the middle of its base. Afterwards it is
    /// as it was, to the bit.
    fn scale(shape: Shape, impulse: f32, is_joined: bool) -> f32 {
        let mut bodies = Bodies::default();
        let ground = bodies.insert(&Body::fixed(Shape::obb(9.0, 1.0)).at([0.0, -0.5])).0.index();
        let key = bodies.insert(&Body::dynamic(shape).mass(1.0).at([0.0, 0.5])).0;
        let mut joints = Joints::default();
        if is_joined {
            joints.insert(Joint::revolute(BodyId(key), None), &bodies);
        }
        let slot = key.index() as usize;
        let mut contacts = Contacts::default();
        let index = contacts.begin(&mut bodies, [ground, key.index()], Mixed::default());
        let mut point = ManifoldPoint::new(Vec2::new(0.0, 0.5), Vec2::new(0.0, 1.0), 0.0, FeatureId::SINGLE);
        point.normal_impulse = impulse;
        contacts[index].manifold = Manifold::of_one(Vec2::new(0.0, 1.0), point);
        let before = bodies.motions[slot].inverse_inertia;
        let mut scaling = MassScaling::default();
        scaling.torques.resize(bodies.motions.len(), 0.0);
        scaling.add(&contacts[index], &bodies, &joints);
        scaling.scale(&mut bodies, H);
        let raised = bodies.motions[slot].inverse_inertia;
        scaling.end(&mut bodies);
        assert_eq!(bodies.motions[slot].inverse_inertia.to_bits(), before.to_bits());
        before / raised
    }

    /// Of a box I = 1/6 kg m² and c · n = 0.5 m: (ω h)² = J h c/I. Three roundings of numbers of order 1, and one of 1/I.
    #[test]
    fn a_box_turns_no_faster_than_substeps_follow() {
        let critical = FASTEST_TURNING.powi(2) / (6.0 * 0.5 * H);
        for (impulse, factor) in
            [(0.0, 1.0), (0.9 * critical, 1.0), (4.0 * critical, 4.0), (1e6 * critical, GREATEST_SCALE)]
        {
            let found = scale(Shape::obb(1.0, 1.0), impulse, false);
            assert!(
                (found / factor - 1.0).abs() < 8.0 * f32::EPSILON,
                "{impulse} N s: {found}, not {factor}"
            );
        }
    }

    /// A wheel rolls, whatever presses it; what is joined drives others by its inertia.
    #[test]
    fn what_rolls_or_is_joined_is_left_as_it_is() {
        assert_eq!(scale(Shape::circle(0.5), 1e6, false), 1.0);
        assert_eq!(scale(Shape::obb(1.0, 1.0), 1e6, true), 1.0);
    }
}
