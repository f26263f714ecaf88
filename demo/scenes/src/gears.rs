//! Wheels with teeth that turn each other.

use rustycs::math::Rot;
use rustycs::{Body, Joint, Material, Settings, Shape, Vec2, World};

use crate::joined::join;
use crate::mark::{Label, Mark};
use crate::parts::world_with_gravity;
use crate::{Scene, View};

/// Wheels with teeth that turn each other.
pub const SCENE: Scene = Scene {
    name: "gears",
    group: "machines",
    summary: "A motor turns the small wheel, and its teeth turn the others: 16, 24 and 32 of them, so that speeds are as 6 : 4 : 3.",
    view: View::above(-4.5, 1.2, 16.0, 9.0),
    build,
    readout: Some(readout),
    is_about_names: true,
    labels: &LABELS,
    ..Scene::PLAIN
};

/// The numbers of teeth, and the directions from each wheel to the next, rad.
const TEETH: [u8; 3] = [16, 24, 32];
const DIRECTIONS: [f32; 2] = [0.5, -0.6];
const LABELS: [Label; 3] = [
    Label::painted("16 teeth", [230, 150, 60]),
    Label::painted("24 teeth", [120, 180, 120]),
    Label::painted("32 teeth", [110, 150, 210]),
];

/// Diameter by tooth, m.
const MODULE: f32 = 0.2;
/// How far teeth stand out from the pitch circle, and gaps go in, in modules.
const OUT: f32 = 0.8;
const IN: f32 = 1.1;
/// The angle at which flanks meet, rad: 20°.
const PRESSURE: f32 = 0.349;
/// Room between flanks, in modules.
const PLAY: f32 = 0.04;
/// Points along a flank.
const POINTS: u8 = 5;
/// Where the first wheel is, m, and how fast the motor turns it, rad/s.
const FIRST: Vec2 = Vec2::new(-4.5, 0.0);
const SPEED: f32 = 1.5;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let (mut place, mut turn) = (FIRST, 0.0);
    for (wheel, teeth) in TEETH.into_iter().enumerate() {
        if wheel > 0 {
            let (before, direction) = (TEETH[wheel - 1], DIRECTIONS[wheel - 1]);
            place +=
                Rot::from_angle(direction).rotate(Vec2::new(pitch_radius(before) + pitch_radius(teeth), 0.0));
            // Where the wheel before has a tooth, this one has a gap.
            let share = (direction - turn) / pitch_angle(before);
            turn = direction + core::f32::consts::PI - (0.5 - share) * pitch_angle(teeth);
        }
        let Ok(pieces) = Shape::concave(outline(teeth)) else { continue };
        let body = Body::dynamic_pieces(pieces).at(place).angle(turn).material(Material::METAL);
        let body = Mark::label(wheel).on(body.friction(0.1).restitution(0.0));
        let Ok(body) = world.add(body) else { continue };
        let axle = Joint::revolute(body, None).at(place);
        // The angle of a joint is that of the world as the wheel sees it.
        let axle = if wheel == 0 { axle.motor(-SPEED, 1e4) } else { axle.motor(0.0, 20.0) };
        join(&mut world, axle);
    }
    world
}

fn pitch_radius(teeth: u8) -> f32 {
    0.5 * MODULE * f32::from(teeth)
}

fn pitch_angle(teeth: u8) -> f32 {
    core::f32::consts::TAU / f32::from(teeth)
}

/// The outline of a wheel, about its axle: involute flanks, and along the radius within the base circle.
fn outline(teeth: u8) -> Vec<Vec2> {
    let pitch = pitch_radius(teeth);
    let base = pitch * Rot::from_angle(PRESSURE).c;
    // tan α - α at the place of a flank whose distance from the axle is r = base / cos α.
    let involute = |r: f32| {
        let tangent = ((r * r - base * base).max(0.0)).sqrt() / base;
        tangent - Rot { c: base / r.max(base), s: tangent * base / r.max(base) }.angle()
    };
    let half =
        |r: f32| 0.25 * pitch_angle(teeth) - 0.5 * PLAY * MODULE / pitch + involute(pitch) - involute(r);
    let (low, high) = (pitch - IN * MODULE, pitch + OUT * MODULE);
    let flank: Vec<f32> = (0..POINTS)
        .map(|point| {
            let share = f32::from(point) / f32::from(POINTS - 1);
            let from = low.max(base);
            from + share * (high - from)
        })
        .collect();
    let radii: Vec<f32> = (low < base).then_some(low).into_iter().chain(flank).collect();
    let at = |r: f32, angle: f32| Rot::from_angle(angle).rotate(Vec2::new(r, 0.0));
    (0..teeth)
        .flat_map(|tooth| {
            let middle = f32::from(tooth) * pitch_angle(teeth);
            let up = radii.iter().map(move |&r| (r, middle - half(r)));
            let down = radii.iter().rev().map(move |&r| (r, middle + half(r)));
            up.chain(down).map(move |(r, angle)| at(r, angle)).collect::<Vec<_>>()
        })
        .collect()
}

/// How fast the wheels turn.
fn readout(world: &World) -> String {
    let speeds = speeds(world).map(|speed| format!("{speed:+.3}"));
    format!("{} rad/s", speeds.join(", "))
}

/// How fast each wheel turns, rad/s; 0 for one that is gone.
fn speeds(world: &World) -> [f32; 3] {
    [0, 1, 2].map(|wheel| {
        let mut bodies = world.bodies();
        bodies
            .find(|&(_, body)| Mark::of(body).label == Some(wheel))
            .map_or(0.0, |(_, body)| body.angular_velocity())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;

    /// Teeth that pass each other in the same time: speeds are as one over the numbers of teeth. Flanks of straight pieces
    /// deviate by some per cent as one passes on to the next; over whole turns nothing is left of it but the play.
    #[test]
    fn speeds_are_as_one_over_the_teeth() {
        let mut world = SCENE.build(1, Settings::default());
        run(&SCENE, &mut world, 60);
        let mut turned = [0.0; 3];
        let ticks: u16 = 1_200;
        for _ in 0..ticks {
            run(&SCENE, &mut world, 1);
            for (sum, speed) in turned.iter_mut().zip(speeds(&world)) {
                *sum += speed / 60.0;
            }
        }
        let driven = SPEED * f32::from(ticks) / 60.0;
        assert!((turned[0] / driven - 1.0).abs() < 1e-3, "{turned:?}");
        for (wheel, sign) in [(1, -1.0), (2, 1.0)] {
            let expected = sign * driven * f32::from(TEETH[0]) / f32::from(TEETH[wheel]);
            assert!((turned[wheel] - expected).abs() < 2.0 * PLAY * MODULE + 0.01, "{turned:?}, {expected}");
        }
    }
}
