//! The life of a manifold: once per step it is kept as the step before left it, or found anew.
//!
//! The solver leaves every manifold where the bodies are at the end of a step: its separations with their motion along the
//! normal, its anchors where they were carried to. Where it followed the surface within the step, the normal too. So a
//! manifold that is kept needs nothing more. What is kept, and what follows:
//!
//! - **Under load** the manifold of two outlines is kept while the bodies are nearly where they were when it was found. It
//!   saves the detection ("recycling", Box2D 3.2), but more: a normal that holds still while a stack trembles does not feed
//!   the trembling, which is what lets tall stacks stand.
//! - **On a single corner** a body topples: its arm decides whether and when. The solver follows it from substep to substep,
//!   and it is kept until others may have come near.
//! - **Without load** it is kept likewise while the bodies rest beside each other, which saves the detection.
//! - **With a circle** the manifold is never kept: its normal turns as it rolls. A normal that is late is a force that is late,
//!   and feeds every swing: late by half a step, as one of the step's begin is, it lets the energy of a swing of angular
//!   frequency ω grow by ω² dt/2 per second. Where it moves slowly it is found where the bodies will be halfway through the
//!   step, as in the midpoint rule, whose swings do not grow, and holds still; where it moves faster, or its load makes swings faster than
//!   that rule can follow, the solver follows it.
//!   Over a face that does not move, as long as it stays over it, only the gap changes, which the solver knows.
//!
//! A manifold is speculative: it has points that are still apart but may meet within the step, so that the
//! solver stops the bodies at the surface, not behind it. For bodies that close in fast, normal and anchors
//! are taken where they will first touch, not where they are now: from afar a passing body looks like a
//! collision, and an oblique blow would be answered along the wrong normal.

mod circle;
mod corners;

use crate::body::{Bodies, Motion};
use crate::collision::one_way::decide;
use crate::collision::refresh::circle::move_to;
use crate::collision::{
    Contact, Frozen, Manifold, ManifoldPoint, Offset, Placed, Swept, Touch, detect_flat, detect_from,
    is_flat, time_of_impact, without_ghosts,
};
use crate::compute::{BodyState, GROUND_ROW};
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

/// Bodies rest beside each other while it would take them this time to go as far as the distance from which on they have
/// points, s: slower than 2 cm/s, if they are not small.
const REST_TIME: f32 = 1.0;

/// A corner is followed from step to step for so many, then it is found anew; sooner where others may have come near.
const LONGEST_FOLLOWED: u8 = 15;

/// What a refresh needs to know beside the contact and the bodies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Refresh {
    /// Length of the step, s.
    pub(crate) dt: f32,
    /// Length of the substeps that impulses are of, s; infinite where there are none yet.
    pub(crate) impulses_of: f32,
    /// Whether manifolds may be kept.
    pub(crate) recycling: bool,
}

/// Brings the manifold of `contact` up to date. Impulses stay with their feature.
pub(crate) fn refresh(contact: &mut Contact, bodies: &Bodies, settings: Refresh) {
    bring_up_to_date(contact, bodies, settings);
    if let Some(before) = contact.one_way {
        decide(contact, before, bodies);
    }
}

#[inline(always)]
fn bring_up_to_date(contact: &mut Contact, bodies: &Bodies, settings: Refresh) {
    let pair = Pair::new(contact.colliders, bodies, settings.dt);
    if pair.is_out_of_reach() {
        return contact.clear();
    }
    let update = pair.update(contact, settings);
    let was_followed = contact.follows;
    (contact.has_bounced, contact.follows, contact.approach_speed) = (false, false, 0.0);
    let (predicted, touch) = match update {
        ManifoldUpdate::Keep => {
            contact.follows = was_followed && contact.pivots();
            contact.holds_still = !contact.follows || pair.is_at_rest(pair.predicted_motion());
            contact.followed_steps += u8::from(contact.follows);
            return;
        }
        ManifoldUpdate::FindAnew(predicted) => {
            let manifold = pair.find_manifold(predicted);
            if manifold.points().is_empty() {
                return contact.clear();
            }
            pair.take_over(manifold, contact);
            contact.approach_speed = pair.approach_speed(&contact.manifold);
            // As where it is found halfway.
            contact.holds_still =
                if contact.has_circle { pair.is_slow(predicted) } else { pair.is_at_rest(predicted) };
            contact.follows = (contact.has_circle || contact.pivots()) && !pair.is_flat();
            return;
        }
        ManifoldUpdate::MoveAlong(predicted, touch) => (predicted, touch),
        ManifoldUpdate::FindHalfway(predicted) => {
            let Some(touch) = pair.find_halfway(predicted) else { return contact.clear() };
            (predicted, touch)
        }
    };
    contact.approach_speed = predicted.closing(touch.normal) / settings.dt;
    contact.holds_still = pair.is_slow(predicted);
    move_to(pair.seen_by_bodies(touch), contact);
}

