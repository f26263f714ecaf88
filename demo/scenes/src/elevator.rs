//! An elevator with its counterweight, and a stone in a block and tackle.

use rustycs::{Body, BodyId, Joint, JointId, JointMut, Material, Settings, Shape, Vec2, World};

use crate::joined::{join, largest_gap};
use crate::parts::{beam, put, put_floor, world_with_gravity};
use crate::{Scene, View};

/// An elevator with its counterweight, and a stone in a block and tackle.
pub const SCENE: Scene = Scene {
    name: "elevator",
    group: "joints",
    summary: "A counterweight bears the car and its crates, so that the motor hardly has to lift; in a block of three strands a third of its weight lifts a stone.",
    view: View::above(-0.8, 2.0, 24.0, 15.0),
    build,
    before_tick: Some(run),
    played: Some(played),
    readout: Some(readout),
    hint: Some("← lowers it, → lifts it."),
    ..Scene::PLAIN
};

/// Height of the beam under which the wheels are, and radius of a wheel, m.
const BEAM: f32 = 13.0;
const WHEEL: f32 = 0.3;
/// Where the car goes, m: its middle, its floor at the lowest, how far up; how fast, m/s, and the greatest force of the motor, N.
const CAR: f32 = -4.0;
const LOWEST: f32 = 0.4;
const TRAVEL: f32 = 7.0;
const SPEED: f32 = 1.6;
const FORCE: f32 = 8_000.0;
/// Near the ends, by how much slower for each metre less that is left, 1/s, and how fast it goes at least, m/s.
const BRAKES: f32 = 1.5;
const CREEP: f32 = 0.05;
/// Masses, kg: of the car without its load, and of the counterweight.
const EMPTY: f32 = 600.0;
const WEIGHT: f32 = 1_000.0;
/// The stone, and what draws it up, kg.
const STONE: f32 = 1_500.0;
const DRAWS: f32 = 560.0;
/// Strands that the stone hangs on.
const STRANDS: f64 = 3.0;
/// What the guide of the car is marked with: whether it lifts.
const LIFTS: u64 = 1;
const LOWERS: u64 = 2;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let floor = put_floor(&mut world, 60.0, 1.0);
    let top = |x: f32| Vec2::new(x, BEAM + 0.5);
    put(&mut world, beam(top(-8.0), top(12.0), 0.5));
    for x in [-7.8, 11.8] {
        put(&mut world, beam(Vec2::new(x - 0.2, BEAM), Vec2::new(x + 0.2, BEAM), BEAM));
    }
    let car = put_car(&mut world, floor);
    let weight = Body::dynamic(Shape::rectangle(1.0, 1.6)).at([0.0, BEAM - 3.0]).mass(WEIGHT);
    let weight = put(&mut world, weight.material(Material::METAL));
    hang(&mut world, [car, weight], [1.5, 0.8], 1.0);
    let [draws, stone] = [(4.0, BEAM - 2.5, DRAWS, 1.0), (9.0, 1.0, STONE, 2.0)].map(|(x, y, mass, side)| {
        let body = Body::dynamic(Shape::rectangle(side, side)).at([x, y]).mass(mass);
        put(&mut world, body.material(Material::STONE).restitution(0.0))
    });
    hang(&mut world, [draws, stone], [0.5, 1.0], STRANDS);
    world
}

/// A floor, a roof and two posts, between guides; and crates in it.
fn put_car(world: &mut World, floor: BodyId) -> BodyId {
    let (width, height, thin) = (4.0, 3.0, 0.16);
    let at = Vec2::new(CAR, LOWEST);
    let plate = |y: f32| rustycs::Collider::new(Shape::rectangle(width, thin)).at([0.0, y]);
    let post = |x: f32| rustycs::Collider::new(Shape::rectangle(thin, height)).at([x, 0.5 * height]);
    let edge = 0.5 * (width - thin);
    let car = Body::dynamic(Shape::rectangle(width, thin)).at(at).with(plate(height));
    let car = car.with(post(-edge)).with(post(edge)).mass(EMPTY).material(Material::METAL);
    let car = put(world, car.restitution(0.0).friction(0.6));
    let guide = Joint::prismatic(floor, car).at(at).axis([0.0, 1.0]).limits(0.0..=f64::from(TRAVEL));
    join(world, guide.motor(SPEED, FORCE).user_data(LIFTS));
    for (x, y, side) in [(-0.9, 0.0, 1.1), (0.5, 0.0, 0.9), (-0.8, 1.1, 0.7)] {
        let place = at + Vec2::new(x, 0.5 * thin + y + 0.5 * side);
        let crate_ = Body::dynamic(Shape::rectangle(side, side)).at(place).density(150.0);
        put(world, crate_.restitution(0.0).friction(0.6));
    }
    car
}

