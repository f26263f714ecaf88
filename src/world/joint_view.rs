//! Views of a joint: to read it, and to change it.

use core::ops::RangeInclusive;

use crate::body::BodyId;
use crate::joint::{End, Joint, JointError, JointId, JointKind, JointRecord, Motor, Spring};
use crate::math::{Point, Vec2};
use crate::world::World;
use crate::world::events::JointRefusal;

/// How far a joint is off what it holds.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add_force(Force::EARTH_GRAVITY);
/// let lamp = world.add(Body::dynamic(Shape::circle(0.2)).at([1.0, 0.0]))?;
/// let rod = world.add_joint(Joint::distance(lamp, None).between([1.0, 0.0], [0.0, 0.0]))?;
/// for _ in 0..60 {
///     world.step();
/// }
/// assert!(world.joint(rod).unwrap().error().distance < 1e-5); // m, while it swings
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct JointGap {
    /// Largest gap of its anchors, or way beyond a limit, m.
    pub distance: f32,
    /// Largest angle that it does not hold, or beyond a limit, rad.
    pub angle: f32,
}

/// A joint of a world.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add_force(Force::EARTH_GRAVITY);
/// let lamp = world.add(Body::dynamic(Shape::circle(0.2)).mass(3.0))?;
/// let hook = world.add_joint(Joint::weld(lamp, None))?;
/// world.step();
/// let hook = world.joint(hook).unwrap();
/// assert!((hook.force().length() - 3.0 * 9.81).abs() < 1e-3); // N: it bears the weight
/// assert_eq!((hook.kind(), hook.body_a(), hook.body_b()), (JointKind::Weld, lamp, None));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct JointRef<'a> {
    world: &'a World,
    id: JointId,
}

impl<'a> JointRef<'a> {
    pub(in crate::world) fn new(world: &'a World, id: JointId) -> Self {
        Self { world, id }
    }

