//! Nothing but the ground.

use rustycs::{Settings, World};

use crate::parts::{put_floor, world_with_gravity};
use crate::{Scene, View};

/// Nothing but the ground.
pub const SCENE: Scene = Scene {
    name: "sandbox",
    group: "classic",
    summary: "An empty world under the Earth's gravity, with a floor to build on.",
    view: View::above(-1.2, 0.0, 20.0, 12.0),
    build,
    ..Scene::PLAIN
};

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    put_floor(&mut world, 60.0, 1.0);
    world
}
