//! On the ground: flat, tiled, sloped, stepped.

use rustycs::prelude::*;

use super::{DT, Walker, shapes, skin};
use crate::support::{add, add_floor, space};

/// A slope that rises from the origin to the right by an angle, rad, for 20 m.
fn add_slope(world: &mut World, angle: f32) {
    let Rot { c, s } = Rot::from_angle(angle);
    let top = [10.0 * c + 0.5 * s, 10.0 * s - 0.5 * c];
    add(world, Body::fixed(Shape::rectangle(20.0, 1.0)).at(top).angle(angle));
}

/// The gap is kept while it walks and while it is pressed against the ground, and it neither hops nor sinks.
#[test]
fn it_walks_on_level_ground_without_a_tremble() {
    for shape in shapes() {
        for speed in [0.0, 0.01, 1.0, 9.0] {
            let mut world = space();
            add_floor(&mut world, 0.5);
            let mut walker = Walker::new(Character::new(shape).at([0.0, 0.6]), speed);
            walker.run(&mut world, 1.0);
            let [x, y] = walker.place();
            assert!((y - 0.5 - skin(shape)).abs() < 1e-5, "{y}");
            for tick in 1..600 {
                let moved = walker.tick(&mut world);
                let expected = x + f64::from(speed * DT) * f64::from(tick);
                let [now_x, now_y] = walker.place();
                assert!(moved.is_grounded() && (now_y - y).abs() < 1e-5, "{speed} m/s: {y} to {now_y}");
                assert!((now_x - expected).abs() < 1e-3, "{speed} m/s: at {now_x}, not {expected}");
            }
        }
    }
}

#[test]
fn it_does_not_feel_where_tiles_meet() {
    for shape in shapes() {
        for speed in [0.5_f32, 3.0, 10.0, 20.0] {
            let mut world = space();
            add(&mut world, Ground::from_tiles(&[true; 100], 100, 1.0).at([-50.0, -1.0]));
            for x in 0..4 {
                add(&mut world, Body::fixed(Shape::aabb(1.0, 1.0)).at([f64::from(x) + 50.5, -0.5]));
            }
            let mut walker = Walker::new(Character::new(shape).step_height(0.0).at([-40.0, 0.6]), speed);
            walker.run(&mut world, 4.0);
            let [x, y] = walker.place();
            let expected = -40.0 + 4.0 * f64::from(speed);
            assert!((x - expected).abs() < 1e-3 && (y - 0.5 - skin(shape)).abs() < 1e-5, "at {x}, {y}");
        }
    }
}

/// As fast along a slope as on the flat, up and down, and always on it.
#[test]
fn slopes_are_walked_at_the_speed_of_the_flat() {
    for shape in shapes() {
        for degrees in [10.0_f32, 30.0, 44.0] {
            let angle = degrees.to_radians();
            let mut world = space();
            add_slope(&mut world, angle);
            let Rot { c, s } = Rot::from_angle(angle);
            let start = [5.0 * c - 0.7 * s, 5.0 * s + 0.7 * c];
            let mut walker = Walker::new(Character::new(shape).at(start), 0.0);
            walker.run(&mut world, 1.0);
            assert!(walker.mover.is_grounded());
            for speed in [3.0_f32, -3.0] {
                walker.speed = speed;
                let before = walker.mover.position();
                for _ in 0..60 {
                    assert!(walker.tick(&mut world).is_grounded(), "{degrees}° at {speed} m/s");
                }
                let way = walker.mover.position() - before;
                let expected = Vec2::new(c, s) * speed;
                assert!(way.distance(expected) < 0.01, "{degrees}°: {way}, not {expected}");
            }
        }
    }
}

/// Pressed down for a minute on a slope that it can stand on, it stays where it is to the millimetre.
#[test]
fn it_does_not_creep_down_a_slope() {
    for shape in shapes() {
        let mut world = space();
        add_slope(&mut world, 0.7);
        let mut walker = Walker::new(Character::new(shape).at([5.0, 6.0]), 0.0);
        walker.run(&mut world, 1.0);
        let before = walker.mover.position();
        walker.run(&mut world, 60.0);
        assert!(walker.mover.is_grounded() && walker.mover.position().distance(before) < 1e-3);
    }
}

