//! One box on ramps that are ever steeper.

use rustycs::{Body, Material, Rot, Settings, Shape, Vec2, World};

use crate::mark::{Label, Mark};
use crate::parts::{put, world_with_gravity};
use crate::{Scene, View};

/// One box on ramps that are ever steeper.
pub const SCENE: Scene = Scene {
    name: "friction_ramp",
    group: "stacks",
    summary: "Friction 0.5 holds up to tan⁻¹ 0.5 = 26.6°: boxes stick at 26° and slide from 27° on.",
    view: View::above(-1.0, 0.0, 30.0, 17.0),
    build,
    labels: &LABELS,
    is_about_names: true,
    ..Scene::PLAIN
};

const LABELS: [Label; 6] = [
    Label::text("15°"),
    Label::text("20°"),
    Label::text("26°"),
    Label::text("27°"),
    Label::text("32°"),
    Label::text("40°"),
];

/// Angles of the ramps, degrees.
const ANGLES: [f32; 6] = [15.0, 20.0, 26.0, 27.0, 32.0, 40.0];
/// Friction of boxes and ramps.
const FRICTION: f32 = 0.5;
/// Length of a ramp, m.
const LENGTH: f32 = 7.0;
/// Sides of a box, m.
const BOX: [f32; 2] = [0.9, 0.6];

/// Three ramps in each of two rows. They rise to the left and end in a stop; the boxes begin at two thirds of
/// the height.
fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let material = Material { friction: FRICTION, restitution: 0.0, ..Material::PLASTIC };
    for (place, degrees) in ANGLES.into_iter().enumerate() {
        let (column, row) = ((place % 3) as f32, (place / 3) as f32);
        let foot = Vec2::new(column * 9.6 - 6.0, 8.6 * (1.0 - row) + 0.8);
        let turn = Rot::from_angle(-degrees.to_radians());
        let at = |along: f32, above: f32| foot + turn.rotate(Vec2::new(-along, above));

        let ramp = Body::fixed(Shape::obb(LENGTH, 0.3)).at(at(0.5 * LENGTH, -0.15)).angle(turn.angle());
        put(&mut world, ramp.material(material));
        let stop = Body::fixed(Shape::obb(0.3, 1.2)).at(at(-0.15, 0.3)).angle(turn.angle());
        put(&mut world, stop.material(material));
        let [width, height] = BOX;
        let sledge = Body::dynamic(Shape::obb(width, height)).at(at(0.7 * LENGTH, 0.5 * height));
        put(&mut world, Mark::label(place).on(sledge.angle(turn.angle()).material(material)));
    }
    world
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;

    /// Below the friction angle nothing moves; above it the speed grows by g (sin - µ cos) t. It is measured
    /// from 0.2 s on, when the boxes have settled, to 1 s, before the steepest meets its stop.
    #[test]
    fn boxes_slide_on_ramps_steeper_than_the_friction_angle() {
        let mut world = SCENE.build(1, Settings::default());
        let sledges = SCENE.labels(&world);
        let motions = |world: &World| -> Vec<(Vec2, f32)> {
            let bodies = sledges.iter().map(|&(id, _)| world.body(id).expect("it was not removed"));
            bodies.map(|body| (body.position(), body.velocity().length())).collect()
        };
        run(&SCENE, &mut world, 12);
        let before = motions(&world);
        run(&SCENE, &mut world, 48);
        for ((before, now), degrees) in before.into_iter().zip(motions(&world)).zip(ANGLES) {
            let Rot { c, s } = Rot::from_angle(degrees.to_radians());
            let gained = 9.81 * (s - FRICTION * c).max(0.0) * 0.8;
            // Speeds of up to 3 m/s are rounded 200 times, and contacts are soft: 1e-3 of the gravity along.
            let error = (now.1 - before.1 - gained).abs();
            assert!(
                error < 1e-3 * 9.81 * s * 0.8,
                "{degrees}°: {before:?} to {now:?} instead of {gained} m/s"
            );
            if gained == 0.0 {
                let crept = (now.0 - before.0).length();
                assert!(crept < 1e-4, "{degrees}°: it has crept {crept} m");
            }
        }
    }
}
