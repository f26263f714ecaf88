//! Brings the manifold of a contact up to date, once per step: kept where the bodies have hardly moved
//! against each other, left as it is where the solver has followed it, found anew otherwise.
//!
//! Keeping it ("recycling", Box2D 3.2) saves the detection, but more: a normal and anchors that hold still
//! while a stack trembles do not feed the trembling, which is what lets tall stacks stand.
//!
//! A contact with a circle is not kept: its normal turns as it rolls. A normal that is late is a force that is late, and
//! feeds every swing: late by half a step, as one of the step's begin is, it lets the energy of a swing of angular
//! frequency ω grow by ω² dt/2 per second. Where it moves slowly it holds still within the step too, but where the
//! bodies will be halfway through it, as in the midpoint rule, whose swings do not grow; where it moves faster
//! the solver follows it. Over a face that does not move, as long as it stays over it, only the gap changes, which the
//! solver knows: there is nothing to follow.
//!
//! A manifold is speculative: it has points that are still apart but may meet within the step, so that the
//! solver stops the bodies at the surface, not behind it. For bodies that close in fast, normal and anchors
//! are taken where they will first touch, not where they are now: from afar a passing body looks like a
//! collision, and an oblique blow would be answered along the wrong normal.

mod circle;

use crate::body::{Bodies, Motion};
use crate::collision::refresh::circle::move_to;
use crate::collision::{
    Contact, Frozen, Manifold, ManifoldPoint, Offset, Touch, detect_flat, detect_from, is_flat, sweep,
};
use crate::compute::LaneRot;
use crate::math::{Rot, Vec2};
use crate::shape::Shape;

/// Points this far apart are kept even between bodies at rest, m: room for what a force can do to them
/// within a step, and for a box that rocks from corner to corner. Smaller bodies take a tenth of their
/// thickness instead.
const SPECULATIVE_MARGIN: f32 = 0.02;

/// How far two bodies may move against each other before their manifold is found anew, m. A tenth of it is
/// too little for a house of cards, whose cards lean on frozen normals; more makes rolling polygons coarse.
/// Small bodies take a quarter of the extent of the smaller of the two.
const RECYCLE_DISTANCE: f32 = 0.05;

/// And while what a normal that has not turned with its face cannot see of the separations is at most this share of the
/// width of the thinner body, no unit: less than what a contact under load may sag before its island is solved directly.
const STALE_SHARE: f32 = 0.01;

/// Cosine of the angle that either body may turn before the manifold is found anew: 11 degrees.
const RECYCLE_COSINE: f32 = 0.98;

/// Bodies rest on each other, or beside each other, while it would take them this time to go as far as the distance
/// from which on they have points, s: slower than 2 cm/s, if they are not small.
const REST_TIME: f32 = 1.0;

/// And while they have moved against each other by less than this share of it, no unit: 0.5 mm.
const REST_SHARE: f32 = 0.025;

/// What stands on one corner is not followed while it would take it this time to go as far as that distance, s: slower
/// than 0.2 mm/s. What has begun to topple is faster.
const STILL_TIME: f32 = 100.0;

/// A corner is followed from step to step for so many, then it is found anew; sooner where others may have come near.
const LONGEST_FOLLOWED: u8 = 15;

/// What a refresh needs to know beside the contact and the bodies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Refresh {
    /// Length of the step, s.
    pub(crate) dt: f32,
    /// Whether manifolds may be kept.
    pub(crate) recycling: bool,
}

