//! Sensors: what they tell is what overlaps them, by looking at all pairs.

use std::collections::BTreeSet;

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::collision::detect;
use rustycs::prelude::*;

use crate::support::{add, add_floor, earth, place, run, space, unit_box};

type Random = Xoshiro256PlusPlus;
type Overlaps = BTreeSet<(BodyId, BodyId)>;

fn overlaps_by_looking_at_all(world: &World) -> Overlaps {
    let mut found = Overlaps::new();
    for (sensor, of_sensor) in world.bodies().filter(|(_, body)| body.is_sensor()) {
        for (body, of_body) in world.bodies().filter(|&(body, _)| body != sensor) {
            let overlaps =
                || detect(of_sensor.shape(), of_sensor.pose(), of_body.shape(), of_body.pose()).is_some();
            if of_sensor.filter().collides_with(of_body.filter()) && overlaps() {
                found.insert((sensor, body));
            }
        }
    }
    found
}

fn random_body(random: &mut Random) -> Body {
    let (width, height) = (random.random_range(0.3..2.0_f32), random.random_range(0.3..2.0_f32));
    let shape = match random.random_range(0..3_u32) {
        0 => Shape::circle(0.5 * width),
        1 => Shape::aabb(width, height),
        _ => Shape::obb(width, height),
    };
    let body = match random.random_range(0..5_u32) {
        0 => Body::fixed(shape),
        1 => Body::kinematic(shape),
        _ => Body::dynamic(shape),
    };
    let mut any = |reach: f32| random.random_range(-reach..reach);
    let (at, velocity, spin) = ([any(5.0), any(5.0).abs()], [any(3.0), any(3.0)], any(3.0));
    let filter =
        Filter { category: 1 << random.random_range(0..2_u32), mask: random.random_range(1..4), group: 0 };
    body.at(at)
        .velocity(velocity)
        .angular_velocity(spin)
        .filter(filter)
        .sensor(random.random_range(0..3) == 0)
}

/// One edit of a world, of any kind that may change what overlaps.
fn edit(world: &mut World, ids: &mut Vec<BodyId>, random: &mut Random) {
    let id = ids[random.random_range(0..ids.len())];
    let other = random_body(random);
    let Some(mut body) = world.body_mut(id) else {
        ids.push(add(world, other));
        return;
    };
    match random.random_range(0..9_u32) {
        0 => _ = world.remove(id),
        1 => body.set_position(other.get_position()).unwrap(),
        2 => body.set_sensor(other.get_sensor()),
        3 => body.set_filter(other.get_filter()),
        4 => body.set_body_type(other.get_body_type()).unwrap(),
        5 => body.set_shape(*other.get_shape()).unwrap(),
        6 => _ = body.sleep(),
        7 => body.set_angle(other.get_angular_velocity()).unwrap(),
        _ => _ = body.set_velocity(other.get_velocity()),
    }
}

/// Through a thousand edits, steps and naps. Nothing is so fast as to go through a sensor within a step.
#[test]
fn sensors_tell_what_overlaps_them_whatever_is_done_to_bodies() {
    let mut random = Random::seed_from_u64(21);
    let mut world = World::new(Settings { max_speed: 8.0, ..Settings::default() });
    world.add_force(Force::EARTH_GRAVITY);
    add_floor(&mut world, 0.6);
    let mut ids: Vec<BodyId> = (0..40).map(|_| add(&mut world, random_body(&mut random))).collect();
    let (mut before, mut told) = (Overlaps::new(), 0);
    for tick in 0..1500 {
        // Half of the time nobody touches anything.
        if tick % 300 < 150 {
            (0..random.random_range(0..4)).for_each(|_| edit(&mut world, &mut ids, &mut random));
        }
        world.step();
        world.validate().unwrap();
        let now = overlaps_by_looking_at_all(&world);
        let set = |events: &[SensorEvent]| {
            let list: Vec<_> = events.iter().map(|event| (event.sensor, event.body)).collect();
            assert!(list.is_sorted(), "tick {tick}: {list:?}");
            list.into_iter().collect::<Overlaps>()
        };
        let (began, ended) = (set(world.events().sensor_began()), set(world.events().sensor_ended()));
        let passed: Overlaps = began.intersection(&ended).copied().collect();
        assert!(passed.is_disjoint(&now) && passed.is_disjoint(&before), "tick {tick}");
        assert_eq!(&began - &passed, &now - &before, "tick {tick}");
        assert_eq!(&ended - &passed, &before - &now, "tick {tick}");
        for (sensor, _) in world.bodies() {
            let expected = now.iter().filter(|&&(of, _)| of == sensor).map(|&(_, body)| body);
            assert!(world.sensor_overlaps(sensor).eq(expected), "tick {tick}");
        }
        told += began.len();
        before = now;
    }
    assert!(told > 500, "{told} events: a test of nothing");
}

/// Bit for bit.
#[test]
fn a_sensor_is_as_if_it_were_not_there() {
    let fall = |with_sensors: bool| {
        let mut world = earth();
        let ids = [0.5, 1.6, 2.7].map(|y| add(&mut world, unit_box(0.1 * y, y).restitution(0.3)));
        add_floor(&mut world, 0.6);
        if with_sensors {
            add(&mut world, Body::fixed(Shape::circle(1.0)).at([0.0, 0.5]).sensor(true));
            add(&mut world, Body::kinematic(Shape::obb(4.0, 0.1)).angular_velocity(2.0).sensor(true));
            add(&mut world, unit_box(0.5, 5.0).sensor(true));
        }
        run(&mut world, 2.0);
        ids.map(|id| (world.body(id).unwrap().pose(), world.body(id).unwrap().velocity()))
    };
    assert_eq!(fall(true), fall(false));
}

