//! Views of a body of a world: to read it, and to change it.

use crate::body::description::{
    check_damping, check_friction, check_gravity_scale, check_place, check_restitution, check_strength,
    check_vector,
};
use crate::body::{Body, BodyError, BodyId, BodyType, Forcing, Material, Motion, NONE, Record};
use crate::compute::BodyState;
use crate::math::{Aabb, Point, Pose, Rot, Vec2};
use crate::shape::Shape;
use crate::world::held_forces::{Forced, TickForce};
use crate::world::{Tier, World};

/// A read-only view of a body.
#[derive(Clone, Copy, Debug)]
pub struct BodyRef<'a> {
    id: BodyId,
    record: &'a Record,
    motion: &'a Motion,
    forcing: &'a Forcing,
    state: &'a BodyState,
    previous: Pose,
    shape: &'a Shape,
    tier: Tier,
}

impl<'a> BodyRef<'a> {
    pub(in crate::world) fn new(world: &'a World, id: BodyId) -> Option<Self> {
        let record = world.bodies.records.get(id.0)?;
        let slot = id.0.index();
        Some(Self {
            id,
            record,
            motion: &world.bodies.motions[slot as usize],
            forcing: &world.bodies.forcings[slot as usize],
            state: world.bodies.state(slot),
            previous: world.bodies.previous_pose(slot),
            shape: &world.bodies.shapes[slot as usize],
            tier: world.graph.tier(slot),
        })
    }

    /// Its id.
    pub fn id(&self) -> BodyId {
        self.id
    }

    /// Centre of mass, m, in `f32`.
    pub fn position(&self) -> Vec2 {
        self.motion.pose.center.to_vec2()
    }

    /// Centre of mass, m, as exactly as the engine knows it: (x, y).
    pub fn position_f64(&self) -> [f64; 2] {
        self.motion.pose.center.into()
    }

    /// Angle, rad, in (-π, π], counter-clockwise.
    pub fn angle(&self) -> f32 {
        self.motion.pose.rotation.angle()
    }

    /// Rotation from the body's frame into the world's.
    pub fn rotation(&self) -> Rot {
        self.motion.pose.rotation
    }

    /// Centre of mass and rotation.
    pub fn pose(&self) -> Pose {
        self.motion.pose
    }

    /// The pose before the last tick. That of a body which was added, woken or put somewhere since is the pose now: it is
    /// not drawn on its way there.
    pub fn previous_pose(&self) -> Pose {
        self.previous
    }

    /// Where to draw the body: `alpha` of the way, 0 to 1, from the pose before the last tick to the pose now.
    ///
    /// With [`World::alpha`] it moves smoothly at any number of frames per second, up to a tick late. It takes the
    /// shorter way round: what turns by more than half a turn per tick is seen to turn the other way.
    pub fn interpolated_pose(&self, alpha: f32) -> Pose {
        self.previous.lerp(self.motion.pose, alpha)
    }

    /// Velocity of the centre of mass, m/s.
    pub fn velocity(&self) -> Vec2 {
        self.state.velocity.into()
    }

    /// Angular velocity, rad/s, counter-clockwise.
    pub fn angular_velocity(&self) -> f32 {
        self.state.angular_velocity
    }

    /// Velocity of the point of the body that is at `place`, m/s.
    pub fn velocity_at(&self, place: impl Into<Point>) -> Vec2 {
        self.velocity() + (place.into() - self.motion.pose.center).perp() * self.state.angular_velocity
    }

    /// Mass, kg; infinite for fixed and kinematic bodies.
    pub fn mass(&self) -> f32 {
        if self.is_dynamic() { self.record.mass } else { f32::INFINITY }
    }

    /// Moment of inertia about the centre of mass, kg m²; infinite for bodies that no contact turns: fixed and kinematic
    /// ones, axis-aligned boxes, and those of fixed rotation.
    pub fn inertia(&self) -> f32 {
        if self.motion.inverse_inertia > 0.0 { self.record.inertia } else { f32::INFINITY }
    }

    /// How the last step solved its contacts, and those of all bodies that contacts connect with it.
    pub fn tier(&self) -> Tier {
        self.tier
    }

    /// Whether it is dynamic, fixed or kinematic.
    pub fn body_type(&self) -> BodyType {
        self.record.body_type
    }

    fn is_dynamic(&self) -> bool {
        self.record.body_type == BodyType::Dynamic
    }

