//! Each shape of a body is something for itself: to filters, sensors, belts and queries.

use rustycs::prelude::*;

use crate::support::{add, add_floor, earth, run, space, velocity};

fn collider_of(world: &World, body: BodyId, number: usize) -> ColliderId {
    world.body(body).unwrap().colliders().nth(number).unwrap().id()
}

#[test]
fn a_foot_that_is_a_sensor_tells_what_is_below_and_weighs_and_holds_nothing() {
    let mut world = earth();
    let floor = add_floor(&mut world, 0.5);
    let foot = Collider::new(Shape::rectangle(0.5, 0.2)).at([0.0, -0.55]).sensor(true);
    let player =
        add(&mut world, Body::dynamic(Shape::rectangle(0.8, 1.0)).with(foot).at([0.0, 2.0]).restitution(0.0));
    let mut began = None;
    for tick in 0..120 {
        world.step();
        for event in world.events().sensor_began() {
            assert_eq!((event.sensor, event.body), (player, floor));
            assert_eq!(event.collider, collider_of(&world, player, 1));
            assert!(world.events().began().is_empty(), "the foot is there before the body");
            began.get_or_insert(tick);
        }
    }
    assert!(began.is_some());
    assert!(world.sensor_overlaps(player).eq([floor]));
    let height = world.body(player).unwrap().position().y;
    assert!((height - 0.5).abs() < 1e-3, "it stands on its body, at {height} m");
    world.body_mut(player).unwrap().set_position([0.0, 5.0]).unwrap();
    world.step();
    assert_eq!(world.events().sensor_ended().len(), 1);
}

/// What several shapes of a sensor overlap is told once for each of them, and listed once.
#[test]
fn a_body_in_two_parts_of_a_sensor_is_listed_once() {
    let mut world = space();
    let zone = Body::fixed(Shape::aabb(4.0, 4.0)).sensor(true);
    let zone = add(&mut world, zone.with(Collider::new(Shape::aabb(4.0, 4.0)).at([3.0, 0.0]).sensor(true)));
    let ball = add(&mut world, Body::dynamic(Shape::circle(0.2)).at([1.5, 0.0]));
    world.step();
    assert_eq!(world.events().sensor_began().len(), 2);
    assert!(world.sensor_overlaps(zone).eq([ball]));
    assert!(world.contacts_of(ball).next().is_none());
}

#[test]
fn a_filter_is_that_of_a_shape_and_of_the_body_where_it_has_none() {
    const GHOSTS: u64 = 0x2;
    let mut world = space();
    // A gate: a post that holds all, and a bar that lets ghosts through.
    let bar = Filter { mask: !GHOSTS, ..Filter::DEFAULT };
    let gate = Body::fixed(Shape::aabb(0.5, 2.0))
        .with(Collider::new(Shape::aabb(0.5, 2.0)).at([0.0, 2.0]).filter(bar));
    add(&mut world, gate);
    let ball = |y: f64, category: u64| {
        let filter = Filter { category, ..Filter::DEFAULT };
        Body::dynamic(Shape::circle(0.2)).at([-2.0, y]).velocity([4.0, 0.0]).filter(filter)
    };
    let stopped =
        [add(&mut world, ball(0.0, 1)), add(&mut world, ball(2.0, 1)), add(&mut world, ball(0.5, GHOSTS))];
    let passes = add(&mut world, ball(1.5, GHOSTS));
    run(&mut world, 1.0);
    for id in stopped {
        assert!(world.body(id).unwrap().position().x < 0.0, "{id:?}");
    }
    assert!(world.body(passes).unwrap().position().x > 1.0);
}

#[test]
fn a_belt_is_one_shape_of_a_machine_and_carries_what_lies_on_it() {
    let mut world = earth();
    let belt = Collider::new(Shape::aabb(10.0, 1.0)).at([10.0, 0.0]).surface_speed(2.0).friction(1.0);
    add(&mut world, Body::fixed(Shape::aabb(10.0, 1.0)).with(belt).friction(1.0));
    let crate_at =
        |x: f64| Body::dynamic(Shape::rectangle(1.0, 1.0)).at([x, 1.0]).friction(1.0).restitution(0.0);
    let [lies, rides] = [0.0, 8.0].map(|x| add(&mut world, crate_at(x)));
    run(&mut world, 2.0);
    assert!(velocity(&world, lies)[0].abs() < 1e-3);
    assert!((velocity(&world, rides)[0] - 2.0).abs() < 1e-3);
}

