//! Manifolds known in closed form, and inputs that are none.

use crate::collision::detection::{detect, detect_within};
use crate::collision::{FeatureId, Manifold};
use crate::math::{Pose, Rot, Vec2};
use crate::shape::Shape;
use crate::shape::testing::{random_shapes, random_solids, rng};

fn at_rest(a: &Shape, b: &Shape, offset: Vec2, margin: f32) -> Option<Manifold> {
    detect_within(a, Rot::IDENTITY, b, Rot::IDENTITY, offset, margin)
}

/// 2^-7 m: sums of it with halves are exact, and so must be the separation.
const OVERLAP: f32 = 1.0 / 128.0;

#[test]
fn a_box_flat_on_the_floor_touches_at_its_two_lower_corners_equally() {
    let square = Shape::polygon(Shape::obb(1.0, 1.0).vertices()).unwrap();
    for floor in [Shape::aabb(100.0, 1.0), Shape::obb(100.0, 1.0)] {
        for upper in [Shape::aabb(1.0, 1.0), Shape::obb(1.0, 1.0), square] {
            let manifold = at_rest(&floor, &upper, Vec2::new(7.25, 1.0 - OVERLAP), 0.02).unwrap();
            assert_eq!(manifold.normal, Vec2::new(0.0, 1.0));
            let points = manifold.points();
            assert_eq!((points[0].separation, points[1].separation), (-OVERLAP, -OVERLAP));
            assert_eq!(points[0].anchor_a, Vec2::new(7.75, 0.5 - 0.5 * OVERLAP));
            assert_eq!(points[1].anchor_a, Vec2::new(6.75, 0.5 - 0.5 * OVERLAP));
            assert_eq!(points[1].anchor_b, Vec2::new(-0.5, -0.5 + 0.5 * OVERLAP));
        }
    }
}

/// The two corners of a square on a slope differ only by the rounding of 1 m lengths.
#[test]
fn a_box_flat_on_a_slope_has_equal_separations_at_both_corners() {
    let (slope, square) = (Shape::obb(100.0, 1.0), Shape::obb(1.0, 1.0));
    for i in 0..100 {
        let rotation = Rot::from_angle(0.03 * i as f32);
        let offset = rotation.rotate(Vec2::new(2.0, 0.99));
        let manifold = detect_within(&slope, rotation, &square, rotation, offset, 0.02).unwrap();
        let [first, second] = manifold.points() else { panic!("two points") };
        assert!((first.separation - second.separation).abs() <= 1.2e-7, "{manifold:?}");
        assert!((first.separation + 0.01).abs() <= 4e-7, "{manifold:?}");
    }
}

#[test]
fn corners_across_a_gap_report_their_true_distance_and_direction() {
    let square = Shape::polygon(Shape::obb(2.0, 2.0).vertices()).unwrap();
    // Corner (1, 1) of a, corner (1.3, 1.4) of b: 0.3, 0.4, 0.5.
    for b in [Shape::aabb(2.0, 2.0), Shape::obb(2.0, 2.0), square] {
        for a in [Shape::aabb(2.0, 2.0), Shape::obb(2.0, 2.0), square] {
            let manifold = at_rest(&a, &b, Vec2::new(2.3, 2.4), 0.6).unwrap();
            let [point] = manifold.points() else { panic!("one point: {manifold:?}") };
            assert!((point.separation - 0.5).abs() < 5e-7);
            assert!((manifold.normal - Vec2::new(0.6, 0.8)).length() < 1e-6);
            assert!((point.anchor_a - Vec2::new(1.15, 1.2)).length() < 5e-7);
            assert_eq!(point.feature, FeatureId::of_vertices(2, 0));
            // Both gaps along the axes are below the margin, the distance is not.
            assert!(at_rest(&a, &b, Vec2::new(2.3, 2.4), 0.45).is_none());
        }
        // From the corner of a box to a circle the same.
        let manifold = at_rest(&b, &Shape::circle(1.0), Vec2::new(1.6, 1.8), 0.1).unwrap();
        assert!((manifold.normal - Vec2::new(0.6, 0.8)).length() < 1e-6);
        assert!(manifold.points()[0].separation.abs() < 5e-7);
    }
}

#[test]
fn touching_is_contact_and_a_gap_is_not() {
    let (unit, ball) = (Shape::aabb(1.0, 1.0), Shape::circle(0.5));
    for b in [unit, ball, Shape::obb(1.0, 1.0)] {
        for a in [unit, ball, Shape::obb(1.0, 1.0)] {
            let pose = |y: f64| Pose::at([0.0, y]);
            assert_eq!(detect(&a, pose(0.0), &b, pose(1.0)).unwrap().points()[0].separation, 0.0);
            assert!(detect(&a, pose(0.0), &b, pose(1.000_001)).is_none());
        }
    }
}

