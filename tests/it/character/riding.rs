//! On lifts, platforms and belts, and between what moves.

use rustycs::prelude::*;

use super::{DT, Walker, shapes, skin};
use crate::support::{add, space};

/// A lift that goes up and down by turns, abruptly: it is stood on in every tick, the gap never changes.
#[test]
fn it_neither_leaves_a_lift_nor_sinks_into_it() {
    for shape in shapes() {
        for speed in [0.5_f32, 3.0, 20.0] {
            let mut world = space();
            let lift = add(&mut world, Body::kinematic(Shape::rectangle(3.0, 0.2)).at([0.0, -0.1]));
            let mut walker = Walker::new(Character::new(shape).at([0.0, 0.51]), 0.0);
            walker.run(&mut world, 0.5);
            for tick in 0..1_200 {
                let upward = if tick / 60 % 2 == 0 { speed } else { -speed };
                world.body_mut(lift).unwrap().set_velocity([0.0, upward]);
                let moved = walker.tick(&mut world);
                let gap = walker.place()[1] - world.body(lift).unwrap().position_f64()[1] - 0.6;
                assert!(moved.is_grounded() && moved.crushed_by.is_none(), "{speed} m/s, tick {tick}");
                assert!((gap - skin(shape)).abs() < 1e-4, "{speed} m/s, tick {tick}: {gap} m");
            }
            assert_eq!(walker.mover.ground_velocity(&world).y, -speed);
        }
    }
}

/// A platform that swings aside carries it along without a slip, also one that is walked on.
#[test]
fn it_does_not_slip_on_a_moving_platform() {
    for shape in shapes() {
        let mut world = space();
        let platform = add(&mut world, Body::kinematic(Shape::rectangle(8.0, 0.2)).at([0.0, -0.1]));
        let mut walker = Walker::new(Character::new(shape).at([0.0, 0.51]), 0.0);
        walker.run(&mut world, 0.5);
        let on_platform = |world: &World, walker: &Walker| {
            walker.place()[0] - world.body(platform).unwrap().position_f64()[0]
        };
        let before = on_platform(&world, &walker);
        for tick in 0..600 {
            let phase = f64::from(tick) * 2.0 * f64::from(DT);
            world.body_mut(platform).unwrap().move_to(Pose::at([1.5 * phase.sin(), -0.1]));
            assert!(walker.tick(&mut world).is_grounded());
            assert!((on_platform(&world, &walker) - before).abs() < 1e-4);
        }
        walker.speed = 0.5;
        for tick in 600..720 {
            let phase = f64::from(tick) * 2.0 * f64::from(DT);
            world.body_mut(platform).unwrap().move_to(Pose::at([1.5 * phase.sin(), -0.1]));
            walker.tick(&mut world);
        }
        assert!((on_platform(&world, &walker) - before - 1.0).abs() < 1e-3);
    }
}

/// On a disc that turns it goes round with the place that it stands on, 20 m out by 1 rad/s times its angle.
#[test]
fn it_goes_round_with_what_turns() {
    let mut world = space();
    let wheel = add(&mut world, Body::kinematic(Shape::circle(20.0)).angular_velocity(-0.2));
    let mut walker = Walker::new(Character::new(Shape::rectangle(0.6, 1.0)).at([0.0, 20.51]), 0.0);
    walker.run(&mut world, 0.1);
    let start = walker.place()[0];
    walker.run(&mut world, 1.0);
    let turned = 0.2_f64;
    let [x, _] = walker.place();
    assert!(walker.mover.is_grounded() && (x - start - 20.0 * turned.sin()).abs() < 0.05, "at {x}");
    assert!(world.body(wheel).is_some());
}

#[test]
fn belts_carry_it() {
    for shape in shapes() {
        let mut world = space();
        add(&mut world, Body::fixed(Shape::aabb(40.0, 1.0)).at([0.0, -0.5]).surface_speed(2.0));
        let mut walker = Walker::new(Character::new(shape).at([0.0, 0.51]), 0.0);
        walker.run(&mut world, 0.1);
        let start = walker.place()[0];
        walker.run(&mut world, 2.0);
        assert!((walker.place()[0] - start - 4.0).abs() < 1e-3);
        assert_eq!(walker.mover.ground_velocity(&world), Vec2::new(2.0, 0.0));
    }
}

/// A lift takes it up against a ceiling: it is told, stays where it is and does not get through the lift or the ceiling; once the
/// lift goes down again it stands on it.
#[test]
fn being_crushed_is_told() {
    for shape in shapes() {
        let mut world = space();
        let lift = add(&mut world, Body::kinematic(Shape::rectangle(3.0, 1.0)).at([0.0, -0.5]));
        add(&mut world, Body::fixed(Shape::aabb(6.0, 1.0)).at([0.0, 2.0]));
        let mut walker = Walker::new(Character::new(shape).at([0.0, 0.51]), 0.0);
        walker.run(&mut world, 0.5);
        world.body_mut(lift).unwrap().set_velocity([0.0, 1.0]);
        let mut first = None;
        for tick in 1..=45 {
            let moved = walker.tick(&mut world);
            first = first.or(moved.crushed_by.map(|by| (tick, by)));
        }
        // The ceiling is 0.5 m above it: after 30 ticks.
        let (tick, by) = first.expect("it was crushed");
        assert!((29..=32).contains(&tick) && by == lift, "tick {tick}, by {by:?}");
        let [_, y] = walker.place();
        assert!((y - 1.0).abs() < 0.02, "at {y}");
        world.body_mut(lift).unwrap().set_velocity([0.0, -1.0]);
        walker.run(&mut world, 1.0);
        let gap = walker.place()[1] - world.body(lift).unwrap().position_f64()[1] - 1.0;
        assert!(walker.mover.is_grounded() && (gap - skin(shape)).abs() < 1e-4, "gap {gap}");
    }
}

