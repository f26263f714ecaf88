//! What was slow was put to sleep, whether or not it was about to move: on a slope steeper than friction holds, in empty
//! space, or where the direct solve was soon to be tried again.

use rustycs::prelude::*;

use crate::support::{G, add, assert_near, assert_relative, place, run};

/// A box on a slope of `degrees`, both of friction 0.5, where gravity is `gravity`; the slope is 1 km long.
fn sledge(degrees: f64, gravity: f64, sleep: bool) -> (World, BodyId) {
    let mut world = World::new(Settings { sleep, ..Settings::default() });
    world.add_force(Force::new("gravity", [0.0, -gravity as f32]));
    let (s, c) = degrees.to_radians().sin_cos();
    let turned = |body: Body| body.angle(degrees.to_radians() as f32).friction(0.5).restitution(0.0);
    add(&mut world, turned(Body::fixed(Shape::obb(1000.0, 1.0))).at([0.5 * s, -0.5 * c]));
    let sledge = add(&mut world, turned(Body::dynamic(Shape::obb(1.0, 0.5))).at([-0.25 * s, 0.25 * c]));
    (world, sledge)
}

/// g (sin - µ cos), m/s².
fn acceleration_of_sledge(degrees: f64, gravity: f64) -> f64 {
    let (s, c) = degrees.to_radians().sin_cos();
    gravity * (s - 0.5 * c)
}

/// The friction angle is 26.565°. Sleep makes no difference at all, and s = a t²/2 at 27°, where a is 1 % of the two
/// forces of which it is the difference, to 1e-3.
#[test]
fn a_box_slides_as_far_with_sleep_as_without_wherever_it_gains_speed() {
    for (degrees, gravity) in [(26.57, G), (26.6, G), (27.0, G), (30.0, G), (27.0, 0.1), (27.0, 1e-2)] {
        let ways = [true, false].map(|sleep| {
            let (mut world, sledge) = sledge(degrees, gravity, sleep);
            let [x, y] = place(&world, sledge);
            run(&mut world, 10.0);
            assert!(!world.body(sledge).unwrap().is_sleeping(), "{degrees}°");
            let [now_x, now_y] = place(&world, sledge);
            (now_x - x).hypot(now_y - y)
        });
        assert_eq!(ways[0], ways[1], "{degrees}° at {gravity} m/s²");
        if degrees >= 27.0 {
            let expected = 0.5 * acceleration_of_sledge(degrees, gravity) * 100.0;
            assert_relative(ways[0], expected, 1e-3, "way in 10 s");
        }
    }
}

#[test]
fn a_box_sleeps_on_a_slope_that_friction_holds() {
    for degrees in [0.0, 15.0, 26.0, 26.56] {
        let (mut world, sledge) = sledge(degrees, G, true);
        run(&mut world, 5.0);
        assert!(world.body(sledge).unwrap().is_sleeping(), "{degrees}°");
    }
}

/// Nothing slows what flies in empty space: x = v t, in 60 s to the rounding of 14,400 substeps of f32, 2^-24 each.
#[test]
fn a_disc_that_drifts_in_empty_space_goes_on() {
    for speed in [4e-2, 1e-3, 1e-6] {
        let mut world = World::new(Settings::default());
        let disc = add(&mut world, Body::dynamic(Shape::circle(0.5)).velocity([speed, 0.0]));
        run(&mut world, 60.0);
        let body = world.body(disc).unwrap();
        assert_eq!((body.velocity(), body.is_sleeping()), (Vec2::new(speed, 0.0), false));
        assert_relative(place(&world, disc)[0], 60.0 * f64::from(speed), 1e-6, "way in 60 s");
    }
}

/// A free pair keeps its momentum, also where an attractor between the two presses one on the other.
#[test]
fn a_pair_that_floats_together_goes_on() {
    for pull in [0.0, 1.0] {
        let mut world = World::new(Settings::default());
        let pair = [-0.5, 0.5]
            .map(|x| add(&mut world, Body::dynamic(Shape::obb(1.0, 1.0)).at([x, 0.0]).velocity([0.0, 1e-5])));
        if pull > 0.0 {
            world.add_attractor(Attractor::global([0.0, 0.0], pull));
        }
        run(&mut world, 20.0);
        assert!(pair.iter().all(|&id| !world.body(id).unwrap().is_sleeping()), "pull {pull}");
    }
}

/// What does not move at all, and what nothing moves, is at rest wherever it is.
#[test]
fn a_body_without_any_velocity_sleeps_in_empty_space() {
    let mut world = World::new(Settings::default());
    let disc = add(&mut world, Body::dynamic(Shape::circle(0.5)));
    run(&mut world, 1.0);
    assert!(world.body(disc).unwrap().is_sleeping());
}

/// A puck with damping c comes to rest after v/c: 1 m, but for the 1 mm that it may miss when it sleeps, and 0.2 % for the
/// damping by substeps.
#[test]
fn what_damping_stops_sleeps_without_a_contact() {
    let mut world = World::new(Settings::default());
    let puck = Body::dynamic(Shape::circle(0.5)).velocity([1.0, 0.0]).angular_velocity(1.0);
    let puck = add(&mut world, puck.linear_damping(1.0).angular_damping(1.0));
    run(&mut world, 30.0);
    assert!(world.body(puck).unwrap().is_sleeping());
    assert_near(place(&world, puck)[0], 1.0, 3e-3, "way");
}

/// What only spins needs no damping but of its spin; what also drifts by, however slowly, is not stopped by that.
#[test]
fn what_only_spins_sleeps_by_damping_of_its_spin_alone() {
    let mut world = World::new(Settings::default());
    let disc = Body::dynamic(Shape::circle(0.5)).angular_velocity(1.0).angular_damping(1.0);
    let spins = add(&mut world, disc.clone());
    let drifts = add(&mut world, disc.at([5.0, 0.0]).velocity([1e-5, 0.0]));
    run(&mut world, 30.0);
    assert!(world.body(spins).unwrap().is_sleeping());
    assert_eq!(world.body(drifts).unwrap().why_awake(), Some(Awake::NotHeld));
}
