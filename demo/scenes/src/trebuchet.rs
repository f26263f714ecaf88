//! A trebuchet, and the tower at which it aims.

use rustycs::{Body, Joint, JointId, Material, Settings, Shape, Vec2, World};

use crate::joined::{GHOST, bar, join};
use crate::parts::{beam, put, put_floor, world_with_gravity};
use crate::{Scene, View};

/// A trebuchet, and the tower at which it aims.
pub const SCENE: Scene = Scene {
    name: "trebuchet",
    group: "joints",
    summary: "A weight falls, the long arm swings the sling around, and it lets the stone go as it flies ahead.",
    view: View::above(-1.0, 12.0, 44.0, 20.0),
    build,
    before_tick: Some(let_go),
    readout: Some(readout),
    ends_after: Some(12.0),
    ..Scene::PLAIN
};

/// Where the arm turns, m, and how long its arms are, m.
const PIVOT: Vec2 = Vec2::new(0.0, 4.0);
const LONG: f32 = 5.2;
const SHORT: f32 = 1.3;
/// Length of the sling, m.
const SLING: f32 = 4.0;
/// Masses of weight and stone, kg.
const WEIGHT: f32 = 1_500.0;
const STONE: f32 = 12.0;
/// The joint of the sling is marked with this.
const IS_SLING: u64 = 1;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    put_floor(&mut world, 120.0, 1.0);
    // The long arm begins low on the left.
    let along = Vec2::new(-0.75, -0.661_438);
    let (tip, butt) = (PIVOT + along * LONG, PIVOT - along * SHORT);
    for side in [-1.0, 1.0] {
        let foot = Vec2::new(side * 2.2, 0.0);
        put(&mut world, beam(PIVOT, foot, 0.2).filter(GHOST));
    }
    let arm = put(&mut world, bar(tip, butt, 0.25).material(Material::PLASTIC).filter(GHOST));
    join(&mut world, Joint::revolute(arm, None).at(PIVOT));
    let weight = Body::dynamic(Shape::obb(1.3, 1.3)).at(butt - Vec2::new(0.0, 0.9)).mass(WEIGHT);
    let weight = put(&mut world, weight.material(Material::METAL).filter(GHOST));
    join(&mut world, Joint::revolute(arm, weight).at(butt));
    let stone = Vec2::new(tip.x + 0.95 * SLING, 0.3);
    let body = Body::dynamic(Shape::circle(0.3)).at(stone).mass(STONE).material(Material::STONE);
    let body = put(&mut world, body.friction(0.1).filter(GHOST));
    let sling = Joint::rope(arm, body).between(tip, stone).max_length(SLING);
    join(&mut world, sling.user_data(IS_SLING));
    for floor in 0..6_u8 {
        for column in 0..2_u8 {
            let place = [26.0 + 1.3 * f32::from(column), 0.5 + f32::from(floor)];
            put(&mut world, Body::dynamic(Shape::obb(1.2, 1.0)).at(place).material(Material::PLASTIC));
        }
    }
    world
}

fn sling(world: &World) -> Option<JointId> {
    world.joints().find(|(_, joint)| joint.user_data() == IS_SLING).map(|(id, _)| id)
}

/// The sling opens when the stone flies up ahead at less than 45 degrees.
fn let_go(world: &mut World) {
    let Some(id) = sling(world) else { return };
    let stone = world.joint(id).and_then(|joint| joint.body_b()).and_then(|stone| world.body(stone));
    let velocity = stone.map_or(Vec2::ZERO, |stone| stone.velocity());
    if velocity.x > 5.0 && velocity.y > 0.0 && velocity.y < velocity.x {
        world.remove_joint(id);
    }
}

fn readout(world: &World) -> String {
    let force = sling(world).and_then(|id| world.joint(id)).map(|joint| joint.force().length());
    force.map_or_else(
        || "the sling is open".to_owned(),
        |force| format!("the sling bears {:.2} kN", 1e-3 * force),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;

    /// The sling opens, and the stone flies farther than the tower is high.
    #[test]
    fn the_stone_flies_to_the_tower() {
        let mut world = SCENE.build(1, Settings::default());
        run(&SCENE, &mut world, 720);
        assert!(sling(&world).is_none(), "the sling is shut");
        let farthest = world.bodies().map(|(_, body)| body.position().x).fold(0.0, f32::max);
        assert!(farthest > 27.5, "nothing is beyond {farthest} m");
    }
}
