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

/// Of 300 piles of 100 bodies, each of its own seed, 250 to 255 were asleep after 30 s: in the others a body swings on, or
/// a wedge trembles. Of 16 with that chance fewer than 9 sleep in one draw of 1,000.
const PILES: u64 = 16;
const LEAST_ASLEEP: usize = 9;

#[test]
fn most_piles_fall_asleep_and_then_run_no_stage() {
    // A disc may roll on for ever: what leaves the pile is removed.
    let bounds = Some(Aabb::new(Vec2::new(-12.0, -20.0), Vec2::new(12.0, 500.0)));
    let piles = (1..=PILES).filter_map(|seed| {
        let mut world =
            rustycs_scenes::pile::build_with(100, seed, Settings { bounds, ..Settings::default() });
        let is_dynamic = |body: &BodyRef<'_>| body.body_type() == BodyType::Dynamic;
        let ids: Vec<BodyId> =
            world.bodies().filter(|(_, body)| is_dynamic(body)).map(|(id, _)| id).collect();
        falls_asleep(&mut world, &ids).then_some(world)
    });
    let mut piles: Vec<World> = piles.collect();
    assert!(piles.len() >= LEAST_ASLEEP, "{} of {PILES} piles are asleep after 30 s", piles.len());
    let world = &mut piles[0];
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

type Change = fn(&mut BodyMut<'_>) -> Result<(), BodyError>;

/// "Forgot to wake" is no way for a setter to fail: each wakes the whole island.
#[test]
fn every_change_of_a_body_wakes_its_stack() {
    let changes: [(&str, Change); 15] = [
        ("set_position", |body| {
            let [x, y] = body.view().position_f64();
            body.set_position([x, y])
        }),
        ("set_angle", |body| body.set_angle(0.0)),
        ("set_velocity", |body| body.set_velocity([0.0, 1.0])),
        ("set_velocity to 0", |body| body.set_velocity([0.0, 0.0])),
        ("set_angular_velocity", |body| body.set_angular_velocity(0.1)),
        ("apply_impulse", |body| body.apply_impulse([0.0, 0.1])),
        ("apply_angular_impulse", |body| body.apply_angular_impulse(0.1)),
        ("apply_force", |body| body.apply_force([0.0, 0.1])),
        ("apply_torque", |body| body.apply_torque(0.1)),
        ("set_friction", |body| body.set_friction(0.1)),
        ("set_restitution", |body| body.set_restitution(0.1)),
        ("set_gravity_scale", |body| body.set_gravity_scale(0.5)),
        ("set_linear_damping", |body| body.set_linear_damping(0.5)),
        ("set_angular_damping", |body| body.set_angular_damping(0.5)),
        ("wake", |body| {
            body.wake();
            Ok(())
        }),
    ];
    let (sleeping, _, ids) = sleeping_stack(3);
    for (name, change) in changes {
        let mut world = sleeping.clone();
        change(&mut world.body_mut(ids[1]).unwrap()).unwrap();
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
        ("set_settings", |world| world.set_settings(world.settings().clone()).unwrap()),
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
    world.body_mut(lift).unwrap().set_velocity([0.0, 1.0]).unwrap();
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
