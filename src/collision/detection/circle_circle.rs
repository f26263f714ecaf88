//! Circle against circle: the distance of their centres.

use crate::collision::detection::touch::Touch;
use crate::collision::detection::within;
use crate::math::Vec2;
use crate::shape::Circle;

/// The normal of circles with one centre: any would do, but it must be the same one every time.
const NORMAL_OF_ONE_CENTER: Vec2 = Vec2::new(0.0, 1.0);

#[inline]
pub(super) fn touch(a: Circle, b: Circle, offset: Vec2, margin: f32) -> Option<Touch> {
    let distance = offset.length();
    let separation = distance - (a.radius() + b.radius());
    if !within(separation, margin) {
        return None;
    }
    // Below the smallest normal number the square under the root has lost its digits.
    let has_direction = distance * distance >= f32::MIN_POSITIVE;
    let normal = if has_direction { offset / distance } else { NORMAL_OF_ONE_CENTER };
    let halfway = normal * (a.radius() + 0.5 * separation);
    Some(Touch::new(normal, halfway, offset, separation))
}
