//! The break of a game of billiards, seen from above.

use rustycs::{Body, Material, Settings, Shape, World};

use crate::mark::{Label, Mark};
use crate::parts::{put, put_room};
use crate::{Scene, View};

/// The break of a game of billiards, seen from above.
pub const SCENE: Scene = Scene {
    name: "billiards",
    group: "collisions",
    summary: "The cue ball breaks a rack of fifteen: the outer balls fly off at once, the cloth slows all alike.",
    view: View::above(-8.0, 0.0, 28.0, 16.0),
    build,
    labels: &LABELS,
    hint: Some("Throw the cue ball. R sets the table again."),
    ..Scene::PLAIN
};

/// Width and height of the table, m: lengths are ten times those of a real one.
const TABLE: [f32; 2] = [25.4, 12.7];
/// Radius of a ball, m.
const RADIUS: f32 = 0.285;
/// Speed of the cue ball, m/s.
const SPEED: f32 = 60.0;
/// Share of its speed that a ball loses to the cloth, 1/s.
const CLOTH: f32 = 0.25;

/// Colours of the balls 1 to 8: yellow, blue, red, purple, orange, green, brown and black. Those from 9 on have them
/// again.
const COLOURS: [[u8; 3]; 8] = [
    [240, 200, 60],
    [70, 110, 220],
    [220, 70, 60],
    [140, 90, 190],
    [240, 140, 50],
    [60, 160, 90],
    [160, 80, 60],
    [70, 74, 84],
];

/// The cue ball and the fifteen, in the colours of the game.
const LABELS: [Label; 16] = {
    let names = ["cue", "1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "11", "12", "13", "14", "15"];
    let mut labels = [Label::painted(names[0], [244, 244, 238]); 16];
    let mut ball = 1;
    while ball < labels.len() {
        labels[ball] = Label::painted(names[ball], COLOURS[(ball - 1) % COLOURS.len()]);
        ball += 1;
    }
    labels
};

/// The balls of the rack touch but for 1/1000 of a radius; the cue ball comes a little off the middle.
fn build(_seed: u64, settings: Settings) -> World {
    let mut world = World::new(settings);
    put_room(
        &mut world,
        TABLE[0],
        TABLE[1],
        Material { restitution: 0.8, friction: 0.1, ..Material::RUBBER },
    );
    let ball = |place: usize| {
        let material = Material { density: 1.0, friction: 0.05, restitution: 0.95 };
        let ball = Body::dynamic(Shape::circle(RADIUS)).material(material).linear_damping(CLOTH);
        Mark::label(place).on(ball.angular_damping(CLOTH))
    };
    let foot = 0.25 * TABLE[0];
    put(&mut world, ball(0).at([-foot, 0.03]).velocity([SPEED, 0.0]));
    let pitch = RADIUS * 2.001;
    let mut place = 1;
    for row in 0..5_u8 {
        for column in 0..=row {
            // Rows of a triangle of equal sides are √3/2 of the pitch apart.
            let x = foot + f32::from(row) * pitch * 0.866_025_4;
            let y = (f32::from(column) - 0.5 * f32::from(row)) * pitch;
            put(&mut world, ball(place).at([x, y]));
            place += 1;
        }
    }
    world
}

#[cfg(test)]
mod tests {
    use rustycs::BodyType;

    use super::*;

    /// The cloth takes the same share from every ball, so p(t) = p(0) e^(-ct) until a ball meets a cushion.
    #[test]
    fn the_break_keeps_the_momentum_but_for_the_cloth() {
        let mut world = SCENE.build(1, Settings::default());
        let (before, energy) = (world.momentum(), world.kinetic_energy());
        let mut hits = 0;
        loop {
            let (momentum, kinetic_energy) = (world.momentum(), world.kinetic_energy());
            let kept = (-world.time() * f64::from(CLOTH)).exp() as f32;
            world.step();
            hits += world.events().hits().len();
            let is_cushion = |id| world.body(id).is_some_and(|body| body.body_type() == BodyType::Fixed);
            if world.events().began().iter().any(|event| is_cushion(event.a) || is_cushion(event.b)) {
                let error = (momentum - before * kept).length() / before.length();
                assert!(error < 1e-4, "momentum {momentum:?} after {before:?}, of which {kept} is kept");
                assert!(kinetic_energy < energy * f64::from(kept * kept), "the break gains energy");
                break;
            }
            assert!(world.ticks() < 120, "no ball has come to a cushion");
        }
        assert!(hits > 8, "only {hits} balls were hit");
    }
}
