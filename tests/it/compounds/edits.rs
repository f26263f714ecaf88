//! Changes of bodies of several shapes, and what is refused.

use rustycs::prelude::*;

use crate::support::{add, place, run, space};

fn hammer() -> Body {
    let head = Collider::new(Shape::rectangle(0.2, 0.5)).at([0.6, 0.1]).angle(0.3).density(7.8).user_data(4);
    Body::dynamic(Shape::rectangle(1.0, 0.1)).density(0.6).with(head)
}

#[test]
fn what_is_described_is_what_was_added_and_adds_up_to_the_same() {
    let mut world = space();
    let id = add(&mut world, hammer().at([3.0, -2.0]).angle(0.5).velocity([1.0, 2.0]).angular_velocity(3.0));
    let described = world.body(id).unwrap().describe();
    assert_eq!(described.get_colliders().len(), 1);
    assert_eq!(described.get_colliders()[0].get_position(), [0.6, 0.1].into());
    let again = add(&mut world, described.clone());
    let [one, other] = [id, again].map(|id| world.body(id).unwrap());
    assert!(one.position().distance(other.position()) < 1e-6);
    assert_eq!((one.mass(), one.inertia()), (other.mass(), other.inertia()));
    for (one, other) in one.colliders().zip(other.colliders()) {
        assert!(one.pose().center.distance(other.pose().center) < 1e-6);
        assert_eq!(
            (one.shape(), one.material(), one.user_data()),
            (other.shape(), other.material(), other.user_data())
        );
    }
    // A removed body is gone with all that was of it.
    let head = world.body(id).unwrap().colliders().nth(1).unwrap().id();
    assert_eq!(world.remove(id), Some(described));
    assert!(world.collider(head).is_none() && world.body(id).is_none() && world.remove(id).is_none());
    assert_eq!(world.body_count(), 1);
    world.validate().unwrap();
}

#[test]
fn ids_of_shapes_are_none_of_bodies() {
    let mut world = space();
    let id = add(&mut world, hammer());
    let single = add(&mut world, Body::dynamic(Shape::circle(1.0)).at([9.0, 0.0]));
    for collider in world.body(id).unwrap().colliders() {
        let stolen = BodyId::from_bits(collider.id().to_bits()).unwrap();
        assert!(world.body(stolen).is_none(), "{stolen:?} is a shape of {id:?}");
    }
    assert!(
        world.collider(ColliderId::from_bits(id.to_bits()).unwrap()).is_none(),
        "it has shapes, but is none"
    );
    let own = world.body(single).unwrap().colliders().next().unwrap();
    assert_eq!((own.body(), own.pose()), (single, world.body(single).unwrap().pose()));
    assert_eq!(world.bodies().count(), 2);
}

/// What nothing moves turns about its own shape; made dynamic, its centre of mass is elsewhere, and its shapes stay.
#[test]
fn the_shapes_stay_where_they_are_as_the_type_changes() {
    let mut world = space();
    let id = add(&mut world, hammer().at([1.0, 1.0]).angle(0.4));
    let poses = |world: &World| {
        world.body(id).unwrap().colliders().map(|collider| collider.pose()).collect::<Vec<_>>()
    };
    let (before, center) = (poses(&world), place(&world, id));
    for body_type in
        [BodyType::Fixed, BodyType::Kinematic, BodyType::Dynamic, BodyType::Fixed, BodyType::Dynamic]
    {
        world.body_mut(id).unwrap().set_body_type(body_type).unwrap();
        world.step();
        world.validate().unwrap();
        for (before, now) in before.iter().zip(poses(&world)) {
            assert!(before.center.distance(now.center) < 1e-6, "{body_type}");
        }
        if body_type == BodyType::Dynamic {
            assert!(world.body(id).unwrap().position().distance([center[0] as f32, center[1] as f32]) < 1e-6);
        } else {
            assert_eq!(world.body(id).unwrap().position(), world.body(id).unwrap().origin().to_vec2());
        }
    }
}

#[test]
fn a_shape_is_that_of_one_and_a_material_that_of_all() {
    let mut world = space();
    let id = add(&mut world, hammer());
    let mass = world.body(id).unwrap().mass();
    let mut body = world.body_mut(id).unwrap();
    body.set_shape(Shape::rectangle(1.0, 0.2)).unwrap();
    assert!((body.mass() - (mass + 0.06)).abs() < 1e-5);
    body.set_friction(0.3).unwrap();
    body.set_density(1.2).unwrap();
    let area: f32 = body.view().colliders().map(|collider| collider.shape().area()).sum();
    assert!((body.mass() - 1.2 * area).abs() < 1e-5);
    body.set_pose(Pose::new([5.0, 5.0], 1.0)).unwrap();
    assert_eq!(body.position(), [5.0, 5.0].into());
    assert_eq!(world.body(id).unwrap().friction(), 0.3);
    world.validate().unwrap();
    run(&mut world, 0.1);
    world.validate().unwrap();
}

