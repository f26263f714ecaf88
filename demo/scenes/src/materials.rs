//! Five balls of the five named materials.

use rustycs::{Body, Material, Settings, Shape, World};

use crate::mark::{Label, Mark};
use crate::parts::{MATERIALS, put, put_floor, world_with_gravity};
use crate::{Scene, View};

/// Five balls of the five named materials.
pub const SCENE: Scene = Scene {
    name: "materials",
    group: "classic",
    summary: "Balls of the five materials fall side by side: they land together, and rubber jumps highest.",
    view: View::above(-1.0, 0.0, 13.0, 8.0),
    build,
    labels: &LABELS,
    is_about_names: true,
    ..Scene::PLAIN
};

const LABELS: [Label; 5] = [
    Label::text("default"),
    Label::text("rubber"),
    Label::text("plastic"),
    Label::text("stone"),
    Label::text("metal"),
];

/// Radius of a ball, m.
const RADIUS: f32 = 0.5;
/// How far a ball falls, m.
const DROP: f32 = 5.5;
/// From one ball to the next, m.
const PITCH: f32 = 2.2;

/// The floor has the middling restitution of the default material.
fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let floor = put_floor(&mut world, 16.0, 1.0);
    world.body_mut(floor).and_then(|mut floor| floor.set_restitution(Material::DEFAULT.restitution).ok());
    for (place, material) in MATERIALS.into_iter().enumerate() {
        let x = (place as f32 - 2.0) * PITCH;
        let ball = Body::dynamic(Shape::circle(RADIUS)).at([x, RADIUS + DROP]).material(material);
        put(&mut world, Mark::label(place).on(ball));
    }
    world
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Materials mix by their mean: e = (e_ball + 0.5) / 2, and the first bounce reaches e² of the drop.
    #[test]
    fn each_ball_bounces_to_e_squared_of_its_drop() {
        let mut world = SCENE.build(1, Settings::default());
        let balls = SCENE.labels(&world);
        let mut highest = [0.0_f32; 5];
        // √(2 · 5.5 / 9.81) = 1.06 s of fall; the liveliest is at the top 0.55 · 1.06 s later.
        for tick in 0..120 {
            world.step();
            for (place, &(id, _)) in balls.iter().enumerate() {
                let body = world.body(id).expect("no ball was removed");
                if tick > 70 {
                    highest[place] = highest[place].max(body.position().y - RADIUS);
                }
            }
        }
        for (material, highest) in MATERIALS.into_iter().zip(highest) {
            let e = 0.5 * (material.restitution + 0.5);
            let expected = e * e * DROP;
            // Heights are seen once in a tick: up to g/8 dt² = 0.3 mm are missed, and 0.5 % allowed.
            assert!((highest - expected).abs() < 0.005 * expected + 1e-3, "{highest} for {expected}");
        }
    }
}