    fn record(&self) -> &'a JointRecord {
        &self.world.joints.all[self.id.0.index()]
    }

    /// Its id.
    pub fn id(&self) -> JointId {
        self.id
    }

    /// What kind of joint it is.
    pub fn kind(&self) -> JointKind {
        self.record().description.kind
    }

    /// Its first body.
    pub fn body_a(&self) -> BodyId {
        self.record().description.a
    }

    /// Its second body; `None` where that is the world.
    pub fn body_b(&self) -> Option<BodyId> {
        self.record().description.b
    }

    /// Its description, as it was added and has been changed since.
    pub fn describe(&self) -> Joint {
        self.record().description.clone()
    }

    /// Where its anchors are, m: that on `a`, and that on `b` or in the world.
    pub fn anchors(&self) -> [Point; 2] {
        self.record().anchors(&self.world.bodies)
    }

    /// The angle of `b` from `a` since the joint was added, rad, of any number of turns.
    pub fn angle(&self) -> f64 {
        self.record().angle()
    }

    /// How fast the angle grows, rad/s.
    pub fn angular_speed(&self) -> f64 {
        let spin = |body: BodyId| f64::from(self.world.bodies.state(body.0.index()).angular_velocity);
        self.body_b().map_or(0.0, spin) - spin(self.body_a())
    }

    /// The axis, in the frame of the world, of length 1: of a prismatic or wheel joint that along which it slides, of others the
    /// direction from the anchor on `a` to the other.
    fn direction(&self) -> Vec2 {
        let record = self.record();
        if matches!(self.kind(), JointKind::Prismatic | JointKind::Wheel) {
            return self.world.bodies.motions[record.slot_a as usize].pose.rotation.rotate(record.axis);
        }
        let [a, b] = self.anchors();
        (b - a).normalized_or_zero()
    }

    /// Where the rope of a pulley leaves for `a`, and for `b`, m; `None` for other kinds.
    pub fn wheels(&self) -> Option<[Point; 2]> {
        self.record().description.wheels
    }

    /// How long it is, m: the most that its [`translation`](Self::translation) may be, of the rope of a pulley, and of a distance joint as far
    /// as it has one. `None` where there is none, as of a spring.
    pub fn length(&self) -> Option<f64> {
        let JointRecord { description, length, .. } = self.record();
        let is_free = description.spring.is_some() || description.motor.is_some();
        match (description.kind, description.limits) {
            (JointKind::Distance, Some([_, most])) => Some(most).filter(|most| most.is_finite()),
            (JointKind::Distance, None) if is_free => None,
            (JointKind::Distance | JointKind::Pulley, _) => Some(*length),
            _ => None,
        }
    }

    /// Where the anchor of `b` is from the anchor of `a`, m.
    ///
    /// Of a prismatic or wheel joint it is the way along the axis, with its sign: positive where `b` is ahead of `a`. Of a pulley it is how much
    /// of its rope is in use: the distance of the anchor on `a` from its wheel, and the ratio times that of the one on `b` from its own; less
    /// than its [`length`](Self::length) where it is slack. Of all other kinds it is the distance of the two anchors, which is never negative.
    pub fn translation(&self) -> f64 {
        if let Some(rope) = self.record().rope(&self.world.bodies) {
            return rope;
        }
        let [a, b] = self.anchors();
        let (axis, gap) = (self.direction(), [b.x - a.x, b.y - a.y]);
        f64::from(axis.x) * gap[0] + f64::from(axis.y) * gap[1]
    }

    /// How fast the joint moves.
    ///
    /// Of prismatic, distance and drag joints and of pulleys it is how fast the [`translation`](Self::translation) grows, m/s. Of all other
    /// kinds, wheels too, it is the [`angular_speed`](Self::angular_speed), rad/s. So it is the speed that a [motor](Joint::motor) of the
    /// joint drives.
    pub fn speed(&self) -> f64 {
        let [a, b] = self.anchors();
        let velocity_at = |body: BodyId, place: Point| {
            self.world.body(body).map_or(Vec2::ZERO, |body| body.velocity_at(place))
        };
        if let (Some([wheel_a, wheel_b]), Some(body_b)) = (self.wheels(), self.body_b()) {
            let away = |body, anchor: Point, wheel: Point| {
                f64::from((anchor - wheel).normalized_or_zero().dot(velocity_at(body, anchor)))
            };
            let ratio = self.record().description.ratio;
            return away(self.body_a(), a, wheel_a) + ratio * away(body_b, b, wheel_b);
        }
        if !matches!(self.kind(), JointKind::Prismatic | JointKind::Distance | JointKind::Drag) {
            return self.angular_speed();
        }
        // The axis turns with a, and so the point of a that is at the anchor of b is what b slides along.
        let of_a = if self.kind() == JointKind::Prismatic { b } else { a };
        let of_b = self.body_b().map_or(Vec2::ZERO, |body| velocity_at(body, b));
        f64::from(self.direction().dot(of_b - velocity_at(self.body_a(), of_a)))
    }

    /// The force on `b` (or the world) at its anchor, N, on average over the last step; that on `a` is opposite. Times the length of
    /// the step it is the impulse, N s, that of a blow too. While its bodies sleep it is that of the step in which they fell asleep.
    ///
    /// A pulley pulls each body to its own wheel: `b` with this force, the ratio times the tension of the rope, and `a` with the tension.
    pub fn force(&self) -> Vec2 {
        self.record().state.force
    }

    /// The torque on `b` (or the world) beside that of the force, N m, on average over the last step: of motors, springs and limits of
    /// the angle, and of welds. While its bodies sleep it is that of the step in which they fell asleep.
    pub fn torque(&self) -> f32 {
        self.record().state.torque
    }

    /// How far it is off what it holds, after the last step in which it acted.
    ///
    /// It acts in a step if it is enabled and one of its bodies is dynamic and awake. So a joint whose bodies have both been made fixed or
    /// kinematic since shows no new gap, however far they are set apart.
    pub fn error(&self) -> JointGap {
        let state = &self.record().state;
        JointGap { distance: state.gap, angle: state.angle_gap }
    }

    /// Whether it acts.
    pub fn is_enabled(&self) -> bool {
        self.record().description.enabled
    }

    /// The number of the caller's.
    pub fn user_data(&self) -> u64 {
        self.record().description.user_data
    }
}

