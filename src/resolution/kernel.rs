//! The contact kernel: warm start, solve, relax. One text for every lane width.
//!
//! This is where a step spends its time: per substep each contact is warm started twice and swept twice.

use crate::compute::{BodyState, Lane, LaneVec2, PairStates};
#[cfg(feature = "report")]
use crate::compute::{Count, Counted, PairBlocks, count};
use crate::resolution::axis::Axis;
use crate::resolution::block::{Row, solve_pair};
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::contact_block::{ContactBlock, Fit};
use crate::resolution::softness::{bias, gap_bias, one_and_compliance};

/// Something that is done to contacts, as many at a time as a lane holds: those of `block` from `place` on, and the states
/// of their bodies. Several threads do it to contacts of one colour, which move no body in common. It is to be
/// `#[inline(always)]`, see [`Job`](crate::compute::Job).
pub(crate) trait Kernel: Clone + Sync {
    fn run<L: Lane>(&self, block: &mut ContactBlock, states: &mut PairStates<'_>, place: usize);
}

/// What kernels leave out for a block. Not all that they could: each case makes programs larger and longer to build.
/// One contact at a time is for the few that do not fit into lanes, where they would save little.
#[inline(always)]
fn fit<L: Lane>(block: &ContactBlock) -> Fit {
    if L::WIDTH > 1 { block.fit() } else { Fit::default() }
}

/// Applies the impulses of the last substep before anything is solved: where the kick is split, half of them before
/// the bodies move and half after it, each with the geometry of its moment.
///
/// There is one accumulator for the whole substep. Along the normal, the second half is of the impulse that the substep
/// began with, not of what the sweep before the move has made of it: with the biased impulse applied again, the push
/// out of an overlap would be counted as load and pump energy into the scene. Along the tangent nothing has changed in
/// between, as friction is solved after the move.
#[derive(Clone, Debug)]
pub(crate) struct WarmStart {
    /// Share of the last impulses, no unit: a half, or all where the kick is not split.
    pub(crate) part: f32,
    pub(crate) time: WarmStartTime,
    /// Whether what no contact of a block needs is left out.
    pub(crate) is_fitted: bool,
}

/// Which of the warm starts of a substep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WarmStartTime {
    BeforeMove,
    AfterMove,
}

impl Kernel for WarmStart {
    #[inline(always)]
    fn run<L: Lane>(&self, block: &mut ContactBlock, states: &mut PairStates<'_>, place: usize) {
        let Fit { is_single, is_smooth, is_still } = fit::<L>(block);
        match (self.is_fitted && is_single, self.is_fitted && is_still, self.is_fitted && is_smooth) {
            (true, _, true) => self.start::<L, 1>(block, states, place, [true, false]),
            (true, _, false) => self.start::<L, 1>(block, states, place, [false, false]),
            (false, true, true) => self.start::<L, 2>(block, states, place, [true, true]),
            (false, true, false) => self.start::<L, 2>(block, states, place, [false, true]),
            (false, false, _) => self.start::<L, 2>(block, states, place, [false, false]),
        }
    }
}

impl WarmStart {
    #[inline(always)]
    fn start<L: Lane, const POINTS: usize>(
        &self,
        block: &mut ContactBlock,
        states: &mut PairStates<'_>,
        place: usize,
        [is_smooth, is_still]: [bool; 2],
    ) {
        let mut constraint = ContactConstraint { is_still, ..block.load::<L>(place) };
        let part = L::splat(self.part);
        match self.time {
            WarmStartTime::BeforeMove => {
                constraint.begin_normal_impulses::<POINTS>(part);
                block.store_warm_starts::<L, POINTS>(place, &constraint);
            }
            WarmStartTime::AfterMove => constraint.count_warm_start::<POINTS>(),
        }
        block.store_normal_impulses::<L, POINTS>(place, &constraint);
        let [mut a, mut b] = states.gather_velocities(place);
        constraint.apply(constraint.warm_start::<POINTS>(part, is_smooth), &mut a, &mut b);
        states.scatter_velocities(place, &[a, b]);
    }
}

