//! The begin of the step: contacts made into the constraints of a block.

use crate::body::{Bodies, Motion};
use crate::collision::{Contact, Contacts, ManifoldPoint};
use crate::compute::{COLUMN, Column, Columns, GROUND_ROW, Lane, RowPairs};
use crate::resolution::constraint::{ConstraintPoint, ContactConstraint, THERE};
use crate::resolution::contact_block::{ContactBlock, Fit, Marks};
use crate::resolution::moving_geometry::MovingGeometry;

/// What constraints are made from as a step begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beginning<'a> {
    pub(crate) contacts: &'a Contacts,
    pub(crate) bodies: &'a Bodies,
    /// Length of a substep now over that of the substep that impulses were found in, no unit: they are multiplied by it.
    pub(crate) impulse_scale: f32,
    /// Length of the step, s.
    pub(crate) dt: f32,
}

/// What is special about the contacts of a block as a step begins.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct BlockStart {
    /// Those that may bounce.
    pub(crate) bouncy: Marks,
    /// Those of a circle with what does not move.
    pub(crate) on_ground: Marks,
    /// Those whose geometry moves within the step in closed form.
    pub(crate) moving: Marks,
    /// Those whose geometry moves within the step, and not in closed form.
    pub(crate) found_anew: Marks,
    /// Those of two points and with friction that bear no load yet.
    pub(crate) cold_contacts: Marks,
}

/// Whether one of two bodies is a circle that contacts move, and the other is not moved by them.
#[inline(always)]
fn is_circle_on_ground([a, b]: [&Motion; 2]) -> bool {
    match [a, b].map(|motion| motion.inverse_mass > 0.0) {
        [true, false] => a.is_round,
        [false, true] => b.is_round,
        _ => false,
    }
}

impl ContactBlock {
    /// Takes over the first contacts of a `list` sorted by kind, as many as there are places. Effective masses are still to
    /// be found, and which bodies are moved.
    pub(crate) fn fill(&mut self, rows: &mut RowPairs, list: &[u32], from: Beginning<'_>) -> BlockStart {
        let indices = &list[..list.len().min(COLUMN)];
        let mut rows_of_bodies = [[GROUND_ROW; COLUMN]; 2];
        self.has_circles = false;
        self.clear_pending();
        self.fit = Fit::ALL;
        let columns = &mut self.columns;
        columns.points[0].normal_k = Column::splat(THERE);
        for friction in &mut columns.frictions {
            // The warm start of a block whose contacts have one point each finds that of the first only.
            friction.warm_start = Column::default();
        }
        // Those of one point come first.
        let last = indices.last().map(|&index| &from.contacts[index]);
        self.fit.is_single = last.is_none_or(|last| last.manifold.points().len() < 2);
        if self.fit.is_single {
            self.columns.points[1] = ConstraintPoint::default();
            self.columns.frictions[1].impulse = Column::default();
        }
        let mut start = BlockStart::default();
        for (place, &index) in indices.iter().enumerate() {
            from.contacts.prefetch_solved(from.bodies, list, place);
            self.put(place, &mut rows_of_bodies, &from.contacts[index], from, &mut start);
        }
        for place in indices.len()..COLUMN {
            self.leave_empty(place);
        }
        *rows = RowPairs::new(rows_of_bodies);
        (self.cold_contacts, self.moving) = (start.cold_contacts, start.moving);
        start
    }

    /// Takes up the geometry of a contact that moves within the step.
    fn put_moving(&mut self, place: usize, contact: &Contact, from: Beginning<'_>, start: &mut BlockStart) {
        if let Some(geometry) = MovingGeometry::new(contact, from.bodies, from.dt) {
            self.geometry.get_or_insert_default().store::<f32>(place, geometry);
            start.moving.set(place, true);
        } else {
            start.found_anew.set(place, true);
        }
    }

    /// What is left over from another contact bears nothing and moves nothing.
    #[inline(always)]
    fn leave_empty(&mut self, place: usize) {
        let columns = &mut self.columns;
        for inverse in [&mut columns.inverse_mass_a, &mut columns.inverse_mass_b] {
            inverse.set(place, 0.0);
        }
        for (point, friction) in columns.points.iter_mut().zip(&mut columns.frictions) {
            point.normal_k.set(place, 0.0);
            point.normal_impulse.set(place, 0.0);
            friction.impulse.set(place, 0.0);
        }
    }

