//! How contacts are stored while a step is solved: sixteen to a block, column by column, so that lanes of any width
//! load and store them without turning rows into columns.

mod begin;
mod end;
mod marks;
mod rare;

use crate::compute::{Column, Columns, Lane};
use crate::resolution::constraint::{ContactConstraint, Turns};
pub(crate) use crate::resolution::contact_block::begin::Beginning;
pub(crate) use crate::resolution::contact_block::end::Residuals;
pub(crate) use crate::resolution::contact_block::marks::Marks;
use crate::resolution::contact_block::rare::Rare;
use crate::resolution::moving_geometry::MovingGeometry;
use crate::resolution::rolling::Rolling;

/// Sixteen contacts, beside the rows of their bodies. Those of one colour share no movable body; a block that is not full
/// ends with contacts of the ground with itself, without points.
///
/// What every pass reads comes first, in whole cache lines; then what the sweep before the bodies move does not read;
/// then what only blocks with circles are read for.
#[repr(C, align(64))]
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactBlock {
    /// Speeds of surfaces past each other, m/s, if any of them moves.
    surface_speeds: Rare<Column>,
    /// What rolls with resistance, if anything does.
    rolling: Rare<Rolling<Column>>,
    /// The geometry of those that move. Made for the first of them, and kept.
    geometry: Option<Box<MovingGeometry<Column>>>,
    pub(crate) marks: BlockMarks,
    fit: Fit,
    /// Whether any of the bodies is a circle.
    has_circles: bool,
    columns: ContactConstraint<Column>,
}

/// Which contacts of a block something is true of.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct BlockMarks {
    /// Those that may bounce.
    pub(crate) bouncy: Marks,
    /// Those of a circle with what does not move.
    pub(crate) on_ground: Marks,
    /// Those of two points and with friction that bear no load as the step begins.
    pub(crate) cold: Marks,
    /// Those of bodies that are [tangled](crate::resolution::tangles).
    pub(crate) tangled: Marks,
    /// By point: those where it approaches fast enough to bounce, and has not met what it is to bounce from. The sweeps
    /// leave it alone, and it bears nothing.
    pending: [Marks; 2],
    /// Those whose geometry moves within the step in closed form.
    pub(crate) moving: Marks,
    /// Those whose geometry moves within the step, and not in closed form.
    pub(crate) found_anew: Marks,
    /// Those whose impulses are added up over the step.
    pub(crate) asked: Marks,
    /// At the end of the step: those with a notable load, see [`load`](crate::resolution::load).
    pub(crate) notably_loaded: Marks,
    /// At the end of the step: those that may have begun or ceased to touch.
    pub(crate) changing: Marks,
}

const _: () = {
    let columns = core::mem::offset_of!(ContactBlock, columns);
    // Twenty-six cache lines, then thirty-four.
    assert!(columns + core::mem::offset_of!(ContactConstraint<Column>, friction) == 26 * 64);
    assert!(columns + core::mem::offset_of!(ContactConstraint<Column>, turns) <= 34 * 64);
};

impl BlockMarks {
    /// Those whose geometry moves within the step.
    #[inline(always)]
    pub(crate) fn moving_within_step(self) -> Marks {
        self.moving.or(self.found_anew)
    }
}

/// What none of the contacts of a block needs, so that kernels may leave it out without a bit of difference.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Fit {
    /// None has a second point.
    pub(crate) is_single: bool,
    /// None has friction, or rolling resistance.
    pub(crate) is_smooth: bool,
    /// None of the bodies turns, or can be turned.
    pub(crate) is_still: bool,
}

impl Fit {
    /// What holds of no contacts at all.
    const ALL: Self = Self { is_single: true, is_smooth: true, is_still: true };
}

impl ContactBlock {
    /// What none of the contacts needs.
    #[inline(always)]
    pub(crate) fn fit(&self) -> Fit {
        self.fit
    }

    /// Whether there are contacts that may begin to bear load.
    #[inline(always)]
    pub(crate) fn has_cold_contacts(&self) -> bool {
        self.marks.cold.any()
    }

    /// Those of them, from `place` on, that bear load now and had no impulses to start this substep from.
    #[inline(always)]
    pub(crate) fn cold_and_loaded<L: Lane>(&self, place: usize) -> L::Mask {
        let (zero, constraint) = (L::splat(0.0), self.load::<L>(place));
        let greatest = |[first, second]: [L; 2]| first.max(second);
        let load = greatest(constraint.points.map(|point| point.normal_impulse));
        let start = greatest(constraint.frictions.map(|friction| friction.warm_start));
        let is_loaded = L::select(start.greater(zero), zero, load).greater(zero);
        L::both(is_loaded, self.marks.cold.mask::<L>(place))
    }

