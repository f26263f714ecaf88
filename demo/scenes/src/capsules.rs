//! Capsules and boxes with round corners that rain on a slope and a heap.

use rustycs::{Body, Material, Settings, Shape, Vec2, World};

use crate::mark::{Label, Mark};
use crate::parts::{put, put_pool, world_with_gravity};
use crate::random::Random;
use crate::{Scene, View};

/// Capsules and boxes with round corners that rain on a slope and a heap.
pub const SCENE: Scene = Scene {
    name: "capsules",
    group: "classic",
    summary: "Capsules and boxes with round corners rain down: they roll over their ends, and lie on their sides.",
    view: View::above(-1.4, 0.0, 22.0, 16.0),
    build,
    labels: &LABELS,
    is_random: true,
    ..Scene::PLAIN
};

const LABELS: [Label; 3] = [Label::text("capsule"), Label::text("round box"), Label::text("round triangle")];

/// Rows and columns of what falls.
const ROWS: u8 = 10;
const COLUMNS: u8 = 9;

/// Two ramps with round ends lead to the middle of a pool, above which the rows hang.
fn build(seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    put_pool(&mut world, 18.0, 6.0);
    for side in [-1.0, 1.0] {
        let (low, high) = (Vec2::new(3.4 * side, 1.6), Vec2::new(8.6 * side, 4.2));
        let middle = (low + high) * 0.5;
        put(&mut world, Body::fixed(Shape::capsule(low, high, 0.15)).at(middle).friction(0.4));
    }
    let mut random = Random::new(seed);
    for row in 0..ROWS {
        for column in 0..COLUMNS {
            let x = (f32::from(column) - 4.0) * 1.7 + random.between(-0.2, 0.2);
            let y = 6.5 + f32::from(row) * 1.6;
            let kind = usize::from(row + column) % 5 / 2;
            let body = Body::dynamic(falling(kind, &mut random)).at([x, y]).angle(random.angle());
            let mark = if row == 0 { Mark::label(kind) } else { Mark::default() };
            put(&mut world, mark.on(body.material(Material::PLASTIC)));
        }
    }
    world
}

/// A capsule, a box or a triangle with round corners, of some size.
fn falling(kind: usize, random: &mut Random) -> Shape {
    let size = random.between(0.25, 0.5);
    let corners: &[[f32; 2]] = match kind {
        0 => &[[-1.0, 0.0], [1.0, 0.0]],
        1 => &[[-1.0, -0.6], [1.0, -0.6], [1.0, 0.6], [-1.0, 0.6]],
        _ => &[[-0.8, -0.5], [0.8, -0.5], [0.0, 0.9]],
    };
    let radius = if kind == 0 { 0.6 * size } else { 0.3 * size };
    let corners = corners.iter().map(|&[x, y]| [size * x, size * y]);
    Shape::rounded(corners, radius).expect("corners of a convex outline")
}