    /// Its shape.
    pub fn shape(&self) -> &'a Shape {
        self.shape
    }

    /// The smallest axis-aligned box around it, m, rounded outward.
    pub fn aabb(&self) -> Aabb {
        self.shape.bounding_box(self.motion.pose)
    }

    /// Density, friction and restitution.
    pub fn material(&self) -> Material {
        self.record.material
    }

    /// Factor on the world's forces.
    pub fn gravity_scale(&self) -> f32 {
        self.forcing.gravity_scale
    }

    /// Linear damping, 1/s.
    pub fn linear_damping(&self) -> f32 {
        self.forcing.linear_damping
    }

    /// Angular damping, 1/s.
    pub fn angular_damping(&self) -> f32 {
        self.forcing.angular_damping
    }

    /// The caller's own number.
    pub fn user_data(&self) -> u64 {
        self.record.user_data
    }

    /// Whether it may be put to sleep once it is at rest.
    pub fn may_sleep(&self) -> bool {
        self.motion.may_sleep
    }

    /// Whether it sleeps.
    pub fn is_sleeping(&self) -> bool {
        self.record.sleep_group != NONE
    }

    /// Whether the place lies in the body, its outline included.
    pub fn contains(&self, place: impl Into<Point>) -> bool {
        self.shape.contains(self.motion.pose, place.into())
    }
}

/// A view of a body to change it. Every change wakes the body. It is rejected, leaving the body unchanged, if a number is NaN,
/// infinite or out of range.
#[derive(Debug)]
pub struct BodyMut<'a> {
    world: &'a mut World,
    id: BodyId,
}

impl<'a> BodyMut<'a> {
    pub(in crate::world) fn new(world: &'a mut World, id: BodyId) -> Option<Self> {
        world.bodies.records.get(id.0)?;
        Some(Self { world, id })
    }

