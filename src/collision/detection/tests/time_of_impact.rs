//! Laws of the time of impact, against stepping along the motion with the slow twin.

use super::reference::{Solid, signed_distance, wide};
use crate::collision::detection::{Swept, time_of_impact};
use crate::math::{Rot, Vec2};
use crate::shape::Shape;
use crate::shape::testing::{random_shapes, rng};

/// Distances up to 10 m round by ten half epsilons.
const ROUNDING: f64 = 6e-6;

/// A shape that does not turn.
fn still(shape: &Shape, rotation: Rot) -> Swept<'_> {
    Swept { shape, rotation, spin: 0.0, arm: Vec2::ZERO }
}

/// The distance is convex in the fraction, so a law on it is a law on the fraction: at the fraction it is the target,
/// before it is more. Where none is found, no step may be nearer than the target.
#[test]
fn it_is_when_stepping_first_comes_within_the_target() {
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
                let hit =
                    time_of_impact(still(a, rotation_a), still(b, rotation_b), offset, motion, 1.0, target);
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
    let fraction = |a: &Shape, b: &Shape, y: f32| {
        let (a, b) = (still(a, Rot::IDENTITY), still(b, Rot::IDENTITY));
        time_of_impact(a, b, Vec2::new(5.0, y), Vec2::new(-8.0, 0.0), 1.0, 0.0)
    };
    for a in [&ball, &unit] {
        for b in [&ball, &unit] {
            assert_eq!(fraction(a, b, 0.0), Some(0.5));
        }
    }
    // Quadratic: (5 - 8f)² + 0.6² = 1, f = (5 - 0.8) / 8.
    let grazing = fraction(&ball, &ball, 0.6).unwrap();
    assert!((grazing - 0.525).abs() < 1e-6);
}

#[test]
fn nothing_is_hit_by_parting_resting_or_passing_and_an_overlap_is_hit_at_once() {
    let (ball, unit) = (Shape::circle(0.5), Shape::obb(1.0, 1.0));
    let hit = |a: &Shape, b: &Shape, x: f32, y: f32, motion: [f32; 2]| {
        let (a, b) = (still(a, Rot::IDENTITY), still(b, Rot::IDENTITY));
        time_of_impact(a, b, Vec2::new(x, y), motion.into(), 1.0, 0.0)
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

/// What turns may stop early, within the tolerance, or where forty steps were not enough; but nothing is nearer before.
#[test]
fn what_turns_is_never_nearer_before_it_is_stopped() {
    let mut rng = rng(32);
    let (mut stopped, mut near) = (0, 0);
    for trial in 0..200 {
        let goes_round = trial % 2 == 1;
        let (shapes_a, shapes_b) = (random_shapes(&mut rng), random_shapes(&mut rng));
        for (a, b) in shapes_a.iter().zip(shapes_b.iter().rev()) {
            let mut swept = |shape| {
                let can_turn = Shape::can_rotate(shape);
                let spin = if can_turn { rng.random_range(-20.0f32..20.0) } else { 0.0 };
                let rotation = Rot::from_angle(rng.random_range(-3.2f32..3.2));
                let mut place = || Vec2::new(rng.random_range(-0.5f32..0.5), rng.random_range(-0.5f32..0.5));
                Swept { shape, rotation, spin, arm: if goes_round { place() } else { Vec2::ZERO } }
            };
            let (a, b) = (swept(a), swept(b));
            let offset = Vec2::new(rng.random_range(1.5f32..4.0), rng.random_range(-1.0f32..1.0));
            let velocity = Vec2::new(rng.random_range(-40.0f32..0.0), rng.random_range(-5.0f32..5.0));
            let distance = |time: f32| {
                let turned = |swept: Swept<'_>| Rot::from_angle(swept.spin * time) * swept.rotation;
                let swung =
                    |swept: Swept<'_>| Rot::from_angle(swept.spin * time).rotate(swept.arm) - swept.arm;
                let solid_a = Solid::new(a.shape, turned(a), swung(a));
                signed_distance(
                    &solid_a,
                    &Solid::new(b.shape, turned(b), offset + velocity * time + swung(b)),
                )
            };
            let (hit, until) = (time_of_impact(a, b, offset, velocity, 0.1, 0.0), 0.1);
            let last = hit.unwrap_or(until);
            for i in 0..100 {
                let before = distance(last * i as f32 / 100.0);
                assert!(before > -ROUNDING || last == 0.0, "{before} before {last} s");
            }
            if last > 0.0 && last < until {
                stopped += 1;
                near += u32::from(distance(last) < 2e-3);
            }
        }
    }
    assert!(stopped > 200, "{stopped} stopped");
    assert!(f64::from(near) > 0.99 * f64::from(stopped), "{near} of {stopped} were near");
}