/// Whether the circles around two shapes stay apart within a step of `dt` seconds.
#[inline(always)]
pub(crate) fn are_out_of_reach(bodies: &Bodies, colliders: [u32; 2], dt: f32) -> bool {
    Pair::new(colliders, bodies, dt).is_out_of_reach()
}

/// How a manifold is brought up to date.
enum ManifoldUpdate {
    /// It stays as the last step left it.
    Keep,
    /// It is found where the bodies will be halfway through the step.
    FindHalfway(PredictedMotion),
    /// A circle has moved along a face that does not, and will stay over it: it touches here.
    MoveAlong(PredictedMotion, Touch),
    FindAnew(PredictedMotion),
}

/// The two shapes of a contact as the narrow phase sees them: from the centre of a. That is the centre of mass of its body, if
/// this has no other shape.
///
/// Most contacts keep their manifold or are out of reach, and need little of what there is to know: the rest is found
/// when it is asked for.
struct Pair<'a> {
    bodies: &'a Bodies,
    colliders: [u32; 2],
    /// Their centres from the centres of mass of their bodies, m, where they are not there.
    arms: Option<[Vec2; 2]>,
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

/// How two bodies have moved since their manifold was found.
#[derive(Clone, Copy)]
struct Since {
    /// Translation of b against a, m.
    moved: Vec2,
    /// Rotations of a and b. The outline of a circle does not turn with it.
    turned: [Rot; 2],
}