    /// The contacts from `place` on, a multiple of the lane's width.
    #[inline(always)]
    pub(crate) fn load<L: Lane>(&self, place: usize) -> ContactConstraint<L> {
        let constraint = self.columns.load::<L>(place);
        let one = L::splat(1.0);
        let turns = if self.has_circles { constraint.turns } else { Turns { a: one, b: one } };
        ContactConstraint { turns, ..constraint }
    }

    /// The same, without the points that are pending.
    #[inline(always)]
    pub(crate) fn load_active<L: Lane>(&self, place: usize) -> ContactConstraint<L> {
        let mut constraint = self.load::<L>(place);
        if self.has_pending() {
            let zero = L::splat(0.0);
            for (point, pending) in constraint.points.iter_mut().zip(self.marks.pending) {
                let is_pending = pending.mask::<L>(place);
                point.normal_k = L::select(is_pending, zero, point.normal_k);
                constraint.coupling = L::select(is_pending, zero, constraint.coupling);
            }
        }
        constraint
    }

    /// How the geometry of the contacts from `place` on moves, and of which of them it does; `None` if of none.
    #[inline(always)]
    pub(crate) fn moving<L: Lane>(&self, place: usize) -> Option<(MovingGeometry<L>, L::Mask)> {
        let geometry = self.geometry.as_ref().filter(|_| self.marks.moving.any())?;
        let moving = self.marks.moving.mask::<L>(place);
        (L::bits(moving) != 0).then(|| (geometry.load(place), moving))
    }

    /// Writes normal and points back.
    #[inline(always)]
    pub(crate) fn store_geometry<L: Lane>(&mut self, place: usize, constraint: &ContactConstraint<L>) {
        self.columns.normal.store::<L>(place, constraint.normal);
        for (to, point) in self.columns.points.iter_mut().zip(&constraint.points) {
            to.anchor_a.store::<L>(place, point.anchor_a);
            to.anchor_b.store::<L>(place, point.anchor_b);
            to.separation.store::<L>(place, point.separation);
        }
        self.store_masses(place, constraint);
    }

    /// Writes effective masses and the coupling back.
    #[inline(always)]
    fn store_masses<L: Lane>(&mut self, place: usize, constraint: &ContactConstraint<L>) {
        self.columns.coupling.store::<L>(place, constraint.coupling);
        for (index, to) in self.columns.points.iter_mut().enumerate() {
            to.normal_k.store::<L>(place, constraint.points[index].normal_k);
            self.columns.frictions[index].mass.store::<L>(place, constraint.frictions[index].mass);
        }
    }

    /// Writes the separations where the bodies are now, of the first points.
    #[inline(always)]
    pub(crate) fn store_separations<L: Lane, const POINTS: usize>(
        &mut self,
        place: usize,
        constraint: &ContactConstraint<L>,
    ) {
        for (to, point) in self.columns.points.iter_mut().zip(&constraint.points).take(POINTS) {
            to.separation_now.store::<L>(place, point.separation_now);
        }
    }

    /// Writes impulses along the normal back, of the first points.
    #[inline(always)]
    pub(crate) fn store_normal_impulses<L: Lane, const POINTS: usize>(
        &mut self,
        place: usize,
        constraint: &ContactConstraint<L>,
    ) {
        for (to, point) in self.columns.points.iter_mut().zip(&constraint.points).take(POINTS) {
            to.normal_impulse.store::<L>(place, point.normal_impulse);
        }
    }

    /// Writes impulses along the tangent back, of the first points.
    #[inline(always)]
    pub(crate) fn store_friction_impulses<L: Lane, const POINTS: usize>(
        &mut self,
        place: usize,
        constraint: &ContactConstraint<L>,
    ) {
        for (to, friction) in self.columns.frictions.iter_mut().zip(&constraint.frictions).take(POINTS) {
            to.impulse.store::<L>(place, friction.impulse);
        }
    }

    /// Writes what the warm starts apply along the normal, of the first points.
    #[inline(always)]
    pub(crate) fn store_warm_starts<L: Lane, const POINTS: usize>(
        &mut self,
        place: usize,
        constraint: &ContactConstraint<L>,
    ) {
        for (to, friction) in self.columns.frictions.iter_mut().zip(&constraint.frictions).take(POINTS) {
            to.warm_start.store::<L>(place, friction.warm_start);
        }
    }

    /// Changes the impulses of a point of one contact, N s, along normal and tangent.
    pub(crate) fn set_impulses(&mut self, place: usize, point: usize, [normal, tangent]: [f32; 2]) {
        self.columns.points[point].normal_impulse.set(place, normal);
        self.columns.frictions[point].impulse.set(place, tangent);
        self.fit.is_smooth &= tangent == 0.0;
    }

