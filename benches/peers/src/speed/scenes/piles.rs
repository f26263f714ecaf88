//! What lies on top of each other, or flies about.

use std::f64::consts::{PI, TAU};

use rustycs_cases::chance::Chance;

use super::{Course, CourseKind, dynamic, fixed, square};
use crate::scene::{BodySpec, Outline, Scene, on_earth};

pub(super) fn races() -> Vec<Course> {
    vec![
        Course::race(
            "large-pyramid",
            "5050 boxes of 1 m in rows of 100 .. 1, set up without gaps.",
            large_pyramid(),
            500,
        ),
        Course::race(
            "many-pyramids",
            "20 × 20 pyramids of 55 boxes of 1 m, each row of them on a floor of its own.",
            many_pyramids(),
            200,
        ),
        Course::race(
            "smash",
            "A box of 4 m and eightfold density is thrown at 40 m/s into 120 × 80 boxes of 0.4 m; no gravity.",
            smash(),
            300,
        ),
        Course::race("pool", "10,000 discs of 0.2 to 0.3 m fall into a pool of 50 m.", pool_of_discs(), 600),
        Course::race(
            "gas",
            "20,000 discs of 0.1 m without friction and of restitution 1 fly about in a box of 200 m, 2 m/s and less.",
            gas(),
            300,
        ),
        Course::race(
            "mixed-pile",
            "3000 discs, boxes and polygons of equal density, 0.15 to 0.42 m from centre to corner, fall into a pool.",
            mixed_pile(3000),
            600,
        ),
        Course {
            warm_up: 300,
            ..Course::race(
                "asleep",
                "20,000 boxes of 1 m lie on floors, have fallen asleep, and may sleep on.",
                asleep(),
                600,
            )
        },
    ]
}

pub(super) fn sizes() -> Vec<Course> {
    let size = |count: usize| Course {
        kind: CourseKind::Size,
        is_dear: count > 16_000,
        ..Course::race(
            &format!("pile-{}k", count / 1000),
            &format!("The mixed pile of {count} bodies; the pool is wider by the root of their number."),
            mixed_pile(count),
            600,
        )
    };
    [1000, 2000, 4000, 8000, 16_000, 64_000].map(size).into()
}

/// A pyramid of boxes of 1 m, with its base on the height 0.
fn pyramid(base: usize, middle: f64, bottom: f64) -> impl Iterator<Item = BodySpec> {
    (0..base).flat_map(move |row| {
        let count = base - row;
        let x = move |column: usize| middle + column as f64 - 0.5 * (count - 1) as f64;
        (0..count).map(move |column| dynamic(square(1.0), [x(column), bottom + row as f64 + 0.5]))
    })
}

fn large_pyramid() -> Scene {
    on_earth([fixed(200.0, 2.0, [0.0, -1.0])].into_iter().chain(pyramid(100, 0.0, 0.0)))
}

fn many_pyramids() -> Scene {
    let (rows, base) = (20, 10);
    let spacing = [base as f64 + 1.0, base as f64 + 2.0];
    let width = rows as f64 * spacing[0];
    let mut bodies = Vec::new();
    for row in 0..rows {
        bodies.push(fixed(width, 1.0, [0.0, row as f64 * spacing[1] - 0.5]));
    }
    for row in 0..rows {
        for column in 0..rows {
            let x = (column as f64 - 0.5 * (rows - 1) as f64) * spacing[0];
            bodies.extend(pyramid(base, x, row as f64 * spacing[1]));
        }
    }
    on_earth(bodies)
}

fn smash() -> Scene {
    let (columns, rows, side) = (120, 80, 0.4);
    let ram = BodySpec { velocity: [40.0, 0.0], density: 8.0, ..dynamic(square(4.0), [-20.0, 0.0]) };
    let mut bodies = vec![ram];
    for column in 0..columns {
        for row in 0..rows {
            let place = [column as f64 * side + 30.0, (row as f64 - 0.5 * rows as f64) * side];
            bodies.push(dynamic(square(side), place));
        }
    }
    Scene { bodies, ..Scene::default() }
}

