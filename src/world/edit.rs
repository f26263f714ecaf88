//! Adding and removing: bodies, forces, attractors.

use crate::body::{Body, BodyError, BodyId, BodyType, Mixed};
use crate::math::Vec2;
use crate::world::events::ContactEvent;
use crate::world::{Attractor, AttractorId, BodyRef, Force, ForceId, Tier, World};

impl World {
    /// Adds a body.
    ///
    /// # Errors
    /// [`BodyError`], if a number of the description or its shape is NaN, infinite or out of range. A dynamic body must weigh
    /// 10⁻¹² to 10¹⁵ kg and have a moment of inertia of 10⁻¹⁸ to 10²⁵ kg m². The world is as it was then.
    #[expect(clippy::needless_pass_by_value, reason = "reads as giving the body to the world")]
    pub fn add(&mut self, body: Body) -> Result<BodyId, BodyError> {
        body.validate()?;
        let id = self.bodies.insert(&body);
        let slot = id.0.index();
        self.cut_velocity(slot);
        for collider in self.bodies.colliders(slot) {
            let is_movable = body.body_type != BodyType::Fixed;
            self.broad_phase.add(collider, is_movable, self.bodies.aabb(collider));
        }
        self.update_box(slot);
        self.note_ground(slot);
        Ok(id)
    }

    /// Lets the fat boxes of a body follow an edit of its pose or velocity: they must hold where its shapes will be after the
    /// next step, or what is fast would pass through what is near.
    pub(in crate::world) fn update_box(&mut self, slot: u32) {
        let dt = self.settings.tick_seconds() as f32;
        self.bodies.motions[slot as usize].room =
            if self.bodies.is_compound(slot) { f32::INFINITY } else { 0.0 };
        self.sensors.note_edit();
        self.bodies.place_colliders(slot);
        for collider in self.bodies.colliders(slot) {
            let motion = self.bodies.velocity_of_shape(collider) * dt;
            self.broad_phase.update(collider, self.bodies.aabb(collider), motion);
        }
    }

    /// The same of a body that may be ground, and was put elsewhere or is of other shapes.
    pub(in crate::world) fn update_place(&mut self, slot: u32) {
        self.note_ground(slot);
        self.update_box(slot);
        self.note_ground(slot);
    }

    /// Cuts the velocities of a body that were set by hand, so that all that is computed with them is finite.
    pub(in crate::world) fn cut_velocity(&mut self, slot: u32) {
        let row = self.bodies.motions[slot as usize].row;
        self.settings.speed_limits().cut(&mut self.bodies.states[row as usize]);
    }

    /// If the body in a slot is kinematic and moves, wakes the bodies that are joined to it. Those that it touches are woken as contacts are found.
    pub(in crate::world) fn wake_what_is_led_by(&mut self, slot: u32) {
        if !self.bodies.is_dynamic(slot) && self.bodies.state(slot).is_moving() {
            while let Some(led) = self.joints.sleeping_beside(slot, &self.bodies) {
                self.wake_slot(led);
            }
        }
    }

    /// Removes a body and returns its description as of now, or `None` if it was removed before. Other ids
    /// stay valid; what it touched wakes.
    pub fn remove(&mut self, id: BodyId) -> Option<Body> {
        if !self.bodies.has(id) {
            return None;
        }
        let slot = id.0.index();
        self.wake_slot(slot);
        self.wake_neighbours(slot);
        self.remove_joints_of(id);
        self.note_ground(slot);
        let contacts: Vec<u32> = self.contacts.of_body(&self.bodies, slot).collect();
        for index in contacts {
            self.end_contact(index);
        }
        for collider in self.bodies.colliders(slot) {
            self.candidates.note_removed(collider);
            self.broad_phase.remove(collider);
        }
        self.graph.set_tier(slot, Tier::Swept);
        self.tiers.forget(slot);
        self.loads.forget_body(slot);
        let removed = self.bodies.remove(id.0);
        self.note_removal();
        self.sensors.note_edit();
        // A step that removes what left the bounds does so at its end.
        if !self.is_within_step {
            self.give_back_memory();
        }
        removed
    }

    /// Removes all bodies. Settings, forces and attractors stay, and so does the time.
    pub fn clear(&mut self) {
        self.retain(|_| false);
    }

