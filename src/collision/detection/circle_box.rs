//! Box against circle: the nearest point of the box, by clamping the circle's centre to it.

use crate::collision::detection::touch::Touch;
use crate::collision::detection::within;
use crate::math::{Rot, Vec2};
use crate::shape::{Circle, Rectangle};

/// a is the box, b the circle.
#[inline]
pub(super) fn touch(a: &Rectangle, rotation_a: Rot, b: Circle, offset: Vec2, margin: f32) -> Option<Touch> {
    let half = a.half_size();
    let center = rotation_a.unrotate(offset);
    let (gap, normal, nearest) = nearest_on_box(half, center);
    let separation = gap - b.radius();
    if !within(separation, margin) {
        return None;
    }
    // On the circle: the arm of friction is its radius, however far it has sunk in.
    let on_circle = rotation_a.rotate(nearest + normal * separation);
    Some(Touch::new(rotation_a.rotate(normal), on_circle, offset, separation))
}

/// Signed distance of a point from the outline of a box, m, the outward normal and the nearest point of the
/// outline, all in the box's frame.
#[inline(always)]
fn nearest_on_box(half: Vec2, point: Vec2) -> (f32, Vec2, Vec2) {
    let nearest = point.max(-half).min(half);
    let away = point - nearest;
    let squared = away.length_squared();
    // Below the smallest normal number the direction has lost its digits: as good as on the border.
    if squared >= f32::MIN_POSITIVE {
        let distance = squared.sqrt();
        return (distance, away / distance, nearest);
    }
    // Inside: out by the nearest side; of equally near ones, the upper.
    let gap = point.abs() - half;
    if gap.x > gap.y {
        let side = if point.x < 0.0 { -1.0 } else { 1.0 };
        (gap.x, Vec2::new(side, 0.0), Vec2::new(side * half.x, point.y))
    } else {
        let side = if point.y < 0.0 { -1.0 } else { 1.0 };
        (gap.y, Vec2::new(0.0, side), Vec2::new(point.x, side * half.y))
    }
}