/// Has a substep begin without the impulses of the last one.
#[derive(Clone, Debug)]
pub(crate) struct ForgetImpulses;

impl Kernel for ForgetImpulses {
    #[inline(always)]
    fn run<L: Lane>(&self, block: &mut ContactBlock, _: &mut PairStates<'_>, place: usize) {
        let mut constraint = block.load::<L>(place);
        for (point, friction) in constraint.points.iter_mut().zip(&mut constraint.frictions) {
            (point.normal_impulse, friction.impulse) = (L::splat(0.0), L::splat(0.0));
        }
        block.store_normal_impulses::<L, 2>(place, &constraint);
        block.store_friction_impulses::<L, 2>(place, &constraint);
    }
}

/// What a sweep does, beside stopping the approach.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Sweep {
    /// Pushes overlapping bodies apart and lets contacts yield: the sweep before the bodies move.
    pub(crate) biased: bool,
    /// Solves friction after the normals.
    pub(crate) friction: bool,
    /// Solves the two points of a contact together.
    pub(crate) block: bool,
}

impl Sweep {
    /// The sweep before the bodies move, by default.
    const MAIN: Self = Self { biased: true, friction: false, block: true };
    /// The sweep after it, by default.
    const RELAX: Self = Self { biased: false, friction: true, block: true };
    /// The same over contacts without friction.
    const SMOOTH_RELAX: Self = Self { friction: false, ..Self::RELAX };
}

/// A contact of two points and with friction that begins to bear load is solved so many times more: without impulses
/// to start from, once lets friction turn the body instead of stopping it, and a box set on a slope keeps 7 mm/s
/// too much for as long as it slides. Twice leave a tenth of that, four times nothing.
const COLD_SWEEPS: u32 = 4;

/// One sweep over contacts: normals, then friction.
#[derive(Clone, Debug)]
pub(crate) struct SweepOver {
    pub(crate) kind: Sweep,
    /// Whether bodies have moved since separations were found.
    pub(crate) have_moved: bool,
    /// One over the length of the substep, 1/s.
    pub(crate) per_substep: f32,
    /// Whether what no contact of a block needs is left out.
    pub(crate) is_fitted: bool,
    /// Whether there is a warm start after the move, which cold contacts can count on.
    pub(crate) starts_again: bool,
}

impl Kernel for SweepOver {
    /// Asks for the kind, and for what the contacts need, once per block, so that what is compiled for the default
    /// kinds has no branches, which keeps numbers in registers, and reads nothing that no contact has.
    #[inline(always)]
    fn run<L: Lane>(&self, block: &mut ContactBlock, states: &mut PairStates<'_>, place: usize) {
        let is_usual = (self.kind == Sweep::MAIN || self.kind == Sweep::RELAX) && !block.has_pending();
        let Fit { is_single, is_still, .. } = fit::<L>(block);
        match (self.is_fitted && is_usual, is_single, is_still) {
            (true, true, _) => self.sweep_usual::<L, 1>(block, states, place, false),
            (true, false, true) => self.sweep_usual::<L, 2>(block, states, place, true),
            (true, false, false) => self.sweep_usual::<L, 2>(block, states, place, false),
            (false, ..) => self.sweep::<L, 2, true>(block, states, place, self.kind, false),
        }
        if self.starts_again && block.has_cold_contacts() {
            self.solve_cold_contacts::<L>(block, states, place);
        }
    }
}

impl SweepOver {
    /// The sweeps of the default.
    #[inline(always)]
    fn sweep_usual<L: Lane, const POINTS: usize>(
        &self,
        block: &mut ContactBlock,
        states: &mut PairStates<'_>,
        place: usize,
        is_still: bool,
    ) {
        match (self.kind, fit::<L>(block).is_smooth) {
            (Sweep::RELAX, true) => {
                self.sweep::<L, POINTS, false>(block, states, place, Sweep::SMOOTH_RELAX, is_still);
            }
            (Sweep::RELAX, false) => {
                self.sweep::<L, POINTS, false>(block, states, place, Sweep::RELAX, is_still);
            }
            _ => self.sweep::<L, POINTS, false>(block, states, place, Sweep::MAIN, is_still),
        }
    }

