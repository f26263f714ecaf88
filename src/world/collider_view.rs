//! A view of one of the shapes of a body, to read it.

use core::fmt;

use crate::body::{BodyId, Collider, ColliderId, Filter, Material, Role};
use crate::math::{Aabb, Point, Pose, Vec2};
use crate::shape::Shape;
use crate::world::World;

/// A read-only view of one of the shapes of a body.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// let handle = Collider::new(Shape::rectangle(0.1, 0.8)).at([0.0, -0.6]);
/// let hammer = world.add(Body::dynamic(Shape::rectangle(0.6, 0.3)).density(5.0).with(handle))?;
/// for shape in world.body(hammer).unwrap().colliders() {
///     let Pose { center, rotation } = shape.pose(); // where to draw it
///     println!("{:?} at {center}, turned by {:.2}", shape.shape().vertices(), rotation.angle());
/// }
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy)]
pub struct ColliderRef<'a> {
    world: &'a World,
    slot: u32,
}

impl World {
    /// The shape of a body with this id, or `None` if its body has been removed.
    pub fn collider(&self, id: ColliderId) -> Option<ColliderRef<'_>> {
        let slot = id.0.index();
        self.bodies.records.get(id.0).filter(|_| !self.bodies.is_compound(slot))?;
        Some(ColliderRef::new(self, slot))
    }

    pub(in crate::world) fn collider_id(&self, slot: u32) -> ColliderId {
        ColliderId(self.bodies.records.key_at(slot))
    }
}

impl<'a> ColliderRef<'a> {
    pub(in crate::world) fn new(world: &'a World, slot: u32) -> Self {
        Self { world, slot }
    }

    pub(in crate::world) fn slot(&self) -> u32 {
        self.slot
    }

    /// Its id.
    pub fn id(&self) -> ColliderId {
        self.world.collider_id(self.slot)
    }

    /// The body that it is a shape of.
    pub fn body(&self) -> BodyId {
        self.world.id_of(self.slot)
    }

    /// Its geometry.
    pub fn shape(&self) -> &'a Shape {
        &self.world.bodies.shapes[self.slot as usize]
    }

    /// Where its centre is, and how it is turned.
    pub fn pose(&self) -> Pose {
        self.world.bodies.motions[self.slot as usize].pose
    }

    /// The pose before the last tick, as [`BodyRef::previous_pose`](crate::BodyRef::previous_pose) tells.
    pub fn previous_pose(&self) -> Pose {
        self.world.bodies.previous_pose(self.slot)
    }

    /// Where it is while its body is in a pose: to draw a body elsewhere than it is.
    pub fn pose_on(&self, body: Pose) -> Pose {
        self.world.bodies.pose_in(self.slot, body)
    }

    /// Where to draw it: `alpha` of the way from the pose before the last tick to the pose now, as
    /// [`BodyRef::interpolated_pose`](crate::BodyRef::interpolated_pose) tells.
    pub fn interpolated_pose(&self, alpha: f32) -> Pose {
        let body = self.world.bodies.body_of(self.slot);
        let now = self.world.bodies.motions[body as usize].pose;
        self.pose_on(self.world.bodies.previous_pose(body).lerp(now, alpha))
    }

    /// The smallest axis-aligned box around it, m, rounded outward.
    pub fn aabb(&self) -> Aabb {
        self.world.bodies.aabb(self.slot)
    }

    /// Density, friction and restitution.
    pub fn material(&self) -> Material {
        self.world.bodies.records[self.slot].material
    }

    /// Coefficient of friction.
    pub fn friction(&self) -> f32 {
        self.material().friction
    }

    /// Coefficient of restitution.
    pub fn restitution(&self) -> f32 {
        self.material().restitution
    }

    /// Coefficient of rolling resistance, no unit; 0.002 where none was told.
    pub fn rolling_resistance(&self) -> f32 {
        self.role().rolling_resistance_or_usual()
    }

    /// What it is to what it meets.
    pub(in crate::world) fn role(&self) -> Role {
        self.world.bodies.roles.of(self.slot)
    }

    /// What it collides with.
    pub fn filter(&self) -> Filter {
        self.world.bodies.roles.of(self.slot).filter
    }

    /// Whether it is a sensor, which only takes note of what overlaps it.
    pub fn is_sensor(&self) -> bool {
        self.world.bodies.roles.of(self.slot).is_sensor
    }

    /// The direction, in its frame and of length 1, in which bodies pass it, if it is a one-way floor.
    pub fn one_way(&self) -> Option<Vec2> {
        self.world.bodies.roles.of(self.slot).one_way
    }

    /// Speed of its surface against the body, m/s.
    pub fn surface_speed(&self) -> f32 {
        self.world.bodies.roles.of(self.slot).surface_speed
    }

    /// The caller's own number.
    pub fn user_data(&self) -> u64 {
        self.world.bodies.records[self.slot].user_data
    }

    /// Whether the place lies in it, its outline included.
    pub fn contains(&self, place: impl Into<Point>) -> bool {
        self.shape().contains(self.pose(), place.into())
    }

    /// Its description, in the frame that the body was described in.
    pub fn describe(&self) -> Collider {
        self.world.bodies.describe_collider(self.slot)
    }
}

impl fmt::Debug for ColliderRef<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("ColliderRef").field(&self.id()).field(&self.describe()).finish()
    }
}
