//! Attractors.

use rustycs::prelude::*;

use crate::support::{add, assert_near, assert_relative, place, run, velocity};

/// A body at the aphelion of an orbit with semi-major axis 1 m around G·mass = 1: period 2π s.
fn orbit(eccentricity: f32, steps_per_period: f32) -> (World, BodyId) {
    let tick_rate = steps_per_period / std::f32::consts::TAU;
    let mut world = World::new(Settings { tick_rate, sleep: false, ..Settings::default() });
    world.add_attractor(Attractor::global([0.0, 0.0], 1.0).with_min_distance(0.01).unwrap());
    let speed = ((1.0 - eccentricity) / (1.0 + eccentricity)).sqrt();
    let planet = Body::dynamic(Shape::circle(0.01)).at([1.0 + eccentricity, 0.0]).velocity([0.0, speed]);
    let planet = add(&mut world, planet);
    (world, planet)
}

/// Largest relative error of the energy, -G m/(2a) per mass, over 10 periods.
fn worst_energy_error(steps_per_period: f32) -> f64 {
    let (mut world, planet) = orbit(0.5, steps_per_period);
    let exact = -0.5 * f64::from(world.body(planet).unwrap().mass());
    let mut worst = 0.0_f64;
    for _ in 0..10 * steps_per_period as usize {
        world.step();
        worst = worst.max((world.energy() / exact - 1.0).abs());
    }
    worst
}

/// Velocity Verlet keeps the energy to second order in the step and without drift: a quarter of the error
/// for half the step, within what `f32` and the higher orders add.
#[test]
fn a_kepler_orbit_keeps_its_energy_and_the_error_falls_by_four() {
    let coarse = worst_energy_error(240.0);
    assert!(coarse < 1e-2, "relative error of the energy: {coarse:e}");
    let (coarser, coarse) = (worst_energy_error(60.0), worst_energy_error(120.0));
    let ratio = coarser / coarse;
    assert!((3.6..4.4).contains(&ratio), "{coarser:e} / {coarse:e} = {ratio}");
}

/// The period is 2π √(a³/GM): after one the body is back.
#[test]
fn a_kepler_orbit_closes_after_its_period() {
    let (mut world, planet) = orbit(0.5, 960.0);
    run_ticks(&mut world, 960);
    let [x, y] = place(&world, planet);
    assert_near(x, 1.5, 1e-3, "x after a period");
    assert_near(y, 0.0, 1e-3, "y after a period");
}

fn run_ticks(world: &mut World, ticks: usize) {
    for _ in 0..ticks {
        world.step();
    }
}

/// a = G m / r², toward it, whatever the body's mass; nothing beyond the range of a local one.
#[test]
fn attractors_pull_by_the_inverse_square_and_local_ones_end_at_their_range() {
    for (mass, distance) in [(0.1_f32, 2.0_f32), (50.0, 2.0), (1.0, 5.0)] {
        for range in [None, Some(6.0)] {
            let settings = Settings { gravitational_constant: 3.0, tick_rate: 1000.0, ..Settings::default() };
            let mut world = World::new(settings);
            world.add_attractor(Attractor::try_new([0.0, 1.0], 20.0, range).unwrap());
            let pulled = Body::dynamic(Shape::circle(0.1)).at([distance, 1.0]).mass(mass);
            let pulled = add(&mut world, pulled);
            let far = add(&mut world, Body::dynamic(Shape::circle(0.1)).at([-7.0, 1.0]).mass(mass));
            world.step();
            let expected = -60.0 / f64::from(distance * distance) * 1e-3;
            assert_relative(velocity(&world, pulled)[0], expected, 1e-4, "speed after a step");
            assert_near(velocity(&world, pulled)[1], 0.0, 1e-9, "speed across");
            let at_far = if range.is_some() { 0.0 } else { 60.0 / 49.0 * 1e-3 };
            assert_near(velocity(&world, far)[0], at_far, 1e-7, "speed of the far body");
        }
    }
}

/// Through the very centre: the softened pull is finite, and the body comes out as fast as it went in.
#[test]
fn a_fall_through_the_centre_stays_finite_and_keeps_its_energy() {
    let mut world = World::new(Settings { tick_rate: 600.0, sleep: false, ..Settings::default() });
    world.add_attractor(Attractor::global([0.0, 0.0], 10.0).with_min_distance(0.2).unwrap());
    let body = add(&mut world, Body::dynamic(Shape::circle(0.05)).at([2.0, 0.0]));
    let energy = world.energy();
    run(&mut world, 10.0);
    assert_relative(world.energy(), energy, 1e-2, "energy");
    assert!(place(&world, body)[0].abs() <= 2.01);
}