    #[inline(always)]
    fn sweep<L: Lane, const POINTS: usize, const MAY_BE_PENDING: bool>(
        &self,
        block: &mut ContactBlock,
        states: &mut PairStates<'_>,
        place: usize,
        kind: Sweep,
        is_still: bool,
    ) {
        if self.have_moved {
            find_separations::<L, POINTS>(block, states, place, is_still);
        }
        let mut pair = states.gather_velocities(place);
        self.solve::<L, POINTS, MAY_BE_PENDING>(block, place, kind, is_still, &mut pair);
        states.scatter_velocities(place, &pair);
    }

    /// Solves contacts once: normals, then friction.
    #[inline(always)]
    fn solve<L: Lane, const POINTS: usize, const MAY_BE_PENDING: bool>(
        &self,
        block: &mut ContactBlock,
        place: usize,
        kind: Sweep,
        is_still: bool,
        pair: &mut [BodyState<L>; 2],
    ) {
        let mut impulse = self.solve_normals::<L, POINTS, MAY_BE_PENDING>(block, place, kind, is_still, pair);
        if kind.friction {
            // The push along the normal, which is still to come, is across to the tangent.
            impulse = impulse + solve_frictions::<L, POINTS>(block, place, is_still, pair);
        }
        let [a, b] = pair;
        block.load::<L>(place).push(impulse, a, b);
    }

    /// Solves those that begin to bear load a few times more, and with friction before the move too: there are no impulses to
    /// start them from, and a box set on a slope would go down freely for half a substep.
    #[inline(always)]
    fn solve_cold_contacts<L: Lane>(
        &self,
        block: &mut ContactBlock,
        states: &mut PairStates<'_>,
        place: usize,
    ) {
        let is_cold = block.cold_and_loaded::<L>(place);
        if L::bits(is_cold) == 0 {
            return;
        }
        let (before, before_pair) = (block.load::<L>(place), states.gather_velocities(place));
        let mut pair = before_pair;
        for _ in 0..COLD_SWEEPS {
            let kind = Sweep { friction: true, ..self.kind };
            self.solve::<L, 2, true>(block, place, kind, false, &mut pair);
        }
        let mut after = block.load::<L>(place);
        for index in 0..2 {
            let (point, friction) = (&mut after.points[index], &mut after.frictions[index]);
            let before_impulse = before.points[index].normal_impulse;
            point.normal_impulse = L::select(is_cold, point.normal_impulse, before_impulse);
            if !self.kind.friction {
                // The warm start after the move does as much again.
                friction.impulse = friction.impulse + friction.impulse;
            }
            friction.impulse = L::select(is_cold, friction.impulse, before.frictions[index].impulse);
        }
        block.store_normal_impulses::<L, 2>(place, &after);
        block.store_friction_impulses::<L, 2>(place, &after);
        for (state, before) in pair.iter_mut().zip(&before_pair) {
            *state = BodyState::select(is_cold, state, before);
        }
        states.scatter_velocities(place, &pair);
    }

    /// Turns the bodies; returns the impulse that is still to push them, N s.
    #[inline(always)]
    fn solve_normals<L: Lane, const POINTS: usize, const MAY_BE_PENDING: bool>(
        &self,
        block: &mut ContactBlock,
        place: usize,
        kind: Sweep,
        is_still: bool,
        [a, b]: &mut [BodyState<L>; 2],
    ) -> LaneVec2<L> {
        let constraint = if MAY_BE_PENDING { block.load_active(place) } else { block.load(place) };
        let mut constraint = ContactConstraint { is_still, ..constraint };
        let axis = Axis::<L, POINTS>::new(&constraint, constraint.normal);
        let speeds = axis.speeds(&constraint, a, b);
        let mut changes = [L::splat(0.0); POINTS];
        if kind.block && POINTS == 2 {
            changes = solve_normals_together(&mut constraint, speeds, kind.biased, self.per_substep);
        } else {
            for index in 0..POINTS {
                let vn = axis.speed_after(index, speeds, &constraint, changes);
                changes[index] = solve_normal(&mut constraint, index, vn, kind.biased, self.per_substep);
            }
        }
        axis.turn(&constraint, changes, a, b);
        block.store_normal_impulses::<L, POINTS>(place, &constraint);
        axis.sum(changes)
    }
}

