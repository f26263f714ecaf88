//! Which contacts approach fast enough to bounce, and which of these may meet: one look at all of them per substep, in
//! lanes. What rests, or is still far apart, costs no more.

use crate::compute::{BodyState, Column, Columns, Job, Lane, LaneVec2, RowPairs};
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::constraint_graph::{BlockIndex, ConstraintGraph, GraphIndex};
use crate::resolution::contact_block::ContactBlock;
use crate::resolution::integrate::Kicks;
use crate::store::places_of;

/// An approach slower than this many substeps' gain of speed, by forces or by the load of the contact, is no
/// impact: a body that rests gains half a substep's before its support is applied, and a bounce that slow would
/// be over within the substep.
const RESTING_SUBSTEPS: f32 = 2.0;

/// Slowest approach that bounces, m/s: the `setting`, or what support makes up for anyway under an `acceleration` along the
/// normal, m/s² and not negative, in a substep of length `h`, s.
#[inline(always)]
pub(super) fn bounce_threshold<L: Lane>(setting: f32, acceleration: L, h: f32) -> L {
    L::splat(setting).max(acceleration * L::splat(RESTING_SUBSTEPS * h))
}

/// Speed of a point along the normal, m/s, and whether it approaches fast enough to bounce: faster than `threshold`,
/// m/s, and than the load makes up for.
#[inline(always)]
pub(super) fn approach<L: Lane>(
    constraint: &ContactConstraint<L>,
    index: usize,
    threshold: L,
    [a, b]: &[BodyState<L>; 2],
) -> (L, L::Mask) {
    let point = &constraint.points[index];
    let speed = constraint.normal.dot(point.relative_velocity(a, b));
    let borne = L::splat(RESTING_SUBSTEPS) * point.normal_k * point.normal_impulse;
    let is_fast = L::both((-threshold).greater(speed), (-borne).greater(speed));
    (speed, L::both(is_fast, point.normal_k.greater(L::splat(0.0))))
}

/// How bodies move in a substep.
#[derive(Clone, Copy, Debug)]
pub(super) struct Substep<'a> {
    pub(super) states: &'a [BodyState],
    pub(super) kicks: &'a Kicks,
    /// Its length, s.
    pub(super) h: f32,
    /// Slowest approach that bounces, m/s.
    pub(super) restitution_threshold: f32,
}

/// Looks at the contacts of some blocks that may bounce: marks the points that approach fast and are apart as pending, and
/// no others, and appends the contacts that may meet within the substep to `due`.
pub(super) struct Look<'a> {
    pub(super) blocks: &'a [BlockIndex],
    pub(super) substep: Substep<'a>,
    pub(super) graph: &'a mut ConstraintGraph,
    pub(super) due: &'a mut Vec<GraphIndex>,
}

impl Job for Look<'_> {
    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { blocks, substep, graph, due } = self;
        for &at in blocks {
            let (rows, block) = graph.block_at_mut(at);
            block.clear_pending();
            for (first, bouncy) in block.marks.bouncy.lanes::<L>() {
                let found = if block.fit().is_single {
                    substep.look::<L, 1>(rows, block, first, bouncy)
                } else {
                    substep.look::<L, 2>(rows, block, first, bouncy)
                };
                for place in places_of(found.pending[0] | found.pending[1]) {
                    let is_pending = found.pending.map(|bits| bits >> place & 1 != 0);
                    block.set_pending(first + place, is_pending);
                }
                due.extend(places_of(found.meets).map(|place| at.contact(first + place)));
            }
        }
    }
}

/// Some of the contacts of a lane, as the bits of masks.
#[derive(Clone, Copy, Debug, Default)]
struct Found {
    /// By point: those where it is apart and approaches fast enough to bounce.
    pending: [u32; 2],
    /// Those that may meet in the substep.
    meets: u32,
}

impl Substep<'_> {
    /// Looks at the contacts of a block from the place `first` on that may bounce.
    #[inline(always)]
    fn look<L: Lane, const POINTS: usize>(
        &self,
        rows: &RowPairs,
        block: &ContactBlock,
        first: usize,
        bouncy: u32,
    ) -> Found {
        let constraint = block.load::<L>(first);
        let pair = rows.gather_velocities(self.states, first);
        let threshold = L::splat(self.restitution_threshold);
        let mut fast = 0;
        for index in 0..POINTS {
            fast |= L::bits(approach(&constraint, index, threshold, &pair).1);
        }
        if fast & bouncy == 0 {
            return Found::default();
        }
        let (mut of_centers, mut turns) = (LaneVec2::<Column>::default(), [Column::default(); 2]);
        for place in places_of(fast & bouncy) {
            let rows = rows.get(first + place);
            let [a, b] = rows.map(|row| self.kicks.acceleration(row));
            of_centers.store::<f32>(first + place, (b - a).into());
            for (turns, row) in turns.iter_mut().zip(rows) {
                turns.store::<f32>(first + place, self.kicks.angular_acceleration(row));
            }
        }
        let (of_centers, turns) = (of_centers.load::<L>(first), turns.map(|turn| turn.load::<L>(first)));
        let (zero, h, [a, b]) = (L::splat(0.0), L::splat(self.h), rows.gather::<L>(self.states, first));
        let mut found = Found::default();
        for index in 0..POINTS {
            let acceleration = constraint.acceleration_along_normal(index, of_centers, turns).abs();
            let threshold = bounce_threshold(self.restitution_threshold, acceleration, self.h);
            let (speed, is_fast) = approach(&constraint, index, threshold, &pair);
            let separation = constraint.separation(&constraint.points[index], &a, &b);
            let is_fast = L::bits(is_fast) & bouncy;
            // No path of this speed and acceleration goes farther within the substep.
            let least = separation + (speed - acceleration * h) * h;
            found.pending[index] = is_fast & L::bits(separation.greater(zero));
            found.meets |= is_fast & !L::bits(least.greater(zero));
        }
        found
    }
}
