//! Changes of what a body is, in place: its id, its contacts and what they bear stay, as far as they still make sense.
//!
//! Each is made by way of the body's description, which is checked as a whole, and so refused as a whole.

use crate::body::{Body, BodyError, BodyId, BodyType, Material};
use crate::resolution::{Connections, find_island};
use crate::shape::Shape;
use crate::store::BitSet;
use crate::world::{BodyMut, Tier, World};

impl BodyMut<'_> {
    /// Makes the body dynamic, fixed or kinematic. One that becomes fixed stops; what rested on one that becomes dynamic
    /// falls with it.
    ///
    /// # Errors
    /// [`BodyError`], if it becomes dynamic and its mass or moment of inertia are not those of a dynamic body, as
    /// [`World::add`] tells.
    pub fn set_body_type(&mut self, body_type: BodyType) -> Result<(), BodyError> {
        self.change(|body| body.body_type = body_type)
    }

    /// Gives the body another shape, about the same centre of mass; one of several shapes gets another own shape. Its mass follows from
    /// density and area, unless it was [given](Self::set_mass).
    ///
    /// # Errors
    /// [`BodyError`], if the shape is one that [`World::add`] refuses, or gives a dynamic body such a mass.
    pub fn set_shape(&mut self, shape: Shape) -> Result<(), BodyError> {
        self.change(|body| body.shape = shape)
    }

    /// Gives the body a mass, kg, or, by `None`, the one that follows from density and area. The moment of inertia scales
    /// with it.
    ///
    /// # Errors
    /// [`BodyError`], if the mass or the moment of inertia is one that [`World::add`] refuses.
    pub fn set_mass(&mut self, mass: impl Into<Option<f32>>) -> Result<(), BodyError> {
        let mass = mass.into();
        self.change(|body| body.mass = mass)
    }

    /// Sets the mass per area, kg/m², of all its shapes. A mass that was [given](Self::set_mass) stays.
    ///
    /// # Errors
    /// [`BodyError`], if the density, or the mass by it, is one that [`World::add`] refuses.
    pub fn set_density(&mut self, density: f32) -> Result<(), BodyError> {
        self.change(|body| {
            body.material.density = density;
            body.further.iter_mut().for_each(|collider| *collider = collider.density(density));
        })
    }

    /// Sets density, friction and restitution of all its shapes. A mass that was [given](Self::set_mass) stays.
    ///
    /// # Errors
    /// [`BodyError`], if a number, or the mass by the density, is one that [`World::add`] refuses.
    pub fn set_material(&mut self, material: Material) -> Result<(), BodyError> {
        self.change(|body| {
            body.material = material;
            body.further.iter_mut().for_each(|collider| *collider = collider.material(material));
        })
    }

    /// Sets whether the body never turns. One that turns stops to.
    pub fn set_fixed_rotation(&mut self, fixed: bool) {
        let changed = self.change(|body| body.fixed_rotation = fixed);
        debug_assert!(changed.is_ok(), "{changed:?}");
    }

    /// Puts the body to sleep, with all that contacts connect with it: they stop where they are, whatever pulls at them, until
    /// something wakes them. Returns whether it sleeps now: not if it is fixed or kinematic, if one of them
    /// [may not](Self::set_may_sleep), or if a kinematic body that moves touches them.
    pub fn sleep(&mut self) -> bool {
        self.world.put_island_to_sleep(self.slot())
    }

    fn change(&mut self, change: impl FnOnce(&mut Body)) -> Result<(), BodyError> {
        let mut body = self.describe();
        change(&mut body);
        body.validate()?;
        if body != self.describe() {
            self.world.redescribe(self.id, &body);
        }
        Ok(())
    }
}

impl World {
    /// Makes a body what a valid description says, but for its pose and velocity, and lets every table know.
    fn redescribe(&mut self, id: BodyId, body: &Body) {
        let slot = id.0.index();
        self.wake_slot(slot);
        self.wake_neighbours(slot);
        // The graph knows contacts by which of their bodies move: they leave it before that changes.
        let contacts: Vec<u32> = self.contacts.of_body(&self.bodies, slot).collect();
        for &index in &contacts {
            self.graph.leave(&self.contacts, index);
        }
        self.note_ground(slot);
        let (old_type, old_mass) = (self.bodies.records[slot].body_type, self.bodies.records[slot].mass);
        self.bodies.redescribe(slot, body);
        if body.body_type == old_type {
            self.update_box(slot);
        } else {
            self.type_changed(slot, old_type);
        }
        self.note_ground(slot);
        // Contacts begin with the impulses they had: those that bore a heavy body would throw a light one.
        let share = (body.masses().mass / old_mass).min(1.0);
        for index in contacts {
            let slots = self.contacts[index].slots;
            if slots.iter().any(|&slot| self.bodies.is_dynamic(slot)) {
                self.contacts.fit_to_bodies(&self.bodies, index, share);
                self.loads.forget_contact(index);
                self.contacts.set_awake(index);
                if !self.contacts[index].manifold.points().is_empty() {
                    self.graph.enter(&self.contacts, &self.bodies, index);
                }
            } else {
                self.end_contact(index);
            }
        }
        self.mix_body(slot);
    }

    /// Has pairs of a body looked for anew: others count than before, in another tree.
    fn type_changed(&mut self, slot: u32, old_type: BodyType) {
        let is_movable = |body_type| body_type != BodyType::Fixed;
        let body_type = self.bodies.records[slot].body_type;
        for collider in self.bodies.colliders(slot) {
            if is_movable(body_type) == is_movable(old_type) {
                self.broad_phase.mark_moved(collider);
            } else {
                self.broad_phase.remove(collider);
                self.broad_phase.add(collider, is_movable(body_type), self.bodies.aabb(collider));
            }
            self.candidates.note_removed(collider);
        }
        self.update_box(slot);
        if body_type != BodyType::Dynamic {
            self.graph.set_tier(slot, Tier::Swept);
            self.tiers.forget(slot);
            self.loads.forget_body(slot);
        }
    }

    /// Puts the island of a body to sleep, if it may; returns whether it sleeps.
    fn put_island_to_sleep(&mut self, slot: u32) -> bool {
        if !self.bodies.is_dynamic(slot) || !self.bodies.is_awake(slot) {
            return self.bodies.is_dynamic(slot);
        }
        // A pair that is found later would wake it.
        if self.broad_phase.moved_count() > 0 {
            self.find_pairs();
        }
        let (mut island, bodies) = (Vec::new(), &self.bodies);
        let mut is_moved = false;
        let all = Connections { contacts: &self.contacts, joints: &self.joints };
        find_island(slot, bodies, all, &mut BitSet::default(), &mut island, |_, contact| {
            let moves = |slot: u32| !bodies.is_dynamic(slot) && bodies.state(slot).is_moving();
            is_moved |= contact.slots.into_iter().any(moves);
        });
        // A contact with points wakes what sleeps.
        debug_assert!(island.iter().all(|&slot| bodies.is_awake(slot)), "half an island sleeps");
        for &slot in &island {
            is_moved |= self.joints.is_led(slot, bodies);
        }
        let may_sleep = island.iter().all(|&slot| bodies.motions[slot as usize].may_sleep);
        if is_moved || !may_sleep {
            return false;
        }
        for &slot in &island {
            self.bodies.forcings[slot as usize].end_step();
        }
        island.sort_unstable();
        let (sleepers, mut tables) = self.sleep_tables();
        sleepers.lay_down(&mut tables, island);
        self.begin_contacts();
        true
    }
}
