//! Newton's cradle as one knows it: balls on strings.

use rustycs::{Body, Joint, Material, Rot, Settings, Shape, Vec2, World};

use crate::joined::join;
use crate::parts::{ELASTIC, put, world_with_gravity};
use crate::{Scene, View};

/// Newton's cradle as one knows it: balls on strings.
pub const SCENE: Scene = Scene {
    name: "strings",
    group: "joints",
    summary: "Newton's cradle: one ball falls, one rises to the same height, and the three between hang still.",
    view: View::above(-0.9, 0.0, 11.0, 6.2),
    build,
    readout: Some(readout),
    hint: Some("Lift two balls at once, and let go."),
    ..Scene::PLAIN
};

const BALLS: u8 = 5;
/// Radius of a ball, m: a sum of halves is exact, so the balls touch exactly.
const RADIUS: f32 = 0.5;
/// Where the strings are held, and how long they are, m.
const TOP: f32 = 4.5;
const STRING: f32 = 4.0;
/// How far the first is lifted, rad.
const LIFT: f32 = 0.7;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let rail = Body::fixed(Shape::aabb(6.5, 0.2)).at([0.0, TOP + 0.1]);
    put(&mut world, rail.material(Material::STONE));
    for ball in 0..BALLS {
        let top = Vec2::new((f32::from(ball) - 0.5 * f32::from(BALLS - 1)) * 2.0 * RADIUS, TOP);
        let lift = if ball == 0 { LIFT } else { 0.0 };
        let place = top + Rot::from_angle(-lift).rotate(Vec2::new(0.0, -STRING));
        let density = Material::METAL.density;
        let body = Body::dynamic(Shape::circle(RADIUS)).at(place).material(Material { density, ..ELASTIC });
        let body = put(&mut world, body);
        join(&mut world, Joint::distance(body, None).between(place, top).length(STRING));
    }
    world
}

fn readout(world: &World) -> String {
    format!("energy {:.1} J, momentum {:+.0} kg m/s", world.energy(), world.momentum().x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;

    /// A quarter of a swing of 4.28 s (4 m, from 0.7 rad) after the blow the last ball is as high as the first was,
    /// and the others have not moved.
    #[test]
    fn one_ball_falls_and_one_rises_to_the_same_height() {
        let mut world = SCENE.build(1, Settings::default());
        let places = |world: &World| -> Vec<Vec2> {
            world.bodies().skip(1).map(|(_, body)| body.position()).collect()
        };
        let start = places(&world);
        let mut highest = f32::MIN;
        for _ in 0..150 {
            run(&SCENE, &mut world, 1);
            highest = highest.max(places(&world)[usize::from(BALLS) - 1].y);
        }
        assert!((highest - start[0].y).abs() < 0.01 * (start[0].y - 0.5), "it rises to {highest} m");
        for (ball, (start, now)) in start.iter().zip(places(&world)).enumerate().take(4).skip(1) {
            assert!((now - *start).length() < 0.02, "ball {ball} went from {start:?} to {now:?}");
        }
    }
}