/// Finds how far the points are apart where the bodies are now. It is so until they move again.
#[inline(always)]
fn find_separations<L: Lane, const POINTS: usize>(
    block: &mut ContactBlock,
    states: &PairStates<'_>,
    place: usize,
    is_still: bool,
) {
    let mut constraint = ContactConstraint { is_still, ..block.load::<L>(place) };
    let [a, b] = states.gather(place);
    for index in 0..POINTS {
        let separation = constraint.separation(&constraint.points[index], &a, &b);
        constraint.points[index].separation_now = separation;
    }
    block.store_separations::<L, POINTS>(place, &constraint);
}

/// Turns the bodies; returns the impulse that is still to push them, N s.
#[inline(always)]
fn solve_frictions<L: Lane, const POINTS: usize>(
    block: &mut ContactBlock,
    place: usize,
    is_still: bool,
    [a, b]: &mut [BodyState<L>; 2],
) -> LaneVec2<L> {
    let mut constraint = ContactConstraint { is_still, ..block.load::<L>(place) };
    let axis = Axis::<L, POINTS>::new(&constraint, constraint.normal.perp());
    let speeds = axis.speeds(&constraint, a, b);
    let mut changes = [L::splat(0.0); POINTS];
    for index in 0..POINTS {
        let slip = axis.speed_after(index, speeds, &constraint, changes);
        changes[index] = solve_friction(&mut constraint, index, slip);
    }
    axis.turn(&constraint, changes, a, b);
    block.store_friction_impulses::<L, POINTS>(place, &constraint);
    axis.sum(changes)
}

/// What a point with the speed `vn`, m/s, asks of its impulse x and of that of the other point, x', so that it does not
/// approach: the row and its q of
///
/// ```text
/// (1 + γ) k x + coupling x' + q ≥ 0,   q = vn + bias - k λ - coupling λ'
/// ```
///
/// where the impulses so far, λ and λ', have brought about vn.
#[inline(always)]
fn row<L: Lane>(
    constraint: &ContactConstraint<L>,
    index: usize,
    vn: L,
    [coupling, other_impulse]: [L; 2],
    biased: bool,
    per_substep: f32,
) -> (Row<L>, L) {
    let (point, per_substep) = (&constraint.points[index], L::splat(per_substep));
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let separation = point.separation_now;
    let load = point.normal_k * point.normal_impulse;
    let (row, bias) = if biased {
        let [soft, whole] = one_and_compliance(separation, load);
        let row = Row { own: point.normal_k * soft, other: coupling * whole, scale: whole };
        (row, bias(separation, per_substep))
    } else {
        (Row { own: point.normal_k, other: coupling, scale: one }, gap_bias(separation, per_substep))
    };
    // What is small is added first: of that less is lost by rounding.
    let q = (vn + bias) - (load + coupling * other_impulse);
    // A point that is not there, or pending, asks for nothing, with a harmless 1.
    let is_there = point.normal_k.greater(zero);
    (Row { own: L::select(is_there, row.own, one), ..row }, L::select(is_there, q, zero))
}

/// Two points together; returns by how much their impulses change, N s.
#[inline(always)]
fn solve_normals_together<L: Lane, const POINTS: usize>(
    constraint: &mut ContactConstraint<L>,
    speeds: [L; POINTS],
    biased: bool,
    per_substep: f32,
) -> [L; POINTS] {
    let before = [constraint.points[0].normal_impulse, constraint.points[1].normal_impulse];
    let coupling = constraint.coupling;
    let (first, q_1) = row(constraint, 0, speeds[0], [coupling, before[1]], biased, per_substep);
    let (second, q_2) = row(constraint, 1, speeds[1], [coupling, before[0]], biased, per_substep);
    let after = solve_pair([first, second], [q_1, q_2]);
    let mut changes = [L::splat(0.0); POINTS];
    for (index, change) in changes.iter_mut().enumerate() {
        constraint.points[index].normal_impulse = after[index];
        *change = after[index] - before[index];
    }
    changes
}

