//! Scenes as games have them.

use rustycs_cases::chance::Chance;

use super::{Course, CourseKind, dynamic, fixed, square};
use crate::scene::{BodySpec, Outline, Scene, on_earth};

pub(super) fn courses() -> [Course; 3] {
    let everyday = |name, statement, scene, ticks| Course {
        kind: CourseKind::Everyday,
        ..Course::race(name, statement, scene, ticks)
    };
    [
        everyday(
            "platformer",
            "A level of 300 bodies: 200 tiles in ledges, and 60 crates, 30 balls and 10 stones that fall onto them.",
            platformer(),
            1200,
        ),
        everyday(
            "puzzle",
            "50 bodies: floor, three shelves and two slopes, 24 planks and boxes in towers, 20 balls that roll against them.",
            puzzle(),
            1200,
        ),
        everyday("one-ball", "A ball of restitution 0.8 on a floor.", one_ball(), 6000),
    ]
}

fn platformer() -> Scene {
    let mut chance = Chance(4);
    let mut bodies = Vec::new();
    for ledge in 0..20 {
        let (left, height) = (chance.between(-60.0, 50.0), 2.0 + 2.0 * f64::from(ledge % 10));
        for tile in 0..10 {
            bodies.push(fixed(1.0, 1.0, [left + f64::from(tile), height - 0.5]));
        }
    }
    for index in 0..100 {
        let place = [chance.between(-60.0, 60.0), 24.0 + 0.1 * f64::from(index)];
        let outline = match index % 10 {
            0..6 => square(0.8),
            6..9 => Outline::Circle { radius: 0.35 },
            _ => Outline::regular(5, 0.5),
        };
        bodies.push(BodySpec { restitution: 0.2, ..dynamic(outline, place) });
    }
    // What falls between the ledges lands here.
    bodies[199] = fixed(160.0, 2.0, [0.0, -1.0]);
    on_earth(bodies)
}

fn puzzle() -> Scene {
    let mut bodies = vec![fixed(60.0, 2.0, [0.0, -1.0])];
    for shelf in 1..4 {
        bodies.push(fixed(12.0, 0.4, [0.0, 4.0 * f64::from(shelf) - 0.2]));
    }
    for (side, angle) in [(-1.0, -0.3), (1.0, 0.3)] {
        bodies.push(BodySpec { angle, ..fixed(6.0, 0.3, [8.0 * side, 14.0]) });
    }
    for tower in 0..8 {
        let [x, bottom] = [if tower % 2 == 0 { -3.0 } else { 3.0 }, 4.0 * f64::from(tower / 2)];
        bodies.push(dynamic(square(0.6), [x, bottom + 0.3]));
        let plank = Outline::Box { width: 2.0, height: 0.2 };
        bodies.push(dynamic(plank, [x, bottom + 0.7]));
        bodies.push(dynamic(square(0.5), [x, bottom + 1.05]));
    }
    for ball in 0..20 {
        let side = if ball % 2 == 0 { -1.0 } else { 1.0 };
        let place = [side * (8.5 + 0.3 * f64::from(ball / 2 % 3)), 15.5 + 0.7 * f64::from(ball / 2)];
        bodies.push(BodySpec { restitution: 0.3, ..dynamic(Outline::Circle { radius: 0.3 }, place) });
    }
    on_earth(bodies)
}

fn one_ball() -> Scene {
    let ball = BodySpec { restitution: 0.8, ..dynamic(Outline::Circle { radius: 0.5 }, [0.0, 5.0]) };
    on_earth(vec![fixed(20.0, 1.0, [0.0, -0.5]), ball])
}
