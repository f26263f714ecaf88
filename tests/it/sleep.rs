//! Sleep: what is at rest costs nothing, and wakes when anything happens to it.

use rustycs::prelude::*;

use crate::support::{add, assert_near, place, unit_box};

/// Slow enough for a woken stack to be where it was, m.
const JUMP: f64 = 1e-4;

/// A world in which bodies may sleep.
fn earth() -> World {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    world
}

fn add_ground(world: &mut World) -> BodyId {
    let ground = Body::fixed(Shape::aabb(200.0, 2.0)).at([0.0, -1.0]);
    add(world, ground.friction(0.6).restitution(0.0))
}

fn add_stack(world: &mut World, x: f64, count: usize) -> Vec<BodyId> {
    (0..count).map(|i| add(world, unit_box(x, 0.5 + i as f64))).collect()
}

/// Whether all of the bodies that are still there are asleep within 30 s.
fn falls_asleep(world: &mut World, ids: &[BodyId]) -> bool {
    for _ in 0..1800 {
        world.step();
        if ids.iter().all(|&id| world.body(id).is_none_or(|body| body.is_sleeping())) {
            world.validate().unwrap();
            return true;
        }
    }
    false
}

fn step_until_asleep(world: &mut World, ids: &[BodyId]) {
    assert!(falls_asleep(world, ids), "awake after 30 s");
}

fn is_asleep(world: &World, id: BodyId) -> bool {
    world.body(id).unwrap().is_sleeping()
}

/// A ground and a stack of `count` boxes that sleeps on it.
fn sleeping_stack(count: usize) -> (World, BodyId, Vec<BodyId>) {
    let mut world = earth();
    let ground = add_ground(&mut world);
    let ids = add_stack(&mut world, 0.0, count);
    step_until_asleep(&mut world, &ids);
    (world, ground, ids)
}

/// A pool with 100 bodies of one density above it. A disc rolls without loss: one with nothing beside it may roll on for
/// ever, and what lies across one may swing for ever. Without `discs` hexagons take their places.
fn pile(seed: u64, discs: bool, sleep: bool) -> (World, Vec<BodyId>) {
    // What leaves the pool is removed.
    let bounds = Some(Aabb::new(Vec2::new(-12.0, -20.0), Vec2::new(12.0, 500.0)));
    let settings = Settings { bounds, sleep, ..Settings::default() };
    let mixed = rustycs_scenes::pile::build_with(100, seed, settings.clone());
    let mut world = World::new(settings);
    world.add_force(Force::EARTH_GRAVITY);
    for (_, body) in mixed.bodies() {
        let shape = match body.shape() {
            Shape::Circle(_) if !discs => hexagon(body.shape().extent()),
            shape => *shape,
        };
        let like =
            if body.body_type() == BodyType::Fixed { Body::fixed(shape) } else { Body::dynamic(shape) };
        let like = like.at(body.position_f64()).angle(body.angle()).material(body.material());
        add(&mut world, like.density(1.0));
    }
    let ids = world.bodies().filter(|(_, body)| body.body_type() == BodyType::Dynamic).map(|(id, _)| id);
    let ids = ids.collect();
    (world, ids)
}

fn hexagon(radius: f32) -> Shape {
    let corner = |k: u8| Rot::from_angle(f32::from(k) * core::f32::consts::FRAC_PI_3);
    let corners = [0, 1, 2, 3, 4, 5].map(|k| [radius * corner(k).c, radius * corner(k).s]);
    Shape::polygon(corners).unwrap()
}

/// How far the bodies have moved or turned since they were at `poses`, m: the point of each that has moved most.
fn moved(world: &World, poses: &[(BodyId, Pose)]) -> f64 {
    let moved = poses.iter().filter_map(|&(id, pose)| {
        let body = world.body(id)?;
        let [x, y] = (body.pose().center - pose.center).into();
        let Rot { c, s } = body.rotation();
        let turned = (c - pose.rotation.c).hypot(s - pose.rotation.s);
        Some(f64::from(Vec2::new(x, y).length() + turned * body.shape().extent()))
    });
    moved.fold(0.0, f64::max)
}

