//! The begin of the step: contacts made into the constraints of a block.

use crate::body::{Bodies, Motion};
use crate::collision::{Contact, Contacts, Manifold};
use crate::compute::{COLUMN, Columns, GROUND_ROW, Lane, RowPairs};
use crate::resolution::asked::Asked;
use crate::resolution::constraint::{ConstraintPoint, ContactConstraint, THERE, Turns};
use crate::resolution::contact_block::{BlockMarks, ContactBlock, Fit};
use crate::resolution::moving_geometry::MovingGeometry;
use crate::resolution::rolling::{Rolling, rolling_arm};

/// What constraints are made from as a step begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beginning<'a> {
    pub(crate) contacts: &'a Contacts,
    pub(crate) bodies: &'a Bodies,
    /// Length of the step, s.
    pub(crate) dt: f32,
    /// Whose impulses are added up over the step.
    pub(crate) asked: Asked,
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

impl ContactConstraint<f32> {
    /// That of a manifold between two bodies, but for the effective masses of the points that are there.
    #[inline(always)]
    pub(crate) fn new(manifold: &Manifold, friction: f32, [a, b]: [&Motion; 2]) -> Self {
        let turns = |motion: &Motion| if motion.is_round { 0.0 } else { 1.0 };
        let mut constraint = Self {
            inverse_mass_a: a.inverse_mass,
            inverse_mass_b: b.inverse_mass,
            inverse_inertia_a: a.inverse_inertia,
            inverse_inertia_b: b.inverse_inertia,
            normal: manifold.normal.into(),
            friction,
            turns: Turns { a: turns(a), b: turns(b) },
            ..Self::default()
        };
        let places = constraint.points.iter_mut().zip(&mut constraint.frictions);
        let places = places.zip(&mut constraint.lasting_impulses);
        for (((to, friction), lasting_impulse), point) in places.zip(manifold.points()) {
            *to = ConstraintPoint {
                anchor_a: point.anchor_a.into(),
                anchor_b: point.anchor_b.into(),
                separation: point.separation,
                separation_now: point.separation,
                normal_k: THERE,
                normal_impulse: point.normal_impulse,
            };
            friction.impulse = point.tangent_impulse;
            friction.warm_start = point.warm_start();
            *lasting_impulse = point.lasting_impulse;
        }
        constraint
    }
}

impl ContactBlock {
    /// Takes over the first contacts of a `list` sorted by kind, as many as there are places. Effective masses are still to
    /// be found, and which bodies are moved.
    pub(crate) fn fill(&mut self, rows: &mut RowPairs, list: &[u32], from: Beginning<'_>) {
        let indices = &list[..list.len().min(COLUMN)];
        let mut rows_of_bodies = [[GROUND_ROW; COLUMN]; 2];
        self.has_circles = false;
        self.surface_speeds.end_use();
        self.rolling.end_use();
        (self.fit, self.marks) = (Fit::ALL, BlockMarks::default());
        // Those of one point come first.
        let last = indices.last().map(|&index| &from.contacts[index]);
        self.fit.is_single = last.is_none_or(|last| last.manifold.points().len() < 2);
        for (place, &index) in indices.iter().enumerate() {
            from.contacts.prefetch_solved(from.bodies, list, place);
            self.put(place, &mut rows_of_bodies, &from.contacts[index], from);
        }
        // What is left over from other contacts bears nothing and moves nothing.
        for place in indices.len()..COLUMN {
            self.columns.store::<f32>(place, ContactConstraint::default());
        }
        *rows = RowPairs::new(rows_of_bodies);
    }

    #[inline(always)]
    fn put(
        &mut self,
        place: usize,
        [rows_a, rows_b]: &mut [[u32; COLUMN]; 2],
        contact: &Contact,
        from: Beginning<'_>,
    ) {
        let bodies = from.bodies;
        let motions = contact.colliders.map(|slot| &bodies.motions[slot as usize]);
        let [a, b] = motions;
        (rows_a[place], rows_b[place]) = (a.row, b.row);
        let constraint = ContactConstraint::new(&contact.manifold, contact.mixed.friction, motions);
        self.columns.store::<f32>(place, constraint);
        self.has_circles |= a.is_round | b.is_round;
        // A spin of 0 stays 0, and not -0, where nothing can change it.
        let is_still = |motion: &Motion| {
            motion.inverse_inertia == 0.0
                && bodies.states[motion.row as usize].angular_velocity.to_bits() == 0
        };
        self.fit.is_still = self.fit.is_still && is_still(a) && is_still(b);
        // What friction did before it ceased is still to be taken back.
        let has_friction = constraint.friction > 0.0;
        self.fit.is_smooth &= !has_friction && constraint.frictions.iter().all(|point| point.impulse == 0.0);
        let [first, second] = constraint.points;
        let is_unloaded = first.normal_impulse == 0.0 && second.normal_impulse == 0.0;
        self.marks.cold.set(place, second.normal_k > 0.0 && has_friction && is_unloaded);
        self.marks.bouncy.set(place, contact.mixed.restitution > 0.0);
        if from.asked.about(contact) {
            self.marks.asked.set(place, true);
        }
        self.marks.on_ground.set(place, is_circle_on_ground(motions));
        if let Some(speed) = bodies.roles.surface_speed(contact.colliders) {
            self.surface_speeds.begin_use().set(place, speed);
        }
        if let Some(arm) = rolling_arm(contact, motions) {
            let rolling = Rolling { arm, moment: contact.rolling_moment, acted: 0.0 };
            self.rolling.begin_use().store::<f32>(place, rolling);
        }
        if contact.follows {
            self.put_moving(place, contact, from);
        }
    }

    /// Takes up the geometry of a contact that moves within the step.
    fn put_moving(&mut self, place: usize, contact: &Contact, from: Beginning<'_>) {
        if let Some(geometry) = MovingGeometry::new(contact, from.bodies, from.dt) {
            self.geometry.get_or_insert_default().store::<f32>(place, geometry);
            self.marks.moving.set(place, true);
        } else {
            self.marks.found_anew.set(place, true);
        }
    }

    /// Finds the effective masses, and which bodies are moved.
    #[inline(always)]
    pub(crate) fn find_masses<L: Lane>(&mut self, rows: &mut RowPairs, place: usize) {
        let mut constraint = self.load::<L>(place);
        rows.set_moves(place, [constraint.inverse_mass_a, constraint.inverse_mass_b]);
        if self.fit.is_single {
            constraint.find_masses::<1>();
        } else {
            constraint.find_masses::<2>();
        }
        self.store_masses(place, &constraint);
    }
}
