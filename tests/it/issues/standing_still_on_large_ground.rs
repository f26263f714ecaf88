//! Far from the middle of a large ground distances round to millimetres: a stone was found to meet the ground and not to approach it,
//! without end, until no time was left to sweep anything, and all stood still in the air while gravity gave them 90 m/s.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

use crate::support::{add, earth};

/// Sixty stones of 1 cm fall by 10 cm, which takes 0.2 s; after 5 s none moves.
#[test]
fn stones_of_a_centimetre_come_to_rest_four_kilometres_from_the_middle_of_their_ground() {
    for seed in 0..6 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut world = earth();
        add(&mut world, Body::fixed(Shape::aabb(10_000.0, 100.0)).at([0.0, -50.0]));
        let stone = |number: u32| {
            let (column, row) = (f64::from(number % 6), f64::from(number / 6));
            let at = [4000.0 + 0.012 * (column - 2.5 + 0.1 * (row % 2.0)), 0.0075 + 0.012 * row];
            let shape = match random.random_range(0..3) {
                0 => Shape::obb(0.007, 0.007),
                1 => Shape::obb(0.009, 0.005),
                _ => Shape::polygon([[-0.005, -0.002], [0.004, -0.004], [0.002, 0.005]]).unwrap(),
            };
            add(&mut world, Body::dynamic(shape).at(at).angle(random.random_range(0.0..6.0)))
        };
        let stones: Vec<BodyId> = (0..60).map(stone).collect();
        (0..300).for_each(|_| world.step());
        for stone in stones {
            let speed = world.body(stone).unwrap().velocity().length();
            assert!(speed < 0.01, "seed {seed}: {speed} m/s");
        }
    }
}
