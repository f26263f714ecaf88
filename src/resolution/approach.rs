//! Which contacts approach fast enough to bounce: one look at all of them per substep, in lanes.

use crate::compute::{self, BodyState, COLUMN, Job, Lane, Width};
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::constraint_graph::{BlockPlace, ConstraintGraph, place_in};
use crate::resolution::contact_block::Marks;
use crate::store::places_of;

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
    /// Blocks with some, and which of their contacts may.
    blocks: Vec<(BlockPlace, Marks)>,
    len: usize,
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

    /// Watches the contacts of a block that may bounce. Blocks come in the order in which they are solved.
    pub(crate) fn watch(&mut self, place: BlockPlace, bouncy: Marks) {
        self.blocks.push((place, bouncy));
        self.len += bouncy.count();
    }

    /// Calls `visit` with the number of each and its place in the constraint graph.
    pub(crate) fn for_each(&self, mut visit: impl FnMut(u32, (u32, u32))) {
        for (block_number, &(place, bouncy)) in self.blocks.iter().enumerate() {
            bouncy.for_each(|of_block| visit(number_of(block_number, of_block), place_in(place, of_block)));
        }
    }

    /// Where the contact with a number is in the constraint graph.
    pub(crate) fn graph_place(&self, number: u32) -> (u32, u32) {
        let number = number as usize;
        place_in(self.blocks[number / COLUMN].0, number % COLUMN)
    }

    /// Appends the numbers of those that approach faster than `threshold`, m/s, and than their load makes up for, to `found`.
    pub(crate) fn find(
        &self,
        threshold: f32,
        (width, graph): (Width, &ConstraintGraph),
        states: &[BodyState],
        found: &mut Vec<u32>,
    ) {
        compute::run(width, Find { blocks: &self.blocks, threshold, graph, states, found });
    }
}

/// The number of the contact at a place of one of the watched blocks.
fn number_of(block: usize, place: usize) -> u32 {
    (block * COLUMN + place) as u32
}

struct Find<'a> {
    blocks: &'a [(BlockPlace, Marks)],
    threshold: f32,
    graph: &'a ConstraintGraph,
    states: &'a [BodyState],
    found: &'a mut Vec<u32>,
}

impl Job for Find<'_> {
    #[inline(always)]
    fn run<L: Lane>(self) {
        let threshold = L::splat(self.threshold);
        for (block_number, &(place, bouncy)) in self.blocks.iter().enumerate() {
            let (rows, block) = self.graph.block_at(place);
            bouncy.for_each_lane::<L>(|first, bouncy| {
                let constraint = block.load::<L>(first);
                let pair = rows.gather_velocities(self.states, first);
                let (_, first_point) = approach(&constraint, 0, threshold, &pair);
                let mut bits = L::bits(first_point);
                if !block.fit().is_single {
                    let (_, second_point) = approach(&constraint, 1, threshold, &pair);
                    bits |= L::bits(second_point);
                }
                self.found
                    .extend(places_of(bits & bouncy).map(|place| number_of(block_number, first + place)));
            });
        }
    }
}
