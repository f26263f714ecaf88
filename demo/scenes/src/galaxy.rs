//! A disc of small bodies around a heavy centre.

use rustycs::{Body, Material, Rot, Settings, Shape, Vec2, World};

use crate::mark::{Label, Mark};
use crate::parts::{put, put_attractor};
use crate::random::Random;
use crate::{Scene, View};

/// A disc of small bodies around a heavy centre.
pub const SCENE: Scene = Scene {
    name: "galaxy",
    group: "attraction",
    summary: "2,000 bodies circle a centre: the inner ones lap the outer, so the three sectors wind up.",
    view: View::above(-26.0, 0.0, 56.0, 52.0),
    build: |seed, settings| build_with(COUNT, seed, settings),
    readout: Some(readout),
    labels: &LABELS,
    is_random: true,
    ..Scene::PLAIN
};

/// Bodies in the scene.
const COUNT: usize = 2000;
/// Radius of a body, m.
const RADIUS: f32 = 0.13;
/// Radius of the centre, m.
const CENTRE: f32 = 1.0;
/// G times the mass of the centre, m³/s²: a body 10 m away needs 2 π √(r³ / GM) = 10 s for a turn.
const GM: f32 = 395.0;
/// Distance from the centre to the innermost body, m.
const INNERMOST: f32 = 3.0;
/// How far velocities are from those of circles, as a share of them.
const SCATTER: f32 = 0.06;
/// Colours of the thirds of the disc.
const LABELS: [Label; 3] = [
    Label { text: None, colour: Some([250, 214, 140]) },
    Label { text: None, colour: Some([120, 170, 250]) },
    Label { text: None, colour: Some([226, 120, 150]) },
];

/// `count` bodies, to see how cost grows with their number. They begin as the seeds of a sunflower (Vogel
/// 1979): each 137.5° further than the one before and at a distance that leaves the same area to each.
///
/// # Panics
/// If [`Settings::validate`] refuses `settings`.
pub fn build_with(count: usize, seed: u64, settings: Settings) -> World {
    let mut world = World::new(settings);
    put_attractor(&mut world, GM, None);
    put(&mut world, Body::fixed(Shape::circle(CENTRE)).material(Material::STONE));
    let mut random = Random::new(seed);
    let golden_angle = core::f32::consts::PI * (3.0 - 5.0_f32.sqrt());
    for index in 0..count {
        let radius = (INNERMOST * INNERMOST + 0.27 * index as f32).sqrt();
        let turns = (golden_angle * index as f32 / core::f32::consts::TAU).fract();
        let turn = Rot::from_angle(turns * core::f32::consts::TAU);
        let sector = (turns * LABELS.len() as f32) as usize;
        let circle = (GM / radius).sqrt();
        let mut near_one = || 1.0 + random.between(-SCATTER, SCATTER);
        let velocity = Vec2::new(circle * (near_one() - 1.0), circle * near_one());
        let body = Body::dynamic(Shape::circle(RADIUS)).at(turn.rotate(Vec2::new(radius, 0.0)));
        let material = Material { density: 1.0, friction: 0.2, restitution: 0.4 };
        put(&mut world, Mark::label(sector).on(body.velocity(turn.rotate(velocity)).material(material)));
    }
    world
}

fn readout(world: &World) -> String {
    format!("energy {:.2} J, angular momentum {:.3} kg m²/s", world.energy(), world.angular_momentum())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A central pull and contacts between the bodies leave the angular momentum alone; only the centre, which
    /// is fixed and rubs, can take some from what falls on it: nothing comes that near.
    #[test]
    fn angular_momentum_is_kept_and_energy_only_falls() {
        let mut world = build_with(500, 1, Settings::default());
        let (before, energy) = (world.angular_momentum(), world.energy());
        for _ in 0..300 {
            world.step();
        }
        let ratio = world.angular_momentum() / before;
        assert!((ratio - 1.0).abs() < 1e-4, "angular momentum is {ratio} of what it was");
        assert!(
            world.energy() < energy * (1.0 - 1e-4 * energy.signum()),
            "{} J after {energy} J",
            world.energy()
        );
    }
}