/// Shapes are what their body is told to be, unless they are told otherwise; and what the body is told later holds for all of
/// them.
#[test]
fn what_a_body_is_told_holds_for_all_its_shapes_that_are_not_told_otherwise() {
    let mut world = space();
    let at = |x: f32| Collider::new(Shape::circle(0.5)).at([x, 0.0]);
    let own = at(2.0).surface_speed(-1.0).rolling_resistance(0.2).friction_mix(Mix::Max).friction(0.9);
    let body = Body::fixed(Shape::circle(0.5)).with(at(1.0)).with(own).with(at(3.0).sensor(true));
    let body = body.surface_speed(2.0).rolling_resistance(0.1).friction_mix(Mix::Min).friction(0.3);
    let id = add(&mut world, body.one_way([0.0, 1.0]));
    let told = |world: &World| -> Vec<_> {
        let of = |collider: ColliderRef<'_>| {
            let is = (collider.is_sensor(), collider.one_way());
            let surface = (collider.surface_speed(), collider.friction(), collider.rolling_resistance());
            (is, surface, collider.friction_mix())
        };
        world.body(id).unwrap().colliders().map(of).collect()
    };
    let (up, of_body) = (Some(Vec2::Y), (2.0, 0.3, 0.1));
    let expected = [
        ((false, up), of_body, Some(Mix::Min)),
        ((false, up), of_body, Some(Mix::Min)),
        ((false, up), (-1.0, 0.9, 0.2), Some(Mix::Max)),
        ((true, up), of_body, Some(Mix::Min)),
    ];
    assert_eq!(told(&world), expected);
    // Described and added again it is the same.
    let again = world.body(id).unwrap().describe();
    world.remove(id);
    let id = add(&mut world, again);
    let mut of_all = world.body_mut(id).unwrap();
    of_all.set_surface_speed(3.0).set_friction_mix(None);
    of_all.set_one_way(None).unwrap();
    of_all.set_friction(0.5).unwrap();
    of_all.set_rolling_resistance(0.0).unwrap();
    of_all.set_sensor(true);
    for collider in world.body(id).unwrap().colliders() {
        assert_eq!((collider.is_sensor(), collider.one_way(), collider.friction_mix()), (true, None, None));
        let surface = (collider.surface_speed(), collider.friction(), collider.rolling_resistance());
        assert_eq!(surface, (3.0, 0.5, 0.0));
    }
    world.validate().unwrap();
}

/// A belt of links carries along all of its length, and a line that is a sensor stops nothing.
#[test]
fn what_a_chain_is_told_holds_for_all_its_links() {
    let mut world = earth();
    let points = || (0..=20).map(|number| [number as f32 - 10.0, 0.0]);
    add(&mut world, Ground::chain(points()).unwrap().surface_speed(2.0).friction(1.0));
    let line = add(&mut world, Ground::chain(points()).unwrap().at([0.0, 1.5]).sensor(true));
    let crates: Vec<_> = [-7.5_f32, -2.5, 2.5]
        .into_iter()
        .map(|x| {
            let body = Body::dynamic(Shape::rectangle(0.5, 0.5)).at([x, 2.5]).friction(1.0).restitution(0.0);
            add(&mut world, body)
        })
        .collect();
    let mut began = 0;
    for _ in 0..120 {
        world.step();
        began += world.events().sensor_began().iter().filter(|overlap| overlap.sensor == line).count();
    }
    assert!(began >= 3, "each crate falls through the line");
    for id in crates {
        assert!((velocity(&world, id)[0] - 2.0).abs() < 1e-3);
    }
}

#[test]
fn parting_two_bodies_parts_all_of_their_shapes_and_no_body_touches_itself() {
    let mut world = space();
    let pair = || Body::dynamic(Shape::circle(0.6)).with(Collider::new(Shape::circle(0.6)).at([1.0, 0.0]));
    let [one, other] = [0.0, 0.9].map(|y| add(&mut world, pair().at([0.0, y])));
    world.step();
    assert!(world.contacts().all(|contact| contact.a() != contact.b()));
    assert!(world.contacts().count() >= 2, "each lies on two of the other");
    assert_eq!(world.set_collision(one, other, false), Some(true));
    world.validate().unwrap();
    run(&mut world, 0.1);
    assert_eq!((world.contacts().count(), world.may_collide(one, other)), (0, Some(false)));
    world.set_collision(one, other, true);
    world.step();
    assert!(world.contacts().count() >= 2);
}

