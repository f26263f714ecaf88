//! Which contacts approach fast enough to bounce: one look at all of them per substep, in lanes.

use crate::compute::{self, BodyState, COLUMN, Column, Job, Lane, Width};
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::constraint_graph::{BlockPlace, ConstraintGraph};
use crate::resolution::contact_block::Marks;

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

/// The contacts that may bounce. Their numbers are in the order in which they are solved.
#[derive(Clone, Debug, Default)]
pub(crate) struct Watched {
    blocks: Vec<WatchedBlock>,
    len: usize,
}

/// The contacts of a block that may bounce.
#[derive(Clone, Debug)]
struct WatchedBlock {
    place: BlockPlace,
    /// Speed of approach from which each bounces, m/s; infinite for those that never do.
    thresholds: Column,
}

impl Watched {
    pub(crate) fn clear(&mut self) {
        self.blocks.clear();
        self.len = 0;
    }

    /// How many contacts there are.
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// Numbers are below this.
    pub(crate) fn end(&self) -> u32 {
        (self.blocks.len() * COLUMN) as u32
    }

    /// Watches the contacts of a block that may bounce, each from the `threshold` of its place on, m/s. Blocks come in the
    /// order in which they are solved.
    pub(crate) fn watch(&mut self, place: BlockPlace, bouncy: Marks, threshold: impl Fn(usize) -> f32) {
        let mut thresholds = Column::splat(f32::INFINITY);
        bouncy.for_each(|place| {
            thresholds.set(place, threshold(place));
            self.len += 1;
        });
        self.blocks.push(WatchedBlock { place, thresholds });
    }

    /// Numbers and places in the constraint graph of all.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (u32, (u32, u32))> + Clone {
        (0..self.end())
            .filter(|&number| self.threshold(number) < f32::INFINITY)
            .map(|number| (number, self.graph_place(number)))
    }

    /// Where the contact with a number is in the constraint graph.
    pub(crate) fn graph_place(&self, number: u32) -> (u32, u32) {
        let (colour, block) = self.block_of(number).place;
        (colour, block as u32 * COLUMN as u32 + number % COLUMN as u32)
    }

    /// Speed of approach from which the contact with a number bounces, m/s.
    pub(crate) fn threshold(&self, number: u32) -> f32 {
        self.block_of(number).thresholds.get(number as usize % COLUMN)
    }

    fn block_of(&self, number: u32) -> &WatchedBlock {
        &self.blocks[number as usize / COLUMN]
    }

    /// Appends the numbers of those that approach fast enough to bounce to `found`.
    pub(crate) fn find(
        &self,
        width: Width,
        graph: &ConstraintGraph,
        states: &[BodyState],
        found: &mut Vec<u32>,
    ) {
        compute::run(width, Find { watched: self, graph, states, found });
    }
}

struct Find<'a> {
    watched: &'a Watched,
    graph: &'a ConstraintGraph,
    states: &'a [BodyState],
    found: &'a mut Vec<u32>,
}

impl Job for Find<'_> {
    #[inline(always)]
    fn run<L: Lane>(self) {
        for (number, &WatchedBlock { place, ref thresholds, .. }) in self.watched.blocks.iter().enumerate() {
            let block = self.graph.block_at(place);
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
                    let place = first + bits.trailing_zeros() as usize;
                    self.found.push((number * COLUMN + place) as u32);
                    bits &= bits - 1;
                }
            }
        }
    }
}
