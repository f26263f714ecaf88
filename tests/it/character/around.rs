//! One-way floors, bodies that are pushed, filters, and what is refused.

use rustycs::prelude::*;

use super::{DT, Walker, shapes, skin};
use crate::support::{add, add_floor, earth, place, run, space, velocity};

fn add_one_way(world: &mut World) -> BodyId {
    add(world, Body::fixed(Shape::aabb(6.0, 0.2)).at([0.0, 1.4]).one_way([0.0, 1.0]))
}

/// Jumped through from below and stood on, walked through from the side, dropped through when told; each character for itself.
#[test]
fn one_way_floors_bear_from_above_only() {
    for shape in shapes() {
        let mut world = space();
        add_floor(&mut world, 0.5);
        add_one_way(&mut world);
        let [mut first, mut second] =
            [0.0, 1.5].map(|x| Walker::new(Character::new(shape).at([x, 0.51]), 0.0));
        first.run(&mut world, 0.2);
        first.jump(7.0);
        for _ in 0..90 {
            let moved = first.tick(&mut world);
            assert!(moved.ceiling.is_none() && moved.wall.is_none() && moved.crushed_by.is_none());
        }
        let top = 1.5 + 0.5 + skin(shape);
        assert!(first.mover.is_grounded() && (first.place()[1] - top).abs() < 1e-4, "at {:?}", first.place());
        // A jump that does not get through falls back through it.
        second.run(&mut world, 0.2);
        second.jump(4.5);
        second.run(&mut world, 1.5);
        assert!(second.mover.is_grounded() && second.place()[1] < 0.6);
        first.mover.set_passes_one_way(true);
        first.run(&mut world, 1.0);
        assert!(first.mover.is_grounded() && first.place()[1] < 0.6, "it dropped through");

        let mut side = Walker::new(Character::new(shape).at([-6.0, 1.45]), 6.0);
        let moved: Vec<Moved> = (0..20).map(|_| side.tick(&mut world)).collect();
        assert!(moved.iter().all(|moved| moved.wall.is_none() && moved.crushed_by.is_none()));
    }
}

/// A one-way lift that goes up and down takes it along from above, and passes it from below.
#[test]
fn one_way_lifts_carry_from_above_only() {
    let mut world = space();
    add_floor(&mut world, 0.5);
    let lift =
        Body::kinematic(Shape::aabb(6.0, 0.2)).at([0.0, 3.0]).one_way([0.0, 1.0]).velocity([0.0, -1.0]);
    let lift = add(&mut world, lift);
    let shape = Shape::rectangle(0.6, 1.0);
    let [mut below, mut above] = [0.51, 3.7].map(|y| Walker::new(Character::new(shape).at([0.0, y]), 0.0));
    for tick in 0..600 {
        let upward = if tick / 120 % 2 == 0 { -1.0 } else { 1.0 };
        world.body_mut(lift).unwrap().set_velocity([0.0, upward]);
        world.step();
        for walker in [&mut below, &mut above] {
            walker.fall -= 9.81 * DT;
            let moved = walker.mover.move_by(&mut world, [0.0, walker.fall * DT]);
            assert_eq!(moved.crushed_by, None);
            if moved.is_grounded() {
                walker.fall = 0.0;
            }
        }
        let gap = above.place()[1] - world.body(lift).unwrap().position_f64()[1] - 0.6;
        assert!(tick < 60 || (gap - skin(shape)).abs() < 1e-4, "tick {tick}: {gap}");
    }
    assert!(below.place()[1] < 0.6);
}

/// A crate that lies on the floor, 10 kg, friction 0.5.
fn add_crate(world: &mut World) -> BodyId {
    let body =
        Body::dynamic(Shape::rectangle(1.0, 1.0)).at([2.0, 0.5]).mass(10.0).friction(0.5).restitution(0.0);
    add(world, body)
}