    /// The read-only view of the body.
    pub fn view(&self) -> BodyRef<'_> {
        let slot = self.slot();
        let bodies = &self.world.bodies;
        BodyRef {
            id: self.id,
            record: &bodies.records[slot],
            motion: &bodies.motions[slot as usize],
            forcing: &bodies.forcings[slot as usize],
            state: bodies.state(slot),
            previous: bodies.previous_pose(slot),
            shape: &bodies.shapes[slot as usize],
            tier: self.world.graph.tier(slot),
        }
    }

    fn slot(&self) -> u32 {
        self.id.0.index()
    }

    fn record(&mut self) -> &mut Record {
        let slot = self.slot();
        &mut self.world.bodies.records[slot]
    }

    fn motion(&mut self) -> &mut Motion {
        let slot = self.slot();
        &mut self.world.bodies.motions[slot as usize]
    }

    fn previous_pose(&mut self) -> Option<&mut Pose> {
        let slot = self.slot();
        self.world.bodies.previous_pose_mut(slot)
    }

    fn forcing(&mut self) -> &mut Forcing {
        let slot = self.slot();
        &mut self.world.bodies.forcings[slot as usize]
    }

    /// The row of the body, woken; `None` for a fixed body, which has none.
    fn state(&mut self) -> Option<&mut BodyState> {
        self.wake();
        if self.record().body_type == BodyType::Fixed {
            return None;
        }
        let row = self.motion().row;
        self.world.bodies.states.get_mut(row as usize)
    }

    /// Wakes the body and all that it rests on or that rests on it.
    pub fn wake(&mut self) {
        self.world.wake_slot(self.slot());
    }

    /// Puts the centre of mass at `center`, m.
    ///
    /// # Errors
    /// [`BodyError`], if a coordinate is not finite or beyond 10¹² m.
    pub fn set_position(&mut self, center: impl Into<Point>) -> Result<(), BodyError> {
        let center = center.into();
        check_place(center)?;
        self.motion().pose.center = center;
        self.moved();
        if let Some(previous) = self.previous_pose() {
            previous.center = center;
        }
        Ok(())
    }

    /// Turns the body to `angle`, rad. Axis-aligned boxes stay as they are.
    ///
    /// # Errors
    /// [`BodyError`], if the angle is not finite or beyond 10¹⁸ rad.
    pub fn set_angle(&mut self, angle: f32) -> Result<(), BodyError> {
        check_strength("the angle", angle, "rad")?;
        if self.view().shape().can_rotate() {
            let rotation = Rot::from_angle(angle);
            self.motion().pose.rotation = rotation;
            self.moved();
            if let Some(previous) = self.previous_pose() {
                previous.rotation = rotation;
            }
        }
        Ok(())
    }

    /// Lets box and neighbours know that the pose was changed.
    fn moved(&mut self) {
        let slot = self.slot();
        self.world.update_box(slot);
        self.world.contacts.forget_moving(&self.world.bodies, slot);
        self.wake();
        self.world.wake_neighbours(slot);
    }

    /// Sets the velocity of the centre of mass, m/s, cut to [`Settings::max_speed`](crate::Settings::max_speed). Fixed bodies stay
    /// at rest.
    ///
    /// # Errors
    /// [`BodyError`], if a component is not finite or beyond 10¹⁸ m/s.
    pub fn set_velocity(&mut self, velocity: impl Into<Vec2>) -> Result<(), BodyError> {
        let velocity = velocity.into();
        check_vector("the velocity", velocity, "m/s")?;
        self.motion().velocity_compensation = Vec2::ZERO;
        if let Some(state) = self.state() {
            state.velocity = velocity.into();
        }
        self.world.cut_velocity(self.slot());
        self.world.update_box(self.slot());
        Ok(())
    }

    /// Sets the angular velocity, rad/s, cut to [`Settings::max_spin`](crate::Settings::max_spin). Fixed bodies, axis-aligned
    /// boxes and bodies with [fixed rotation](Body::fixed_rotation) do not turn.
    ///
    /// # Errors
    /// [`BodyError`], if it is not finite or beyond 10¹⁸ rad/s.
    pub fn set_angular_velocity(&mut self, angular_velocity: f32) -> Result<(), BodyError> {
        check_strength("the angular velocity", angular_velocity, "rad/s")?;
        if self.record().fixed_rotation || !self.view().shape().can_rotate() {
            return Ok(());
        }
        if let Some(state) = self.state() {
            state.angular_velocity = angular_velocity;
        }
        self.world.cut_velocity(self.slot());
        Ok(())
    }

    /// Changes the velocity by `impulse`/mass; N s, at the centre of mass. Only dynamic bodies respond.
    ///
    /// # Errors
    /// [`BodyError`], if a component is not finite or beyond 10¹⁸ N s.
    pub fn apply_impulse(&mut self, impulse: impl Into<Vec2>) -> Result<(), BodyError> {
        let impulse = impulse.into();
        check_vector("the impulse", impulse, "N s")?;
        self.add_velocity(impulse, 0.0);
        Ok(())
    }

    /// Changes velocity and spin by an impulse, N s, that acts at `place`, m. Only dynamic bodies respond.
    ///
    /// # Errors
    /// [`BodyError`], if a number is not finite, an impulse beyond 10¹⁸ N s or a place beyond 10¹² m.
    pub fn apply_impulse_at(
        &mut self,
        impulse: impl Into<Vec2>,
        place: impl Into<Point>,
    ) -> Result<(), BodyError> {
        let (impulse, place) = (impulse.into(), place.into());
        check_vector("the impulse", impulse, "N s")?;
        check_place(place)?;
        let arm = place - self.motion().pose.center;
        self.add_velocity(impulse, arm.cross(impulse));
        Ok(())
    }

    /// Changes the angular velocity by `impulse`/inertia; N m s. Only dynamic bodies that can turn respond.
    ///
    /// # Errors
    /// [`BodyError`], if it is not finite or beyond 10¹⁸ N m s.
    pub fn apply_angular_impulse(&mut self, impulse: f32) -> Result<(), BodyError> {
        check_strength("the angular impulse", impulse, "N m s")?;
        self.add_velocity(Vec2::ZERO, impulse);
        Ok(())
    }

    fn add_velocity(&mut self, impulse: Vec2, angular_impulse: f32) {
        let (inverse_mass, inverse_inertia) = (self.motion().inverse_mass, self.motion().inverse_inertia);
        let Some(state) = self.state() else { return };
        state.velocity = (Vec2::from(state.velocity) + impulse * inverse_mass).into();
        state.angular_velocity += angular_impulse * inverse_inertia;
        self.world.cut_velocity(self.slot());
        self.world.update_box(self.slot());
    }

    /// Applies a force, N, at the centre of mass during the next step, or for as long as the next
    /// [`advance`](World::advance) is. Forces of several calls add up; a force of 0 does not even wake the body. Only dynamic
    /// bodies respond.
    ///
    /// The force is held over the whole tick. One that depends on where the body is, such as a spring's or the water's, is
    /// half a tick late by that, and gains energy without end: give it as an impulse before each tick,
    /// `apply_impulse(force * tick_seconds)` in [`advance_with`](World::advance_with), which keeps the energy.
    ///
    /// # Errors
    /// [`BodyError`], if a component is not finite or beyond 10¹⁸ N.
    pub fn apply_force(&mut self, force: impl Into<Vec2>) -> Result<(), BodyError> {
        let force = force.into();
        check_vector("the force", force, "N")?;
        self.add_force(force, 0.0);
        Ok(())
    }

    /// Applies a force, N, at `place`, m, in the way of [`apply_force`](Self::apply_force).
    ///
    /// # Errors
    /// [`BodyError`], if a number is not finite, a force beyond 10¹⁸ N or a place beyond 10¹² m.
    pub fn apply_force_at(
        &mut self,
        force: impl Into<Vec2>,
        place: impl Into<Point>,
    ) -> Result<(), BodyError> {
        let (force, place) = (force.into(), place.into());
        check_vector("the force", force, "N")?;
        check_place(place)?;
        let arm = place - self.motion().pose.center;
        self.add_force(force, arm.cross(force));
        Ok(())
    }

    /// Applies a torque, N m, in the way of [`apply_force`](Self::apply_force). Only dynamic bodies that can turn respond.
    ///
    /// # Errors
    /// [`BodyError`], if it is not finite or beyond 10¹⁸ N m.
    pub fn apply_torque(&mut self, torque: f32) -> Result<(), BodyError> {
        check_strength("the torque", torque, "N m")?;
        self.add_force(Vec2::ZERO, torque);
        Ok(())
    }

    fn add_force(&mut self, force: Vec2, torque: f32) {
        let force = TickForce { body: self.id, force, torque, wakes: true };
        if self.world.add_force_to(force) {
            self.world.forced.push(Forced { body: self.id, wakes: force.wakes });
        }
    }

    /// Sets the coefficient of friction, 0 or more.
    ///
    /// # Errors
    /// [`BodyError`], if it is negative, not finite or beyond 10⁶.
    pub fn set_friction(&mut self, friction: f32) -> Result<(), BodyError> {
        check_friction(friction)?;
        self.record().material.friction = friction;
        self.surface_changed();
        Ok(())
    }

    /// Sets the coefficient of restitution, 0 to 1.
    ///
    /// # Errors
    /// [`BodyError`], if it is not from 0 to 1.
    pub fn set_restitution(&mut self, restitution: f32) -> Result<(), BodyError> {
        check_restitution(restitution)?;
        self.record().material.restitution = restitution;
        self.surface_changed();
        Ok(())
    }

    fn surface_changed(&mut self) {
        let slot = self.slot();
        self.world.mix_body(slot);
        self.wake();
        self.world.wake_neighbours(slot);
    }

    /// Sets the factor on the world's forces.
    ///
    /// # Errors
    /// [`BodyError`], if it is not finite or beyond ±10⁶.
    pub fn set_gravity_scale(&mut self, scale: f32) -> Result<(), BodyError> {
        check_gravity_scale(scale)?;
        self.forcing().gravity_scale = scale;
        self.wake();
        Ok(())
    }

    /// Sets the linear damping, 1/s, 0 or more.
    ///
    /// # Errors
    /// [`BodyError`], if it is negative, not finite or beyond 10⁶ 1/s.
    pub fn set_linear_damping(&mut self, damping: f32) -> Result<(), BodyError> {
        check_damping("the linear damping", damping)?;
        self.forcing().linear_damping = damping;
        self.wake();
        Ok(())
    }

    /// Sets the angular damping, 1/s, 0 or more.
    ///
    /// # Errors
    /// [`BodyError`], if it is negative, not finite or beyond 10⁶ 1/s.
    pub fn set_angular_damping(&mut self, damping: f32) -> Result<(), BodyError> {
        check_damping("the angular damping", damping)?;
        self.forcing().angular_damping = damping;
        self.wake();
        Ok(())
    }

    /// Sets whether the body may be put to sleep once it is at rest; where it may not, neither may what it touches.
    pub fn set_may_sleep(&mut self, may_sleep: bool) {
        self.motion().may_sleep = may_sleep;
        self.wake();
    }

    /// Sets the caller's own number.
    pub fn set_user_data(&mut self, user_data: u64) {
        self.record().user_data = user_data;
    }

    /// The description of the body as it is now, from which another like it can be added.
    pub fn describe(&self) -> Option<Body> {
        self.world.bodies.describe(self.id.0)
    }
}
