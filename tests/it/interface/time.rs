//! Ticks, frames, settings in flight, and the profile.

use std::sync::atomic::{AtomicU32, Ordering};

use rustycs::prelude::*;

use crate::support::{add, add_floor, assert_near, assert_relative, earth, place, unit_box};

#[test]
fn sixty_frames_make_sixty_ticks() {
    for frames_per_second in [30.0_f64, 60.0, 75.0, 144.0, 1000.0] {
        let mut world = World::new(Settings::default());
        let ticks: u32 = (0..frames_per_second as u32).map(|_| world.advance(1.0 / frames_per_second)).sum();
        assert_eq!((ticks, world.ticks()), (60, 60), "{frames_per_second} frames per second");
    }
    let mut world = World::new(Settings::default());
    assert!((0..60).all(|_| world.advance(1.0_f32 / 60.0) == 1), "each frame of f32 is a tick");
}

#[test]
fn a_slow_frame_cannot_spiral() {
    let mut world = World::new(Settings::default());
    assert_eq!(world.advance(10.0), 8);
    assert_eq!((world.advance(0.0), world.alpha()), (0, 0.0));
    assert_eq!(world.advance(1e300) + world.advance(f64::MAX), 16);
    assert_eq!(world.advance(1.0 / 60.0), 1);
}

#[test]
fn time_that_is_none_is_ignored() {
    let mut world = World::new(Settings::default());
    world.advance(0.5 / 60.0);
    for nonsense in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, -0.0, 0.0] {
        assert_eq!((world.advance(nonsense), world.ticks()), (0, 0), "{nonsense}");
        assert_near(f64::from(world.alpha()), 0.5, 1e-6, "alpha");
    }
}

#[test]
fn alpha_is_how_far_the_frame_is_past_the_last_tick() {
    let mut world = World::new(Settings::default());
    for (frame, ticks, alpha) in [(0.25, 0, 0.25), (0.5, 0, 0.75), (0.5, 1, 0.25), (3.5, 3, 0.75)] {
        assert_eq!(world.advance(frame / 60.0), ticks);
        assert_near(f64::from(world.alpha()), alpha, 1e-6, "alpha");
    }
    // More ticks per second: what is left over may be several ticks, and alpha is a fraction still.
    world.set_settings(Settings { tick_rate: 600.0, ..Settings::default() }).unwrap();
    assert_eq!(world.alpha(), 1.0);
    assert_eq!(world.advance(0.0), 7);
}

/// g t²/2 whatever the tick rates on the way.
#[test]
fn the_tick_rate_may_change_in_flight() {
    let mut world = earth();
    let id = add(&mut world, Body::dynamic(Shape::circle(0.5)));
    for tick_rate in [60.0_f32, 240.0, 20.0, 100.0] {
        world.set_settings(Settings { tick_rate, sleep: false, ..Settings::default() }).unwrap();
        assert_relative(world.settings().tick_seconds(), 1.0 / f64::from(tick_rate), 1e-12, "tick");
        crate::support::run(&mut world, 0.5);
    }
    assert_relative(place(&world, id)[1], -0.5 * 9.81 * 4.0, 1e-6, "fall in 2 s");
}

/// A stack stands through a change of the tick rate: the impulses it is held by are scaled with it.
#[test]
fn a_stack_does_not_feel_a_change_of_the_tick_rate() {
    let mut world = earth();
    add_floor(&mut world, 0.6);
    let ids: Vec<BodyId> = (0..5).map(|i| add(&mut world, unit_box(0.0, 0.5 + f64::from(i)))).collect();
    crate::support::run(&mut world, 2.0);
    for tick_rate in [120.0, 60.0, 240.0, 60.0] {
        let before = place(&world, ids[4])[1];
        world.set_settings(Settings { tick_rate, sleep: false, ..Settings::default() }).unwrap();
        world.step();
        // Overlap at rest goes with h: driven out at 28 1/s, but not thrown up.
        assert_near(place(&world, ids[4])[1], before, 1e-3, "the top");
        crate::support::run(&mut world, 0.5);
    }
}

#[test]
fn a_stage_without_input_does_not_run() {
    let mut world = World::new(Settings::default());
    world.step();
    for (stage, report) in world.profile().stages() {
        assert_eq!((report.ran, report.count, report.seconds), (false, 0, None), "{}", stage.name());
    }
    // One body in flight: no contacts, nothing at rest.
    world.add_force(Force::EARTH_GRAVITY);
    add(&mut world, Body::dynamic(Shape::circle(0.5)));
    world.step();
    for (stage, expected) in [
        (Stage::Pairs, true),
        (Stage::Contacts, false),
        (Stage::Solve, true),
        (Stage::Finalize, true),
        (Stage::Events, false),
        (Stage::Sensors, false),
        (Stage::Sleep, false),
    ] {
        let report = world.profile().stage(stage);
        assert_eq!((report.ran, report.count > 0), (expected, expected), "{}", stage.name());
    }
    assert_eq!(world.profile().counters().awake_bodies, 1);
    let order: Vec<Stage> = world.profile().stages().map(|(stage, _)| stage).collect();
    assert_eq!(order, Stage::ALL);
}

