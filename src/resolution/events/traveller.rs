//! Travellers: bodies that are swept along their ways within a substep.

use crate::compute::BodyState;
use crate::math::{Rot, Vec2};
use crate::resolution::integrate::{Kicks, drift};

/// A body that is swept in this substep.
#[derive(Clone, Copy, Debug)]
pub(super) struct Traveller {
    pub(super) row: u32,
    pub(super) slot: u32,
    /// Its box in the tree of ways.
    pub(super) leaf: u32,
    /// Its way is straight from this time of the substep on, s; or it was stopped then.
    pub(super) from: f32,
    /// Where it was stopped, if it was.
    pub(super) halted: Option<BodyState>,
    /// How often its way has changed.
    pub(super) version: u32,
    /// How often in a row it was struck at short intervals.
    pub(super) quick_strikes: u32,
}

impl Traveller {
    /// The body in a row, with this slot, whose way is straight from a time on, s.
    pub(super) fn new(row: u32, slot: u32, from: f32) -> Self {
        Self { row, slot, leaf: 0, from, halted: None, version: 1, quick_strikes: 0 }
    }

    /// Lets the move of a substep of length `h`, s, take the body to where it was stopped, if it was. Forces have acted on it for the
    /// whole substep: what they gave it since is taken out of its velocity again, as far as it is still in there, as the body would be
    /// faster and no lower.
    pub(super) fn stop(&self, h: f32, kicks: &Kicks, state: &mut BodyState) {
        let Some(there) = self.halted else { return };
        let lost = h - self.from;
        let (velocity, gained) = (state.velocity.to_vec2(), kicks.acceleration(self.row) * lost);
        let velocity = velocity - gained * share_left(velocity.dot(gained), gained.length_squared());
        let (spin, gained) = (state.angular_velocity, kicks.angular_acceleration(self.row) * lost);
        let spin = spin - gained * share_left(spin * gained, gained * gained);
        *state = BodyState { velocity: velocity.into(), angular_velocity: spin, ..there };
        drift(state, -h);
    }
}

/// Which share of what a velocity has gained is still in it, from the product of the two and the square of the gain: all, unless contacts
/// hold the body against the force.
fn share_left(product: f32, gain_squared: f32) -> f32 {
    if gain_squared > 0.0 { (product / gain_squared).clamp(0.0, 1.0) } else { 0.0 }
}

/// An arm, m, of a body that has turned within the step.
pub(super) fn arm_in(arm: Vec2, state: &BodyState) -> Vec2 {
    Rot { c: state.delta_rotation.c, s: state.delta_rotation.s }.rotate(arm)
}

/// Whether a point that starts at `offset` and moves by `motion`, m, comes within a distance of `reach`, m, of the origin.
pub(super) fn circles_meet(offset: Vec2, motion: Vec2, reach: f32) -> bool {
    let (along, length_squared) = (-offset.dot(motion), motion.length_squared());
    let nearest = if along <= 0.0 || length_squared == 0.0 {
        offset
    } else {
        offset + motion * (along / length_squared).min(1.0)
    };
    // The rounding of numbers as large as these.
    let noise = 8.0 * f32::EPSILON * (offset.norm_1() + motion.norm_1());
    let reach = reach + noise;
    nearest.length_squared() <= reach * reach
}
