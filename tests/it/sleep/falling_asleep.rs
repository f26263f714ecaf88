//! What sleeps, and when: islands in equilibrium, and nothing else.

use rustycs::prelude::*;

use crate::sleep::{
    add_ground, add_stack, earth, falls_asleep, is_asleep, moved, pile, poses, sleeping_stack,
    step_until_asleep,
};
use crate::support::{add, assert_near, unit_box};

/// Of 300 such piles all were asleep after 20 s.
#[test]
fn piles_fall_asleep_and_then_run_no_stage() {
    for seed in 1..=8 {
        let (mut world, ids) = pile(seed, false, true);
        assert!(falls_asleep(&mut world, &ids), "the pile of seed {seed} is awake after 30 s");
        runs_no_stage(&mut world);
    }
}

/// What rolls on discs is lost, so heaps of them come to rest as others do. Of 200 such piles two are awake for longer, so that of twenty two
/// are hardly by chance.
#[test]
fn piles_with_discs_fall_asleep() {
    let stays_awake = |&seed: &u64| {
        let (mut world, ids) = pile(seed, true, true);
        !falls_asleep(&mut world, &ids)
    };
    let awake: Vec<u64> = (1..=20).filter(stays_awake).collect();
    assert!(awake.len() <= 1, "the piles of seeds {awake:?} are awake after 30 s");
}

fn runs_no_stage(world: &mut World) {
    // The step after the one that put the last to sleep looks at the boxes that had moved in it.
    world.step();
    let hash = world.state_hash();
    for _ in 0..10 {
        world.step();
        for (stage, report) in world.profile().stages() {
            assert!(!report.ran && report.count == 0, "{} ran on {}", stage.name(), report.count);
        }
        let counters = world.profile().counters();
        assert_eq!((counters.awake_bodies, counters.substeps), (0, 0));
    }
    assert_eq!(world.state_hash(), hash);
}

/// Sleep changes nothing: what sleeps would have stayed within 1 mm in ten seconds more. What has slept first counts, as
/// the worlds go apart after that.
#[test]
fn what_sleeps_would_not_have_moved() {
    for (seed, discs) in (1..=6).flat_map(|seed| [(seed, false), (seed, true)]) {
        let ((mut sleeping, ids), (mut awake, _)) = (pile(seed, discs, true), pile(seed, discs, false));
        for _ in 0..1800 {
            sleeping.step();
            awake.step();
            if sleeping.sleeping_islands() > 0 {
                break;
            }
        }
        let sleepers: Vec<BodyId> =
            ids.into_iter().filter(|&id| sleeping.body(id).is_some_and(|body| body.is_sleeping())).collect();
        let before = poses(&awake, &sleepers);
        for _ in 0..600 {
            awake.step();
            sleeping.step();
            // Something else has come to them.
            if !sleepers.iter().all(|&id| is_asleep(&sleeping, id)) {
                break;
            }
            let moved = moved(&awake, &before);
            assert!(moved < 1e-3, "seed {seed}, discs {discs}: by {moved} m");
        }
    }
}

/// No pile stays awake for nothing: in each that does, but for two of 40, something moves by more than half of the 1 mm in
/// ten seconds by which a body at rest may stray. Near that bound each body passes for a few seconds of a watch only, and not all do at once.
#[test]
fn what_stays_awake_moves() {
    let (mut awake, mut for_nothing) = (0, Vec::new());
    for seed in 1..=40 {
        let (mut world, ids) = pile(seed, true, true);
        for &id in &ids {
            world.body_mut(id).unwrap().set_rolling_resistance(0.0).unwrap();
        }
        if !falls_asleep(&mut world, &ids) {
            let before = poses(&world, &ids);
            awake += 1;
            let mut farthest = 0.0_f64;
            for _ in 0..600 {
                world.step();
                farthest = farthest.max(moved(&world, &before));
            }
            if farthest <= 0.5e-3 {
                for_nothing.push((seed, farthest));
            }
        }
    }
    assert!(for_nothing.len() <= 2, "awake, with the greatest motion in m: {for_nothing:?}");
    assert!(awake > 0, "no disc rolls on: ask others");
}