#[test]
fn the_profile_counts_what_there_is() {
    let mut world = earth();
    add_floor(&mut world, 0.6);
    for i in 0..3 {
        add(&mut world, unit_box(0.0, 0.5 + f64::from(i)));
    }
    world.step();
    let counters = world.profile().counters();
    assert_eq!((counters.awake_bodies, counters.contacts, counters.substeps), (3, 3, 4));
    assert_eq!((counters.bouncy_contacts, counters.impacts, counters.overflow), (0, 0, 0));
    assert!(counters.pairs >= 3 && counters.colours >= 2);
}

static CALLS: AtomicU32 = AtomicU32::new(0);

/// A clock that is a second later each time it is read.
fn clock() -> f64 {
    f64::from(CALLS.fetch_add(1, Ordering::Relaxed))
}

#[test]
fn a_clock_is_read_only_if_one_is_given() {
    let mut world = earth();
    add(&mut world, Body::dynamic(Shape::circle(0.5)));
    world.step();
    assert_eq!((CALLS.load(Ordering::Relaxed), world.profile().seconds()), (0, None));
    world.set_clock(Clock::new(clock));
    world.step();
    // Solve and finalize: a beginning and an end each.
    let running = world.profile().stages().filter(|(_, report)| report.ran).count();
    assert_eq!(CALLS.load(Ordering::Relaxed), 2 * running as u32);
    assert_eq!(world.profile().seconds(), Some(running as f64));
    assert_eq!(world.profile().stage(Stage::Solve).seconds, Some(1.0));
    assert_eq!(world.profile().stage(Stage::Sleep).seconds, Some(0.0));
    world.set_clock(None);
    world.step();
    assert_eq!((CALLS.load(Ordering::Relaxed), world.profile().seconds()), (2 * running as u32, None));
}

/// What a clock counts from is the caller's, and clones read the same one.
#[test]
fn a_clock_may_keep_what_it_counts_from() {
    let reads = std::sync::Arc::new(AtomicU32::new(0));
    let counter = reads.clone();
    let mut world = earth();
    add(&mut world, Body::dynamic(Shape::circle(0.5)));
    world.set_clock(Clock::new(move || f64::from(counter.fetch_add(1, Ordering::Relaxed)) / 8.0));
    let mut clone = world.clone();
    for world in [&mut world, &mut clone] {
        world.step();
        let running = world.profile().stages().filter(|(_, report)| report.ran).count();
        assert_eq!(world.profile().seconds(), Some(running as f64 / 8.0));
    }
    assert!(reads.load(Ordering::Relaxed) >= 8);
    assert_eq!(world.state_hash(), clone.state_hash());
}

/// A clock is the caller's function, which may tell anything. Of every pair of readings no time has passed.
#[test]
fn a_clock_that_tells_no_time_gives_times_of_zero() {
    for readings in [
        [f64::NAN, 1.0],
        [1.0, f64::NAN],
        [f64::NAN, f64::NAN],
        [0.0, f64::INFINITY],
        [f64::INFINITY, f64::INFINITY],
        [f64::NEG_INFINITY, 0.0],
        [f64::MIN, f64::MAX],
        [2.0, 1.0],
        [1.0, 1.0],
    ] {
        let mut world = earth();
        add(&mut world, Body::dynamic(Shape::circle(0.5)));
        let reads = AtomicU32::new(0);
        let clock = move || readings[reads.fetch_add(1, Ordering::Relaxed) as usize % 2];
        world.set_clock(Clock::new(clock));
        world.step();
        assert_eq!(world.profile().seconds(), Some(0.0), "{readings:?}");
        for (stage, report) in world.profile().stages() {
            assert_eq!(report.seconds, Some(0.0), "{readings:?}: {}", stage.name());
        }
    }
    // Two stages of the longest time there is make no infinite one.
    let mut world = earth();
    add(&mut world, Body::dynamic(Shape::circle(0.5)));
    let reads = AtomicU32::new(0);
    world.set_clock(Clock::new(move || f64::MAX * f64::from(reads.fetch_add(1, Ordering::Relaxed) % 2)));
    world.step();
    assert_eq!(world.profile().seconds(), Some(f64::MAX));
}

fn broken_clock() -> f64 {
    panic!("the clock stands still")
}

#[test]
fn a_panic_in_a_step_is_passed_on_and_the_world_is_not_stepped_again() {
    let message_of = |world: &mut World| {
        let step = std::panic::AssertUnwindSafe(|| world.step());
        *std::panic::catch_unwind(step).unwrap_err().downcast::<&str>().unwrap()
    };
    let mut world = World::new(Settings { threads: 2, ..Settings::default() });
    let ball = world.add(Body::dynamic(Shape::circle(0.5))).unwrap();
    let before = world.clone();
    world.set_clock(Clock::new(broken_clock));
    assert_eq!(message_of(&mut world), "the clock stands still");
    assert_eq!(message_of(&mut world), "an earlier step of this world panicked halfway");
    assert_eq!(world.body(ball).unwrap().position(), Vec2::ZERO);
    assert_eq!(message_of(&mut world.clone()), "an earlier step of this world panicked halfway");
    let mut world = before;
    world.step();
    assert_eq!(world.ticks(), 1);
}
