//! Shapes with round corners: the manifold of their cores, from which the radii are taken off.
//!
//! What is within a radius of a core reaches a radius farther in every direction. So the shapes are as deep as their cores are,
//! and the radii deeper, and along the same normal: that of a face, or where two corners are nearest, from one to the other. As
//! a corner comes past the end of a face, the normal turns on without a jump, and what is round rolls over it.
//!
//! A core may be a line (then the shape is a capsule, or a segment, whose radius is 0), which has no inside: two that lie one
//! behind the other are apart by no line along an edge. There the nearest corners are looked for, too.

use crate::collision::Manifold;
use crate::collision::detection::Core;
use crate::collision::detection::clip::Tolerance;
use crate::collision::detection::polygon_polygon::{Face, Pair, best_face};
use crate::collision::detection::within;
use crate::math::Vec2;

pub(super) fn detect(a: Core<'_>, b: Core<'_>, offset: Vec2, margin: f32) -> Option<Manifold> {
    let margin = margin + (a.radius + b.radius);
    let rotation = a.rotation.inverse() * b.rotation;
    let center = a.rotation.unrotate(offset);
    let face_a = best_face(a.hull, b.hull, rotation, center);
    if !within(face_a.separation, margin) {
        return None;
    }
    let face_b = best_face(b.hull, a.hull, rotation.inverse(), rotation.unrotate(-center));
    if !within(face_b.separation, margin) {
        return None;
    }
    let (inradius_a, inradius_b) = (a.inradius(), b.inradius());
    let are_segments = inradius_a.min(inradius_b) == f32::INFINITY;
    let inradius_b = if are_segments { 0.0 } else { inradius_b };
    let tolerance = Tolerance::new(inradius_a, inradius_b, center);
    let mut manifold = if face_b.separation > face_a.separation + tolerance.preference {
        of_cores(&pair(b, a, -offset), face_b, tolerance, margin)?.flipped()
    } else {
        of_cores(&pair(a, b, offset), face_a, tolerance, margin)?
    };
    if a.radius + b.radius > 0.0 {
        manifold.take_off([a.radius, b.radius]);
    } else {
        manifold.forget_round_corners();
    }
    Some(manifold)
}

fn pair<'a>(a: Core<'a>, b: Core<'a>, offset: Vec2) -> Pair<'a> {
    Pair { a: a.hull, rotation_a: a.rotation, b: b.hull, rotation_b: b.rotation, offset }
}

/// The manifold of the cores of a pair, of which a has the reference face.
fn of_cores(pair: &Pair<'_>, face: Face, tolerance: Tolerance, margin: f32) -> Option<Manifold> {
    let Tolerance { noise, preference } = tolerance;
    let (stretch, turn) = pair.common_stretch(face.index);
    // What leans round the end of a face is not to be taken for flat on it: its normal turns.
    let tolerance = if pair.is_flat_on(face.index) { preference } else { noise };
    let are_apart = face.separation > noise && !stretch.is_nearest(face.separation, tolerance);
    let are_in_line =
        stretch.is_empty() && face.separation > -preference && pair.a.is_segment() && pair.b.is_segment();
    if !(are_apart || are_in_line) {
        let stretch = stretch.without_far_end(noise);
        return stretch.manifold(pair.rotation_a * turn, pair.offset, noise, margin);
    }
    let closest = pair.closest(noise, margin)?;
    within(closest.distance, margin).then(|| closest.manifold_of_rounded(pair.rotation_a, pair.offset))
}
