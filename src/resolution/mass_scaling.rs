//! Mass scaling: what is pressed too hard for the length of a substep turns as if its moment of inertia were greater.
//!
//! Loads F that press a body at arms r from its centre turn it with up to Σ F r for each radian that it has turned (the geometric stiffness of its
//! contacts; M. Tournier et al., "Stable Constrained Dynamics", 2015). So it rocks, or topples, with
//!
//! ```text
//! ω² = Σ F r / I
//! ```
//!
//! Where that is faster than substeps of length h can follow, a light body in a heap is shaken, and its load with it: heaps neither come to rest nor
//! bear what lies on them without sinking in. How fast it truly turns there is of no account, as its inertia is little beside what presses it. So it is
//! taken for as much greater as brings ω h down to what substeps follow, and its load goes through it as before (the mass scaling of explicit finite
//! elements; L. Olovsson, K. Simonsson & M. Unosson, "Selective mass scaling for explicit finite element analyses", 2005).
//!
//! Only loads count that are [steady](super::load). So a blow changes nothing: what spins freely keeps its angular momentum. What spins while it is
//! pressed, and is slowed, gives off as many times more than it has. What is solved directly needs none of this.

use crate::body::Bodies;
use crate::collision::{Contact, Contacts};
use crate::resolution::constraint_graph::ConstraintGraph;
use crate::resolution::load::Loads;

/// Substeps follow what turns no faster than this, ω h, no unit. With 1.5 one of eight heaps of 300 bodies with densities 20 : 1 is 13 mm deep after
/// twenty seconds, for 6; with 0.35 nine of 24 such heaps are still awake, for one, as what turns too slowly is in the way.
const FASTEST_TURNING: f32 = 0.75;

/// A moment of inertia is taken for no more than so many times what it is, no unit. Heaps with densities of up to 1,000 : 1 ask for less. What walls squeeze asks
/// for any: with 64 times, a box that a press holds trembles at 1 mm/s for ever, and with 300 at 1 cm/s.
const GREATEST_SCALE: f32 = 16.0;

/// The bodies that are scaled in a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct MassScaling {
    /// By slot: the torque of the loads that press a body, times the length of a substep, per radian, N m s. 0 between steps.
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
        h: f32,
    ) {
        self.torques.resize(bodies.motions.len(), 0.0);
        for &index in &loads.notable {
            let is_swept = graph.home(index).is_some_and(|home| !home.is_solved_directly());
            if is_swept && loads.of_contact[index as usize].is_steady() {
                self.add(&contacts[index], bodies);
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
    fn add(&mut self, contact: &Contact, bodies: &Bodies) {
        let points = || contact.manifold.points().iter();
        let torque_on_a = points().map(|point| point.normal_impulse * point.anchor_a.length()).sum::<f32>();
        let torque_on_b = points().map(|point| point.normal_impulse * point.anchor_b.length()).sum::<f32>();
        for (slot, torque) in contact.slots.into_iter().zip([torque_on_a, torque_on_b]) {
            let inverse_inertia = bodies.motions[slot as usize].inverse_inertia;
            if torque > 0.0 && inverse_inertia > 0.0 {
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
    use crate::body::{Body, Mixed};
    use crate::collision::{FeatureId, Manifold, ManifoldPoint};
    use crate::math::Vec2;
    use crate::shape::Shape;

    /// A box of 1 kg on the ground, pressed by an impulse at an arm of 0.5 m: I = 1/6 kg m².
    fn pressed(impulse: f32) -> (Bodies, Contacts) {
        let mut bodies = Bodies::default();
        let ground = bodies.insert(&Body::fixed(Shape::obb(9.0, 1.0)).at([0.0, -0.5])).0.index();
        let slot = bodies.insert(&Body::dynamic(Shape::obb(1.0, 1.0)).mass(1.0).at([0.0, 0.5])).0.index();
        let mut contacts = Contacts::default();
        let index = contacts.begin(&mut bodies, [ground, slot], Mixed::default());
        let mut point = ManifoldPoint::new(Vec2::new(0.0, 0.5), Vec2::new(0.0, 1.0), 0.0, FeatureId::SINGLE);
        point.normal_impulse = impulse;
        contacts[index].manifold = Manifold::of_one(Vec2::new(0.0, 1.0), point);
        (bodies, contacts)
    }

    /// ω h = √(J r h/I) is brought to the limit where it is above, as far as inertia may grow, and left alone below. Afterwards all is as it was, to the bit.
    #[test]
    fn what_is_pressed_turns_no_faster_than_substeps_follow() {
        let h = 1.0 / 240.0;
        let critical = FASTEST_TURNING.powi(2) / (6.0 * 0.5 * h);
        for (impulse, factor) in
            [(0.0, 1.0), (0.9 * critical, 1.0), (4.0 * critical, 4.0), (1e6 * critical, GREATEST_SCALE)]
        {
            let (mut bodies, contacts) = pressed(impulse);
            let inverse_inertia = |bodies: &Bodies| bodies.motions[1].inverse_inertia;
            let (before, mut scaling) = (inverse_inertia(&bodies), MassScaling::default());
            scaling.torques.resize(2, 0.0);
            scaling.add(&contacts[0], &bodies);
            scaling.scale(&mut bodies, h);
            let found = before / inverse_inertia(&bodies);
            assert!((found / factor - 1.0).abs() < 1e-5, "{impulse} N s: {found} times, for {factor}");
            scaling.end(&mut bodies);
            assert_eq!(inverse_inertia(&bodies).to_bits(), before.to_bits());
        }
    }
}
