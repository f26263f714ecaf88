//! What passes over contacts do to them: warm start, sweep, and rolling resistance. One text for every lane width.
//!
//! This is where a step spends its time: per substep each contact is warm started twice and swept twice, and what rolls has two passes more.

use crate::compute::{BodyState, Lane, PairStates};
#[cfg(feature = "report")]
use crate::compute::{Count, Counted, PairBlocks, count};
use crate::resolution::constraint::Action;
use crate::resolution::contact_block::{ContactBlock, Fit};
use crate::resolution::solve_contact::Sweep;

/// Something that is done to contacts, as many at a time as a lane holds: those of `block` from `place` on, and the states of their
/// bodies. Several threads do it to contacts of one colour, which move no body in common. It is to be `#[inline(always)]`, see
/// [`Job`](crate::compute::Job).
pub(crate) trait Kernel: Clone + Sync {
    fn run<L: Lane>(&self, block: &mut ContactBlock, states: &mut PairStates<'_>, place: usize);
}

/// What a kernel leaves out for a block, if it `is_fitted`. Not all that it could: each case makes programs larger and longer
/// to build. One contact at a time is for the few that do not fit into lanes, where it would save little.
#[inline(always)]
fn fit<L: Lane>(block: &ContactBlock, is_fitted: bool) -> Fit {
    if is_fitted && L::WIDTH > 1 { block.fit() } else { Fit::default() }
}

/// Where outlines turn against each other by more than this in a substep, rad, the impulses of the last are no guess for it: what
/// friction began with before the move is taken back after it along a surface that lies another way, and small boxes that hit a wall
/// left it with 45 times their energy. With half a radian, a row of boxes that a heavy one drives into a wall still gains; with a
/// tenth, what is thrown on a heap begins without impulses for long.
pub(crate) const MOST_TURNED: f32 = 0.25;

/// Applies the impulses of the last substep before anything is solved: where the kick is split, half of them before
/// the bodies move and half after it, each with the geometry of its moment. Along the normal, they are what of them is
/// [load](crate::resolution::constraint::warm_start::LOAD_GROWTH).
///
/// There is one accumulator for the whole substep. Along the normal, the second half is of the impulse that the substep
/// began with, not of what the sweep before the move has made of it: with the biased impulse applied again, the push
/// out of an overlap would be counted as load and pump energy into the scene. Along the tangent nothing has changed in
/// between, as friction is solved after the move.
#[derive(Clone, Debug)]
pub(crate) struct WarmStart {
    /// Share of the last impulses, no unit: a half; all where the kick is not split; 0 where they are to be forgotten.
    pub(crate) part: f32,
    /// Where two outlines turn faster against each other, the last impulses are forgotten, rad/s.
    pub(crate) fastest_turn: f32,
    /// k λ of a load that begins, at most, in each of them, m/s.
    pub(crate) new_load_speed: f32,
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
        let Fit { is_single, is_smooth, is_still } = fit::<L>(block, self.is_fitted);
        match (is_single, is_still, is_smooth) {
            (true, _, true) => self.start::<L, 1, false, true>(block, states, place),
            (true, _, false) => self.start::<L, 1, false, false>(block, states, place),
            (false, true, true) => self.start::<L, 2, true, true>(block, states, place),
            (false, true, false) => self.start::<L, 2, true, false>(block, states, place),
            (false, false, _) => self.start::<L, 2, false, false>(block, states, place),
        }
    }
}

impl WarmStart {
    #[cfg_attr(unoptimized, inline(never))]
    #[cfg_attr(not(unoptimized), inline(always))]
    fn start<L: Lane, const POINTS: usize, const STILL: bool, const SMOOTH: bool>(
        &self,
        block: &mut ContactBlock,
        states: &mut PairStates<'_>,
        place: usize,
    ) {
        let mut constraint = block.load::<L>(place);
        let part = L::splat(self.part);
        let [mut a, mut b] = states.gather_velocities(place);
        match self.time {
            WarmStartTime::BeforeMove => {
                let all = || L::splat(1.0).greater(L::splat(0.0));
                let forgotten = if self.part == 0.0 { Some(all()) } else { block.tangled::<L>(place) };
                if let Some(forgotten) = forgotten {
                    block.forget_where::<L, POINTS>(place, &mut constraint, forgotten);
                }
                if !STILL {
                    let is_fast = constraint.outlines_turn_at(&a, &b).greater(L::splat(self.fastest_turn));
                    if L::bits(is_fast) != 0 {
                        block.forget_where::<L, POINTS>(place, &mut constraint, is_fast);
                    }
                }
                constraint.begin_normal_impulses::<POINTS>(part, L::splat(self.new_load_speed));
                block.store_warm_starts::<L, POINTS>(place, &constraint);
            }
            WarmStartTime::AfterMove => constraint.count_warm_start::<POINTS>(),
        }
        block.store_normal_impulses::<L, POINTS>(place, &constraint);
        let Action { impulse, moments } = constraint.warm_start::<POINTS>(part, SMOOTH);
        constraint.push(impulse, &mut a, &mut b);
        if !STILL {
            constraint.turn(moments, &mut a, &mut b);
            if let Some(mut rolling) = block.rolling::<L>(place) {
                if self.time == WarmStartTime::BeforeMove {
                    rolling.begin();
                }
                let moment = rolling.start(part, constraint.frictions[0].warm_start);
                constraint.turn([moment; 2], &mut a, &mut b);
                block.store_rolling(place, rolling);
            }
        }
        states.scatter_velocities(place, &[a, b]);
    }
}

