//! Contacts are solved one, four, eight or sixteen at a time, and every bit is the same.
//!
//! The golden hashes hold for every width too: each machine checks the widest it has. Random use of the API at
//! every width is in `random_use`.

use rustycs::prelude::*;

use crate::support::{add, add_floor, earth_with, unit_box};

const WIDTHS: [Lanes; 4] = [Lanes::One, Lanes::Four, Lanes::Eight, Lanes::Sixteen];

/// Builds a world for each width, steps them side by side, and compares state and error after each tick. Gives
/// back one of them.
#[track_caller]
fn step_at_every_width(
    what: &str,
    settings: &Settings,
    ticks: usize,
    build: impl Fn(Settings) -> World,
    before_tick: impl Fn(&mut World),
) -> World {
    let mut worlds = WIDTHS.map(|lanes| build(Settings { lanes, ..settings.clone() }));
    for tick in 0..ticks {
        let [one, others @ ..] = worlds.each_mut().map(|world| {
            before_tick(world);
            world.step();
            let StepError { penetration, velocity_residual, .. } = world.error();
            (world.state_hash(), penetration.to_bits(), velocity_residual.to_bits())
        });
        for (lanes, other) in WIDTHS[1..].iter().zip(others) {
            assert_eq!(other, one, "{what}, {lanes:?} at a time, tick {tick}");
        }
    }
    let [world, ..] = worlds;
    world
}

#[test]
fn every_scene_steps_alike_at_every_width() {
    for scene in rustycs_scenes::all() {
        let build = |settings| scene.build(2, settings);
        let before_tick = |world: &mut World| scene.before_tick(world);
        step_at_every_width(scene.name, &Settings::default(), 90, build, before_tick);
    }
}

/// Other sweeps than those of the default: friction in the first one, one point at a time, no warm start, more than
/// one sweep, positions projected.
#[test]
fn every_scheme_steps_alike_at_every_width() {
    let default = Settings::default();
    let schemes = [
        ("classic", Settings::classic()),
        ("one point at a time", Settings { block_solve: false, ..default.clone() }),
        ("cold", Settings { warm_starting: false, ..default.clone() }),
        ("many sweeps", Settings { iterations: 3, relax_iterations: 2, ..default.clone() }),
        ("one kick", Settings { split_kick: false, relax_iterations: 0, ..default.clone() }),
        ("adaptive", Settings { adaptive: true, ..default }),
    ];
    for (name, settings) in schemes {
        let build = |settings| rustycs_scenes::pile::build_with(150, 4, settings);
        step_at_every_width(name, &settings, 200, build, |_| ());
    }
}

/// One plank carries more boxes than there are colours: those that overflow are solved one by one at every width.
#[test]
fn contacts_that_overflow_the_colours_are_solved_alike_at_every_width() {
    let build = |settings| {
        let mut world = earth_with(settings);
        add_floor(&mut world, 0.6);
        add(&mut world, Body::dynamic(Shape::obb(80.0, 0.5)).at([0.0, 0.5]).friction(0.5).density(3.0));
        for i in 0..60 {
            add(&mut world, unit_box(1.2 * f64::from(i) - 35.4, 1.4 + 0.01 * f64::from(i % 7)));
        }
        world
    };
    let world = step_at_every_width("plank", &Settings::default(), 200, build, |_| ());
    let overflow = world.profile().counters().overflow;
    assert!(overflow > 20, "only {overflow} contacts overflow: a test of nothing");
}

/// A kinematic body is in many contacts of one colour, and none of them may write to it.
#[test]
fn a_kinematic_body_keeps_its_velocity_at_every_width() {
    let build = |settings| {
        let mut world = earth_with(settings);
        let belt = Body::kinematic(Shape::obb(100.0, 1.0)).at([0.0, -0.5]).velocity([0.7, 0.0]);
        add(&mut world, belt.friction(0.9));
        for i in 0..50 {
            add(&mut world, unit_box(1.1 * f64::from(i) - 27.0, 0.52));
        }
        world
    };
    let world = step_at_every_width("belt", &Settings::default(), 120, build, |_| ());
    let (_, belt) = world.bodies().next().expect("the belt");
    assert_eq!(belt.velocity(), Vec2::new(0.7, 0.0));
    assert!(world.bodies().skip(1).all(|(_, body)| body.velocity().x > 0.6), "the boxes ride along");
}

/// The number of contacts in the last block of a colour is anything from one to sixteen.
#[test]
fn colours_of_every_size_are_solved_alike_at_every_width() {
    for count in 1..=33 {
        let build = |settings| {
            let mut world = earth_with(settings);
            add_floor(&mut world, 0.5);
            for i in 0..count {
                let shape = if i % 3 == 0 { Shape::circle(0.4) } else { Shape::obb(0.8, 0.6) };
                let at = [f64::from(i) - 16.0, 0.5 + 0.1 * f64::from(i % 4)];
                add(&mut world, Body::dynamic(shape).at(at).angle(0.1 * i as f32).restitution(0.3));
            }
            world
        };
        step_at_every_width(&format!("{count} bodies"), &Settings::default(), 60, build, |_| ());
    }
}
