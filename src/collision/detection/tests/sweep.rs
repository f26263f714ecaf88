//! Laws of the sweep, against stepping along the motion with the slow twin.

use super::reference::{Solid, signed_distance, wide};
use crate::collision::detection::sweep;
use crate::math::{Rot, Vec2};
use crate::shape::Shape;
use crate::shape::testing::{random_shapes, rng};

/// Distances up to 10 m round by ten half epsilons.
const ROUNDING: f64 = 6e-6;

/// The distance is convex in the fraction, so a law on it is a law on the fraction: at the fraction it is the target,
/// before it is more. Where the sweep finds nothing, no step may be nearer than the target.
#[test]
fn the_sweep_stops_where_stepping_first_comes_within_the_target() {
    let mut rng = rng(31);
    let (mut stopped, mut passed) = (0, 0);
    for round in 0..400 {
        let (shapes_a, shapes_b) = (random_shapes(&mut rng), random_shapes(&mut rng));
        for a in &shapes_a {
            for b in &shapes_b {
                let mut angle = || Rot::from_angle(rng.random_range(-3.2f32..3.2));
                let (rotation_a, rotation_b, direction) = (angle(), angle(), angle());
                let offset = direction.rotate(Vec2::new(rng.random_range(1.5f32..5.0), 0.0));
                let aim = Vec2::new(rng.random_range(-1.5f32..1.5), rng.random_range(-1.5f32..1.5));
                let motion = (aim - offset) * rng.random_range(0.5f32..2.0);
                let target = if round % 3 == 0 { -0.01 } else { 0.005 * (round % 3 - 1) as f32 };
                let hit = sweep(a, rotation_a, b, rotation_b, offset, motion, target);
                let (solid_a, solid_b) =
                    (Solid::new(a, rotation_a, Vec2::ZERO), Solid::new(b, rotation_b, offset));
                let distance = |fraction: f64| {
                    let [x, y] = wide(motion);
                    signed_distance(&solid_a, &solid_b.moved([fraction * x, fraction * y]))
                };
                let target = f64::from(target);
                let last = f64::from(hit.unwrap_or(1.0));
                for i in 0..100 {
                    let before = distance(last * f64::from(i) / 100.0);
                    assert!(before > target - ROUNDING || last == 0.0, "{round}: {before} {target}");
                }
                if hit.is_some() {
                    stopped += 1;
                    let there = distance(last);
                    assert!((there - target).abs() < ROUNDING || last == 0.0 && there <= target + ROUNDING);
                } else {
                    passed += 1;
                }
            }
        }
    }
    assert!(stopped > 2000 && passed > 500, "{stopped} {passed}");
}

#[test]
fn the_fraction_is_exact_for_motions_in_closed_form() {
    let (ball, unit) = (Shape::circle(0.5), Shape::obb(1.0, 1.0));
    let still = Rot::IDENTITY;
    let along_x =
        |a: &Shape, b: &Shape| sweep(a, still, b, still, Vec2::new(5.0, 0.0), Vec2::new(-8.0, 0.0), 0.0);
    for a in [&ball, &unit] {
        for b in [&ball, &unit] {
            assert_eq!(along_x(a, b), Some(0.5));
        }
    }
    // Quadratic: (5 - 8f)² + 0.6² = 1, f = (5 - 0.8) / 8.
    let grazing = sweep(&ball, still, &ball, still, Vec2::new(5.0, 0.6), Vec2::new(-8.0, 0.0), 0.0).unwrap();
    assert!((grazing - 0.525).abs() < 1e-6);
}

#[test]
fn nothing_is_hit_by_parting_resting_or_passing_and_an_overlap_is_hit_at_once() {
    let (ball, unit) = (Shape::circle(0.5), Shape::obb(1.0, 1.0));
    let hit = |a: &Shape, b: &Shape, x: f32, y: f32, motion: [f32; 2]| {
        sweep(a, Rot::IDENTITY, b, Rot::IDENTITY, Vec2::new(x, y), motion.into(), 0.0)
    };
    for a in [&ball, &unit] {
        for b in [&ball, &unit] {
            assert_eq!(hit(a, b, 3.0, 0.0, [5.0, 0.0]), None);
            assert_eq!(hit(a, b, 3.0, 0.0, [0.0, 0.0]), None);
            assert_eq!(hit(a, b, 3.0, 1.1, [-9.0, 0.0]), None);
            assert_eq!(hit(a, b, 3.0, 0.0, [-1.5, 0.0]), None);
            assert_eq!(hit(a, b, 0.5, 0.0, [5.0, 0.0]), Some(0.0));
            assert_eq!(hit(a, b, f32::NAN, 0.0, [1.0, 0.0]), None);
            assert_eq!(hit(a, b, 3.0, 0.0, [f32::NAN, 0.0]), None);
            assert_eq!(hit(a, b, 3.0, 0.0, [f32::NEG_INFINITY, 0.0]), None);
        }
    }
}