/// A wall that comes nearer pushes it along.
#[test]
fn walls_that_move_push_it() {
    for shape in shapes() {
        let mut world = space();
        add(&mut world, Body::fixed(Shape::aabb(40.0, 1.0)).at([0.0, -0.5]));
        let half = f64::from(shape.bounding_box(Pose::at([0.0, 0.0])).max.x);
        let wall =
            add(&mut world, Body::kinematic(Shape::aabb(1.0, 4.0)).at([-3.0, 2.1]).velocity([2.0, 0.0]));
        let mut walker = Walker::new(Character::new(shape).at([0.0, 0.51]), 0.0);
        for _ in 0..240 {
            let moved = walker.tick(&mut world);
            assert!(moved.is_grounded() && moved.crushed_by.is_none());
        }
        let gap = walker.place()[0] - half - world.body(wall).unwrap().position_f64()[0] - 0.5;
        assert!((0.0..0.04).contains(&gap), "{gap}");
    }
}

/// What it stands on is taken away: it falls.
#[test]
fn it_falls_when_its_ground_is_removed() {
    let mut world = space();
    let floor = add(&mut world, Body::fixed(Shape::aabb(4.0, 1.0)).at([0.0, -0.5]));
    let mut walker = Walker::new(Character::new(Shape::circle(0.5)).at([0.0, 0.51]), 0.0);
    walker.run(&mut world, 0.5);
    world.remove(floor);
    assert!(!walker.tick(&mut world).is_grounded());
    assert_eq!(walker.mover.ground_velocity(&world), Vec2::ZERO);
}

/// A game that moves its character after each tick comes to the same at any number of frames per second, and what is drawn between
/// two ticks stands on the lift that is drawn there.
#[test]
fn it_moves_and_is_drawn_alike_at_any_frame_rate() {
    let ride = |rate: u32| {
        let mut world = space();
        let lift = Body::kinematic(Shape::rectangle(30.0, 0.2)).at([0.0, -0.1]).velocity([0.5, 2.0]);
        let lift = add(&mut world, lift);
        let hero = Character::new(Shape::rectangle(0.6, 1.0)).at([0.0, 0.51]);
        let gap = skin(Shape::rectangle(0.6, 1.0));
        let mut mover = Mover::new(hero).unwrap();
        let mut drawn_before = f64::NEG_INFINITY;
        for frame in 0..2 * rate {
            world.advance_then(1.0 / f64::from(rate), |world| {
                mover.move_by(world, [1.5 * DT, -0.01]);
            });
            let drawn = mover.interpolated_pose(&world).center;
            let below = world.body(lift).unwrap().interpolated_pose(world.alpha()).center;
            // After the first frames, in which it is set down.
            if frame > rate / 4 {
                assert!((drawn.y - below.y - 0.6 - gap).abs() < 1e-4, "{rate}, frame {frame}");
                // 2 m/s of its own and of the lift.
                let gone = drawn.x - drawn_before;
                assert!((gone * f64::from(rate) - 2.0).abs() < 1e-3, "{rate}, frame {frame}: {gone} m");
            }
            drawn_before = drawn.x;
        }
        let came_to = (world.ticks(), mover.position());
        // One that is not moved any more is drawn where it is.
        assert_eq!(world.advance(1.5 / 60.0), 1);
        assert_eq!(mover.interpolated_pose(&world).center, mover.position());
        came_to
    };
    let places = [20, 30, 60, 144, 240].map(ride);
    assert!(places.iter().all(|place| *place == places[0]), "{places:?}");
}

/// Set between a wall and a slope, 3 cm too low: there is room above, and it is lifted by so much, and by what its gaps to both
/// take.
#[test]
fn it_gets_out_of_a_wedge() {
    let (width, height, depth) = (0.4_f32, 0.9_f32, 0.03);
    for angle in [0.4_f32, 0.8, 1.2] {
        let mut world = space();
        add(&mut world, Body::fixed(Shape::rectangle(1.0, 9.0)).at([0.5 + 0.5 * width, 0.0]));
        // The upper face of a block falls to the right through the lower left corner of the character, where that is to be.
        let (normal, size) = (Vec2::from_angle(core::f32::consts::FRAC_PI_2 - angle), 0.5_f32);
        let middle = Vec2::new(-0.5 * width, -0.5 * height) - normal * (0.5 * size);
        add(&mut world, Body::fixed(Shape::rectangle(size, size)).at(middle).angle(-angle));
        let shape = Shape::rectangle(width, height);
        let mut mover = Mover::new(Character::new(shape).at([0.0, -depth])).unwrap();
        let moved = mover.move_by(&mut world, [0.0, 0.0]);
        assert_eq!(moved.crushed_by, None, "{angle} rad");
        let (place, gap) = (mover.position(), skin(shape) as f32);
        let (x, y) = (place.x as f32, place.y as f32);
        assert!(x.abs() <= 2.0 * gap && (0.0..=8.0 * gap).contains(&y), "{angle} rad: at {x}, {y}");
    }
}
