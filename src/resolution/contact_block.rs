//! How contacts are stored while a step is solved: eight to a block, column by column, so that lanes of any width
//! load and store them without turning rows into columns.

use crate::body::Bodies;
use crate::collision::Contact;
use crate::compute::{BodyState, Column, GROUND_ROW, Lane};
use crate::resolution::constraint::{ConstraintPoint, ContactConstraint};

/// Eight contacts. Those of one colour share no movable body; a block that is not full ends with contacts of the
/// ground with itself, without points.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactBlock {
    pub(crate) rows_a: Column<u32>,
    pub(crate) rows_b: Column<u32>,
    columns: ContactConstraint<Column>,
}

impl ContactBlock {
    /// Puts a contact at `place`.
    pub(crate) fn put(&mut self, place: usize, contact: &Contact, bodies: &Bodies, scale: f32) {
        let [row_a, row_b] = contact.slots.map(|slot| bodies.motions[slot as usize].row);
        self.rows_a.set(place, row_a);
        self.rows_b.set(place, row_b);
        self.columns.store(place, &ContactConstraint::new(contact, bodies, scale));
    }

    /// The contacts from `place` on, a multiple of the lane's width.
    #[inline(always)]
    pub(crate) fn load<L: Lane>(&self, place: usize) -> ContactConstraint<L> {
        self.columns.load(place)
    }

    /// Writes normals and points back.
    #[inline(always)]
    pub(crate) fn store_geometry<L: Lane>(&mut self, place: usize, constraint: &ContactConstraint<L>) {
        self.columns.store_geometry(place, constraint);
    }

    /// Writes impulses back.
    #[inline(always)]
    pub(crate) fn store_impulses<L: Lane>(&mut self, place: usize, constraint: &ContactConstraint<L>) {
        for (to, point) in self.columns.points.iter_mut().zip(&constraint.points) {
            point.normal_impulse.store(&mut to.normal_impulse, place);
            point.tangent_impulse.store(&mut to.tangent_impulse, place);
        }
    }

    /// Writes the shares of the warm start.
    #[inline(always)]
    pub(crate) fn store_shares<L: Lane>(&mut self, place: usize, constraint: &ContactConstraint<L>) {
        for (to, point) in self.columns.points.iter_mut().zip(&constraint.points) {
            point.normal_share.store(&mut to.normal_share, place);
        }
    }

    /// Changes what the first point of one contact bears, N s: its impulses along normal and tangent, and the share
    /// of the warm start along the normal.
    pub(crate) fn set_load(&mut self, place: usize, [normal, tangent, normal_share]: [f32; 3]) {
        let point = &mut self.columns.points[0];
        point.normal_impulse.set(place, normal);
        point.tangent_impulse.set(place, tangent);
        point.normal_share.set(place, normal_share);
    }

    /// Has the sweeps heed the points of one contact again or not.
    pub(crate) fn set_awaits_impact(&mut self, place: usize, awaits: [f32; 2]) {
        for (to, awaits) in self.columns.points.iter_mut().zip(awaits) {
            to.awaits_impact.set(place, awaits);
        }
    }

    /// The rows of the two bodies of one contact.
    pub(crate) fn rows(&self, place: usize) -> [u32; 2] {
        [self.rows_a.get(place), self.rows_b.get(place)]
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
    pub(crate) fn gather<L: Lane>(&self, states: &[BodyState], place: usize) -> [BodyState<L>; 2] {
        [L::gather(states, &self.rows_a, place), L::gather(states, &self.rows_b, place)]
    }

    /// The same where only velocities are needed.
    #[inline(always)]
    pub(crate) fn gather_velocities<L: Lane>(&self, states: &[BodyState], place: usize) -> [BodyState<L>; 2] {
        [L::gather_velocities(states, &self.rows_a, place), L::gather_velocities(states, &self.rows_b, place)]
    }

    /// Writes velocities back, but for bodies that contacts do not move: those may be in more than one contact.
    #[inline(always)]
    pub(crate) fn scatter<L: Lane>(
        &self,
        states: &mut [BodyState],
        place: usize,
        [a, b]: &[BodyState<L>; 2],
    ) {
        let moves_a = L::load(&self.columns.inverse_mass_a, place).greater(L::splat(0.0));
        let moves_b = L::load(&self.columns.inverse_mass_b, place).greater(L::splat(0.0));
        L::scatter_velocities(states, &self.rows_a, place, a, moves_a);
        L::scatter_velocities(states, &self.rows_b, place, b, moves_b);
    }
}

impl ContactConstraint<Column> {
    #[inline(always)]
    fn load<L: Lane>(&self, place: usize) -> ContactConstraint<L> {
        ContactConstraint {
            inverse_mass_a: L::load(&self.inverse_mass_a, place),
            inverse_mass_b: L::load(&self.inverse_mass_b, place),
            inverse_inertia_a: L::load(&self.inverse_inertia_a, place),
            inverse_inertia_b: L::load(&self.inverse_inertia_b, place),
            turns_a: L::load(&self.turns_a, place),
            turns_b: L::load(&self.turns_b, place),
            normal: self.normal.load(place),
            friction: L::load(&self.friction, place),
            coupling: L::load(&self.coupling, place),
            points: [self.points[0].load(place), self.points[1].load(place)],
        }
    }

    fn store(&mut self, place: usize, constraint: &ContactConstraint<f32>) {
        self.inverse_mass_a.set(place, constraint.inverse_mass_a);
        self.inverse_mass_b.set(place, constraint.inverse_mass_b);
        self.inverse_inertia_a.set(place, constraint.inverse_inertia_a);
        self.inverse_inertia_b.set(place, constraint.inverse_inertia_b);
        self.turns_a.set(place, constraint.turns_a);
        self.turns_b.set(place, constraint.turns_b);
        self.friction.set(place, constraint.friction);
        self.store_geometry(place, constraint);
        for (to, point) in self.points.iter_mut().zip(&constraint.points) {
            to.normal_impulse.set(place, point.normal_impulse);
            to.tangent_impulse.set(place, point.tangent_impulse);
            to.awaits_impact.set(place, point.awaits_impact);
        }
    }

    #[inline(always)]
    fn store_geometry<L: Lane>(&mut self, place: usize, constraint: &ContactConstraint<L>) {
        self.normal.store(place, constraint.normal);
        constraint.coupling.store(&mut self.coupling, place);
        for (to, point) in self.points.iter_mut().zip(&constraint.points) {
            to.anchor_a.store(place, point.anchor_a);
            to.anchor_b.store(place, point.anchor_b);
            point.separation.store(&mut to.separation, place);
            point.normal_k.store(&mut to.normal_k, place);
            point.tangent_mass.store(&mut to.tangent_mass, place);
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
            tangent_mass: L::load(&self.tangent_mass, place),
            normal_impulse: L::load(&self.normal_impulse, place),
            tangent_impulse: L::load(&self.tangent_impulse, place),
            normal_share: L::load(&self.normal_share, place),
            awaits_impact: L::load(&self.awaits_impact, place),
        }
    }
}
