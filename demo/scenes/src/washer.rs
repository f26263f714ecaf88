//! A round drum with paddles that turns.

use rustycs::{Body, Material, Rot, Settings, Shape, Vec2, World};

use crate::mark::Mark;
use crate::parts::{grid, put, regular_polygon, world_with_gravity};
use crate::rotor::{self, Seat};
use crate::{Scene, View};

/// A round drum with paddles that turns.
pub const SCENE: Scene = Scene {
    name: "washer",
    group: "machines",
    summary: "A round drum with six paddles lifts discs, boxes and hexagons, and lets them fall from the top.",
    view: View::above(-9.2, 0.0, 22.0, 18.4),
    build,
    before_tick: Some(|world| rotor::turn(world, Vec2::ZERO, SPIN, &seats())),
    ..Scene::PLAIN
};

/// Rate at which the drum turns, rad/s: the paddles just hold what they lift, w² r = 0.65 g.
const SPIN: f32 = 0.9;
/// Radius of the inside, m.
const RADIUS: f32 = 8.0;
/// Flat pieces the drum is made of.
const STAVES: usize = 36;
/// Paddles, each from one of the staves inward.
const PADDLES: usize = 6;
/// Thickness of a stave, m.
const STAVE: f32 = 0.6;
/// Length and thickness of a paddle, m.
const PADDLE: [f32; 2] = [1.8, 0.3];
/// Bodies in a row of the load, and in all.
const LOAD: usize = 26;

/// Staves first, then paddles; all of them lie with their thin side along the radius and across it.
fn seats() -> [Seat; STAVES + PADDLES] {
    core::array::from_fn(|part| {
        let (angle, radius) = if part < STAVES {
            (part as f32 / STAVES as f32, RADIUS + 0.5 * STAVE)
        } else {
            ((part - STAVES) as f32 / PADDLES as f32, RADIUS - 0.5 * PADDLE[0])
        };
        let angle = angle * core::f32::consts::TAU;
        Seat { offset: Rot::from_angle(angle).rotate(Vec2::new(radius, 0.0)), angle }
    })
}

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let drum = Material { friction: 0.6, restitution: 0.0, ..Material::METAL };
    // Outer corners of neighbours meet: 2 (r + d) tan(π / n) wide.
    let half = Rot::from_angle(core::f32::consts::PI / STAVES as f32);
    let width = 2.0 * (RADIUS + STAVE) * half.s / half.c;
    for (part, seat) in seats().into_iter().enumerate() {
        let shape = if part < STAVES { Shape::obb(STAVE, width) } else { Shape::obb(PADDLE[0], PADDLE[1]) };
        let body = Body::kinematic(shape).at(seat.offset).angle(seat.angle).angular_velocity(SPIN);
        put(&mut world, Mark::part(part).on(body.material(drum)));
    }
    let load = Material { density: 1.0, friction: 0.5, restitution: 0.1 };
    for index in 0..LOAD * LOAD {
        let shape = match index % 3 {
            0 => Shape::circle(0.14),
            1 => Shape::obb(0.26, 0.22),
            _ => regular_polygon(6, 0.15),
        };
        let place = grid(index, LOAD, 0.31, Vec2::new(0.0, -4.0));
        put(&mut world, Body::dynamic(shape).at(place).material(load));
    }
    world
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;

    #[test]
    fn the_drum_holds_its_load() {
        let mut world = SCENE.build(1, Settings::default());
        run(&SCENE, &mut world, 240);
        let farthest = world.bodies().map(|(_, body)| body.position().length()).fold(0.0, f32::max);
        assert!(farthest < RADIUS + STAVE, "something is {farthest} m from the axis");
        // The drum is turned by 0.9 · 4 rad, less a turn: each stave is at its angle still.
        let turned = Rot::from_angle(SPIN * 4.0);
        for (id, part) in rotor::parts(&world, STAVES + PADDLES) {
            let body = world.body(id).expect("the part is there");
            let off = (body.position() - turned.rotate(seats()[part].offset)).length();
            assert!(off < 1e-3, "part {part} is {off} m off");
        }
    }
}