/// A box that is set down at rest sags by less than a watch of half a second allows for: it sleeps after the sleep time, or
/// if it does not after another watch, twice as long; islands are looked for every 1/8 s.
#[test]
fn bodies_sleep_after_the_sleep_time() {
    for sleep_time in [0.0_f32, 0.2, 3.0] {
        let mut world = World::new(Settings { sleep_time, ..Settings::default() });
        world.add_force(Force::EARTH_GRAVITY);
        add_ground(&mut world);
        let id = add(&mut world, unit_box(0.0, 0.5));
        step_until_asleep(&mut world, &[id]);
        let time = world.time();
        let [earliest, latest] = [f64::from(sleep_time), 3.0 * f64::from(sleep_time.max(0.5)) + 0.15];
        assert!(earliest <= time && time <= latest, "{time} s instead of {earliest} to {latest}");
    }
}

/// A disc that rolls at v strays by v t, and that passes for rest, s H (t/H)², after H v/s: 2 s at a fifth of the sleep
/// speed s. At the sleep speed it never does: it is out of reach before.
#[test]
fn what_is_slower_than_the_sleep_speed_is_at_rest() {
    for (share, sleeps) in [(0.2, true), (1.2, false)] {
        let mut world = World::new(Settings { sleep_speed: 0.01, ..Settings::default() });
        world.add_force(Force::EARTH_GRAVITY);
        add_ground(&mut world);
        let radius = 0.5;
        // The point on top is twice as fast as the centre, and straying counts turns and ways: half of the speed is each's.
        let speed = 0.5 * share * 0.01;
        let disc = Body::dynamic(Shape::circle(radius)).at([0.0, 0.5]).restitution(0.0).friction(0.6);
        let disc = disc.rolling_resistance(0.0);
        let disc = add(&mut world, disc.velocity([speed, 0.0]).angular_velocity(-speed / radius));
        assert_eq!(falls_asleep(&mut world, &[disc]), sleeps, "{share} of the sleep speed");
    }
}

/// One body that may not sleep keeps awake what touches it, and nothing else.
#[test]
fn a_body_that_may_not_sleep_stays_awake_with_what_it_touches() {
    let mut world = earth();
    add_ground(&mut world);
    let (kept_awake, others) = (add_stack(&mut world, 0.0, 2), add_stack(&mut world, 20.0, 2));
    let watchful = add(&mut world, unit_box(0.0, 2.5).may_sleep(false));
    step_until_asleep(&mut world, &others);
    for _ in 0..600 {
        world.step();
    }
    assert!(!world.body(watchful).unwrap().may_sleep() && world.body(others[0]).unwrap().may_sleep());
    assert!(kept_awake.iter().chain([&watchful]).all(|&id| !is_asleep(&world, id)));
    world.body_mut(watchful).unwrap().set_may_sleep(true);
    step_until_asleep(&mut world, &[watchful, kept_awake[0]]);
    world.body_mut(watchful).unwrap().set_may_sleep(false);
    assert!(!is_asleep(&world, kept_awake[0]));
}

/// A body that sleeps is at rest: its velocity reads 0, and it counts as standing still.
/// A disc that flies, two boxes on each other of which one may not sleep, and a box that sleeps.
#[test]
fn a_body_tells_why_it_is_awake() {
    let mut world = World::default();
    let flying = add(&mut world, Body::dynamic(Shape::circle(0.5)).velocity([1.0, 0.0]));
    let why = |world: &World, id: BodyId| world.body(id).unwrap().why_awake();
    world.step();
    assert_eq!(why(&world, flying), Some(Awake::Moves));

    let mut world = earth();
    let ground = add(&mut world, Body::fixed(Shape::aabb(40.0, 1.0)).at([0.0, -0.5]));
    let restless = add(&mut world, unit_box(0.0, 0.5).may_sleep(false));
    let above = add(&mut world, unit_box(0.0, 1.5));
    let alone = add(&mut world, unit_box(5.0, 0.5));
    world.step();
    assert_eq!(why(&world, above), Some(Awake::Moves), "not for long enough");
    (0..600).for_each(|_| world.step());
    assert_eq!(why(&world, restless), Some(Awake::MayNotSleep));
    assert_eq!(why(&world, above), Some(Awake::Others));
    assert_eq!([why(&world, alone), why(&world, ground)], [None, None]);
    world.set_settings(Settings { sleep: false, ..Settings::default() }).unwrap();
    world.step();
    assert_eq!(why(&world, above), Some(Awake::MayNotSleep));
}

