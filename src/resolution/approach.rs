//! Which contacts approach fast enough to bounce, and which of these may meet: one look at all of them per substep, in
//! lanes. What rests, or is still far apart, costs no more.

use crate::compute::{self, BodyState, COLUMN, Column, Job, Lane, LaneVec2, RowPairs, Width};
use crate::resolution::constraint::{ContactConstraint, OUT_OF_REACH};
use crate::resolution::constraint_graph::{BlockPlace, ConstraintGraph, place_in};
use crate::resolution::contact_block::{ContactBlock, Marks};
use crate::resolution::integrate::Kicks;
use crate::store::places_of;

/// An approach slower than this many substeps' gain of speed, by forces or by the load of the contact, is no
/// impact: a body that rests gains half a substep's before its support is applied, and a bounce that slow would
/// be over within the substep.
pub(crate) const RESTING_SUBSTEPS: f32 = 2.0;

/// Two bodies have met, and two points meet together, within this share of the way that the approach makes in a
/// substep, no unit: a box that lands flat is not to be tipped over by a rounding error.
pub(crate) const MEETING_TOLERANCE: f32 = 1e-3;

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

/// Those of the contacts of a block that may bounce.
#[derive(Clone, Copy, Debug)]
struct WatchedBlock {
    place: BlockPlace,
    bouncy: Marks,
    /// Whether the sweeps have been told to leave some of their points alone.
    is_waiting: bool,
}

/// The contacts that may bounce. Their numbers are in the order in which they are solved.
#[derive(Clone, Debug, Default)]
pub(crate) struct Watched {
    blocks: Vec<WatchedBlock>,
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
        self.blocks.push(WatchedBlock { place, bouncy, is_waiting: false });
        self.len += bouncy.count();
    }

    /// Calls `visit` with the number of each and its place in the constraint graph.
    pub(crate) fn for_each(&self, mut visit: impl FnMut(u32, (u32, u32))) {
        for (block_number, watched) in self.blocks.iter().enumerate() {
            watched.bouncy.for_each(|of_block| {
                visit(number_of(block_number, of_block), place_in(watched.place, of_block));
            });
        }
    }

    /// Where the contact with a number is in the constraint graph.
    pub(crate) fn graph_place(&self, number: u32) -> (u32, u32) {
        let number = number as usize;
        place_in(self.blocks[number / COLUMN].place, number % COLUMN)
    }

    /// Tells the sweeps which points of the contact with a number wait for an impact.
    pub(crate) fn set_waiting(&mut self, number: u32, waits: [bool; 2], graph: &mut ConstraintGraph) {
        let graph_place = self.graph_place(number);
        let is_waiting = &mut self.blocks[number as usize / COLUMN].is_waiting;
        *is_waiting |= waits[0] || waits[1];
        if *is_waiting {
            graph.set_awaits_impact(graph_place, awaits(waits));
        }
    }

    /// Tells the sweeps which points approach fast and are apart, and appends the numbers of the contacts that may meet
    /// within the substep to `due`.
    pub(crate) fn look(
        &mut self,
        width: Width,
        substep: Substep<'_>,
        graph: &mut ConstraintGraph,
        due: &mut Vec<u32>,
    ) {
        compute::run(width, Look { blocks: &mut self.blocks, substep, graph, due });
    }
}

/// What the sweeps see as added to the separations of points that wait for an impact or not, m.
fn awaits(waits: [bool; 2]) -> [f32; 2] {
    waits.map(|waits| if waits { OUT_OF_REACH } else { 0.0 })
}

/// The number of the contact at a place of one of the watched blocks.
fn number_of(block: usize, place: usize) -> u32 {
    (block * COLUMN + place) as u32
}

/// How bodies move in a substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Substep<'a> {
    pub(crate) states: &'a [BodyState],
    pub(crate) kicks: &'a Kicks,
    /// Its length, s.
    pub(crate) h: f32,
    /// Slowest approach that bounces, m/s.
    pub(crate) restitution_threshold: f32,
}

struct Look<'a> {
    blocks: &'a mut [WatchedBlock],
    substep: Substep<'a>,
    graph: &'a mut ConstraintGraph,
    due: &'a mut Vec<u32>,
}

impl Job for Look<'_> {
    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { blocks, substep, graph, due } = self;
        for (number, watched) in blocks.iter_mut().enumerate() {
            let (rows, block) = graph.block_at_mut(watched.place);
            if std::mem::take(&mut watched.is_waiting) {
                block.await_no_impact();
            }
            let (is_single, bouncy) = (block.fit().is_single, watched.bouncy);
            for (first, bouncy) in bouncy.lanes::<L>() {
                let found = if is_single {
                    substep.look::<L, 1>(rows, block, first, bouncy)
                } else {
                    substep.look::<L, 2>(rows, block, first, bouncy)
                };
                for place in places_of(found.waits[0] | found.waits[1]) {
                    let waits = found.waits.map(|bits| bits >> place & 1 != 0);
                    block.set_awaits_impact(first + place, awaits(waits));
                    watched.is_waiting = true;
                }
                due.extend(places_of(found.meets).map(|place| number_of(number, first + place)));
            }
        }
    }
}

/// Some of the contacts of a lane, as the bits of masks.
#[derive(Clone, Copy, Debug, Default)]
struct Found {
    /// By point: those where it is apart and approaches fast enough to bounce.
    waits: [u32; 2],
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
        let mut accelerations = LaneVec2::<Column>::default();
        for place in places_of(fast & bouncy) {
            let [a, b] = rows.get(first + place).map(|row| self.kicks.acceleration(row));
            accelerations.store::<f32>(first + place, (b - a).into());
        }
        let acceleration = constraint.normal.dot(accelerations.load::<L>(first)).abs();
        let threshold = threshold.max(acceleration * L::splat(RESTING_SUBSTEPS * self.h));
        let (zero, h, [a, b]) = (L::splat(0.0), L::splat(self.h), rows.gather::<L>(self.states, first));
        let mut found = Found::default();
        for index in 0..POINTS {
            let (speed, is_fast) = approach(&constraint, index, threshold, &pair);
            let separation = constraint.separation(&constraint.points[index], &a, &b);
            let is_fast = L::bits(is_fast) & bouncy;
            // No path of this speed and acceleration goes farther within the substep.
            let least = separation + (speed - acceleration * h) * h;
            found.waits[index] = is_fast & L::bits(separation.greater(zero));
            found.meets |= is_fast & !L::bits(least.greater(zero));
        }
        found
    }
}