fn poses(world: &World, ids: &[BodyId]) -> Vec<(BodyId, Pose)> {
    ids.iter().filter_map(|&id| Some((id, world.body(id)?.pose()))).collect()
}

/// Of 300 such piles all were asleep after 20 s.
#[test]
fn piles_fall_asleep_and_then_run_no_stage() {
    for seed in 1..=8 {
        let (mut world, ids) = pile(seed, false, true);
        assert!(falls_asleep(&mut world, &ids), "the pile of seed {seed} is awake after 30 s");
        runs_no_stage(&mut world);
    }
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

/// No pile stays awake for nothing: in each that does something moves by more than half of the 1 mm in ten seconds by which
/// a body at rest may stray. Near that bound each body passes for a few seconds of a watch only, and not all do at once.
#[test]
fn what_stays_awake_moves() {
    let mut awake = 0;
    for seed in 1..=20 {
        let (mut world, ids) = pile(seed, true, true);
        if !falls_asleep(&mut world, &ids) {
            let before = poses(&world, &ids);
            awake += 1;
            let mut farthest = 0.0_f64;
            for _ in 0..600 {
                world.step();
                farthest = farthest.max(moved(&world, &before));
            }
            assert!(farthest > 0.5e-3, "seed {seed} is awake and moves by {farthest} m");
        }
    }
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

#[test]
fn an_impact_wakes_the_stack_it_hits_and_no_other() {
    let mut world = earth();
    add_ground(&mut world);
    let (hit, left_alone) = (add_stack(&mut world, 0.0, 3), add_stack(&mut world, 20.0, 3));
    let both: Vec<BodyId> = hit.iter().chain(&left_alone).copied().collect();
    step_until_asleep(&mut world, &both);
    assert_eq!(world.sleeping_islands(), 2);
    add(&mut world, unit_box(0.0, 5.0));
    for _ in 0..60 {
        world.step();
    }
    assert!(hit.iter().all(|&id| !is_asleep(&world, id)), "1.5 m fall in 0.55 s");
    assert!(left_alone.iter().all(|&id| is_asleep(&world, id)));
    world.validate().unwrap();
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

#[test]
fn removing_the_support_wakes_what_stood_on_it() {
    let (mut world, ground, ids) = sleeping_stack(3);
    let before = place(&world, ids[2])[1];
    assert!(world.remove(ground).is_some());
    world.validate().unwrap();
    for _ in 0..60 {
        world.step();
    }
    // All fall alike, freely: g/2 in a second.
    for &id in &ids {
        assert!(!is_asleep(&world, id));
    }
    assert_near(before - place(&world, ids[2])[1], 4.905, 0.05, "fall in 1 s");
}

#[test]
fn removing_a_box_wakes_the_ones_above() {
    let (mut world, _, ids) = sleeping_stack(4);
    let before = place(&world, ids[3])[1];
    assert!(world.remove(ids[1]).is_some());
    for _ in 0..120 {
        world.step();
    }
    assert_near(before - place(&world, ids[3])[1], 1.0, 0.01, "the top came down by a box");
    world.validate().unwrap();
}

type Change = fn(&mut BodyMut<'_>);

/// "Forgot to wake" is no way for a setter to fail: each wakes the whole island.
#[test]
fn every_change_of_a_body_wakes_its_stack() {
    let changes: [(&str, Change); 24] = [
        ("set_position", |body| body.set_position(body.position_f64()).unwrap()),
        ("set_angle", |body| body.set_angle(0.0).unwrap()),
        ("set_pose", |body| body.set_pose(body.pose()).unwrap()),
        ("set_velocity", |body| _ = body.set_velocity([0.0, 1.0])),
        ("set_velocity to 0", |body| _ = body.set_velocity([0.0, 0.0])),
        ("set_angular_velocity", |body| _ = body.set_angular_velocity(0.1)),
        ("apply_impulse", |body| _ = body.apply_impulse([0.0, 0.1])),
        ("apply_angular_impulse", |body| _ = body.apply_angular_impulse(0.1)),
        ("apply_force", |body| _ = body.apply_force([0.0, 0.1])),
        ("apply_torque", |body| _ = body.apply_torque(0.1)),
        ("set_friction", |body| body.set_friction(0.1).unwrap()),
        ("set_restitution", |body| body.set_restitution(0.1).unwrap()),
        ("set_material", |body| body.set_material(Material::RUBBER).unwrap()),
        ("set_density", |body| body.set_density(3.0).unwrap()),
        ("set_mass", |body| body.set_mass(3.0).unwrap()),
        ("set_shape", |body| body.set_shape(Shape::obb(0.9, 1.0)).unwrap()),
        ("set_body_type", |body| body.set_body_type(BodyType::Kinematic).unwrap()),
        ("set_fixed_rotation", |body| body.set_fixed_rotation(true)),
        ("set_gravity_scale", |body| body.set_gravity_scale(0.5).unwrap()),
        ("set_linear_damping", |body| body.set_linear_damping(0.5).unwrap()),
        ("set_angular_damping", |body| body.set_angular_damping(0.5).unwrap()),
        ("set_may_sleep", |body| body.set_may_sleep(true)),
        ("wake", |body| _ = body.wake()),
        ("set_body_type to fixed", |body| body.set_body_type(BodyType::Fixed).unwrap()),
    ];
    let (sleeping, _, ids) = sleeping_stack(3);
    for (name, change) in changes {
        let mut world = sleeping.clone();
        change(&mut world.body_mut(ids[1]).unwrap());
        assert!(ids.iter().all(|&id| !is_asleep(&world, id)), "{name}");
        world.validate().unwrap();
        world.step();
        assert!(world.profile().stage(Stage::Solve).ran, "{name}");
    }
}

type Edit = fn(&mut World);

#[test]
fn every_change_of_what_acts_on_all_bodies_wakes_them() {
    let edits: [(&str, Edit); 6] = [
        ("add_force", |world| _ = world.add_force(Force::new("wind", [0.0, 0.0]))),
        ("remove_force", |world| {
            let id = world.forces().next().unwrap().0;
            world.remove_force(id).unwrap();
        }),
        ("add_attractor", |world| _ = world.add_attractor(Attractor::global([0.0, 9.0], 1.0))),
        ("remove_attractor", |world| {
            let id = world.attractors().next().unwrap().0;
            world.remove_attractor(id).unwrap();
        }),
        ("replace_attractor", |world| {
            let id = world.attractors().next().unwrap().0;
            world.replace_attractor(id, Attractor::global([0.0, 9.0], 1.0)).unwrap();
        }),
        ("set_settings", |world| {
            world.set_settings(Settings { substeps: 5, ..world.settings().clone() }).unwrap();
        }),
    ];
    let mut sleeping = earth();
    add_ground(&mut sleeping);
    sleeping.add_attractor(Attractor::local([0.0, 50.0], 1.0, 1.0));
    let ids = add_stack(&mut sleeping, 0.0, 2);
    step_until_asleep(&mut sleeping, &ids);
    for (name, edit) in edits {
        let mut world = sleeping.clone();
        edit(&mut world);
        assert!(ids.iter().all(|&id| !is_asleep(&world, id)), "{name}");
    }
}

/// Settings that are those of before, or move no body, wake none; nor does a force, a torque or an impulse of 0.
#[test]
fn what_changes_nothing_wakes_nobody() {
    let bounds = Some(Aabb::new(Vec2::splat(-1e6), Vec2::splat(1e6)));
    let same: [Edit; 5] = [
        |world| world.set_settings(world.settings().clone()).unwrap(),
        |world| {
            let settings =
                Settings { lanes: Lanes::One, threads: 1, fitted_kernels: false, ..Settings::default() };
            world
                .set_settings(Settings { max_ticks_per_advance: 3, hit_threshold: 2.0, ..settings })
                .unwrap();
        },
        |world| {
            let id = world.bodies().last().unwrap().0;
            let mut body = world.body_mut(id).unwrap();
            body.apply_force([0.0, 0.0]).apply_torque(0.0).apply_impulse([0.0, -0.0]);
            body.apply_force_at([0.0, 0.0], [3.0, 3.0]).apply_angular_impulse(0.0);
        },
        |world| {
            let id = world.bodies().last().unwrap().0;
            let body = world.body_mut(id).unwrap().describe();
            let mut same = world.body_mut(id).unwrap();
            same.set_material(body.get_material()).unwrap();
            same.set_mass(body.get_mass()).unwrap();
            same.set_shape(*body.get_shape()).unwrap();
            same.set_body_type(BodyType::Dynamic).unwrap();
        },
        |world| {
            let id = world.bodies().last().unwrap().0;
            world.body_mut(id).unwrap().without_waking().apply_force([9.0, 9.0]).apply_impulse([9.0, 9.0]);
        },
    ];
    let (sleeping, _, ids) = sleeping_stack(2);
    for (number, edit) in same.into_iter().enumerate() {
        let mut world = sleeping.clone();
        edit(&mut world);
        for _ in 0..3 {
            assert!(ids.iter().all(|&id| is_asleep(&world, id)), "edit {number}");
            world.step();
        }
        assert_eq!(world.state_hash(), sleeping.state_hash(), "edit {number}");
    }
    let mut bounded = sleeping.clone();
    bounded.set_settings(Settings { bounds, ..Settings::default() }).unwrap();
    assert_eq!(bounded.sleeping_islands(), 1);
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

/// The paddle needs (4 - 0.5 - 0.25) m / 2 m/s to get there.
#[test]
fn a_kinematic_body_that_moves_in_wakes_the_stack() {
    let (mut world, _, ids) = sleeping_stack(2);
    add(&mut world, Body::kinematic(Shape::obb(0.5, 0.8)).at([-4.0, 0.5]).velocity([2.0, 0.0]));
    for _ in 0..60 {
        world.step();
    }
    assert!(ids.iter().all(|&id| is_asleep(&world, id)), "it is a metre away");
    for _ in 0..90 {
        world.step();
    }
    assert!(!is_asleep(&world, ids[0]));
    assert!(place(&world, ids[0])[0] > 0.5, "pushed to {}", place(&world, ids[0])[0]);
}

/// What rides on a kinematic body sleeps once that stands still, and wakes when it is told to move.
#[test]
fn a_lift_that_starts_wakes_its_load() {
    let mut world = earth();
    let lift = add(&mut world, Body::kinematic(Shape::aabb(4.0, 1.0)).at([0.0, -0.5]).restitution(0.0));
    let ids = add_stack(&mut world, 0.0, 2);
    step_until_asleep(&mut world, &ids);
    world.body_mut(lift).unwrap().set_velocity([0.0, 1.0]);
    let before = place(&world, ids[1])[1];
    for _ in 0..60 {
        world.step();
    }
    assert!(ids.iter().all(|&id| !is_asleep(&world, id)));
    assert_near(place(&world, ids[1])[1] - before, 1.0, 0.02, "rise in 1 s");
}

/// A wall that is put into a sleeping stack, new or moved there, wakes it.
#[test]
fn a_fixed_body_put_into_a_sleeping_stack_wakes_it() {
    let (sleeping, ..) = sleeping_stack(2);
    let mut added = sleeping.clone();
    add(&mut added, Body::fixed(Shape::aabb(1.0, 0.5)).at([0.8, 0.5]));
    let mut moved = sleeping;
    let wall = add(&mut moved, Body::fixed(Shape::aabb(1.0, 0.5)).at([50.0, 0.5]));
    moved.step();
    assert_eq!(moved.sleeping_islands(), 1);
    moved.body_mut(wall).unwrap().set_position([0.8, 0.5]).unwrap();
    for mut world in [added, moved] {
        world.step();
        world.step();
        assert_eq!(world.sleeping_islands(), 0);
        world.validate().unwrap();
    }
}

/// Manifolds and impulses are kept over the sleep: a woken stack goes on as if nothing had been.
#[test]
fn a_woken_stack_goes_on_where_it_was() {
    let (mut world, _, ids) = sleeping_stack(10);
    let before: Vec<[f64; 2]> = ids.iter().map(|&id| place(&world, id)).collect();
    world.wake_all();
    assert_eq!(world.sleeping_islands(), 0);
    for _ in 0..20 {
        world.step();
        for (&id, &[x, y]) in ids.iter().zip(&before) {
            assert_near(place(&world, id)[0], x, JUMP, "sideways");
            assert_near(place(&world, id)[1], y, JUMP, "height");
        }
    }
    step_until_asleep(&mut world, &ids);
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
