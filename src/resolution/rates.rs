//! Substeps of another length, as the impulses see it that contacts keep for the warm start.
//!
//! An impulse λ is that of one substep. A force F that lasts leaves λ = F h, and so F h' is what it takes in a substep of length
//! h'. A collision leaves the momentum that it took, which has nothing to do with h, and does not come again: multiplied by
//! h'/h > 1 it would throw the bodies apart.
//!
//! Which of the two a contact has left is told by what the impulses of the last substep have done to its bodies. Where
//! bodies rest, slide or roll they make up for the forces, and change velocities by about as much as these do:
//!
//! ```text
//! |Σ λ/m| + |Σ r × λ/I| l  ≤  2 |a| h       a: acceleration by forces,  l: extent of the body
//! ```
//!
//! A body for which that does not hold is struck, and so is whatever it presses on, as a blow passes through what rests: of
//! a row that stands against a wall only the first one is moved by it. In longer substeps loads between struck bodies stay
//! what they are, and the sweeps let them grow. In shorter ones all of them shrink, as too small a start throws nothing.
//!
//! Runs only in a step whose substeps are not as long as those of the step before, on all contacts.

use crate::body::Bodies;
use crate::collision::{Contact, Contacts};
use crate::math::Vec2;
use crate::resolution::solver::{Acceleration, acceleration_of};
use crate::store::BitSet;

/// Contacts that change the velocity of a body by more than this many times what forces do are striking it, no unit. What
/// rests needs 1, and what toppled, rolled or slid was never seen to need 2; a blow of more than 8 cm/s is beyond it by
/// default.
const RESTING_KICKS: f32 = 2.0;

/// Rescales the impulses of contacts, with its buffers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rescaling {
    /// Slots of the bodies that were struck, or pressed on by one that was.
    struck: BitSet,
    /// Scratch: those of them whose neighbours are still to be looked at.
    passing_on: Vec<u32>,
}

impl Rescaling {
    /// Makes the impulses of all contacts, which are those of a substep of length `old_h`, s, into what to start one of length
    /// `new_h`, s, from.
    pub(crate) fn rescale(
        &mut self,
        contacts: &mut Contacts,
        bodies: &Bodies,
        acceleration: &impl Acceleration,
        [old_h, new_h]: [f32; 2],
    ) {
        let ratio = new_h / old_h;
        self.struck.clear();
        if ratio > 1.0 {
            self.find_struck(contacts, bodies, acceleration, old_h);
        }
        for contact in contacts.iter_mut() {
            if contact.slots.into_iter().any(|slot| self.struck.contains(slot)) {
                continue;
            }
            contact.rolling_moment *= ratio;
            for point in contact.manifold.points_mut() {
                point.scale_impulses(ratio);
            }
        }
    }

    /// Finds the bodies that were struck in a substep of length `h`, s, or pressed on by one that was.
    fn find_struck(
        &mut self,
        contacts: &Contacts,
        bodies: &Bodies,
        acceleration: &impl Acceleration,
        h: f32,
    ) {
        let Self { struck, passing_on } = self;
        for &slot in bodies.awake.iter().filter(|&&slot| bodies.is_dynamic(slot)) {
            let forced = acceleration_of(bodies, slot, acceleration).length();
            // Written so that NaN is struck.
            if !(gain(contacts, bodies, slot) <= RESTING_KICKS * forced * h) && struck.insert(slot) {
                passing_on.push(slot);
            }
        }
        while let Some(slot) = passing_on.pop() {
            for index in contacts.of_body(bodies, slot) {
                let contact = &contacts[index];
                let other = contact.other(slot);
                if contact.is_loaded() && bodies.is_dynamic(other) && struck.insert(other) {
                    passing_on.push(other);
                }
            }
        }
    }
}

/// By how much the impulses that its contacts keep change the velocity of any point of the body in `slot` at most, m/s.
fn gain(contacts: &Contacts, bodies: &Bodies, slot: u32) -> f32 {
    let motion = &bodies.motions[slot as usize];
    let (mut impulse, mut moment) = (Vec2::ZERO, 0.0);
    for index in contacts.of_body(bodies, slot) {
        let Contact { manifold, slots, .. } = &contacts[index];
        let is_b = slots[1] == slot;
        for point in manifold.points() {
            let on_b = manifold.impulse_on_b(point);
            let (own, anchor) = if is_b { (on_b, point.anchor_b) } else { (-on_b, point.anchor_a) };
            impulse += own;
            moment += anchor.cross(own);
        }
    }
    impulse.length() * motion.inverse_mass + moment.abs() * motion.inverse_inertia * motion.extent
}
