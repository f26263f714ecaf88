//! How contacts are stored while a step is solved: sixteen to a block, column by column, so that lanes of any width
//! load and store them without turning rows into columns.

mod begin;
mod end;
mod marks;

use crate::compute::{Column, Lane};
use crate::resolution::constraint::{ConstraintPoint, ContactConstraint, PointFriction, Special};
pub(crate) use crate::resolution::contact_block::begin::{Beginning, BlockStart};
pub(crate) use crate::resolution::contact_block::end::{BlockEnd, ContactEnds};
pub(crate) use crate::resolution::contact_block::marks::Marks;

/// Sixteen contacts, beside the rows of their bodies. Those of one colour share no movable body; a block that is not full
/// ends with contacts of the ground with itself, without points.
///
/// What every pass reads comes first, in whole cache lines; then what the sweep before the bodies move does not read;
/// then what only blocks with something special are read for.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactBlock {
    /// Whether any of the contacts has something special.
    is_special: bool,
    fit: Fit,
    /// Contacts of two points and with friction that bear no load as the step begins.
    cold_contacts: Marks,
    /// Contacts that bear load since the last sweep, and had no impulses to start this substep from; only in blocks with
    /// cold contacts.
    newly_loaded: Marks,
    /// What the caller calls those of them that follow the surface; `NONE` where there are none.
    pub(crate) followers: u32,
    columns: ContactConstraint<Column>,
}

