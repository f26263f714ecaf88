//! At walls, in corners, under ceilings and in gaps.

use rustycs::prelude::*;

use super::{DT, Walker, shapes, skin};
use crate::support::{add, add_floor, space};

/// Pressed against a wall, of one piece or of tiles, it falls and jumps as in the air.
#[test]
fn it_does_not_stick_to_walls() {
    for shape in shapes() {
        let half = f64::from(shape.bounding_box(Pose::at([0.0, 0.0])).max.x);
        for is_tiled in [false, true] {
            let mut world = space();
            if is_tiled {
                for y in -30..30 {
                    add(&mut world, Body::fixed(Shape::aabb(1.0, 1.0)).at([half + 0.6, f64::from(y)]));
                }
            } else {
                add(&mut world, Body::fixed(Shape::aabb(1.0, 60.0)).at([half + 0.6, 0.0]));
            }
            let mut walker = Walker::new(Character::new(shape).at([0.0, 10.0]), 5.0);
            walker.jump(4.0);
            for tick in 1..=60 {
                let moved = walker.tick(&mut world);
                // After n ticks: v n dt - g dt² n (n + 1) / 2.
                let n = f64::from(tick);
                let fallen = 4.0 * n / 60.0 - 9.81 * n * (n + 1.0) / 7200.0;
                let [x, y] = walker.place();
                assert!((y - 10.0 - fallen).abs() < 1e-3, "{y}, not {}", 10.0 + fallen);
                assert!(!moved.is_grounded());
                assert!(tick < 4 || moved.wall.is_some() && (x - 0.1 + skin(shape)).abs() < 1e-5, "at {x}");
            }
        }
    }
}

/// In a corner, between a slope and a wall, and under a ceiling that comes down, it is still.
#[test]
fn it_does_not_tremble_in_corners() {
    for shape in shapes() {
        for speed in [0.5, 5.0] {
            let mut world = space();
            add_floor(&mut world, 0.5);
            add(&mut world, Body::fixed(Shape::aabb(1.0, 8.0)).at([3.0, 0.0]));
            add(&mut world, Body::fixed(Shape::rectangle(8.0, 0.5)).at([-6.0, 1.2]).angle(0.3));
            for speed in [speed, -speed] {
                let mut walker = Walker::new(Character::new(shape).at([0.0, 0.6]), speed);
                walker.run(&mut world, 16.0);
                let before = walker.mover.position();
                for _ in 0..120 {
                    let moved = walker.tick(&mut world);
                    assert!(moved.is_grounded() && walker.mover.position().distance(before) < 1e-4);
                }
            }
        }
    }
}

/// A jump ends at a ceiling, and not beside it; below a sloping one it goes on along it.
#[test]
fn ceilings_stop_a_jump() {
    for shape in shapes() {
        let mut world = space();
        add_floor(&mut world, 0.5);
        add(&mut world, Body::fixed(Shape::aabb(40.0, 1.0)).at([0.0, 2.0]));
        let mut walker = Walker::new(Character::new(shape).at([0.0, 0.51]), 2.0);
        walker.run(&mut world, 0.5);
        walker.jump(20.0);
        let moved = walker.tick(&mut world);
        let moved = if moved.ceiling.is_some() { moved } else { walker.tick(&mut world) };
        assert!(moved.ceiling.is_some_and(|hit| hit.normal.y < -0.99));
        assert!((walker.place()[1] - 1.0 + skin(shape)).abs() < 1e-4, "{:?}", walker.place());
        walker.fall = 0.0;
        walker.run(&mut world, 1.0);
        assert!(walker.mover.is_grounded());
    }
}