/// Brings the manifold of `contact` up to date. Impulses stay with their feature.
pub(crate) fn refresh(contact: &mut Contact, bodies: &Bodies, settings: Refresh) {
    let pair = Pair::new(contact.slots, bodies, settings.dt);
    if pair.is_out_of_reach() {
        return contact.clear();
    }
    let update = pair.update(contact, settings.recycling);
    let holds_still = match update {
        ManifoldUpdate::Recycle(_) | ManifoldUpdate::FindHalfway(_) => true,
        ManifoldUpdate::MoveAlong(course, _) => pair.is_slow(course),
        ManifoldUpdate::LeaveAsFollowed | ManifoldUpdate::FindAnew(_) => false,
    };
    let is_to_follow = matches!(update, ManifoldUpdate::LeaveAsFollowed | ManifoldUpdate::FindAnew(_));
    let mut approach_speed = 0.0;
    match update {
        ManifoldUpdate::Recycle(since) => recycle(contact, since),
        ManifoldUpdate::FindHalfway(course) => {
            let Some(touch) = pair.find_halfway(course) else { return contact.clear() };
            approach_speed = course.closing(touch.normal) / settings.dt;
            move_to(touch, contact);
        }
        ManifoldUpdate::MoveAlong(course, touch) => {
            approach_speed = course.closing(touch.normal) / settings.dt;
            move_to(touch, contact);
        }
        ManifoldUpdate::LeaveAsFollowed => contact.followed_steps += 1,
        ManifoldUpdate::FindAnew(course) => {
            let manifold = pair.find_manifold(course);
            if manifold.points().is_empty() {
                return contact.clear();
            }
            approach_speed = course.closing(manifold.normal) / settings.dt;
            pair.take_over(manifold, contact);
        }
    }
    (contact.holds_still, contact.has_bounced, contact.approach_speed) = (holds_still, false, approach_speed);
    contact.follows = is_to_follow && (contact.has_circle || contact.pivots()) && !pair.is_flat();
}

/// Whether the circles around two bodies stay apart within a step of `dt` seconds.
#[inline(always)]
pub(crate) fn are_out_of_reach(bodies: &Bodies, slots: [u32; 2], dt: f32) -> bool {
    Pair::new(slots, bodies, dt).is_out_of_reach()
}

/// Keeps the normal, and the anchors on their bodies, which they turn with: what topples does so about where it
/// stands now. Each separation follows the motion since they were found.
fn recycle(contact: &mut Contact, since: Since) {
    let (normal, separations) = (contact.manifold.normal, contact.frozen.separations);
    for (point, then) in contact.manifold.points_mut().iter_mut().zip(separations) {
        point.separation = then + since.opened(normal, point.anchor_a, point.anchor_b);
    }
}

/// How a manifold is brought up to date.
enum ManifoldUpdate {
    /// Normal and anchors are kept.
    Recycle(Since),
    /// It is found where the bodies will be halfway through the step.
    FindHalfway(PredictedMotion),
    /// A circle has moved along a face that does not, and will stay over it: it touches here.
    MoveAlong(PredictedMotion, Touch),
    /// It has been followed to where it is.
    LeaveAsFollowed,
    FindAnew(PredictedMotion),
}

/// The two bodies of a contact as the narrow phase sees them: from the centre of a.
///
/// Most contacts keep their manifold or are out of reach, and need little of what there is to know: the rest is found
/// when it is asked for.
struct Pair<'a> {
    bodies: &'a Bodies,
    slots: [u32; 2],
    motion_a: &'a Motion,
    motion_b: &'a Motion,
    shape_a: &'a Shape,
    shape_b: &'a Shape,
    rotation_a: Rot,
    rotation_b: Rot,
    /// Centre of b from the centre of a.
    offset: Offset,
    /// Length of the step, s.
    dt: f32,
}

/// What two bodies are expected to do within the step.
#[derive(Clone, Copy)]
struct PredictedMotion {
    /// Translation of b against a, m.
    motion: Vec2,
    /// Farthest that the outlines can come closer by turning, m.
    turning: f32,
}

impl PredictedMotion {
    /// How much closer the bodies come along the normal by their translation, m.
    #[inline(always)]
    fn closing(&self, normal: Vec2) -> f32 {
        -normal.dot(self.motion)
    }
}

/// How two bodies have moved since their manifold was found, or will have when it is.
#[derive(Clone, Copy)]
struct Since {
    /// Translation of b against a, m.
    moved: Vec2,
    /// Rotations of a and b. The outline of a circle does not turn with it.
    turned: [Rot; 2],
}

