//! Contacts of joined bodies: what a blow does passes on through the joints.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

use crate::support::{add, add_floor, assert_relative, earth, place, run, space, spin, velocity};

/// Angular momentum of a body about the origin, kg m²/s: m r × v + I ω.
fn angular_momentum(world: &World, id: BodyId) -> f64 {
    let ([x, y], [u, v]) = (place(world, id), velocity(world, id));
    let body = world.body(id).unwrap();
    f64::from(body.mass()) * (x * v - y * u) + f64::from(body.inertia()) * spin(world, id)
}

/// The pin has no moment about itself. What is left is rounding of `f32` states over some twenty substeps, 1e-6 each at most.
#[test]
fn a_blow_on_a_hinged_rod_keeps_the_angular_momentum_about_its_pin() {
    for restitution in [0.0_f32, 0.5, 1.0] {
        let mut world = space();
        let rod = Body::dynamic(Shape::obb(0.1, 1.0)).at([0.0, -0.5]).mass(2.0).friction(0.0);
        let rod = add(&mut world, rod.restitution(restitution));
        let pin = world.add_joint(Joint::revolute(rod, None).at([0.0, 0.0])).unwrap();
        let ball = Body::dynamic(Shape::circle(0.1)).at([-1.0, -0.9]).velocity([10.0, 0.0]).mass(1.0);
        let ball = add(&mut world, ball.friction(0.0).restitution(restitution));
        let before = angular_momentum(&world, ball);
        for _ in 0..30 {
            world.step();
            let gap = world.joint(pin).unwrap().error().distance;
            assert!(gap < 1e-6, "the pin parts by {gap} m");
        }
        let after = angular_momentum(&world, ball) + angular_momentum(&world, rod);
        assert!(spin(&world, rod) > 1.0, "the rod was hit");
        assert_relative(after, before, 1e-4, "angular momentum about the pin");
    }
}

/// Twelve links fall flat, and on end, from 2 m: no pin parts by a millimetre, and the chain comes to lie on the floor.
#[test]
fn a_chain_that_falls_on_a_floor_does_not_part() {
    for angle in [0.0_f64, 1.2] {
        let mut world = earth();
        add_floor(&mut world, 0.5);
        let along = [angle.cos(), angle.sin()];
        let at = |way: f64| [way * along[0], 2.0 + way * along[1]];
        let (mut before, mut joints) = (None, Vec::new());
        for link in 0..12_u8 {
            let left = 0.5 * f64::from(link);
            let body = Body::dynamic(Shape::obb(0.5, 0.15)).at(at(left + 0.25)).angle(angle as f32).mass(1.0);
            let body = add(&mut world, body.restitution(0.0));
            if let Some(before) = before {
                joints.push(world.add_joint(Joint::revolute(before, body).at(at(left))).unwrap());
            }
            before = Some(body);
        }
        let start = world.energy();
        for tick in 0..300 {
            world.step();
            for &joint in &joints {
                let gap = world.joint(joint).unwrap().error().distance;
                assert!(gap < 1e-3, "{angle} rad, tick {tick}: a pin parts by {gap} m");
            }
            let gained = world.energy() - start;
            assert!(gained < 1e-3 * start.abs(), "{angle} rad, tick {tick}: {gained} J gained");
        }
        assert!(world.error().penetration < 0.01, "{} m deep", world.error().penetration);
    }
}

/// A box of ten times its mass lies on the middle of a plank that two pins hold: each bears half of the weight of both.
#[test]
fn pins_bear_what_lies_on_a_plank() {
    let mut world = earth();
    let plank = add(&mut world, Body::dynamic(Shape::obb(2.0, 0.2)).at([0.0, 0.0]).mass(1.0));
    let ends = [-1.0, 1.0].map(|x| world.add_joint(Joint::revolute(plank, None).at([x, 0.0])).unwrap());
    let load = Body::dynamic(Shape::obb(0.5, 0.5)).at([0.0, 0.35]).mass(10.0).restitution(0.0);
    add(&mut world, load);
    run(&mut world, 2.0);
    for end in ends {
        let force = f64::from(world.joint(end).unwrap().force().y.abs());
        assert_relative(force, 0.5 * 11.0 * crate::support::G, 1e-3, "force in a pin");
    }
}

