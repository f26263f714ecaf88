//! A box of each material on a ramp.

use rustycs::{Body, Material, Rot, Settings, Shape, Vec2, World};

use crate::mark::{Label, Mark};
use crate::parts::{put, put_floor, world_with_gravity};
use crate::{Scene, View};

/// A box of each material on a ramp.
pub const SCENE: Scene = Scene {
    name: "slope",
    group: "classic",
    summary: "25° is too steep for metal and stone, which slide, and not for the others, which stick.",
    view: View::above(-5.0, 1.5, 26.0, 17.0),
    build,
    labels: &LABELS,
    is_about_names: true,
    ..Scene::PLAIN
};

const LABELS: [Label; 5] = [
    Label::text("rubber"),
    Label::text("plastic"),
    Label::text("default"),
    Label::text("stone"),
    Label::text("metal"),
];

/// Angle of the ramp, rad: 25°. tan 25° = 0.466 parts the frictions below.
pub const ANGLE: f32 = 25.0 * core::f32::consts::PI / 180.0;
/// Friction of the ramp. The mean with rubber is 0.6, plastic and default 0.5, stone 0.4, metal 0.3.
const RAMP_FRICTION: f32 = 0.4;
/// Length of the ramp's upper side, m.
const RAMP: f32 = 16.0;
/// Where the upper side of the ramp meets the floor, m.
const FOOT: Vec2 = Vec2::new(4.0, 0.0);

/// From the top down, so that those that slide have nobody before them.
const BOXES: [Material; 5] =
    [Material::RUBBER, Material::PLASTIC, Material::DEFAULT, Material::STONE, Material::METAL];

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    // The ramp rises to the left: a long box under the line from the foot along `uphill`.
    let turn = Rot::from_angle(-ANGLE);
    let (uphill, outward) = (turn.rotate(Vec2::new(-1.0, 0.0)), turn.rotate(Vec2::new(0.0, 1.0)));
    let thickness = 0.4;
    let middle = FOOT + uphill * (0.5 * RAMP) - outward * (0.5 * thickness);
    let ramp = Body::fixed(Shape::obb(RAMP, thickness)).at(middle).angle(-ANGLE);
    put(&mut world, ramp.material(Material::STONE).friction(RAMP_FRICTION));
    // After the ramp, so that what of the ramp is below it does not show.
    put_floor(&mut world, 40.0, 1.0);

    let side = 0.8;
    for (place, material) in BOXES.into_iter().enumerate() {
        let along = RAMP - 1.5 - 2.0 * place as f32;
        let center = FOOT + uphill * along + outward * (0.5 * side);
        let body = Body::dynamic(Shape::obb(1.2, side)).at(center).angle(-ANGLE).material(material);
        put(&mut world, Mark::label(place).on(body));
    }
    world
}
