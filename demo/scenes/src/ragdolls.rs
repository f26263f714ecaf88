//! Dolls of ten parts that fall down a stair.

use rustycs::{Body, BodyId, Filter, Joint, Material, Settings, Shape, Vec2, World};

use crate::joined::{join, largest_gap};
use crate::parts::{put, put_floor, world_with_gravity};
use crate::random::Random;
use crate::{Scene, View};

/// Dolls of ten parts that fall down a stair.
pub const SCENE: Scene = Scene {
    name: "ragdolls",
    group: "joints",
    summary: "Ten parts each, with stiff joints that bend as far as ours do: elbows and knees to one side only.",
    view: View::above(-0.8, 0.0, 24.0, 15.0),
    build,
    readout: Some(readout),
    hint: Some("Take one by the hand and throw it."),
    is_random: true,
    ..Scene::PLAIN
};

const DOLLS: i16 = 9;
/// Torque by which a joint resists, N m: about what holds a leg of ours up.
const STIFFNESS: f32 = 1.5;
const SKIN: Material = Material { density: 1.0, friction: 0.6, restitution: 0.1 };

/// A part of a doll that stands upright: its middle, width and height, m.
struct Part {
    middle: Vec2,
    size: [f32; 2],
    /// The part it hangs on, where, m, and how far it turns, rad.
    on: Option<(usize, Vec2, [f32; 2])>,
}

const fn part(middle: [f32; 2], size: [f32; 2], on: usize, at: [f32; 2], range: [f32; 2]) -> Part {
    let [middle, at] = [Vec2::new(middle[0], middle[1]), Vec2::new(at[0], at[1])];
    Part { middle, size, on: Some((on, at, range)) }
}

/// From the feet up, as seen from the left: the doll looks to the right.
const PARTS: [Part; 10] = [
    Part { middle: Vec2::new(0.0, 1.28), size: [0.34, 0.72], on: None },
    part([0.0, 1.82], [0.3, 0.3], 0, [0.0, 1.66], [-0.6, 0.6]),
    part([0.0, 1.36], [0.13, 0.44], 0, [0.0, 1.56], [-1.0, 2.8]),
    part([0.0, 0.98], [0.11, 0.38], 2, [0.0, 1.16], [0.0, 2.4]),
    part([0.0, 1.36], [0.13, 0.44], 0, [0.0, 1.56], [-1.0, 2.8]),
    part([0.0, 0.98], [0.11, 0.38], 4, [0.0, 1.16], [0.0, 2.4]),
    part([0.0, 0.7], [0.18, 0.5], 0, [0.0, 0.94], [-0.5, 1.9]),
    part([0.0, 0.24], [0.14, 0.48], 6, [0.0, 0.46], [-2.3, 0.0]),
    part([0.0, 0.7], [0.18, 0.5], 0, [0.0, 0.94], [-0.5, 1.9]),
    part([0.0, 0.24], [0.14, 0.48], 8, [0.0, 0.46], [-2.3, 0.0]),
];

fn build(seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let mut random = Random::new(seed);
    put_floor(&mut world, 60.0, 1.0);
    for step in 0..8_u8 {
        let (x, height) = (-1.0 - 1.3 * f32::from(step), 0.7 * f32::from(step + 1));
        let stair = Body::fixed(Shape::aabb(1.3, height)).at([x, 0.5 * height]);
        put(&mut world, stair.material(Material::STONE));
    }
    for doll in 0..DOLLS {
        let column = f32::from(doll % 3);
        let at = Vec2::new(-9.2 + 2.4 * column, 6.6 + 2.4 * f32::from(doll / 3));
        put_doll(&mut world, at, Vec2::new(random.between(1.0, 3.0), 0.0), -1 - i32::from(doll));
    }
    world
}

/// A doll with its feet at a place, m, and a velocity, m/s. Its parts pass each other.
fn put_doll(world: &mut World, feet: Vec2, velocity: Vec2, group: i32) {
    let mut bodies: Vec<BodyId> = Vec::new();
    for (number, part) in PARTS.iter().enumerate() {
        let [width, height] = part.size;
        let shape = if number == 1 { Shape::circle(0.5 * width) } else { Shape::obb(width, height) };
        let body = Body::dynamic(shape).at(feet + part.middle).velocity(velocity).material(SKIN);
        let body = put(world, body.filter(Filter { group, ..Filter::DEFAULT }));
        if let Some((on, at, [least, most])) = part.on {
            let joint = Joint::revolute(bodies[on], body).at(feet + at).limits(least..=most);
            join(world, joint.motor(0.0, STIFFNESS));
        }
        bodies.push(body);
    }
}

fn readout(world: &World) -> String {
    let worst = world.joints().map(|(_, joint)| joint.error().angle).fold(0.0, f32::max);
    let gap = 1e3 * largest_gap(world);
    format!("largest gap {gap:.3} mm, beyond a limit {:.2}°", worst.to_degrees())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;

    /// After twenty seconds all lie below, in one piece each.
    #[test]
    fn dolls_come_to_lie_in_one_piece() {
        let mut world = SCENE.build(1, Settings::default());
        run(&SCENE, &mut world, 1_200);
        assert_eq!(world.joint_count(), 9 * usize::from(DOLLS.unsigned_abs()));
        assert!(largest_gap(&world) < 0.01, "{} m", largest_gap(&world));
    }
}