    /// Removes the bodies for which `keeps` is false, in the order of [`bodies`](Self::bodies). What they touched wakes.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// world.retain(|body| body.position().y > -100.0);
    /// ```
    pub fn retain(&mut self, mut keeps: impl FnMut(BodyRef<'_>) -> bool) {
        let goes = self.bodies().filter(|&(_, body)| !keeps(body));
        let gone: Vec<BodyId> = goes.map(|(id, _)| id).collect();
        for id in gone {
            self.remove(id);
        }
    }

    /// Ends a contact everywhere: graph, lists, pair set.
    pub(in crate::world) fn end_contact(&mut self, index: u32) {
        self.graph.leave(&self.contacts, index);
        let contact = self.contacts.end(&mut self.bodies, index);
        let [a, b] = contact.colliders;
        self.broad_phase.forget_pair(a, b);
        if contact.is_touching {
            let [a, b] = contact.slots.map(|slot| self.id_of(slot));
            let colliders = contact.colliders.map(|slot| self.collider_id(slot));
            self.events.ended_by_edit.push(ContactEvent { a, b, colliders, tick: self.next_tick() });
        }
    }

    /// The coefficients of a contact between two shapes.
    pub(in crate::world) fn mixed(&self, colliders: [u32; 2]) -> Mixed {
        self.settings.mixes().of(&self.bodies, colliders)
    }

    /// Mixes the coefficients of the contacts with these indices anew.
    fn mix(&mut self, indices: Vec<u32>) {
        for index in indices {
            let mixed = self.mixed(self.contacts[index].colliders);
            self.contacts[index].mixed = mixed;
        }
    }

    /// Mixes the coefficients of all contacts anew.
    pub(in crate::world) fn mix_all(&mut self) {
        let all = self.contacts.iter().map(|(index, _)| index).collect();
        self.mix(all);
    }

    /// Mixes the coefficients of the contacts of one body anew.
    pub(in crate::world) fn mix_body(&mut self, slot: u32) {
        let of_body = self.contacts.of_body(&self.bodies, slot).collect();
        self.mix(of_body);
    }

    /// Adds a force; it acts from the next step on. Wakes all bodies.
    pub fn add_force(&mut self, force: Force) -> ForceId {
        let key = self.forces.insert(force);
        self.forces_changed();
        ForceId(key)
    }

    /// Removes a force and returns it, or `None` if it was removed before. Wakes all bodies.
    pub fn remove_force(&mut self, id: ForceId) -> Option<Force> {
        let force = self.forces.remove(id.0)?;
        self.forces_changed();
        Some(force)
    }

    /// The force with this id, or `None` if it has been removed.
    pub fn force(&self, id: ForceId) -> Option<&Force> {
        self.forces.get(id.0)
    }

    /// Every force.
    pub fn forces(&self) -> impl Iterator<Item = (ForceId, &Force)> {
        self.forces.iter().map(|(key, force)| (ForceId(key), force))
    }

    /// The sum of all forces, m/s².
    pub fn acceleration(&self) -> Vec2 {
        self.acceleration
    }

    fn forces_changed(&mut self) {
        self.acceleration = self.forces.iter().fold(Vec2::ZERO, |sum, (_, force)| sum + force.acceleration());
        self.wake_all();
    }

    /// Adds an attractor; it pulls from the next step on. Wakes all bodies.
    pub fn add_attractor(&mut self, attractor: Attractor) -> AttractorId {
        let key = self.attractors.insert(attractor);
        self.wake_all();
        AttractorId(key)
    }

    /// Removes an attractor and returns it, or `None` if it was removed before. Wakes all bodies.
    pub fn remove_attractor(&mut self, id: AttractorId) -> Option<Attractor> {
        let attractor = self.attractors.remove(id.0)?;
        self.wake_all();
        Some(attractor)
    }

    /// Puts another attractor in the place of the one with this id, and returns that, or `None` (and does
    /// nothing) if it has been removed. Wakes all bodies.
    pub fn replace_attractor(&mut self, id: AttractorId, attractor: Attractor) -> Option<Attractor> {
        let replaced = std::mem::replace(self.attractors.get_mut(id.0)?, attractor);
        self.wake_all();
        Some(replaced)
    }

    /// The attractor with this id, or `None` if it has been removed.
    pub fn attractor(&self, id: AttractorId) -> Option<&Attractor> {
        self.attractors.get(id.0)
    }

    /// Every attractor.
    pub fn attractors(&self) -> impl Iterator<Item = (AttractorId, &Attractor)> {
        self.attractors.iter().map(|(key, attractor)| (AttractorId(key), attractor))
    }
}
