//! Two shapes of any size in any place: no panic, and no number that is not finite.

#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use rustycs::collision::detect;
use rustycs::{Point, Pose, Rot, Shape};

#[derive(Arbitrary, Debug)]
enum Outline {
    Circle(f32),
    Aabb(f32, f32),
    Obb(f32, f32),
    Polygon(Vec<[f32; 2]>),
    Capsule([[f32; 2]; 2], f32),
    Rounded(Vec<[f32; 2]>, f32),
    Segment([[f32; 2]; 2]),
}

impl Outline {
    fn shape(&self) -> Option<Shape> {
        let shape = match self {
            Self::Circle(radius) => Shape::circle(*radius),
            Self::Aabb(width, height) => Shape::aabb(*width, *height),
            Self::Obb(width, height) => Shape::obb(*width, *height),
            Self::Capsule([a, b], radius) => Shape::capsule(*a, *b, *radius),
            Self::Segment([a, b]) => Shape::segment(*a, *b),
            Self::Rounded(corners, radius) => Shape::rounded(corners.iter().copied(), *radius).ok()?,
            Self::Polygon(corners) => Shape::polygon(corners.iter().copied()).ok()?,
        };
        shape.validate().ok().map(|()| shape)
    }
}

#[derive(Arbitrary, Debug)]
struct Pair {
    outlines: [Outline; 2],
    places: [[f64; 2]; 2],
    angles: [f32; 2],
}

fuzz_target!(|pair: Pair| {
    let [Some(a), Some(b)] = pair.outlines.each_ref().map(Outline::shape) else { return };
    let is_allowed = |value: &f64| value.abs() <= 1e12;
    if !pair.places.as_flattened().iter().all(is_allowed) || !pair.angles.iter().all(|angle| angle.is_finite()) {
        return;
    }
    let [pose_a, pose_b] = [0, 1].map(|index| Pose {
        center: Point::from(pair.places[index]),
        rotation: Rot::from_angle(pair.angles[index]),
    });
    for (one, pose_one, other, pose_other) in [(&a, pose_a, &b, pose_b), (&b, pose_b, &a, pose_a)] {
        let Some(manifold) = detect(one, pose_one, other, pose_other) else { continue };
        let length = manifold.normal.length();
        assert!((length - 1.0).abs() < 1e-3, "{manifold:?}");
        assert!((1..=2).contains(&manifold.points().len()));
        for point in manifold.points() {
            assert!(point.anchor_a.is_finite() && point.anchor_b.is_finite() && point.separation.is_finite());
        }
    }
});
