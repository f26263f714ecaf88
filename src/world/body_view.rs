//! A view of a body of a world, to read it.

use core::fmt;

use crate::body::{Body, BodyId, BodyType, Filter, Forcing, Material, Motion, NONE, Record, Role};
use crate::compute::BodyState;
use crate::math::{Aabb, Point, Pose, Rot, Vec2};
use crate::shape::Shape;
use crate::world::sleep::why_awake;
use crate::world::{Awake, ColliderRef, Tier, World};

/// A read-only view of a body.
#[derive(Clone, Copy)]
pub struct BodyRef<'a> {
    world: &'a World,
    id: BodyId,
}

impl<'a> BodyRef<'a> {
    /// The view of a body that is there.
    pub(in crate::world) fn new(world: &'a World, id: BodyId) -> Self {
        debug_assert!(world.bodies.has(id), "{id:?} is not there");
        Self { world, id }
    }

    fn slot(&self) -> u32 {
        self.id.0.index()
    }

    fn record(&self) -> &'a Record {
        &self.world.bodies.records[self.slot()]
    }

    fn motion(&self) -> &'a Motion {
        &self.world.bodies.motions[self.slot() as usize]
    }

    fn forcing(&self) -> &'a Forcing {
        &self.world.bodies.forcings[self.slot() as usize]
    }

    /// The slot of its own shape.
    fn own(&self) -> u32 {
        self.world.bodies.own_collider(self.slot())
    }

    fn own_material(&self) -> Material {
        self.world.bodies.records[self.own()].material
    }

    pub(in crate::world) fn role(&self) -> Role {
        self.world.bodies.roles.of(self.own())
    }

    fn state(&self) -> &'a BodyState {
        self.world.bodies.state(self.slot())
    }

    /// Its id.
    pub fn id(&self) -> BodyId {
        self.id
    }

    /// Centre of mass, m, in `f32`.
    pub fn position(&self) -> Vec2 {
        self.motion().pose.center.to_vec2()
    }

    /// Centre of mass, m, as exactly as the engine knows it: (x, y).
    pub fn position_f64(&self) -> [f64; 2] {
        self.motion().pose.center.into()
    }

    /// Angle, rad, in (-π, π], counter-clockwise.
    pub fn angle(&self) -> f32 {
        self.motion().pose.rotation.angle()
    }

    /// Rotation from the body's frame into the world's.
    pub fn rotation(&self) -> Rot {
        self.motion().pose.rotation
    }

    /// Centre of mass and rotation.
    pub fn pose(&self) -> Pose {
        self.motion().pose
    }

    /// The pose before the last tick. That of a body which was added, woken or put somewhere since is the pose now: it is
    /// not drawn on its way there.
    pub fn previous_pose(&self) -> Pose {
        self.world.bodies.previous_pose(self.slot())
    }

    /// Where to draw the body: `alpha` of the way, 0 to 1, from the pose before the last tick to the pose now.
    ///
    /// With [`World::alpha`] it moves smoothly at any number of frames per second, up to a tick late. It takes the
    /// shorter way round: what turns by more than half a turn per tick is seen to turn the other way.
    pub fn interpolated_pose(&self, alpha: f32) -> Pose {
        self.previous_pose().lerp(self.pose(), alpha)
    }

    /// Velocity of the centre of mass, m/s.
    ///
    /// Of a kinematic body it is the velocity that it was told. A body that is put somewhere, as by
    /// [`set_position`](crate::BodyMut::set_position), keeps the velocity it had: a kinematic one at rest that is put elsewhere in every tick
    /// has velocity 0 all the time. One that is [moved to](crate::BodyMut::move_to) a pose has a velocity within the tick, and 0 after it.
    pub fn velocity(&self) -> Vec2 {
        self.state().velocity.to_vec2()
    }

    /// Angular velocity, rad/s, counter-clockwise.
    pub fn angular_velocity(&self) -> f32 {
        self.state().angular_velocity
    }

    /// Velocity of the point of the body that is at `place`, m/s.
    pub fn velocity_at(&self, place: impl Into<Point>) -> Vec2 {
        self.velocity() + (place.into() - self.motion().pose.center).perp() * self.state().angular_velocity
    }

    /// ½ m v² + ½ I w², J; 0 for fixed and kinematic bodies. [`World::kinetic_energy`] is the sum.
    pub fn kinetic_energy(&self) -> f64 {
        if !self.is_dynamic() {
            return 0.0;
        }
        let (record, state) = (self.record(), self.state());
        let [x, y, w] = [state.velocity.x, state.velocity.y, state.angular_velocity].map(f64::from);
        0.5 * (f64::from(record.mass) * (x * x + y * y) + f64::from(record.inertia) * w * w)
    }

    /// Mass, kg; infinite for fixed and kinematic bodies.
    pub fn mass(&self) -> f32 {
        if self.is_dynamic() { self.record().mass } else { f32::INFINITY }
    }

    /// The mass that the body was given, kg; `None` where it follows from density and area.
    pub fn mass_override(&self) -> Option<f32> {
        self.record().mass_override
    }

    /// Moment of inertia about the centre of mass, kg m²; infinite for bodies that no contact turns: fixed and kinematic
    /// ones, axis-aligned boxes, and those of fixed rotation.
    pub fn inertia(&self) -> f32 {
        if self.motion().inverse_inertia > 0.0 { self.record().inertia } else { f32::INFINITY }
    }

    /// Whether it was told never to turn.
    pub fn fixed_rotation(&self) -> bool {
        self.record().fixed_rotation
    }

    /// How the last step solved its contacts, and those of all bodies that contacts connect with it.
    pub fn tier(&self) -> Tier {
        self.world.graph.tier(self.slot())
    }

    /// Whether it is dynamic, fixed or kinematic.
    pub fn body_type(&self) -> BodyType {
        self.record().body_type
    }

    fn is_dynamic(&self) -> bool {
        self.record().body_type == BodyType::Dynamic
    }

    /// Its shape; the first, if it has [several](Self::colliders).
    pub fn shape(&self) -> &'a Shape {
        &self.world.bodies.shapes[self.own() as usize]
    }

    /// Its shapes, each with its own place, material, filter and role: most bodies have one.
    pub fn colliders(&self) -> impl Iterator<Item = ColliderRef<'a>> + use<'a> {
        let world = self.world;
        world.bodies.colliders(self.slot()).map(move |slot| ColliderRef::new(world, slot))
    }

    /// Where the origin of the frame is in which its shapes were described, m. Of a body of one shape it is the centre of that shape,
    /// and so its [position](Self::position). Of several shapes it is the centre of the body's own one; of
    /// [pieces](crate::Body::dynamic_pieces) it is the origin that their points count from.
    pub fn origin(&self) -> Point {
        self.world.bodies.place_of_frame(self.slot())
    }

    /// The smallest axis-aligned box around it, m, rounded outward.
    pub fn aabb(&self) -> Aabb {
        self.world.bodies.aabb_of_all(self.slot())
    }

    /// Density, friction and restitution.
    pub fn material(&self) -> Material {
        self.own_material()
    }

    /// Mass per area of its material, kg/m².
    pub fn density(&self) -> f32 {
        self.own_material().density
    }

    /// Coefficient of friction of its material.
    pub fn friction(&self) -> f32 {
        self.own_material().friction
    }

    /// Coefficient of restitution of its material.
    pub fn restitution(&self) -> f32 {
        self.own_material().restitution
    }

    /// Factor on the world's forces.
    pub fn gravity_scale(&self) -> f32 {
        self.forcing().gravity_scale
    }

    /// Linear damping, 1/s.
    pub fn linear_damping(&self) -> f32 {
        self.forcing().linear_damping
    }

    /// Angular damping, 1/s.
    pub fn angular_damping(&self) -> f32 {
        self.forcing().angular_damping
    }

    /// Which bodies it collides with.
    pub fn filter(&self) -> Filter {
        self.role().filter
    }

    /// Whether it is a sensor, which only takes note of what overlaps it.
    pub fn is_sensor(&self) -> bool {
        self.role().is_sensor
    }

    /// The direction, in its frame and of length 1, in which bodies pass it, if it is a one-way floor.
    pub fn one_way(&self) -> Option<Vec2> {
        self.role().one_way
    }

    /// Speed of its surface against the body, m/s.
    pub fn surface_speed(&self) -> f32 {
        self.role().surface_speed
    }

    /// Coefficient of rolling resistance, no unit; 0.002 where none was told.
    pub fn rolling_resistance(&self) -> f32 {
        self.role().rolling_resistance_or_usual()
    }

    /// The caller's own number.
    pub fn user_data(&self) -> u64 {
        self.record().user_data
    }

    /// Whether it may be put to sleep once it is at rest.
    pub fn may_sleep(&self) -> bool {
        self.motion().may_sleep
    }

    /// Whether it sleeps.
    pub fn is_sleeping(&self) -> bool {
        self.record().sleep_group != NONE
    }

    /// Why it does not sleep: to find what keeps a heap awake, look for those where this is neither `None` nor
    /// [`Awake::Others`]. `None` if it sleeps, and of what is not dynamic.
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let mut world = World::default();
    /// let drifting = world.add(Body::dynamic(Shape::circle(0.5)).velocity([1.0, 0.0]))?;
    /// world.step();
    /// assert_eq!(world.body(drifting).unwrap().why_awake(), Some(Awake::Moves));
    /// # Ok(())
    /// # }
    /// ```
    pub fn why_awake(&self) -> Option<Awake> {
        let World { bodies, contacts, joints, settings, .. } = self.world;
        let rule = settings.sleep.then(|| settings.rest_rule());
        why_awake(bodies, contacts, joints, self.slot(), rule)
    }

    /// Whether the place lies in the body, its outline included.
    pub fn contains(&self, place: impl Into<Point>) -> bool {
        let place = place.into();
        self.colliders().any(|collider| collider.shape().contains(collider.pose(), place))
    }

    /// The description of the body as it is now, from which another like it can be added.
    pub fn describe(&self) -> Body {
        self.world.bodies.describe(self.slot())
    }
}

impl fmt::Debug for BodyRef<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("BodyRef").field(&self.id).field(&self.describe()).finish()
    }
}
