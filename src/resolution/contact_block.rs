//! How contacts are stored while a step is solved: eight to a block, column by column, so that lanes of any width
//! load and store them without turning rows into columns.

use crate::body::{Bodies, Motion, NONE};
use crate::collision::{Contact, Contacts, ManifoldPoint};
use crate::compute::{BodyState, COLUMN, Column, GROUND_ROW, Lane, LaneVec2, RowPairs, Rows, Shared};
use crate::resolution::constraint::{
    ConstraintPoint, ContactConstraint, PointFriction, Special, StepResidual, THERE,
};

/// Eight contacts. Those of one colour share no movable body; a block that is not full ends with contacts of the
/// ground with itself, without points.
///
/// What every pass reads comes first, in whole cache lines; then what the sweep before the bodies move does not read;
/// then what only blocks with something special are read for.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactBlock {
    rows: RowPairs,
    /// Whether any of the contacts has something special.
    is_special: bool,
    fit: Fit,
    /// Contacts that are more than bodies at rest on each other.
    lively: Marks,
    /// What the caller calls those of them that follow the surface; `NONE` where there are none.
    pub(crate) followers: u32,
    columns: ContactConstraint<Column>,
}

const _: () = {
    let columns = core::mem::offset_of!(ContactBlock, columns);
    // Twelve cache lines, then sixteen.
    assert!(columns + core::mem::offset_of!(ContactConstraint<Column>, friction) == 12 * 64);
    assert!(columns + core::mem::offset_of!(ContactConstraint<Column>, special) <= 16 * 64);
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

/// One of the points of eight contacts at the end of the step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PointEnds {
    separation: Column,
    approach_speed: Column,
    /// From the centres, turned with the bodies.
    anchor_a: LaneVec2<Column>,
    anchor_b: LaneVec2<Column>,
}

/// Some of the eight contacts of a block.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Marks(u8);

impl Marks {
    /// Marks the contact at `place`, below [`COLUMN`], that is not marked yet, or not.
    #[inline(always)]
    pub(crate) fn set(&mut self, place: usize, is_marked: bool) {
        self.0 |= u8::from(is_marked) << place;
    }

    /// Calls `visit` with the places of the marked contacts, in order.
    #[inline(always)]
    pub(crate) fn for_each(mut self, mut visit: impl FnMut(usize)) {
        while self.0 != 0 {
            visit(self.0.trailing_zeros() as usize);
            self.0 &= self.0 - 1;
        }
    }
}

/// What a step did to the contacts of a block.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct BlockEnd {
    /// Contacts under lasting load.
    pub(crate) lasting: Marks,
    /// Contacts that may have begun or ceased to touch.
    pub(crate) changing: Marks,
    pub(crate) residual: StepResidual,
}

impl ContactBlock {
    /// Takes over some contacts, as many as there are places or less, as the step begins. Their impulses are
    /// multiplied by `scale`, the length of a substep now over that of the substep they were found in. Effective
    /// masses are still to be found.
    pub(crate) fn fill(&mut self, indices: &[u32], contacts: &Contacts, bodies: &Bodies, scale: f32) {
        // What is left over is overwritten, but for places beyond the last contact and the greatest row.
        if indices.len() < COLUMN {
            *self = Self::default();
        }
        self.rows = RowPairs::default();
        self.is_special = false;
        self.fit = Fit::ALL;
        self.lively = Marks::default();
        self.followers = NONE;
        self.columns.special.awaits_impact = Default::default();
        for (place, &index) in indices.iter().enumerate() {
            self.put(place, &contacts[index], bodies, scale);
        }
    }

    fn put(&mut self, place: usize, contact: &Contact, bodies: &Bodies, scale: f32) {
        let [a, b] = contact.slots.map(|slot| &bodies.motions[slot as usize]);
        self.rows.set(place, [a.row, b.row]);
        let columns = &mut self.columns;
        columns.inverse_mass_a.set(place, a.inverse_mass);
        columns.inverse_mass_b.set(place, b.inverse_mass);
        columns.inverse_inertia_a.set(place, a.inverse_inertia);
        columns.inverse_inertia_b.set(place, b.inverse_inertia);
        let special = &mut columns.special;
        special.turns_a.set(place, if a.is_round { 0.0 } else { 1.0 });
        special.turns_b.set(place, if b.is_round { 0.0 } else { 1.0 });
        self.is_special |= a.is_round || b.is_round;
        columns.friction.set(place, contact.friction);
        columns.normal.store(place, contact.manifold.normal.into());
        // A spin of 0 stays 0, and not -0, where nothing can change it.
        let is_still = |motion: &Motion| {
            motion.inverse_inertia == 0.0
                && bodies.states[motion.row as usize].angular_velocity.to_bits() == 0
        };
        self.fit.is_still &= is_still(a) && is_still(b);
        self.fit.is_single &= contact.manifold.points().len() < 2;
        self.fit.is_smooth &= contact.friction == 0.0;
        let mut is_loaded = false;
        let mut points = contact.manifold.points().iter();
        for (to, friction) in columns.points.iter_mut().zip(&mut columns.frictions) {
            let (point, k) = points.next().map_or((ManifoldPoint::default(), 0.0), |point| (*point, THERE));
            is_loaded |= point.normal_impulse > 0.0;
            to.anchor_a.store(place, point.anchor_a.into());
            to.anchor_b.store(place, point.anchor_b.into());
            to.separation.set(place, point.separation);
            to.normal_k.set(place, k);
            to.normal_impulse.set(place, scale * point.normal_impulse);
            friction.impulse.set(place, scale * point.tangent_impulse);
            // The warm start of a block whose contacts have one point each finds that of the first only.
            friction.normal_share.set(place, 0.0);
            // What friction did before it ceased is still to be taken back.
            self.fit.is_smooth &= point.tangent_impulse == 0.0;
        }
        let rests = contact.is_kept && is_loaded;
        let is_plain = rests && contact.restitution == 0.0 && !a.is_round && !b.is_round;
        self.lively.set(place, !is_plain);
    }