#[test]
fn queries_name_the_shape_and_list_a_body_once() {
    let mut world = space();
    let gate = Body::fixed(Shape::aabb(1.0, 1.0))
        .at([5.0, 0.0])
        .with(Collider::new(Shape::circle(1.0)).at([4.0, 0.0]).user_data(7));
    let gate = add(&mut world, gate);
    let hits = world.ray_cast_all([0.0, 0.0], [20.0, 0.0]);
    let expected = [collider_of(&world, gate, 0), collider_of(&world, gate, 1)];
    assert!(hits.iter().map(|hit| hit.collider).eq(expected) && hits.iter().all(|hit| hit.body == gate));
    assert_eq!(hits.iter().map(|hit| hit.fraction * 20.0).collect::<Vec<_>>(), [4.5, 8.0]);
    assert_eq!(world.bodies_in([0.0, -1.0], [20.0, 1.0]), [gate]);
    assert_eq!(world.overlaps(&Shape::aabb(10.0, 1.0), Pose::at([7.0, 0.0]), &QueryFilter::new()), [gate]);
    let nearest = world.closest([12.0, 0.0], 10.0, &QueryFilter::new()).unwrap();
    assert_eq!((nearest.collider, nearest.distance), (expected[1], 2.0));
    let cast = world
        .shape_cast(&Shape::circle(0.5), Pose::at([9.0, 5.0]), [0.0, -10.0], &QueryFilter::new())
        .unwrap();
    assert_eq!(cast.collider, expected[1]);
    assert_eq!(world.collider(cast.collider).unwrap().user_data(), 7);
    assert!(
        world.body(gate).unwrap().contains([9.5, 0.0]) && !world.body(gate).unwrap().contains([7.0, 0.0])
    );
    let aabb = world.body(gate).unwrap().aabb();
    assert!(aabb.contains_point([4.6, 0.0].into()) && aabb.contains_point([9.9, 0.0].into()));
}

/// A contact names the shapes that touch, in the order of its bodies.
#[test]
fn a_contact_names_its_shapes() {
    let mut world = earth();
    let floor = add_floor(&mut world, 0.5);
    let leg = Collider::new(Shape::circle(0.5)).at([0.0, -0.5]);
    let body = add(&mut world, Body::dynamic(Shape::rectangle(0.4, 1.0)).with(leg).at([0.0, 1.0]));
    run(&mut world, 0.5);
    let contact = world.contacts_of(body).next().unwrap();
    let names = [collider_of(&world, floor, 0), collider_of(&world, body, 1)];
    assert_eq!((contact.a(), contact.b(), contact.colliders()), (floor, body, names));
}

#[test]
fn each_shape_is_changed_for_itself() {
    let mut world = earth();
    let belt = Collider::new(Shape::aabb(10.0, 1.0)).at([10.0, 0.0]).friction(1.0);
    let machine = add(&mut world, Body::fixed(Shape::aabb(10.0, 1.0)).with(belt).friction(1.0));
    let crate_at =
        |x: f64| Body::dynamic(Shape::rectangle(1.0, 1.0)).at([x, 1.0]).friction(1.0).restitution(0.0);
    let [lies, rides] = [0.0, 8.0].map(|x| add(&mut world, crate_at(x)));
    let [own, belt] = [0, 1].map(|number| collider_of(&world, machine, number));
    world.collider_mut(belt).unwrap().set_surface_speed(2.0);
    run(&mut world, 1.0);
    assert!(velocity(&world, lies)[0].abs() < 1e-3 && (velocity(&world, rides)[0] - 2.0).abs() < 1e-3);
    // What lies on the own shape falls through it once this meets nothing, and the belt still bears.
    world.collider_mut(own).unwrap().set_filter(Filter { mask: 0, ..Filter::DEFAULT });
    world.collider_mut(belt).unwrap().set_surface_speed(0.0);
    assert!(world.collider_mut(belt).unwrap().set_restitution(1.5).is_err());
    run(&mut world, 1.0);
    world.validate().unwrap();
    assert!(world.body(lies).unwrap().position().y < -2.0);
    assert!(
        (world.body(rides).unwrap().position().y - 1.0).abs() < 1e-3
            && velocity(&world, rides)[0].abs() < 1e-3
    );
}

#[test]
fn events_name_the_shapes_that_met() {
    let mut world = space();
    let tip = Collider::new(Shape::circle(0.2)).at([1.0, 0.0]);
    let spear = add(&mut world, Body::dynamic(Shape::rectangle(1.8, 0.1)).with(tip).velocity([5.0, 0.0]));
    let target = add(&mut world, Body::dynamic(Shape::rectangle(1.0, 1.0)).at([2.5, 0.0]));
    let names = [collider_of(&world, spear, 1), collider_of(&world, target, 0)];
    let mut seen = 0;
    for _ in 0..60 {
        world.step();
        let events = world.events();
        let both = |colliders: [ColliderId; 2]| names.iter().all(|name| colliders.contains(name));
        assert!(events.began().iter().all(|event| both(event.colliders)));
        assert!(events.hits().iter().all(|event| both(event.colliders)));
        seen += events.began().len() + events.hits().len();
    }
    assert!(seen >= 2, "it began to touch, and hit");
}
