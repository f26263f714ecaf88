//! Bodies of every shape, size and material fall into a pool.
//!
//! Random numbers come from xoshiro256++ (Blackman and Vigna 2018, <https://prng.di.unimi.it>), which `rand`
//! offers under its own name: unlike `StdRng` and `SmallRng` it never becomes another algorithm, it works on
//! 64-bit integers only, and it needs none of the crate's features. A float is its upper bits times a power of
//! two, which rounds nowhere, so a seed gives the same bodies on every machine.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::{Body, Material, Rot, Settings, Shape, Vec2, World};

use crate::parts::{put, world_with_gravity};
use crate::{Scene, View};

/// Bodies of every shape, size and material fall into a pool.
pub const SCENE: Scene = Scene {
    name: "pile",
    summary: "Discs, boxes and polygons of every material fall into a pool and come to rest.",
    view: View::above(-1.4, 0.0, 20.0, 13.4),
    build: |seed, settings| build_with(COUNT, seed, settings),
};

/// Bodies in the scene.
pub const COUNT: usize = 450;

/// Distance from the centre to the farthest corner of a body, m: smallest and largest.
const RADIUS: [f32; 2] = [0.15, 0.42];
/// Side of the square that each body has for itself at the start, m: the largest fit in any angle.
const CELL: f32 = 0.95;
/// Thickness of the walls and depth of the floor, m: four times what the fastest body moves in a substep.
const WALL: f32 = 1.0;
/// Height from which the lowest bodies fall, m.
const DROP: f32 = 3.0;

const MATERIALS: [Material; 5] =
    [Material::DEFAULT, Material::RUBBER, Material::PLASTIC, Material::STONE, Material::METAL];

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
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let width = pool_width(count);
    put_pool(&mut world, width);

    let columns = ((width / CELL) as usize).max(1);
    for index in 0..count {
        let (column, row) = (index % columns, index / columns);
        let shape = random_shape(&mut random);
        // Anywhere in its square: the smaller the body, the further from the middle.
        let room = 0.5 * CELL - shape.extent();
        let x = (column as f32 - 0.5 * (columns - 1) as f32) * CELL + random.random_range(-room..room);
        let y = DROP + (row as f32 + 0.5) * CELL + random.random_range(-room..room);
        let material = MATERIALS[random.random_range(0..MATERIALS.len() as u32) as usize];
        let angle = random.random_range(0.0..core::f32::consts::TAU);
        put(&mut world, Body::dynamic(shape).at([x, y]).angle(angle).material(material));
    }
    world
}

/// A floor with its upper side at height 0, and two walls that reach above the pile at rest.
fn put_pool(world: &mut World, width: f32) {
    let outer = width + 2.0 * WALL;
    let floor = Body::fixed(Shape::aabb(outer, WALL)).at([0.0, -0.5 * WALL]);
    put(world, floor.material(Material::STONE));
    let height = 0.6 * width;
    for side in [-1.0, 1.0] {
        let wall = Body::fixed(Shape::aabb(WALL, height)).at([side * 0.5 * (width + WALL), 0.5 * height]);
        put(world, wall.material(Material::STONE));
    }
}

/// A disc, a box or a polygon that fits into a circle of a radius within [`RADIUS`].
fn random_shape(random: &mut Xoshiro256PlusPlus) -> Shape {
    let radius = random.random_range(RADIUS[0]..RADIUS[1]);
    match random.random_range(0..3_u32) {
        0 => Shape::circle(radius),
        1 => {
            // Half the angle between the diagonals: 26° is twice as wide as high, 45° a square.
            let Rot { c, s } = Rot::from_angle(random.random_range(0.46..core::f32::consts::FRAC_PI_4));
            Shape::obb(2.0 * radius * c, 2.0 * radius * s)
        }
        _ => random_polygon(random, radius),
    }
}

/// A polygon with 3 to 8 corners on a circle, which makes it convex, none of them close to another.
fn random_polygon(random: &mut Xoshiro256PlusPlus, radius: f32) -> Shape {
    let corners = random.random_range(3..=8_u32);
    let pitch = core::f32::consts::TAU / corners as f32;
    let points: Vec<Vec2> = (0..corners)
        .map(|corner| {
            let angle = pitch * (corner as f32 + random.random_range(-0.25_f32..0.25));
            Rot::from_angle(angle).rotate(Vec2::new(radius, 0.0))
        })
        .collect();
    let convex = |points: Vec<Vec2>| {
        Shape::polygon(points).expect("corners on a circle, a quarter of the pitch off at most, are convex")
    };
    // The centroid is not quite the middle of the circle; about it, too, the farthest corner is at `radius`.
    let shape = convex(points);
    let scale = radius / shape.extent();
    convex(shape.vertices().iter().map(|&vertex| vertex * scale).collect())
}
