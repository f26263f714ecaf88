//! Bodies that slide, roll and fall from one platform to the next.

use rustycs::{Body, Material, Settings, Shape, Vec2, World};

use crate::parts::{MATERIALS, beam, put, put_pool, regular_polygon, world_with_gravity};
use crate::{Scene, View};

/// Bodies that slide, roll and fall from one platform to the next.
pub const SCENE: Scene = Scene {
    name: "slide",
    group: "classic",
    summary: "Discs roll and boxes slide down a zigzag of ramps, fall from one to the next, and end in a heap.",
    view: View::above(-1.4, 0.0, 24.0, 18.4),
    build,
    ..Scene::PLAIN
};

/// Ramps of the zigzag.
const RAMPS: u8 = 3;
/// How far a ramp falls over its width, m.
const FALL: f32 = 3.4;
/// From one ramp to the next, m of height.
const STOREY: f32 = 4.6;
/// Height of the lower end of the lowest ramp, m.
const LOWEST: f32 = 2.0;
/// Half the width of the pool, m.
const SIDE: f32 = 8.0;

/// Each ramp leaves a gap at its lower end, through which bodies fall on the next. Two rows of bodies begin
/// above the highest.
fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    put_pool(&mut world, 2.0 * SIDE, LOWEST + f32::from(RAMPS) * STOREY);
    for ramp in 0..RAMPS {
        let low = LOWEST + f32::from(ramp) * STOREY;
        // Those with an even number fall to the right.
        let (left, right) = if ramp % 2 == 0 {
            (Vec2::new(-SIDE, low + FALL), Vec2::new(SIDE - 2.4, low))
        } else {
            (Vec2::new(2.4 - SIDE, low), Vec2::new(SIDE, low + FALL))
        };
        put(&mut world, beam(left, right, 0.3).friction(0.05));
    }
    let top = LOWEST + f32::from(RAMPS) * STOREY;
    for place in 0..16_u8 {
        let x = SIDE - 1.0 - f32::from(place % 8) * 1.1;
        let y = top + 0.6 + f32::from(place / 8) * 1.2;
        let shape = match place % 4 {
            0 => Shape::circle(0.35),
            1 => Shape::obb(0.7, 0.5),
            2 => regular_polygon(6, 0.4),
            _ => Shape::obb(0.45, 0.45),
        };
        let material = Material { friction: 0.2, ..MATERIALS[usize::from(place) % MATERIALS.len()] };
        put(&mut world, Body::dynamic(shape).at([x, y]).material(material));
    }
    world
}
