//! Adding, removing, changing.

use rustycs::prelude::*;

use crate::support::{add, assert_near, assert_relative, place, velocity};

#[test]
fn a_removed_body_gives_back_what_it_was_and_can_be_added_again() {
    let mut world = World::new(Settings::default());
    let body = Body::dynamic(Shape::obb(2.0, 1.0))
        .at([3.0, -4.0])
        .angle(0.5)
        .velocity([1.0, 2.0])
        .material(Material::METAL)
        .mass(7.0)
        .gravity_scale(-0.5)
        .linear_damping(0.25)
        .angular_damping(0.75)
        .may_sleep(false)
        .user_data(u64::MAX);
    for given in [body.clone().angular_velocity(-3.0), body.fixed_rotation(true)] {
        let id = add(&mut world, given.clone());
        let described = world.body(id).unwrap().describe();
        let back = world.remove(id).unwrap();
        assert_eq!(described, back);
        // The angle goes through its cosine and sine; all else is the same bits.
        let angle = {
            let again = add(&mut world, back.clone());
            f64::from(world.body(again).unwrap().angle())
        };
        assert_near(angle, 0.5, 1e-6, "angle");
        assert_eq!(back.angle(0.5), given);
    }
}

/// What leaves the bounds is taken out and reported, what touched it hears of it, and what is fixed may be outside.
#[test]
fn bodies_that_leave_the_bounds_are_removed_and_reported() {
    let bounds = Some(Aabb::new(Vec2::splat(-10.0), Vec2::splat(10.0)));
    let mut world = World::new(Settings { bounds, ..Settings::default() });
    let outside = add(&mut world, Body::fixed(Shape::circle(1.0)).at([50.0, 0.0]));
    let stays = add(&mut world, Body::dynamic(Shape::circle(0.5)).at([0.0, 5.0]));
    let goes = add(&mut world, Body::dynamic(Shape::circle(0.5)).at([9.0, 0.0]).velocity([6.0, 0.0]));
    let belt = add(&mut world, Body::kinematic(Shape::circle(0.5)).at([0.0, -9.95]).velocity([0.0, -6.0]));
    let mut left = Vec::new();
    for _ in 0..20 {
        world.step();
        left.extend_from_slice(world.events().left());
        world.validate().unwrap();
    }
    // 0.05 m at 6 m/s take one tick, 1 m takes ten and one to be beyond.
    assert_eq!(left, [belt, goes]);
    assert!(world.body(goes).is_none() && world.body(belt).is_none());
    assert!(world.body(outside).is_some() && world.body(stays).is_some());
}

/// A pair of boxes that touch leaves the bounds one after the other: in the tick in which the first has left, its contact has ended.
#[test]
fn what_leaves_the_bounds_ends_its_contacts_in_the_same_tick() {
    let bounds = Some(Aabb::new(Vec2::splat(-5.0), Vec2::splat(5.0)));
    let mut world = World::new(Settings { bounds, ..Settings::default() });
    let [first, second] = [4.0, 3.0].map(|x| {
        let body = Body::dynamic(Shape::rectangle(1.0, 1.0)).at([x, 0.0]).velocity([3.0, 0.0]);
        add(&mut world, body.restitution(0.0))
    });
    while world.events().left().is_empty() {
        world.step();
    }
    assert_eq!(world.events().left(), [first]);
    let ended: Vec<_> = world.events().ended().iter().map(|event| (event.other(first), event.tick)).collect();
    assert_eq!(ended, [(Some(second), world.ticks())]);
}

/// A body that was taken out and put back goes on as one that never was.
#[test]
fn a_body_put_back_moves_on() {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    let ball = || Body::dynamic(Shape::circle(0.5));
    let (moved, left) = (add(&mut world, ball()), add(&mut world, ball().at([9.0, 0.0])));
    for _ in 0..30 {
        world.step();
    }
    let description = world.remove(moved).unwrap();
    let moved = add(&mut world, description);
    for _ in 0..30 {
        world.step();
    }
    // What rounding had kept out of the velocity is forgotten: half a unit in the last place of 5 m/s.
    assert_near(place(&world, moved)[1], place(&world, left)[1], 2.4e-7, "height");
    assert_near(velocity(&world, moved)[1], velocity(&world, left)[1], 4.8e-7, "speed");
}

