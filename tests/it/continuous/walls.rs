//! Thin walls, and what is thrown at them: straight or spinning, alone or struck from behind.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

use crate::support::{add, place};

/// Random worlds of each kind.
const TRIALS: u64 = 10;
/// Thickness of a wall, and of a needle, m.
const THIN: f32 = 0.01;
/// Tick rate, Hz, and substeps.
const RATES: [(f32, u32); 4] = [(30.0, 1), (60.0, 1), (60.0, 4), (240.0, 4)];
/// m/s.
const SPEEDS: [f32; 6] = [5.0, 20.0, 60.0, 150.0, 400.0, 1_000.0];

#[derive(Clone, Copy, Debug)]
enum Wall {
    /// Fixed, of one piece.
    Whole,
    /// Fixed tiles of half a metre.
    Tiles,
    /// Free, of 40 t.
    Free,
    /// Fixed; what is before it at rest is struck from behind by a heavy disc.
    BehindOneAtRest,
}

/// What is thrown: its shape, its greatest spin, rad/s, and the least of its coefficients of restitution.
#[derive(Clone, Debug)]
struct Thrown {
    shape: Shape,
    spin: f32,
    restitution: f32,
}

impl Thrown {
    fn disc() -> Self {
        Self { shape: Shape::circle(0.05), spin: 0.0, restitution: 0.0 }
    }

    fn square(spin: f32) -> Self {
        Self { shape: Shape::rectangle(0.1, 0.1), spin, restitution: 0.0 }
    }

    fn needle(spin: f32) -> Self {
        Self { shape: Shape::rectangle(2.0, THIN), spin, restitution: 0.0 }
    }
}

/// Whether something that is thrown with a speed, m/s, comes to the other side of a wall along the y axis within a second.
fn passes(seed: u64, wall: Wall, thrown: &Thrown, settings: Settings, speed: f32) -> bool {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let ticks = settings.tick_rate as usize;
    let before = 1.1 + rng.random_range(0.0..f64::from(speed / settings.tick_rate).max(0.1));
    let restitution = [thrown.restitution, 0.2, 0.5, 1.0][(seed % 4) as usize];
    let mut world = World::new(settings);
    let whole = Shape::rectangle(THIN, 40.0);
    let mut free = None;
    match wall {
        Wall::Whole | Wall::BehindOneAtRest => _ = add(&mut world, Body::fixed(whole)),
        Wall::Free => free = Some(add(&mut world, Body::dynamic(whole).density(1e5))),
        Wall::Tiles => {
            for index in -40..40 {
                let tile = Body::fixed(Shape::rectangle(THIN, 0.5));
                add(&mut world, tile.at([0.0, 0.25 + 0.5 * f64::from(index)]));
            }
        }
    }
    let spin = thrown.spin * rng.random_range(-1.0..1.0);
    let body = Body::dynamic(thrown.shape).angle(rng.random_range(-3.0..3.0)).angular_velocity(spin);
    let body = body.restitution(restitution);
    let id = if let Wall::BehindOneAtRest = wall {
        let heavy = Body::dynamic(Shape::circle(0.2)).density(20.0).restitution(restitution);
        let at = [-before - 1.6, rng.random_range(-0.2..0.2)];
        add(&mut world, heavy.at(at).velocity([speed, 0.0]));
        add(&mut world, body.at([-1.2, 0.0]))
    } else {
        let along = rng.random_range(-0.5..0.5) * speed;
        add(&mut world, body.at([-before, 0.0]).velocity([speed, along]))
    };
    (0..ticks).any(|_| {
        world.step();
        let [x, y] = place(&world, id);
        let wall_at_y = free.map_or(0.0, |free| {
            let [wall_x, wall_y] = place(&world, free);
            wall_x - (y - wall_y) * f64::from(world.body(free).expect("the wall is there").angle()).tan()
        });
        x > wall_at_y && y.abs() < 18.0
    })
}

