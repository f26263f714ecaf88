//! A car on hills, with a bridge on its way.

use rustycs::{Body, BodyId, Joint, JointId, Material, Settings, Shape, Vec2, World};

use crate::joined::{bar, divided, join, put_chain};
use crate::parts::{beam, put, world_with_gravity};
use crate::{Scene, View};

/// A car on hills, with a bridge on its way.
pub const SCENE: Scene = Scene {
    name: "car",
    group: "joints",
    summary: "Two driven wheels on springs, over hills and a hanging bridge of planks, there and back again.",
    view: View::above(-6.0, 0.0, 44.0, 20.0),
    build,
    before_tick: Some(drive),
    played: Some(played),
    readout: Some(readout),
    hint: Some("Drive it yourself: ← and →, or a finger on either side."),
    ..Scene::PLAIN
};

/// Distance of two places of the ground, m, and their heights, m: left of the bridge, and right of it.
const PITCH: f32 = 2.0;
const LEFT: [f32; 8] = [4.0, 1.6, 0.4, 0.0, 0.4, 0.9, 0.7, 0.0];
const RIGHT: [f32; 8] = [0.0, 0.2, 1.0, 0.5, 0.3, 0.9, 2.4, 5.4];
/// Half of the width of the bridge, m.
const GAP: f32 = 6.0;
/// Planks of the bridge.
const PLANKS: u16 = 13;
/// Where the car turns round, m from the middle.
const TURN: f32 = 14.0;
/// Radius of a wheel, m.
const WHEEL: f32 = 0.45;
/// Speed of the wheels, rad/s, and the torque of each motor, N m.
const SPEED: f32 = 18.0;
const TORQUE: f32 = 8.0;
/// What the joints of the wheels are marked with: the direction in which they drive.
const TO_RIGHT: u64 = 1;
const TO_LEFT: u64 = 2;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let left = |place: usize| Vec2::new(-GAP - PITCH * (7 - place) as f32, LEFT[place]);
    let right = |place: usize| Vec2::new(GAP + PITCH * place as f32, RIGHT[place]);
    let mut banks = Vec::new();
    for piece in 0..7 {
        for ends in [[left(piece), left(piece + 1)], [right(piece), right(piece + 1)]] {
            banks.push(put(&mut world, beam(ends[0], ends[1], 0.6).friction(0.9)));
        }
    }
    // The pieces of ground that meet the bridge: the last of the left, the first of the right.
    put_bridge(&mut world, [banks[12], banks[1]]);
    put_car(&mut world, Vec2::new(-11.0, 2.2));
    world
}

/// A bridge that hangs through by more than its planks are thick, so that they have room.
fn put_bridge(world: &mut World, banks: [BodyId; 2]) {
    let ends = [Vec2::new(-GAP, -0.1), Vec2::new(GAP, -0.1)];
    let places: Vec<Vec2> = divided(ends[0], ends[1], PLANKS)
        .into_iter()
        .map(|place| {
            let along = place.x / GAP;
            place + Vec2::new(0.0, -1.2 * (1.0 - along * along))
        })
        .collect();
    let plank = |from, to| bar(from, to, 0.18).density(4.0).friction(0.9);
    let planks = put_chain(world, &places, plank);
    join(world, Joint::revolute(planks[0], banks[0]).at(ends[0]));
    join(world, Joint::revolute(planks[planks.len() - 1], banks[1]).at(ends[1]));
}

fn put_car(world: &mut World, at: Vec2) {
    let outline = [[-1.4, -0.3], [1.4, -0.3], [1.5, 0.05], [0.7, 0.5], [-0.7, 0.5], [-1.5, 0.15]];
    let hull = Shape::polygon(outline).expect("the outline of a car is convex");
    let hull = put(world, Body::dynamic(hull).at(at).material(Material::DEFAULT));
    for side in [-1.0, 1.0] {
        let axle = at + Vec2::new(0.95 * side, -0.45);
        let wheel = Body::dynamic(Shape::circle(WHEEL)).at(axle).material(Material::RUBBER);
        let wheel = put(world, wheel.friction(0.9).restitution(0.0));
        let joint = Joint::wheel(hull, wheel).at(axle).suspension(3.0, 0.7).travel(-0.2..=0.2);
        join(world, joint.motor(-SPEED, TORQUE).user_data(TO_RIGHT));
    }
}

/// The joints of the wheels.
fn wheels(world: &World) -> Vec<JointId> {
    world.joints().filter(|(_, joint)| joint.user_data() != 0).map(|(id, _)| id).collect()
}

/// Drives on, and turns round at the ends of the way.
fn drive(world: &mut World) {
    for id in wheels(world) {
        let Some(mut joint) = world.joint_mut(id) else { continue };
        let [at, _] = joint.view().anchors();
        let is_at_end = at.x.abs() > f64::from(TURN);
        let direction = match (is_at_end, at.x > 0.0) {
            (false, _) => joint.view().user_data(),
            (true, false) => TO_RIGHT,
            (true, true) => TO_LEFT,
        };
        joint.set_user_data(direction);
        joint.set_motor(if direction == TO_RIGHT { -SPEED } else { SPEED }, TORQUE);
    }
}

/// Drives where the keys say, and brakes gently where none is down.
fn played(world: &mut World, [left, right]: [bool; 2]) {
    let speed = SPEED * (f32::from(u8::from(left)) - f32::from(u8::from(right)));
    for id in wheels(world) {
        if let Some(mut joint) = world.joint_mut(id) {
            joint.set_motor(speed, if speed == 0.0 { 0.2 * TORQUE } else { TORQUE });
        }
    }
}

fn readout(world: &World) -> String {
    let id = wheels(world).first().copied();
    let Some(wheel) = id.and_then(|id| world.joint(id)) else { return String::new() };
    let speed = world.body(wheel.body_a()).map_or(0.0, |hull| hull.velocity().length());
    format!("{:.1} km/h, springs bear {:.0} N", 3.6 * speed, wheel.force().length())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::joined::largest_gap;

    /// It comes to both ends of the way, over the bridge, and its wheels stay on.
    #[test]
    fn the_car_goes_there_and_back() {
        let mut world = SCENE.build(1, Settings::default());
        let (mut least, mut most) = (0.0_f64, 0.0_f64);
        for _ in 0..3_000 {
            SCENE.before_tick(&mut world);
            world.step();
            let id = wheels(&world)[0];
            let [at, _] = world.joint(id).expect("the wheel is on").anchors();
            (least, most) = (least.min(at.x), most.max(at.x));
            assert!(largest_gap(&world) < 0.05, "{} m at {} s", largest_gap(&world), world.time());
        }
        assert!(least < -f64::from(GAP) && most > f64::from(TURN), "it went from {least} to {most}");
    }
}
