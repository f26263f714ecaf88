//! Which contacts approach fast enough to bounce: one look at all of them per substep, in lanes.

use crate::body::Effort;
use crate::compute::{self, BodyState, COLUMN, Column, Job, Lane, Width};
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::constraint_graph::ConstraintGraph;

/// An approach slower than this many substeps' gain of speed, by forces or by the load of the contact, is no
/// impact: a body that rests gains half a substep's before its support is applied, and a bounce that slow would
/// be over within the substep.
pub(crate) const RESTING_SUBSTEPS: f32 = 2.0;

/// Speed of a point along the normal, m/s, and whether it approaches fast enough to bounce: faster than `threshold`,
/// m/s, and than the load makes up for.
#[inline(always)]
pub(crate) fn approach<L: Lane>(
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

/// The contacts that may bounce, by their number in the constraint graph.
#[derive(Clone, Debug, Default)]
pub(crate) struct Watched {
    /// Speed of approach from which each bounces, m/s; infinite for those that never do.
    thresholds: Vec<Column>,
    /// What the caller calls each.
    names: Vec<[u32; COLUMN]>,
}

impl Watched {
    pub(crate) fn clear(&mut self) {
        self.thresholds.clear();
        self.names.clear();
    }

    /// Watches the contact with a number in the constraint graph.
    pub(crate) fn add(&mut self, number: usize, threshold: f32, name: u32) {
        let (block, place) = (number / COLUMN, number % COLUMN);
        if block >= self.thresholds.len() {
            self.thresholds.resize(block + 1, Column::splat(f32::INFINITY));
            self.names.resize(block + 1, [u32::MAX; COLUMN]);
        }
        self.thresholds[block].set(place, threshold);
        self.names[block][place] = name;
    }

    /// Appends the names of those that approach fast enough to bounce to `found`.
    pub(crate) fn find(
        &self,
        (effort, width): (Effort, Width),
        graph: &ConstraintGraph,
        states: &[BodyState],
        found: &mut Vec<u32>,
    ) {
        compute::run(width, Find { watched: self, effort, graph, states, found });
    }
}

struct Find<'a> {
    watched: &'a Watched,
    effort: Effort,
    graph: &'a ConstraintGraph,
    states: &'a [BodyState],
    found: &'a mut Vec<u32>,
}

impl Job for Find<'_> {
    #[inline(always)]
    fn run<L: Lane>(self) {
        let Watched { thresholds, names } = self.watched;
        for ((block, thresholds), names) in self.graph.blocks(self.effort).zip(thresholds).zip(names) {
            for first in (0..COLUMN).step_by(L::WIDTH) {
                let threshold = L::load(thresholds, first);
                if L::bits(L::splat(f32::INFINITY).greater(threshold)) == 0 {
                    continue;
                }
                let constraint = block.load::<L>(first);
                let pair = block.gather_velocities(self.states, first);
                let (_, first_point) = approach(&constraint, 0, threshold, &pair);
                let mut bits = L::bits(first_point);
                if !block.fit().is_single {
                    let (_, second_point) = approach(&constraint, 1, threshold, &pair);
                    bits |= L::bits(second_point);
                }
                while bits != 0 {
                    self.found.push(names[first + bits.trailing_zeros() as usize]);
                    bits &= bits - 1;
                }
            }
        }
    }
}