/// How many pass in all trials, at all rates and speeds.
fn all_passes(wall: Wall, thrown: &Thrown, continuous: bool) -> usize {
    let settings = |(tick_rate, substeps)| Settings {
        tick_rate,
        substeps,
        continuous,
        sleep: false,
        ..Settings::default()
    };
    RATES
        .into_iter()
        .flat_map(|rate| SPEEDS.map(|speed| (rate, speed)))
        .flat_map(|of| (0..TRIALS).map(move |seed| (of, seed)))
        .filter(|&((rate, speed), seed)| passes(seed, wall, thrown, settings(rate), speed))
        .count()
}

#[test]
fn nothing_that_is_thrown_passes_a_wall_of_a_centimetre() {
    let all = [
        Thrown::disc(),
        Thrown::square(0.0),
        Thrown::square(200.0),
        Thrown::needle(0.0),
        Thrown::needle(100.0),
    ];
    for thrown in &all {
        for wall in [Wall::Whole, Wall::Tiles, Wall::Free] {
            assert_eq!(all_passes(wall, thrown, true), 0, "{thrown:?}, {wall:?}");
        }
    }
}

#[test]
fn what_is_struck_before_a_wall_of_a_centimetre_does_not_pass_it() {
    for thrown in [Thrown::disc(), Thrown::square(0.0), Thrown::square(200.0)] {
        assert_eq!(all_passes(Wall::BehindOneAtRest, &thrown, true), 0, "{thrown:?}");
    }
}

/// Known to pass now and then: needles that are struck, in less than one of a hundred; more of those without restitution, which
/// are left to the sweeps.
#[test]
fn needles_that_are_struck_hardly_ever_pass() {
    for spin in [0.0, 100.0] {
        let needle = Thrown { restitution: 0.1, ..Thrown::needle(spin) };
        let passed = all_passes(Wall::BehindOneAtRest, &needle, true);
        let trials = RATES.len() * SPEEDS.len() * TRIALS as usize;
        assert!(100 * passed < trials, "{passed} of {trials} at {spin} rad/s");
    }
}

/// Without continuous collision most of what is struck passes, so that the tests above can fail.
#[test]
fn without_continuous_collision_things_pass() {
    assert!(all_passes(Wall::BehindOneAtRest, &Thrown::disc(), false) > 50);
    assert!(all_passes(Wall::Whole, &Thrown::needle(100.0), false) > 0);
}

/// Needles by chance, of 5 mm to 50 cm and to a thirtieth as thin, at a line, which has no thickness at all: the first corner stops at
/// it, and the rest is yet to come.
#[test]
fn no_needle_passes_a_line() {
    for seed in 0..600 {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
        let settings = Settings {
            tick_rate: [20.0, 60.0, 240.0][rng.random_range(0..3)],
            substeps: [1, 4, 8][rng.random_range(0..3)],
            ..Settings::default()
        };
        let mut world = World::new(settings);
        add(&mut world, Body::fixed(Shape::segment([0.0, -50.0], [0.0, 50.0])));
        let length = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5][rng.random_range(0..7)];
        let width = length / [5.0, 10.0, 30.0][rng.random_range(0..3)];
        let half = 0.5 * length;
        let shape = if rng.random_bool(0.5) {
            Shape::obb(length, width)
        } else {
            Shape::capsule([-half, 0.0], [half, 0.0], 0.5 * width)
        };
        let speed = [3.0, 10.0, 30.0, 100.0, 300.0, 1_000.0, 3_000.0][rng.random_range(0..7)]
            * rng.random_range(0.5..1.0);
        let needle = Body::dynamic(shape).velocity([speed, 0.0]).angle(rng.random_range(-3.1..3.1));
        let needle = needle.at([f64::from(-length) - rng.random_range(0.0..2.0), 0.0]);
        let needle = add(&mut world, needle.restitution([0.0, 0.5][rng.random_range(0..2)]));
        for tick in 0..60 {
            world.step();
            let [x, y] = place(&world, needle);
            assert!(x <= 0.0 || y.abs() > 49.0, "seed {seed}: {length} m at {speed} m/s, tick {tick}");
        }
    }
}