    #[inline(always)]
    fn put(
        &mut self,
        place: usize,
        [rows_a, rows_b]: &mut [[u32; COLUMN]; 2],
        contact: &Contact,
        from: Beginning<'_>,
        start: &mut BlockStart,
    ) {
        let Beginning { bodies, impulse_scale: scale, .. } = from;
        let [a, b] = contact.slots.map(|slot| &bodies.motions[slot as usize]);
        (rows_a[place], rows_b[place]) = (a.row, b.row);
        let columns = &mut self.columns;
        columns.inverse_mass_a.set(place, a.inverse_mass);
        columns.inverse_mass_b.set(place, b.inverse_mass);
        columns.inverse_inertia_a.set(place, a.inverse_inertia);
        columns.inverse_inertia_b.set(place, b.inverse_inertia);
        columns.turns.a.set(place, if a.is_round { 0.0 } else { 1.0 });
        columns.turns.b.set(place, if b.is_round { 0.0 } else { 1.0 });
        self.has_circles |= a.is_round | b.is_round;
        columns.friction.set(place, contact.friction);
        columns.normal.store(place, contact.manifold.normal.into());
        // A spin of 0 stays 0, and not -0, where nothing can change it.
        let is_still = |motion: &Motion| {
            motion.inverse_inertia == 0.0
                && bodies.states[motion.row as usize].angular_velocity.to_bits() == 0
        };
        self.fit.is_still = self.fit.is_still && is_still(a) && is_still(b);
        let points = contact.manifold.points();
        debug_assert!(points.len() < 2 || !self.fit.is_single, "those of one point come first");
        let Some(first) = points.first() else { return self.leave_empty(place) };
        self.put_point(0, place, first, scale);
        // What friction did before it ceased is still to be taken back.
        let mut is_smooth = contact.friction == 0.0 && first.tangent_impulse == 0.0;
        if !self.fit.is_single {
            let none = ManifoldPoint::default();
            let (k, second) = points.get(1).map_or((0.0, &none), |point| (THERE, point));
            self.columns.points[1].normal_k.set(place, k);
            self.put_point(1, place, second, scale);
            is_smooth &= second.tangent_impulse == 0.0;
            let begins = !contact.is_loaded() && points.len() == 2 && contact.friction > 0.0;
            start.cold_contacts.set(place, begins);
        }
        self.fit.is_smooth &= is_smooth;
        start.bouncy.set(place, contact.restitution > 0.0);
        start.on_ground.set(place, is_circle_on_ground([a, b]));
        if contact.follows {
            self.put_moving(place, contact, from, start);
        }
    }

    /// Takes over a point.
    #[inline(always)]
    fn put_point(&mut self, index: usize, place: usize, point: &ManifoldPoint, scale: f32) {
        let (to, friction) = (&mut self.columns.points[index], &mut self.columns.frictions[index]);
        to.anchor_a.store(place, point.anchor_a.into());
        to.anchor_b.store(place, point.anchor_b.into());
        to.separation.set(place, point.separation);
        to.normal_impulse.set(place, scale * point.normal_impulse);
        friction.impulse.set(place, scale * point.tangent_impulse);
    }

    /// Finds the effective masses, and which bodies are moved.
    #[inline(always)]
    pub(crate) fn find_masses<L: Lane>(&mut self, rows: &mut RowPairs, place: usize) {
        let ContactConstraint { inverse_mass_a, inverse_mass_b, .. } = &self.columns;
        rows.set_moves(place, [L::load(inverse_mass_a, place), L::load(inverse_mass_b, place)]);
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
            let columns = &mut self.columns.points[index];
            constraint.points[index].separation.store(&mut columns.separation_now, place);
            constraint.points[index].normal_k.store(&mut self.columns.points[index].normal_k, place);
            constraint.frictions[index].mass.store(&mut self.columns.frictions[index].mass, place);
        }
        if POINTS == 2 {
            constraint.coupling.store(&mut self.columns.coupling, place);
        }
    }
}
