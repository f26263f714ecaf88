//! A circle so large that the other shape finds it flat: a planet.
//!
//! The face that looks down the line between the centres touches at its ends, as on level ground: over the shape the
//! circle falls off by less than rounding. The distance of the centres is taken in `f64`: in `f32` that from the middle
//! of the Earth comes in pieces of half a metre.

use crate::collision::detection::polygon_polygon::facing;
use crate::collision::detection::{Offset, within};
use crate::collision::{FeatureId, Manifold, ManifoldPoint};
use crate::math::{Rot, Vec2};
use crate::shape::{Circle, Shape};

/// Radius in extents of the other shape from which a circle counts as flat, no unit: a face bulges by less than a part
/// in 80,000 of it.
const FLAT_RADIUS: f32 = 1e4;

/// Whether one of two shapes is a circle that the other finds flat. Of each: whether it is a circle, and its extent, m.
#[inline(always)]
pub(crate) fn is_flat([a, b]: [(bool, f32); 2]) -> bool {
    let is_flat_for = |(is_circle, radius): (bool, f32), (_, extent): (bool, f32)| {
        is_circle && radius > FLAT_RADIUS * extent
    };
    is_flat_for(a, b) || is_flat_for(b, a)
}

/// a is the large circle, b the other shape.
pub(super) fn detect(a: Circle, b: &Shape, rotation_b: Rot, offset: Offset, margin: f32) -> Option<Manifold> {
    let Offset { near, rest } = offset;
    let (x, y) = (f64::from(near.x) + f64::from(rest.x), f64::from(near.y) + f64::from(rest.y));
    let distance = (x * x + y * y).sqrt();
    // In the middle all ways out are as long.
    let normal = if distance == 0.0 {
        Vec2::new(0.0, 1.0)
    } else {
        Vec2::new((x / distance) as f32, (y / distance) as f32)
    };
    let height = (distance - f64::from(a.radius())) as f32;
    let point = |from_b: Vec2, feature: FeatureId| {
        let separation = height + normal.dot(from_b);
        // From b, which is near; from a it is as good as the centre of b.
        let anchor_b = from_b - normal * (0.5 * separation);
        let anchor_a = anchor_b + near;
        ManifoldPoint { anchor_b, ..ManifoldPoint::new(anchor_a, near, separation, feature) }
    };
    let is_near = |point: &ManifoldPoint| within(point.separation, margin) && point.separation.is_finite();
    let Some((hull, radius)) = b.core() else {
        let lowest = point(-normal * b.extent(), FeatureId::SINGLE);
        return is_near(&lowest).then(|| Manifold::of_one(normal, lowest));
    };
    let face = facing(hull, rotation_b.unrotate(normal));
    // Along the outline of the circle, counter-clockwise, its end comes first.
    let [first, second] = [hull.next(face), face].map(|corner| {
        point(
            rotation_b.rotate(hull.vertices[corner]) - normal * radius,
            FeatureId::of_vertices(0, corner as u8),
        )
    });
    match (is_near(&first), is_near(&second)) {
        (true, true) => Some(Manifold::of_two(normal, first, second)),
        (true, false) => Some(Manifold::of_one(normal, first)),
        (false, true) => Some(Manifold::of_one(normal, second)),
        (false, false) => None,
    }
}