#[test]
fn a_stale_id_gives_none_everywhere() {
    let mut world = World::new(Settings::default());
    let body = || Body::dynamic(Shape::circle(0.5));
    let (stale, kept) = (add(&mut world, body()), add(&mut world, body().at([5.0, 0.0])));
    let force = world.add_force(Force::EARTH_GRAVITY);
    let attractor = world.add_attractor(Attractor::global([0.0, 0.0], 1.0));
    assert!(world.remove(stale).is_some());
    assert!(world.remove_force(force).is_some() && world.remove_attractor(attractor).is_some());
    // The same places are used again, under other ids.
    let (second, second_force) = (add(&mut world, body()), world.add_force(Force::MOON_GRAVITY));
    let second_attractor = world.add_attractor(Attractor::global([1.0, 0.0], 2.0));
    assert!(second != stale && second_force != force && second_attractor != attractor);
    let before = world.state_hash();
    assert!(world.body(stale).is_none() && world.body_mut(stale).is_none() && world.remove(stale).is_none());
    assert!(world.force(force).is_none() && world.remove_force(force).is_none());
    assert!(world.attractor(attractor).is_none() && world.remove_attractor(attractor).is_none());
    assert!(world.replace_attractor(attractor, Attractor::global([0.0, 0.0], 9.0)).is_none());
    assert!(world.bodies().all(|(id, _)| id == kept || id == second));
    assert_eq!(world.force(second_force), Some(&Force::MOON_GRAVITY));
    assert_eq!(world.attractor(second_attractor).map(Attractor::mass), Some(2.0));
    assert_eq!(world.state_hash(), before);
    world.validate().unwrap();
}

#[test]
fn an_id_survives_the_way_through_a_number() {
    let mut world = World::new(Settings::default());
    let id = add(&mut world, Body::dynamic(Shape::circle(0.5)));
    assert_eq!(BodyId::from_bits(id.to_bits()), Some(id));
    assert_eq!(BodyId::from_bits(0), None);
    let foreign = BodyId::from_bits(u64::MAX).unwrap();
    assert!(world.body(foreign).is_none() && world.remove(foreign).is_none());
}

#[test]
fn forces_add_up_and_are_removed_by_id() {
    let mut world = World::new(Settings::default());
    let gravity = world.add_force(Force::EARTH_GRAVITY);
    let wind = world.add_force(Force::new("wind", [2.0, 0.0]));
    let lift = world.add_force(Force::new(String::from("lift"), [0.0, 1.0]));
    assert_eq!(world.acceleration(), Vec2::new(2.0, -8.81));
    let names: Vec<&str> = world.forces().map(|(_, force)| force.name()).collect();
    assert_eq!(names, ["earth gravity", "wind", "lift"]);
    assert_eq!(world.remove_force(wind).map(|force| force.acceleration()), Some(Vec2::new(2.0, 0.0)));
    assert_eq!(world.acceleration(), Vec2::new(0.0, -8.81));
    assert!(world.remove_force(gravity).is_some() && world.remove_force(lift).is_some());
    assert_eq!(world.acceleration(), Vec2::ZERO);
    let body = add(&mut world, Body::dynamic(Shape::circle(0.5)));
    world.step();
    assert_eq!(place(&world, body), [0.0, 0.0]);
}