/// It moves what friction, 0.5 m g = 49 N, does not hold, and never faster than it walks.
#[test]
fn a_crate_is_pushed_with_the_force_that_it_has() {
    for shape in shapes() {
        for (force, is_moved) in [(0.0, false), (40.0, false), (100.0, true), (1e6, true)] {
            let mut world = earth();
            add_floor(&mut world, 0.5);
            let pushed = add_crate(&mut world);
            run(&mut world, 0.2);
            let mut walker = Walker::new(Character::new(shape).push_force(force).at([0.0, 0.51]), 2.0);
            let mut fastest = 0.0_f64;
            for _ in 0..240 {
                let moved = walker.tick(&mut world);
                assert!(moved.crushed_by.is_none() && moved.is_grounded());
                fastest = fastest.max(velocity(&world, pushed)[0]);
            }
            let way = place(&world, pushed)[0] - 2.0;
            // It walks 8 m in all, about 1 m of it up to the crate.
            let expected = if is_moved { 5.0..8.0 } else { -1e-3..1e-3 };
            assert!(expected.contains(&way), "{shape:?}, {force} N: moved by {way} m");
            // Friction takes µ g dt of it in each tick, and no more is given back.
            assert!(fastest < 2.0 + 1e-3, "{fastest} m/s");
        }
    }
}

/// What is free is given F dt in a tick: 60 N for 1/60 s on 10 kg are 0.1 m/s.
#[test]
fn a_push_is_the_force_over_a_tick() {
    let mut world = space();
    let floating = add(&mut world, Body::dynamic(Shape::rectangle(1.0, 1.0)).at([1.0, 0.0]).mass(10.0));
    let mut mover = Mover::new(Character::new(Shape::rectangle(0.6, 1.0)).push_force(60.0)).unwrap();
    let moved = mover.move_by(&mut world, [1.0, 0.0]);
    assert_eq!(moved.wall.map(|hit| hit.body), Some(floating));
    world.step();
    assert!(
        (velocity(&world, floating)[0] - 60.0 / 60.0 / 10.0).abs() < 1e-5,
        "{:?}",
        velocity(&world, floating)
    );
    // At 0.06 m/s it asks for no more than that.
    let mut slow = Mover::new(Character::new(Shape::rectangle(0.6, 1.0)).push_force(1e6)).unwrap();
    let mut world = space();
    let floating = add(&mut world, Body::dynamic(Shape::rectangle(1.0, 1.0)).at([0.801, 0.0]).mass(10.0));
    slow.move_by(&mut world, [0.001, 0.0]);
    world.step();
    assert!((velocity(&world, floating)[0] - 0.06).abs() < 1e-4, "{:?}", velocity(&world, floating));
}

#[test]
fn filters_sensors_and_ignored_bodies_are_passed() {
    let mut world = space();
    let filter = Filter { category: 2, mask: u64::MAX, group: 0 };
    let wall = |x: f64| Body::fixed(Shape::aabb(0.2, 4.0)).at([x, 0.0]);
    add(&mut world, wall(1.0).filter(filter));
    add(&mut world, wall(2.0).sensor(true));
    let own = add(&mut world, wall(3.0));
    let stops = add(&mut world, wall(4.0));
    let character =
        Character::new(Shape::circle(0.3)).filter(Filter { mask: 1, ..Filter::DEFAULT }).ignore(own);
    let mut mover = Mover::new(character).unwrap();
    let moved = mover.move_by(&mut world, [10.0, 0.0]);
    assert_eq!(moved.wall.map(|hit| hit.body), Some(stops));
    assert!((mover.position().x - 3.6 + f64::from(mover.character().get_skin())).abs() < 1e-5);
}

/// A companion in the world is met by others, and does not disturb the character.
#[test]
fn a_companion_stands_for_it_in_the_world() {
    let mut world = earth();
    add_floor(&mut world, 0.5);
    let shape = Shape::rectangle(0.6, 1.0);
    let body = add(&mut world, Body::kinematic(shape).at([0.0, 0.51]));
    let falls = add(&mut world, Body::dynamic(Shape::rectangle(0.4, 0.4)).at([0.0, 3.0]).restitution(0.0));
    let mut walker = Walker::new(Character::new(shape).at([0.0, 0.51]).ignore(body), 0.0);
    for _ in 0..180 {
        let moved = walker.tick(&mut world);
        assert!(moved.is_grounded() && moved.crushed_by.is_none());
        world.body_mut(body).unwrap().move_to(walker.mover.pose());
    }
    assert!((place(&world, falls)[1] - 1.2).abs() < 0.01, "it lies on the head: {:?}", place(&world, falls));
}

