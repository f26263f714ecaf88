//! A gas of discs in a closed box.

use rustycs::{Body, Rot, Settings, Shape, Vec2, World};

use crate::parts::{ELASTIC, grid, put, put_room};
use crate::random::Random;
use crate::{Scene, View};

/// A gas of discs in a closed box.
pub const SCENE: Scene = Scene {
    name: "confined",
    group: "collisions",
    summary: "An elastic gas in a box: half of it is still at first, soon all are alike, and no energy is lost.",
    view: View::above(-8.6, 0.0, 26.0, 17.2),
    build,
    readout: Some(readout),
    is_random: true,
    ..Scene::PLAIN
};

/// Discs in the box.
const COUNT: usize = 384;
/// Radius of a disc, m.
const RADIUS: f32 = 0.28;
/// From one disc to the next at the start, m.
const PITCH: f32 = 0.75;
/// Discs in a row.
const COLUMNS: usize = 24;
/// Width and height of the box, m.
const ROOM: [f32; 2] = [20.0, 14.0];
/// Speed of the discs that move at first, m/s.
const SPEED: f32 = 5.0;

/// The left half moves, each disc its own way; the right half is at rest.
fn build(seed: u64, settings: Settings) -> World {
    let mut world = World::new(settings);
    put_room(&mut world, ROOM[0], ROOM[1], ELASTIC);
    let mut random = Random::new(seed);
    for index in 0..COUNT {
        let place = grid(index, COLUMNS, PITCH, [0.0, -6.0].into());
        let way = Rot::from_angle(random.angle()).rotate(Vec2::new(SPEED, 0.0));
        let velocity = if place.x < 0.0 { way } else { Vec2::ZERO };
        put(&mut world, Body::dynamic(Shape::circle(RADIUS)).at(place).velocity(velocity).material(ELASTIC));
    }
    world
}

fn readout(world: &World) -> String {
    format!("kinetic energy {:.3} J", world.kinetic_energy())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Restitution 1 without friction keeps the energy in each impact to the rounding of f32.
    #[test]
    fn the_gas_keeps_its_energy() {
        let mut world = SCENE.build(1, Settings::default());
        let before = world.kinetic_energy();
        for _ in 0..300 {
            world.step();
        }
        let ratio = world.kinetic_energy() / before;
        assert!((ratio - 1.0).abs() < 1e-2, "energy is {ratio} of what it was");
    }
}
