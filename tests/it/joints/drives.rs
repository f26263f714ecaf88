//! Springs, motors and limits.

use rustycs::prelude::*;

use crate::support::{G, add, assert_near, assert_relative, earth, place, run, space, spin};

/// A body of 1 kg on a spring along x to the world, 1 m off its rest; returns where it is after `seconds`, m.
fn on_spring(hertz: f32, damping_ratio: f32, seconds: f64) -> f64 {
    let mut world = space();
    let body = add(&mut world, Body::dynamic(Shape::obb(0.2, 0.2)).at([0.0, 0.0]).mass(1.0));
    let joint = Joint::prismatic(body, None).at([0.0, 0.0]).axis([1.0, 0.0]);
    let joint = joint.spring(hertz, damping_ratio).rest(-1.0);
    world.add_joint(joint).unwrap();
    run(&mut world, seconds);
    // The world has slid by -x from the body; the spring is at rest where it has slid by -1.
    1.0 - place(&world, body)[0]
}

/// The poles of the scheme are those of the spring: what is left is rounding, of 100 periods of up to 2,400 substeps each.
#[test]
fn an_undamped_spring_keeps_amplitude_and_time_over_a_hundred_periods() {
    for hertz in [0.5_f32, 1.0, 2.0, 5.0, 10.0, 30.0] {
        let seconds = 100.0 / f64::from(hertz);
        assert_near(on_spring(hertz, 0.0, seconds), 1.0, 1e-3, &format!("after 100 periods of {hertz} Hz"));
    }
}

/// From rest at 1 m: x = e^(-ζ ω t) (cos ν t + ζ ω/ν sin ν t), and its limits for ζ ≥ 1. The scheme has the poles, and a first
/// velocity that is off by a share of (ω h)²/6 or so: 5e-4 of the whole at 2 Hz.
#[test]
fn a_damped_spring_follows_its_closed_form() {
    let omega = core::f64::consts::TAU * 2.0;
    for ratio in [0.1_f64, 1.0, 2.0] {
        for seconds in [0.1, 0.2, 0.5] {
            let t = seconds;
            let expected = if ratio < 1.0 {
                let nu = omega * (1.0 - ratio * ratio).sqrt();
                (-ratio * omega * t).exp() * ((nu * t).cos() + ratio * omega / nu * (nu * t).sin())
            } else if ratio > 1.0 {
                let root = omega * (ratio * ratio - 1.0).sqrt();
                let [slow, fast] = [root - ratio * omega, -root - ratio * omega];
                (fast * (slow * t).exp() - slow * (fast * t).exp()) / (fast - slow)
            } else {
                (1.0 + omega * t) * (-omega * t).exp()
            };
            assert_near(on_spring(2.0, ratio as f32, t), expected, 2e-3, &format!("ζ {ratio} after {t} s"));
        }
    }
}

/// A wheel with the moment of inertia I under a torque τ turns at τ t/I until it has the speed that was set.
#[test]
fn a_motor_gains_speed_by_its_torque_and_keeps_the_speed_it_was_set_to() {
    let mut world = space();
    let wheel = add(&mut world, Body::dynamic(Shape::circle(0.5)).at([0.0, 0.0]).mass(2.0));
    // The angle is that of the world as seen from the wheel.
    let hinge = world.add_joint(Joint::revolute(wheel, None).motor(-60.0, 5.0)).unwrap();
    let inertia = f64::from(world.body(wheel).unwrap().inertia());
    run(&mut world, 0.5);
    assert_relative(spin(&world, wheel), 5.0 * 0.5 / inertia, 1e-4, "speed after half a second");
    run(&mut world, 10.0);
    assert_relative(spin(&world, wheel), 60.0, 1e-5, "speed in the end");
    assert_relative(world.joint(hinge).unwrap().angular_speed(), -60.0, 1e-5, "speed of the joint");
}

/// What holds an arm level bears m g l.
#[test]
fn a_motor_that_holds_an_arm_level_bears_the_torque_of_its_weight() {
    let mut world = earth();
    let arm = add(&mut world, Body::dynamic(Shape::obb(1.0, 0.1)).at([0.5, 0.0]).mass(3.0));
    let hinge = world.add_joint(Joint::revolute(arm, None).at([0.0, 0.0]).motor(0.0, 100.0)).unwrap();
    run(&mut world, 1.0);
    assert_near(place(&world, arm)[1], 0.0, 1e-5, "height of the arm");
    let joint = world.joint(hinge).unwrap();
    assert_relative(f64::from(joint.torque().abs()), 3.0 * G * 0.5, 1e-4, "torque");
    assert_relative(f64::from(joint.force().length()), 3.0 * G, 1e-4, "force");
}

/// A rod falls onto a stop straight down: it is there after a quarter of a period from 90 degrees, 0.4839 s, and stays.
#[test]
fn a_limit_stops_a_rod_that_falls_and_holds_it() {
    let mut world = earth();
    let rod = add(&mut world, Body::dynamic(Shape::obb(1.0, 0.1)).at([0.5, 0.0]).mass(1.0));
    // The rod turns clockwise, and so the world counter-clockwise as seen from it.
    let hinge = Joint::revolute(rod, None).at([0.0, 0.0]).limits(-10.0..=core::f64::consts::FRAC_PI_2);
    let hinge = world.add_joint(hinge).unwrap();
    run(&mut world, 0.45);
    assert!(world.joint(hinge).unwrap().angle() < 1.5, "it is not there yet");
    for _ in 0..120 {
        world.step();
        let angle = world.joint(hinge).unwrap().angle();
        assert!(angle < core::f64::consts::FRAC_PI_2 + 1e-6, "{angle} beyond the limit");
    }
    assert_near(world.joint(hinge).unwrap().angle(), core::f64::consts::FRAC_PI_2, 1e-5, "angle at rest");
}

/// At ω = 20 rad/s to a limit at ten turns: the angle counts them all, and stops there. The wheel, of I = 0.125 kg m², gains
/// its speed at α = 800 rad/s², which leaves it ω²/(2 α) = 0.25 rad behind, but for half a substep, 0.02 rad.
#[test]
fn an_angle_counts_ten_turns_and_stops_at_its_limit() {
    let mut world = space();
    let wheel = add(&mut world, Body::dynamic(Shape::circle(0.5)).at([0.0, 0.0]).mass(1.0));
    let limit = 20.0 * core::f64::consts::PI;
    let hinge = Joint::revolute(wheel, None).motor(20.0, 100.0).limits(-limit..=limit);
    let hinge = world.add_joint(hinge).unwrap();
    run(&mut world, 2.0);
    assert_near(world.joint(hinge).unwrap().angle(), 40.0 - 0.25, 0.02, "angle after two seconds");
    run(&mut world, 3.0);
    assert_near(world.joint(hinge).unwrap().angle(), limit, 1e-5, "angle at the limit");
}
