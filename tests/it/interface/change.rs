//! Bodies that become something else: the id stays, and contacts as far as they still make sense.

use rustycs::prelude::*;

#[cfg(debug_assertions)]
use crate::support::place_of_panic;
use crate::support::{
    G, add, add_floor, assert_near, assert_relative, earth, place, run, space, unit_box, velocity,
};

/// Three boxes on a floor, at rest, and their ids.
fn stack() -> (World, BodyId, [BodyId; 3]) {
    let mut world = earth();
    let floor = add_floor(&mut world, 0.6);
    let ids = [0.5, 1.5, 2.5].map(|y| add(&mut world, unit_box(0.0, y)));
    run(&mut world, 2.0);
    (world, floor, ids)
}

type Change = fn(&mut BodyMut<'_>);

/// None of these moves what stands, or lets it cease to touch.
#[test]
fn a_stack_stands_through_changes_of_the_box_in_its_middle() {
    let changes: [(&str, Change); 9] = [
        ("lighter", |body| body.set_mass(0.1).unwrap()),
        ("heavier", |body| body.set_mass(10.0).unwrap()),
        ("as heavy as before", |body| body.set_mass(None).unwrap()),
        ("denser", |body| body.set_density(2.0).unwrap()),
        ("of stone", |body| body.set_material(Material { restitution: 0.0, ..Material::STONE }).unwrap()),
        ("upright", |body| body.set_fixed_rotation(true)),
        ("wider", |body| body.set_shape(Shape::rectangle(1.2, 1.0)).unwrap()),
        ("never turning", |body| body.set_shape(Shape::aabb(1.0, 1.0)).unwrap()),
        ("fixed", |body| body.set_body_type(BodyType::Fixed).unwrap()),
    ];
    let (standing, _, ids) = stack();
    for (name, change) in changes {
        let mut world = standing.clone();
        let before = ids.map(|id| place(&world, id));
        change(&mut world.body_mut(ids[1]).unwrap());
        world.validate().unwrap();
        for _ in 0..120 {
            world.step();
            world.validate().unwrap();
            let events = world.events();
            assert!(events.began().is_empty() && events.ended().is_empty(), "{name}: {events:?}");
        }
        for (id, before) in ids.into_iter().zip(before) {
            // They sag with what they bear, by less than a centimetre under 10 kg.
            let [x, y] = place(&world, id);
            assert_near(x, before[0], 1e-4, name);
            assert_near(y, before[1], 1e-2, name);
        }
    }
}

/// What was heavy and is light is not thrown by the impulse that bore it, and bears m g h per substep after a while.
#[test]
fn a_body_that_becomes_light_is_not_thrown() {
    let mut world = earth();
    let floor = add_floor(&mut world, 0.6);
    let id = add(&mut world, unit_box(0.0, 0.5).mass(1000.0));
    run(&mut world, 2.0);
    world.body_mut(id).unwrap().set_mass(1.0).unwrap();
    for _ in 0..60 {
        world.step();
        assert!(velocity(&world, id)[1].abs() < 0.02, "{:?}", velocity(&world, id));
    }
    let contact = world.contact_between(floor, id).unwrap();
    let borne: f32 = contact.points().iter().map(|point| point.normal_impulse).sum();
    assert_relative(f64::from(borne), G / 240.0, 1e-3, "m g h");
}

/// a = F / m, with the mass of now.
#[test]
fn mass_and_inertia_follow_from_what_was_set() {
    let mut world = space();
    let id = add(&mut world, Body::dynamic(Shape::rectangle(2.0, 1.0)).density(3.0));
    let masses = |world: &World| {
        let body = world.body(id).unwrap();
        [body.mass(), body.inertia()].map(f64::from)
    };
    // m (a² + b²) / 12
    assert_eq!(masses(&world), [6.0, 2.5]);
    world.body_mut(id).unwrap().set_mass(12.0).unwrap();
    assert_eq!((masses(&world), world.body(id).unwrap().mass_override()), ([12.0, 5.0], Some(12.0)));
    world.body_mut(id).unwrap().apply_force([60.0, 0.0]);
    world.step();
    assert_relative(velocity(&world, id)[0], 60.0 / 12.0 / 60.0, 1e-6, "F t / m");
    world.body_mut(id).unwrap().set_density(1.0).unwrap();
    assert_eq!(masses(&world), [12.0, 5.0], "the mass that was given stays");
    world.body_mut(id).unwrap().set_mass(None).unwrap();
    assert_relative(masses(&world)[0], 2.0, 1e-6, "density times area");
    world.body_mut(id).unwrap().set_shape(Shape::circle(1.0)).unwrap();
    assert_relative(masses(&world)[0], core::f64::consts::PI, 1e-6, "of a disc");
    assert_relative(masses(&world)[1], 0.5 * core::f64::consts::PI, 1e-6, "m r² / 2");
    world.body_mut(id).unwrap().set_fixed_rotation(true);
    assert_eq!(masses(&world)[1], f64::INFINITY);
}

/// It keeps its velocity through what moves, and falls by g t²/2 once it is dynamic.
#[test]
fn a_body_moves_as_its_type_says() {
    let mut world = earth();
    let id = add(&mut world, unit_box(0.0, 100.0).velocity([3.0, 0.0]).angular_velocity(1.0));
    let set = |world: &mut World, body_type| {
        let mut body = world.body_mut(id).unwrap();
        body.set_body_type(body_type).unwrap();
        assert_eq!(body.body_type(), body_type);
        world.validate().unwrap();
        run(world, 0.5);
        world.validate().unwrap();
    };
    set(&mut world, BodyType::Kinematic);
    assert_eq!((velocity(&world, id), world.body(id).unwrap().mass()), ([3.0, 0.0], f32::INFINITY));
    assert_near(place(&world, id)[0], 1.5, 1e-5, "x");
    assert_near(place(&world, id)[1], 100.0, 1e-9, "y");
    set(&mut world, BodyType::Dynamic);
    assert_near(place(&world, id)[0], 3.0, 1e-5, "x");
    assert_near(100.0 - place(&world, id)[1], 0.5 * G * 0.25, 1e-5, "g t²/2");
    let before = world.body(id).unwrap().pose();
    set(&mut world, BodyType::Fixed);
    let body = world.body(id).unwrap();
    assert_eq!((body.pose(), body.velocity(), body.angular_velocity()), (before, Vec2::ZERO, 0.0));
    set(&mut world, BodyType::Dynamic);
    assert_near(before.center.y - place(&world, id)[1], 0.5 * G * 0.25, 1e-5, "g t²/2 from rest");
}

/// The lowest box is held, then let go with what lies on it.
#[test]
fn what_lies_on_a_body_feels_its_type() {
    let (mut world, floor, ids) = stack();
    world.body_mut(ids[0]).unwrap().set_body_type(BodyType::Fixed).unwrap();
    world.step();
    // Two bodies that do not move have no contact.
    assert!(world.events().ended().iter().any(|event| [event.a, event.b] == [floor, ids[0]]));
    assert!(world.contact_between(floor, ids[0]).is_none());
    assert!(world.contact_between(ids[0], ids[1]).is_some());
    world.remove(floor);
    run(&mut world, 1.0);
    assert_near(place(&world, ids[2])[1], 2.5, 1e-2, "held");
    world.body_mut(ids[0]).unwrap().set_body_type(BodyType::Dynamic).unwrap();
    world.validate().unwrap();
    run(&mut world, 0.5);
    assert_near(2.5 - place(&world, ids[2])[1], 0.5 * G * 0.25, 2e-2, "all fall");
}

/// Two fixed boxes on a fixed floor have no contacts; those of the one that becomes dynamic are found then.
#[test]
fn a_body_that_becomes_dynamic_finds_what_is_beside_it() {
    for first in [BodyType::Fixed, BodyType::Kinematic] {
        let mut world = earth();
        let floor = add_floor(&mut world, 0.6);
        let as_is = |body: Body| if first == BodyType::Fixed { body } else { body.velocity([0.0, 0.0]) };
        let body = |y| {
            let shape = Shape::rectangle(1.0, 1.0);
            let body = if first == BodyType::Fixed { Body::fixed(shape) } else { Body::kinematic(shape) };
            as_is(body.at([0.0, y]).density(1.0).restitution(0.0))
        };
        let [low, high] = [0.5, 1.5].map(|y| add(&mut world, body(y)));
        run(&mut world, 0.1);
        assert_eq!(world.contacts().count(), 0);
        world.body_mut(high).unwrap().set_body_type(BodyType::Dynamic).unwrap();
        world.step();
        assert!(world.contact_between(low, high).is_some_and(|contact| contact.is_touching()));
        assert!(world.contact_between(low, floor).is_none());
        world.body_mut(low).unwrap().set_body_type(BodyType::Dynamic).unwrap();
        world.step();
        assert!(world.contact_between(floor, low).is_some_and(|contact| contact.is_touching()));
        run(&mut world, 1.0);
        assert_near(place(&world, high)[1], 1.5, 1e-2, "they stand");
    }
}

/// A ball grows on the floor: it is pushed up to its new radius, weighs as much as that is, and rolls on.
#[test]
fn a_ball_that_grows_keeps_touching_the_floor() {
    let mut world = earth();
    let floor = add_floor(&mut world, 0.6);
    let ball = Body::dynamic(Shape::circle(0.5)).at([0.0, 0.5]).density(1.0).restitution(0.0);
    let id = add(&mut world, ball);
    run(&mut world, 1.0);
    for step in 1..=50 {
        let radius = 0.5 + 0.01 * step as f32;
        world.body_mut(id).unwrap().set_shape(Shape::circle(radius)).unwrap();
        world.validate().unwrap();
        world.step();
        assert!(world.contact_between(id, floor).is_some_and(|contact| contact.is_touching()));
        assert!(world.events().ended().is_empty() && world.events().began().is_empty());
    }
    run(&mut world, 1.0);
    assert_near(place(&world, id)[1], 1.0, 5e-3, "height");
    assert_relative(f64::from(world.body(id).unwrap().mass()), core::f64::consts::PI, 1e-5, "mass");
}

/// Discs and boxes that touch a wall become smaller ones of either kind: the contact ends in the next step, and is told to.
#[test]
fn a_body_that_shrinks_away_from_a_wall_ends_its_contact() {
    let shapes = [Shape::circle(0.5), Shape::rectangle(1.0, 1.0)];
    let smaller = [Shape::circle(0.3), Shape::rectangle(0.6, 0.6)];
    for (shape, small) in shapes.into_iter().flat_map(|shape| smaller.map(|small| (shape, small))) {
        let mut world = World::new(Settings::default());
        add(&mut world, Body::fixed(Shape::rectangle(1.0, 1.0)));
        let id = add(&mut world, Body::dynamic(shape).at([1.0, 0.0]));
        run(&mut world, 0.1);
        world.body_mut(id).unwrap().set_shape(small).unwrap();
        world.step();
        let ended: Vec<_> = world.events().ended().iter().filter_map(|event| event.other(id)).collect();
        assert_eq!(ended.len(), 1, "{shape:?} to {small:?}");
        assert!(world.contacts_of(id).all(|contact| !contact.is_touching()));
    }
}

/// Each value that a description was given can be read, of it and of the body.
#[test]
fn every_value_of_a_description_can_be_read() {
    let mut world = space();
    let body = Body::dynamic(Shape::rectangle(2.0, 1.0))
        .at([3.0, 4.0])
        .angle(0.5)
        .velocity([1.0, 2.0])
        .angular_velocity(0.25)
        .material(Material::METAL)
        .density(2.0)
        .friction(0.3)
        .restitution(0.9)
        .mass(7.0)
        .gravity_scale(-1.0)
        .linear_damping(0.1)
        .angular_damping(0.2)
        .may_sleep(false)
        .user_data(9);
    assert_eq!((body.get_body_type(), body.get_position()), (BodyType::Dynamic, Point::new(3.0, 4.0)));
    assert_eq!((body.get_angle(), body.get_velocity()), (0.5, Vec2::new(1.0, 2.0)));
    let material = Material { density: 2.0, friction: 0.3, restitution: 0.9 };
    let id = add(&mut world, body.clone());
    let view = world.body(id).unwrap();
    for of in [&body, &view.describe()] {
        assert_eq!((of.get_shape(), of.get_material(), of.get_mass()), (view.shape(), material, Some(7.0)));
        assert_eq!((of.get_gravity_scale(), of.get_user_data()), (-1.0, 9));
        assert_eq!((of.get_linear_damping(), of.get_angular_damping()), (0.1, 0.2));
        assert_eq!((of.get_fixed_rotation(), of.get_may_sleep()), (false, false));
        assert_eq!(of.get_angular_velocity(), 0.25);
    }
    assert_eq!((view.density(), view.friction(), view.restitution()), (2.0, 0.3, 0.9));
    assert_eq!((view.mass_override(), view.fixed_rotation()), (Some(7.0), false));
    // A view that changes a body reads it too.
    let mut body = world.body_mut(id).unwrap();
    let faster = 2.0 * body.velocity();
    body.set_velocity(faster);
    assert_eq!((body.velocity(), body.position_f64()), (Vec2::new(2.0, 4.0), [3.0, 4.0]));
    assert!(body.contains([3.0, 4.0]) && body.velocity_at(body.position()) == faster);
}

#[test]
fn worlds_are_cleared_and_thinned_out() {
    let mut world = World::default();
    assert_eq!(world.settings(), &Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    let floor = add_floor(&mut world, 0.6);
    let ids: Vec<BodyId> =
        (0..10_u32).map(|i| add(&mut world, unit_box(f64::from(i), 0.5).user_data(i.into()))).collect();
    run(&mut world, 1.0);
    world.retain(|body| body.user_data() % 2 == 0);
    world.validate().unwrap();
    assert_eq!((world.body_count(), world.body(floor).is_some()), (6, true));
    assert!(ids.iter().enumerate().all(|(i, &id)| world.body(id).is_some() == (i % 2 == 0)));
    let time = world.time();
    world.clear();
    world.validate().unwrap();
    assert_eq!((world.body_count(), world.contacts().count(), world.time()), (0, 0, time));
    assert_eq!(world.acceleration(), Force::EARTH_GRAVITY.acceleration());
    world.step();
    assert!(world.body(floor).is_none());
}

/// A table beside the world needs no more places than there were bodies at once.
#[test]
fn indices_are_dense_and_used_again() {
    let mut world = space();
    let ids: Vec<BodyId> = (0..5).map(|i| add(&mut world, unit_box(3.0 * f64::from(i), 0.0))).collect();
    assert_eq!(ids.iter().map(|id| id.index()).collect::<Vec<_>>(), [0, 1, 2, 3, 4]);
    world.remove(ids[2]);
    let again = add(&mut world, unit_box(0.0, 9.0));
    assert_eq!((again.index(), again == ids[2]), (2, false));
}

/// It gets there within a tick, and stops; each tick anew it follows a path, and what stands on it rides along.
#[test]
fn a_kinematic_body_moves_to_a_pose_and_stops_there() {
    let mut world = earth();
    let lift = add(&mut world, Body::kinematic(Shape::rectangle(4.0, 1.0)).at([0.0, -0.5]).restitution(0.0));
    let load = add(&mut world, unit_box(0.0, 0.5));
    let target = Pose::new([0.01, -0.48], 0.02);
    world.body_mut(lift).unwrap().move_to(target);
    assert_relative(velocity(&world, lift)[0], 0.6, 1e-6, "velocity on the way");
    for _ in 0..3 {
        world.step();
        let pose = world.body(lift).unwrap().pose();
        assert_near(pose.center.distance(target.center), 0.0, 1e-8, "where it was to be");
        assert_near(f64::from(pose.rotation.angle()), 0.02, 1e-7, "turned as it was to be");
        assert_eq!((velocity(&world, lift), world.body(lift).unwrap().angular_velocity()), ([0.0, 0.0], 0.0));
    }
    // At 1 m/s for two seconds.
    world.body_mut(lift).unwrap().set_pose(Pose::at([0.0, -0.5])).unwrap();
    world.body_mut(load).unwrap().set_pose(Pose::at([0.0, 0.5])).unwrap();
    world.body_mut(load).unwrap().set_velocity([0.0, 0.0]).set_angular_velocity(0.0);
    for step in 1..=120 {
        let height = -0.5 + f64::from(step) / 60.0;
        world.body_mut(lift).unwrap().move_to(Pose::at([0.0, height]));
        world.step();
        assert_near(place(&world, lift)[1], height, 1e-7, "on its path");
    }
    assert_near(place(&world, load)[1], 2.5, 1e-2, "the load rides along");
    // A velocity that is set meanwhile holds.
    world.body_mut(lift).unwrap().move_to(Pose::at([9.0, 9.0])).set_velocity([1.0, 0.0]);
    world.step();
    assert_eq!(velocity(&world, lift), [1.0, 0.0]);
}

/// It stays where it is, in mid-air and before the first step, until something wakes it.
#[test]
fn a_body_can_be_put_to_sleep() {
    let mut world = World::default();
    world.add_force(Force::EARTH_GRAVITY);
    let floor = add_floor(&mut world, 0.6);
    let ids = [0.5, 1.49, 9.0].map(|y| add(&mut world, unit_box(0.0, y).velocity([0.0, 0.1])));
    world.body_mut(ids[2]).unwrap().apply_force([60.0, 0.0]);
    for id in ids {
        assert!(world.body_mut(id).unwrap().sleep());
        world.validate().unwrap();
    }
    assert!(!world.body_mut(floor).unwrap().sleep());
    let before = ids.map(|id| world.body(id).unwrap().pose());
    run(&mut world, 1.0);
    world.validate().unwrap();
    assert!(ids.iter().all(|&id| world.body(id).unwrap().is_sleeping()));
    assert_eq!(ids.map(|id| world.body(id).unwrap().pose()), before);
    world.body_mut(ids[2]).unwrap().wake();
    run(&mut world, 0.5);
    assert_near(
        9.0 - place(&world, ids[2])[1],
        0.5 * G * 0.25,
        1e-5,
        "it falls from rest, without the force",
    );
    run(&mut world, 3.0);
    assert!(place(&world, ids[2])[1] > 2.3, "it lies on the others, which it woke");
}

/// A stack that rests goes to sleep as a whole, and wakes as a whole.
#[test]
fn sleep_takes_the_whole_island() {
    let (mut world, _, ids) = stack();
    assert!(world.body_mut(ids[0]).unwrap().sleep());
    assert!(ids.iter().all(|&id| world.body(id).unwrap().is_sleeping()));
    assert_eq!(world.sleeping_islands(), 1);
    world.validate().unwrap();
    world.body_mut(ids[2]).unwrap().wake();
    assert!(ids.iter().all(|&id| !world.body(id).unwrap().is_sleeping()));
    world.body_mut(ids[1]).unwrap().set_may_sleep(false);
    assert!(!world.body_mut(ids[0]).unwrap().sleep());
    assert_eq!(world.sleeping_islands(), 0);
}

/// What is refused in a release build is told by the next step, and by that alone.
#[test]
#[cfg(not(debug_assertions))]
fn what_is_refused_is_reported_once() {
    let mut world = space();
    let id = add(&mut world, unit_box(0.0, 0.0));
    world
        .body_mut(id)
        .unwrap()
        .apply_force([f32::NAN, 0.0])
        .set_velocity([1.0, 0.0])
        .move_to(Pose::default());
    world.step();
    let texts: Vec<String> =
        world.events().refused().iter().map(|refusal| refusal.error.to_string()).collect();
    assert_eq!(
        texts,
        [
            "the force is NaN N; give a finite number from -1e18 to 1e18 N",
            "a body that is dynamic cannot be moved to a pose; give it one by set_pose, or make it kinematic"
        ]
    );
    assert_eq!((world.events().refused()[0].body, velocity(&world, id)), (id, [1.0, 0.0]));
    world.step();
    assert!(world.events().refused().is_empty());
}

/// And in a debug build it panics at the line of the caller.
#[test]
#[cfg(debug_assertions)]
fn what_is_refused_panics_where_it_was_asked_for() {
    let mut world = space();
    let id = add(&mut world, unit_box(0.0, 0.0));
    let place = place_of_panic(|| _ = world.body_mut(id).unwrap().apply_torque(f32::NAN));
    assert_eq!(place, Some((file!().to_owned(), line!() - 1)));
}
