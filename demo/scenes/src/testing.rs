//! What the tests of several scenes need.

use rustycs::World;

use crate::Scene;

/// Steps a world of the scene for so many ticks.
pub(crate) fn run(scene: &Scene, world: &mut World, ticks: usize) {
    for _ in 0..ticks {
        scene.before_tick(world);
        world.step();
    }
}
