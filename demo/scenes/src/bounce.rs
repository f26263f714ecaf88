//! Balls of every restitution, dropped side by side.

use rustycs::{Body, Material, Settings, Shape, World};

use crate::mark::{Label, Mark};
use crate::parts::{put, world_with_gravity};
use crate::{Scene, View};

/// Balls of every restitution, dropped side by side.
pub const SCENE: Scene = Scene {
    name: "bounce",
    group: "collisions",
    summary: "Restitution 0 to 1 from left to right: each bounce reaches e² of the height before it.",
    view: View::above(-1.0, 0.0, 15.0, 8.6),
    build,
    labels: &LABELS,
    is_about_names: true,
    ..Scene::PLAIN
};

const LABELS: [Label; BALLS as usize] = [
    Label::text("e = 0"),
    Label::text("0.125"),
    Label::text("0.25"),
    Label::text("0.375"),
    Label::text("0.5"),
    Label::text("0.625"),
    Label::text("0.75"),
    Label::text("0.875"),
    Label::text("e = 1"),
];

/// Balls in the row, restitution 0 to 1 in even steps.
const BALLS: u8 = 9;
/// Radius of a ball, m.
const RADIUS: f32 = 0.45;
/// How far a ball falls, m.
const DROP: f32 = 6.0;
/// From one ball to the next, m.
const PITCH: f32 = 1.5;

/// Every ball has a plate of its own with the same restitution, so that any rule of mixing gives just that.
fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    for place in 0..BALLS {
        let restitution = f32::from(place) / f32::from(BALLS - 1);
        let x = (f32::from(place) - 0.5 * f32::from(BALLS - 1)) * PITCH;
        let plate = Body::fixed(Shape::aabb(1.2, 0.4)).at([x, -0.2]).restitution(restitution);
        put(&mut world, plate);
        let ball = Body::dynamic(Shape::circle(RADIUS)).at([x, RADIUS + DROP]).material(Material::RUBBER);
        put(&mut world, Mark::label(usize::from(place)).on(ball.restitution(restitution)));
    }
    world
}
