//! A heavy ball on a light chain, and a tower.

use rustycs::{Body, Joint, Material, Settings, Shape, Vec2, World};

use crate::joined::{bar, divided, join, largest_gap, put_chain};
use crate::parts::{put, put_floor, world_with_gravity};
use crate::{Scene, View};

/// A heavy ball on a light chain, and a tower.
pub const SCENE: Scene = Scene {
    name: "wrecking_ball",
    group: "joints",
    summary: "A ball of four hundred times the mass of a link swings into a tower, and the chain does not stretch.",
    view: View::above(-0.8, 0.0, 30.0, 16.0),
    build,
    readout: Some(readout),
    ..Scene::PLAIN
};

/// Where the chain hangs, m; how many links it has, and how long each is, m.
const TOP: Vec2 = Vec2::new(-1.5, 14.0);
const LINKS: u16 = 14;
const LINK: f32 = 0.7;
/// Radius of the ball, m.
const BALL: f32 = 1.3;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    put_floor(&mut world, 80.0, 1.0);
    let end = TOP - Vec2::new(LINK * f32::from(LINKS), 0.0);
    let links = put_chain(&mut world, &divided(TOP, end, LINKS), |from, to| bar(from, to, 0.12).density(2.0));
    join(&mut world, Joint::revolute(links[0], None).at(TOP));
    let ball = Body::dynamic(Shape::circle(BALL)).at(end - Vec2::new(BALL, 0.0));
    let ball = put(&mut world, ball.material(Material::METAL).density(13.0));
    join(&mut world, Joint::revolute(links[links.len() - 1], ball).at(end));
    for floor in 0..7_u8 {
        for column in 0..3_u8 {
            let place = [2.0 + 1.25 * f32::from(column), 0.5 + f32::from(floor)];
            let body = Body::dynamic(Shape::obb(1.2, 1.0)).at(place).material(Material::STONE);
            put(&mut world, body.restitution(0.1));
        }
    }
    world
}

fn readout(world: &World) -> String {
    let most = world.joints().map(|(_, joint)| joint.force().length()).fold(0.0, f32::max);
    format!("most in a link {:.1} kN, largest gap {:.4} mm", 1e-3 * most, 1e3 * largest_gap(world))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;

    /// The ball has the mass that is said, and strikes blocks off the tower.
    #[test]
    fn the_ball_wrecks_the_tower() {
        let mut world = SCENE.build(1, Settings::default());
        let masses: Vec<f32> = world.bodies().map(|(_, body)| body.mass()).collect();
        let ratio = masses[usize::from(LINKS) + 1] / masses[1];
        assert!((380.0..450.0).contains(&ratio), "{ratio}");
        run(&SCENE, &mut world, 400);
        let far = world.bodies().filter(|(_, body)| body.position().x > 6.0).count();
        assert!(far >= 5, "{far} blocks have been thrown");
    }
}
