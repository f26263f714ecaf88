//! A body that was stopped in the middle of a substep, as there was no time left to sweep it on, got its speed from gravity all the same:
//! what was stopped in substep after substep came to fall at 200 m/s without falling.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

use crate::support::{add, earth};

/// Some crates of a tonne fall from 15 m on loose boxes of 0.1 kg in a closed box. Contacts take energy; overlaps are pushed apart, of which
/// a thousandth is allowed for.
#[test]
fn crates_that_drive_light_boxes_about_gain_no_energy() {
    // The first four gained.
    for seed in [20, 28, 29, 54].into_iter().chain(100..108) {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut world = earth();
        for (x, y, width, height) in
            [(0.0, -2.0, 20.0, 4.0), (0.0, 22.0, 20.0, 4.0), (-8.0, 10.0, 4.0, 20.0), (8.0, 10.0, 4.0, 20.0)]
        {
            add(&mut world, Body::fixed(Shape::aabb(width, height)).at([x, y]));
        }
        for number in 0..random.random_range(40..200) {
            let at = [-5.6 + 0.72 * (number % 16) as f32, 0.4 + 0.72 * (number / 16) as f32];
            let width = random.random_range(0.25..0.5);
            let shape = Shape::obb(width, width * random.random_range(0.6..1.0));
            add(&mut world, Body::dynamic(shape).at(at).angle(random.random_range(0.0..3.0)).mass(0.1));
        }
        for number in 0..random.random_range(1..=4) {
            let at = [-4.0 + 2.5 * number as f32, random.random_range(13.0..17.0)];
            let width = random.random_range(0.8..1.6);
            let crate_of_a_tonne = Body::dynamic(Shape::obb(width, width)).at(at).mass(1000.0);
            let angle = random.random_range(0.0..1.5);
            add(&mut world, crate_of_a_tonne.angle(angle).velocity([random.random_range(-3.0..3.0), 0.0]));
        }
        let most = 1.001 * world.energy();
        for tick in 0..240 {
            world.step();
            assert!(world.energy() <= most, "seed {seed}, tick {tick}: {} of {most} J", world.energy());
        }
    }
}
