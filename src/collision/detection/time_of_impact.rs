//! Time of impact: when do two shapes first come near, of which each moves and turns evenly.
//!
//! For fast pairs only, so that nothing passes through anything. Two shapes are as far apart as the widest strip between
//! them. A strip along a fixed normal shrinks no faster than the shapes approach each other along it and their outlines turn
//! into it, so that until it has shrunk to the target they are farther apart: a step by that time is never too long
//! (conservative advancement: B. Mirtich, 1996). Where nothing turns, the distance is a convex function of how far one has
//! moved, the step is Newton's, and on stretches where the same straight features face each other one step is exact.

use crate::collision::detection::closest::Closest;
use crate::collision::detection::polygon_polygon::best_face;
use crate::collision::detection::{detect_within, within};
use crate::math::{Rot, Vec2};
use crate::shape::{Hull, Shape};

/// Newton's method doubles the digits at each step, but where the shapes only graze it gains one bit: after
/// 40 steps the time has all the bits that `f32` has, either way. What turns may not have come near by then.
const MAX_STEPS: usize = 40;

/// What turns is near its target within this part of the width of the thinner shape, no unit: each step closes a part of
/// what is left, and would never end.
const TOLERANCE: f32 = 1e-3;

/// A shape that turns evenly.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Swept<'a> {
    pub(crate) shape: &'a Shape,
    /// As it begins.
    pub(crate) rotation: Rot,
    /// rad/s. What is round about its centre does not turn.
    pub(crate) spin: f32,
    /// Its centre from that about which it turns, as it begins, m.
    pub(crate) arm: Vec2,
}

impl Swept<'_> {
    /// As it is after `time`, s.
    fn rotation_after(&self, time: f32) -> Rot {
        if self.spin == 0.0 { self.rotation } else { Rot::from_angle(self.spin * time) * self.rotation }
    }

    /// How far its centre has gone round after `time`, s, m.
    fn swung_after(&self, time: f32) -> Vec2 {
        if self.spin == 0.0 || self.arm == Vec2::ZERO {
            return Vec2::ZERO;
        }
        Rot::from_angle(self.spin * time).rotate(self.arm) - self.arm
    }

    /// How fast its outline may come closer along any direction by turning, m/s.
    fn rim_speed(&self) -> f32 {
        self.spin.abs() * (self.shape.core_extent() + self.arm.length())
    }
}

/// When two shapes first come within `target`, m, of each other, s, if not later than `until`: the centre of b starts at
/// `offset`, m, from that of a, and what b turns about moves with `velocity`, m/s, against what a turns about. 0 where they
/// already are.
///
/// A negative target asks for an overlap of that depth. Never late: at the time returned the distance is the target or, by
/// rounding and the tolerance of what turns, a little more; more than that where 40 steps were not enough.
pub(crate) fn time_of_impact(
    a: Swept<'_>,
    b: Swept<'_>,
    offset: Vec2,
    velocity: Vec2,
    until: f32,
    target: f32,
) -> Option<f32> {
    let rim_speed = a.rim_speed() + b.rim_speed();
    let tolerance = if rim_speed == 0.0 { 0.0 } else { TOLERANCE * a.shape.width_between(b.shape) };
    let mut time = 0.0;
    for _ in 0..MAX_STEPS {
        let place = offset + velocity * time + (b.swung_after(time) - a.swung_after(time));
        let gap = gap_of(a.shape, a.rotation_after(time), b.shape, b.rotation_after(time), place)?;
        let left = gap.distance - target;
        if left <= noise_of(place) + tolerance {
            return Some(time);
        }
        // How fast the strip shrinks: the gradient of the distance is the normal.
        let approach = rim_speed - gap.normal.dot(velocity);
        if approach <= 0.0 {
            return None;
        }
        time += left / approach;
        if !within(time, until) {
            return None;
        }
    }
    Some(time)
}

/// The distance of two shapes as they begin, m, negative where they overlap.
pub(crate) fn gap_between(a: Swept<'_>, b: Swept<'_>, offset: Vec2) -> Option<f32> {
    gap_of(a.shape, a.rotation, b.shape, b.rotation, offset).map(|gap| gap.distance)
}

/// A strip between two shapes.
#[derive(Clone, Copy)]
struct Gap {
    /// Its width, m, negative where the shapes overlap.
    distance: f32,
    /// Unit vector across, from a to b.
    normal: Vec2,
}

fn gap_of(shape_a: &Shape, rotation_a: Rot, shape_b: &Shape, rotation_b: Rot, offset: Vec2) -> Option<Gap> {
    if let (Some((a, radius_a)), Some((b, radius_b))) = (shape_a.core(), shape_b.core()) {
        let (rotation_a, rotation_b) = (shape_a.rotation_at(rotation_a), shape_b.rotation_at(rotation_b));
        let gap = gap_of_hulls(a, rotation_a, b, rotation_b, offset);
        // A strip between the cores is narrower by the radii between what is round them.
        return Some(Gap { distance: gap.distance - (radius_a + radius_b), ..gap });
    }
    // With a circle the manifold has the exact distance. Without a margin, it is always there.
    let manifold = detect_within(shape_a, rotation_a, shape_b, rotation_b, offset, f32::INFINITY)?;
    let distance = manifold.points().first()?.separation;
    Some(Gap { distance, normal: manifold.normal })
}

/// The widest strip between two hulls: along an edge, or across from corner to corner.
///
/// Unlike in the manifold no shape's faces are preferred, and the direction between two corners, which is vague when
/// they are near, counts only by the strip that is truly free along it: a strip is never wider than the distance, and
/// shrinks evenly, so that a step by it never goes too far.
fn gap_of_hulls(a: &Hull, rotation_a: Rot, b: &Hull, rotation_b: Rot, offset: Vec2) -> Gap {
    let rotation = rotation_a.inverse() * rotation_b;
    let center = rotation_a.unrotate(offset);
    let face_a = best_face(a, b, rotation, center);
    let face_b = best_face(b, a, rotation.inverse(), rotation.unrotate(-center));
    let mut widest = if face_b.separation > face_a.separation {
        Gap { distance: face_b.separation, normal: -rotation.rotate(b.normals[face_b.index]) }
    } else {
        Gap { distance: face_a.separation, normal: a.normals[face_a.index] }
    };
    let noise = noise_of(center);
    // Lines, one behind the other, have no strip along an edge between them.
    let may_be_in_line = a.is_segment() && b.is_segment();
    if (widest.distance > noise || may_be_in_line)
        && let Some(Closest { normal, .. }) = Closest::find(a, b, rotation, center, noise, f32::INFINITY)
    {
        let reach_a = reach(a, normal);
        let reach_b = reach(b, rotation.unrotate(-normal));
        let across = Gap { distance: normal.dot(center) - reach_a - reach_b, normal };
        if across.distance > widest.distance {
            widest = across;
        }
    }
    Gap { normal: rotation_a.rotate(widest.normal), ..widest }
}

/// How far a hull reaches along `normal` from its centre, m.
fn reach(hull: &Hull, normal: Vec2) -> f32 {
    hull.vertices().iter().map(|v| normal.dot(*v)).fold(f32::NEG_INFINITY, f32::max)
}

/// Distances round by a few half epsilons of the lengths they are taken from, m.
pub(crate) fn noise_of(offset: Vec2) -> f32 {
    4.0 * f32::EPSILON * (offset.x.abs() + offset.y.abs())
}
