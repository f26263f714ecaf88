//! Polygon, sharp or with round corners, against circle: the face that the centre stands out from furthest, then the ends of
//! that face.
//!
//! The nearest point of a convex outline is always on that face. From an edge: its line is at the true distance,
//! and no line can be further than the outline. From a corner: the direction to the centre lies between the
//! normals of the two edges that meet there, so one of them makes the smallest angle with it, and the lines of
//! all others pass behind the corner.

use crate::collision::detection::touch::Touch;
use crate::collision::detection::{Core, within};
use crate::math::Vec2;
use crate::shape::Circle;

/// a is the polygon, b the circle.
#[inline]
pub(super) fn touch(a: Core<'_>, b: Circle, offset: Vec2, margin: f32) -> Option<Touch> {
    let Core { hull, rotation, radius } = a;
    let center = rotation.unrotate(offset);
    let (mut gap, face) = hull.nearest_face(center);
    let radii = b.radius() + radius;
    if !within(gap - radii, margin) {
        return None;
    }
    let mut normal = hull.normals[face];
    let mut nearest = center - normal * gap;
    // A line has no inside.
    if gap > 0.0 || hull.is_segment() {
        let [start, end] = hull.ends_from(face, center);
        let corner = if start > 0.0 {
            Some(hull.vertices[face])
        } else if end < 0.0 {
            Some(hull.vertices[hull.next(face)])
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
    let separation = gap - radii;
    // The corner may be further than its face; NaN got here without a face.
    if !(within(separation, margin) && separation.is_finite()) {
        return None;
    }
    // On the circle: the arm of friction is its radius, however far it has sunk in.
    let on_circle = rotation.rotate(nearest + normal * (radius + separation));
    Some(Touch::new(rotation.rotate(normal), on_circle, offset, separation))
}
