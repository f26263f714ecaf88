//! Manifolds of segments, known in closed form.

use crate::collision::detection::detect_within;
use crate::math::{Rot, Vec2};
use crate::shape::Shape;

/// 2^-7 m: sums of it with halves are exact.
const OVERLAP: f32 = 1.0 / 128.0;

#[test]
fn a_segment_bears_a_box_and_a_disc_on_both_sides() {
    let floor = Shape::segment([-10.0, 0.0], [10.0, 0.0]);
    for side in [1.0, -1.0] {
        for (shape, reach, points) in
            [(Shape::obb(1.0, 1.0), 0.5, 2), (Shape::circle(0.5), 0.5, 1), (Shape::aabb(1.0, 2.0), 1.0, 2)]
        {
            let offset = Vec2::new(3.0, side * (reach - OVERLAP));
            let manifold = detect_within(&floor, Rot::IDENTITY, &shape, Rot::IDENTITY, offset, 0.0).unwrap();
            assert_eq!(manifold.normal, Vec2::new(0.0, side));
            assert_eq!(manifold.points().len(), points);
            assert!(manifold.points().iter().all(|point| point.separation == -OVERLAP));
        }
    }
}

/// The end of a segment against the side of a box, and another segment in line.
#[test]
fn the_end_of_a_segment_meets_what_is_before_it() {
    let bar = Shape::segment([-1.0, 0.0], [1.0, 0.0]);
    for (shape, reach) in [(Shape::obb(1.0, 1.0), 0.5), (Shape::circle(0.5), 0.5), (bar, 1.0)] {
        for gap in [OVERLAP, -OVERLAP] {
            let offset = Vec2::new(1.0 + reach + gap, 0.0);
            let manifold = detect_within(&bar, Rot::IDENTITY, &shape, Rot::IDENTITY, offset, 0.02).unwrap();
            if gap > 0.0 || shape != bar {
                assert_eq!(manifold.normal, Vec2::new(1.0, 0.0), "{shape:?}, {gap}");
                assert_eq!(manifold.points()[0].separation, gap, "{shape:?}");
            }
        }
    }
}

#[test]
fn a_segment_has_no_round_corners() {
    let bar = Shape::segment([-1.0, 0.0], [1.0, 0.0]);
    let leaning = Rot::from_angle(0.7);
    let manifold =
        detect_within(&bar, Rot::IDENTITY, &Shape::obb(1.0, 1.0), leaning, Vec2::new(1.69, 0.1), 0.5)
            .unwrap();
    assert!(!manifold.is_of_corners());
}
