//! Two boxes that never turn: the gaps along the two axes say everything.

use crate::collision::detection::within;
use crate::collision::{FeatureId, Manifold, ManifoldPoint};
use crate::math::Vec2;
use crate::shape::Rectangle;

#[inline]
pub(super) fn detect(a: &Rectangle, b: &Rectangle, offset: Vec2, margin: f32) -> Option<Manifold> {
    let (half_a, half_b) = (a.half_size(), b.half_size());
    let gap = offset.abs() - (half_a + half_b);
    if !(within(gap.x, margin) && within(gap.y, margin)) {
        return None;
    }
    let right = if offset.x < 0.0 { -1.0 } else { 1.0 };
    let up = if offset.y < 0.0 { -1.0 } else { 1.0 };
    let noise = 4.0 * f32::EPSILON * (offset.x.abs() + offset.y.abs());
    if gap.x > noise && gap.y > noise {
        return corner_to_corner(half_a, gap, Vec2::new(right, up), offset, margin);
    }
    // Where the boxes reach the same way along the face, from the first corner to the second of a's edge.
    let low = (-half_a).max(offset - half_b);
    let high = half_a.min(offset + half_b);
    if gap.x > gap.y {
        let x = right * (half_a.x + 0.5 * gap.x);
        // Right edge 1 runs up from corner 1, left edge 3 runs down; b's corner opposite is i ^ 1.
        let (first, y) = if right > 0.0 { (1, [low.y, high.y]) } else { (3, [high.y, low.y]) };
        let points = [Vec2::new(x, y[0]), Vec2::new(x, y[1])];
        Some(face(Vec2::new(right, 0.0), points, offset, gap.x, first, 1, high.y - low.y > noise))
    } else {
        let y = up * (half_a.y + 0.5 * gap.y);
        // Bottom edge 0 runs right from corner 0, top edge 2 runs left; b's corner opposite is 3 - i = i ^ 3.
        let (first, x) = if up > 0.0 { (2, [high.x, low.x]) } else { (0, [low.x, high.x]) };
        let points = [Vec2::new(x[0], y), Vec2::new(x[1], y)];
        Some(face(Vec2::new(0.0, up), points, offset, gap.y, first, 3, high.x - low.x > noise))
    }
}

/// Edge on edge: two points at the ends of the common stretch, or one where it is a mere point.
#[inline(always)]
fn face(
    normal: Vec2,
    points: [Vec2; 2],
    offset: Vec2,
    separation: f32,
    first: u8,
    opposite: u8,
    has_stretch: bool,
) -> Manifold {
    let second = (first + 1) % 4;
    let point = |at, vertex| {
        ManifoldPoint::new(at, offset, separation, FeatureId::of_vertices(vertex, vertex ^ opposite))
    };
    if has_stretch {
        Manifold::of_two(normal, point(points[0], first), point(points[1], second))
    } else {
        Manifold::of_one(normal, point(points[0], first))
    }
}

/// A gap along both axes: the corners are nearest, on the line between them.
#[cold]
fn corner_to_corner(half_a: Vec2, gap: Vec2, side: Vec2, offset: Vec2, margin: f32) -> Option<Manifold> {
    let distance = gap.length();
    if !within(distance, margin) {
        return None;
    }
    let across = Vec2::new(side.x * gap.x, side.y * gap.y);
    let vertex_a = match (side.x > 0.0, side.y > 0.0) {
        (false, false) => 0,
        (true, false) => 1,
        (true, true) => 2,
        (false, true) => 3,
    };
    let corner = Vec2::new(side.x * half_a.x, side.y * half_a.y);
    let feature = FeatureId::of_vertices(vertex_a, vertex_a ^ 2);
    let point = ManifoldPoint::new(corner + across * 0.5, offset, distance, feature);
    Some(Manifold::of_one(across / distance, point))
}