impl Since {
    /// How far a point has opened along the normal, whose anchors have turned with the bodies to where these are given, m:
    /// s - s₀ = n·(Δoffset + (1 - R_b⁻¹) r_b - (1 - R_a⁻¹) r_a).
    #[inline(always)]
    fn opened(&self, normal: Vec2, anchor_a: Vec2, anchor_b: Vec2) -> f32 {
        let [back_a, back_b] = self.turned.map(Rot::inverse).map(|back| LaneRot { c: back.c, s: back.s });
        let tip_a: Vec2 = back_a.displacement(anchor_a.into()).into();
        let tip_b: Vec2 = back_b.displacement(anchor_b.into()).into();
        normal.dot(self.moved - tip_b + tip_a)
    }
}

impl<'a> Pair<'a> {
    #[inline(always)]
    fn new(slots: [u32; 2], bodies: &'a Bodies, dt: f32) -> Self {
        let [a, b] = slots.map(|slot| slot as usize);
        let (motion_a, motion_b) = (&bodies.motions[a], &bodies.motions[b]);
        Self {
            bodies,
            slots,
            motion_a,
            motion_b,
            shape_a: &bodies.shapes[a],
            shape_b: &bodies.shapes[b],
            rotation_a: motion_a.pose.rotation,
            rotation_b: motion_b.pose.rotation,
            offset: Offset::between(motion_a.pose.center, motion_b.pose.center),
            dt,
        }
    }

    /// Translation of b against a that is expected within the step, m.
    #[inline(always)]
    fn motion(&self) -> Vec2 {
        let [state_a, state_b] = self.slots.map(|slot| self.bodies.state(slot));
        Vec2::from(state_b.velocity - state_a.velocity) * self.dt
    }

    #[inline(always)]
    fn course(&self) -> PredictedMotion {
        let [state_a, state_b] = self.slots.map(|slot| self.bodies.state(slot));
        let turning = |motion: &Motion, w: f32| (w.abs() * self.dt).min(2.0) * motion.extent;
        PredictedMotion {
            motion: self.motion(),
            turning: turning(self.motion_a, state_a.angular_velocity)
                + turning(self.motion_b, state_b.angular_velocity),
        }
    }

    /// Points this far apart are kept between bodies at rest, m.
    fn near(&self) -> f32 {
        // A tenth of the width of the thinner of the two.
        SPECULATIVE_MARGIN.min(0.1 * self.thickness())
    }

    /// Width of the thinner of the two, m.
    fn thickness(&self) -> f32 {
        self.motion_a.thickness.min(self.motion_b.thickness)
    }

    /// Whether the circles around the two shapes stay apart: half of the pairs of a pile, at a tenth of the
    /// cost of finding a manifold.
    #[inline(always)]
    fn is_out_of_reach(&self) -> bool {
        let distance_squared = self.offset.near.length_squared();
        let reach = self.motion_a.extent + self.motion_b.extent;
        if distance_squared <= reach * reach {
            return false;
        }
        // Turning does not bring the circles closer.
        let reach = reach + self.near() + self.motion().length();
        // In f32 the distance from the middle of a planet is none.
        distance_squared > reach * reach && !self.is_flat()
    }

    /// Whether one of the two is a circle that the other finds flat.
    fn is_flat(&self) -> bool {
        is_flat([self.motion_a, self.motion_b].map(|motion| (motion.is_round, motion.extent)))
    }

    /// How far the bodies may move against each other before their manifold is found anew, m.
    fn recycle_distance(&self) -> f32 {
        RECYCLE_DISTANCE.min(0.25 * self.extent())
    }

    /// Extent of the smaller of the two, m.
    fn extent(&self) -> f32 {
        self.motion_a.extent.min(self.motion_b.extent)
    }

    /// How the bodies have moved against each other since their manifold was found.
    #[inline(always)]
    fn since(&self, then: &Frozen) -> Since {
        let turned = |motion: &Motion, then: Rot| {
            if motion.is_round { Rot::IDENTITY } else { motion.pose.rotation * then.inverse() }
        };
        Since {
            moved: (self.offset.near - then.offset.near) + (self.offset.rest - then.offset.rest),
            turned: [turned(self.motion_a, then.rotation_a), turned(self.motion_b, then.rotation_b)],
        }
    }

