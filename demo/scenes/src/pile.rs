//! Bodies of every shape, size and material fall into a pool.

use rustycs::{Body, Settings, World};

use crate::parts::{put, put_pool, world_with_gravity};
use crate::random::Random;
use crate::{Scene, View};

/// Bodies of every shape, size and material fall into a pool.
pub const SCENE: Scene = Scene {
    name: "pile",
    group: "classic",
    summary: "Discs, boxes and polygons of every material fall into a pool and come to rest.",
    view: View::above(-1.4, 0.0, 20.0, 13.4),
    build: |seed, settings| build_with(COUNT, seed, settings),
    hint: Some("Take hold of a body and throw it."),
    is_random: true,
    ..Scene::PLAIN
};

/// Bodies in the scene.
pub const COUNT: usize = 450;

/// Distance from the centre to the farthest corner of a body, m: smallest and largest.
const RADIUS: [f32; 2] = [0.15, 0.42];
/// Side of the square that each body has for itself at the start, m: the largest fit in any angle.
const CELL: f32 = 0.95;
/// Height from which the lowest bodies fall, m.
const DROP: f32 = 3.0;

/// Width of the pool for `count` bodies, m. It grows with √count, so that the pile keeps its proportions: about
/// half as high as wide.
pub fn pool_width(count: usize) -> f32 {
    0.8 * (count.max(25) as f32).sqrt()
}

/// A pool with `count` bodies above it, to see how cost grows with their number.
///
/// # Panics
/// If [`Settings::validate`] refuses `settings`.
pub fn build_with(count: usize, seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let mut random = Random::new(seed);
    let width = pool_width(count);
    put_pool(&mut world, width, 0.6 * width);

    let columns = ((width / CELL) as usize).max(1);
    for index in 0..count {
        let (column, row) = (index % columns, index / columns);
        let shape = random.shape(RADIUS);
        // Anywhere in its square: the smaller the body, the further from the middle.
        let room = 0.5 * CELL - shape.extent();
        let x = (column as f32 - 0.5 * (columns - 1) as f32) * CELL + random.between(-room, room);
        let y = DROP + (row as f32 + 0.5) * CELL + random.between(-room, room);
        let material = random.material();
        let angle = random.angle();
        put(&mut world, Body::dynamic(shape).at([x, y]).angle(angle).material(material));
    }
    world
}