    /// Finds the effective masses.
    #[inline(always)]
    pub(crate) fn find_masses<L: Lane>(&mut self, place: usize) {
        if self.fit.is_single {
            self.columns.coupling = Column::default();
            self.columns.frictions[1].mass = Column::default();
            self.find_masses_of::<L, 1>(place);
        } else {
            self.find_masses_of::<L, 2>(place);
        }
    }

    #[inline(always)]
    fn find_masses_of<L: Lane, const POINTS: usize>(&mut self, place: usize) {
        let mut constraint = self.load::<L>(place);
        constraint.find_masses::<POINTS>();
        for index in 0..POINTS {
            constraint.points[index].normal_k.store(&mut self.columns.points[index].normal_k, place);
            constraint.frictions[index].mass.store(&mut self.columns.frictions[index].mass, place);
        }
        if POINTS == 2 {
            constraint.coupling.store(&mut self.columns.coupling, place);
        }
    }

    /// Finds where the points are at the end of the step.
    #[inline(always)]
    pub(crate) fn end<L: Lane>(&self, place: usize, states: &[BodyState], ends: &mut [PointEnds; 2]) {
        let constraint = self.load::<L>(place);
        let [a, b] = self.gather(states, place);
        for (point, end) in constraint.points.iter().zip(ends) {
            constraint.separation(point, &a, &b).store(&mut end.separation, place);
            let approach = -constraint.normal.dot(point.relative_velocity(&a, &b));
            approach.store(&mut end.approach_speed, place);
            let [tip_a, tip_b] = constraint.turned(point, &a, &b);
            end.anchor_a.store(place, point.anchor_a + tip_a);
            end.anchor_b.store(place, point.anchor_b + tip_b);
        }
    }

    /// Writes impulses and separations back into a contact; adds what is left wrong to `residual`. Returns the
    /// greatest k λ of its points, m/s.
    pub(crate) fn finish(
        &self,
        place: usize,
        ends: &[PointEnds; 2],
        contact: &mut Contact,
        residual: &mut StepResidual,
    ) -> f32 {
        let mut load: f32 = 0.0;
        if contact.follows {
            contact.manifold.normal = self.columns.normal.load::<f32>(place).into();
        }
        for (index, stored) in contact.manifold.points_mut().iter_mut().enumerate() {
            let (point, end) = (&self.columns.points[index], &ends[index]);
            let separation = end.separation.get(place);
            stored.separation = separation;
            // What follows is there already.
            let [anchor_a, anchor_b] =
                if contact.follows { [point.anchor_a, point.anchor_b] } else { [end.anchor_a, end.anchor_b] };
            stored.anchor_a = anchor_a.load::<f32>(place).into();
            stored.anchor_b = anchor_b.load::<f32>(place).into();
            stored.normal_impulse = point.normal_impulse.get(place);
            stored.tangent_impulse = self.columns.frictions[index].impulse.get(place);
            residual.penetration = residual.penetration.max(-separation);
            load = load.max(point.normal_k.get(place) * stored.normal_impulse);
            if separation <= 0.0 && self.columns.special.awaits_impact[index].get(place) == 0.0 {
                residual.approach_speed = residual.approach_speed.max(end.approach_speed.get(place));
            }
        }
        load
    }

    /// What none of the contacts needs.
    #[inline(always)]
    pub(crate) fn fit(&self) -> Fit {
        self.fit
    }

    /// The contacts that may bounce, follow the surface, begin to bear load or be handed over: all but those of bodies
    /// that rest on each other, without restitution and without a circle.
    pub(crate) fn lively(&self) -> Marks {
        self.lively
    }

