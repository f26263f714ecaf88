//! A view of a body of a world, to read it and to change how it moves.

use crate::body::limits::{
    check_damping, check_gravity_scale, check_place, check_rotation, check_strength, check_vector,
};
use crate::body::{Body, BodyError, BodyId, BodyType, Filter, Forcing, Material, Mix, Motion, Record};
use crate::compute::BodyState;
use crate::math::{Aabb, Point, Pose, Rot, Vec2};
use crate::shape::Shape;
use crate::world::held_forces::{Forced, TickForce};
use crate::world::{BodyRef, Tier, World};

/// A view of a body to change it, and to read it as [`BodyRef`] does.
///
/// - A change wakes the body; [`without_waking`](Self::without_waking) says where it does not.
/// - What a game does every frame (velocities, impulses, forces, [`move_to`](Self::move_to)) gives the view back, for the
///   next call. A number that is not finite or out of range is refused, and nothing changes: a debug build panics at the line
///   of the call, a release build reports it in [`Events::refused`](crate::Events::refused).
/// - Other changes return a [`BodyError`], with the body as it was.
///
/// ```
/// # use rustycs::prelude::*;
/// # let mut world = World::new(Settings::default());
/// # let id = world.add(Body::dynamic(Shape::circle(0.5)))?;
/// let mut body = world.body_mut(id).unwrap();
/// let braked = 0.9 * body.velocity();
/// body.set_velocity(braked).apply_force([0.0, 5.0]).apply_torque(1.0);
/// body.set_shape(Shape::circle(0.25))?;
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Debug)]
pub struct BodyMut<'a> {
    pub(in crate::world) world: &'a mut World,
    pub(in crate::world) id: BodyId,
    /// Whether forces and impulses wake the body.
    wakes: bool,
}

/// What can be read of a body, of a [`BodyMut`] too.
macro_rules! read_like_body_ref {
    ($($name:ident($($argument:ident: $type:ty)?) -> $result:ty;)*) => {
        /// What [`BodyRef`] tells.
        impl BodyMut<'_> {
            $(
                #[doc = concat!("[`BodyRef::", stringify!($name), "`] of the body.")]
                pub fn $name(&self $(, $argument: $type)?) -> $result {
                    self.view().$name($($argument)?)
                }
            )*
        }
    };
}

read_like_body_ref! {
    position() -> Vec2;
    position_f64() -> [f64; 2];
    angle() -> f32;
    rotation() -> Rot;
    pose() -> Pose;
    previous_pose() -> Pose;
    interpolated_pose(alpha: f32) -> Pose;
    velocity() -> Vec2;
    angular_velocity() -> f32;
    velocity_at(place: impl Into<Point>) -> Vec2;
    kinetic_energy() -> f64;
    mass() -> f32;
    mass_override() -> Option<f32>;
    inertia() -> f32;
    fixed_rotation() -> bool;
    tier() -> Tier;
    body_type() -> BodyType;
    shape() -> &Shape;
    aabb() -> Aabb;
    material() -> Material;
    density() -> f32;
    friction() -> f32;
    restitution() -> f32;
    friction_mix() -> Option<Mix>;
    restitution_mix() -> Option<Mix>;
    gravity_scale() -> f32;
    linear_damping() -> f32;
    angular_damping() -> f32;
    user_data() -> u64;
    filter() -> Filter;
    is_sensor() -> bool;
    surface_speed() -> f32;
    rolling_resistance() -> f32;
    one_way() -> Option<Vec2>;
    may_sleep() -> bool;
    is_sleeping() -> bool;
    contains(place: impl Into<Point>) -> bool;
    describe() -> Body;
}

impl<'a> BodyMut<'a> {
    /// The view of a body that is there.
    pub(in crate::world) fn new(world: &'a mut World, id: BodyId) -> Self {
        Self { world, id, wakes: true }
    }

    /// Its id.
    pub fn id(&self) -> BodyId {
        self.id
    }