/// A sensor 2 cm thin, from 1 m/s to 1 km/s, which is 17 m per step: each passes once, in whatever step; and a sensor as fast
/// that passes a ball.
#[test]
fn nothing_passes_a_thin_sensor_unseen() {
    for is_moved in [false, true] {
        for speed in [1.0_f32, 3.0, 10.0, 77.0, 300.0, 1000.0] {
            let mut world = space();
            let [gate, ball] = [
                add(&mut world, Body::kinematic(Shape::aabb(0.02, 3.0)).sensor(true)),
                add(&mut world, Body::dynamic(Shape::circle(0.1)).at([-1.5, 1.0])),
            ];
            let (mover, along) = if is_moved { (gate, -speed) } else { (ball, speed) };
            world.body_mut(mover).unwrap().set_velocity([along, 0.0]);
            let [mut began, mut ended] = [0, 0];
            // 3 m, and a tick more.
            for _ in 0..=(3.0 / speed * 60.0).ceil() as u32 {
                world.step();
                began += world.events().sensor_began().len();
                ended += world.events().sensor_ended().len();
                assert!(began >= ended);
            }
            assert_eq!([began, ended], [1, 1], "{speed} m/s, the gate moves: {is_moved}");
        }
    }
}

/// What goes beside a sensor, or was put on the other side, has not passed it.
#[test]
fn what_has_not_passed_is_not_seen() {
    let mut world = space();
    add(&mut world, Body::fixed(Shape::aabb(0.02, 3.0)).sensor(true));
    let beside = add(&mut world, Body::dynamic(Shape::circle(0.1)).at([-1.0, 1.65]).velocity([300.0, 0.0]));
    let put = add(&mut world, Body::dynamic(Shape::circle(0.1)).at([-1.0, 0.0]));
    world.step();
    assert!(place(&world, beside)[0] > 1.0);
    world.body_mut(put).unwrap().set_position([1.0, 0.0]).unwrap();
    world.step();
    assert!(world.events().sensor_began().is_empty() && world.events().sensor_ended().is_empty());
}

/// In a world at rest the stage does not run; a sensor that is put there and taken away wakes nobody and is told of.
#[test]
fn sensors_see_what_sleeps_and_let_it_sleep() {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    let floor = add_floor(&mut world, 0.6);
    let id = add(&mut world, unit_box(0.0, 0.5));
    run(&mut world, 3.0);
    assert!(world.body(id).unwrap().is_sleeping());
    let zone = add(&mut world, Body::fixed(Shape::circle(2.0)).sensor(true));
    world.step();
    let began: Vec<BodyId> = world.events().sensor_began().iter().map(|event| event.body).collect();
    assert_eq!(began, [floor, id]);
    for _ in 0..10 {
        world.step();
        assert!(!world.profile().stage(Stage::Sensors).ran);
        assert!(world.sensor_overlaps(zone).eq([floor, id]));
    }
    assert!(world.body(id).unwrap().is_sleeping());
    world.remove(floor);
    assert!(world.sensor_overlaps(zone).eq([id]), "what was removed is no body any more");
    world.body_mut(zone).unwrap().set_position([50.0, 0.0]).unwrap();
    world.step();
    let ended: Vec<BodyId> = world.events().sensor_ended().iter().map(|event| event.body).collect();
    assert_eq!(ended, [floor, id]);
}

/// The events of all ticks of a frame, in order of time, and the same in a clone.
#[test]
fn a_frame_has_the_sensor_events_of_all_its_ticks() {
    let mut world = space();
    for x in [1.0, 3.0, 2.0] {
        add(&mut world, Body::fixed(Shape::aabb(0.2, 3.0)).at([x, 0.0]).sensor(true));
    }
    let ball = add(&mut world, Body::dynamic(Shape::circle(0.1)).velocity([40.0, 0.0]));
    let mut fork = World::default();
    fork.clone_from(&world);
    world.advance(0.12);
    assert_eq!(fork.advance(0.12), 7);
    let order = |world: &World| -> Vec<f64> {
        world.events().sensor_began().iter().map(|event| place(world, event.sensor)[0]).collect()
    };
    assert_eq!(order(&world), [1.0, 2.0, 3.0]);
    assert_eq!((order(&fork), fork.state_hash()), (order(&world), world.state_hash()));
    assert!(world.events().sensor_ended().iter().all(|event| event.body == ball));
}

#[test]
fn queries_for_what_is_in_the_way_pass_sensors_unless_asked() {
    let mut world = space();
    let zone = add(&mut world, Body::fixed(Shape::circle(1.0)).sensor(true));
    let (all, with_sensors) = (QueryFilter::new(), QueryFilter::new().sensors(true));
    assert_eq!(world.ray_cast([-5.0, 0.0], [10.0, 0.0]), None);
    assert_eq!(world.ray_cast_with([-5.0, 0.0], [10.0, 0.0], &with_sensors).unwrap().body, zone);
    assert_eq!(world.closest([-5.0, 0.0], 10.0, &all), None);
    assert_eq!(world.bodies_at([0.0, 0.0]), [zone]);
    assert!(world.remove(zone).unwrap().get_sensor());
}
