//! A heavy box smashes into a wall of small ones.

use rustycs::{Body, Material, Settings, Shape, World};

use crate::parts::put;
use crate::{Scene, View};

/// A heavy box smashes into a wall of small ones.
pub const SCENE: Scene = Scene {
    name: "smash",
    group: "many",
    summary: "A heavy box at 40 m/s ploughs through 2,400 small ones that float in space.",
    view: View::above(-22.0, 0.0, 76.0, 44.0),
    build: |_, settings| build_with(60, 40, settings),
    ends_after: Some(6.0),
    ..Scene::PLAIN
};

/// Side of a small box, m.
const SIDE: f32 = 0.4;
/// Side of the heavy box, m.
const HEAVY: f32 = 4.0;

/// A wall of `columns` by `rows` boxes; 120 by 80 is the benchmark of Box2D.
///
/// # Panics
/// If [`Settings::validate`] refuses `settings`.
pub fn build_with(columns: usize, rows: usize, settings: Settings) -> World {
    let mut world = World::new(settings);
    let material = Material { density: 1.0, friction: 0.6, restitution: 0.0 };
    for row in 0..rows {
        for column in 0..columns {
            let place = [column as f32 * SIDE, (row as f32 - 0.5 * (rows - 1) as f32) * SIDE];
            put(&mut world, Body::dynamic(Shape::obb(SIDE, SIDE)).at(place).material(material));
        }
    }
    let heavy = Body::dynamic(Shape::obb(HEAVY, HEAVY)).at([-20.0, 0.0]).velocity([40.0, 0.0]);
    put(&mut world, heavy.material(material).density(8.0));
    world
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nothing acts from outside: m v of the heavy box is shared, none is lost.
    #[test]
    fn momentum_is_kept() {
        let mut world = build_with(30, 20, Settings::default());
        let before = world.momentum();
        for _ in 0..120 {
            world.step();
        }
        let error = (world.momentum() - before).length() / before.length();
        // 600 velocities of f32, each rounded once per contact and substep.
        assert!(error < 1e-4, "momentum {:?} after {before:?}", world.momentum());
    }
}
