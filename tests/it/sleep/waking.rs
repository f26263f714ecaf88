//! What wakes: whatever something happens to, with its island, and nothing else.

use rustycs::prelude::*;

use crate::sleep::{JUMP, add_ground, add_stack, earth, is_asleep, sleeping_stack, step_until_asleep};
use crate::support::{add, assert_near, place, unit_box};

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
            let settings = Settings { lanes: Lanes::One, threads: 1, ..Settings::default() };
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

/// As a game does that tells each lift its speed in every tick, by any of three ways.
#[test]
fn a_lift_that_is_told_to_stand_still_in_each_tick_lets_its_load_sleep() {
    for tell in [
        |lift: &mut BodyMut<'_>| _ = lift.set_velocity([0.0, 0.0]),
        |lift: &mut BodyMut<'_>| _ = lift.set_angular_velocity(0.0),
        |lift: &mut BodyMut<'_>| _ = lift.move_to(Pose::at([0.0, -0.5])),
    ] {
        let mut world = earth();
        let lift = add(&mut world, Body::kinematic(Shape::obb(4.0, 1.0)).at([0.0, -0.5]));
        let ids = add_stack(&mut world, 0.0, 2);
        for _ in 0..180 {
            tell(&mut world.body_mut(lift).unwrap());
            world.step();
        }
        assert!(ids.iter().all(|&id| is_asleep(&world, id)));
    }
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
