//! What a substep begins with: of the impulses of the last, what is load.

use crate::compute::{Lane, LaneVec2};
use crate::resolution::constraint::{Action, ContactConstraint};

/// What a point has borne in a substep is taken for its load in the next up to so many times the load before, no unit, and what
/// [`NEW_LOAD_ACCELERATION`] gives beside. More was a blow, which does not come again. With its impulse to begin from, what has fallen onto a body on
/// the ground would come back at up to a third of its speed: one sweep over the two contacts of the lower body does not take it back. With 4 it comes back
/// at up to a tenth, with 2 or 1.5 at a twentieth; the less, the longer the sweeps have to find a load that grows.
pub(crate) const LOAD_GROWTH: f32 = 2.0;

/// Where a point begins to bear, its load in the next substep is taken to be no more than what gives it this acceleration, m/s²: twelve times that of
/// the earth. With 300 what has fallen onto a body on the ground comes back at up to a tenth of its speed, with 1000 at a fifth; with 60 a heap of
/// stones of a centimetre does not come to rest.
pub(crate) const NEW_LOAD_ACCELERATION: f32 = 120.0;

impl<L: Lane> ContactConstraint<L> {
    /// Begins a substep: of the last impulses along the normal of the first `POINTS` points this `part` acts in each warm start, no unit, as far as it
    /// is load,
    ///
    /// ```text
    /// W = min(part λ, LOAD_GROWTH W₀ + new_load_speed/k)
    /// ```
    ///
    /// W₀ being what each did in the last substep. Friction begins with all of its last impulse: where that was cut as well, a third more of what is
    /// thrown at thin walls came to lie in them.
    #[inline(always)]
    pub(crate) fn begin_normal_impulses<const POINTS: usize>(&mut self, part: L, new_load_speed: L) {
        for (point, friction) in self.points.iter_mut().zip(&mut self.frictions).take(POINTS) {
            let last = point.normal_impulse * part;
            let grown = friction.warm_start * L::splat(LOAD_GROWTH);
            let was_blow = (point.normal_k * (last - grown)).greater(new_load_speed);
            point.normal_impulse = last;
            // Few were, and a division takes long.
            if L::bits(was_blow) != 0 {
                let load = grown + new_load_speed / point.normal_k;
                point.normal_impulse = L::select(was_blow, load, last);
            }
            friction.warm_start = point.normal_impulse;
        }
    }

    /// Lets the contacts go on as if they had borne nothing where the mask holds.
    #[inline(always)]
    pub(crate) fn forget_impulses_where(&mut self, mask: L::Mask) {
        let zero = L::splat(0.0);
        for (point, friction) in self.points.iter_mut().zip(&mut self.frictions) {
            point.normal_impulse = L::select(mask, zero, point.normal_impulse);
            friction.impulse = L::select(mask, zero, friction.impulse);
            friction.warm_start = L::select(mask, zero, friction.warm_start);
        }
    }

    /// Counts a second warm start as impulse along the normal of the first `POINTS` points.
    #[inline(always)]
    pub(crate) fn count_warm_start<const POINTS: usize>(&mut self) {
        for (point, friction) in self.points.iter_mut().zip(&self.frictions).take(POINTS) {
            point.normal_impulse = point.normal_impulse + friction.warm_start;
        }
    }

    /// What one of the warm starts of a substep does by the first `POINTS` points: along the tangent, this `part` of the
    /// impulse, no unit, which is 0 if `is_smooth`.
    #[inline(always)]
    pub(crate) fn warm_start<const POINTS: usize>(&self, part: L, is_smooth: bool) -> Action<L> {
        let tangent = if is_smooth { None } else { Some(self.normal.perp() * part) };
        let mut sum = self.warm_start_of(0, tangent);
        for index in 1..POINTS {
            sum = sum.and(self.warm_start_of(index, tangent));
        }
        sum
    }

    /// The same of one of the points.
    #[inline(always)]
    fn warm_start_of(&self, index: usize, tangent: Option<LaneVec2<L>>) -> Action<L> {
        let (point, friction) = (&self.points[index], &self.frictions[index]);
        let mut impulse = self.normal * friction.warm_start;
        if let Some(tangent) = tangent {
            impulse = impulse + tangent * friction.impulse;
        }
        Action::at(point, impulse)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What each warm start applies, N s, where a point with k = 4 1/kg bore `last` in the substep before, of which each warm start applied `before`.
    fn begun(last: f32, before: f32) -> f32 {
        let mut constraint = ContactConstraint::<f32>::default();
        constraint.points[0].normal_k = 4.0;
        constraint.points[0].normal_impulse = last;
        constraint.frictions[0].warm_start = before;
        constraint.begin_normal_impulses::<1>(0.5, 2.0);
        constraint.frictions[0].warm_start
    }

    /// Half of the last impulse, or twice what was before and 2 m/s over 4 1/kg. All numbers are powers of two: nothing is rounded.
    #[test]
    fn a_load_grows_to_twice_as_much_and_what_a_new_one_may_be() {
        for (last, before, expected) in [
            (1.0, 0.0, 0.5),
            (8.0, 0.0, 0.5),
            (8.0, 1.0, 2.5),
            (8.0, 4.0, 4.0),
            (4.0, 8.0, 2.0),
            (0.0, 8.0, 0.0),
        ] {
            assert_eq!(begun(last, before), expected, "{last} N s after {before}");
        }
    }

    #[test]
    fn a_point_that_is_not_there_begins_with_nothing() {
        let mut constraint = ContactConstraint::<f32>::default();
        constraint.begin_normal_impulses::<2>(0.5, 2.0);
        assert!(constraint.frictions.iter().all(|friction| friction.warm_start == 0.0));
    }
}
