//! Regular polygons, from the triangle to the octagon.

use rustycs::{Body, Material, Settings, World};

use crate::mark::{Label, Mark};
use crate::parts::{put, put_pool, regular_polygon, world_with_gravity};
use crate::random::Random;
use crate::{Scene, View};

/// Regular polygons, from the triangle to the octagon.
pub const SCENE: Scene = Scene {
    name: "polygons",
    group: "classic",
    summary: "Polygons of 3 to 8 corners fall: the more corners, the further they roll before they lie.",
    view: View::above(-1.4, 0.0, 22.0, 15.0),
    build,
    labels: &LABELS,
    is_random: true,
    ..Scene::PLAIN
};

const LABELS: [Label; 6] = [
    Label::text("triangle"),
    Label::text("square"),
    Label::text("pentagon"),
    Label::text("hexagon"),
    Label::text("heptagon"),
    Label::text("octagon"),
];

/// Rows of polygons.
const ROWS: u8 = 6;
/// Distance from the middle of a polygon to a corner, m.
const RADIUS: f32 = 0.7;

/// A column for each polygon; the lowest of each bears its name.
fn build(seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    put_pool(&mut world, 18.0, 6.0);
    let mut random = Random::new(seed);
    for row in 0..ROWS {
        for column in 0..6_u8 {
            let x = (f32::from(column) - 2.5) * 2.6 + random.between(-0.4, 0.4);
            let y = 2.0 + f32::from(row) * 1.9;
            let shape = regular_polygon(column + 3, RADIUS);
            let body = Body::dynamic(shape).at([x, y]).angle(random.angle()).material(Material::PLASTIC);
            let mark = if row == 0 { Mark::label(usize::from(column)) } else { Mark::default() };
            put(&mut world, mark.on(body));
        }
    }
    world
}
