//! Ten boxes on top of each other.

use rustycs::{Body, Material, Settings, Shape, World};

use crate::parts::{put, put_floor, world_with_gravity};
use crate::{Scene, View};

/// Ten boxes on top of each other.
pub const SCENE: Scene = Scene {
    name: "tower",
    summary: "Ten boxes stand on each other: none may sink, drift or tremble.",
    view: View::above(-1.2, 0.0, 14.0, 12.6),
    build,
};

/// Boxes in the tower.
const BOXES: u8 = 10;
/// Side of a box, m.
const SIDE: f32 = 1.0;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    put_floor(&mut world, 20.0, 1.0);
    for level in 0..BOXES {
        let y = (f32::from(level) + 0.5) * SIDE;
        put(&mut world, Body::dynamic(Shape::obb(SIDE, SIDE)).at([0.0, y]).material(Material::PLASTIC));
    }
    world
}
