//! Boxes that rub and do not bounce, thrown together in a closed room, came to the speed limit within a second where there were
//! eight `iterations` or more: a contact that began to bear load doubled its friction in each of them.

use rustycs::prelude::*;

use crate::support::add;

const SIDE: f32 = 0.2;

/// As many boxes in rows and columns, each with 2 m/s in a direction of its own, in a room that leaves each a square of
/// `spacing`, m.
fn room(columns: u16, spacing: f32, phase: f32, settings: &Settings) -> World {
    let mut world = World::new(Settings { sleep: false, ..settings.clone() });
    let half = 0.5 * f32::from(columns) * spacing;
    let long = 2.0 * half + 2.0;
    let rubs = |body: Body| body.friction(0.4).restitution(0.0);
    for (x, y, width, height) in
        [(-1.0, 0.0, 1.0, long), (1.0, 0.0, 1.0, long), (0.0, -1.0, long, 1.0), (0.0, 1.0, long, 1.0)]
    {
        let place = [x * (half + 0.5), y * (half + 0.5)];
        add(&mut world, rubs(Body::fixed(Shape::aabb(width, height)).at(place)));
    }
    for index in 0..columns * columns {
        let place = [index % columns, index / columns].map(|cell| (f32::from(cell) + 0.5) * spacing - half);
        let Rot { c, s } = Rot::from_angle(2.4 * f32::from(index) + phase);
        add(&mut world, rubs(Body::dynamic(Shape::obb(SIDE, SIDE)).at(place).velocity([2.0 * c, 2.0 * s])));
    }
    world
}

/// Collisions without restitution, and friction, only take kinetic energy. Boxes that are turned into one another are pushed
/// apart, which gives back what they had overlapped by: a hundredth of what they began with is room for that.
#[test]
fn no_number_of_iterations_makes_energy() {
    for (iterations, relax_iterations) in [(1, 1), (4, 1), (16, 1), (64, 1), (16, 16)] {
        for adaptive in [false, true] {
            for phase in 0..10_u8 {
                for (columns, spacing) in [(2, 0.25), (4, 0.22), (5, 0.28)] {
                    let settings = Settings { iterations, relax_iterations, adaptive, ..Settings::default() };
                    let mut world = room(columns, spacing, 0.37 * f32::from(phase), &settings);
                    let start = world.kinetic_energy();
                    for tick in 0..120 {
                        world.step();
                        let energy = world.kinetic_energy();
                        let of = format!(
                            "{iterations} and {relax_iterations} iterations, {columns}² boxes, phase {phase}, tick {tick}"
                        );
                        assert!(energy < 1.01 * start, "{of}: {energy} J of {start} J");
                    }
                }
            }
        }
    }
}
