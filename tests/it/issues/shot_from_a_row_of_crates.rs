//! Crates that a blade pushed over the ground jammed: each normal bore what friction added to the other, so that both grew to 10,000 times the
//! weight of all. When the jam opened, one of them left at up to 558 m/s.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

use crate::support::{add, earth};

/// How fast the blade goes, m/s.
const BLADE: f32 = 3.0;

/// Of the crates, no unit.
const RESTITUTION: f32 = 0.05;

/// The greatest speed of so many crates of random sizes and masses in ten seconds, m/s.
fn fastest_crate(crates: u8, friction: f32, seed: u64) -> f32 {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut world = earth();
    add(&mut world, Body::fixed(Shape::aabb(400.0, 2.0)).at([0.0, -1.0]).friction(0.7));
    let blade = Body::kinematic(Shape::rectangle(2.0, 2.0)).at([-2.5, 1.1]);
    add(&mut world, blade.velocity([BLADE, 0.0]));
    let crates: Vec<_> = (0..crates)
        .map(|place| {
            let side = random.random_range(0.5_f32..1.0);
            let body = Body::dynamic(Shape::rectangle(side, side)).at([1.1 * f32::from(place), 0.5 * side]);
            add(
                &mut world,
                body.mass(random.random_range(10.0_f32..40.0)).friction(friction).restitution(0.05),
            )
        })
        .collect();
    let mut fastest = 0.0_f32;
    for _ in 0..600 {
        world.step();
        for &id in &crates {
            fastest = fastest.max(world.body(id).unwrap().velocity().length());
        }
    }
    fastest
}

/// The blade strikes a crate to (1 + e) times its speed, e being the mean of both restitutions, and no crate another to more than its own speed, as e is
/// 0.05 there and one has four times the mass of the other at most. A crate that is lifted onto another falls by 1 m at most, which adds
/// 2 g h to the square of its speed.
#[test]
fn crates_before_a_blade_go_no_faster_than_blows_and_falls_make_them() {
    let restitution = 0.5 * (Material::DEFAULT.restitution + RESTITUTION);
    let most = ((1.0 + restitution) * BLADE).hypot((2.0 * 9.81_f32).sqrt());
    for friction in [0.5, 0.9] {
        for seed in 0..12 {
            let fastest = fastest_crate(24, friction, seed);
            assert!(fastest < most, "{fastest} m/s for {most}, friction {friction}, seed {seed}");
        }
    }
}
