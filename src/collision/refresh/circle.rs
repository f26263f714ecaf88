//! Where a circle touches, found once per step.

use crate::body::Motion;
use crate::collision::refresh::{Pair, PredictedMotion};
use crate::collision::{Contact, Touch, touch, without_ghosts};
use crate::compute::{BodyState, GROUND_ROW, LaneRot};
use crate::math::{Rot, Vec2};
use crate::shape::Link;

/// A contact with a circle holds still within a step in which its bodies move against each other by less than this, m, or
/// by less than a fortieth of the extent of the smaller of the two: with half as much, piles are left that swing on.
const SLOW_DISTANCE: f32 = 0.005;

/// And in which its load alone would not move the lighter by more than this share of the extent of the smaller, no unit. A body between two
/// others swings under their loads F with ω² of about 7 F/(m e), e being its extent, and the midpoint rule makes swings grow from ω dt = 2 on:
/// with two loads, from a quarter on, so that this leaves a factor of two. Without it three times as many bodies of piles with densities 78 : 1
/// are faster than 1 cm/s after twenty seconds; with half as much, a pit of balls takes 7 % longer.
const PRESSED_SHARE: f32 = 1.0 / 8.0;

/// Moves the only point of a contact with a circle to where it touches.
pub(super) fn move_to(touch: Touch, contact: &mut Contact) {
    contact.manifold.normal = touch.normal;
    for point in contact.manifold.points_mut() {
        (point.anchor_a, point.anchor_b, point.separation) =
            (touch.anchor_a, touch.anchor_b, touch.separation);
    }
}

impl Pair<'_> {
    /// Whether the bodies move against each other so little within the step that a contact with a circle may hold still.
    pub(super) fn is_slow(&self, PredictedMotion { motion, turning }: PredictedMotion) -> bool {
        let left = SLOW_DISTANCE.min(0.025 * self.extent()) - turning;
        left > 0.0 && motion.length_squared() < left * left
    }

    /// Whether the load of a contact, whose impulses are of substeps of so many seconds, may make its bodies swing too fast for one normal a
    /// step.
    pub(super) fn is_pressed(&self, contact: &Contact, impulses_of: f32) -> bool {
        let impulse = contact.manifold.points().first().map_or(0.0, |point| point.normal_impulse);
        let inverse_mass = self.motion_a.inverse_mass.max(self.motion_b.inverse_mass);
        let acceleration = impulse / impulses_of * inverse_mass;
        0.5 * acceleration * self.dt * self.dt > PRESSED_SHARE * self.extent()
    }

    /// Where the circle touches halfway through the step; with the separation of now along the normal of then. `None` where
    /// the bodies do not meet within the step.
    pub(super) fn find_halfway(&self, predicted: PredictedMotion) -> Option<Touch> {
        let half_turn = |motion: &Motion, state: &BodyState| {
            if motion.is_round {
                return Rot::IDENTITY;
            }
            let angle = 0.5 * self.dt * state.angular_velocity;
            // Slow bodies turn by less than 1/80: the next terms of cosine and sine are below the last digit of a gap.
            Rot { c: 1.0 - 0.5 * angle * angle, s: angle }
        };
        let [state_a, state_b] = self.states();
        let [half_a, half_b] = [half_turn(self.motion_a, state_a), half_turn(self.motion_b, state_b)];
        let moved = 0.5 * predicted.motion;
        let (rotation_a, rotation_b) = (half_a * self.rotation_a, half_b * self.rotation_b);
        let near = self.offset.near + moved;
        let mut then = touch(self.shape_a, rotation_a, self.shape_b, rotation_b, near, f32::INFINITY)?;
        if let Some(exposures) = self.bodies.exposures_of(self.colliders) {
            let placed = self.placed([rotation_a, rotation_b], near, f32::INFINITY);
            then = Touch::of(&without_ghosts(then.manifold(), exposures, placed)?)?;
        }
        // n·(Δx + (1 - R_b⁻¹) r_b - (1 - R_a⁻¹) r_a), of which each term keeps its digits.
        let swung = |half: Rot, anchor: Vec2| -> Vec2 {
            Vec2::ZERO - LaneRot { c: half.c, s: -half.s }.displacement(anchor.into()).to_vec2()
        };
        let opened = then.normal.dot(moved + swung(half_b, then.anchor_b) - swung(half_a, then.anchor_a));
        let separation = then.separation + self.offset.missing(then.normal) - opened;
        self.meets(predicted, then.normal, separation).then_some(Touch { separation, ..then })
    }

    /// Whether one is a circle around its centre of mass, and what it touches does not move.
    pub(super) fn is_on_ground(&self) -> bool {
        let ground = if self.motion_b.is_round { self.motion_a } else { self.motion_b };
        (self.motion_a.is_round || self.motion_b.is_round) && ground.row == GROUND_ROW
    }

    /// Where a circle touches a face over which it will stay within the step. Where that does not move, only the gap changes
    /// meanwhile, as the solver finds it anyway. `None` where they do not meet.
    #[inline(never)]
    pub(super) fn find_on_face(&self, predicted: PredictedMotion) -> Option<Touch> {
        let near = self.offset.near;
        let (shape, rotation, radius, to_circle) = if self.motion_b.is_round {
            (self.shape_a, self.rotation_a, self.motion_b.extent, near)
        } else {
            (self.shape_b, self.rotation_b, self.motion_a.extent, -near)
        };
        let ((hull, rounding), rotation) = (shape.core()?, shape.rotation_at(rotation));
        let center = rotation.unrotate(to_circle);
        let (gap, face) = hull.nearest_face(center);
        if shape.link().is_some() && face != Link::FACE {
            return None;
        }
        let [start, end] = hull.ends_from(face, center);
        // By a radius more than it is on its way: it may be struck meanwhile.
        let way = predicted.motion.length() + radius;
        if !(gap > 0.0 && start < -way && end > way) {
            return None;
        }
        let outward = rotation.rotate(hull.normals[face]);
        let arm = outward * -radius;
        let [normal, anchor_a, anchor_b] =
            if self.motion_b.is_round { [outward, near + arm, arm] } else { [-outward, arm, arm - near] };
        let separation = gap - (radius + rounding) + self.offset.missing(normal);
        self.meets(predicted, normal, separation).then_some(Touch { normal, anchor_a, anchor_b, separation })
    }

    /// Whether bodies on this course may meet within the step, of which a circle has this gap, m.
    fn meets(&self, predicted: PredictedMotion, normal: Vec2, gap: f32) -> bool {
        self.may_meet(gap, predicted.closing(normal), predicted.turning)
    }
}