/// Between two slopes that are too steep to stand on it stands.
/// Also where it does not fall while it stands, and where it tries to walk up one of them.
#[test]
fn it_stands_between_steep_slopes() {
    for shape in shapes() {
        let mut world = space();
        for side in [-1.0_f32, 1.0] {
            let slope = Body::fixed(Shape::rectangle(6.0, 0.5)).at([side * 1.6, 2.0]).angle(side * 1.1);
            add(&mut world, slope);
        }
        let mut walker = Walker::new(Character::new(shape).at([0.1, 4.0]), 0.0);
        walker.run(&mut world, 4.0);
        let before = walker.mover.position();
        assert!(walker.mover.is_grounded(), "at {before}");
        walker.run(&mut world, 2.0);
        assert!(walker.mover.position().distance(before) < 1e-3);
        for speed in [0.0, 2.0, -2.0] {
            for _ in 0..60 {
                world.step();
                let moved = walker.mover.move_by(&mut world, [speed * DT, 0.0]);
                assert!(moved.is_grounded(), "at {speed} m/s");
            }
            let now = walker.mover.position();
            assert!(now.distance(before) < 0.02, "{speed} m/s: from {before} to {now}");
        }
    }
}

/// Through a gap as wide as itself and two of the gaps that it keeps, and a little.
#[test]
fn it_fits_through_a_gap_of_its_size() {
    for shape in shapes() {
        let room = 1.0 + 2.5 * skin(shape);
        let mut world = space();
        add_floor(&mut world, 0.5);
        add(&mut world, Body::fixed(Shape::aabb(4.0, 1.0)).at([5.0, room + 0.5]));
        let mut walker = Walker::new(Character::new(shape).at([0.0, 0.6]), 4.0);
        walker.run(&mut world, 3.0);
        let expected = 12.0 - f64::from(DT);
        assert!((walker.place()[0] - expected).abs() < 0.1, "at {:?}", walker.place());
    }
}

/// Random ways in a random place: it is never within anything, never anywhere that is no place, and the same in every run.
#[test]
fn it_never_gets_into_anything_and_is_the_same_in_every_run() {
    let wander = |shape: Shape, seed: u64| {
        let mut state = seed;
        let mut random = move |low: f32, high: f32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            low + (high - low) * ((state >> 33) as f32 / 2_147_483_648.0)
        };
        let mut world = space();
        for (at, size) in [
            ([0.0, -6.0], [14.0, 1.0]),
            ([0.0, 6.0], [14.0, 1.0]),
            ([-7.0, 0.0], [1.0, 14.0]),
            ([7.0, 0.0], [1.0, 14.0]),
        ] {
            add(&mut world, Body::fixed(Shape::aabb(size[0], size[1])).at(at));
        }
        let shape_of = |number: u8, size: f32| match number % 3 {
            0 => Shape::rectangle(size, 0.4),
            1 => Shape::circle(0.5 * size),
            _ => Shape::polygon([[0.0, 0.0], [size, 0.2], [0.3, size]]).unwrap(),
        };
        for number in 0..14 {
            let (at, angle) = ([random(-6.0, 6.0), random(-5.5, 3.0)], random(-3.0, 3.0));
            add(&mut world, Body::fixed(shape_of(number, random(0.5, 1.6))).at(at).angle(angle));
        }
        let mut walker = Walker::new(Character::new(shape).at([0.0, 4.7]), 0.0);
        let mut way = 0.0_f32;
        for tick in 0..1_500 {
            if tick % 40 == 0 {
                walker.speed = random(-8.0, 8.0);
                if walker.mover.is_grounded() {
                    walker.jump(random(0.0, 9.0));
                }
            }
            let moved = walker.tick(&mut world);
            way += moved.translation.length();
            assert_eq!(moved.crushed_by, None);
            let pose = walker.mover.pose();
            for (_, body) in world.bodies() {
                let manifold = collision::detect(&shape, pose, body.shape(), body.pose());
                let depth = manifold
                    .map_or(0.0, |found| -found.points().iter().map(|p| p.separation).fold(0.0, f32::min));
                assert!(depth < 1e-4, "seed {seed}, tick {tick}: {depth} m deep at {pose:?}");
            }
            // The room is 13 m wide and 11 m high.
            assert!(
                pose.center.x.abs() < 6.5 && pose.center.y.abs() < 5.5,
                "seed {seed}, tick {tick}: {pose:?}"
            );
        }
        assert!(way > 10.0, "seed {seed}: it hung after {way} m");
        walker.place().map(f64::to_bits)
    };
    for shape in shapes() {
        for seed in 1..12 {
            assert_eq!(wander(shape, seed), wander(shape, seed));
        }
    }
}
