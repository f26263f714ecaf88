//! Nothing passes through anything, of whatever it is made.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

use crate::support::{add, space};

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