#[test]
fn boxes_that_touch_at_corners_only_touch_at_one_point() {
    for shape in [Shape::aabb(1.0, 1.0), Shape::obb(1.0, 1.0)] {
        let manifold = at_rest(&shape, &shape, Vec2::new(1.0, 1.0), 0.01).unwrap();
        assert_eq!(manifold.points().len(), 1);
        assert_eq!(manifold.points()[0].anchor_a, Vec2::new(0.5, 0.5));
    }
}

#[test]
fn shapes_with_one_center_part_along_a_definite_normal() {
    let mut rng = rng(21);
    let shapes = random_solids(&mut rng);
    for a in &shapes {
        for b in &shapes {
            let manifold = at_rest(a, b, Vec2::ZERO, 0.0).unwrap();
            assert!((manifold.normal.length() - 1.0).abs() < 4e-7);
            assert_eq!(Some(manifold), at_rest(a, b, Vec2::ZERO, 0.0));
            assert!(manifold.points().iter().all(|p| p.separation < 0.0 && p.anchor_a.is_finite()));
        }
    }
    let ball = Shape::circle(1.0);
    let manifold = at_rest(&ball, &ball, Vec2::ZERO, 0.0).unwrap();
    assert_eq!((manifold.normal, manifold.points()[0].separation), (Vec2::new(0.0, 1.0), -2.0));
    // So near that the square of the distance is lost, and still a unit vector.
    let manifold = at_rest(&ball, &ball, Vec2::new(1e-30, 0.0), 0.0).unwrap();
    assert_eq!(manifold.normal, Vec2::new(0.0, 1.0));
}

#[test]
fn numbers_that_are_none_give_no_manifold_and_no_panic() {
    let mut rng = rng(22);
    let shapes = random_shapes(&mut rng);
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    for a in &shapes {
        for b in &shapes {
            assert_eq!(at_rest(a, b, Vec2::ZERO, f32::NAN), None);
            for value in bad {
                for offset in [Vec2::new(value, 0.0), Vec2::new(0.3, value), Vec2::splat(value)] {
                    assert_eq!(at_rest(a, b, offset, 0.1), None, "{a:?} {b:?} {offset:?}");
                }
                let broken = Rot { c: value, s: value };
                for (rot_a, rot_b) in [(broken, Rot::IDENTITY), (Rot::IDENTITY, broken)] {
                    let _no_panic = detect_within(a, rot_a, b, rot_b, Vec2::new(0.1, 0.2), 0.1);
                }
            }
        }
    }
}

/// Places are subtracted in f64, so a manifold has the same bits wherever in the world it is.
#[test]
fn a_manifold_is_the_same_far_from_the_origin() {
    let mut rng = rng(23);
    let (shapes_a, shapes_b) = (random_solids(&mut rng), random_solids(&mut rng));
    for a in &shapes_a {
        for b in &shapes_b {
            let near = detect(a, Pose::new([0.0, 0.0], 0.3), b, Pose::new([0.25, 0.125], 1.0));
            let far = detect(a, Pose::new([1e9, -3e9], 0.3), b, Pose::new([1e9 + 0.25, -3e9 + 0.125], 1.0));
            assert!(near.is_some());
            assert_eq!(near, far);
        }
    }
}

/// The deepest point is that on level ground, but for what the circle falls off by, extent²/2R, here 4e-8 m, and for the
/// rounding of numbers as large as the shapes, 1e-6 m.
#[test]
fn a_shape_on_a_planet_touches_as_on_level_ground() {
    let radius = 6.4e6;
    let (planet, ground) = (Shape::circle(radius), Shape::aabb(100.0, 10.0));
    let mut rng = rng(7);
    for (number, shape) in (0..100).flat_map(|_| random_solids(&mut rng)).enumerate() {
        let pose = Pose::new([0.0, 0.1], 0.1 * number as f32);
        let on_planet = detect(&planet, Pose::at([0.0, -f64::from(radius)]), &shape, pose);
        let on_ground = detect(&ground, Pose::at([0.0, -5.0]), &shape, pose);
        let (Some(on_planet), Some(on_ground)) = (on_planet, on_ground) else {
            panic!("{shape:?} does not touch")
        };
        assert!((on_planet.normal - on_ground.normal).length() < 1e-6);
        let deepest =
            |manifold: &Manifold| manifold.points().iter().map(|point| point.separation).fold(0.0, f32::min);
        let (here, there) = (deepest(&on_planet), deepest(&on_ground));
        assert!((here - there).abs() < 2e-6, "{shape:?}: {here} m, not {there} m");
        assert_eq!(on_planet.points().len(), on_ground.points().len(), "{shape:?}");
        let flipped = detect(&shape, pose, &planet, Pose::at([0.0, -f64::from(radius)])).unwrap();
        assert_eq!(flipped, on_planet.flipped());
    }
}
