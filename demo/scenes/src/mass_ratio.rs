//! Heavy boxes on light ones.

use rustycs::{Body, Material, Settings, Shape, World};

use crate::mark::{Label, Mark};
use crate::parts::{put, put_floor, world_with_gravity};
use crate::{Scene, View};

/// Heavy boxes on light ones.
pub const SCENE: Scene = Scene {
    name: "mass_ratio",
    group: "stacks",
    summary: "A box on one that weighs as much, a tenth, a hundredth, a thousandth: the light one must bear it.",
    view: View::above(-1.0, 0.0, 14.0, 6.0),
    build,
    readout: Some(readout),
    labels: &LABELS,
    is_about_names: true,
    ..Scene::PLAIN
};

const LABELS: [Label; 4] =
    [Label::text("1 : 1"), Label::text("10 : 1"), Label::text("100 : 1"), Label::text("1000 : 1")];

/// Mass of the upper boxes over that of the lower.
const RATIOS: [f32; 4] = [1.0, 10.0, 100.0, 1000.0];
/// From one pair to the next, m.
const PITCH: f32 = 3.2;

/// The upper box is a little wider, so that it cannot turn about an edge.
fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    put_floor(&mut world, 16.0, 1.0);
    let material = Material { density: 1.0, friction: 0.6, restitution: 0.0 };
    for (place, ratio) in RATIOS.into_iter().enumerate() {
        let x = (place as f32 - 1.5) * PITCH;
        put(&mut world, Body::dynamic(Shape::obb(1.0, 1.0)).at([x, 0.5]).material(material).mass(1.0));
        let heavy = Body::dynamic(Shape::obb(1.6, 1.6)).at([x, 1.8]).material(material).mass(ratio);
        put(&mut world, Mark::label(place).on(heavy));
    }
    world
}

/// How far each heavy box is below where it began, 1.8 m up, as none of the light ones gives way.
fn readout(world: &World) -> String {
    let heavy = world.bodies().filter_map(|(_, body)| Some((Mark::of(body).label?, body)));
    let sunk: Vec<String> = heavy
        .map(|(place, body)| format!("{:.1} mm at {} : 1", (1.8 - body.position().y) * 1e3, RATIOS[place]))
        .collect();
    format!("the heavy box has sunk by {}", sunk.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Up to 10 : 1 a contact gives by millimetres; none of the heavy boxes topples or comes through.
    #[test]
    fn heavy_boxes_stay_on_light_ones() {
        let mut world = SCENE.build(1, Settings::default());
        for _ in 0..600 {
            world.step();
        }
        for (place, (_, body)) in
            world.bodies().filter(|&(_, body)| Mark::of(body).label.is_some()).enumerate()
        {
            let sunk = 1.8 - body.position().y;
            let allowed = if RATIOS[place] <= 10.0 { 5e-3 } else { 0.5 };
            assert!(
                sunk < allowed && body.angle().abs() < 0.05,
                "{} : 1 has sunk by {sunk} m",
                RATIOS[place]
            );
        }
    }
}