/// Hangs two bodies by points above their middles, m, on a rope that goes up, along below the beam, and down.
fn hang(world: &mut World, bodies: [BodyId; 2], above: [f32; 2], ratio: f64) {
    let middles = bodies.map(|id| world.body(id).expect("it was put").position());
    let [a, b] = [0, 1].map(|side| middles[side] + Vec2::new(0.0, above[side]));
    // The rope goes round the outer side of each wheel.
    let wheels = [Vec2::new(a.x, BEAM), Vec2::new(b.x, BEAM)];
    for (wheel, inward) in wheels.into_iter().zip([WHEEL, -WHEEL]) {
        let place = wheel + Vec2::new(inward, -WHEEL);
        put(world, Body::fixed(Shape::circle(WHEEL)).at(place).material(Material::METAL));
    }
    join(world, Joint::pulley(bodies[0], bodies[1], wheels[0], wheels[1]).between(a, b).ratio(ratio));
}

fn guide(world: &World) -> Option<JointId> {
    world.joints().find(|(_, joint)| joint.user_data() != 0).map(|(id, _)| id)
}

/// Up, and down again.
fn run(world: &mut World) {
    let Some(mut guide) = guide(world).and_then(|id| world.joint_mut(id)) else { return };
    let at = guide.view().translation();
    let direction = match guide.view().user_data() {
        LIFTS if at > f64::from(TRAVEL) - 0.02 => LOWERS,
        LOWERS if at < 0.02 => LIFTS,
        same => same,
    };
    guide.set_user_data(direction);
    drive(&mut guide, if direction == LIFTS { 1.0 } else { -1.0 });
}

fn played(world: &mut World, [lowers, lifts]: [bool; 2]) {
    if let Some(mut guide) = guide(world).and_then(|id| world.joint_mut(id)) {
        drive(&mut guide, f32::from(u8::from(lifts)) - f32::from(u8::from(lowers)));
    }
}

/// Up for 1, down for -1, slowly near the ends: a car that stopped at once would leave its weight on a slack rope.
fn drive(guide: &mut JointMut<'_>, direction: f32) {
    let at = guide.view().translation() as f32;
    let left = if direction > 0.0 { TRAVEL - at } else { at };
    guide.set_motor(direction * SPEED.min(CREEP + BRAKES * left.max(0.0)), FORCE);
}

fn readout(world: &World) -> String {
    let motor = guide(world).and_then(|id| world.joint(id)).map_or(0.0, |guide| guide.force().y);
    let rope = world.joints().map(|(_, joint)| joint).find(|joint| joint.wheels().is_some());
    let rope = rope.map_or(0.0, |rope| rope.force().length());
    format!(
        "the motor lifts with {:.1} kN, the rope with {:.1} kN, largest gap {:.4} mm",
        1e-3 * motor,
        1e-3 * rope,
        1e3 * largest_gap(world)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing;

    fn pulley(world: &World, number: usize) -> [f32; 2] {
        let joint =
            world.joints().map(|(_, joint)| joint).filter(|joint| joint.wheels().is_some()).nth(number);
        let joint = joint.expect("there are two");
        [joint.body_a(), joint.body_b().expect("it has two bodies")]
            .map(|id| world.body(id).expect("it is there").position().y)
    }

    /// The car goes up and down with its crates, and the weight down and up by as much, but for what it swings. The stone is lifted by a
    /// third of what draws it up comes down.
    #[test]
    fn the_car_and_the_stone_are_lifted() {
        let mut world = SCENE.build(1, Settings::default());
        let ([car, weight], [draws, stone]) = (pulley(&world, 0), pulley(&world, 1));
        let (mut lifted, mut stone_lifted) = (0.0_f32, 0.0_f32);
        for _ in 0..900 {
            testing::run(&SCENE, &mut world, 1);
            let ([car_now, weight_now], [draws_now, stone_now]) = (pulley(&world, 0), pulley(&world, 1));
            lifted = lifted.max(car_now - car);
            stone_lifted = stone_lifted.max(stone_now - stone);
            assert!((car_now - car + weight_now - weight).abs() < 1e-4, "{} s", world.time());
            // The rope of the stone is slack for a moment, as what draws it lands.
            let slack = draws_now - draws + 3.0 * (stone_now - stone);
            assert!(slack > -1e-4, "{slack} m at {} s", world.time());
            assert!(largest_gap(&world) < 1e-5, "{} m", largest_gap(&world));
        }
        assert!(lifted > TRAVEL - 0.05, "{lifted} m");
        assert!(stone_lifted > 2.0, "{stone_lifted} m");
    }
}