#[test]
fn numbers_that_are_none_are_refused() {
    let good = || Character::new(Shape::circle(0.5));
    for value in [f32::NAN, f32::INFINITY, -1.0] {
        assert!(Mover::new(Character::new(Shape::circle(value))).is_err());
        assert!(Mover::new(good().max_slope(value)).is_err());
        assert!(Mover::new(good().step_height(value)).is_err());
        assert!(Mover::new(good().snap(value)).is_err());
        assert!(Mover::new(good().push_force(value)).is_err());
    }
    assert!(Mover::new(good().max_slope(1.6)).is_err());
    assert!(Mover::new(good().up([0.0, 0.0])).is_err() && Mover::new(good().up([f32::NAN, 1.0])).is_err());
    assert!(Mover::new(good().at([f64::NAN, 0.0])).is_err());
    let mut mover = Mover::new(good().up([0.0, 5.0])).unwrap();
    assert!(mover.set_position([f64::INFINITY, 0.0]).is_err());
    assert_eq!(mover.position(), Point::ORIGIN);
}

/// A way that is no way goes nowhere, and a debug build says where it was told.
#[test]
fn a_way_that_is_not_finite_goes_nowhere() {
    let mut world = space();
    let mut mover = Mover::new(Character::new(Shape::circle(0.5))).unwrap();
    let told =
        std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| mover.move_by(&mut world, [f32::NAN, 0.0])));
    assert_eq!(told.is_err(), cfg!(debug_assertions));
    assert_eq!(mover.position(), Point::ORIGIN);
    for way in [[1e30, 1e30], [-3e38, 0.0], [1e-38, 0.0]] {
        mover.move_by(&mut world, way);
        assert!(mover.position().is_finite());
    }
}

/// Upside down all is the same.
#[test]
fn up_may_be_anywhere() {
    for (up, floor) in [([0.0_f32, -1.0], [0.0, 1.0]), ([1.0, 0.0], [-1.0, 0.0])] {
        let mut world = space();
        add(&mut world, Body::fixed(Shape::aabb(2.0, 2.0)).at([2.0 * floor[0], 2.0 * floor[1]]));
        let mut mover = Mover::new(Character::new(Shape::circle(0.5)).up(up)).unwrap();
        let down = Vec2::from(up) * -1.0;
        assert!(mover.move_by(&mut world, down).is_grounded());
        let across = down.perp() * 0.3;
        let moved = mover.move_by(&mut world, across + down * 0.1);
        assert!(moved.is_grounded() && moved.translation.distance(across) < 1e-4, "{moved:?}");
    }
}

/// A box that it does not collide with, and a one-way floor, over the edge of a step hide neither edge nor top.
#[test]
fn what_it_passes_does_not_hide_a_step() {
    let other = Filter { category: 2, mask: u64::MAX, group: 0 };
    let one_way = Body::fixed(Shape::aabb(4.0, 0.02)).at([4.0, 0.21]).one_way([0.0, 1.0]);
    let box_ = Body::fixed(Shape::aabb(4.0, 1.0)).at([4.0, 0.7]).filter(other);
    for obstacle in [one_way, box_] {
        for shape in shapes() {
            let mut world = space();
            add_floor(&mut world, 0.5);
            add(&mut world, Body::fixed(Shape::aabb(4.0, 0.2)).at([4.0, 0.1]));
            add(&mut world, obstacle.clone());
            let character = Character::new(shape).at([0.0, 0.6]).step_height(0.25);
            let mut walker = Walker::new(character.filter(Filter { mask: 1, ..Filter::DEFAULT }), 3.0);
            walker.run(&mut world, 1.5);
            assert!(walker.place()[0] > 3.0, "{shape:?} stops at {:?}", walker.place());
        }
    }
}