#[test]
fn bad_shapes_are_refused_whole() {
    let mut world = space();
    let good = || Body::dynamic(Shape::circle(1.0));
    let bad = [
        Collider::new(Shape::circle(-1.0)),
        Collider::new(Shape::circle(1.0)).at([f32::NAN, 0.0]),
        Collider::new(Shape::circle(1.0)).at([0.0, 1e9]),
        Collider::new(Shape::circle(1.0)).angle(f32::INFINITY),
        Collider::new(Shape::circle(1.0)).density(0.0),
        Collider::new(Shape::circle(1.0)).friction(-0.1),
        Collider::new(Shape::circle(1.0)).restitution(2.0),
        Collider::new(Shape::circle(1.0)).surface_speed(f32::NAN),
        Collider::new(Shape::circle(1.0)).one_way([0.0, 0.0]),
    ];
    for collider in bad {
        let sentence = world.add(good().with(collider)).unwrap_err().to_string();
        assert!(sentence.len() > 20, "{sentence}");
        assert_eq!(world.body_count(), 0);
    }
    let id = add(&mut world, good().with(Collider::new(Shape::circle(1.0)).at([2.0, 0.0])));
    assert!(world.body_mut(id).unwrap().set_density(-1.0).is_err());
    assert!(world.body_mut(id).unwrap().set_shape(Shape::circle(f32::NAN)).is_err());
    world.validate().unwrap();
}

/// A box that never turns keeps its body from turning.
#[test]
fn a_body_with_an_axis_aligned_box_never_turns() {
    let mut world = space();
    let body = Body::dynamic(Shape::circle(0.5)).with(Collider::new(Shape::aabb(1.0, 0.2)).at([0.0, 1.0]));
    let id = add(&mut world, body.angle(1.0).angular_velocity(5.0));
    add(&mut world, Body::dynamic(Shape::circle(0.5)).at([3.0, 1.0]).velocity([-5.0, 0.0]));
    run(&mut world, 1.0);
    let body = world.body(id).unwrap();
    assert_eq!((body.angle(), body.angular_velocity()), (0.0, 0.0));
    assert!(body.velocity().x < 0.0);
}

/// The same bits on any lanes, and in a clone, also one into a world that was another.
#[test]
fn lanes_and_clones_come_to_the_same_bits() {
    let build = |lanes: Lanes| {
        let mut world = World::new(Settings { lanes, ..Settings::default() });
        world.add_force(Force::EARTH_GRAVITY);
        let tile = |x: f32| Collider::new(Shape::aabb(2.0, 1.0)).at([x, 0.0]);
        let floor = (1..10_u8).fold(Body::fixed(Shape::aabb(2.0, 1.0)).at([-10.0, -0.5]), |floor, number| {
            floor.with(tile(2.0 * f32::from(number)))
        });
        add(&mut world, floor);
        for number in 0..20_u8 {
            let ball = Collider::new(Shape::circle(0.3)).at([0.5, 0.0]);
            let at = [f64::from(number % 5) * 1.5 - 4.0, 1.0 + f64::from(number / 5)];
            let body =
                if number % 2 == 0 { hammer() } else { Body::dynamic(Shape::rectangle(0.5, 0.5)).with(ball) };
            add(&mut world, body.at(at).angle(f32::from(number)));
        }
        world
    };
    let mut hashes = Vec::new();
    for lanes in [Lanes::One, Lanes::Four, Lanes::Eight, Lanes::Auto] {
        let mut world = build(lanes);
        run(&mut world, 1.0);
        let mut clone = world.clone();
        let mut other = build(lanes);
        other.clone_from(&world);
        for world in [&mut world, &mut clone, &mut other] {
            run(world, 1.0);
            world.validate().unwrap();
            hashes.push(world.state_hash());
        }
    }
    assert!(hashes.iter().all(|&hash| hash == hashes[0]), "{hashes:x?}");
}

/// A paddle 5 m from the centre of a kinematic body is told to turn by one radian in the first tick. The ball on its way is met, as it is by a paddle that
/// has turned before.
#[test]
fn an_arm_that_is_told_to_turn_meets_what_is_on_its_way_in_the_same_tick() {
    let mut world = World::new(Settings::default());
    let paddle = Collider::new(Shape::circle(0.5)).at([5.0, 0.0]);
    let arm = add(&mut world, Body::kinematic(Shape::circle(0.1)).with(paddle));
    let (sin, cos) = 0.5_f64.sin_cos();
    let ball = add(&mut world, Body::dynamic(Shape::circle(0.2)).at([5.0 * cos, 5.0 * sin]));
    (0..30).for_each(|_| world.step());
    world.body_mut(arm).unwrap().set_angular_velocity(60.0);
    world.step();
    assert!(world.body(ball).unwrap().velocity().length() > 1.0, "the paddle comes at 300 m/s");
}