impl<'a> Pair<'a> {
    #[inline(always)]
    fn new(colliders: [u32; 2], bodies: &'a Bodies, dt: f32) -> Self {
        let [a, b] = colliders.map(|slot| slot as usize);
        let (motion_a, motion_b) = (&bodies.motions[a], &bodies.motions[b]);
        Self {
            bodies,
            colliders,
            arms: bodies.arms(colliders),
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

    /// Velocity of the centre of b against that of a, m/s.
    #[inline(always)]
    fn velocity(&self) -> Vec2 {
        let [state_a, state_b] = self.states();
        let velocity = (state_b.velocity - state_a.velocity).to_vec2();
        self.arms.map_or(velocity, |[arm_a, arm_b]| {
            velocity + arm_b.perp() * state_b.angular_velocity - arm_a.perp() * state_a.angular_velocity
        })
    }

    /// Translation of b against a that is expected within the step, m.
    #[inline(always)]
    fn motion(&self) -> Vec2 {
        self.velocity() * self.dt
    }

    #[inline(always)]
    fn states(&self) -> [&BodyState; 2] {
        self.colliders.map(|slot| self.bodies.state(slot))
    }

    #[inline(always)]
    fn predicted_motion(&self) -> PredictedMotion {
        let [state_a, state_b] = self.states();
        let turning = |motion: &Motion, w: f32| (w.abs() * self.dt).min(2.0) * motion.extent;
        PredictedMotion {
            motion: self.motion(),
            turning: turning(self.motion_a, state_a.angular_velocity)
                + turning(self.motion_b, state_b.angular_velocity)
                + self.bend(),
        }
    }

    /// How far the ways of the two centres bend within the step at most, m, as each turns about the centre of mass of its body:
    /// on a circle of radius r by r θ²/2 for the angle θ, and never by more than its width.
    #[inline(always)]
    fn bend(&self) -> f32 {
        let Some(arms) = self.arms else { return 0.0 };
        let bend = |(arm, state): (Vec2, &BodyState)| {
            let angle = state.angular_velocity * self.dt;
            (0.5 * angle * angle).min(2.0) * arm.length()
        };
        arms.into_iter().zip(self.states()).map(bend).sum()
    }

    /// Whether one of the centres goes round the centre of mass of its body as this turns.
    fn goes_round(&self) -> bool {
        let may_turn = [self.motion_a, self.motion_b].map(|motion| motion.row != GROUND_ROW);
        self.arms.is_some_and(|arms| (0..2).any(|side| may_turn[side] && arms[side] != Vec2::ZERO))
    }

    /// What touches, with anchors from the centres of mass in the place of those of the shapes.
    #[inline(always)]
    fn seen_by_bodies(&self, mut touch: Touch) -> Touch {
        if let Some([arm_a, arm_b]) = self.arms {
            touch.anchor_a += arm_a;
            touch.anchor_b += arm_b;
        }
        touch
    }

    /// Greatest speed with which a point of the manifold approaches along the normal, m/s.
    fn approach_speed(&self, manifold: &Manifold) -> f32 {
        let [a, b] = self.states();
        let parting = |point: &ManifoldPoint| manifold.normal.dot(point.relative_velocity(a, b));
        -manifold.points().iter().map(parting).fold(f32::INFINITY, f32::min)
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
        let reach = reach + self.near() + self.motion().length() + self.bend();
        // In f32 the distance from the middle of a planet is none.
        distance_squared > reach * reach && !self.is_flat()
    }

    /// Whether one of the two is a circle that the other finds flat.
    fn is_flat(&self) -> bool {
        is_flat([self.motion_a, self.motion_b].map(|motion| (motion.is_circle, motion.extent)))
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

    /// How the manifold is to be brought up to date.
    #[inline(always)]
    fn update(&self, contact: &Contact, settings: Refresh) -> ManifoldUpdate {
        if !settings.recycling || contact.manifold.points().is_empty() {
            return ManifoldUpdate::FindAnew(self.predicted_motion());
        }
        if contact.has_circle {
            let predicted = self.predicted_motion();
            return if self.is_on_ground()
                && let Some(touch) = self.find_on_face(predicted)
            {
                ManifoldUpdate::MoveAlong(predicted, touch)
            } else if self.is_slow(predicted)
                && !self.goes_round()
                && !self.is_pressed(contact, settings.impulses_of)
            {
                ManifoldUpdate::FindHalfway(predicted)
            } else {
                ManifoldUpdate::FindAnew(predicted)
            };
        }
        // What rolls from corner to corner has a normal that turns, as a circle has.
        let rolls = contact.manifold.is_of_corners();
        let keeps = contact.frozen().is_some_and(|frozen| {
            if rolls || self.may_turn_to_another_corner(contact) {
                false
            } else if contact.pivots() {
                let was_followed = contact.follows && contact.followed_steps < LONGEST_FOLLOWED;
                was_followed && self.strayed(&frozen) < self.near()
            } else {
                let rests = contact.is_loaded() || self.is_at_rest(self.predicted_motion());
                rests && self.stays(&self.since(&frozen))
            }
        });
        if keeps { ManifoldUpdate::Keep } else { ManifoldUpdate::FindAnew(self.predicted_motion()) }
    }

    /// Whether the bodies are nearly where they were, and the kept normal does not miss too much: a face that has turned by
    /// an angle θ rises by l sin θ under a contact that has slid on by l.
    fn stays(&self, since: &Since) -> bool {
        let distance = self.recycle_distance();
        let [turned_a, turned_b] = since.turned;
        let slope = turned_a.s.abs().max(turned_b.s.abs());
        let slid = since.moved.length() + self.swung(since);
        since.moved.length_squared() < distance * distance
            && turned_a.c.min(turned_b.c) > 0.0
            && slid * slope < STALE_SHARE * self.thickness()
    }

    /// How far the outlines have come by turning, by the sines of the angles, m.
    fn swung(&self, since: &Since) -> f32 {
        let [turned_a, turned_b] = since.turned;
        turned_a.s.abs() * self.motion_a.extent + turned_b.s.abs() * self.motion_b.extent
    }

    /// Whether the bodies move so slowly that they rest beside each other.
    fn is_at_rest(&self, PredictedMotion { motion, turning }: PredictedMotion) -> bool {
        (motion.length() + turning) * REST_TIME < self.near() * self.dt
    }

    /// Takes over a manifold that was found anew; impulses stay with their feature.
    fn take_over(&self, mut manifold: Manifold, contact: &mut Contact) {
        contact.followed_steps = 0;
        if let Some(arms) = self.arms {
            manifold.move_anchors(arms);
        }
        // What is round rolls over a corner as a ball does, whichever of its sides comes down.
        let rolls = matches!((manifold.points(), contact.manifold.points()), ([_], [_]))
            && [self.shape_a, self.shape_b].iter().any(|shape| matches!(shape, Shape::Rounded(_)));
        for point in manifold.points_mut() {
            let same = |old: &&ManifoldPoint| {
                old.feature == point.feature || rolls && old.feature.shares_vertex(point.feature)
            };
            if let Some(old) = contact.manifold.points().iter().find(same) {
                point.take_impulses(old);
            }
        }
        let [rotation_a, rotation_b] = [self.rotation_a, self.rotation_b];
        let frozen = Frozen { offset: self.offset, rotation_a, rotation_b };
        contact.freeze((!contact.has_circle).then_some(frozen));
        contact.manifold = manifold;
    }

    /// The manifold of bodies on this course; without points where they do not meet within the step.
    fn find_manifold(&self, predicted: PredictedMotion) -> Manifold {
        let PredictedMotion { motion, turning } = predicted;
        let margin = self.near() + motion.length() + turning;
        let near = self.offset.near;
        // What is out of reach as the step begins is so until it ends.
        let Some(found) = self.detect_at(near, margin) else { return Manifold::default() };
        let Some(manifold) = self.without_ghosts(found, near, margin) else {
            return self.find_beyond_ghosts(motion, margin).unwrap_or_default();
        };
        let gap = manifold.points().iter().fold(f32::INFINITY, |gap, point| gap.min(point.separation));
        let closing = predicted.closing(manifold.normal);
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
        let still = |shape, rotation| Swept { shape, rotation, spin: 0.0, arm: Vec2::ZERO };
        let a = still(self.shape_a, self.rotation_a);
        let b = still(self.shape_b, self.rotation_b);
        let fraction = time_of_impact(a, b, self.offset.near, motion, 1.0, 0.0)?;
        self.find_after(motion * fraction, margin)
    }

    /// The manifold of bodies that have met a ghost as the step begins, but come to meet what is exposed within it: as they first
    /// touch, or where they are at its end.
    fn find_beyond_ghosts(&self, motion: Vec2, margin: f32) -> Option<Manifold> {
        if let Some(meeting) = self.find_where_they_meet(motion, margin) {
            return Some(meeting);
        }
        let manifold = self.find_after(motion, margin)?;
        // What is far behind the face as the step begins has come through the ground.
        let deepest = manifold.points().iter().map(|point| point.separation).fold(f32::INFINITY, f32::min);
        (deepest >= -self.near()).then_some(manifold)
    }

    /// The manifold after b has advanced by so much, m; separations are those of now along its normal.
    fn find_after(&self, advance: Vec2, margin: f32) -> Option<Manifold> {
        let near = self.offset.near + advance;
        let mut manifold = self.without_ghosts(self.detect_at(near, margin)?, near, margin)?;
        let closed = manifold.normal.dot(advance);
        for point in manifold.points_mut() {
            point.separation -= closed;
        }
        Some(manifold)
    }

    /// The manifold where the centre of b is `near` from that of a, and what is missing of it as it is now; ghosts are in it.
    fn detect_at(&self, near: Vec2, margin: f32) -> Option<Manifold> {
        let offset = Offset { near, ..self.offset };
        let detect = if self.is_flat() { detect_flat } else { detect_from };
        detect(self.shape_a, self.rotation_a, self.shape_b, self.rotation_b, offset, margin)
    }

    /// What is left of a manifold that was found so without what neighbours cover.
    fn without_ghosts(&self, found: Manifold, near: Vec2, margin: f32) -> Option<Manifold> {
        match self.bodies.exposures_of(self.colliders) {
            None => Some(found),
            Some(exposures) => without_ghosts(
                found,
                exposures,
                self.placed([self.rotation_a, self.rotation_b], near, margin),
            ),
        }
    }

    /// The two shapes turned so, where the centre of b is `near` from that of a.
    fn placed(&self, rotations: [Rot; 2], near: Vec2, margin: f32) -> Placed<'_> {
        Placed { shapes: [self.shape_a, self.shape_b], rotations, offset: near, margin }
    }
}