/// F/m for one tick, and no longer.
#[test]
fn a_force_on_a_body_acts_for_one_tick_and_forces_of_several_calls_add_up() {
    let mut world = World::new(Settings { sleep: false, ..Settings::default() });
    let id = add(&mut world, Body::dynamic(Shape::obb(1.0, 1.0)).mass(2.0));
    let mut body = world.body_mut(id).unwrap();
    body.apply_force([3.0, 0.0]);
    body.apply_force([3.0, 6.0]);
    body.apply_force_at([0.0, 1.0], [2.0, 0.0]);
    body.apply_torque(-1.0);
    for _ in 0..2 {
        world.step();
        assert_relative(velocity(&world, id)[0], 6.0 / 2.0 / 60.0, 1e-6, "F t / m");
        assert_relative(velocity(&world, id)[1], 7.0 / 2.0 / 60.0, 1e-6, "F t / m");
        // 1 N at an arm of 2 m less 1 N m, over the inertia of 2/6 kg m².
        let spin = world.body(id).unwrap().angular_velocity();
        assert_relative(f64::from(spin), (2.0 - 1.0) / (2.0 / 6.0) / 60.0, 1e-6, "torque t / I");
    }
}

#[test]
fn user_data_is_kept_and_never_read() {
    let mut world = World::new(Settings::default());
    let id = add(&mut world, Body::fixed(Shape::circle(0.5)).user_data(42));
    assert_eq!(world.body(id).unwrap().user_data(), 42);
    let hash = world.state_hash();
    world.body_mut(id).unwrap().set_user_data(7);
    assert_eq!((world.body(id).unwrap().user_data(), world.state_hash()), (7, hash));
}

/// What bodies ignore, as documented: boxes that never turn have no angle, fixed bodies no velocity.
#[test]
fn options_that_do_not_apply_are_ignored() {
    let mut world = World::new(Settings::default());
    let upright = Body::dynamic(Shape::aabb(1.0, 1.0)).angle(0.5).angular_velocity(2.0);
    let upright = add(&mut world, upright);
    let wall = add(&mut world, Body::fixed(Shape::obb(1.0, 1.0)).at([9.0, 0.0]).velocity([1.0, 1.0]));
    for id in [upright, wall] {
        let mut body = world.body_mut(id).unwrap();
        if id == upright {
            body.set_angle(1.0).unwrap();
        } else {
            body.set_velocity([3.0, 0.0]);
        }
        body.set_angular_velocity(3.0);
        body.apply_angular_impulse(3.0);
        body.apply_torque(3.0);
    }
    world.step();
    for id in [upright, wall] {
        let body = world.body(id).unwrap();
        assert_eq!((body.angle(), body.angular_velocity(), body.velocity()), (0.0, 0.0, Vec2::ZERO));
    }
    assert_eq!(place(&world, wall), [9.0, 0.0]);
    assert_eq!(world.body(upright).unwrap().inertia(), f32::INFINITY);
}

/// Each setter shows in the view at once.
#[test]
fn what_is_set_can_be_read() {
    let mut world = World::new(Settings::default());
    let id = add(&mut world, Body::dynamic(Shape::obb(1.0, 1.0)));
    let mut body = world.body_mut(id).unwrap();
    body.set_position([1.0, 2.0]).unwrap();
    body.set_angle(0.5).unwrap();
    body.set_velocity([3.0, 4.0]);
    body.set_angular_velocity(5.0);
    body.set_friction(0.25).unwrap();
    body.set_restitution(0.75).unwrap();
    body.set_gravity_scale(-2.0).unwrap();
    body.set_linear_damping(0.125).unwrap();
    body.set_angular_damping(0.375).unwrap();
    let view = world.body(id).unwrap();
    assert_eq!(view.position_f64(), [1.0, 2.0]);
    assert_near(f64::from(view.angle()), 0.5, 1e-6, "angle");
    assert_eq!((view.velocity(), view.angular_velocity()), (Vec2::new(3.0, 4.0), 5.0));
    assert_eq!((view.material().friction, view.material().restitution), (0.25, 0.75));
    assert_eq!((view.gravity_scale(), view.linear_damping(), view.angular_damping()), (-2.0, 0.125, 0.375));
    // A point a metre to the right moves up by w × r more.
    assert_eq!(view.velocity_at([2.0, 2.0]), Vec2::new(3.0, 9.0));
    assert!(view.contains([1.0, 2.0]) && !view.contains([3.0, 2.0]) && view.id() == id);
}
