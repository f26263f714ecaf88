//! Polygon against circle: the face that the centre stands out from furthest, then the ends of that face.
//!
//! The nearest point of a convex outline is always on that face. From an edge: its line is at the true distance,
//! and no line can be further than the outline. From a corner: the direction to the centre lies between the
//! normals of the two edges that meet there, so one of them makes the smallest angle with it, and the lines of
//! all others pass behind the corner.

use crate::collision::detection::touch::Touch;
use crate::collision::detection::within;
use crate::math::{Rot, Vec2};
use crate::shape::{Circle, Hull};

/// a is the polygon, b the circle.
#[inline]
pub(super) fn touch(a: &Hull, rotation_a: Rot, b: Circle, offset: Vec2, margin: f32) -> Option<Touch> {
    let center = rotation_a.unrotate(offset);
    let (mut gap, face) = a.nearest_face(center);
    if !within(gap - b.radius(), margin) {
        return None;
    }
    let mut normal = a.normals[face];
    let mut nearest = center - normal * gap;
    if gap > 0.0 {
        let (start, end) = (a.vertices[face], a.vertices[a.next(face)]);
        let along = normal.perp();
        let corner = if along.dot(center - start) < 0.0 {
            Some(start)
        } else if along.dot(center - end) > 0.0 {
            Some(end)
        } else {
            None
        };
        if let Some(corner) = corner {
            let distance = (center - corner).length();
            // A distance whose square is lost leaves the face's normal, which is as near.
            if distance * distance >= f32::MIN_POSITIVE {
                (gap, normal, nearest) = (distance, (center - corner) / distance, corner);
            }
        }
    }
    let separation = gap - b.radius();
    // The corner may be further than its face; NaN got here without a face.
    if !(within(separation, margin) && separation.is_finite()) {
        return None;
    }
    // On the circle: the arm of friction is its radius, however far it has sunk in.
    let on_circle = rotation_a.rotate(nearest + normal * separation);
    Some(Touch::new(rotation_a.rotate(normal), on_circle, offset, separation))
}