const _: () = {
    let columns = core::mem::offset_of!(ContactBlock, columns);
    // Twenty-four cache lines, then thirty-two.
    assert!(columns + core::mem::offset_of!(ContactConstraint<Column>, friction) == 24 * 64);
    assert!(columns + core::mem::offset_of!(ContactConstraint<Column>, special) <= 32 * 64);
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

    /// Those of them that the last sweep has found to bear load, and that had no impulses to start this substep from.
    pub(crate) fn newly_loaded(&self) -> Marks {
        self.newly_loaded.and(self.cold_contacts)
    }

    /// Takes note of which contacts that is so, from `place` on, a multiple of the lane's width.
    #[inline(always)]
    pub(crate) fn note_newly_loaded<L: Lane>(&mut self, place: usize, constraint: &ContactConstraint<L>) {
        let zero = L::splat(0.0);
        let greatest = |[first, second]: [L; 2]| first.max(second).greater(zero);
        let is_pressed = greatest(constraint.points.map(|point| point.normal_impulse));
        let was_started = greatest(constraint.frictions.map(|friction| friction.warm_start));
        let bits = L::bits(is_pressed) & !L::bits(was_started);
        self.newly_loaded.write::<L>(place, bits);
    }

    /// The contacts from `place` on, a multiple of the lane's width.
    #[inline(always)]
    pub(crate) fn load<L: Lane>(&self, place: usize) -> ContactConstraint<L> {
        let special = if self.is_special { self.columns.special.load(place) } else { Special::none() };
        self.columns.load(place, special)
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

    /// Takes over a contact of another block as it is now, to be swept over.
    pub(crate) fn copy(&mut self, place: usize, from: &Self, from_place: usize) {
        self.is_special |= from.is_special;
        self.columns.store(place, &from.load::<f32>(from_place));
    }

    /// Takes over the impulses of such a copy, those along the tangent times `tangent_scale`, no unit.
    pub(crate) fn copy_impulses(&mut self, place: usize, from: &Self, from_place: usize, tangent_scale: f32) {
        let mut constraint = from.load::<f32>(from_place);
        for friction in &mut constraint.frictions {
            friction.impulse *= tangent_scale;
        }
        self.store_normal_impulses::<f32, 2>(place, &constraint);
        self.store_friction_impulses::<f32, 2>(place, &constraint);
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

    /// Has the sweeps heed all points again.
    pub(crate) fn await_no_impact(&mut self) {
        self.columns.special.awaits_impact = Default::default();
    }

    /// Has the sweeps heed the points of one contact again or not.
    pub(crate) fn set_awaits_impact(&mut self, place: usize, awaits: [f32; 2]) {
        for (to, awaits) in self.columns.special.awaits_impact.iter_mut().zip(awaits) {
            to.set(place, awaits);
        }
        self.is_special = true;
    }
}

impl ContactConstraint<Column> {
    #[inline(always)]
    fn load<L: Lane>(&self, place: usize, special: Special<L>) -> ContactConstraint<L> {
        ContactConstraint {
            inverse_mass_a: L::load(&self.inverse_mass_a, place),
            inverse_mass_b: L::load(&self.inverse_mass_b, place),
            inverse_inertia_a: L::load(&self.inverse_inertia_a, place),
            inverse_inertia_b: L::load(&self.inverse_inertia_b, place),
            normal: self.normal.load(place),
            friction: L::load(&self.friction, place),
            coupling: L::load(&self.coupling, place),
            points: [self.points[0].load(place), self.points[1].load(place)],
            frictions: [self.frictions[0].load(place), self.frictions[1].load(place)],
            special,
            is_still: false,
        }
    }

    /// Writes all that sweeps read.
    fn store(&mut self, place: usize, constraint: &ContactConstraint<f32>) {
        self.inverse_mass_a.set(place, constraint.inverse_mass_a);
        self.inverse_mass_b.set(place, constraint.inverse_mass_b);
        self.inverse_inertia_a.set(place, constraint.inverse_inertia_a);
        self.inverse_inertia_b.set(place, constraint.inverse_inertia_b);
        self.friction.set(place, constraint.friction);
        self.store_geometry::<f32, 2>(place, constraint);
        for (to, point) in self.points.iter_mut().zip(&constraint.points) {
            to.separation_now.set(place, point.separation_now);
            to.normal_impulse.set(place, point.normal_impulse);
        }
        for (to, friction) in self.frictions.iter_mut().zip(&constraint.frictions) {
            to.impulse.set(place, friction.impulse);
            to.warm_start.set(place, friction.warm_start);
        }
        self.special.store(place, &constraint.special);
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

impl PointFriction<Column> {
    #[inline(always)]
    fn load<L: Lane>(&self, place: usize) -> PointFriction<L> {
        PointFriction {
            mass: L::load(&self.mass, place),
            impulse: L::load(&self.impulse, place),
            warm_start: L::load(&self.warm_start, place),
        }
    }
}

impl Special<Column> {
    #[inline(always)]
    fn load<L: Lane>(&self, place: usize) -> Special<L> {
        let [first, second] = &self.awaits_impact;
        Special {
            turns_a: L::load(&self.turns_a, place),
            turns_b: L::load(&self.turns_b, place),
            awaits_impact: [L::load(first, place), L::load(second, place)],
        }
    }

    fn store(&mut self, place: usize, special: &Special<f32>) {
        self.turns_a.set(place, special.turns_a);
        self.turns_b.set(place, special.turns_b);
        for (to, awaits) in self.awaits_impact.iter_mut().zip(special.awaits_impact) {
            to.set(place, awaits);
        }
    }
}

impl ConstraintPoint<Column> {
    #[inline(always)]
    fn load<L: Lane>(&self, place: usize) -> ConstraintPoint<L> {
        ConstraintPoint {
            anchor_a: self.anchor_a.load(place),
            anchor_b: self.anchor_b.load(place),
            separation: L::load(&self.separation, place),
            separation_now: L::load(&self.separation_now, place),
            normal_k: L::load(&self.normal_k, place),
            normal_impulse: L::load(&self.normal_impulse, place),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::LaneVec2;

    #[test]
    fn a_copy_is_swept_like_the_contact_that_it_is_of_and_gives_its_impulses_back() {
        let mut numbers = (1..).map(|number: u8| f32::from(number));
        let mut next = || numbers.next().unwrap();
        let contact = ContactConstraint {
            inverse_mass_a: next(),
            inverse_mass_b: next(),
            inverse_inertia_a: next(),
            inverse_inertia_b: next(),
            normal: LaneVec2 { x: next(), y: next() },
            coupling: next(),
            points: [(); 2].map(|()| ConstraintPoint {
                anchor_a: LaneVec2 { x: next(), y: next() },
                anchor_b: LaneVec2 { x: next(), y: next() },
                separation: next(),
                separation_now: next(),
                normal_k: next(),
                normal_impulse: next(),
            }),
            friction: next(),
            frictions: [(); 2].map(|()| PointFriction { mass: next(), impulse: next(), warm_start: next() }),
            special: Special { turns_a: next(), turns_b: next(), awaits_impact: [next(), next()] },
            is_still: false,
        };
        let mut block = ContactBlock { is_special: true, ..ContactBlock::default() };
        let mut copies = ContactBlock::default();
        block.columns.store(3, &contact);
        copies.copy(14, &block, 3);
        assert_eq!(format!("{:?}", copies.load::<f32>(14)), format!("{contact:?}"));

        copies.set_impulses(14, 0, [0.25, -0.25]);
        copies.set_impulses(14, 1, [0.5, -0.5]);
        block.copy_impulses(3, &copies, 14, 1.0);
        assert_eq!(format!("{:?}", block.load::<f32>(3)), format!("{:?}", copies.load::<f32>(14)));
    }
}