/// A hanging chain of eight links of 1 kg, hit by a ball at each link: a strike comes within a substep, and its pins hold when that is over,
/// but for the rounding of places in `f32`, 1e-7 of the metres of a substep's way. (At 0.1 kg and 100 m/s a link turns by so much of a
/// radian in a substep that a pin parts by 3 mm for a moment.)
#[test]
fn a_chain_that_is_hit_does_not_part() {
    for (mass, speed) in [(1.0, 10.0), (0.1, 30.0), (0.01, 300.0)] {
        for (restitution, link) in [(0.0, 1), (0.0, 6), (0.5, 1), (0.5, 6)] {
            for place in [-0.15, 0.0, 0.1] {
                let mut world = earth();
                let (mut before, mut pins) = (None, Vec::new());
                for number in 0..8_u8 {
                    let top = -0.4 * f64::from(number);
                    let body = Body::dynamic(Shape::obb(0.2, 0.4)).at([0.0, top - 0.2]).mass(1.0);
                    let body = add(&mut world, body.restitution(restitution));
                    let pin = Joint::revolute(body, before).at([0.0, top]);
                    pins.push(world.add_joint(pin).unwrap());
                    before = Some(body);
                }
                let from = [-1.0, -0.4 * f64::from(link) - 0.2 + place];
                let ball = Body::dynamic(Shape::circle(0.05)).at(from).velocity([speed, 0.0]).mass(mass);
                add(&mut world, ball.restitution(restitution));
                for tick in 0..120 {
                    world.step();
                    let gaps = pins.iter().map(|&pin| world.joint(pin).unwrap().error().distance);
                    let gap = gaps.fold(0.0, f32::max);
                    let of = format!(
                        "{mass} kg at {speed} m/s, restitution {restitution}, link {link}, {place} m"
                    );
                    assert!(gap < 1e-5, "{of}, tick {tick}: a pin parts by {gap} m");
                }
            }
        }
    }
}

/// A ball on a chain of ten links, which it whips into a wall of crates: links swing by more than a radian in a substep, and touch. What
/// contacts bear is a load for the steps of the chain, not a blow, and its pins hold to a hundredth of a link's width; in one world of five
/// they parted by centimetres.
#[test]
fn a_wrecking_ball_stays_on_its_chain() {
    for seed in 0..16 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut world = earth();
        add(&mut world, Body::fixed(Shape::aabb(60.0, 1.0)).at([0.0, -0.5]));
        let (link, ratio) = (random.random_range(0.5..10.0_f32), random.random_range(10.0..1000.0_f32));
        let tilt = random.random_range(-0.5..0.7_f64);
        let (sin, cos) = tilt.sin_cos();
        let at = |along: f64| [-cos * along, 8.0 + sin * along];
        let (mut before, mut pins) = (None, Vec::new());
        for number in 0..10_u8 {
            let start = 0.6 * f64::from(number);
            let body = Body::dynamic(Shape::obb(0.55, 0.12)).at(at(start + 0.3)).angle(-tilt as f32);
            let body = add(&mut world, body.mass(link));
            pins.push(world.add_joint(Joint::revolute(body, before).at(at(start))).unwrap());
            before = Some(body);
        }
        let ball = add(&mut world, Body::dynamic(Shape::circle(0.5)).at(at(6.55)).mass(link * ratio));
        pins.push(world.add_joint(Joint::revolute(ball, before).at(at(6.0))).unwrap());
        let crate_mass = random.random_range(1.0..100.0_f32);
        for (column, row) in (0..2_u8).flat_map(|column| (0..6_u8).map(move |row| (column, row))) {
            let at = [1.2 + 0.62 * f64::from(column), 0.3 + 0.6 * f64::from(row)];
            add(&mut world, Body::dynamic(Shape::obb(0.6, 0.6)).at(at).mass(crate_mass));
        }
        for tick in 0..300 {
            world.step();
            let gaps = pins.iter().map(|&pin| world.joint(pin).unwrap().error().distance);
            let gap = gaps.fold(0.0, f32::max);
            assert!(gap < 1e-3, "seed {seed}, tick {tick}: a pin parts by {gap} m");
        }
    }
}