/// One point on its own. Returns by how much its impulse changes, N s.
#[inline(always)]
fn solve_normal<L: Lane>(
    constraint: &mut ContactConstraint<L>,
    index: usize,
    vn: L,
    biased: bool,
    per_substep: f32,
) -> L {
    let zero = L::splat(0.0);
    let before = constraint.points[index].normal_impulse;
    let (row, q) = row(constraint, index, vn, [zero; 2], biased, per_substep);
    // By the inverse, as two points together: a contact of one gets the same either way.
    let after = (-(row.scale * (L::splat(1.0) / row.own)) * q).max(zero);
    constraint.points[index].normal_impulse = after;
    after - before
}

/// Friction of one point: stops the slip, with at most µ times the normal impulse (Coulomb). Returns by how much the
/// impulse changes, N s.
#[inline(always)]
fn solve_friction<L: Lane>(constraint: &mut ContactConstraint<L>, index: usize, slip: L) -> L {
    let limit = constraint.friction * constraint.points[index].normal_impulse;
    let friction = &mut constraint.frictions[index];
    let before = friction.impulse;
    friction.impulse = (before - friction.mass * slip).min(limit).max(-limit);
    friction.impulse - before
}

/// Does something to the first contact of the first block, whose numbers are counted.
#[cfg(feature = "report")]
fn do_once(blocks: &mut PairBlocks<ContactBlock>, kernel: &impl Kernel) {
    let (mut states, place) = ([BodyState::REST], 0);
    let mut over = blocks.over(&mut states);
    let (block, mut states) = over.get_mut(0);
    kernel.run::<Counted>(block, &mut states, place);
}

/// What a substep does for one contact of two points with friction: two warm starts and two sweeps.
#[cfg(feature = "report")]
pub(crate) fn work_of_a_substep() -> Count {
    let (mut blocks, is_fitted) = (PairBlocks::default(), true);
    blocks.resize(1);
    count(|| {
        for time in [WarmStartTime::BeforeMove, WarmStartTime::AfterMove] {
            do_once(&mut blocks, &WarmStart { part: 0.5, time, is_fitted });
        }
        let main = SweepOver {
            kind: Sweep::MAIN,
            have_moved: false,
            per_substep: 1.0,
            is_fitted,
            starts_again: true,
        };
        do_once(&mut blocks, &main);
        do_once(&mut blocks, &SweepOver { kind: Sweep::RELAX, have_moved: true, ..main });
    })
}

#[cfg(all(test, feature = "report"))]
mod tests {
    use super::*;

    #[test]
    fn a_warm_start_does_what_its_equations_say() {
        let mut blocks = PairBlocks::default();
        blocks.resize(1);
        let start = WarmStart { part: 0.5, time: WarmStartTime::BeforeMove, is_fitted: true };
        let found = count(|| do_once(&mut blocks, &start));
        // Per point: the impulse along the normal times the part; both times their directions (2 + 2), summed (2); r × that
        // for two bodies (3 + 3).
        let point = 1 + 4 + 2 + 6;
        // Of the two points the impulses (2) and the moments (1 + 1) are summed.
        let sum = 2 + 2;
        // Per body: the impulse times 1/m, added to v (2 + 2); the moment times 1/I, added to w.
        let body = 2 + 2 + 1 + 1;
        // The direction of the tangent is a negation, and is multiplied by the part.
        assert_eq!(found.operations, 1 + 2 + 2 * point + sum + 2 * body);
        // Numbers: of each body 1/m and 1/I; the normal; per point two anchors and two impulses. Written: per
        // point the impulse along the normal and the warm start. Half rows of two bodies, to and fro.
        let numbers = 2 * 2 + 2 + 2 * (4 + 2) + 2 * 2;
        assert_eq!(found.bytes, 4 * numbers + 4 * 16);
    }
}