/// A slope that is too steep is a wall from below, at a run and after a jump, and slid down along from above, faster and faster.
#[test]
fn slopes_that_are_too_steep_are_slid_down_and_not_climbed() {
    for shape in shapes() {
        for speed in [1.0, 8.0] {
            let mut world = space();
            add_floor(&mut world, 0.5);
            add_slope(&mut world, 1.0);
            let mut walker = Walker::new(Character::new(shape).at([-2.0, 0.6]), speed);
            let mut highest = f64::NEG_INFINITY;
            for _ in 0..300 {
                walker.tick(&mut world);
                highest = highest.max(walker.place()[1]);
            }
            assert!(highest < 0.62, "it climbed to {highest}");
            walker.jump(3.0);
            for _ in 0..120 {
                walker.tick(&mut world);
                highest = highest.max(walker.place()[1]);
            }
            // A jump of 3 m/s is v²/2g high.
            assert!(highest < 0.51 + 9.0 / (2.0 * 9.81), "it jumped to {highest}");
            assert!(walker.mover.is_grounded() && walker.place()[1] < 0.6);
        }
        let mut world = space();
        add_slope(&mut world, 1.0);
        let Rot { c, s } = Rot::from_angle(1.0);
        let mut walker = Walker::new(Character::new(shape).at([9.0 * c - 1.0 * s, 9.0 * s + 1.0 * c]), 0.0);
        walker.run(&mut world, 0.6);
        let [x, y] = walker.place();
        assert!(!walker.mover.is_grounded() && y < 8.0, "at {x}, {y}");
        // It is still on it, and slides along it.
        let moved = walker.tick(&mut world);
        assert!(moved.wall.is_some() && moved.translation.normalized_or_zero().dot([-c, -s].into()) > 0.999);
    }
}

fn add_stairs(world: &mut World, height: f64, count: u8) {
    for step in 0..count {
        let number = f64::from(step) + 1.0;
        let top = number * height;
        add(world, Body::fixed(Shape::aabb(1.0, 4.0)).at([number + 0.5, top - 2.0]));
    }
    add(
        world,
        Body::fixed(Shape::aabb(20.0, 4.0)).at([f64::from(count) + 11.0, f64::from(count) * height - 2.0]),
    );
}

/// Up and down, at a crawl and at a run, without leaving the ground.
#[test]
fn steps_are_climbed_up_to_their_height_and_no_higher() {
    for shape in shapes() {
        for speed in [0.02, 0.5, 3.0, 6.0] {
            let character = || Character::new(shape).step_height(0.3).snap(0.3).at([0.4, 0.51]);
            for (height, is_climbed) in [(0.1, true), (0.29, true), (0.33, false), (1.0, false)] {
                let mut world = space();
                add_floor(&mut world, 0.5);
                add_stairs(&mut world, height, 4);
                let mut walker = Walker::new(character(), speed);
                walker.run(&mut world, 0.1);
                let mut is_grounded = true;
                // To the fifth step and 2 m farther; at a crawl to the first.
                let way = if speed < 0.1 { 0.8 } else { 7.0 };
                for _ in 0..(1.5 * way / (speed * DT)) as u32 {
                    is_grounded &= walker.tick(&mut world).is_grounded();
                }
                let [x, y] = walker.place();
                let top = if speed < 0.1 { height } else { 4.0 * height };
                let is_up = (y - top - 0.5 - skin(shape)).abs() < 1e-4;
                assert_eq!(is_up, is_climbed, "{shape:?}, {height} m at {speed} m/s: at {x}, {y}");
                assert!(is_grounded, "{height} m at {speed} m/s: it left the ground");
                assert!(is_climbed || x < 1.0 && y < 0.6, "at {x}, {y}");
                if is_climbed && speed >= 0.5 {
                    // Back to before the first step; a disc goes round each edge, which is a longer way.
                    walker.speed = -speed;
                    for _ in 0..(2.5 * way / (speed * DT)) as u32 {
                        is_grounded &= walker.tick(&mut world).is_grounded();
                    }
                    let [x, y] = walker.place();
                    assert!(is_grounded, "{shape:?}, down {height} m at {speed} m/s: it left the ground");
                    assert!(x < 0.4 && y < 0.6, "{shape:?}, down {height} m at {speed} m/s: at {x}, {y}");
                }
            }
        }
    }
}

