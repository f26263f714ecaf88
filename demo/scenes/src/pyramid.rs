//! A pyramid of boxes, twenty at the base.

use rustycs::{Body, Material, Settings, Shape, World};

use crate::parts::{put, put_floor, world_with_gravity};
use crate::{Scene, View};

/// A pyramid of boxes, twenty at the base.
pub const SCENE: Scene = Scene {
    name: "pyramid",
    group: "stacks",
    summary: "210 boxes lean on nothing but friction: the lowest carry twenty layers and must not be squeezed out.",
    view: View::above(-1.2, 0.0, 23.0, 18.4),
    build,
    hint: Some("Take hold of a box and throw it at the others."),
    ..Scene::PLAIN
};

/// Boxes in the lowest layer.
const BASE: u8 = 20;
/// Side of a box, m.
const SIDE: f32 = 0.8;
/// Room between neighbours in a layer, m.
const GAP: f32 = 0.08;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    put_floor(&mut world, 30.0, 1.0);
    for layer in 0..BASE {
        let y = (f32::from(layer) + 0.5) * SIDE;
        let in_layer = BASE - layer;
        let material = if layer % 2 == 0 { Material::STONE } else { Material::PLASTIC };
        for column in 0..in_layer {
            let x = (f32::from(column) - 0.5 * f32::from(in_layer - 1)) * (SIDE + GAP);
            put(&mut world, Body::dynamic(Shape::obb(SIDE, SIDE)).at([x, y]).material(material));
        }
    }
    world
}
