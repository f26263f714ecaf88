//! Manifolds of shapes with round corners, known in closed form.

use crate::collision::detection::{Swept, detect_within, time_of_impact};
use crate::collision::{FeatureId, Manifold};
use crate::math::{Rot, Vec2};
use crate::shape::Shape;

fn at_rest(a: &Shape, b: &Shape, offset: Vec2, margin: f32) -> Option<Manifold> {
    detect_within(a, Rot::IDENTITY, b, Rot::IDENTITY, offset, margin)
}

/// 2^-7 m: sums of it with halves are exact.
const OVERLAP: f32 = 1.0 / 128.0;

#[test]
fn a_capsule_flat_on_the_floor_touches_below_the_centres_of_its_ends() {
    let lying = Shape::capsule([-0.5, 0.0], [0.5, 0.0], 0.25);
    let tile = Shape::rounded([[-0.5, -0.25], [0.5, -0.25], [0.5, 0.25], [-0.5, 0.25]], 0.25).unwrap();
    for floor in [Shape::aabb(100.0, 1.0), Shape::obb(100.0, 1.0)] {
        for (upper, below) in [(lying, 0.25), (tile, 0.5)] {
            let manifold = at_rest(&floor, &upper, Vec2::new(7.25, 0.5 + below - OVERLAP), 0.02).unwrap();
            assert_eq!(manifold.normal, Vec2::new(0.0, 1.0));
            let points = manifold.points();
            assert_eq!((points[0].separation, points[1].separation), (-OVERLAP, -OVERLAP));
            assert_eq!(points[0].anchor_a, Vec2::new(7.75, 0.5 - 0.5 * OVERLAP));
            assert_eq!(points[1].anchor_a, Vec2::new(6.75, 0.5 - 0.5 * OVERLAP));
            assert_eq!(points[1].anchor_b, Vec2::new(-0.5, 0.5 * OVERLAP - below));
        }
    }
}

/// No line along an edge is between the cores of the two.
#[test]
fn capsules_in_line_touch_end_to_end() {
    let half = Vec2::new(0.3, 0.4);
    let capsule = Shape::capsule(-half, half, 0.25);
    let along = half * 2.0;
    for blur in [0.0, 1e-7, -1e-7, 1e-4] {
        let rotation = Rot { c: 1.0, s: blur };
        for gap in [-OVERLAP, 0.0, OVERLAP] {
            let offset = along * (1.5 + gap);
            let manifold = detect_within(&capsule, Rot::IDENTITY, &capsule, rotation, offset, 0.02).unwrap();
            let [point] = manifold.points() else { panic!("one point: {manifold:?}") };
            // A core of 1 m that is turned by an angle φ leaves the line by φ/2, over a gap of 0.49 m.
            let tolerance = 1e-6 + 1.1 * blur.abs();
            assert!((manifold.normal - along).length() < tolerance, "{manifold:?}");
            assert!((point.separation - gap).abs() < tolerance, "{manifold:?}");
            assert!((point.anchor_a - along * (0.75 + 0.5 * gap)).length() < tolerance, "{manifold:?}");
            assert_eq!(point.feature, FeatureId::of_vertices(1, 0));
        }
    }
    assert!(at_rest(&capsule, &capsule, along * 1.6, 0.02).is_none());
    let still = |shape| Swept { shape, rotation: Rot::IDENTITY, spin: 0.0, arm: Vec2::ZERO };
    let when = time_of_impact(still(&capsule), still(&capsule), along * 4.0, along * -5.0, 1.0, 0.0).unwrap();
    assert!((when - 0.5).abs() < 1e-6, "{when}");
}

