//! Bodies that nothing touches.

use rustycs::prelude::*;

use crate::support::{G, add, assert_near, assert_relative, earth_with, place, run, space, velocity};

/// x = x₀ + v₀ t + a t²/2. Half kicks before and after the drift make the sum exact for constant a; what is
/// left is `f32` rounding of the small steps, at most 1e-7 each and of either sign: below 1e-6 of the way.
#[test]
fn free_flight_is_exact_at_any_tick_rate() {
    for tick_rate in [15.0, 60.0, 240.0] {
        let mut world = earth_with(Settings { tick_rate, ..Settings::default() });
        world.add_force(Force::new("wind", [2.0, 0.0]));
        let ball = add(&mut world, Body::dynamic(Shape::circle(0.5)).at([1.0, 100.0]).velocity([3.0, 4.0]));
        run(&mut world, 2.0);
        let [x, y] = place(&world, ball);
        assert_relative(x - 1.0, 3.0 * 2.0 + 2.0 * 2.0 * 2.0 / 2.0, 1e-6, "way across");
        assert_relative(y - 100.0, 4.0 * 2.0 - G * 2.0 * 2.0 / 2.0, 1e-6, "way down");
        let [vx, vy] = velocity(&world, ball);
        assert_relative(vx, 3.0 + 2.0 * 2.0, 1e-6, "speed across");
        assert_relative(vy, 4.0 - G * 2.0, 1e-6, "speed down");
    }
}

/// θ = w t = 200 rad. Each substep turns by exactly w h; the product of 2400 rotations in `f32` drifts by at
/// most 2400 × 1.2e-7 = 3e-4 rad.
#[test]
fn a_free_spin_keeps_its_rate() {
    let mut world = space();
    let top = add(&mut world, Body::dynamic(Shape::obb(1.0, 0.4)).angular_velocity(20.0));
    run(&mut world, 10.0);
    let turns = (200.0_f64 - f64::from(world.body(top).unwrap().angle())) / std::f64::consts::TAU;
    assert_near(turns, turns.round(), 1e-3 / std::f64::consts::TAU, "turns");
    assert_eq!(world.body(top).unwrap().angular_velocity(), 20.0);
}

/// v = v₀ e^(-ct): the factor per half kick agrees with e^(-x) to x³/6 with x = c h / 2 = 1e-3, so that over
/// 960 of them the relative error is 960 × 2e-10; `f32` rounds v 960 times by up to 6e-8 of either sign.
#[test]
fn damping_slows_exponentially() {
    let mut world = space();
    let body = Body::dynamic(Shape::obb(1.0, 1.0)).velocity([10.0, 0.0]).angular_velocity(5.0);
    let body = add(&mut world, body.linear_damping(0.5).angular_damping(0.25));
    run(&mut world, 2.0);
    assert_relative(velocity(&world, body)[0], 10.0 * (-1.0_f64).exp(), 1e-5, "speed");
    assert_relative(crate::support::spin(&world, body), 5.0 * (-0.5_f64).exp(), 1e-5, "spin");
}

/// A force acts for one step: v = F dt / m per step in which it was applied.
#[test]
fn applied_forces_and_impulses_change_momentum_by_their_amount() {
    let mut world = space();
    let body = add(&mut world, Body::dynamic(Shape::obb(2.0, 1.0)).mass(3.0));
    let mut handle = world.body_mut(body).unwrap();
    handle.apply_force([6.0, 0.0]);
    handle.apply_force([0.0, 3.0]);
    handle.apply_torque(2.0);
    let inertia = f64::from(world.body(body).unwrap().inertia());
    assert_relative(inertia, 3.0 * (4.0 + 1.0) / 12.0, 1e-6, "inertia of a rectangle");
    world.step();
    world.step();
    assert_relative(velocity(&world, body)[0], 2.0 / 60.0, 1e-6, "force / mass for one step");
    assert_relative(velocity(&world, body)[1], 1.0 / 60.0, 1e-6, "force / mass for one step");
    assert_relative(crate::support::spin(&world, body), 2.0 / inertia / 60.0, 1e-6, "torque / inertia");
    let mut handle = world.body_mut(body).unwrap();
    handle.set_velocity([0.0, 0.0]);
    handle.set_angular_velocity(0.0);
    let corner = handle.view().pose().to_world(Vec2::new(1.0, 0.5));
    let turned = f64::from(handle.view().angle());
    handle.apply_impulse_at([0.0, 3.0], corner);
    let arm = turned.cos() - 0.5 * turned.sin();
    assert_relative(velocity(&world, body)[1], 1.0, 1e-6, "impulse / mass");
    assert_relative(crate::support::spin(&world, body), 3.0 * arm / inertia, 1e-5, "arm × impulse / inertia");
}

/// Gravity scale and fixed rotation are the body's own; kinematic bodies move as told.
#[test]
fn options_of_a_body_change_its_motion_and_no_other() {
    let mut world = earth_with(Settings::default());
    let shape = || Shape::obb(1.0, 1.0);
    let plain = add(&mut world, Body::dynamic(shape()).at([0.0, 50.0]));
    let floating = add(&mut world, Body::dynamic(shape()).at([10.0, 50.0]).gravity_scale(0.0));
    let lift = add(&mut world, Body::kinematic(shape()).at([20.0, 50.0]).velocity([0.0, 1.0]));
    let wall = add(&mut world, Body::fixed(shape()).at([30.0, 50.0]).velocity([5.0, 5.0]));
    run(&mut world, 1.0);
    assert_near(place(&world, plain)[1], 50.0 - G / 2.0, 1e-5, "falls");
    assert_eq!(place(&world, floating), [10.0, 50.0]);
    assert_near(place(&world, lift)[1], 51.0, 1e-5, "rises");
    assert_eq!(place(&world, wall), [30.0, 50.0]);
}
