//! Platforms of every shape, and bodies of every shape that fall on them.

use rustycs::{Body, Material, Settings, Shape, World};

use crate::parts::{put, put_pool, regular_polygon, world_with_gravity};
use crate::random::Random;
use crate::{Scene, View};

/// Platforms of every shape, and bodies of every shape that fall on them.
pub const SCENE: Scene = Scene {
    name: "platforms",
    group: "classic",
    summary: "Every shape falls on fixed platforms of every shape, flat and tilted, round and pointed.",
    view: View::above(-1.4, 0.0, 26.0, 16.0),
    build,
    is_random: true,
    ..Scene::PLAIN
};

/// Bodies that fall.
const COUNT: usize = 60;

fn build(seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    put_pool(&mut world, 20.0, 12.0);
    let platforms = [
        Body::fixed(Shape::aabb(3.0, 0.5)).at([-7.5, 3.2]),
        Body::fixed(Shape::obb(3.4, 0.4)).at([-3.0, 4.4]).angle(-0.35),
        Body::fixed(Shape::circle(1.1)).at([0.8, 3.0]),
        Body::fixed(regular_polygon(3, 1.2)).at([4.2, 4.0]),
        Body::fixed(regular_polygon(6, 1.0)).at([7.8, 3.0]).angle(0.2),
        Body::fixed(Shape::obb(2.6, 0.4)).at([-6.2, 6.6]).angle(0.3),
        Body::fixed(regular_polygon(5, 0.8)).at([0.4, 6.8]).angle(0.4),
        Body::fixed(Shape::aabb(2.0, 0.4)).at([6.6, 6.6]),
    ];
    for platform in platforms {
        put(&mut world, platform.material(Material::STONE));
    }
    let mut random = Random::new(seed);
    for index in 0..COUNT {
        let shape = random.shape([0.2, 0.42]);
        let (column, row) = (index % 15, index / 15);
        let x = (column as f32 - 7.0) * 1.2 + random.between(-0.15, 0.15);
        let y = 9.0 + row as f32 * 1.2;
        let (angle, material) = (random.angle(), random.material());
        put(&mut world, Body::dynamic(shape).at([x, y]).angle(angle).material(material));
    }
    world
}
