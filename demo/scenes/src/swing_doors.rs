//! Doors that swing, seen from above.

use rustycs::{Body, Joint, Material, Settings, Shape, Vec2, World};

use crate::joined::join;
use crate::parts::{put, put_room};
use crate::{Scene, View};

/// Doors that swing, seen from above.
pub const SCENE: Scene = Scene {
    name: "swing_doors",
    group: "joints",
    summary: "Balls push doors open, springs pull them shut, and stops keep them from turning through the wall.",
    view: View::above(-5.6, 0.0, 20.0, 11.2),
    build,
    hint: Some("Throw a ball at a door."),
    ..Scene::PLAIN
};

/// Width of a door, and half of that of an opening, m.
const DOOR: f32 = 1.4;
const HALF: f32 = DOOR + 0.05;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = World::new(settings);
    let wall = Material { friction: 0.2, restitution: 0.9, ..Material::STONE };
    put_room(&mut world, 18.0, 10.0, wall);
    for x in [-4.0, 0.0, 4.0] {
        // The wall with an opening in its middle.
        for side in [-1.0, 1.0] {
            let length = 5.0 - HALF;
            let piece = Body::fixed(Shape::aabb(0.3, length)).at([x, side * (HALF + 0.5 * length)]);
            let piece = put(&mut world, piece.material(wall));
            let door = Body::dynamic(Shape::obb(0.16, DOOR)).at([x, side * (HALF - 0.5 * DOOR)]);
            let door = put(&mut world, door.material(Material::PLASTIC).restitution(0.3));
            let hinge = Joint::revolute(piece, door).at([x, side * HALF]).limits(-1.7..=1.7);
            join(&mut world, hinge.spring(0.7, 0.25));
        }
    }
    for (number, (x, y)) in
        [(-7.0, 0.3), (-6.0, -2.0), (6.5, 0.6), (2.0, -0.4), (-2.0, 2.0)].into_iter().enumerate()
    {
        let velocity = Vec2::new(if x < 0.0 { 5.0 } else { -5.0 }, 0.7 * number as f32);
        let ball = Body::dynamic(Shape::circle(0.4)).at([x, y]).velocity(velocity).material(Material::RUBBER);
        put(&mut world, ball.friction(0.2).restitution(0.9));
    }
    world
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;

    /// Doors open, stay within their stops to a degree and a half, and stay on their hinges.
    #[test]
    fn doors_open_and_stay_on_their_hinges() {
        let mut world = SCENE.build(1, Settings::default());
        let (mut widest, mut beyond) = (0.0_f64, 0.0_f32);
        for _ in 0..600 {
            run(&SCENE, &mut world, 1);
            for (_, hinge) in world.joints() {
                widest = widest.max(hinge.angle().abs());
                beyond = beyond.max(hinge.error().angle);
            }
        }
        assert!(widest > 1.0, "no door opened farther than {widest} rad");
        assert!(beyond < 0.025, "a door went {beyond} rad beyond its stop");
    }
}
