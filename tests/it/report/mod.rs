//! The report: orders, planted errors, chaos, recommendations, refusals, and what it writes.

mod findings;
mod recommendations;
mod refusals;
mod writing;

use rustycs::prelude::*;

use crate::support::add;

/// A disc thrown upward at an angle, under gravity.
fn thrown(settings: Settings) -> World {
    let mut world = World::new(settings);
    world.add_force(Force::EARTH_GRAVITY);
    add(&mut world, Body::dynamic(Shape::circle(0.5)).velocity([3.0, 4.0]).angular_velocity(2.0));
    world
}

/// A planet at the far end of an ellipse of eccentricity 0.5: half axis 1 m, period 2π s.
#[expect(clippy::needless_pass_by_value, reason = "a scene is given its settings")]
fn planet(settings: Settings) -> World {
    let mut world = World::new(Settings { sleep: false, ..settings });
    world.add_attractor(Attractor::global([0.0, 0.0], 1.0).with_min_distance(0.01).unwrap());
    add(
        &mut world,
        Body::dynamic(Shape::circle(0.01)).at([1.5, 0.0]).velocity([0.0, (0.5_f32 / 1.5).sqrt()]),
    );
    world
}

/// A box that slides on a floor and stops.
fn sliding(settings: Settings) -> World {
    let mut world = World::new(settings);
    world.add_force(Force::EARTH_GRAVITY);
    add(&mut world, Body::fixed(Shape::aabb(100.0, 2.0)).at([0.0, -1.0]).friction(0.5));
    add(&mut world, Body::dynamic(Shape::obb(1.0, 0.5)).at([0.0, 0.25]).friction(0.5).velocity([5.0, 0.0]));
    world
}

/// Fifteen elastic discs in a triangle, hit by a sixteenth, between four walls.
fn break_of_discs(settings: Settings) -> World {
    let mut world = World::new(settings);
    let smooth = |body: Body| body.friction(0.0).restitution(1.0);
    for [x, y, width, height] in
        [[0.0, 3.5, 14.0, 1.0], [0.0, -3.5, 14.0, 1.0], [-6.5, 0.0, 1.0, 8.0], [6.5, 0.0, 1.0, 8.0]]
    {
        add(&mut world, smooth(Body::fixed(Shape::aabb(width, height)).at([x, y])));
    }
    for row in 0..5 {
        for place in 0..=row {
            let (row, place) = (f64::from(row), f64::from(place));
            let at = [1.0 + 0.36 * row, 0.41 * (place - 0.5 * row)];
            add(&mut world, smooth(Body::dynamic(Shape::circle(0.2)).at(at)));
        }
    }
    add(&mut world, smooth(Body::dynamic(Shape::circle(0.2)).at([-4.0, 0.05]).velocity([10.0, 0.0])));
    world
}
