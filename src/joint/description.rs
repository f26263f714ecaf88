//! The description of a joint.

use core::fmt;
use core::ops::RangeInclusive;

use crate::body::BodyId;
use crate::math::{Point, Vec2};

/// What a joint leaves free.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// let car = world.add(Body::dynamic(Shape::rectangle(4.0, 1.0)).at([0.0, 1.0]))?;
/// for x in [-1.5, 1.5] {
///     let tyre = world.add(Body::dynamic(Shape::circle(0.5)).at([x, 0.4]))?;
///     world.add_joint(Joint::wheel(car, tyre).axis([0.0, 1.0]).suspension(4.0, 0.7))?;
/// }
/// let wheels = world.joints_of(car).into_iter().filter(|&id| world.joint(id).unwrap().kind() == JointKind::Wheel);
/// assert_eq!(wheels.count(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum JointKind {
    /// Turning about a common point.
    Revolute,
    /// Sliding along an axis.
    Prismatic,
    /// Everything but the distance of two points.
    Distance,
    /// Nothing.
    Weld,
    /// Sliding along an axis, and turning.
    Wheel,
    /// Everything; a force and a torque of limited strength drive one body to a pose beside the other.
    Motor,
    /// Everything; a spring pulls a point of the body to a target.
    Drag,
    /// Everything; a force and a torque of limited strength resist motion.
    Friction,
    /// Everything but the sum of the two angles, one of them times a ratio.
    Gear,
    /// Turning about a common point, but not back over a tooth.
    Ratchet,
    /// Everything but what would take more rope than there is, of one that goes from `a` over two wheels to `b`.
    Pulley,
}

impl fmt::Display for JointKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Revolute => "revolute",
            Self::Prismatic => "prismatic",
            Self::Distance => "distance",
            Self::Weld => "weld",
            Self::Wheel => "wheel",
            Self::Motor => "motor",
            Self::Drag => "drag",
            Self::Friction => "friction",
            Self::Gear => "gear",
            Self::Ratchet => "ratchet",
            Self::Pulley => "pulley",
        })
    }
}

/// Drives a coordinate at a speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Motor {
    /// m/s or rad/s.
    pub(crate) speed: f32,
    /// Greatest force, N, or torque, N m.
    pub(crate) max: f32,
}

/// Pulls a coordinate to its rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spring {
    /// Frequency without damping, Hz.
    pub(crate) hertz: f32,
    /// 0 keeps swinging, 1 comes to rest soonest.
    pub(crate) damping_ratio: f32,
}

/// Where the anchors are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Anchors {
    /// Not told: see [`Joint`].
    Centers,
    /// Both at one place of the world as it is when the joint is added.
    At(Point),
    /// On each body, from its centre, in its own frame; for the world, a place in it.
    Local(Vec2, Point),
    /// Body `a` by a place of the world as it is when the joint is added; `b` by another.
    Between(Point, Point),
}

/// The description of a joint between two bodies, or a body and the world.
///
/// Where `b` is `None`, the body `a` is joined to the world. Angle and translation are those of `b` (or the world) as seen from `a`. The
/// angle is 0 as the bodies are when the joint is added, and the translation is 0 where the two anchors are at one place. The bodies do
/// not touch each other unless [`collide_connected`](Self::collide_connected) says so; those of a pulley do.
///
/// Anchors that are not told are both where the centre of mass of `b` is when the joint is added, or that of `a`, if `b` is the world; of rods, ropes
/// and pulleys each is at the centre of its own body.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add_force(Force::EARTH_GRAVITY);
/// let rod = world.add(Body::dynamic(Shape::obb(1.0, 0.1)).at([0.5, 0.0]))?;
/// let hinge = world.add_joint(Joint::revolute(rod, None).at([0.0, 0.0]))?;
/// world.step();
/// assert!(world.joint(hinge).unwrap().error().distance < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[must_use = "a description does nothing until it is added to a world"]
pub struct Joint {
    pub(crate) kind: JointKind,
    pub(crate) a: BodyId,
    pub(crate) b: Option<BodyId>,
    pub(crate) anchors: Anchors,
    pub(crate) axis: Option<Vec2>,
    pub(crate) limits: Option<[f64; 2]>,
    /// Of a rope whose limits are not told: that it becomes as long as its anchors are apart when it is added.
    pub(crate) is_as_long_as_now: bool,
    pub(crate) motor: Option<Motor>,
    pub(crate) spring: Option<Spring>,
    /// Of a distance joint: the length, or the rest of its spring, m; `None` for the distance of the anchors. Of a pulley, that of its rope;
    /// `None` for what of it is in use.
    pub(crate) length: Option<f32>,
    /// Where the spring is at rest: an angle, rad, or a translation, m.
    pub(crate) rest: f64,
    /// Of a drag joint, where its spring is at rest; of a motor joint, the offset of the anchors in the frame of the world, m.
    pub(crate) target: Option<Point>,
    pub(crate) max_force: Option<f32>,
    pub(crate) max_torque: Option<f32>,
    /// Gear: how far `a` turns back for a turn of `b`. Ratchet: the angle of a tooth, rad. Pulley: how far `a` goes for a metre of `b`.
    pub(crate) ratio: f64,
    /// Where the rope of a pulley leaves for `a` and for `b`, m.
    pub(crate) wheels: Option<[Point; 2]>,
    pub(crate) breaks_at: Option<[f32; 2]>,
    pub(crate) collide_connected: bool,
    pub(crate) enabled: bool,
    pub(crate) user_data: u64,
    pub(crate) foreign: Option<ForeignOption>,
}

