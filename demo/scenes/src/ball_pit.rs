//! A round pit full of small balls, and heavy ones that drop in.

use rustycs::{Body, Material, Settings, Shape, Vec2, World};

use crate::parts::{grid, put, put_bowl, world_with_gravity};
use crate::random::Random;
use crate::{Scene, View};

/// A round pit full of small balls, and heavy ones that drop in.
pub const SCENE: Scene = Scene {
    name: "ball_pit",
    group: "many",
    summary: "Two thousand light balls settle in a bowl, and three heavy ones dive in to the bottom.",
    view: View::above(-13.2, 0.0, 32.0, 26.0),
    build,
    hint: Some("Throw a body in: choose one under Tools, and pull before letting go."),
    is_random: true,
    ..Scene::PLAIN
};

/// Small balls.
const COUNT: usize = 2000;
/// Radii of the small balls, m: smallest and largest.
const RADII: [f32; 2] = [0.14, 0.2];
/// Where the bowl ends: the sine of the angle above its middle.
const RIM: f32 = 0.55;
/// Radius of the bowl, m.
const BOWL: f32 = 12.0;

/// The bowl is open above, and what is thrown out lands on the ground below it. The balls begin in rows, the
/// heavy ones high above.
fn build(seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    put(&mut world, Body::fixed(Shape::aabb(100.0, 1.0)).at([0.0, -13.1]).material(Material::STONE));
    put_bowl(&mut world, BOWL, 64, |outward| outward.y < RIM);
    let mut random = Random::new(seed);
    let light = Material { density: 0.3, friction: 0.3, restitution: 0.3 };
    for index in 0..COUNT {
        let radius = random.between(RADII[0], RADII[1]);
        let place = grid(index, 44, 0.41, Vec2::new(0.0, -7.6));
        let shift = Vec2::new(random.between(-0.01, 0.01), 0.0);
        put(&mut world, Body::dynamic(Shape::circle(radius)).at(place + shift).material(light));
    }
    for (x, y, radius) in [(-4.0, 15.0, 1.0), (0.5, 20.0, 1.2), (4.5, 26.0, 0.8)] {
        put(&mut world, Body::dynamic(Shape::circle(radius)).at([x, y]).material(Material::METAL));
    }
    world
}