/// Without a step height nothing is climbed, and without snapping it flies off a ledge.
#[test]
fn what_it_is_not_told_to_do_it_does_not() {
    let mut world = space();
    add_floor(&mut world, 0.5);
    add_stairs(&mut world, 0.05, 1);
    let plain = Character::new(Shape::rectangle(0.6, 1.0)).step_height(0.0).snap(0.0);
    let mut walker = Walker::new(plain.at([0.0, 0.6]), 1.0);
    walker.run(&mut world, 3.0);
    assert!(walker.place()[0] < 0.7 && walker.tick(&mut world).wall.is_some());
    walker.mover.set_position([2.0, 0.56]).unwrap();
    walker.speed = -3.0;
    let mut left = 0;
    for _ in 0..60 {
        left += u32::from(!walker.tick(&mut world).is_grounded());
    }
    // It falls by 5 cm in sqrt(2 h / g) = 0.1 s.
    assert!((4..=8).contains(&left), "{left} ticks in the air");
}

/// It stands at the end of a ledge until nothing of it is above it, and then falls.
#[test]
fn a_box_stands_on_a_ledge_to_its_edge() {
    let mut world = space();
    add(&mut world, Body::fixed(Shape::aabb(4.0, 1.0)).at([-2.0, -0.5]));
    let mut walker = Walker::new(Character::new(Shape::rectangle(0.6, 1.0)).at([0.29, 0.6]), 0.0);
    walker.run(&mut world, 5.0);
    assert!(walker.mover.is_grounded() && walker.place()[0] == 0.29);
    walker.speed = 0.6;
    walker.run(&mut world, 0.5);
    assert!(!walker.mover.is_grounded() && walker.place()[1] < 0.0);
}

/// A round foot slides off a ledge where it stands steeper than the character can walk, and onto the ledge it still walks.
#[test]
fn a_capsule_does_not_hang_on_a_ledge() {
    let capsule = Shape::capsule([0.0, -0.3], [0.0, 0.3], 0.3);
    let on_ledge = |x: f64, speed: f32| {
        let mut world = space();
        add(&mut world, Body::fixed(Shape::aabb(4.0, 1.0)).at([-2.0, -0.5]));
        let hero = Character::new(capsule).at([x, 0.61]).step_height(0.3).max_slope(45.0_f32.to_radians());
        let mut walker = Walker::new(hero, speed);
        walker.run(&mut world, 1.0);
        walker
    };
    // Of a radius of 0.3 m, 45° are 0.212 m past the edge.
    for (x, stands) in [(0.0, true), (0.1, true), (0.2, true), (0.22, false), (0.28, false), (0.299, false)] {
        let walker = on_ledge(x, 0.0);
        assert_eq!(walker.mover.is_grounded(), stands, "{x} m past the edge");
        assert_eq!(walker.place()[1] > 0.5, stands, "{x} m past the edge: at {:?}", walker.place());
    }
    // Where it walks to the ledge it gets onto it.
    let walker = on_ledge(0.28, -1.0);
    assert!(walker.mover.is_grounded() && walker.place()[1] > 0.6, "{:?}", walker.place());
}

/// It falls onto the middle of two pieces, with a side just over where they meet: the side of a piece below is no wall to it.
#[test]
fn it_lands_with_a_side_over_a_seam() {
    let grounds: [fn(&mut World); 2] = [
        |world| {
            for x in [-2.0, 2.0] {
                add(world, Body::fixed(Shape::rectangle(4.0, 1.0)).at([x, -0.5]));
            }
        },
        |world| _ = add(world, Ground::chain([[-4.0, 0.0], [0.0, 0.0], [4.0, 0.0]]).unwrap()),
    ];
    for (number, ground) in grounds.into_iter().enumerate() {
        for (width, height) in [(0.5, 1.0), (0.6, 1.8)] {
            for past in [-1e-4, -1e-6, 0.0, 1e-6, 1e-4] {
                for side in [-1.0, 1.0] {
                    let mut world = space();
                    ground(&mut world);
                    let at = [side * (0.5 * f64::from(width) + past), 0.5 * f64::from(height) + 0.2];
                    let mut walker = Walker::new(Character::new(Shape::rectangle(width, height)).at(at), 0.0);
                    // 0.2 m take sqrt(2 h / g) = 0.2 s.
                    walker.run(&mut world, 0.3);
                    for _ in 0..30 {
                        let moved = walker.tick(&mut world);
                        let stands = moved.is_grounded() && moved.wall.is_none();
                        assert!(stands, "ground {number}, {width} m wide, {past} m past, {side}: {moved:?}");
                    }
                }
            }
        }
    }
}
