//! Pendulums: periods, energy, and the forces in their pins.

use rustycs::prelude::*;

use crate::support::{G, add, assert_near, assert_relative, earth, place, run, spin};

/// Length of a rod between its pins, m; it is 0.1 m wide.
const LENGTH: f64 = 1.0;
const WIDTH: f64 = 0.1;

/// A rod of 1 kg that hangs on a pin, at an angle from straight down, rad.
fn pendulum(world: &mut World, angle: f64) -> (BodyId, JointId) {
    let center = [0.5 * LENGTH * angle.sin(), -0.5 * LENGTH * angle.cos()];
    let rod = Body::dynamic(Shape::obb(WIDTH as f32, LENGTH as f32)).at(center).angle(angle as f32).mass(1.0);
    let rod = add(world, rod);
    let hinge = world.add_joint(Joint::revolute(rod, None).at([0.0, 0.0])).unwrap();
    (rod, hinge)
}

/// Moment of inertia of the rod about its pin, kg m².
fn inertia() -> f64 {
    (LENGTH * LENGTH + WIDTH * WIDTH) / 12.0 + 0.25 * LENGTH * LENGTH
}

/// Energy of the rod above that of hanging at rest, J.
fn energy(world: &World, rod: BodyId) -> f64 {
    0.5 * inertia() * spin(world, rod).powi(2) + G * (place(world, rod)[1] + 0.5 * LENGTH)
}

/// Arithmetic-geometric mean, which gives the complete elliptic integral: K(k) = π / (2 agm(1, √(1 - k²))).
fn agm(mut a: f64, mut b: f64) -> f64 {
    for _ in 0..10 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}

/// Time of a swing from `angle` and back, s: T = 4 √(I / (m g l)) K(sin (angle / 2)).
fn period(angle: f64) -> f64 {
    let quarter = core::f64::consts::FRAC_PI_2 / agm(1.0, (0.5 * angle).cos());
    4.0 * (inertia() / (0.5 * G * LENGTH)).sqrt() * quarter
}

/// Times at which the rod turns from one direction into the other, s.
fn turning_times(substeps: u32, seconds: f64) -> Vec<f64> {
    let mut world = earth();
    world.set_settings(Settings { substeps, sleep: false, ..Settings::default() }).unwrap();
    let (rod, _) = pendulum(&mut world, core::f64::consts::FRAC_PI_2);
    let (mut times, mut before) = (Vec::new(), spin(&world, rod));
    while world.time() < seconds {
        world.step();
        let now = spin(&world, rod);
        if before * now < 0.0 {
            times.push(world.time() - now / (now - before) / 60.0);
        }
        before = now;
    }
    times
}

/// A substep of h changes the period by a share of (ω h)²/24 or so, with ω of 3.83 rad/s: 1e-5 at 4 substeps, which a swing
/// of a right angle, of more than its small ones, makes three times as much.
#[test]
fn a_box_pendulum_swings_in_the_time_of_its_elliptic_integral() {
    let times = turning_times(4, 100.0);
    let swings = (times.len() - 1) as f64;
    let found = 2.0 * (times[times.len() - 1] - times[0]) / swings;
    assert_relative(found, period(core::f64::consts::FRAC_PI_2), 1e-4, "period from a right angle");
}

