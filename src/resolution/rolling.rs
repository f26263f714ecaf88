//! Rolling resistance: what is lost where a circle rolls on something, as a moment against its spin.
//!
//! For the spin w of b against a, the moments of inertia I, and the impulse λ along the normal in a substep:
//!
//! ```text
//! constraint   w = 0,   effective mass 1/k, k = 1/I_a + 1/I_b
//! moment       |Λ| ≤ 3/2 c r λ,   so that a disc, which takes (m + I/r²) a = 3/2 m a = Λ/(r h), is slowed down by c λ/(m h)
//! ```
//!
//! As friction does, it makes up for what would turn the circle as far as it goes, and no further: the spin is not turned
//! round. It begins with what it was in the last substep, half before and half after the move, so that a disc on a slope
//! comes to rest, and discs in a heap do not tremble. After the move it is solved before the sweep, whose friction answers it,
//! and once more after the sweep, with the load that the sweep has found.
//!
//! Runs four times per substep on the contacts of bodies with rolling resistance that have a circle. Nothing where there is none.
//! In what is solved directly it is a row like others.

use crate::body::Bodies;
use crate::collision::{Contact, Contacts};
use crate::compute::BodyState;
use crate::resolution::constraint_graph::{ConstraintGraph, GraphIndex};
use crate::resolution::kernel::WarmStartTime;

/// How much harder than a moment c r N the same deceleration is for a disc that turns as well as moves, no unit: 1 + I/(m r²).
const OF_A_DISC: f32 = 1.5;

/// A contact on which something rolls.
#[derive(Clone, Copy, Debug)]
struct RollingContact {
    contact: u32,
    home: GraphIndex,
    rows: [u32; 2],
    /// 1/(kg m²); 0 of what cannot be turned.
    inverse_inertias: [f32; 2],
    /// Greatest moment per impulse along the normal, m.
    arm: f32,
    /// Moment in the last substep, and what of that of this substep has acted, N m s, on b.
    moment: f32,
    acted: f32,
}

/// Greatest moment of rolling resistance per impulse along the normal of a contact, m; `None` where there is none.
pub(super) fn rolling_arm(bodies: &Bodies, contact: &Contact) -> Option<f32> {
    let coefficients = contact.colliders.map(|slot| bodies.roles.of(slot).rolling_resistance);
    let motions = contact.colliders.map(|slot| &bodies.motions[slot as usize]);
    let radii = motions.into_iter().filter(|motion| motion.is_round).map(|motion| motion.extent);
    let arm = OF_A_DISC * coefficients[0].max(coefficients[1]) * radii.reduce(f32::min)?;
    let can_turn = motions.iter().any(|motion| motion.inverse_inertia > 0.0);
    (arm > 0.0 && can_turn).then_some(arm)
}

/// The stage and its buffer.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rolling {
    contacts: Vec<RollingContact>,
}

impl Rolling {
    /// Takes up the contacts of the bodies with rolling resistance that have a circle and points.
    pub(crate) fn prepare(&mut self, bodies: &Bodies, contacts: &Contacts, graph: &ConstraintGraph) {
        self.contacts.clear();
        for &slot in bodies.roles.rolling() {
            for index in contacts.of_body(bodies, bodies.body_of(slot)) {
                let (contact, Some(home)) = (&contacts[index], graph.home(index)) else { continue };
                // A contact of two such shapes is in the lists of both, and in the list of a body are those of its other shapes.
                let is_of_both = slot == contact.colliders[1]
                    && bodies.roles.of(contact.colliders[0]).rolling_resistance > 0.0;
                if home.is_solved_directly() || is_of_both || !contact.colliders.contains(&slot) {
                    continue;
                }
                let Some(arm) = rolling_arm(bodies, contact) else { continue };
                let motions = contact.colliders.map(|slot| &bodies.motions[slot as usize]);
                self.contacts.push(RollingContact {
                    contact: index,
                    home,
                    rows: motions.map(|motion| motion.row),
                    inverse_inertias: motions.map(|motion| motion.inverse_inertia),
                    arm,
                    moment: contact.rolling_moment,
                    acted: 0.0,
                });
            }
        }
    }

    /// One of the warm starts of a substep: a `part` of what acted in the last one, no unit, as far as that goes which it applies along the
    /// normal.
    pub(crate) fn start(
        &mut self,
        time: WarmStartTime,
        part: f32,
        graph: &ConstraintGraph,
        states: &mut [BodyState],
    ) {
        for contact in &mut self.contacts {
            let applied = graph.constraint(contact.home).frictions.map(|friction| friction.warm_start);
            let greatest = contact.limit(applied);
            let moment = (part * contact.moment).clamp(-greatest, greatest);
            contact.turn(moment, states);
            let before = if time == WarmStartTime::BeforeMove { 0.0 } else { contact.acted };
            contact.acted = before + moment;
        }
    }

    /// After the move: what stops the spin, as far as the load goes.
    pub(crate) fn solve(&mut self, graph: &ConstraintGraph, states: &mut [BodyState]) {
        for contact in &mut self.contacts {
            let load = graph.constraint(contact.home).points.map(|point| point.normal_impulse);
            let greatest = contact.limit(load);
            contact.moment = (contact.acted + contact.stopping(states)).clamp(-greatest, greatest);
            contact.turn(contact.moment - contact.acted, states);
            contact.acted = contact.moment;
        }
    }

    /// Writes the moments back into the contacts.
    pub(crate) fn finish(&self, contacts: &mut Contacts) {
        for &RollingContact { contact, moment, .. } in &self.contacts {
            contacts[contact].rolling_moment = moment;
        }
    }
}

impl RollingContact {
    /// Greatest moment under these impulses along the normal, N s, of both points, N m s.
    fn limit(&self, [first, second]: [f32; 2]) -> f32 {
        self.arm * (first + second)
    }

    /// The moment on b that stops its spin against a, N m s.
    fn stopping(&self, states: &[BodyState]) -> f32 {
        let [a, b] = self.rows.map(|row| states[row as usize].angular_velocity);
        (a - b) / (self.inverse_inertias[0] + self.inverse_inertias[1])
    }

    /// Turns b by a moment, N m s, and a by the opposite.
    fn turn(&self, moment: f32, states: &mut [BodyState]) {
        for (side, sign) in [-1.0, 1.0].into_iter().enumerate() {
            // The ground stays as it is.
            if self.inverse_inertias[side] > 0.0 {
                states[self.rows[side] as usize].angular_velocity +=
                    sign * self.inverse_inertias[side] * moment;
            }
        }
    }
}
