//! What happened in the last step.

use crate::body::{BodyError, BodyId, ColliderId};
use crate::joint::{JointError, JointId};
use crate::math::{Point, Vec2};

/// Two bodies began or ceased to touch.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add_force(Force::EARTH_GRAVITY);
/// let floor = world.add(Body::fixed(Shape::rectangle(20.0, 1.0)).at([0.0, -0.5]))?;
/// let cat = world.add(Body::dynamic(Shape::rectangle(0.6, 0.4)).at([0.0, 1.0]).restitution(0.0))?;
/// let mut landed = 0;
/// for _ in 0..60 {
///     world.step();
///     landed += world.events().began().iter().filter(|event| event.other(cat) == Some(floor)).count();
/// }
/// assert_eq!(landed, 1);
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ContactEvent {
    /// One of the bodies.
    pub a: BodyId,
    /// The other. The id of a body that was removed meanwhile is stale.
    pub b: BodyId,
    /// Which of their shapes.
    pub colliders: [ColliderId; 2],
    /// The tick in which it happened: what [`World::ticks`](crate::World::ticks) was at the end of it, so 1 for the first.
    pub tick: u64,
}

impl ContactEvent {
    /// The body that met `body`; `None` if `body` is neither of the two.
    pub fn other(&self, body: BodyId) -> Option<BodyId> {
        other_of([self.a, self.b], body)
    }
}

/// Two bodies met fast, or, with [`Settings::sum_impulses`](crate::Settings::sum_impulses), a blow ran through two that rest on
/// each other.
///
/// The impulses are those of the whole tick: of the blow itself, wherever within the tick it fell and however often they
/// bounced, and of what pressed them together besides. Over all contacts of a body, and forces, they are what its momentum has
/// changed by.
///
/// ```
/// # use rustycs::prelude::*;
/// # let mut world = World::new(Settings::default());
/// let wall = world.add(Body::fixed(Shape::rectangle(1.0, 4.0)).at([3.0, 0.0]).restitution(0.5))?;
/// let ball = Body::dynamic(Shape::circle(0.5)).mass(2.0).velocity([10.0, 0.0]).restitution(0.5);
/// let ball = world.add(ball)?;
/// let mut damage = 0.0;
/// for _ in 0..60 {
///     world.step();
///     for hit in world.events().hits().iter().filter(|hit| hit.other(ball) == Some(wall)) {
///         damage += hit.normal_impulse; // it comes with 20 N s, and goes with 10
///         assert_eq!(hit.normal_on(ball), Vec2::new(-1.0, 0.0));
///         assert!(hit.point.distance([2.5, 0.0]) < 1e-3); // for sparks
///     }
/// }
/// assert!((damage - 30.0).abs() < 1e-3);
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct HitEvent {
    /// One of the bodies.
    pub a: BodyId,
    /// The other.
    pub b: BodyId,
    /// Which of their shapes.
    pub colliders: [ColliderId; 2],
    /// Speed of the first approach along the normal, m/s, where they met: at least `Settings::hit_threshold`, but for a blow
    /// that ran through bodies at rest.
    pub speed: f32,
    /// Where they met; of two points the middle. Of two without restitution it is where they touch as the tick ends: what slides on has gone up to its
    /// speed times the length of the tick by then.
    pub point: Point,
    /// Direction in which b was pushed away from a; length 1.
    pub normal: Vec2,
    /// Impulse of the whole blow along the normal, N s, on b, and its opposite on a.
    pub normal_impulse: f32,
    /// The same of friction, N s, on b along the normal turned left, and its opposite on a.
    pub tangent_impulse: f32,
    /// The tick in which it was over: what [`World::ticks`](crate::World::ticks) was at the end of it, so 1 for the first. What does not
    /// bounce and meets at the end of a tick is slowed down in that tick and stopped in the next.
    pub tick: u64,
}

impl HitEvent {
    /// The body that met `body`; `None` if `body` is neither of the two.
    pub fn other(&self, body: BodyId) -> Option<BodyId> {
        other_of([self.a, self.b], body)
    }

    /// Direction in which `body` was pushed, away from the other; length 1, or 0 for a body that is neither of the two.
    pub fn normal_on(&self, body: BodyId) -> Vec2 {
        self.normal * side_of([self.a, self.b], body)
    }

    /// Impulse that `body` got over the tick, N s: along the normal and of friction; 0 for a body that is neither of the two.
    pub fn impulse_on(&self, body: BodyId) -> Vec2 {
        let on_b = self.normal * self.normal_impulse + self.normal.perp() * self.tangent_impulse;
        on_b * side_of([self.a, self.b], body)
    }
}