    /// Whether a contact presses its bodies apart, and had no impulses to start this substep from.
    pub(crate) fn is_newly_loaded(&self, place: usize) -> bool {
        let ContactConstraint { points, frictions, .. } = &self.columns;
        points.iter().any(|point| point.normal_impulse.get(place) > 0.0)
            && frictions.iter().all(|friction| friction.normal_share.get(place) == 0.0)
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

    /// Writes normal and points back.
    #[inline(always)]
    pub(crate) fn store_geometry<L: Lane>(&mut self, place: usize, constraint: &ContactConstraint<L>) {
        if self.fit.is_single {
            self.columns.store_geometry::<L, 1>(place, constraint);
        } else {
            self.columns.store_geometry::<L, 2>(place, constraint);
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

    /// Writes the shares of the warm start, of the first points.
    #[inline(always)]
    pub(crate) fn store_shares<L: Lane, const POINTS: usize>(
        &mut self,
        place: usize,
        constraint: &ContactConstraint<L>,
    ) {
        for (to, friction) in self.columns.frictions.iter_mut().zip(&constraint.frictions).take(POINTS) {
            friction.normal_share.store(&mut to.normal_share, place);
        }
    }

    /// Changes the impulses of a point of one contact, N s, along normal and tangent.
    pub(crate) fn set_impulses(&mut self, place: usize, point: usize, [normal, tangent]: [f32; 2]) {
        self.columns.points[point].normal_impulse.set(place, normal);
        self.columns.frictions[point].impulse.set(place, tangent);
        self.fit.is_smooth &= tangent == 0.0;
    }

    /// Changes what the first point of one contact bears, N s: its impulses along normal and tangent, and the share
    /// of the warm start along the normal.
    pub(crate) fn set_load(&mut self, place: usize, [normal, tangent, normal_share]: [f32; 3]) {
        self.columns.points[0].normal_impulse.set(place, normal);
        self.columns.frictions[0].impulse.set(place, tangent);
        self.columns.frictions[0].normal_share.set(place, normal_share);
        self.fit.is_smooth &= tangent == 0.0;
    }

    /// Has the sweeps heed the points of one contact again or not.
    pub(crate) fn set_awaits_impact(&mut self, place: usize, awaits: [f32; 2]) {
        for (to, awaits) in self.columns.special.awaits_impact.iter_mut().zip(awaits) {
            to.set(place, awaits);
        }
        self.is_special = true;
    }

    /// The rows of the two bodies of one contact.
    pub(crate) fn rows(&self, place: usize) -> [u32; 2] {
        self.rows.get(place)
    }

    /// The same, with the ground's in the place of a body that contacts do not move.
    pub(crate) fn moved_rows(&self, place: usize) -> [u32; 2] {
        let row_if = |moves: bool, row: u32| if moves { row } else { GROUND_ROW };
        let [row_a, row_b] = self.rows(place);
        let columns = &self.columns;
        [
            row_if(columns.inverse_mass_a.get(place) > 0.0, row_a),
            row_if(columns.inverse_mass_b.get(place) > 0.0, row_b),
        ]
    }

    /// The states of the two bodies of each contact from `place` on.
    #[inline(always)]
    pub(crate) fn gather<L: Lane>(&self, states: &(impl Rows + ?Sized), place: usize) -> [BodyState<L>; 2] {
        L::gather(states, &self.rows, place)
    }

    /// The same where only velocities are needed.
    #[inline(always)]
    pub(crate) fn gather_velocities<L: Lane>(
        &self,
        states: &(impl Rows + ?Sized),
        place: usize,
    ) -> [BodyState<L>; 2] {
        L::gather_velocities(states, &self.rows, place)
    }

    /// Writes velocities back, but for bodies that contacts do not move: those may be in more than one contact.
    #[inline(always)]
    pub(crate) fn scatter<L: Lane>(
        &self,
        states: &Shared<'_, BodyState>,
        place: usize,
        pair: &[BodyState<L>; 2],
    ) {
        let zero = L::splat(0.0);
        let a_moves = L::load(&self.columns.inverse_mass_a, place).greater(zero);
        let b_moves = L::load(&self.columns.inverse_mass_b, place).greater(zero);
        L::scatter_velocities(states, &self.rows, place, pair, [a_moves, b_moves]);
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
            normal_share: L::load(&self.normal_share, place),
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
}

impl ConstraintPoint<Column> {
    #[inline(always)]
    fn load<L: Lane>(&self, place: usize) -> ConstraintPoint<L> {
        ConstraintPoint {
            anchor_a: self.anchor_a.load(place),
            anchor_b: self.anchor_b.load(place),
            separation: L::load(&self.separation, place),
            normal_k: L::load(&self.normal_k, place),
            normal_impulse: L::load(&self.normal_impulse, place),
        }
    }
}
