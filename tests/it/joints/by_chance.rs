//! Worlds by chance, with joints of every kind: nothing breaks, whatever joins what.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

type Random = Xoshiro256PlusPlus;

/// From 10^`low` to 10^`high`.
fn power(random: &mut Random, low: f32, high: f32) -> f32 {
    10.0_f64.powf(f64::from(random.random_range(low..high))) as f32
}

fn body(random: &mut Random) -> Body {
    let size = power(random, -1.0, 0.3);
    let shape = match random.random_range(0..3) {
        0 => Shape::circle(size),
        1 => Shape::obb(size, power(random, -1.0, 0.3)),
        _ => Shape::aabb(size, size),
    };
    let body = match random.random_range(0..8) {
        0 => Body::fixed(shape),
        1 => Body::kinematic(shape).velocity([random.random_range(-2.0..2.0), 0.0]),
        _ => Body::dynamic(shape).mass(power(random, -3.0, 3.0)),
    };
    body.at([random.random_range(-4.0..4.0), random.random_range(0.0..6.0)])
        .angle(if matches!(shape, Shape::Aabb(_)) { 0.0 } else { random.random_range(-3.0..3.0) })
}

fn joint(random: &mut Random, bodies: &[BodyId]) -> Joint {
    let mut any = || bodies[random.random_range(0..bodies.len())];
    let (a, other) = (any(), any());
    let b = Some(other).filter(|_| random.random_bool(0.8));
    let ratio = random.random_range(-3.0..3.0);
    let joint = match random.random_range(0..12) {
        0 => Joint::revolute(a, b).limits(-1.0..=random.random_range(-1.0..2.0)),
        1 => Joint::revolute(a, b).motor(random.random_range(-50.0..50.0), power(random, -2.0, 5.0)),
        2 => Joint::prismatic(a, b).axis([1.0, 0.5]).limits(-0.5..=0.5),
        3 => Joint::distance(a, b).length(power(random, -2.0, 1.0)),
        4 => Joint::distance(a, b).spring(power(random, -1.0, 2.5), random.random_range(0.0..2.0)),
        5 => Joint::rope(a, b).max_length(power(random, -1.0, 1.0)),
        6 => Joint::weld(a, b).break_at(power(random, 1.0, 5.0), f32::INFINITY),
        7 => Joint::wheel(a, b).axis([0.0, 1.0]).suspension(4.0, 0.7).travel(-0.2..=0.2).motor(10.0, 50.0),
        8 => Joint::friction(a, b).max_force(10.0).max_torque(1.0),
        9 => Joint::gear(a, other, ratio),
        10 => {
            let mut wheel = || [random.random_range(-4.0..4.0), random.random_range(0.0..8.0)];
            let pulley = Joint::pulley(a, other, wheel(), wheel()).ratio(f64::from(power(random, -1.0, 1.0)));
            if random.random_bool(0.5) { pulley.length(power(random, -1.0, 1.5)) } else { pulley }
        }
        _ => Joint::drag(a, [random.random_range(-5.0..5.0), 3.0]).max_force(power(random, 0.0, 5.0)),
    };
    joint.collide_connected(random.random_bool(0.3))
}

fn play(seed: u64, lanes: Lanes) -> World {
    let mut random = Random::seed_from_u64(seed);
    let settings = Settings { lanes, substeps: [1, 4, 8][(seed % 3) as usize], ..Settings::default() };
    let mut world = World::new(settings);
    world.add_force(Force::EARTH_GRAVITY);
    let floor = Body::fixed(Shape::aabb(40.0, 1.0)).at([0.0, -0.5]);
    let mut bodies = vec![world.add(floor).expect("a floor")];
    for _ in 0..random.random_range(2..12) {
        bodies.push(world.add(body(&mut random)).expect("a body that a world takes"));
    }
    let mut joints = Vec::new();
    for tick in 0..120 {
        if tick % 10 == 0 {
            // What makes no sense, as a body joined to itself, is refused.
            joints.extend(world.add_joint(joint(&mut random, &bodies)).ok());
        }
        if tick % 40 == 39 {
            if let Some(removed) = joints.pop() {
                world.remove_joint(removed);
            }
            world.remove(bodies.swap_remove(random.random_range(0..bodies.len())));
        }
        world.step();
        world.validate().unwrap_or_else(|what| panic!("seed {seed}, tick {tick}: {what}"));
        for (id, body) in world.bodies() {
            let numbers = [body.velocity().x, body.velocity().y, body.angular_velocity(), body.angle()];
            assert!(
                numbers.iter().all(|x| x.is_finite()),
                "seed {seed}, tick {tick}: {id:?} has {numbers:?}"
            );
        }
        for (id, joint) in world.joints() {
            let numbers = [joint.force().x, joint.force().y, joint.torque(), joint.error().distance];
            assert!(
                numbers.iter().all(|x| x.is_finite()),
                "seed {seed}, tick {tick}: {id:?} has {numbers:?}"
            );
        }
    }
    world
}

#[test]
fn no_world_of_joints_by_chance_breaks_and_lanes_and_clones_come_to_the_same() {
    for seed in 0..60 {
        let mut world = play(seed, Lanes::Auto);
        assert_eq!(world.state_hash(), play(seed, Lanes::One).state_hash(), "seed {seed}: one lane");
        let mut other = World::new(Settings::default());
        other.clone_from(&world);
        for _ in 0..30 {
            world.step();
            other.step();
        }
        assert_eq!(world.state_hash(), other.state_hash(), "seed {seed}: the clone");
    }
}
