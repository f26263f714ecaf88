//! Ten boxes on top of each other, near the origin and far from it.

use rustycs::{Body, Material, Point, Settings, Shape, Vec2, World};

use crate::parts::{put, world_with_gravity};
use crate::{Scene, View};

/// Ten boxes on top of each other.
pub const SCENE: Scene = Scene {
    name: "tower",
    group: "stacks",
    summary: "Ten boxes stand on each other: none may sink, drift or tremble.",
    view: View::above(-1.2, 0.0, 14.0, 12.6),
    build: |_, settings| build_at(0.0, settings),
    hint: Some("Pull a box out, or shake the lowest one."),
    ..Scene::PLAIN
};

/// The same tower a million metres from the origin.
pub const FAR: Scene = Scene {
    name: "far_tower",
    group: "stacks",
    summary: "The tower a thousand kilometres from the origin: it stands as the one at the origin does.",
    view: View::above(-1.2, FAR_AWAY as f32, 14.0, 12.6),
    build: |_, settings| build_at(FAR_AWAY, settings),
    readout: Some(readout),
    ..Scene::PLAIN
};

/// How far the far tower is from the origin, m.
const FAR_AWAY: f64 = 1e6;
/// Boxes in the tower.
const BOXES: u8 = 10;
/// Side of a box, m.
const SIDE: f32 = 1.0;

/// The tower over `x`, m.
fn build_at(x: f64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let foot = Point::new(x, 0.0);
    let floor = Body::fixed(Shape::aabb(20.0, 1.0)).at(foot + Vec2::new(0.0, -0.5));
    put(&mut world, floor.material(Material::STONE));
    for level in 0..BOXES {
        let center = foot + Vec2::new(0.0, (f32::from(level) + 0.5) * SIDE);
        put(&mut world, Body::dynamic(Shape::obb(SIDE, SIDE)).at(center).material(Material::PLASTIC));
    }
    world
}

/// Where the uppermost box is: a millimetre shows.
fn readout(world: &World) -> String {
    match world.bodies().nth(usize::from(BOXES)) {
        Some((_, body)) => format!("the uppermost box is at x = {:.3} m", body.position_f64()[0]),
        None => "the uppermost box is gone".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An `f64` at 1e6 m has steps of 1e-10 m: the two towers differ by what that rounding grows to.
    #[test]
    fn the_far_tower_stands_as_the_near_one() {
        let [mut near, mut far] = [SCENE, FAR].map(|scene| scene.build(1, Settings::default()));
        for _ in 0..600 {
            near.step();
            far.step();
        }
        for ((_, near), (_, far)) in near.bodies().zip(far.bodies()) {
            let ([x, y], [x_far, y_far]) = (near.position_f64(), far.position_f64());
            assert!(
                (x_far - FAR_AWAY - x).abs() < 1e-3 && (y_far - y).abs() < 1e-3,
                "{x} {y}: {x_far} {y_far}"
            );
        }
    }
}
