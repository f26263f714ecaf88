//! Sweep: when do two shapes that move without turning first come near.
//!
//! For fast pairs only, so that nothing passes through anything. The distance of two convex shapes is a convex
//! function of how far one has moved: it falls, then rises. Newton's method from the left therefore never
//! overshoots the first time it reaches the target, and on stretches where the same straight features face each
//! other one step is exact (conservative advancement: B. Mirtich, 1996).

use crate::collision::detection::closest::Closest;
use crate::collision::detection::polygon_polygon::best_face;
use crate::collision::detection::{detect_within, within};
use crate::math::{Rot, Vec2};
use crate::shape::{Hull, Shape};

/// Newton's method doubles the digits at each step, but where the shapes only graze it gains one bit: after
/// 40 steps the fraction has all the bits that `f32` has, either way.
const MAX_STEPS: usize = 40;

/// Part of `motion`, m, the translation of b relative to a, after which the shapes first come within `target`, m,
/// of each other; neither turns on the way. 0 where they already are, `None` where they never do.
///
/// A negative target asks for an overlap of that depth. Never late: at the fraction returned the distance is the
/// target or, by rounding, a little more.
pub(crate) fn sweep(
    shape_a: &Shape,
    rotation_a: Rot,
    shape_b: &Shape,
    rotation_b: Rot,
    offset: Vec2,
    motion: Vec2,
    target: f32,
) -> Option<f32> {
    let mut fraction = 0.0;
    for _ in 0..MAX_STEPS {
        let place = offset + motion * fraction;
        let gap = gap_of(shape_a, rotation_a, shape_b, rotation_b, place)?;
        let left = gap.distance - target;
        if left <= noise_of(place) {
            return Some(fraction);
        }
        // How fast the distance shrinks: its gradient is the normal.
        let approach = -gap.normal.dot(motion);
        if approach <= 0.0 {
            return None;
        }
        fraction += left / approach;
        if !within(fraction, 1.0) {
            return None;
        }
    }
    Some(fraction)
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
    if let (Some(a), Some(b)) = (shape_a.hull(), shape_b.hull()) {
        let (rotation_a, rotation_b) = (shape_a.rotation_at(rotation_a), shape_b.rotation_at(rotation_b));
        return Some(gap_of_hulls(a, rotation_a, b, rotation_b, offset));
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
    if widest.distance > noise
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
fn noise_of(offset: Vec2) -> f32 {
    4.0 * f32::EPSILON * (offset.x.abs() + offset.y.abs())
}
