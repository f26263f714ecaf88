//! A paddle that stirs a bowl of small bodies.

use rustycs::{Body, Material, Settings, Shape, Vec2, World};

use crate::parts::{grid, put, put_bowl, regular_polygon, world_with_gravity};
use crate::{Scene, View};

/// A paddle that stirs a bowl of small bodies.
pub const SCENE: Scene = Scene {
    name: "spinner",
    group: "machines",
    summary: "A paddle stirs 600 small bodies in a ring: it throws them, and never slows down nor lets one through.",
    view: View::above(-8.2, 0.0, 22.0, 16.4),
    build,
    ..Scene::PLAIN
};

/// Radius of the ring, m.
const RADIUS: f32 = 7.5;
/// Length and thickness of the paddle, m.
const PADDLE: [f32; 2] = [10.0, 0.5];
/// Rate at which the paddle turns, rad/s.
const SPIN: f32 = 2.5;
/// Small bodies.
const COUNT: usize = 600;

/// The paddle turns about its own centre, so it needs no steering. Half of the bodies begin above it and half
/// below.
fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    put_bowl(&mut world, RADIUS, 40, |_| true);
    let paddle = Body::kinematic(Shape::obb(PADDLE[0], PADDLE[1])).angular_velocity(SPIN);
    put(&mut world, paddle.material(Material::METAL).friction(0.6));
    let material = Material { density: 1.0, friction: 0.4, restitution: 0.1 };
    for index in 0..COUNT {
        let shape = match index % 3 {
            0 => Shape::circle(0.12),
            1 => Shape::obb(0.26, 0.17),
            _ => regular_polygon(5, 0.15),
        };
        let half = index / (COUNT / 2);
        let lowest = if half == 0 { -4.2 } else { 0.6 };
        let place = grid(index % (COUNT / 2), 25, 0.32, Vec2::new(0.0, lowest));
        put(&mut world, Body::dynamic(shape).at(place).material(material));
    }
    world
}

#[cfg(test)]
mod tests {
    use rustycs::BodyType;

    use super::*;

    #[test]
    fn the_paddle_keeps_its_pace_and_the_ring_its_content() {
        let mut world = SCENE.build(1, Settings::default());
        for _ in 0..300 {
            world.step();
        }
        for (_, body) in world.bodies() {
            match body.body_type() {
                BodyType::Kinematic => {
                    assert_eq!(body.angular_velocity(), SPIN);
                    assert_eq!(body.position_f64(), [0.0, 0.0]);
                }
                BodyType::Dynamic => assert!(body.position().length() < RADIUS, "{:?}", body.position()),
                BodyType::Fixed => {}
            }
        }
    }
}
