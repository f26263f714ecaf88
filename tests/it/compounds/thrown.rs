//! Nothing passes through anything, of whatever it is made.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

use crate::support::{add, earth, place, space};

/// A dumbbell, a hook or a cross, about 1 m large.
fn thing(number: u32) -> Body {
    let bar = || Shape::rectangle(1.0, 0.1);
    let ball = |x: f32| Collider::new(Shape::circle(0.15)).at([x, 0.0]);
    match number % 3 {
        0 => Body::dynamic(bar()).with(ball(-0.5)).with(ball(0.5)),
        1 => Body::dynamic(bar()).with(Collider::new(Shape::rectangle(0.1, 0.6)).at([0.45, 0.3])),
        _ => Body::dynamic(bar()).with(Collider::new(bar()).angle(1.2)),
    }
}

/// Thrown at a wall of 1 cm, of one piece or of tiles that are one body, at up to 1 km/s, spinning.
#[test]
fn no_thrown_compound_passes_a_thin_wall() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(11);
    let mut passed = Vec::new();
    for trial in 0..600_u32 {
        let speed = [10.0_f32, 50.0, 200.0, 1000.0][trial as usize % 4];
        let mut world = space();
        let tile = |number: i16| Collider::new(Shape::aabb(0.01, 1.0)).at([0.0, f32::from(number)]);
        let tiles = (-6..=6).filter(|&number| number != 0);
        let wall = Body::fixed(Shape::aabb(0.01, 1.0));
        let wall = if trial % 2 == 0 {
            tiles.fold(wall, |wall, number| wall.with(tile(number)))
        } else {
            Body::fixed(Shape::aabb(0.01, 13.0))
        };
        add(&mut world, wall.restitution(0.0));
        let at = [
            -1.5 - f64::from(random.random_range(0.0_f32..1.0)),
            f64::from(random.random_range(-1.0_f32..1.0)),
        ];
        let spin = random.random_range(-100.0_f32..100.0);
        let restitution = [0.0, 0.5, 1.0][trial as usize / 4 % 3];
        let body = thing(trial / 12).at(at).angle(random.random_range(-3.0..3.0)).velocity([speed, 0.0]);
        let id = add(&mut world, body.angular_velocity(spin).restitution(restitution));
        let ticks = (4.0 * 60.0 / speed).ceil() as u32 + 3;
        let has_passed = (0..ticks).any(|_| {
            world.step();
            world.body(id).unwrap().position().x > 0.0
        });
        if has_passed {
            passed.push((trial, speed));
        }
    }
    assert!(passed.is_empty(), "{} of 600 passed: {passed:?}", passed.len());
}

/// An L of two bars that falls on a chain, or on a line: of bars that cross, whose corner is stopped within a tick, and whose middle rises as it
/// turns about it; it has been before the chain when the tick began. And of bars that lie side by side, whose outer side is one of two
/// faces: the second comes down on a line whose middle is far away, behind the plane of that face.
#[test]
fn an_l_that_falls_on_a_line_lies_on_it() {
    for seed in 0..800 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut world = earth();
        let (is_chain, do_cross) = (seed % 2 == 0, seed % 4 < 2);
        let points = (0..=60_u8).map(|number| [f32::from(number) - 30.0, 0.0]);
        let ground = if is_chain {
            Ground::chain(points).unwrap()
        } else {
            Body::fixed(Shape::segment([-30.0, 0.0], [30.0, 0.0]))
        };
        add(&mut world, ground.restitution(0.0));
        let size = [0.05, 0.1, 0.2, 0.5, 1.0][random.random_range(0..5)];
        let speed = [1.0, 3.0, 10.0, 30.0, 100.0, 300.0][random.random_range(0..6)];
        let [length, x, y] =
            if do_cross { [1.0, 0.5, 0.4] } else { [0.8, 0.4, 0.5] }.map(|share| share * size);
        let bar = Collider::new(Shape::obb(0.2 * size, length)).at([x, y]);
        let body = Body::dynamic(Shape::obb(size, 0.2 * size)).with(bar).restitution(0.0);
        let body =
            body.angle(random.random_range(-3.1..3.1)).angular_velocity(random.random_range(-30.0..30.0));
        let body = body.velocity([speed * random.random_range(-0.7..0.7), -speed]);
        let id = add(&mut world, body.at([0.0, f64::from(size) * random.random_range(1.0..1.6) + 0.3]));
        for tick in 0..120 {
            world.step();
            let [x, y] = place(&world, id);
            assert!(
                y > f64::from(-size) || x.abs() > 29.0,
                "seed {seed}, tick {tick}: {size} m at {speed} m/s"
            );
        }
    }
}

/// A U whose legs lie flush at the ends of its bar, thrown at the thin floor of a room: a leg that comes down with its side nearly flat has its
/// near end covered, and is a corner to the floor by its far end alone. One in three thousand fell through.
#[test]
fn a_u_does_not_pass_the_thin_floor_of_a_room() {
    let mut passed = Vec::new();
    for seed in 0..6_000 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut world = space();
        for (at, width, height) in [
            ([0.0, -0.005], 30.02, 0.01),
            ([0.0, 20.005], 30.02, 0.01),
            ([-15.005, 10.0], 0.01, 20.02),
            ([15.005, 10.0], 0.01, 20.02),
        ] {
            add(&mut world, Body::fixed(Shape::aabb(width, height)).at(at).restitution(0.0));
        }
        let (size, share) = (random.random_range(0.5..2.0_f32), random.random_range(0.05..0.3_f32));
        let width = share * size;
        let leg = |side: f32| {
            Collider::new(Shape::obb(width, size)).at([side * 0.5 * (size - width), 0.5 * (size + width)])
        };
        let body = Body::dynamic(Shape::obb(size, width)).with(leg(-1.0)).with(leg(1.0)).restitution(0.0);
        let speed = random.random_range(5.0..30.0_f32);
        let body = body.velocity([speed * random.random_range(-1.0..1.0), -speed]);
        let body =
            body.angle(random.random_range(-3.1..3.1)).angular_velocity(random.random_range(-30.0..30.0));
        let id = add(&mut world, body.at([random.random_range(-5.0..5.0), 4.0]));
        let has_passed = (0..60).any(|_| {
            world.step();
            let [x, y] = place(&world, id);
            x.abs() < 14.0 && y < 0.0
        });
        if has_passed {
            passed.push(seed);
        }
    }
    assert!(passed.is_empty(), "{} of 6,000 passed: {passed:?}", passed.len());
}
