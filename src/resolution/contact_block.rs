//! How contacts are stored while a step is solved: sixteen to a block, column by column, so that lanes of any width
//! load and store them without turning rows into columns.

mod begin;
mod end;
mod marks;

use crate::compute::{Column, Columns, Lane};
use crate::resolution::constraint::{ConstraintPoint, ContactConstraint, PointFriction, Turns};
pub(crate) use crate::resolution::contact_block::begin::{Beginning, BlockStart};
pub(crate) use crate::resolution::contact_block::end::{BlockEnd, ContactEnds};
pub(crate) use crate::resolution::contact_block::marks::Marks;
use crate::resolution::moving_geometry::MovingGeometry;

/// Sixteen contacts, beside the rows of their bodies. Those of one colour share no movable body; a block that is not full
/// ends with contacts of the ground with itself, without points.
///
/// What every pass reads comes first, in whole cache lines; then what the sweep before the bodies move does not read;
/// then what only blocks with circles are read for.
#[repr(C, align(64))]
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactBlock {
    /// Whether any of the bodies is a circle.
    has_circles: bool,
    fit: Fit,
    /// Contacts of two points and with friction that bear no load as the step begins.
    cold_contacts: Marks,
    /// By point: the contacts of which it approaches fast enough to bounce, and has not met what it is to bounce from. The
    /// sweeps leave it alone, and it bears nothing.
    pending: [Marks; 2],
    /// Contacts whose geometry moves within the step, in closed form.
    moving: Marks,
    /// Their geometry. Made for the first of them, and kept.
    geometry: Option<Box<MovingGeometry<Column>>>,
    columns: ContactConstraint<Column>,
}

const _: () = {
    let columns = core::mem::offset_of!(ContactBlock, columns);
    // Twenty-four cache lines, then thirty-two.
    assert!(columns + core::mem::offset_of!(ContactConstraint<Column>, friction) == 24 * 64);
    assert!(columns + core::mem::offset_of!(ContactConstraint<Column>, turns) <= 32 * 64);
};

