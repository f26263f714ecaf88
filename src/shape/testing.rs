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

/// One of each kind of shape, about 1 m across.
pub(crate) fn random_shapes(rng: &mut Random) -> [Shape; 4] {
    let mut size = || rng.random_range(0.2..2.0);
    let (radius, w, h, v, k) = (0.5 * size(), size(), size(), size(), size());
    [Shape::circle(radius), Shape::aabb(w, h), Shape::obb(v, k), random_polygon(rng)]
}