    /// How the manifold is to be brought up to date. What carries load keeps it while the bodies are nearly where they were,
    /// but not that of a single corner, over which a body topples: its arm is what decides whether and when.
    #[inline(always)]
    fn update(&self, contact: &Contact, recycling: bool) -> ManifoldUpdate {
        if !recycling || contact.manifold.points().is_empty() {
            return ManifoldUpdate::FindAnew(self.course());
        }
        if contact.has_circle {
            let course = self.course();
            if self.is_on_ground()
                && let Some(touch) = self.find_on_face(course)
            {
                return ManifoldUpdate::MoveAlong(course, touch);
            }
            return if self.is_slow(course) {
                ManifoldUpdate::FindHalfway(course)
            } else {
                ManifoldUpdate::FindAnew(course)
            };
        }
        let is_loaded = contact.is_loaded();
        if is_loaded && contact.pivots() {
            if contact.followed_steps == 0 && self.lingers(self.course(), STILL_TIME) {
                let since = self.since(&contact.frozen);
                if self.has_hardly_moved(&since) {
                    return ManifoldUpdate::Recycle(since);
                }
            }
            let was_followed = contact.follows && contact.followed_steps < LONGEST_FOLLOWED;
            return if was_followed && self.strayed(&contact.frozen) < self.near() {
                ManifoldUpdate::LeaveAsFollowed
            } else {
                ManifoldUpdate::FindAnew(self.course())
            };
        }
        let since = self.since(&contact.frozen);
        if is_loaded && self.stays(&since) {
            return ManifoldUpdate::Recycle(since);
        }
        let course = self.course();
        if !is_loaded && self.lingers(course, REST_TIME) && self.has_hardly_moved(&since) {
            ManifoldUpdate::Recycle(since)
        } else {
            ManifoldUpdate::FindAnew(course)
        }
    }

    /// How far any point of b has moved as a sees it since their manifold was found, and may have by the end of the step,
    /// m. What was farther than [`near`](Self::near) then is not in the manifold, and has not come by less.
    fn strayed(&self, then: &Frozen) -> f32 {
        let seen = |offset: Offset, a: Rot, b: Rot| (a.unrotate(offset.near), a.inverse() * b);
        let (offset, rotation) = seen(self.offset, self.rotation_a, self.rotation_b);
        let (offset_then, rotation_then) = seen(then.offset, then.rotation_a, then.rotation_b);
        let turned = rotation * rotation_then.inverse();
        if turned.c <= 0.0 {
            return f32::INFINITY;
        }
        let [state_a, state_b] = self.slots.map(|slot| self.bodies.state(slot));
        let turning = state_b.angular_velocity - state_a.angular_velocity;
        let velocity = Vec2::from(state_b.velocity - state_a.velocity)
            - self.offset.near.perp() * state_a.angular_velocity;
        (offset - offset_then).length()
            + velocity.length() * self.dt
            + (turned.s.abs() + turning.abs() * self.dt) * self.motion_b.extent
    }

    /// Whether the bodies are nearly where they were.
    fn stays(&self, since: &Since) -> bool {
        let distance = self.recycle_distance();
        since.moved.length_squared() < distance * distance
            && since.turned.iter().all(|turned| turned.c > RECYCLE_COSINE)
            && !self.is_stale(since)
    }

    /// Whether the kept normal misses too much: a face that has turned by an angle θ rises by l sin θ under a contact that
    /// has slid on by l.
    fn is_stale(&self, since: &Since) -> bool {
        let slid = since.moved.length() + self.swung(since);
        let slope = since.turned.iter().fold(0.0, |slope: f32, turned| slope.max(turned.s.abs()));
        slid * slope >= STALE_SHARE * self.thickness()
    }