/// A joint of a world, to change it. What changes wakes its bodies.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// let wheel = world.add(Body::dynamic(Shape::circle(0.5)).mass(1.0))?;
/// let axle = world.add_joint(Joint::revolute(wheel, None).motor(0.0, 50.0))?;
/// if let Some(mut axle) = world.joint_mut(axle) {
///     axle.set_motor(6.0, 50.0); // the pedal
/// }
/// for _ in 0..60 {
///     world.step();
/// }
/// assert!((world.body(wheel).unwrap().angular_velocity().abs() - 6.0).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct JointMut<'a> {
    world: &'a mut World,
    id: JointId,
}

impl<'a> JointMut<'a> {
    pub(in crate::world) fn new(world: &'a mut World, id: JointId) -> Self {
        Self { world, id }
    }

    /// The read-only view of the joint.
    pub fn view(&self) -> JointRef<'_> {
        JointRef::new(self.world, self.id)
    }

    fn record_mut(&mut self) -> &mut JointRecord {
        &mut self.world.joints.all[self.id.0.index()]
    }

    fn change(&mut self, change: impl FnOnce(&mut Joint)) -> Result<(), JointError> {
        let mut joint = self.view().describe();
        change(&mut joint);
        self.world.validate_joint(&joint)?;
        let record = self.record_mut();
        if record.description == joint {
            return Ok(());
        }
        // Rows that come or go leave those after them at other places.
        let options = |joint: &Joint| (joint.motor.is_some(), joint.spring.is_some(), joint.limits.is_some());
        if options(&record.description) != options(&joint) {
            record.state.loads = Default::default();
        }
        let touching_changes = record.description.collide_connected != joint.collide_connected;
        record.description = joint;
        self.world.joint_changed(self.id, touching_changes);
        Ok(())
    }

    /// A change of every frame: one that is refused is reported.
    #[track_caller]
    fn steer(&mut self, change: impl FnOnce(&mut Joint)) {
        if let Err(error) = self.change(change) {
            self.refuse(error);
        }
    }

    #[track_caller]
    #[expect(clippy::manual_assert, reason = "the build decides, not a condition")]
    fn refuse(&mut self, error: JointError) {
        if cfg!(debug_assertions) {
            panic!("{error}");
        }
        self.world.events.joints_refused_by_edit.push(JointRefusal { joint: self.id, error });
    }

    /// Drives it at a speed, rad/s or m/s, with `max` torque, N m, or force, N, at most.
    ///
    /// # Panics
    /// In a debug build, if the kind has no motor or a number is one that [`World::add_joint`] refuses; in a release build the
    /// joint stays as it is, and [`Events::refused_joints`](crate::Events::refused_joints) tells.
    #[track_caller]
    pub fn set_motor(&mut self, speed: f32, max: f32) {
        self.steer(|joint| joint.motor = Some(Motor { speed, max }));
    }

    /// Moves the target of a drag joint, m.
    ///
    /// # Panics
    /// As [`set_motor`](Self::set_motor).
    #[track_caller]
    pub fn set_target(&mut self, target: impl Into<Point>) {
        let target = target.into();
        self.steer(|joint| joint.target = Some(target));
        let record = self.record_mut();
        if let (JointKind::Drag, Some(target)) = (record.description.kind, record.description.target) {
            record.end = End::World(target);
        }
    }

    /// Moves the rest of the spring of the angle, rad, or of the translation, m: a motor to a position.
    ///
    /// # Panics
    /// As [`set_motor`](Self::set_motor).
    #[track_caller]
    pub fn set_rest(&mut self, rest: f64) {
        self.steer(|joint| joint.rest = rest);
    }

    /// Takes the motor away, if there is one.
    pub fn remove_motor(&mut self) {
        self.steer(|joint| joint.motor = None);
    }

    /// Sets from where to where the angle, rad, the translation or the distance, m, may go; `None` for anywhere. A distance joint with neither
    /// limits nor a spring nor a motor is a rod, of the length that it was added with.
    ///
    /// # Errors
    /// [`JointError`], if the limits are ones that [`World::add_joint`] refuses, or the joint is of a kind that has none.
    pub fn set_limits(&mut self, limits: impl Into<Option<RangeInclusive<f64>>>) -> Result<(), JointError> {
        let limits = limits.into().map(|range| [*range.start(), *range.end()]);
        self.change(|joint| joint.limits = limits)
    }

    /// Sets frequency, Hz, and damping ratio of the spring.
    ///
    /// # Errors
    /// [`JointError`], if a number is one that [`World::add_joint`] refuses, or the joint is of a kind that has no spring.
    pub fn set_spring(&mut self, hertz: f32, damping_ratio: f32) -> Result<(), JointError> {
        self.change(|joint| joint.spring = Some(Spring { hertz, damping_ratio }))
    }

    /// Takes the spring away, if there is one. A drag or motor joint does nothing without one; a weld is rigid.
    pub fn remove_spring(&mut self) {
        self.steer(|joint| joint.spring = None);
    }

    /// Sets the length of a distance joint, the greatest of one with limits and no spring, as of a rope, or that of the rope of a pulley, m: a winch. What is too far apart for it comes together at no more than
    /// 3 m/s, whatever is in its way: it is put where the length has it, as by hand, and its [`velocity`](crate::BodyRef::velocity) does not
    /// tell of that. A winch that pulls with a force, and stops at what is in its way, is a distance joint with a [motor](Joint::motor).
    ///
    /// # Errors
    /// [`JointError`], if the length is one that [`World::add_joint`] refuses, or the joint is of another kind.
    pub fn set_length(&mut self, length: f32) -> Result<(), JointError> {
        self.change(|joint| match (joint.kind, joint.spring, &mut joint.limits) {
            (JointKind::Distance, None, Some([_, most])) => *most = f64::from(length),
            _ => joint.length = Some(length),
        })?;
        self.record_mut().length = f64::from(length);
        Ok(())
    }

    /// Sets the greatest force, N.
    ///
    /// # Errors
    /// [`JointError`], if the joint has none, or the number is not a force.
    pub fn set_max_force(&mut self, force: f32) -> Result<(), JointError> {
        self.change(|joint| joint.max_force = Some(force))
    }

    /// Sets the greatest torque, N m.
    ///
    /// # Errors
    /// [`JointError`], if the joint has none, or the number is not a torque.
    pub fn set_max_torque(&mut self, torque: f32) -> Result<(), JointError> {
        self.change(|joint| joint.max_torque = Some(torque))
    }

    /// Sets by which force, N, or torque, N m, it breaks; `None` for never.
    ///
    /// # Errors
    /// [`JointError`], if a number is not a force or torque.
    pub fn set_break_at(&mut self, limits: impl Into<Option<[f32; 2]>>) -> Result<(), JointError> {
        let limits = limits.into();
        self.change(|joint| joint.breaks_at = limits)
    }

    /// Sets whether it acts.
    pub fn set_enabled(&mut self, enabled: bool) {
        self.steer(|joint| joint.enabled = enabled);
    }

    /// Sets whether its bodies touch each other.
    pub fn set_collide_connected(&mut self, collide: bool) {
        self.steer(|joint| joint.collide_connected = collide);
    }

    /// Sets the number of the caller's.
    pub fn set_user_data(&mut self, user_data: u64) {
        self.record_mut().description.user_data = user_data;
    }
}