/// An option whose name is one of other kinds. What it says has a meaning for this kind too, and another one: the longest distance of a rope
/// would be a limit of an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ForeignOption {
    pub(crate) name: &'static str,
    /// The kinds that have it.
    pub(crate) kinds: &'static [JointKind],
}

/// Stiffness of the spring of a motor or drag joint that is not given one: 5 Hz follows a hand within a tenth of a second, and is
/// critically damped.
const USUAL_SPRING: Spring = Spring { hertz: 5.0, damping_ratio: 1.0 };

impl Joint {
    fn new(kind: JointKind, a: BodyId, b: Option<BodyId>) -> Self {
        Self {
            kind,
            a,
            b,
            anchors: Anchors::Centers,
            axis: None,
            limits: None,
            is_as_long_as_now: false,
            motor: None,
            spring: None,
            length: None,
            rest: 0.0,
            target: None,
            max_force: None,
            max_torque: None,
            ratio: 1.0,
            wheels: None,
            breaks_at: None,
            collide_connected: false,
            enabled: true,
            user_data: 0,
            foreign: None,
        }
    }

    /// Takes note of an option that `kinds` have, if this kind has it not; the first is told of.
    fn option_of(self, name: &'static str, kinds: &'static [JointKind]) -> Self {
        let is_foreign = !kinds.contains(&self.kind);
        let foreign = self.foreign.or(is_foreign.then_some(ForeignOption { name, kinds }));
        Self { foreign, ..self }
    }

    /// A hinge. It takes limits, a motor and a spring, of the angle.
    pub fn revolute(a: BodyId, b: impl Into<Option<BodyId>>) -> Self {
        Self::new(JointKind::Revolute, a, b.into())
    }

    /// A slide along an [axis](Self::axis) of `a`. It takes limits, a motor and a spring, of the translation.
    pub fn prismatic(a: BodyId, b: impl Into<Option<BodyId>>) -> Self {
        Self::new(JointKind::Prismatic, a, b.into())
    }

    /// A rod between two anchors, of fixed [`length`](Self::length). With a spring it is a spring instead, with limits a rope between a shortest
    /// and a longest length, with a motor what that drives; and it may have all three.
    pub fn distance(a: BodyId, b: impl Into<Option<BodyId>>) -> Self {
        Self::new(JointKind::Distance, a, b.into())
    }

    /// A rope between two anchors, as long as they are apart, at least 10⁻⁶ m, unless [`max_length`](Self::max_length) says otherwise: a joint of
    /// the kind [`Distance`](JointKind::Distance) with limits.
    pub fn rope(a: BodyId, b: impl Into<Option<BodyId>>) -> Self {
        Self { is_as_long_as_now: true, ..Self::distance(a, b) }
    }

    /// Two bodies as one; with a spring, a soft one.
    pub fn weld(a: BodyId, b: impl Into<Option<BodyId>>) -> Self {
        Self::new(JointKind::Weld, a, b.into())
    }

