//! Friction was asked to stop in a substep what takes a thousand times its force, and cut to that; the hinge beside it was left with what it
//! had to bear for the whole: 26 J became 17 MJ. And at its bound it pointed along the lighter way of its anchor, not against the slip.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

use crate::support::add;

/// The most energy that a world has in so many steps, as a share of that with which it begins.
fn most_energy(world: &mut World, steps: u32) -> f64 {
    let start = world.kinetic_energy();
    let energies = (0..steps).map(|_| {
        world.step();
        world.kinetic_energy()
    });
    energies.fold(0.0, f64::max) / start
}

#[test]
fn two_bodies_on_a_hinge_lose_energy_by_friction() {
    let mut world = World::new(Settings::default());
    let plank = |x: f64, mass: f32| Body::dynamic(Shape::rectangle(1.0, 0.5)).at([x, 0.0]).mass(mass);
    let a = plank(-1.0, 0.183_126_45).velocity([4.592_156_4, 5.559_805]).angular_velocity(-0.734_431_3);
    let b = plank(1.0, 2.410_278_8).velocity([1.435_346_6, -3.624_944_7]).angular_velocity(-4.738_224);
    let [a, b] = [a, b].map(|body| add(&mut world, body));
    world.add_joint(Joint::revolute(a, b).at([0.470_220_57, 0.566_257_24])).unwrap();
    world.add_joint(Joint::friction(a, b).max_force(0.27)).unwrap();
    let most = most_energy(&mut world, 300);
    assert!(most <= 1.0, "{most} times the energy");
}

/// Hinges and the like gain by themselves a part of the energy and lose it again, as the square of the angle by which their bodies turn in a substep:
/// 8 rad/s in 1/240 s are 0.033 rad, and its square is 1.1e-3.
#[test]
fn joined_bodies_thrown_by_chance_gain_no_energy_by_friction() {
    for seed in 0..300 {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut world = World::new(Settings::default());
        let mut thrown = |x: f64| {
            let plank = Body::dynamic(Shape::rectangle(1.0, 0.5)).at([x, 0.0]);
            let velocity = [rng.random_range(-10.0..10.0), rng.random_range(-10.0..10.0)];
            let plank = plank.mass(rng.random_range(0.1..3.0)).velocity(velocity);
            add(&mut world, plank.angular_velocity(rng.random_range(-8.0..8.0)))
        };
        let [a, b] = [thrown(-1.0), thrown(1.0)];
        let place = [rng.random_range(-0.5..0.5), rng.random_range(-2.0..2.0)];
        let joint = match seed % 4 {
            0 => Joint::revolute(a, b).at(place),
            1 => Joint::prismatic(a, b).at(place).axis([rng.random_range(-1.0..1.0), 1.0]).limits(-1.0..=1.0),
            2 => Joint::weld(a, b),
            _ => Joint::ratchet(a, b, rng.random_range(0.1..1.0)).at(place),
        };
        world.add_joint(joint).unwrap();
        let force = 10.0_f64.powf(rng.random_range(-1.0..2.0)) as f32;
        world.add_joint(Joint::friction(a, b).max_force(force)).unwrap();
        let most = most_energy(&mut world, 300);
        assert!(most < 1.0011, "seed {seed}, {force} N: {most} times the energy");
    }
}

/// Friction of 1 N at the tip of a rod takes 1 J for each metre that the tip slides, whether the rod is free or on a hinge. The way is the sum of the
/// chords of steps, which are shorter than arcs by (ω dt)²/24, here 4 parts in 10,000.
#[test]
fn friction_at_the_tip_of_a_rod_takes_its_force_times_the_way() {
    for is_hinged in [false, true] {
        let mut world = World::new(Settings::default());
        let rod = Body::dynamic(Shape::rectangle(2.0, 0.1)).mass(1.0);
        let (velocity, spin) = if is_hinged { ([0.0, 0.0], 6.0) } else { ([3.0, 3.0], 2.0) };
        let rod = add(&mut world, rod.velocity(velocity).angular_velocity(spin));
        if is_hinged {
            world.add_joint(Joint::revolute(rod, None).at([0.0, 0.0])).unwrap();
        }
        world.add_joint(Joint::friction(rod, None).max_force(1.0).at([1.0, 0.0])).unwrap();
        let tip = |world: &World| {
            let rod = world.body(rod).unwrap();
            rod.position() + rod.rotation().rotate(Vec2::new(1.0, 0.0))
        };
        let (start, mut way, mut at) = (world.kinetic_energy(), 0.0, tip(&world));
        for _ in 0..60 {
            world.step();
            let next = tip(&world);
            way += f64::from((next - at).length());
            at = next;
        }
        let lost = start - world.kinetic_energy();
        assert!((lost / way - 1.0).abs() < 5e-4, "hinged {is_hinged}: {lost} J over {way} m");
    }
}