/// Floor and walls of a pool whose bottom is at the height 0.
fn pool(width: f64, height: f64) -> [BodySpec; 3] {
    let wall = |side: f64| fixed(2.0, height + 2.0, [side * (0.5 * width + 1.0), 0.5 * height - 1.0]);
    [fixed(width + 4.0, 2.0, [0.0, -1.0]), wall(-1.0), wall(1.0)]
}

fn pool_of_discs() -> Scene {
    let (width, cell) = (50.0, 0.65);
    let mut chance = Chance(1);
    let mut bodies: Vec<_> = pool(width, 120.0).into();
    let columns = ((width - 1.0) / cell) as usize;
    for index in 0..10_000 {
        let radius = chance.between(0.2, 0.3);
        let (column, row) = (index % columns, index / columns);
        let x = (column as f64 - 0.5 * (columns - 1) as f64) * cell + chance.between(-0.02, 0.02);
        bodies.push(dynamic(Outline::Circle { radius }, [x, 0.5 + row as f64 * cell]));
    }
    on_earth(bodies)
}

fn gas() -> Scene {
    let (width, columns, speed) = (200.0, 142, 2.0);
    let mut chance = Chance(2);
    let wall = |x: f64, y: f64| {
        let [w, h] = if y == 0.0 { [2.0, width + 4.0] } else { [width + 4.0, 2.0] };
        fixed(w, h, [x * (0.5 * width + 1.0), y * (0.5 * width + 1.0)])
    };
    let mut bodies = vec![wall(-1.0, 0.0), wall(1.0, 0.0), wall(0.0, -1.0), wall(0.0, 1.0)];
    let cell = width / columns as f64;
    for index in 0..20_000 {
        let (column, row) = (index % columns, index / columns);
        let place = |cells: usize| (cells as f64 + 0.5) * cell - 0.5 * width;
        let offset = [chance.between(-0.4, 0.4), chance.between(-0.4, 0.4)];
        let disc =
            dynamic(Outline::Circle { radius: 0.1 }, [place(column) + offset[0], place(row) + offset[1]]);
        let (way, fast) = (chance.between(0.0, TAU), chance.between(0.0, speed));
        bodies.push(BodySpec { velocity: [fast * way.cos(), fast * way.sin()], ..disc });
    }
    for body in &mut bodies {
        (body.friction, body.restitution) = (0.0, 1.0);
    }
    Scene { bodies, ..Scene::default() }
}

/// A disc, a box or a polygon of 3 to 6 corners.
fn any_outline(chance: &mut Chance) -> Outline {
    let reach = chance.between(0.15, 0.42);
    match chance.one_of(6) {
        0 | 1 => Outline::Circle { radius: reach },
        2 | 3 => {
            let half = chance.between(0.2 * PI, 0.3 * PI);
            Outline::Box { width: 2.0 * reach * half.cos(), height: 2.0 * reach * half.sin() }
        }
        // Regular, so that the centre of mass is the middle.
        _ => Outline::regular(3 + chance.one_of(4), reach),
    }
}

pub(super) fn mixed_pile(count: usize) -> Scene {
    let (width, cell) = (0.8 * (count as f64).sqrt(), 0.95);
    let mut chance = Chance(3);
    let mut bodies: Vec<_> = pool(width, 2.0 * width).into();
    let columns = (width / cell) as usize;
    for index in 0..count {
        let (column, row) = (index % columns, index / columns);
        let outline = any_outline(&mut chance);
        let x = (column as f64 - 0.5 * (columns - 1) as f64) * cell + chance.between(-0.05, 0.05);
        let y = 1.0 + (row as f64 + 0.5) * cell + chance.between(-0.05, 0.05);
        bodies.push(BodySpec { angle: chance.between(0.0, TAU), ..dynamic(outline, [x, y]) });
    }
    on_earth(bodies)
}

fn asleep() -> Scene {
    let mut bodies = Vec::new();
    for floor in 0..100 {
        bodies.push(fixed(400.0, 1.0, [0.0, 5.0 * f64::from(floor) - 0.5]));
    }
    for floor in 0..100 {
        for index in 0..200 {
            let place = [1.8 * f64::from(index) - 180.0, 5.0 * f64::from(floor) + 0.5];
            bodies.push(dynamic(square(1.0), place));
        }
    }
    Scene { sleeps: true, ..on_earth(bodies) }
}