    /// A wheel `b` on a car `a`: it slides along an [axis](Self::axis) of `a`, and turns. It takes a
    /// [`suspension`](Self::suspension) and a [`travel`](Self::travel), along the axis, and a motor, of the angle. `spring` and `limits` are other
    /// names of these two; [`rest`](Self::rest) is where along the axis its spring is at rest.
    pub fn wheel(a: BodyId, b: impl Into<Option<BodyId>>) -> Self {
        Self::new(JointKind::Wheel, a, b.into())
    }

    /// Pulls `b` back to a pose beside `a` by a spring. That is the pose which `b` has when the joint is added; with
    /// [`between`](Self::between) or [`local_anchors`](Self::local_anchors), the one where both anchors are in one place. Its angle is
    /// changed by [`JointMut::set_rest`](crate::JointMut::set_rest).
    pub fn motor_to(a: BodyId, b: impl Into<Option<BodyId>>) -> Self {
        Self { spring: Some(USUAL_SPRING), ..Self::new(JointKind::Motor, a, b.into()) }
    }

    /// Pulls the point of a body that is at `at` to a [target](Self::target), which is `at` until another is given.
    pub fn drag(body: BodyId, at: impl Into<Point>) -> Self {
        let joint = Self::new(JointKind::Drag, body, None);
        Self { anchors: Anchors::At(at.into()), spring: Some(USUAL_SPRING), ..joint }
    }

    /// Resists motion of two bodies against each other with [`max_force`](Self::max_force) and
    /// [`max_torque`](Self::max_torque) at most, of which it needs one: as on a table that is seen from above. The force acts at its anchors. As
    /// these part, it has an arm, so that the angular momentum of two bodies that are both moved by it changes.
    pub fn friction(a: BodyId, b: impl Into<Option<BodyId>>) -> Self {
        Self::new(JointKind::Friction, a, b.into())
    }

    /// Couples the angles of two bodies, each held by a joint of its own: `a` turns by `-ratio` times what `b` turns. Of wheels that mesh it is
    /// the radius of `b` over that of `a`. Its size is from 10⁻⁶ to 10⁶. Where its anchors are does not matter.
    pub fn gear(a: BodyId, b: BodyId, ratio: f64) -> Self {
        Self { ratio, ..Self::new(JointKind::Gear, a, Some(b)) }
    }

    /// A hinge that turns to greater angles only, and back no farther than to the last multiple of `tooth`, rad, from 10⁻⁶ to 10⁶. It takes
    /// a motor, and a spring with its rest, of the angle.
    pub fn ratchet(a: BodyId, b: impl Into<Option<BodyId>>, tooth: f64) -> Self {
        Self { ratio: tooth, ..Self::new(JointKind::Ratchet, a, b.into()) }
    }

