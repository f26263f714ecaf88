//! A view of one of the shapes of a body, to change what it is made of and what it is to what it meets.
//!
//! [`BodyMut`](crate::BodyMut) changes all shapes of a body so.

use crate::body::limits::{
    check_friction, check_one_way, check_restitution, check_rolling_resistance, check_surface_speed,
};
use crate::body::{Bodies, BodyError, BodyId, ColliderId, Filter, Role};
use crate::math::Vec2;
use crate::world::{ColliderRef, World};

/// A view of one of the shapes of a body to change it. A change wakes the body and what it touches.
///
/// ```
/// # use rustycs::prelude::*;
/// # let mut world = World::new(Settings::default());
/// let belt = Collider::new(Shape::aabb(10.0, 1.0)).at([10.0, 0.0]).surface_speed(2.0);
/// let machine = world.add(Body::fixed(Shape::aabb(10.0, 1.0)).with(belt))?;
/// let belt = world.body(machine).unwrap().colliders().nth(1).unwrap().id();
/// world.collider_mut(belt).unwrap().set_surface_speed(-2.0);
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Debug)]
pub struct ColliderMut<'a> {
    world: &'a mut World,
    /// Of the shape, or of the body whose shapes are all changed.
    slot: u32,
}

impl World {
    /// The shape of a body with this id, for changing it, or `None` if its body has been removed.
    pub fn collider_mut(&mut self, id: ColliderId) -> Option<ColliderMut<'_>> {
        let slot = self.collider(id)?.slot();
        Some(ColliderMut::new(self, slot))
    }
}

impl<'a> ColliderMut<'a> {
    pub(in crate::world) fn new(world: &'a mut World, slot: u32) -> Self {
        Self { world, slot }
    }

    /// All shapes of a body, to change them as one.
    pub(in crate::world) fn of_all(world: &'a mut World, body: BodyId) -> Self {
        Self { world, slot: body.0.index() }
    }

    /// The same view for reading.
    pub fn view(&self) -> ColliderRef<'_> {
        ColliderRef::new(self.world, self.slot)
    }

    /// Sets what it collides with. Contacts with others end, and new ones begin in the next step.
    pub fn set_filter(&mut self, filter: Filter) {
        if self.change_role(|role| role.filter = filter) {
            self.world.collisions_changed(self.body());
        }
    }

    /// Makes it a sensor, see [`Body::sensor`](crate::Body::sensor), or no longer one. Its contacts end. The mass of its body stays
    /// as it is.
    pub fn set_sensor(&mut self, is_sensor: bool) {
        if self.change_role(|role| role.is_sensor = is_sensor) {
            self.world.collisions_changed(self.body());
        }
    }

    /// Makes it a one-way floor in this direction, see [`Body::one_way`](crate::Body::one_way), or, by `None`, one that is passed
    /// by none. What touches it decides anew whether it passes.
    ///
    /// # Errors
    /// [`BodyError`], if the direction is not finite or has no length.
    pub fn set_one_way(&mut self, direction: impl Into<Option<Vec2>>) -> Result<(), BodyError> {
        let direction = direction.into().map(|direction| direction.direction().unwrap_or(direction));
        check_one_way(direction)?;
        if self.change_role(|role| role.one_way = direction) {
            let body = self.body();
            self.wake();
            self.world.contacts.decide_anew(&self.world.bodies, body);
            self.world.note_ground(body);
        }
        Ok(())
    }

    /// Sets the speed of its surface, m/s, see [`Body::surface_speed`](crate::Body::surface_speed). Refused beyond ±10⁶ m/s.
    #[track_caller]
    pub fn set_surface_speed(&mut self, speed: f32) -> &mut Self {
        if let Err(error) = check_surface_speed(speed) {
            let body = self.world.id_of(self.slot);
            self.world.refuse(body, error);
        } else if self.change_role(|role| role.surface_speed = speed) {
            self.wake();
        }
        self
    }

    /// Sets the coefficient of rolling resistance, see [`Body::rolling_resistance`](crate::Body::rolling_resistance).
    ///
    /// # Errors
    /// [`BodyError`], if it is not within 0 to 10⁶.
    pub fn set_rolling_resistance(&mut self, coefficient: f32) -> Result<(), BodyError> {
        check_rolling_resistance(coefficient)?;
        if self.change_role(|role| role.rolling_resistance = Some(coefficient)) {
            self.surface_changed();
        }
        Ok(())
    }

    /// Sets the coefficient of friction, 0 or more.
    ///
    /// # Errors
    /// [`BodyError`], if it is negative, not finite or beyond 10⁶.
    pub fn set_friction(&mut self, friction: f32) -> Result<(), BodyError> {
        check_friction(friction)?;
        self.for_each_shape(|bodies, slot| bodies.records[slot].material.friction = friction);
        self.surface_changed();
        Ok(())
    }

    /// Sets the coefficient of restitution, 0 to 1.
    ///
    /// # Errors
    /// [`BodyError`], if it is not from 0 to 1.
    pub fn set_restitution(&mut self, restitution: f32) -> Result<(), BodyError> {
        check_restitution(restitution)?;
        self.for_each_shape(|bodies, slot| bodies.records[slot].material.restitution = restitution);
        self.surface_changed();
        Ok(())
    }

    /// Sets the caller's own number. A contact filter that reads it is not asked again of what is near.
    pub fn set_user_data(&mut self, user_data: u64) {
        self.world.bodies.records[self.slot].user_data = user_data;
    }

    /// The slot of its body.
    fn body(&self) -> u32 {
        self.world.bodies.body_of(self.slot)
    }

    fn wake(&mut self) {
        let body = self.body();
        self.world.wake_slot(body);
        self.world.wake_neighbours(body);
    }

    pub(in crate::world) fn surface_changed(&mut self) {
        self.world.mix_body(self.body());
        self.wake();
    }

    /// Changes its role; returns whether it is another one now.
    pub(in crate::world) fn change_role(&mut self, change: impl Fn(&mut Role)) -> bool {
        let mut has_changed = false;
        self.for_each_shape(|bodies, slot| {
            let before = bodies.roles.of(slot);
            let mut role = before;
            change(&mut role);
            bodies.roles.set(slot, role);
            has_changed |= role != before;
        });
        has_changed
    }

    fn for_each_shape(&mut self, change: impl FnMut(&mut Bodies, u32)) {
        self.world.bodies.for_each_shape(self.slot, change);
    }
}