    /// How far the outlines have come by turning, by the sines of the angles, m.
    fn swung(&self, since: &Since) -> f32 {
        let [turned_a, turned_b] = since.turned;
        turned_a.s.abs() * self.motion_a.extent + turned_b.s.abs() * self.motion_b.extent
    }

    /// Whether it would take the bodies more than this time, s, to go as far as the distance from which on they have points.
    fn lingers(&self, PredictedMotion { motion, turning }: PredictedMotion, time: f32) -> bool {
        (motion.length() + turning) * time < self.near() * self.dt
    }

    /// Whether they have moved against each other by hardly a part of that since then.
    fn has_hardly_moved(&self, since: &Since) -> bool {
        let [turned_a, turned_b] = since.turned;
        let is_near = |moved: f32| moved < REST_SHARE * self.near();
        turned_a.c > 0.0 && turned_b.c > 0.0 && is_near(since.moved.length() + self.swung(since))
    }

    /// Takes over a manifold that was found anew; impulses stay with their feature.
    fn take_over(&self, mut manifold: Manifold, contact: &mut Contact) {
        contact.followed_steps = 0;
        for point in manifold.points_mut() {
            let same = |old: &&ManifoldPoint| old.feature == point.feature;
            if let Some(old) = contact.manifold.points().iter().find(same) {
                point.normal_impulse = old.normal_impulse;
                point.tangent_impulse = old.tangent_impulse;
            }
        }
        let mut separations = [0.0; 2];
        for (separation, point) in separations.iter_mut().zip(manifold.points()) {
            *separation = point.separation;
        }
        let [rotation_a, rotation_b] = [self.rotation_a, self.rotation_b];
        if !contact.has_circle {
            contact.frozen = Frozen { offset: self.offset, rotation_a, rotation_b, separations };
        }
        contact.manifold = manifold;
    }

    /// The manifold of bodies on this course; without points where they do not meet within the step.
    fn find_manifold(&self, course: PredictedMotion) -> Manifold {
        let PredictedMotion { motion, turning } = course;
        let margin = self.near() + motion.length() + turning;
        let Some(manifold) = self.detect_at(self.offset.near, margin) else { return Manifold::default() };
        let gap = manifold.points().iter().fold(f32::INFINITY, |gap, point| gap.min(point.separation));
        let closing = course.closing(manifold.normal);
        // What is flat has one normal, wherever they meet.
        if gap <= 0.0 || closing <= gap || self.is_flat() {
            return if self.may_meet(gap, closing, turning) { manifold } else { Manifold::default() };
        }
        match self.find_where_they_meet(motion, margin) {
            Some(meeting) => meeting,
            None if self.may_meet(gap, 0.0, turning) => manifold,
            None => Manifold::default(),
        }
    }

    /// Whether bodies with this gap, m, may meet within the step, in which they come closer by so much, m: by their
    /// translation along the normal, and by turning.
    fn may_meet(&self, gap: f32, closing: f32, turning: f32) -> bool {
        gap <= self.near() + turning + closing.max(0.0)
    }

    /// The manifold of the moment in which the bodies first touch, if they do within the step; separations
    /// are those of now along its normal.
    fn find_where_they_meet(&self, motion: Vec2, margin: f32) -> Option<Manifold> {
        let (a, b) = (self.shape_a, self.shape_b);
        let fraction = sweep(a, self.rotation_a, b, self.rotation_b, self.offset.near, motion, 0.0)?;
        let advance = motion * fraction;
        let mut manifold = self.detect_at(self.offset.near + advance, margin)?;
        let closed = manifold.normal.dot(advance);
        for point in manifold.points_mut() {
            point.separation -= closed;
        }
        Some(manifold)
    }

    /// The manifold where the centre of b is `near` from that of a, and what is missing of it as it is now.
    fn detect_at(&self, near: Vec2, margin: f32) -> Option<Manifold> {
        let offset = Offset { near, ..self.offset };
        let detect = if self.is_flat() { detect_flat } else { detect_from };
        detect(self.shape_a, self.rotation_a, self.shape_b, self.rotation_b, offset, margin)
    }
}
