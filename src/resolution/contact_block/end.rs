//! The end of the step: what it did to the contacts of a block, written back into them.

use crate::collision::Contact;
use crate::compute::{BodyState, Column, Columns, Lane, LaneVec2};
use crate::resolution::constraint::StepResidual;
use crate::resolution::contact_block::{ContactBlock, Marks};
use crate::resolution::softness::{lasting_after, yields_in_full};

/// What is left wrong of the contacts of all blocks so far, by place; and what the last of them bear.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Residuals {
    /// Deepest overlap, m.
    penetration: Column,
    /// Largest speed with which a touching point still approaches, m/s.
    approach_speed: Column,
    /// Of the last block: greatest k λ of the points, m/s.
    pub(crate) load: Column,
    /// Of the last block: those with a point that touches or bears load.
    pub(crate) touching: Marks,
}

impl Residuals {
    /// What is left wrong of the contacts of all blocks so far.
    pub(crate) fn greatest(&self) -> StepResidual {
        StepResidual {
            penetration: self.penetration.greatest(),
            approach_speed: self.approach_speed.greatest(),
        }
    }
}

impl ContactBlock {
    /// Finds where the contacts from `place` on, a multiple of the lane's width, are at the end of the step: what is moving
    /// there is so already, the others are carried along.
    #[inline(always)]
    pub(crate) fn end<L: Lane>(&mut self, place: usize, pair: &[BodyState<L>; 2], residuals: &mut Residuals) {
        if self.fit.is_single {
            self.end_of::<L, 1>(place, pair, residuals);
        } else {
            self.end_of::<L, 2>(place, pair, residuals);
        }
    }

    #[inline(always)]
    fn end_of<L: Lane, const POINTS: usize>(
        &mut self,
        place: usize,
        [a, b]: &[BodyState<L>; 2],
        residuals: &mut Residuals,
    ) {
        let zero = L::splat(0.0);
        let constraint = self.load::<L>(place);
        let mut penetration = residuals.penetration.load::<L>(place);
        let mut approach_speed = residuals.approach_speed.load::<L>(place);
        let (mut load, mut touching) = (zero, 0);
        for index in 0..POINTS {
            let point = &constraint.points[index];
            let is_there = point.normal_k.greater(zero);
            let separation = constraint.separation(point, a, b);
            let mut anchors = constraint.carried(point, a, b);
            let moving = self.marks.moving_within_step();
            if moving.any() {
                let moving = moving.mask::<L>(place);
                let there = [point.anchor_a, point.anchor_b];
                anchors = [0, 1].map(|side| LaneVec2::select(moving, there[side], anchors[side]));
            }
            let to = &mut self.columns.points[index];
            to.separation.store::<L>(place, separation);
            to.anchor_a.store::<L>(place, anchors[0]);
            to.anchor_b.store::<L>(place, anchors[1]);
            load = load.max(point.normal_k * point.normal_impulse);
            // Zero less a zero is 0, never -0; and what is not a number is not greater than anything.
            penetration = L::select(is_there, zero - separation, zero).max(penetration);
            let (is_apart, is_pressed) = (separation.greater(zero), point.normal_impulse.greater(zero));
            touching |= L::bits(is_there) & (!L::bits(is_apart) | L::bits(is_pressed));
            let approach = zero - constraint.normal.dot(point.relative_velocity(a, b));
            let mut left = L::select(is_there, L::select(is_apart, zero, approach), zero);
            if self.has_pending() {
                // What is pending is not to be stopped yet.
                left = L::select(self.marks.pending[index].mask::<L>(place), zero, left);
            }
            approach_speed = left.max(approach_speed);
        }
        residuals.load.store::<L>(place, load);
        residuals.penetration.store::<L>(place, penetration);
        residuals.approach_speed.store::<L>(place, approach_speed);
        residuals.touching.write::<L>(place, touching);
    }

    /// Writes the end of a step of length `dt`, s, back into a contact; the greatest k λ of its points is `load`, m/s.
    #[inline(always)]
    pub(crate) fn write_back(&self, place: usize, contact: &mut Contact, load: f32, dt: f32) {
        // Half of the impulses act before the move, where contacts yield.
        const HALF: f32 = 0.5;
        // Nearly all do, so that a point is asked only where one of the two may not.
        let yields_in_full = yields_in_full(HALF * load);
        contact.manifold.normal = self.columns.normal.load::<f32>(place).to_vec2();
        contact.rolling_moment = self.rolling::<f32>(place).map_or(0.0, |rolling| rolling.moment);
        for (index, stored) in contact.manifold.points_mut().iter_mut().enumerate() {
            let point = &self.columns.points[index];
            stored.anchor_a = point.anchor_a.load::<f32>(place).to_vec2();
            stored.anchor_b = point.anchor_b.load::<f32>(place).to_vec2();
            stored.separation = point.separation.get(place);
            let friction = &self.columns.frictions[index];
            let warm_start = friction.warm_start.get(place);
            stored.set_normal_impulse(point.normal_impulse.get(place), warm_start);
            stored.tangent_impulse = friction.impulse.get(place);
            stored.lasting_impulse = if yields_in_full {
                0.0
            } else {
                // What is more than the warm start may be a blow.
                let impulse = (HALF * stored.normal_impulse).min(warm_start);
                lasting_after(stored.lasting_impulse, [point.normal_k.get(place), impulse], dt)
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{ContactBlock, Residuals};
    use crate::compute::{BodyState, F32x4, Lane};
    use crate::resolution::contact_block::Fit;

    /// What is left wrong of a point at a distance of `separation`, m, between bodies that move with `velocities`, m/s.
    fn left_wrong<L: Lane>(is_single: bool, separation: f32, velocities: [f32; 2]) -> [f32; 2] {
        let mut block = ContactBlock { fit: Fit { is_single, ..Fit::default() }, ..ContactBlock::default() };
        block.columns.points[0].normal_k.set(0, 1.0);
        block.columns.points[0].separation.set(0, separation);
        block.columns.normal.x.set(0, 1.0);
        let state = |velocity| {
            let mut state = BodyState::<L>::at_rest();
            state.velocity.x = L::splat(velocity);
            state
        };
        let mut residuals = Residuals::default();
        block.end(0, &velocities.map(state), &mut residuals);
        let greatest = residuals.greatest();
        [greatest.penetration, greatest.approach_speed]
    }

    /// Which of two zeros is the greater is not said anywhere: processors differ.
    #[test]
    fn what_is_not_wrong_is_zero_without_a_sign() {
        for (is_single, separation) in [(true, 0.0), (true, -0.0), (false, 0.0), (false, -0.0)] {
            for velocities in [[0.0, 0.0], [-0.0, 0.0], [0.0, -0.0], [3.0, 3.0]] {
                for left in [left_wrong::<f32>, left_wrong::<F32x4>] {
                    let left = left(is_single, separation, velocities).map(f32::to_bits);
                    assert_eq!(left, [0, 0], "{separation:?} m, {velocities:?} m/s");
                }
            }
        }
    }

    /// What is not a number would reach the next contact at its place in the block, and no other.
    #[test]
    fn what_is_not_a_number_is_passed_over() {
        for is_single in [true, false] {
            assert_eq!(left_wrong::<f32>(is_single, f32::NAN, [f32::NAN, 0.0]), [0.0, 0.0]);
            assert_eq!(left_wrong::<F32x4>(is_single, -0.25, [2.0, 0.5]), [0.25, 1.5]);
        }
    }
}