/// A body began or ceased to overlap a sensor.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// let coin = world.add(Body::fixed(Shape::circle(0.3)).at([3.0, 0.0]).sensor(true))?;
/// let hero = world.add(Body::dynamic(Shape::rectangle(0.6, 1.2)).velocity([4.0, 0.0]))?;
/// let mut coins = 0;
/// for _ in 0..60 {
///     world.step();
///     for event in world.take_events().sensor_began() {
///         if event.body == hero {
///             world.remove(event.sensor);
///             coins += 1;
///         }
///     }
/// }
/// assert!(coins == 1 && world.body(coin).is_none());
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct SensorEvent {
    /// The body of the sensor.
    pub sensor: BodyId,
    /// Which of its shapes is the sensor.
    pub collider: ColliderId,
    /// The body, which may be a sensor too. The id of one that was removed meanwhile is stale.
    pub body: BodyId,
    /// The tick in which it happened: what [`World::ticks`](crate::World::ticks) was at the end of it, so 1 for the first.
    pub tick: u64,
}

/// The other of two bodies, if `body` is one of them.
pub(in crate::world) fn other_of([a, b]: [BodyId; 2], body: BodyId) -> Option<BodyId> {
    if body == a { Some(b) } else { (body == b).then_some(a) }
}

/// 1 for the second of two bodies, which normals point to, -1 for the first, and 0 for any other.
pub(in crate::world) fn side_of([a, b]: [BodyId; 2], body: BodyId) -> f32 {
    f32::from(i8::from(body == b) - i8::from(body == a))
}

/// A change to a body that was refused, as a game makes them every frame.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// let ship = world.add(Body::dynamic(Shape::circle(0.5)))?;
/// # if cfg!(not(debug_assertions)) {
/// world.body_mut(ship).unwrap().apply_force([1.0 / 0.0, 0.0]); // a debug build panics here
/// world.step();
/// for Refusal { body, error, .. } in world.events().refused() {
///     eprintln!("{body:?}: {error}"); // the force is inf N; give a finite number from -1e18 to 1e18 N
/// }
/// # assert_eq!(world.events().refused().len(), 1);
/// # }
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Refusal {
    /// The body, which is as it was.
    pub body: BodyId,
    /// Why.
    pub error: BodyError,
}

/// A change to a joint that was refused, as a game makes them every frame.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// let wheel = world.add(Body::dynamic(Shape::circle(0.5)))?;
/// let axle = world.add_joint(Joint::revolute(wheel, None).motor(3.0, 40.0))?;
/// # if cfg!(not(debug_assertions)) {
/// world.joint_mut(axle).unwrap().set_motor(f32::NAN, 40.0); // a debug build panics here
/// world.step();
/// for JointRefusal { joint, error, .. } in world.events().refused_joints() {
///     eprintln!("{joint:?}: {error}");
/// }
/// # assert_eq!(world.events().refused_joints().len(), 1);
/// # }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct JointRefusal {
    /// The joint, which is as it was.
    pub joint: JointId,
    /// Why.
    pub error: JointError,
}

/// What happened in the last [`step`](crate::World::step), or in all ticks of the last
/// [`advance`](crate::World::advance): slices, valid until the next. Each has its ticks one after the other, and is the same in every run.
///
/// Contacts, hits and sensors are sorted by ids within a tick, and tell their `tick`, which says which of two in different slices came first.
/// What broke, left, was removed or refused comes in the order in which it did, and tells no tick. A body that began and ceased to overlap
/// a sensor in one tick began first. What ended by an edit between two ticks has the number of the later one.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add_force(Force::EARTH_GRAVITY);
/// world.add(Body::fixed(Shape::rectangle(20.0, 1.0)).at([0.0, -0.5]))?;
/// world.add(Body::dynamic(Shape::rectangle(1.0, 1.0)).at([0.0, 4.0]))?;
/// for _ in 0..60 {
///     world.step();
///     for hit in world.events().hits() {
///         println!("a sound at {}, as loud as {:.1} N s", hit.point, hit.normal_impulse);
///     }
///     for event in world.events().ended() {
///         println!("{:?} and {:?} touch no more", event.a, event.b);
///     }
/// }
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Debug, Default)]
pub struct Events {
    pub(crate) began: Vec<ContactEvent>,
    pub(crate) ended: Vec<ContactEvent>,
    pub(crate) hits: Vec<HitEvent>,
    pub(crate) sensor_began: Vec<SensorEvent>,
    pub(crate) sensor_ended: Vec<SensorEvent>,
    pub(crate) left: Vec<BodyId>,
    pub(crate) broken: Vec<JointId>,
    removed_joints: Vec<JointId>,
    pub(crate) joints_removed_by_edit: Vec<JointId>,
    refused_joints: Vec<JointRefusal>,
    pub(crate) joints_refused_by_edit: Vec<JointRefusal>,
    /// Contacts that ended because of an edit and are still to be reported, by this step or the next.
    pub(crate) ended_by_edit: Vec<ContactEvent>,
    refused: Vec<Refusal>,
    /// What was refused since the last tick.
    refused_by_edit: Vec<Refusal>,
    /// Where those of the current tick begin in `began`, `ended`, `hits`, `sensor_began` and `sensor_ended`.
    tick_begins: [usize; 5],
}

clone_into_buffers!(Events {
    began,
    ended,
    hits,
    sensor_began,
    sensor_ended,
    left,
    broken,
    removed_joints,
    joints_removed_by_edit,
    refused_joints,
    joints_refused_by_edit,
    ended_by_edit,
    refused,
    refused_by_edit,
    tick_begins
});

