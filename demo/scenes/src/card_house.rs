//! A house of cards, five levels high.

use rustycs::{Body, Material, Rot, Settings, Shape, World};

use crate::parts::{put, put_floor, world_with_gravity};
use crate::{Scene, View};

/// A house of cards, five levels high.
pub const SCENE: Scene = Scene {
    name: "card_house",
    group: "stacks",
    summary: "Forty thin cards hold each other up: whatever slides or trembles brings the house down.",
    view: View::above(-0.6, 0.0, 7.0, 6.0),
    build,
    hint: Some("Pull a card out. X shows the classic solver beside the default one."),
    ..Scene::PLAIN
};

/// Tents in the lowest level.
const LEVELS: u8 = 5;
/// Length of a card, m.
const LENGTH: f32 = 1.0;
/// Thickness of a card, m.
const THICKNESS: f32 = 0.04;
/// How far a card leans from upright, rad: 20°. A foot holds while the friction is above tan 20° = 0.36.
const LEAN: f32 = 20.0 * core::f32::consts::PI / 180.0;
/// From one tent to the next, m: a little more than a card, so that the cards that lie on them do not meet.
const PITCH: f32 = LENGTH + 0.02;
/// Friction of cards and floor.
const FRICTION: f32 = 0.8;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let floor = put_floor(&mut world, 12.0, 0.5);
    world.body_mut(floor).and_then(|mut floor| floor.set_friction(FRICTION).ok());

    let Rot { c: cos, s: sin } = Rot::from_angle(LEAN);
    // Half of the height and of the width that a leaning card takes.
    let half_height = 0.5 * (LENGTH * cos + THICKNESS * sin);
    let half_width = 0.5 * (LENGTH * sin + THICKNESS * cos);
    for level in 0..LEVELS {
        let bottom = f32::from(level) * (2.0 * half_height + THICKNESS);
        let tents = LEVELS - level;
        for tent in 0..tents {
            let apex = (f32::from(tent) - 0.5 * f32::from(tents - 1)) * PITCH;
            for side in [-1.0, 1.0] {
                let card = card().at([apex + side * half_width, bottom + half_height]).angle(side * LEAN);
                put(&mut world, card);
            }
        }
        // The cards that lie across this level carry the tents of the next.
        for across in 1..tents {
            let x = (f32::from(across) - 0.5 * f32::from(tents)) * PITCH;
            let y = bottom + 2.0 * half_height + 0.5 * THICKNESS;
            put(&mut world, card().at([x, y]).angle(core::f32::consts::FRAC_PI_2));
        }
    }
    world
}

/// An upright card.
fn card() -> Body {
    let material = Material { friction: FRICTION, restitution: 0.0, ..Material::PLASTIC };
    Body::dynamic(Shape::obb(THICKNESS, LENGTH)).material(material)
}
