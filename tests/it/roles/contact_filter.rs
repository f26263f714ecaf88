//! A contact filter by a function: what it refuses passes through, all else is as without it.

use rustycs::prelude::*;

use crate::support::{add, add_floor, earth, earth_with, place, run, unit_box};

/// Shapes pass through others of the same number, but for 0.
fn same_number_passes() -> ContactFilter {
    ContactFilter::new(|a, b| a.user_data() == 0 || a.user_data() != b.user_data())
}

#[test]
fn a_pair_that_is_refused_passes_and_others_do_not() {
    for speed in [0.0, 3.0, 300.0] {
        let mut world = earth();
        world.set_contact_filter(same_number_passes());
        let floor = add_floor(&mut world, 0.6);
        let shelf = add(&mut world, Body::fixed(Shape::aabb(20.0, 0.2)).at([0.0, 3.0]).user_data(7));
        let ids = [7, 8, 0].map(|number| {
            let x = number as f64;
            add(&mut world, unit_box(1.2 * x - 5.0, 5.0).velocity([0.0, -speed]).user_data(number))
        });
        run(&mut world, 3.0);
        let heights = ids.map(|id| place(&world, id)[1]);
        assert!((heights[0] - 0.5).abs() < 1e-3, "{speed} m/s: {heights:?}");
        assert!((heights[2] - 3.6).abs() < 1e-3, "{speed} m/s: {heights:?}");
        assert_eq!(world.may_collide(shelf, ids[0]), Some(false));
        assert_eq!([ids[1], floor].map(|id| world.may_collide(id, ids[0])), [Some(true); 2]);
        assert!(world.validate().is_ok());
    }
}

/// What stood on the shelf falls once it is refused, asleep or not, and what is within it is pushed out once it is not.
#[test]
fn it_may_be_set_and_taken_away_at_any_time() {
    let mut world = earth_with(Settings { sleep: true, ..Settings::default() });
    world.set_settings(Settings { sleep: true, ..world.settings().clone() }).unwrap();
    add_floor(&mut world, 0.6);
    add(&mut world, Body::fixed(Shape::aabb(20.0, 0.2)).at([0.0, 3.0]).user_data(7));
    let id = add(&mut world, unit_box(0.0, 3.6).user_data(7));
    run(&mut world, 3.0);
    assert!(world.body(id).unwrap().is_sleeping());
    world.set_contact_filter(same_number_passes());
    run(&mut world, 3.0);
    assert!((place(&world, id)[1] - 0.5).abs() < 1e-3);
    world.set_contact_filter(None);
    world.body_mut(id).unwrap().set_position([0.0, 4.0]).unwrap();
    run(&mut world, 3.0);
    assert!((place(&world, id)[1] - 3.6).abs() < 1e-3);
}

/// A heap of numbered boxes and discs.
fn heap(settings: Settings) -> World {
    let mut world = earth_with(settings);
    world.set_contact_filter(same_number_passes());
    add_floor(&mut world, 0.6);
    for number in 0..120_u32 {
        let shape = if number % 2 == 0 { Shape::circle(0.4) } else { Shape::rectangle(0.7, 0.9) };
        let at = [f64::from(number % 8) * 0.9 - 4.0, 1.0 + f64::from(number / 8)];
        add(&mut world, Body::dynamic(shape).at(at).density(1.0).user_data(u64::from(number % 5)));
    }
    world
}

#[test]
fn clones_and_threads_give_the_same_bits() {
    let mut world = heap(Settings::default());
    let mut threaded = heap(Settings { threads: 3, ..Settings::default() });
    run(&mut world, 1.0);
    let mut clone = world.clone();
    let mut target = World::new(Settings::default());
    target.clone_from(&world);
    for one in [&mut world, &mut clone, &mut target] {
        run(one, 1.0);
    }
    run(&mut threaded, 2.0);
    let hashes = [clone.state_hash(), target.state_hash(), threaded.state_hash()];
    assert_eq!(hashes, [world.state_hash(); 3]);
}

/// One that lets all pass changes no bit.
#[test]
fn a_filter_that_refuses_nothing_changes_nothing() {
    let [mut plain, mut asked] = [(); 2].map(|()| heap(Settings::default()));
    plain.set_contact_filter(None);
    asked.set_contact_filter(ContactFilter::new(|_, _| true));
    for world in [&mut plain, &mut asked] {
        run(world, 2.0);
    }
    assert_eq!(plain.state_hash(), asked.state_hash());
}