/// The end of a capsule, 0.5 m of radius, around the corner of a box at 0.3 m and 0.4 m: as a disc.
#[test]
fn a_round_end_meets_a_corner_along_the_line_between_them() {
    let (block, upright) = (Shape::aabb(2.0, 2.0), Shape::capsule([0.0, -1.0], [0.0, 1.0], 0.5));
    let manifold = at_rest(&block, &upright, Vec2::new(1.3, 2.4), 0.01).unwrap();
    let [point] = manifold.points() else { panic!("one point: {manifold:?}") };
    assert!((manifold.normal - Vec2::new(0.6, 0.8)).length() < 1e-6);
    assert!(point.separation.abs() < 1e-6);
    assert!((point.anchor_a - Vec2::new(1.0, 1.0)).length() < 1e-6);
    assert_eq!(point.feature, FeatureId::of_vertices(2, 0));
    assert!(manifold.is_of_corners());
    let disc = Shape::circle(0.5);
    let of_disc = at_rest(&block, &disc, Vec2::new(1.3, 1.4), 0.01).unwrap();
    assert!((of_disc.normal - manifold.normal).length() < 1e-6);
}

/// As the end of a capsule goes over the corner of a box, the normal turns with it as it does under a disc.
#[test]
fn the_normal_turns_without_a_jump_where_an_end_goes_over_a_corner() {
    let (block, upright) = (Shape::aabb(2.0, 2.0), Shape::capsule([0.0, -1.0], [0.0, 1.0], 0.5));
    for step in -100..=100 {
        let x = 1.0 + 0.002 * step as f32;
        let offset = Vec2::new(x, 2.49);
        let manifold = at_rest(&block, &upright, offset, 0.05).unwrap();
        let of_disc = at_rest(&block, &Shape::circle(0.5), offset - Vec2::new(0.0, 1.0), 0.05).unwrap();
        assert!((manifold.normal - of_disc.normal).length() < 1e-5, "at {x}: {manifold:?} {of_disc:?}");
        let gap = manifold.points()[0].separation - of_disc.points()[0].separation;
        assert!(gap.abs() < 1e-6, "at {x}: {gap}");
    }
}

/// A tilt by rounding decides anew which face is the reference; the ids must not follow.
#[test]
fn feature_ids_stay_while_a_rounded_box_on_another_trembles() {
    let tile = Shape::rounded([[-0.4, -0.4], [0.4, -0.4], [0.4, 0.4], [-0.4, 0.4]], 0.1).unwrap();
    let lying = Shape::capsule([-0.4, 0.0], [0.4, 0.0], 0.1);
    let expected = [[(2, 1), (3, 0)], [(0, 0), (1, 1)]];
    for (shape, height, expected) in [(tile, 0.999, expected[0]), (lying, 0.199, expected[1])] {
        for tilt in [-1e-3, -1e-7, 0.0, 1e-7, 1e-3] {
            for shift in [-0.1, -1e-7, 0.0, 1e-7, 0.1] {
                let offset = Vec2::new(shift, height);
                let rotation = Rot { c: 1.0, s: tilt };
                let manifold = detect_within(&shape, Rot::IDENTITY, &shape, rotation, offset, 0.02).unwrap();
                let mut ids: Vec<_> = manifold.points().iter().map(|point| point.feature).collect();
                let mut wanted = expected.map(|(a, b)| FeatureId::of_vertices(a, b)).to_vec();
                ids.sort_unstable();
                wanted.sort_unstable();
                assert_eq!(ids, wanted, "{shape:?}: tilt {tilt}, shift {shift}");
            }
        }
    }
}

/// Also where every distance counts.
#[test]
fn an_upright_capsule_touches_with_its_lower_end() {
    let (floor, upright) = (Shape::aabb(10.0, 1.0), Shape::capsule([0.0, -0.5], [0.0, 0.5], 0.25));
    for turned in [Rot::IDENTITY, Rot { c: -1.0, s: 0.0 }] {
        let offset = Vec2::new(1.0, 1.25);
        let manifold = detect_within(&floor, Rot::IDENTITY, &upright, turned, offset, f32::INFINITY).unwrap();
        let [point] = manifold.points() else { panic!("one point: {manifold:?}") };
        assert_eq!((point.separation, point.anchor_a), (0.0, Vec2::new(1.0, 0.5)));
    }
}