    /// The read-only view of the body.
    pub fn view(&self) -> BodyRef<'_> {
        BodyRef::new(self.world, self.id)
    }

    pub(in crate::world) fn slot(&self) -> u32 {
        self.id.0.index()
    }

    fn record_mut(&mut self) -> &mut Record {
        let slot = self.slot();
        &mut self.world.bodies.records[slot]
    }

    fn motion_mut(&mut self) -> &mut Motion {
        let slot = self.slot();
        &mut self.world.bodies.motions[slot as usize]
    }

    fn forcing_mut(&mut self) -> &mut Forcing {
        let slot = self.slot();
        &mut self.world.bodies.forcings[slot as usize]
    }

    /// The row of the body; `None` for one that is fixed or sleeps, which has none.
    fn state_mut(&mut self) -> Option<&mut BodyState> {
        let slot = self.slot();
        let row = self.world.bodies.motions[slot as usize].row;
        if self.world.bodies.is_awake(slot) { self.world.bodies.states.get_mut(row as usize) } else { None }
    }

    /// Refuses what a game does every frame, and says so.
    #[track_caller]
    pub(in crate::world) fn refuse(&mut self, error: BodyError) -> &mut Self {
        self.world.refuse(self.id, error);
        self
    }

    /// Wakes the body and all that it rests on or that rests on it.
    pub fn wake(&mut self) -> &mut Self {
        self.world.wake_slot(self.slot());
        self
    }

    /// Forces, torques and impulses given by this view do not wake the body, and do not keep it awake. While it sleeps they do
    /// nothing. It is meant for wind, water or drag, which act on all bodies for ever.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// # world.add(Body::dynamic(Shape::circle(0.5)))?;
    /// for id in world.bodies_in([-5.0, 0.0], [5.0, 10.0]) {
    ///     world.body_mut(id).unwrap().without_waking().apply_force([0.05, 0.0]);
    /// }
    /// # Ok::<(), BodyError>(())
    /// ```
    #[must_use]
    pub fn without_waking(mut self) -> Self {
        self.wakes = false;
        self
    }

    /// Puts the centre of mass at `center`, m. The velocity stays as it is, and nothing on the way is met. A kinematic body that is to push and
    /// carry what it meets is [moved](Self::move_to).
    ///
    /// # Errors
    /// [`BodyError`], if a coordinate is not finite or beyond 10¹² m.
    pub fn set_position(&mut self, center: impl Into<Point>) -> Result<(), BodyError> {
        let center = center.into();
        check_place(center)?;
        self.put(Some(center), None);
        Ok(())
    }

    /// Turns the body to `angle`, rad. Axis-aligned boxes stay as they are.
    ///
    /// # Errors
    /// [`BodyError`], if the angle is not finite or beyond 10¹⁸ rad.
    pub fn set_angle(&mut self, angle: f32) -> Result<(), BodyError> {
        check_strength("the angle", angle, "rad")?;
        self.put(None, Some(Rot::from_angle(angle)));
        Ok(())
    }

    /// Puts the body into `pose`. Axis-aligned boxes stay as they are turned.
    ///
    /// # Errors
    /// [`BodyError`], if a coordinate is not finite or beyond 10¹² m, or the rotation is none: c² + s² must be 1, to a
    /// thousandth.
    pub fn set_pose(&mut self, pose: Pose) -> Result<(), BodyError> {
        check_place(pose.center)?;
        check_rotation(pose.rotation)?;
        self.put(Some(pose.center), Some(pose.rotation.normalized()));
        Ok(())
    }

    /// Puts the body somewhere, without a way there, and lets box and neighbours know.
    fn put(&mut self, center: Option<Point>, rotation: Option<Rot>) {
        let slot = self.slot();
        let rotation = rotation.filter(|_| self.world.bodies.can_be_turned(slot));
        if center.is_none() && rotation.is_none() {
            return;
        }
        self.wake();
        let place = |pose: &mut Pose| {
            pose.center = center.unwrap_or(pose.center);
            pose.rotation = rotation.unwrap_or(pose.rotation);
        };
        place(&mut self.motion_mut().pose);
        if let Some(previous) = self.world.bodies.previous_pose_mut(slot) {
            place(previous);
        }
        self.world.update_place(slot);
        self.world.contacts.forget_moving(&self.world.bodies, slot);
        self.world.wake_neighbours(slot);
    }

    /// Sets the velocity of the centre of mass, m/s, cut to [`Settings::max_speed`](crate::Settings::max_speed). Fixed bodies stay
    /// at rest. Refused beyond 10¹⁸ m/s.
    #[track_caller]
    pub fn set_velocity(&mut self, velocity: impl Into<Vec2>) -> &mut Self {
        let velocity = velocity.into();
        if let Err(error) = check_vector("the velocity", velocity, "m/s") {
            return self.refuse(error);
        }
        self.wake_to_be_moved();
        self.motion_mut().velocity_compensation = Vec2::ZERO;
        if let Some(state) = self.state_mut() {
            state.velocity = velocity.into();
        }
        self.velocity_was_set();
        self
    }

    /// Sets the angular velocity, rad/s, cut to [`Settings::max_spin`](crate::Settings::max_spin). Fixed bodies, axis-aligned
    /// boxes and bodies with [fixed rotation](Body::fixed_rotation) do not turn. Refused beyond 10¹⁸ rad/s.
    #[track_caller]
    pub fn set_angular_velocity(&mut self, angular_velocity: f32) -> &mut Self {
        if let Err(error) = check_strength("the angular velocity", angular_velocity, "rad/s") {
            return self.refuse(error);
        }
        if self.can_turn() {
            self.wake_to_be_moved();
            if let Some(state) = self.state_mut() {
                state.angular_velocity = angular_velocity;
            }
            self.velocity_was_set();
        }
        self
    }

    fn can_turn(&self) -> bool {
        self.shape().can_rotate() && !self.fixed_rotation()
    }

    /// Wakes a dynamic body. A kinematic one never sleeps, and wakes what it touches or leads as it moves: that it is told each tick to stand still
    /// keeps nothing awake.
    fn wake_to_be_moved(&mut self) {
        if self.body_type() == BodyType::Dynamic {
            self.wake();
        }
    }

    fn velocity_was_set(&mut self) {
        let slot = self.slot();
        self.record_mut().stops_after_tick = false;
        self.world.cut_velocity(slot);
        self.world.update_box(slot);
        self.world.wake_what_is_led_by(slot);
    }

    /// Moves a kinematic body to `pose` within the next tick. It pushes what it meets on the way, and takes along what stands on it. Called
    /// before each tick it follows a path.
    ///
    /// [`velocity`](BodyRef::velocity) is what the way takes until the tick is over. Then the body stops and its velocity is 0, so that it is 0
    /// whenever it is read after a step.
    ///
    /// Its velocity changes from tick to tick, and not in between: what lies on a lift that is braked at nearly g parts from it by millimetres,
    /// and its contacts end and begin.
    ///
    /// Faster than [`Settings::max_speed`](crate::Settings::max_speed) it is late. It takes the shorter way round. Refused where
    /// the pose is none, as by [`set_pose`](Self::set_pose), or the body is not kinematic.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// let lift = world.add(Body::kinematic(Shape::obb(3.0, 0.3)))?;
    /// world.advance_with(0.1, |world| {
    ///     let height = world.ticks() as f64 / 60.0;
    ///     world.body_mut(lift).unwrap().move_to(Pose::at([0.0, height]));
    /// });
    /// assert!((world.body(lift).unwrap().position().y - 5.0 / 60.0).abs() < 1e-6);
    /// # Ok::<(), BodyError>(())
    /// ```
    #[track_caller]
    pub fn move_to(&mut self, pose: Pose) -> &mut Self {
        let check = || {
            if self.body_type() != BodyType::Kinematic {
                return Err(BodyError::NotKinematic { body_type: self.body_type() });
            }
            check_place(pose.center)?;
            check_rotation(pose.rotation)
        };
        if let Err(error) = check() {
            return self.refuse(error);
        }
        let tick = self.world.settings.tick_seconds() as f32;
        let velocity = (pose.center - self.pose().center) / tick;
        let turn = if self.can_turn() { (pose.rotation * self.rotation().inverse()).angle() } else { 0.0 };
        if let Some(state) = self.state_mut() {
            state.velocity = velocity.into();
            state.angular_velocity = turn / tick;
        }
        self.velocity_was_set();
        self.record_mut().stops_after_tick = true;
        self.world.arriving.push(self.id);
        self
    }

    /// Changes the velocity by `impulse`/mass; N s, at the centre of mass. Only dynamic bodies respond; an impulse of 0 does
    /// not even wake them. Refused beyond 10¹⁸ N s.
    #[track_caller]
    pub fn apply_impulse(&mut self, impulse: impl Into<Vec2>) -> &mut Self {
        let impulse = impulse.into();
        match check_vector("the impulse", impulse, "N s") {
            Ok(()) => self.add_velocity(impulse, 0.0),
            Err(error) => self.refuse(error),
        }
    }

    /// Changes velocity and spin by an impulse, N s, that acts at `place`, m, in the way of
    /// [`apply_impulse`](Self::apply_impulse). Refused beyond 10¹⁸ N s and 10¹² m.
    #[track_caller]
    pub fn apply_impulse_at(&mut self, impulse: impl Into<Vec2>, place: impl Into<Point>) -> &mut Self {
        let (impulse, place) = (impulse.into(), place.into());
        match check_vector("the impulse", impulse, "N s").and_then(|()| check_place(place)) {
            Ok(()) => self.add_velocity(impulse, (place - self.pose().center).cross(impulse)),
            Err(error) => self.refuse(error),
        }
    }

    /// Changes the angular velocity by `impulse`/inertia; N m s. Only dynamic bodies that can turn respond. Refused beyond
    /// 10¹⁸ N m s.
    #[track_caller]
    pub fn apply_angular_impulse(&mut self, impulse: f32) -> &mut Self {
        match check_strength("the angular impulse", impulse, "N m s") {
            Ok(()) => self.add_velocity(Vec2::ZERO, impulse),
            Err(error) => self.refuse(error),
        }
    }

    fn add_velocity(&mut self, impulse: Vec2, angular_impulse: f32) -> &mut Self {
        let Motion { inverse_mass, inverse_inertia, .. } = *self.motion_mut();
        let is_none = impulse == Vec2::ZERO && angular_impulse == 0.0;
        if is_none || inverse_mass == 0.0 {
            return self;
        }
        if self.wakes {
            self.wake();
        }
        if let Some(state) = self.state_mut() {
            state.velocity = (state.velocity.to_vec2() + impulse * inverse_mass).into();
            state.angular_velocity += angular_impulse * inverse_inertia;
            let slot = self.slot();
            self.world.cut_velocity(slot);
            self.world.update_box(slot);
        }
        self
    }

    /// Applies a force, N, at the centre of mass during the next step, or for as long as the next
    /// [`advance`](World::advance) is. Forces of several calls add up. Only dynamic bodies respond; a force of 0 does not even
    /// wake them. Refused beyond 10¹⁸ N.
    ///
    /// The force is held over the whole tick. If it depends on where the body is, as that of a spring or of water does, it
    /// comes half a tick late and adds energy without end. Use a [spring joint](crate::Joint::distance) in its place, or give an
    /// impulse before each tick, `apply_impulse(force * tick_seconds)` in [`advance_with`](World::advance_with): that keeps the
    /// energy. What hovers by such impulses has the velocity -g·dt/2 between ticks: it has fallen for half a tick.
    #[track_caller]
    pub fn apply_force(&mut self, force: impl Into<Vec2>) -> &mut Self {
        let force = force.into();
        match check_vector("the force", force, "N") {
            Ok(()) => self.add_force(force, 0.0),
            Err(error) => self.refuse(error),
        }
    }

    /// Applies a force, N, at `place`, m, in the way of [`apply_force`](Self::apply_force). Refused beyond 10¹⁸ N and 10¹² m.
    #[track_caller]
    pub fn apply_force_at(&mut self, force: impl Into<Vec2>, place: impl Into<Point>) -> &mut Self {
        let (force, place) = (force.into(), place.into());
        match check_vector("the force", force, "N").and_then(|()| check_place(place)) {
            Ok(()) => self.add_force(force, (place - self.pose().center).cross(force)),
            Err(error) => self.refuse(error),
        }
    }

    /// Applies a torque, N m, in the way of [`apply_force`](Self::apply_force). Only dynamic bodies that can turn respond.
    /// Refused beyond 10¹⁸ N m.
    #[track_caller]
    pub fn apply_torque(&mut self, torque: f32) -> &mut Self {
        match check_strength("the torque", torque, "N m") {
            Ok(()) => self.add_force(Vec2::ZERO, torque),
            Err(error) => self.refuse(error),
        }
    }

    fn add_force(&mut self, force: Vec2, torque: f32) -> &mut Self {
        let force = TickForce { body: self.id, force, torque, wakes: self.wakes };
        if self.world.add_force_to(force) {
            self.world.forced.push(Forced { body: self.id, wakes: force.wakes });
        }
        self
    }

    /// Sets the factor on the world's forces.
    ///
    /// # Errors
    /// [`BodyError`], if it is not finite or beyond ±10⁶.
    pub fn set_gravity_scale(&mut self, scale: f32) -> Result<(), BodyError> {
        check_gravity_scale(scale)?;
        self.forcing_mut().gravity_scale = scale;
        self.wake();
        Ok(())
    }

    /// Sets the linear damping, 1/s, 0 or more.
    ///
    /// # Errors
    /// [`BodyError`], if it is negative, not finite or beyond 10⁶ 1/s.
    pub fn set_linear_damping(&mut self, damping: f32) -> Result<(), BodyError> {
        check_damping("the linear damping", damping)?;
        self.forcing_mut().linear_damping = damping;
        self.wake();
        Ok(())
    }

    /// Sets the angular damping, 1/s, 0 or more.
    ///
    /// # Errors
    /// [`BodyError`], if it is negative, not finite or beyond 10⁶ 1/s.
    pub fn set_angular_damping(&mut self, damping: f32) -> Result<(), BodyError> {
        check_damping("the angular damping", damping)?;
        self.forcing_mut().angular_damping = damping;
        self.wake();
        Ok(())
    }

    /// Sets whether the body may be put to sleep once it is at rest; where it may not, neither may what it touches.
    pub fn set_may_sleep(&mut self, may_sleep: bool) {
        self.motion_mut().may_sleep = may_sleep;
        self.wake();
    }

    /// Sets the caller's own number. A contact filter that reads it is not asked again of what is near.
    pub fn set_user_data(&mut self, user_data: u64) {
        self.record_mut().user_data = user_data;
    }
}
