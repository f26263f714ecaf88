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

#[test]
fn print_pendulum() {
    println!("period {}", period(core::f64::consts::FRAC_PI_2));
    for substeps in [1, 2, 4, 8] {
        let times = turning_times(substeps, 100.0);
        let n = times.len();
        println!("{substeps}: {} {} swings", (times[n - 1] - times[0]) / (n - 1) as f64 * 2.0, n);
    }
    let mut world = earth();
    let (rod, hinge) = pendulum(&mut world, core::f64::consts::FRAC_PI_2);
    let (mut lowest, mut highest, mut gap) = (f64::MAX, 0.0_f64, 0.0_f32);
    for _ in 0..12000 {
        world.step();
        let e = energy(&world, rod);
        lowest = lowest.min(e);
        highest = highest.max(e);
        gap = gap.max(world.joint(hinge).unwrap().error().distance);
    }
    println!("energy {lowest} {highest} end {} of {}, gap {gap:e}", energy(&world, rod), 0.5 * G);
    run(&mut world, 0.0);
    assert_near(0.0, 0.0, 1.0, "");
    assert_relative(1.0, 1.0, 1.0, "");
}
