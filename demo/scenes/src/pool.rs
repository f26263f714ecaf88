//! A pool that fills with discs.

use rustycs::{Body, Material, Settings, Shape, Vec2, World};

use crate::parts::{grid, put, put_pool, world_with_gravity};
use crate::random::Random;
use crate::{Scene, View};

/// A pool that fills with discs.
pub const SCENE: Scene = Scene {
    name: "pool",
    group: "classic",
    summary: "Discs of one size pour into a pool, jostle until each finds its place between others, and sleep once the last has stopped rolling.",
    view: View::above(-1.4, 0.0, 22.0, 14.4),
    build: |seed, settings| build_with(COUNT, seed, settings),
    is_random: true,
    ..Scene::PLAIN
};

/// Discs in the scene.
const COUNT: usize = 500;
/// Radius of a disc, m.
const RADIUS: f32 = 0.25;
/// From one disc to the next at the start, m: they are shifted by up to a tenth of it.
const PITCH: f32 = 0.65;

/// A pool with `count` discs above it, to see how cost grows with their number.
///
/// # Panics
/// If [`Settings::validate`] refuses `settings`.
pub fn build_with(count: usize, seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let mut random = Random::new(seed);
    // Half as high as wide when full.
    let width = 0.7 * (count.max(25) as f32).sqrt();
    put_pool(&mut world, width, 0.6 * width);
    let columns = (width / PITCH) as usize;
    for index in 0..count {
        let place = grid(index, columns, PITCH, [0.0, 1.0].into());
        let shift = [random.between(-0.06, 0.06), random.between(-0.06, 0.06)];
        let disc = Body::dynamic(Shape::circle(RADIUS)).at(place + Vec2::from(shift));
        put(&mut world, disc.material(Material::PLASTIC).restitution(0.2));
    }
    world
}
