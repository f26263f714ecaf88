//! Random shapes for tests.

use crate::math::{Rot, Vec2};
use crate::shape::Shape;
use crate::testing::Random;

/// The same numbers in every run.
pub(crate) fn rng(seed: u64) -> Random {
    Random(seed)
}

/// Points of a convex outline with `count` corners, counter-clockwise, about 1 m across.
///
/// Corners on a circle, at least a quarter of an even spacing apart, then stretched and turned: convexity outlives
/// both.
pub(crate) fn random_outline(rng: &mut Random, count: usize) -> Vec<Vec2> {
    let spacing = core::f32::consts::TAU / count as f32;
    let stretch = Vec2::new(rng.random_range(0.2..1.0), rng.random_range(0.2..1.0));
    let turn = Rot::from_angle(rng.random_range(0.0..6.0));
    (0..count)
        .map(|i| {
            let on_circle = Rot::from_angle(spacing * (i as f32 + rng.random_range(0.0_f32..0.75)));
            turn.rotate(Vec2::new(stretch.x * on_circle.c, stretch.y * on_circle.s))
        })
        .collect()
}

/// A polygon with 3 to 8 corners, about 1 m across.
pub(crate) fn random_polygon(rng: &mut Random) -> Shape {
    let count = rng.random_range(3..=8);
    Shape::polygon(random_outline(rng, count)).expect("corners of an ellipse are convex")
}

/// A capsule that leans any way, about 1 m across.
pub(crate) fn random_capsule(rng: &mut Random) -> Shape {
    let half =
        Rot::from_angle(rng.random_range(0.0..6.0)).rotate(Vec2::new(rng.random_range(0.05..0.8), 0.0));
    Shape::capsule(-half, half, rng.random_range(0.1..0.5))
}

/// A polygon with 3 to 8 round corners, about 1 m across.
pub(crate) fn random_rounded(rng: &mut Random) -> Shape {
    let count = rng.random_range(3..=8);
    let corners = random_outline(rng, count).into_iter().map(|corner| corner * 0.6);
    Shape::rounded(corners, rng.random_range(0.05..0.4)).expect("corners of an ellipse are convex")
}

/// A segment that leans any way, about 1 m long.
pub(crate) fn random_segment(rng: &mut Random) -> Shape {
    let half = Rot::from_angle(rng.random_range(0.0..6.0)).rotate(Vec2::new(rng.random_range(0.1..1.0), 0.0));
    Shape::segment(-half, half)
}

/// One of each kind of shape that has a thickness, about 1 m across.
pub(crate) fn random_solids(rng: &mut Random) -> [Shape; 6] {
    let mut size = || rng.random_range(0.2..2.0);
    let (radius, w, h, v, k) = (0.5 * size(), size(), size(), size(), size());
    let [circle, aabb, obb] = [Shape::circle(radius), Shape::aabb(w, h), Shape::obb(v, k)];
    [circle, aabb, obb, random_polygon(rng), random_capsule(rng), random_rounded(rng)]
}

/// One of each kind of shape, about 1 m across.
pub(crate) fn random_shapes(rng: &mut Random) -> [Shape; 7] {
    let [circle, aabb, obb, polygon, capsule, rounded] = random_solids(rng);
    [circle, aabb, obb, polygon, capsule, rounded, random_segment(rng)]
}