/// What none of the contacts of a block needs, so that kernels may leave it out without a bit of difference.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Fit {
    /// None has a second point.
    pub(crate) is_single: bool,
    /// None has friction.
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
    pub(crate) fn has_cold_contacts(&self) -> bool {
        self.cold_contacts.any()
    }

    /// Those of them, from `place` on, that bear load now and had no impulses to start this substep from.
    #[inline(always)]
    pub(crate) fn cold_and_loaded<L: Lane>(&self, place: usize) -> L::Mask {
        let (zero, constraint) = (L::splat(0.0), self.load::<L>(place));
        let greatest = |[first, second]: [L; 2]| first.max(second);
        let load = greatest(constraint.points.map(|point| point.normal_impulse));
        let start = greatest(constraint.frictions.map(|friction| friction.warm_start));
        let is_loaded = L::select(start.greater(zero), zero, load).greater(zero);
        L::both(is_loaded, self.cold_contacts.mask::<L>(place))
    }

    /// The contacts from `place` on, a multiple of the lane's width.
    #[inline(always)]
    pub(crate) fn load<L: Lane>(&self, place: usize) -> ContactConstraint<L> {
        let one = L::splat(1.0);
        let turns = if self.has_circles { self.columns.turns.load(place) } else { Turns { a: one, b: one } };
        self.columns.load(place, turns)
    }

    /// The same, without the points that are pending.
    #[inline(always)]
    pub(crate) fn load_active<L: Lane>(&self, place: usize) -> ContactConstraint<L> {
        let mut constraint = self.load::<L>(place);
        if self.has_pending() {
            let zero = L::splat(0.0);
            for (point, pending) in constraint.points.iter_mut().zip(self.pending) {
                let is_pending = pending.mask::<L>(place);
                point.normal_k = L::select(is_pending, zero, point.normal_k);
                constraint.coupling = L::select(is_pending, zero, constraint.coupling);
            }
        }
        constraint
    }

    /// One contact alone, without reading a point that no contact of the block has.
    #[inline(always)]
    pub(crate) fn load_one(&self, place: usize) -> ContactConstraint<f32> {
        let mut constraint = self.load(place);
        if self.fit.is_single {
            constraint.points[1] = ConstraintPoint::default();
            constraint.frictions[1] = PointFriction::default();
            constraint.coupling = 0.0;
        }
        constraint
    }

    /// How the geometry of the contacts from `place` on moves, and of which of them it does; `None` if of none.
    #[inline(always)]
    pub(crate) fn moving<L: Lane>(&self, place: usize) -> Option<(MovingGeometry<L>, L::Mask)> {
        let geometry = self.geometry.as_ref().filter(|_| self.moving.any())?;
        let moving = self.moving.mask::<L>(place);
        (L::bits(moving) != 0).then(|| (geometry.load(place), moving))
    }

    /// Writes normal and points back.
    #[inline(always)]
    pub(crate) fn store_geometry<L: Lane>(&mut self, place: usize, constraint: &ContactConstraint<L>) {
        if self.fit.is_single {
            self.columns.store_geometry::<L, 1>(place, constraint);
        } else {
            self.columns.store_geometry::<L, 2>(place, constraint);
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
            point.separation_now.store(&mut to.separation_now, place);
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
            point.normal_impulse.store(&mut to.normal_impulse, place);
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
            friction.impulse.store(&mut to.impulse, place);
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
            friction.warm_start.store(&mut to.warm_start, place);
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

    /// Whether any point is pending.
    #[inline(always)]
    pub(crate) fn has_pending(&self) -> bool {
        self.pending[0].any() || self.pending[1].any()
    }

    /// Which points of one contact are pending.
    #[inline(always)]
    pub(crate) fn is_pending(&self, place: usize) -> [bool; 2] {
        self.pending.map(|pending| pending.get(place))
    }

    /// No point is pending any more.
    pub(crate) fn clear_pending(&mut self) {
        self.pending = Default::default();
    }

    /// Says which points of one contact are pending. Those that are bear nothing from now on.
    #[inline(always)]
    pub(crate) fn set_pending(&mut self, place: usize, is_pending: [bool; 2]) {
        for (index, is_pending) in is_pending.into_iter().enumerate() {
            self.pending[index].put(place, is_pending);
            if is_pending {
                self.columns.points[index].normal_impulse.set(place, 0.0);
                self.columns.frictions[index].impulse.set(place, 0.0);
            }
        }
    }
}

impl ContactConstraint<Column> {
    #[inline(always)]
    fn load<L: Lane>(&self, place: usize, turns: Turns<L>) -> ContactConstraint<L> {
        ContactConstraint {
            inverse_mass_a: self.inverse_mass_a.load(place),
            inverse_mass_b: self.inverse_mass_b.load(place),
            inverse_inertia_a: self.inverse_inertia_a.load(place),
            inverse_inertia_b: self.inverse_inertia_b.load(place),
            normal: self.normal.load(place),
            friction: self.friction.load(place),
            coupling: self.coupling.load(place),
            points: self.points.load(place),
            frictions: self.frictions.load(place),
            turns,
            is_still: false,
        }
    }

    #[inline(always)]
    fn store_geometry<L: Lane, const POINTS: usize>(
        &mut self,
        place: usize,
        constraint: &ContactConstraint<L>,
    ) {
        self.normal.store(place, constraint.normal);
        if POINTS == 2 {
            constraint.coupling.store(&mut self.coupling, place);
        }
        for (to, point) in self.points.iter_mut().zip(&constraint.points).take(POINTS) {
            to.anchor_a.store(place, point.anchor_a);
            to.anchor_b.store(place, point.anchor_b);
            point.separation.store(&mut to.separation, place);
            point.normal_k.store(&mut to.normal_k, place);
        }
        for (to, friction) in self.frictions.iter_mut().zip(&constraint.frictions).take(POINTS) {
            friction.mass.store(&mut to.mass, place);
        }
    }
}