    /// Two bodies on one rope over two wheels, which are fixed in the world: at `wheel_a` it leaves for `a`, and at `wheel_b` for `b`, m. With
    /// the distances of the anchors from their wheels
    ///
    /// ```text
    /// distance of a + ratio × distance of b ≤ length
    /// ```
    ///
    /// The rope does not stretch, weighs nothing, and can be slack. It is [as long](Self::length) as it takes when it is added, unless said. With
    /// a [`ratio`](Self::ratio) it is a block and tackle. The anchors are the centres of the bodies, unless said. The bodies touch each
    /// other, which those of other kinds do not: they hang side by side.
    ///
    /// An anchor that is drawn up to its wheel goes on through it, as the wheel is a place and has no size, and that close a step takes up to
    /// a millisecond: let a stop hold it before that, as a [rope](Self::rope) for the other body, or a beam to lie against.
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// let mut world = World::new(Settings::default());
    /// world.add_force(Force::EARTH_GRAVITY);
    /// let car = world.add(Body::dynamic(Shape::rectangle(1.0, 2.0)).at([-1.0, 0.0]).mass(500.0))?;
    /// let weight = world.add(Body::dynamic(Shape::rectangle(0.5, 1.0)).at([1.0, 0.0]).mass(300.0))?;
    /// // From the middle of the roof up; the machine of G. Atwood (1784) has g (m_a - m_b)/(m_a + m_b).
    /// let lift = Joint::pulley(car, weight, [-1.0, 9.0], [1.0, 9.0]).local_anchors([0.0, 1.0], [0.0, 0.5]);
    /// let lift = world.add_joint(lift)?;
    /// for _ in 0..60 {
    ///     world.step();
    /// }
    /// let speed = world.body(weight).unwrap().velocity().y;
    /// assert!((speed - 9.81 * 200.0 / 800.0).abs() < 1e-4);
    /// assert!(world.joint(lift).unwrap().error().distance < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn pulley(a: BodyId, b: BodyId, wheel_a: impl Into<Point>, wheel_b: impl Into<Point>) -> Self {
        let wheels = Some([wheel_a.into(), wheel_b.into()]);
        Self { wheels, collide_connected: true, ..Self::new(JointKind::Pulley, a, Some(b)) }
    }

    /// The ratio of a pulley, from 10⁻⁶ to 10⁶, no unit, 1 unless said: how many metres `a` goes up for each that `b` comes down, and how many
    /// times the tension of the rope `b` bears. With 3, `b` hangs in a block on three strands, and a third of its weight at `a` holds it. Of
    /// a [gear](Self::gear) it takes the place of the one that it was made with, and may be negative.
    pub fn ratio(self, ratio: f64) -> Self {
        Self { ratio, ..self.option_of("ratio", &[JointKind::Gear, JointKind::Pulley]) }
    }

    /// Both anchors at one place of the world, m, as it is when the joint is added.
    pub fn at(self, place: impl Into<Point>) -> Self {
        Self { anchors: Anchors::At(place.into()), ..self }
    }

    /// The anchors on each body, m, from its centre and in its own frame; where there is no `b`, a place of the world.
    pub fn local_anchors(self, a: impl Into<Vec2>, b: impl Into<Point>) -> Self {
        Self { anchors: Anchors::Local(a.into(), b.into()), ..self }
    }

    /// The same as [`local_anchors`](Self::local_anchors).
    pub fn anchors(self, a: impl Into<Vec2>, b: impl Into<Point>) -> Self {
        self.local_anchors(a, b)
    }

    /// The anchor of each body at a place of the world, m, as it is when the joint is added.
    pub fn between(self, a: impl Into<Point>, b: impl Into<Point>) -> Self {
        Self { anchors: Anchors::Between(a.into(), b.into()), ..self }
    }

    /// The direction along which a prismatic or wheel joint slides. Its length does not matter.
    ///
    /// It is given in the frame of the world, as `a` is turned when the joint is added. From then on it is fixed to `a` and turns with it.
    /// Unless said it is the x axis of the world, and for a wheel the y axis.
    pub fn axis(self, axis: impl Into<Vec2>) -> Self {
        Self { axis: Some(axis.into()), ..self }
    }

    /// From where to where the angle (rad, of any number of turns), the translation or the distance (m) may go.
    /// `0.0..=f64::INFINITY` is open at its end. Finite limits are within ±10⁹ rad or ±10¹² m; of a distance joint they are 0 m or more,
    /// and the upper one at least 10⁻⁶ m. They are for revolute, prismatic, distance and wheel joints. What is beyond them comes to them at no
    /// more than 3 m/s, or 3 rad/s: a winch that is to be faster takes a motor of the distance. A wall in between does not hold them up:
    /// joints are exact, and contacts yield to them.
    pub fn limits(self, range: RangeInclusive<impl Into<f64> + Copy>) -> Self {
        Self { limits: Some([(*range.start()).into(), (*range.end()).into()]), ..self }
    }

    /// How far a wheel may move along the axis, m. Other kinds have [`limits`](Self::limits).
    pub fn travel(self, range: RangeInclusive<impl Into<f64> + Copy>) -> Self {
        self.option_of("travel", &[JointKind::Wheel]).limits(range)
    }

    /// The longest distance of the anchors of a rope or distance joint, m. Other kinds have [`limits`](Self::limits).
    pub fn max_length(self, length: f32) -> Self {
        self.option_of("greatest length", &[JointKind::Distance]).limits(0.0..=f64::from(length))
    }

    /// Drives the angle at a speed in rad/s with a torque of at most `max`, N m; or the translation or distance at a speed in m/s with a force
    /// of at most `max`, N. `max` may be infinite; the speed is within ±10⁹. The angle is driven of revolute, wheel and ratchet joints, the
    /// translation of prismatic ones, the distance of distance joints.
    ///
    /// A positive speed turns `b` counter-clockwise as seen from `a`, or moves `b` along the axis. Where `b` is the world it is `a` that moves,
    /// and it moves the other way: a positive speed turns it clockwise. To turn a body counter-clockwise against the world, give a negative
    /// speed. Or add a fixed body and give that as `a`, and the body as `b`.
    ///
    /// A motor of infinite force drives bodies through walls. At speed 0 a motor is a brake, and creeps under a load; to lock, give
    /// [`limits`](Self::limits) of one value.
    pub fn motor(self, speed: f32, max: f32) -> Self {
        Self { motor: Some(Motor { speed, max }), ..self }
    }

    /// A spring by its frequency, from 10⁻⁶ to 10⁶ Hz, and damping ratio, from 0, which swings for ever, by 1, which comes to rest soonest,
    /// to 10⁶. The frequency is that of the two masses on it, or their moments of inertia, about their centres; other joints slow it. All kinds
    /// but friction joints, gears and pulleys take one. Without damping a stiff spring may gain energy between bodies that turn fast. From
    /// half the rate of substeps on one with damping may too, most of all as its bodies bounce.
    pub fn spring(self, hertz: f32, damping_ratio: f32) -> Self {
        Self { spring: Some(Spring { hertz, damping_ratio }), ..self }
    }

    /// The spring of a wheel along its axis: frequency, Hz, and damping ratio, as of [`spring`](Self::spring). The frequency is that
    /// of the wheel, which swings while the car all but rests. A car of mass M on n wheels of mass m each bounces slower, by
    /// √(n m / M). So for a car of 900 kg on two wheels of 20 kg that is to bounce at 1.5 Hz, give 7 Hz.
    ///
    /// Other kinds have a [`spring`](Self::spring).
    pub fn suspension(self, hertz: f32, damping_ratio: f32) -> Self {
        self.option_of("suspension", &[JointKind::Wheel]).spring(hertz, damping_ratio)
    }

    /// Where the spring of the angle (rad) or the translation (m) is at rest, within ±10⁹. 0 unless said. The spring of a distance joint is
    /// at rest at its [`length`](Self::length), that of a drag joint at its [`target`](Self::target), that of a weld where the bodies were
    /// joined.
    pub fn rest(self, rest: f64) -> Self {
        Self { rest, ..self }
    }

    /// The length of a distance joint, or that at which its spring is at rest, m. Of a pulley that of its rope: the most that the distance of
    /// `a` from its wheel, and the ratio times that of `b` from its own, may be. From 10⁻⁶ to 10¹² m.
    pub fn length(self, length: f32) -> Self {
        Self { length: Some(length), ..self }
    }

    /// Where a drag joint pulls to, m.
    pub fn target(self, target: impl Into<Point>) -> Self {
        Self { target: Some(target.into()), ..self }
    }

    /// The greatest force of a drag, motor or friction joint, N.
    pub fn max_force(self, force: f32) -> Self {
        Self { max_force: Some(force), ..self }
    }

    /// The greatest torque of a motor or friction joint, N m.
    pub fn max_torque(self, torque: f32) -> Self {
        Self { max_torque: Some(torque), ..self }
    }

    /// Breaks where its [force](crate::JointRef::force) (N) or torque (N m) is greater on average over a step: the joint is removed
    /// and [reported](crate::Events::broken). A blow of 10 N s is 600 N in a step of 1/60 s, and 2400 N in one of 1/240 s. A straight row
    /// of hinges between two supports has no slope to carry a load by, and bears any force: leave it slack. Either may be infinite.
    /// The force of a pulley is that on `b`, the ratio times the tension of its rope.
    pub fn break_at(self, force: f32, torque: f32) -> Self {
        Self { breaks_at: Some([force, torque]), ..self }
    }

    /// Whether the two bodies touch each other. They do not unless said; those of a pulley do.
    pub fn collide_connected(self, collide: bool) -> Self {
        Self { collide_connected: collide, ..self }
    }

    /// Whether it acts. It does unless said.
    pub fn enabled(self, enabled: bool) -> Self {
        Self { enabled, ..self }
    }

    /// A number of the caller's, which the world keeps with the joint.
    pub fn user_data(self, user_data: u64) -> Self {
        Self { user_data, ..self }
    }
}
