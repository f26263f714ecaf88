//! An engine of five cylinders about one crank.

use rustycs::{Body, BodyId, Joint, Material, Rot, Settings, Shape, Vec2, World};

use crate::joined::{GHOST, bar, join, largest_gap};
use crate::parts::put;
use crate::{Scene, View};

/// An engine of five cylinders about one crank.
pub const SCENE: Scene = Scene {
    name: "radial_engine",
    group: "joints",
    summary: "A motor turns the crank, and five pistons go to and fro: six joints hold on to one pin.",
    view: View::above(-5.0, 0.0, 16.0, 10.0),
    build,
    readout: Some(readout),
    ..Scene::PLAIN
};

const CYLINDERS: u8 = 5;
/// Radius of the crank and length of a rod, m.
const CRANK: f32 = 0.9;
const ROD: f32 = 2.5;
/// Speed of the crank, rad/s, and the torque of its motor, N m.
const SPEED: f32 = 6.0;
const TORQUE: f32 = 500.0;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = World::new(settings);
    let block = put(&mut world, Body::fixed(Shape::circle(0.25)).filter(GHOST));
    let disc = Body::dynamic(Shape::circle(1.25)).material(Material::STONE).filter(GHOST);
    let disc = put(&mut world, disc);
    join(&mut world, Joint::revolute(block, disc).motor(SPEED, TORQUE));
    let pin = Vec2::new(0.0, CRANK);
    for cylinder in 0..CYLINDERS {
        let turn = f32::from(cylinder) / f32::from(CYLINDERS) * core::f32::consts::TAU;
        put_cylinder(&mut world, [block, disc], pin, Rot::from_angle(turn));
    }
    world
}

/// A cylinder that points upward, turned; its piston and the rod from there to the pin.
fn put_cylinder(world: &mut World, [block, disc]: [BodyId; 2], pin: Vec2, turn: Rot) {
    let out = turn.rotate(Vec2::new(0.0, 1.0));
    // The end of the rod is on the axis: |s out - pin| = ROD.
    let (along, across) = (out.dot(pin), out.cross(pin));
    let end = out * (along + (ROD * ROD - across * across).sqrt());
    for side in [-1.0, 1.0] {
        let wall = Body::fixed(Shape::obb(0.12, 2.0)).at(out * 3.2 + out.perp() * (side * 0.62));
        put(world, wall.angle(turn.angle()).material(Material::STONE).filter(GHOST));
    }
    let piston = Body::dynamic(Shape::obb(1.1, 0.6)).at(end).angle(turn.angle()).material(Material::METAL);
    let piston = put(world, piston.filter(GHOST));
    let rod = put(world, bar(pin, end, 0.2).material(Material::PLASTIC).filter(GHOST));
    join(world, Joint::prismatic(block, piston).at(end).axis(out));
    join(world, Joint::revolute(disc, rod).at(pin));
    join(world, Joint::revolute(rod, piston).at(end));
}

fn readout(world: &World) -> String {
    let Some((_, crank)) = world.joints().next() else { return String::new() };
    let turns = crank.angle() / core::f64::consts::TAU;
    let (torque, gap) = (crank.torque(), 1e6 * largest_gap(world));
    format!("{turns:.2} turns, motor {torque:+.0} N m, largest gap {gap:.3} µm")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;

    /// The motor keeps its speed, and the pins hold to what an `f32` tells of 4 m.
    #[test]
    fn the_crank_turns_at_the_speed_of_its_motor() {
        let mut world = SCENE.build(1, Settings::default());
        run(&SCENE, &mut world, 600);
        let (_, crank) = world.joints().next().expect("there is a crank");
        let turned = crank.angle();
        // It has its speed after a fraction of a second.
        assert!((55.0..60.1).contains(&turned), "{turned} rad");
        assert!(largest_gap(&world) < 2e-6, "{} m", largest_gap(&world));
    }
}
