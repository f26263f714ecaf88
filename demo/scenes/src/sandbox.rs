//! An empty room.

use rustycs::{Body, Material, Settings, Shape, World};

use crate::parts::{put, put_floor, world_with_gravity};
use crate::{Scene, View};

/// An empty room.
pub const SCENE: Scene = Scene {
    name: "sandbox",
    group: "classic",
    summary: "An empty room under the Earth's gravity, to build and to break in.",
    view: View::above(-1.2, 0.0, WIDTH + 2.4, HEIGHT + 2.4),
    build,
    hint: Some("Choose a shape under Tools and click here to make it; pull before letting go to throw it."),
    ..Scene::PLAIN
};

/// Inner width and height of the room, m.
const WIDTH: f32 = 20.0;
const HEIGHT: f32 = 12.0;
/// Thickness of floor, walls and ceiling, m.
const WALL: f32 = 1.0;

/// Walls all round, so that nothing is lost.
fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    put_floor(&mut world, WIDTH + 2.0 * WALL, WALL);
    for side in [-1.0, 1.0] {
        let wall = Body::fixed(Shape::aabb(WALL, HEIGHT)).at([side * 0.5 * (WIDTH + WALL), 0.5 * HEIGHT]);
        put(&mut world, wall.material(Material::STONE));
    }
    let ceiling = Body::fixed(Shape::aabb(WIDTH + 2.0 * WALL, WALL)).at([0.0, HEIGHT + 0.5 * WALL]);
    put(&mut world, ceiling.material(Material::STONE));
    world
}