#[test]
fn twice_the_substeps_leave_a_quarter_of_the_error_of_a_pendulum() {
    let exact = period(core::f64::consts::FRAC_PI_2);
    let [coarse, fine] = [1, 2].map(|substeps| {
        let times = turning_times(substeps, 50.0);
        2.0 * (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64 - exact
    });
    assert_near(coarse / fine, 4.0, 0.3, "ratio of errors");
}

/// The energy of the scheme differs from that of the body by terms of (ω h)² that do not add up: 1e-4 of the whole.
#[test]
fn a_pendulum_keeps_its_energy_over_a_hundred_swings() {
    let mut world = earth();
    let (rod, hinge) = pendulum(&mut world, core::f64::consts::FRAC_PI_2);
    for _ in 0..11_600 {
        world.step();
        assert_relative(energy(&world, rod), 0.5 * G * LENGTH, 1e-4, "energy");
        // The pose is in `f32`, of which a metre has digits of 6e-8.
        let gap = world.joint(hinge).unwrap().error();
        assert!(gap.distance < 2e-7, "{gap:?}");
    }
}

/// A small disc that hangs on a rod or a rope by a handle of 0.5 m, and swings with 20 rad/s about its own centre, does so at √(T r/I) of
/// hundreds of rad/s, where the handle comes straight. There a step is too long if its solve comes to no end, of a rope as of a rod: taken as it
/// was, it took 95 % of the energy within two seconds. Steps up to a radian waver by an eighth of it. The first tick, in which the rope first bears,
/// is left out.
#[test]
fn a_disc_on_a_handle_keeps_swinging_on_a_rope() {
    for kind in ["rod", "rope", "rope of a pulley"] {
        let mut world = earth();
        let disc = Body::dynamic(Shape::circle(0.045)).at([0.0, -1.5]).angular_velocity(20.0).mass(1.0);
        let disc = add(&mut world, disc);
        let handle = |joint: Joint| joint.local_anchors([0.0, 0.5], [0.0, 0.0]);
        let joint = match kind {
            "rod" => Joint::distance(disc, None),
            "rope" => Joint::rope(disc, None),
            _ => {
                let hook = add(&mut world, Body::fixed(Shape::circle(0.1)).at([5.0, -2.0]));
                Joint::pulley(disc, hook, [0.0, 0.0], [5.0, 0.0])
            }
        };
        world.add_joint(handle(joint)).unwrap();
        let energy = |world: &World| world.energy() + 1.5 * G;
        world.step();
        let start = energy(&world);
        for tick in 0..600 {
            world.step();
            assert_relative(energy(&world), start, 0.125, &format!("energy on a {kind}, tick {tick}"));
        }
    }
}

/// A point on a thread bears its weight and the centripetal m v²/r = 2 m g: 3 m g. A disc of r = 0.01 m is one but for 5e-5.
#[test]
fn a_pin_bears_three_times_the_weight_at_the_bottom_of_a_swing() {
    let mut world = earth();
    let bob = add(&mut world, Body::dynamic(Shape::circle(0.01)).at([1.0, 0.0]).mass(1.0));
    let pin = world.add_joint(Joint::revolute(bob, None).at([0.0, 0.0])).unwrap();
    let mut largest = 0.0_f32;
    for _ in 0..120 {
        world.step();
        largest = largest.max(world.joint(pin).unwrap().force().length());
    }
    // A tick is off the bottom by 0.037 rad at most, where the force is less by 3 (1 - cos): 7e-4 of the whole.
    assert_relative(f64::from(largest), 3.0 * G, 1e-3, "force");
}

/// Two rods from 45 degrees at rest, by a Runge-Kutta integration of their equations to ten digits.
#[test]
fn a_double_pendulum_is_where_its_equations_take_it() {
    let mut world = earth();
    let angle = core::f64::consts::FRAC_PI_4;
    let (upper, _) = pendulum(&mut world, angle);
    let end = [LENGTH * angle.sin(), -LENGTH * angle.cos()];
    let center = [1.5 * end[0], 1.5 * end[1]];
    let lower =
        Body::dynamic(Shape::obb(WIDTH as f32, LENGTH as f32)).at(center).angle(angle as f32).mass(1.0);
    let lower = add(&mut world, lower);
    world.add_joint(Joint::revolute(upper, lower).at(end)).unwrap();
    run(&mut world, 1.0);
    let angle_of = |id| f64::from(world.body(id).unwrap().angle());
    // Of second order with h = 1/240 s and frequencies up to 9 rad/s: (ω h)²/24 of a phase of 9 is 5e-4.
    assert_near(angle_of(upper), -0.609_806_796_4, 1e-3, "upper angle after a second");
    assert_near(angle_of(lower), -0.815_734_954_3, 1e-3, "lower angle after a second");
}
