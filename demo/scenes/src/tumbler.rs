//! A square drum that turns, half full of boxes.

use rustycs::{Body, Material, Settings, Shape, Vec2, World};

use crate::mark::Mark;
use crate::parts::{grid, put, world_with_gravity};
use crate::rotor::{self, Seat};
use crate::{Scene, View};

/// A square drum that turns, half full of boxes.
pub const SCENE: Scene = Scene {
    name: "tumbler",
    group: "machines",
    summary: "A square drum turns 25° a second: the heap climbs with the wall, slides back and never rests.",
    view: View::above(-11.0, 0.0, 24.0, 22.0),
    build: |_, settings| build_with(32, 14.0, settings),
    before_tick: Some(|world| turn(world, 14.0)),
    ..Scene::PLAIN
};

/// Rate at which the drum turns, rad/s: 25° per second.
const SPIN: f32 = 25.0 * core::f32::consts::PI / 180.0;
/// Thickness of the walls, m.
const WALL: f32 = 1.0;
/// Side of a box, m.
const SIDE: f32 = 0.25;

/// A drum with an inner `side` (m) and `columns` by `columns` boxes in it; 45 and 20 m is the benchmark of
/// Box2D. [`turn`] is to be called before each tick.
///
/// # Panics
/// If [`Settings::validate`] refuses `settings`.
pub fn build_with(columns: usize, side: f32, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let material = Material { density: 1.0, friction: 0.6, restitution: 0.0 };
    for (part, seat) in walls(side).into_iter().enumerate() {
        let wall = Body::kinematic(Shape::obb(WALL, side + 2.0 * WALL)).at(seat.offset).angle(seat.angle);
        put(&mut world, Mark::part(part).on(wall.angular_velocity(SPIN).material(material)));
    }
    let pitch = SIDE * 1.02;
    let lowest = Vec2::new(0.0, -0.5 * (columns - 1) as f32 * pitch);
    for index in 0..columns * columns {
        let place = grid(index, columns, pitch, lowest);
        put(&mut world, Body::dynamic(Shape::obb(SIDE, SIDE)).at(place).material(material));
    }
    world
}

/// Turns the walls of a drum with an inner `side` (m) on, as one.
pub fn turn(world: &mut World, side: f32) {
    rotor::turn(world, Vec2::ZERO, SPIN, &walls(side));
}

/// The walls: right, upper, left, lower.
fn walls(side: f32) -> [Seat; 4] {
    let out = 0.5 * (side + WALL);
    [[out, 0.0], [0.0, out], [-out, 0.0], [0.0, -out]].map(Vec2::from).map(|offset| Seat {
        offset,
        angle: if offset.y == 0.0 { 0.0 } else { core::f32::consts::FRAC_PI_2 },
    })
}

#[cfg(test)]
mod tests {
    use rustycs::Rot;

    use super::*;
    use crate::testing::run;

    /// A place is set anew each tick, so only the rounding of one tick is seen: 10 m in f32, 1e-6 m.
    #[test]
    fn the_walls_stay_together_and_no_box_leaves() {
        let mut world = SCENE.build(1, Settings::default());
        run(&SCENE, &mut world, 300);
        let (_, first) = world.bodies().next().expect("the first wall");
        let angle = first.angle();
        assert!((angle - 5.0 * SPIN).abs() < 1e-4, "the drum is at {angle}");
        for (id, part) in rotor::parts(&world, 4) {
            let wall = world.body(id).expect("the wall is there");
            let seat = walls(14.0)[part];
            let off = (wall.position() - first.rotation().rotate(seat.offset)).length();
            assert!(off < 1e-5, "wall {part} is {off} m off");
            let turned = wall.rotation() * (first.rotation() * Rot::from_angle(seat.angle)).inverse();
            assert!(turned.angle().abs() < 1e-5, "wall {part} is turned by {}", turned.angle());
        }
        let farthest = world.bodies().map(|(_, body)| body.position().length()).fold(0.0, f32::max);
        assert!(farthest < 7.0 * core::f32::consts::SQRT_2, "a box is {farthest} m from the axis");
    }
}