    /// Changes what the first point of one contact bears, N s: its impulses along normal and tangent, and what the warm
    /// start after the move will apply along the normal.
    pub(crate) fn set_load(&mut self, place: usize, [normal, tangent, warm_start]: [f32; 3]) {
        self.columns.points[0].normal_impulse.set(place, normal);
        self.columns.frictions[0].impulse.set(place, tangent);
        self.columns.frictions[0].warm_start.set(place, warm_start);
        self.fit.is_smooth &= tangent == 0.0;
    }

    /// Whether any of the surfaces moves.
    #[inline(always)]
    pub(crate) fn moves_surfaces(&self) -> bool {
        self.surface_speeds.used().is_some()
    }

    /// Speeds of the surfaces of the contacts from `place` on past each other, beside that of their bodies, m/s; `None` if none
    /// of the block moves.
    #[inline(always)]
    pub(crate) fn surface_speed<L: Lane>(&self, place: usize) -> Option<L> {
        Some(self.surface_speeds.used()?.load::<L>(place))
    }

    /// Whether anything rolls with resistance.
    pub(crate) fn rolls(&self) -> bool {
        self.rolling.used().is_some()
    }

    /// What rolls of the contacts from `place` on; `None` if nothing of the block does.
    #[inline(always)]
    pub(crate) fn rolling<L: Lane>(&self, place: usize) -> Option<Rolling<L>> {
        Some(self.rolling.used()?.load::<L>(place))
    }

    /// Writes what rolls back.
    #[inline(always)]
    pub(crate) fn store_rolling<L: Lane>(&mut self, place: usize, rolling: Rolling<L>) {
        if let Some(to) = self.rolling.used_mut() {
            to.moment.store::<L>(place, rolling.moment);
            to.acted.store::<L>(place, rolling.acted);
        }
    }

    /// Changes the moment of one contact on which something rolls, N m s.
    pub(crate) fn set_rolling_moment(&mut self, place: usize, moment: f32) {
        if let Some(rolling) = self.rolling.used_mut() {
            rolling.moment.set(place, moment);
        }
    }

    /// Takes note that the bodies of one contact are [tangled](crate::resolution::tangles): to the sweeps their shapes only touch.
    pub(crate) fn set_tangled(&mut self, place: usize) {
        self.marks.tangled.set(place, true);
        for point in &mut self.columns.points {
            point.separation_now.set(place, point.separation_now.get(place).max(0.0));
        }
    }

    /// Lets the contacts from `place` on begin a substep without impulses where the mask holds.
    #[inline(always)]
    pub(crate) fn forget_where<L: Lane, const POINTS: usize>(
        &mut self,
        place: usize,
        constraint: &mut ContactConstraint<L>,
        forgotten: L::Mask,
    ) {
        constraint.forget_impulses_where(forgotten);
        self.store_friction_impulses::<L, POINTS>(place, constraint);
    }

    /// Lets the contacts from `place` on go on after the move as if they had borne nothing before it, where the mask holds.
    #[inline(always)]
    pub(crate) fn forget_load_where<L: Lane, const POINTS: usize>(
        &mut self,
        place: usize,
        forgotten: L::Mask,
    ) {
        let mut constraint = self.load::<L>(place);
        self.forget_where::<L, POINTS>(place, &mut constraint, forgotten);
        self.store_normal_impulses::<L, POINTS>(place, &constraint);
        self.store_warm_starts::<L, POINTS>(place, &constraint);
    }

    /// Those of the contacts from `place` on whose bodies are [tangled](crate::resolution::tangles), if there are some in the block.
    #[inline(always)]
    pub(crate) fn tangled<L: Lane>(&self, place: usize) -> Option<L::Mask> {
        self.marks.tangled.any().then(|| self.marks.tangled.mask::<L>(place))
    }

    /// Whether any point is pending.
    #[inline(always)]
    pub(crate) fn has_pending(&self) -> bool {
        self.marks.pending[0].any() || self.marks.pending[1].any()
    }

    /// Which points of one contact are pending.
    #[inline(always)]
    pub(crate) fn is_pending(&self, place: usize) -> [bool; 2] {
        self.marks.pending.map(|pending| pending.get(place))
    }

    /// Whether a point of one contact bears load.
    #[inline(always)]
    pub(crate) fn is_loaded(&self, place: usize) -> bool {
        self.columns.points.iter().any(|point| point.normal_impulse.get(place) > 0.0)
    }

    /// No point is pending any more.
    pub(crate) fn clear_pending(&mut self) {
        self.marks.pending = Default::default();
    }

    /// Says which points of one contact are pending. Those that are bear nothing from now on.
    #[inline(always)]
    pub(crate) fn set_pending(&mut self, place: usize, is_pending: [bool; 2]) {
        for (index, is_pending) in is_pending.into_iter().enumerate() {
            self.marks.pending[index].put(place, is_pending);
            if is_pending {
                self.columns.points[index].normal_impulse.set(place, 0.0);
                self.columns.frictions[index].impulse.set(place, 0.0);
            }
        }
    }
}