/// A contact of two points and with friction that begins to bear load is solved so many times more: without impulses
/// to start from, once lets friction turn the body instead of stopping it, and a box set on a slope keeps 7 mm/s
/// too much for as long as it slides. Twice leave a tenth of that, four times nothing.
const COLD_SWEEPS: u32 = 4;

/// One sweep over contacts: normals, then friction.
#[derive(Clone, Debug)]
pub(crate) struct SweepOver {
    pub(crate) sweep: Sweep,
    /// Whether bodies have moved since separations were found.
    pub(crate) have_moved: bool,
    /// One over the length of the substep, 1/s.
    pub(crate) substep_rate: f32,
    /// Whether what no contact of a block needs is left out.
    pub(crate) is_fitted: bool,
    /// Whether there is a warm start after the move, which cold contacts can count on.
    pub(crate) starts_again: bool,
}

impl Kernel for SweepOver {
    #[inline(always)]
    fn run<L: Lane>(&self, block: &mut ContactBlock, states: &mut PairStates<'_>, place: usize) {
        let Fit { is_single, is_smooth, is_still } = fit::<L>(block, self.is_fitted);
        let is_special = block.has_pending() || block.moves_surfaces() || !self.sweep.is_usual();
        match (is_special, is_single, is_still) {
            (true, ..) => self.run_sweep::<L, 2, false, true>(block, states, place, self.sweep),
            (_, true, _) => self.run_usual::<L, 1, false>(block, states, place, is_smooth),
            (_, _, true) => self.run_usual::<L, 2, true>(block, states, place, is_smooth),
            _ => self.run_usual::<L, 2, false>(block, states, place, is_smooth),
        }
        if self.starts_again && block.has_cold_contacts() {
            self.run_cold::<L>(block, states, place);
        }
    }
}

impl SweepOver {
    /// The sweeps of the default, each compiled on its own: without branches, which keeps numbers in registers.
    #[inline(always)]
    fn run_usual<L: Lane, const POINTS: usize, const STILL: bool>(
        &self,
        block: &mut ContactBlock,
        states: &mut PairStates<'_>,
        place: usize,
        is_smooth: bool,
    ) {
        match (self.sweep.biased, is_smooth) {
            (true, _) => self.run_sweep::<L, POINTS, STILL, false>(block, states, place, Sweep::PUSH),
            (_, true) => self.run_sweep::<L, POINTS, STILL, false>(block, states, place, Sweep::SMOOTH_RELAX),
            _ => self.run_sweep::<L, POINTS, STILL, false>(block, states, place, Sweep::RELAX),
        }
    }

    #[cfg_attr(unoptimized, inline(never))]
    #[cfg_attr(not(unoptimized), inline(always))]
    fn run_sweep<L: Lane, const POINTS: usize, const STILL: bool, const IS_SPECIAL: bool>(
        &self,
        block: &mut ContactBlock,
        states: &mut PairStates<'_>,
        place: usize,
        sweep: Sweep,
    ) {
        let mut contact = if IS_SPECIAL { block.load_active::<L>(place) } else { block.load(place) };
        let surface_speed = if IS_SPECIAL { block.surface_speed::<L>(place) } else { None };
        let mut pair = if self.have_moved {
            let pair = states.gather(place);
            contact.find_separations::<POINTS>(&pair);
            if let Some(tangled) = block.tangled::<L>(place) {
                contact.see_as_touching_where(tangled);
            }
            block.store_separations::<L, POINTS>(place, &contact);
            pair
        } else {
            states.gather_velocities(place)
        };
        contact.solve::<POINTS, STILL>(sweep, self.substep_rate, surface_speed, &mut pair);
        block.store_normal_impulses::<L, POINTS>(place, &contact);
        if sweep.friction {
            block.store_friction_impulses::<L, POINTS>(place, &contact);
        }
        states.scatter_velocities(place, &pair);
    }

