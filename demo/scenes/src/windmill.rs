//! A mill that is turned by the balls that fall on it.

use rustycs::{Body, BodyType, Joint, Material, Rot, Settings, Shape, Vec2, World};

use crate::joined::{GHOST, join};
use crate::mark::Mark;
use crate::parts::{put, world_with_gravity};
use crate::{Scene, View};

/// A mill that is turned by the balls that fall on it.
pub const SCENE: Scene = Scene {
    name: "windmill",
    group: "joints",
    summary: "Eight blades are welded to a hub that turns on a pin; balls fall on one side and drive it.",
    view: View::above(-6.0, 0.0, 20.0, 14.0),
    build,
    before_tick: Some(lift),
    readout: Some(readout),
    ..Scene::PLAIN
};

const BLADES: u8 = 8;
/// Radius of the hub, and how far the blades reach, m.
const HUB: f32 = 0.7;
const REACH: f32 = 4.2;
const BALLS: u8 = 40;
/// From where the balls fall, and below which height they are taken up again, m.
const TOP: f32 = 7.0;
const BOTTOM: f32 = -7.0;
/// Balls are marked as this part.
const BALL: usize = 0;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let hub = Body::dynamic(Shape::circle(HUB)).material(Material::STONE).filter(GHOST);
    let hub = put(&mut world, hub);
    // Bearings rub.
    let pin = join(&mut world, Joint::revolute(hub, None).motor(0.0, 60.0));
    if let Some(mut pin) = world.joint_mut(pin) {
        pin.set_user_data(1);
    }
    for blade in 0..BLADES {
        let turn = Rot::from_angle(f32::from(blade) / f32::from(BLADES) * core::f32::consts::TAU);
        let out = turn.rotate(Vec2::new(1.0, 0.0));
        let length = REACH - HUB;
        let body = Body::dynamic(Shape::obb(length, 0.22)).at(out * (HUB + 0.5 * length)).angle(turn.angle());
        let body = put(&mut world, body.material(Material::PLASTIC).filter(GHOST));
        join(&mut world, Joint::weld(hub, body).at(out * HUB));
    }
    for ball in 0..BALLS {
        let place = above(ball) + Vec2::new(0.0, 0.9 * f32::from(ball));
        let body = Body::dynamic(Shape::circle(0.28)).at(place).material(Material::RUBBER).restitution(0.1);
        put(&mut world, Mark::part(BALL).on(body));
    }
    world
}

/// Where a ball falls from, m: each a little aside of the one before.
fn above(ball: u8) -> Vec2 {
    Vec2::new(2.2 + 0.25 * f32::from(ball % 5), TOP)
}

/// Takes balls that have fallen through up again.
fn lift(world: &mut World) {
    let is_ball = |body: rustycs::BodyRef<'_>| {
        Mark::of(body).part == Some(BALL) && body.body_type() == BodyType::Dynamic
    };
    let balls: Vec<_> =
        world.bodies().filter(|&(_, body)| is_ball(body)).map(|(id, body)| (id, body.position())).collect();
    for (number, (id, place)) in balls.into_iter().enumerate() {
        if place.y > BOTTOM {
            continue;
        }
        let top = above(number as u8);
        let reach = Vec2::new(0.3, 0.3);
        if world.bodies_in(top - reach, top + reach).is_empty()
            && let Some(mut ball) = world.body_mut(id)
        {
            // Numbers of a scene are within what a body can be given.
            _ = ball.set_position(top);
            ball.set_velocity([0.0, -2.0]).set_angular_velocity(0.0);
        }
    }
}

fn readout(world: &World) -> String {
    let pin = world.joints().find(|(_, joint)| joint.user_data() == 1);
    pin.map_or_else(String::new, |(_, pin)| {
        let turns = -pin.angle() / core::f64::consts::TAU;
        format!("{turns:+.2} turns, {:+.2} rad/s, the pin bears {:.0} N", -pin.speed(), pin.force().length())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;

    /// Balls on the right turn it clockwise.
    #[test]
    fn balls_turn_the_mill() {
        let mut world = SCENE.build(1, Settings::default());
        run(&SCENE, &mut world, 1_200);
        let (_, pin) = world.joints().find(|(_, joint)| joint.user_data() == 1).expect("there is a pin");
        assert!(pin.angle() > 6.0, "the world has turned by {} rad as seen from it", pin.angle());
    }
}