impl Events {
    /// Bodies that began to touch, also those that have bounced off again by the end of the tick, whose contact is gone.
    pub fn began(&self) -> &[ContactEvent] {
        &self.began
    }

    /// Bodies that ceased to touch, because they parted or because one of them was removed.
    pub fn ended(&self) -> &[ContactEvent] {
        &self.ended
    }

    /// Bodies that met with at least the speed of [`Settings::hit_threshold`](crate::Settings::hit_threshold), each pair once per
    /// tick. With [`Settings::sum_impulses`](crate::Settings::sum_impulses) also blows that ran through bodies at rest, and a second blow while two
    /// bodies touch, as of the other corner of one that tumbles against a wall. Without it only the first is told.
    pub fn hits(&self) -> &[HitEvent] {
        &self.hits
    }

    /// Bodies that began to overlap a [sensor](crate::Body::sensor). One that went through within the step has also ended.
    pub fn sensor_began(&self) -> &[SensorEvent] {
        &self.sensor_began
    }

    /// Bodies that ceased to overlap a sensor, for whatever reason: they parted, one was put elsewhere, removed, or made
    /// something else.
    pub fn sensor_ended(&self) -> &[SensorEvent] {
        &self.sensor_ended
    }

    /// Bodies that left [`Settings::bounds`](crate::Settings::bounds) and were removed. The ids are no longer valid in the world:
    /// they are to be compared with those that were kept.
    pub fn left(&self) -> &[BodyId] {
        &self.left
    }

    /// What was refused of [`BodyMut`](crate::BodyMut) since the step before: velocities, impulses and forces with numbers that
    /// are not finite or out of range. In a debug build the call panics instead.
    pub fn refused(&self) -> &[Refusal] {
        &self.refused
    }

    /// Joints that bore more than they [can](crate::Joint::break_at) and were removed. The ids are no longer valid in the world:
    /// they are to be compared with those that were kept.
    pub fn broken(&self) -> &[JointId] {
        &self.broken
    }

    /// Joints that were removed with one of their bodies since the step before: their ids are stale.
    pub fn removed_joints(&self) -> &[JointId] {
        &self.removed_joints
    }

    /// What was refused of [`JointMut`](crate::JointMut) since the step before: speeds, forces and targets that are not
    /// finite or out of range. In a debug build the call panics instead.
    pub fn refused_joints(&self) -> &[JointRefusal] {
        &self.refused_joints
    }

    /// Takes out what was reported; what is still to be stays.
    pub(crate) fn take_reported(&mut self) -> Self {
        let kept = Self {
            ended_by_edit: std::mem::take(&mut self.ended_by_edit),
            refused_by_edit: std::mem::take(&mut self.refused_by_edit),
            joints_removed_by_edit: std::mem::take(&mut self.joints_removed_by_edit),
            joints_refused_by_edit: std::mem::take(&mut self.joints_refused_by_edit),
            ..Self::default()
        };
        std::mem::replace(self, kept)
    }

    /// Takes note of a change that was refused.
    pub(crate) fn refuse(&mut self, refusal: Refusal) {
        self.refused_by_edit.push(refusal);
    }

    /// Forgets what was reported.
    pub(crate) fn clear(&mut self) {
        self.began.clear();
        self.ended.clear();
        self.hits.clear();
        self.sensor_began.clear();
        self.sensor_ended.clear();
        self.left.clear();
        self.broken.clear();
        self.removed_joints.clear();
        self.refused_joints.clear();
        self.refused.clear();
    }

    /// Begins a tick: takes over what edits have ended since the last.
    pub(crate) fn begin_tick(&mut self) {
        let sensors = [self.sensor_began.len(), self.sensor_ended.len()];
        self.tick_begins = [self.began.len(), self.ended.len(), self.hits.len(), sensors[0], sensors[1]];
        if self.ended.is_empty() {
            // The list itself, which is long where most of a world was removed, and not a second one beside it.
            std::mem::swap(&mut self.ended, &mut self.ended_by_edit);
        } else {
            self.ended.append(&mut self.ended_by_edit);
        }
        self.refused.append(&mut self.refused_by_edit);
        self.refused_joints.append(&mut self.joints_refused_by_edit);
        self.removed_joints.append(&mut self.joints_removed_by_edit);
    }

    /// Brings the events of the current tick into an order that does not depend on how it was computed.
    pub(crate) fn sort(&mut self) {
        let [began, ended, hits, sensor_began, sensor_ended] = self.tick_begins;
        self.began[began..].sort_unstable_by_key(|event| (event.a, event.b, event.colliders));
        self.ended[ended..].sort_unstable_by_key(|event| (event.a, event.b, event.colliders));
        self.hits[hits..].sort_unstable_by_key(|event| (event.a, event.b, event.colliders));
        self.sensor_began[sensor_began..]
            .sort_unstable_by_key(|event| (event.sensor, event.collider, event.body));
        self.sensor_ended[sensor_ended..]
            .sort_unstable_by_key(|event| (event.sensor, event.collider, event.body));
    }
}
