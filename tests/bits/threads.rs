//! A step on several threads, and every bit is the same, whatever is divided and however.
//!
//! The golden hashes hold for every number of threads too, see `golden`; random use of the API is in `random_use`.
//! Without the feature `parallel` all of this holds as well, since there is one thread.

use rustycs::prelude::*;

const THREADS: [usize; 5] = [1, 2, 3, 4, 8];

/// All that a step leaves behind.
type Trace =
    (u64, [u32; 2], Vec<(BodyId, BodyId)>, Vec<(BodyId, BodyId)>, Vec<(BodyId, BodyId, u32)>, Counters);

fn trace(world: &World) -> Trace {
    let StepError { penetration, velocity_residual, .. } = world.error();
    let pairs = |events: &[ContactEvent]| events.iter().map(|event| (event.a, event.b)).collect();
    let hits = world.events().hits().iter().map(|hit| (hit.a, hit.b, hit.speed.to_bits()));
    (
        world.state_hash(),
        [penetration.to_bits(), velocity_residual.to_bits()],
        pairs(world.events().began()),
        pairs(world.events().ended()),
        hits.collect(),
        world.profile().counters(),
    )
}

/// Builds a world for each number of threads, and compares what they do tick by tick.
#[track_caller]
fn step_on_any_number_of_threads(
    what: &str,
    settings: &Settings,
    ticks: usize,
    build: impl Fn(Settings) -> World,
    before_tick: impl Fn(&mut World),
) {
    let mut worlds = THREADS.map(|threads| {
        let mut world = build(Settings { threads, ..settings.clone() });
        world.divide_all_work();
        world
    });
    for tick in 0..ticks {
        let [one, others @ ..] = worlds.each_mut().map(|world| {
            before_tick(world);
            world.step();
            trace(world)
        });
        for (other, threads) in others.iter().zip(&THREADS[1..]) {
            assert_eq!(other, &one, "{what}, {threads} threads, tick {tick}");
        }
    }
}

/// Events among it, in their order.
#[test]
fn every_scene_steps_alike_on_any_number_of_threads() {
    for scene in rustycs_scenes::all() {
        let build = |settings| scene.build(3, settings);
        let before_tick = |world: &mut World| scene.before_tick(world);
        step_on_any_number_of_threads(scene.name, &Settings::default(), 120, build, before_tick);
    }
}

#[test]
fn every_scheme_steps_alike_on_any_number_of_threads() {
    let default = Settings::default();
    for (name, settings) in [
        ("classic", Settings::classic()),
        ("one at a time", Settings { lanes: Lanes::One, ..default.clone() }),
        ("four at a time", Settings { lanes: Lanes::Four, ..default.clone() }),
        ("one kick", Settings { split_kick: false, relax_iterations: 0, ..default }),
    ] {
        let build = |settings| rustycs_scenes::pile::build_with(200, 4, settings);
        step_on_any_number_of_threads(name, &settings, 150, build, |_| ());
    }
}

/// Large enough to be divided unasked, as a user has it.
#[test]
fn a_large_pile_steps_alike_on_two_threads() {
    let mut worlds = [1, 2].map(|threads| {
        rustycs_scenes::pile::build_with(3000, 1, Settings { threads, ..Settings::default() })
    });
    for tick in 0..150 {
        let [one, two] = worlds.each_mut().map(|world| {
            world.step();
            trace(world)
        });
        assert_eq!(two, one, "tick {tick}");
    }
}

/// The threads are those of one world: a clone has its own, and so does a world that changes their number.
#[test]
fn clones_and_changes_of_the_number_of_threads_change_nothing() {
    let scene = rustycs_scenes::find("pile").expect("a scene");
    let mut one = scene.build(5, Settings::default());
    let mut many = one.clone();
    many.divide_all_work();
    for (tick, threads) in (0..120).zip([2, 2, 4, 1, 3].into_iter().cycle()) {
        for (world, threads) in [(&mut one, 1), (&mut many, threads)] {
            world.set_settings(Settings { threads, ..world.settings().clone() }).expect("good settings");
            world.step();
        }
        assert_eq!(trace(&many), trace(&one), "tick {tick}, {threads} threads");
        if tick % 40 == 39 {
            many = many.clone();
        }
    }
    let there = std::thread::spawn(move || {
        many.step();
        many.state_hash()
    });
    one.step();
    assert_eq!(there.join().expect("it steps"), one.state_hash());
}

#[test]
fn no_threads_and_too_many_are_refused() {
    for threads in [0, 17, usize::MAX] {
        assert!(World::try_new(Settings { threads, ..Settings::default() }).is_err(), "{threads} threads");
    }
}
