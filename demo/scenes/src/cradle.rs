//! Newton's cradle, laid on its side.

use rustycs::{Body, Material, Settings, Shape, World};

use crate::parts::put;
use crate::{Scene, View};

/// Newton's cradle, laid on its side.
pub const SCENE: Scene = Scene {
    name: "cradle",
    group: "collisions",
    summary: "One disc comes in, one leaves: the four between pass the impulse on and stay where they are.",
    view: View::above(-3.0, 0.0, 15.0, 6.0),
    build,
    readout: Some(readout),
    ..Scene::PLAIN
};

/// Discs that lie in a row and touch.
const DISCS: u8 = 5;
/// Radius of a disc, m: a sum of halves is exact, so the discs touch exactly.
const RADIUS: f32 = 0.5;
/// Speed of the disc that comes in, m/s.
const SPEED: f32 = 3.0;
/// Where the walls are that send it back, m from the middle.
const WALL: f32 = 6.5;

/// Nothing pulls, nothing rubs and everything bounces. The first of the discs begins away from the others.
fn build(_seed: u64, settings: Settings) -> World {
    let mut world = World::new(settings);
    for side in [-1.0, 1.0] {
        let wall = Body::fixed(Shape::aabb(0.5, 3.0)).at([side * (WALL + 0.25), 0.0]);
        put(&mut world, elastic(wall));
    }
    for place in 1..=DISCS {
        let x = (f32::from(place) - 0.5 * f32::from(DISCS)) * 2.0 * RADIUS;
        let body = Body::dynamic(Shape::circle(RADIUS));
        let body =
            if place == 1 { body.at([x - 3.0, 0.0]).velocity([SPEED, 0.0]) } else { body.at([x, 0.0]) };
        put(&mut world, elastic(body));
    }
    world
}

fn elastic(body: Body) -> Body {
    body.material(Material { friction: 0.0, restitution: 1.0, ..Material::METAL })
}

fn readout(world: &World) -> String {
    format!("kinetic energy {:.4} J, momentum {:+.3} kg m/s", world.kinetic_energy(), world.momentum().x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first disc meets the row after 2 m at 3 m/s; a second later only the last one moves, as fast.
    #[test]
    fn one_disc_comes_in_and_one_leaves() {
        let mut world = SCENE.build(1, Settings::default());
        for _ in 0..70 {
            world.step();
        }
        let speeds: Vec<f32> = world.bodies().skip(2).map(|(_, body)| body.velocity().x).collect();
        for (place, speed) in speeds.iter().enumerate() {
            let expected = if place + 1 == usize::from(DISCS) { SPEED } else { 0.0 };
            assert!((speed - expected).abs() < 1e-3 * SPEED, "disc {place} moves at {speed} m/s");
        }
    }
}
