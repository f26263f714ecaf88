//! A bridge of planks, and what falls on it.

use rustycs::{Body, Joint, Material, Settings, Shape, Vec2, World};

use crate::joined::{bar, divided, join, largest_gap, put_chain};
use crate::parts::{grid, put, world_with_gravity};
use crate::{Scene, View};

/// A bridge of planks, and what falls on it.
pub const SCENE: Scene = Scene {
    name: "bridge",
    group: "joints",
    summary: "Thirty planks hold twelve crates of stone: the bridge hangs lower, and its hinges do not stretch.",
    view: View::above(-4.5, 0.0, 26.0, 14.0),
    build,
    readout: Some(readout),
    hint: Some("Pull at a plank, or drop more on it."),
    ..Scene::PLAIN
};

/// Half of the distance of the banks, m.
const HALF: f32 = 9.0;
const PLANKS: u16 = 30;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    for side in [-1.0, 1.0] {
        let bank = Body::fixed(Shape::aabb(4.0, 5.0)).at([side * (HALF + 2.1), -2.6]);
        put(&mut world, bank.material(Material::STONE));
    }
    let places: Vec<Vec2> = divided(Vec2::new(-HALF, 0.0), Vec2::new(HALF, 0.0), PLANKS)
        .into_iter()
        .map(|place| place + Vec2::new(0.0, -1.6 * (1.0 - (place.x / HALF) * (place.x / HALF))))
        .collect();
    let planks = put_chain(&mut world, &places, |from, to| bar(from, to, 0.2).density(8.0).friction(0.8));
    join(&mut world, Joint::revolute(planks[0], None).at(places[0]));
    let last = usize::from(PLANKS);
    join(&mut world, Joint::revolute(planks[last - 1], None).at(places[last]));
    for crate_ in 0..12 {
        let place = grid(crate_, 4, 1.6, Vec2::new(0.3, 2.0));
        let body = Body::dynamic(Shape::obb(1.0, 1.0)).at(place).material(Material::STONE);
        put(&mut world, body.restitution(0.1));
    }
    world
}

fn readout(world: &World) -> String {
    let most = world.joints().map(|(_, joint)| joint.force().length()).fold(0.0, f32::max);
    format!("most in a hinge {:.1} kN, largest gap {:.4} mm", 1e-3 * most, 1e3 * largest_gap(world))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;

    /// Every crate comes to rest on the bridge, and the hinges hold to a tenth of a millimetre.
    #[test]
    fn crates_lie_on_the_bridge() {
        let mut world = SCENE.build(1, Settings::default());
        run(&SCENE, &mut world, 1_200);
        assert!(largest_gap(&world) < 1e-4, "{} m", largest_gap(&world));
        let lowest = world.bodies().map(|(_, body)| body.position().y).fold(0.0, f32::min);
        assert!(lowest > -6.0, "something is at {lowest} m");
    }
}