    /// Solves those that begin to bear load a few times more, and with friction before the move too: there are no impulses to
    /// start them from, and a box set on a slope would go down freely for half a substep.
    #[cfg_attr(unoptimized, inline(never))]
    #[cfg_attr(not(unoptimized), inline(always))]
    fn run_cold<L: Lane>(&self, block: &mut ContactBlock, states: &mut PairStates<'_>, place: usize) {
        let is_cold = block.cold_and_loaded::<L>(place);
        if L::bits(is_cold) == 0 {
            return;
        }
        let (before, pair_before) = (block.load_active::<L>(place), states.gather_velocities(place));
        let (mut after, mut pair) = (before, pair_before);
        // Before the move half of the impulses along the tangent have acted; the warm start after it does as much again.
        let (acted, whole) = if self.sweep.friction { (1.0, 1.0) } else { (0.5, 2.0) };
        for friction in &mut after.frictions {
            friction.impulse = friction.impulse * L::splat(acted);
        }
        let surface_speed = block.surface_speed::<L>(place);
        for _ in 0..COLD_SWEEPS {
            let sweep = Sweep { friction: true, ..self.sweep };
            after.solve::<2, false>(sweep, self.substep_rate, surface_speed, &mut pair);
        }
        for index in 0..2 {
            let (point, friction) = (&mut after.points[index], &mut after.frictions[index]);
            let impulse_before = before.points[index].normal_impulse;
            point.normal_impulse = L::select(is_cold, point.normal_impulse, impulse_before);
            let impulse = friction.impulse * L::splat(whole);
            friction.impulse = L::select(is_cold, impulse, before.frictions[index].impulse);
        }
        block.store_normal_impulses::<L, 2>(place, &after);
        block.store_friction_impulses::<L, 2>(place, &after);
        for (state, before) in pair.iter_mut().zip(&pair_before) {
            *state = BodyState::select(is_cold, state, before);
        }
        states.scatter_velocities(place, &pair);
    }
}

/// Rolling resistance of the swept contacts that have any, before and after the sweep that follows the move.
#[derive(Clone, Debug)]
pub(crate) struct Roll;

impl Kernel for Roll {
    #[inline(always)]
    fn run<L: Lane>(&self, block: &mut ContactBlock, states: &mut PairStates<'_>, place: usize) {
        let Some(mut rolling) = block.rolling::<L>(place) else { return };
        let mut pair = states.gather_velocities(place);
        rolling.solve(&block.load(place), &mut pair);
        block.store_rolling(place, rolling);
        states.scatter_velocities(place, &pair);
    }
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
    let (mut blocks, part, is_fitted) = (PairBlocks::default(), 0.5, true);
    blocks.resize(1);
    count(|| {
        for time in [WarmStartTime::BeforeMove, WarmStartTime::AfterMove] {
            do_once(
                &mut blocks,
                &WarmStart { part, fastest_turn: f32::MAX, new_load_speed: f32::MAX, time, is_fitted },
            );
        }
        let push = SweepOver {
            sweep: Sweep::PUSH,
            have_moved: false,
            substep_rate: 1.0,
            is_fitted,
            starts_again: true,
        };
        do_once(&mut blocks, &push);
        do_once(&mut blocks, &SweepOver { sweep: Sweep::RELAX, have_moved: true, ..push });
    })
}

#[cfg(all(test, feature = "report"))]
mod tests {
    use super::*;

    #[test]
    fn a_warm_start_does_what_its_equations_say() {
        let mut blocks = PairBlocks::default();
        blocks.resize(1);
        let time = WarmStartTime::BeforeMove;
        let start =
            WarmStart { part: 0.5, fastest_turn: f32::MAX, new_load_speed: f32::MAX, time, is_fitted: true };
        let found = count(|| do_once(&mut blocks, &start));
        // Per point: the impulse along the normal times the part; whether it is load (two products, a difference and a comparison);
        // both impulses times their directions (2 + 2), summed (2); r × that for two bodies (3 + 3).
        let point = 1 + 4 + 4 + 2 + 6;
        // Of the two points the impulses (2) and the moments (1 + 1) are summed.
        let sum = 2 + 2;
        // Per body: the impulse times 1/m, added to v (2 + 2); the moment times 1/I, added to w.
        let body = 2 + 2 + 1 + 1;
        // How fast outlines turn: two products, their difference, its size (2), and the comparison.
        let turning = 2 + 1 + 2 + 1;
        // The direction of the tangent is a negation, and is multiplied by the part.
        assert_eq!(found.operations, turning + 1 + 2 + 2 * point + sum + 2 * body);
        // Numbers: of each body 1/m and 1/I, as all outlines turn where there are no circles; the normal; per point two anchors,
        // two impulses, k and the warm start before. Written: per point the impulse along the normal and the warm start. Half rows
        // of two bodies, to and fro.
        let numbers = 2 * 2 + 2 + 2 * (4 + 2 + 2) + 2 * 2;
        assert_eq!(found.bytes, 4 * numbers + 4 * 16);
    }
}
