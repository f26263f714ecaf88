//! The end of the step: what it did to the contacts of a block, written back into them.

use crate::collision::Contact;
use crate::compute::{BodyState, Column, Columns, Lane, LaneVec2};
use crate::resolution::constraint::StepResidual;
use crate::resolution::contact_block::{ContactBlock, Marks};

/// What a step did to the contacts of a block.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct BlockEnd {
    /// Contacts under lasting load.
    pub(crate) lasting: Marks,
    /// Contacts that may have begun or ceased to touch.
    pub(crate) changing: Marks,
}

/// One of the points of sixteen contacts at the end of the step.
#[derive(Clone, Copy, Debug, Default)]
struct PointEnds {
    separation: Column,
    /// From the centres.
    anchor_a: LaneVec2<Column>,
    anchor_b: LaneVec2<Column>,
}

/// Sixteen contacts at the end of the step, and the worst of all that were looked at so far.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactEnds {
    points: [PointEnds; 2],
    /// Greatest k λ of the points, m/s.
    pub(crate) load: Column,
    /// By place, of all blocks so far: deepest overlap, m, and largest speed with which a touching point still approaches,
    /// m/s.
    penetration: Column,
    approach_speed: Column,
    /// Those with a point that touches or bears load.
    pub(crate) touching: Marks,
}

impl ContactEnds {
    /// What is left wrong of the contacts of all blocks so far.
    pub(crate) fn residual(&self) -> StepResidual {
        StepResidual {
            penetration: self.penetration.greatest(),
            approach_speed: self.approach_speed.greatest(),
        }
    }
}

impl ContactBlock {
    /// Finds where the contacts from `place` on, a multiple of the lane's width, are at the end of the step.
    #[inline(always)]
    pub(crate) fn end<L: Lane>(&self, place: usize, pair: &[BodyState<L>; 2], ends: &mut ContactEnds) {
        if self.fit.is_single {
            self.end_of::<L, 1>(place, pair, ends);
        } else {
            self.end_of::<L, 2>(place, pair, ends);
        }
    }

    #[inline(always)]
    fn end_of<L: Lane, const POINTS: usize>(
        &self,
        place: usize,
        [a, b]: &[BodyState<L>; 2],
        ends: &mut ContactEnds,
    ) {
        let zero = L::splat(0.0);
        let constraint = self.load::<L>(place);
        let mut penetration = L::load(&ends.penetration, place);
        let mut approach_speed = L::load(&ends.approach_speed, place);
        let (mut load, mut touching) = (zero, 0);
        for (index, end) in ends.points.iter_mut().enumerate().take(POINTS) {
            let point = &constraint.points[index];
            let is_there = point.normal_k.greater(zero);
            let separation = constraint.separation(point, a, b);
            separation.store(&mut end.separation, place);
            let [carried_a, carried_b] = constraint.carried(point, a, b);
            end.anchor_a.store(place, point.anchor_a + carried_a);
            end.anchor_b.store(place, point.anchor_b + carried_b);
            load = load.max(point.normal_k * point.normal_impulse);
            penetration = penetration.max(L::select(is_there, -separation, zero));
            let (is_apart, is_pressed) = (separation.greater(zero), point.normal_impulse.greater(zero));
            touching |= L::bits(is_there) & (!L::bits(is_apart) | L::bits(is_pressed));
            let approach = -constraint.normal.dot(point.relative_velocity(a, b));
            let mut left = L::select(is_there, L::select(is_apart, zero, approach), zero);
            if self.has_pending() {
                // What is pending is not to be stopped yet.
                left = L::select(self.pending[index].mask::<L>(place), zero, left);
            }
            approach_speed = approach_speed.max(left);
        }
        load.store(&mut ends.load, place);
        penetration.store(&mut ends.penetration, place);
        approach_speed.store(&mut ends.approach_speed, place);
        ends.touching.write::<L>(place, touching);
    }

    /// Writes impulses and separations back into a contact.
    #[inline(always)]
    pub(crate) fn finish(&self, place: usize, ends: &ContactEnds, contact: &mut Contact) {
        let follows = contact.follows;
        if follows {
            contact.manifold.normal = self.columns.normal.load::<f32>(place).into();
        }
        for (index, stored) in contact.manifold.points_mut().iter_mut().enumerate() {
            let (point, end) = (&self.columns.points[index], &ends.points[index]);
            // What follows is there already.
            let [anchor_a, anchor_b] =
                if follows { [&point.anchor_a, &point.anchor_b] } else { [&end.anchor_a, &end.anchor_b] };
            stored.anchor_a = anchor_a.load::<f32>(place).into();
            stored.anchor_b = anchor_b.load::<f32>(place).into();
            stored.separation = end.separation.get(place);
            stored.normal_impulse = point.normal_impulse.get(place);
            stored.tangent_impulse = self.columns.frictions[index].impulse.get(place);
        }
    }
}
