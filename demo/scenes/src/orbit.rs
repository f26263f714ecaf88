//! A planet on an elliptic orbit.

use rustycs::{Body, Material, Settings, Shape, World};

use crate::parts::{put, put_attractor};
use crate::{Scene, View};

/// A planet on an elliptic orbit.
pub const SCENE: Scene = Scene {
    name: "orbit",
    group: "attraction",
    summary: "An ellipse of eccentricity 0.5 once in 10 s: fast near the sun, slow far from it, and it closes.",
    view: View::above(-5.0, -2.0, 14.0, 10.0),
    build,
    readout: Some(readout),
    is_about_paths: true,
    ..Scene::PLAIN
};

/// Half of the long axis, m.
pub const SEMI_MAJOR_AXIS: f32 = 4.0;
/// Eccentricity: 0 is a circle, 1 a fall.
pub const ECCENTRICITY: f32 = 0.5;
/// Time of one turn, s.
pub const PERIOD: f32 = 10.0;

/// Kepler: the period T and the half axis a give GM = a³ (2π / T)². The planet begins where it is nearest, at
/// a (1 - e), with the speed √(GM (1 + e) / (a (1 - e))).
fn build(_seed: u64, settings: Settings) -> World {
    let turn_rate = core::f32::consts::TAU / PERIOD;
    let gm = SEMI_MAJOR_AXIS * SEMI_MAJOR_AXIS * SEMI_MAJOR_AXIS * turn_rate * turn_rate;
    let nearest = SEMI_MAJOR_AXIS * (1.0 - ECCENTRICITY);
    let speed = (gm * (1.0 + ECCENTRICITY) / nearest).sqrt();

    let mut world = World::new(settings);
    put_attractor(&mut world, gm, None);
    put(&mut world, Body::fixed(Shape::circle(0.5)));
    let planet = Body::dynamic(Shape::circle(0.2)).at([nearest, 0.0]).velocity([0.0, speed]);
    put(&mut world, planet.material(Material::STONE).angular_velocity(turn_rate));
    world
}

fn readout(world: &World) -> String {
    format!("energy {:.4} J, angular momentum {:.4} kg m²/s", world.energy(), world.angular_momentum())
}
