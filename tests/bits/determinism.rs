//! The same past gives the same bits.

use rustycs::prelude::*;

use crate::support::{add, place};

fn pile() -> World {
    rustycs_scenes::find("pile").unwrap().build(3, Settings::default())
}

fn step_hashes(world: &mut World, ticks: usize) -> Vec<u64> {
    (0..ticks)
        .map(|_| {
            world.step();
            world.state_hash()
        })
        .collect()
}

#[test]
fn worlds_built_alike_step_alike() {
    for scene in rustycs_scenes::all() {
        let [mut one, mut other] = [(); 2].map(|()| scene.build(3, Settings::default()));
        assert_eq!(step_hashes(&mut one, 100), step_hashes(&mut other, 100), "{}", scene.name);
    }
}

/// A clone holds all that the next step depends on: warm starting, sleep timers, unused time, free places.
#[test]
fn a_clone_steps_as_its_original() {
    let mut original = pile();
    step_hashes(&mut original, 150);
    let mut clone = original.clone();
    assert_eq!(original.state_hash(), clone.state_hash());
    for world in [&mut original, &mut clone] {
        let ids: Vec<BodyId> = world.bodies().map(|(id, _)| id).collect();
        for id in ids.iter().skip(5).step_by(7) {
            assert!(world.remove(*id).is_some());
        }
        add(world, Body::dynamic(Shape::obb(0.5, 0.5)).at([0.0, 20.0]).velocity([0.0, -20.0]));
    }
    assert_eq!(step_hashes(&mut original, 150), step_hashes(&mut clone, 150));
}

/// Of the world that was there nothing is left, whatever it held: each of these is cloned into the one of the scene before.
#[test]
fn a_world_cloned_into_another_steps_as_its_original() {
    for threads in [1, 2] {
        let settings = Settings { threads, ..Settings::default() };
        let mut other = World::default();
        for scene in rustycs_scenes::all() {
            let mut original = scene.build(3, settings.clone());
            original.divide_all_work();
            step_hashes(&mut original, 70);
            other.clone_from(&original);
            other.validate().unwrap();
            assert_eq!(other.state_hash(), original.state_hash(), "{}", scene.name);
            assert_eq!(step_hashes(&mut other, 70), step_hashes(&mut original, 70), "{}", scene.name);
            assert_eq!(other.profile().counters(), original.profile().counters(), "{}", scene.name);
        }
    }
}

/// What is done to a clone leaves its original alone.
#[test]
fn a_clone_shares_nothing() {
    let mut original = pile();
    step_hashes(&mut original, 60);
    let (hash, mut clone) = (original.state_hash(), original.clone());
    step_hashes(&mut clone, 10);
    assert_ne!(clone.state_hash(), hash);
    assert_eq!(original.state_hash(), hash);
}

#[test]
fn a_world_steps_alike_on_another_thread() {
    let mut here = pile();
    let mut there = here.clone();
    let elsewhere = std::thread::spawn(move || step_hashes(&mut there, 120));
    assert_eq!(step_hashes(&mut here, 120), elsewhere.join().unwrap());
}

/// Asking is free: queries, views and hashes between steps change nothing.
#[test]
fn asking_changes_nothing() {
    let [mut asked, mut left_alone] = [pile(), pile()];
    for _ in 0..100 {
        asked.step();
        left_alone.step();
        assert!(asked.bodies_in([-1e6, -1e6], [1e6, 1e6]).len() == asked.body_count());
        assert!(asked.ray_cast([0.0, 100.0], [0.0, -200.0]).is_some());
        assert!(asked.contacts().count() <= asked.profile().counters().pairs);
        assert!(asked.energy().is_finite() && !asked.tree_boxes().is_empty());
        assert_eq!(asked.state_hash(), left_alone.state_hash());
    }
}

#[test]
fn events_come_in_the_same_order() {
    let [mut one, mut other] = [pile(), pile()];
    let mut seen = 0;
    for _ in 0..200 {
        one.step();
        other.step();
        let (ours, theirs) = (one.events(), other.events());
        assert_eq!(ours.began(), theirs.began());
        assert_eq!(ours.ended(), theirs.ended());
        assert_eq!(ours.hits(), theirs.hits());
        let ids = |event: &ContactEvent| (event.a, event.b);
        assert!(ours.began().is_sorted_by_key(ids) && ours.ended().is_sorted_by_key(ids));
        seen += ours.began().len() + ours.ended().len() + ours.hits().len();
    }
    assert!(seen > 500, "only {seen} events");
}

/// The order in which a body was built up does not matter, only what it is.
#[test]
fn the_hash_is_that_of_the_state_and_not_of_its_past() {
    let start = || {
        let mut world = World::new(Settings::default());
        let id = add(&mut world, Body::dynamic(Shape::circle(0.5)).at([1.0, 2.0]));
        (world, id)
    };
    let ((still, _), (mut pushed, id)) = (start(), start());
    pushed.body_mut(id).unwrap().set_position([5.0, 5.0]).unwrap();
    assert_ne!(still.state_hash(), pushed.state_hash());
    pushed.body_mut(id).unwrap().set_position([1.0, 2.0]).unwrap();
    assert_eq!(still.state_hash(), pushed.state_hash());
}

/// One bit of one number of any body is enough.
#[test]
fn the_hash_changes_when_any_body_changes() {
    let mut world = pile();
    step_hashes(&mut world, 30);
    let hash = world.state_hash();
    let ids: Vec<BodyId> = world.bodies().map(|(id, _)| id).collect();
    for &id in ids.iter().step_by(10) {
        let [x, y] = place(&world, id);
        let next = f64::from_bits(x.to_bits() + 1);
        for change in [
            |body: &mut BodyMut<'_>, _: [f64; 2], x: f64, y: f64| body.set_position([x, y]),
            |body: &mut BodyMut<'_>, [x, _]: [f64; 2], _: f64, y: f64| {
                body.set_position([x, f64::from_bits(y.to_bits() + 1)])
            },
        ] {
            let mut changed = world.clone();
            change(&mut changed.body_mut(id).unwrap(), [x, y], next, y).unwrap();
            assert_ne!(changed.state_hash(), hash, "{id:?}");
        }
        let mut removed = world.clone();
        assert!(removed.remove(id).is_some());
        assert_ne!(removed.state_hash(), hash, "{id:?} removed");
        if world.body(id).unwrap().body_type() == BodyType::Dynamic {
            let spin = world.body(id).unwrap().angular_velocity();
            let mut changed = world.clone();
            changed.body_mut(id).unwrap().set_angular_velocity(spin + 1e-3);
            assert_ne!(changed.state_hash(), hash, "{id:?} spins");
        }
    }
}