#[test]
fn a_sleeping_body_has_no_velocity() {
    let (world, _, ids) = sleeping_stack(3);
    for &id in &ids {
        let body = world.body(id).unwrap();
        assert_eq!((body.velocity(), body.angular_velocity()), (Vec2::ZERO, 0.0));
    }
    assert_eq!(world.kinetic_energy(), 0.0);
    assert_eq!(world.sleeping_islands(), 1);
}

#[test]
fn nothing_sleeps_where_sleep_is_off() {
    let mut world = World::new(Settings { sleep: false, ..Settings::default() });
    world.add_force(Force::EARTH_GRAVITY);
    add_ground(&mut world);
    let ids = add_stack(&mut world, 0.0, 2);
    for _ in 0..300 {
        world.step();
    }
    assert!(ids.iter().all(|&id| !is_asleep(&world, id)));
}

/// Two stacks on one floor are two islands: one still rocks while the other sleeps.
#[test]
fn two_separate_stacks_sleep_separately() {
    let mut world = earth();
    add_ground(&mut world);
    let still = add_stack(&mut world, 0.0, 3);
    let busy = add(&mut world, unit_box(20.0, 0.5).friction(0.0).velocity([1.0, 0.0]));
    step_until_asleep(&mut world, &still);
    assert!(!is_asleep(&world, busy));
    assert_eq!(world.sleeping_islands(), 1);
}

/// A wind of 0.05 N on all of a heap, for ever: it sleeps all the same, and what flies in it gains F t / m.
#[test]
fn a_heap_sleeps_in_a_wind_that_does_not_wake() {
    let mut world = earth();
    add_ground(&mut world);
    let ids: Vec<BodyId> = (0..10).map(|i| add(&mut world, unit_box(1.5 * f64::from(i), 0.5))).collect();
    let leaf =
        add(&mut world, Body::dynamic(Shape::circle(0.1)).at([0.0, 90.0]).mass(0.5).gravity_scale(0.0));
    for _ in 0..600 {
        for &id in ids.iter().chain([&leaf]) {
            world.body_mut(id).unwrap().without_waking().apply_force([0.05, 0.0]);
        }
        world.step();
    }
    assert!(ids.iter().all(|&id| is_asleep(&world, id)));
    assert_near(f64::from(world.body(leaf).unwrap().velocity().x), 0.05 / 0.5 * 10.0, 1e-5, "F t / m");
}

/// A sleeping contact neither begins nor ends again.
#[test]
fn sleep_and_waking_are_no_contact_events() {
    let (mut world, _, ids) = sleeping_stack(3);
    world.step();
    world.wake_all();
    for _ in 0..90 {
        world.step();
        let events = world.events();
        assert!(events.began().is_empty() && events.ended().is_empty() && events.hits().is_empty());
    }
    assert!(ids.iter().all(|&id| is_asleep(&world, id)));
}

/// Two stacks on one floor are two islands, a lone body is a third; the floor belongs to none.
#[test]
fn islands_are_what_contacts_connect() {
    let mut world = crate::support::earth();
    crate::support::add_floor(&mut world, 0.6);
    let mut expected = vec![Vec::new(), Vec::new(), Vec::new()];
    for (island, x, height) in [(0, -3.0, 3), (1, 3.0, 2), (2, 9.0, 1)] {
        for i in 0..height {
            expected[island]
                .push(crate::support::add(&mut world, crate::support::unit_box(x, 0.5 + f64::from(i))));
        }
    }
    crate::support::run(&mut world, 0.5);
    assert_eq!(world.islands(), expected);
}
