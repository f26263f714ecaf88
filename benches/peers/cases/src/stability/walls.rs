//! Speeds against walls, as a map.

use crate::scene::{BodySpec, Scene, block, disc};
use crate::stability::case::{Case, Check, Group, SHARE};
use crate::stability::run::Lab;

/// m/s.
const SPEEDS: [f64; 5] = [1.0, 10.0, 100.0, 1000.0, 10_000.0];
/// m.
const THICKNESSES: [f64; 3] = [0.01, 0.1, 1.0];
/// Discs that are thrown at once, each in a lane of its own, from places that differ by parts of a tick.
const LANES: u32 = 20;
/// Radius of a disc, m.
const RADIUS: f64 = 0.1;

pub(super) fn cases() -> Vec<Case> {
    let statement = "Discs of 0.2 m fly straight at walls 1 cm, 10 cm and 1 m thick, at 1 to 10,000 m/s (up to 167 m in a \
                     tick), 20 of them at each pair, from places that differ by parts of a tick. A wall that does not move \
                     lets nothing through: none is beyond it at the end. A check that only looks where bodies are at the \
                     ends of substeps can promise that below (thickness + 0.2 m) × 240/s, 50 m/s and more; each share that \
                     passes is a figure of the map.";
    let case = Case::new(
        "speeds-against-walls",
        Group::Speeds,
        statement,
        scene(SPEEDS[2], THICKNESSES[1]),
        |lab, _| {
            let pairs =
                THICKNESSES.iter().flat_map(|&thickness| SPEEDS.iter().map(move |&speed| (thickness, speed)));
            pairs.map(|(thickness, speed)| passing(lab, speed, thickness)).collect()
        },
    );
    vec![case]
}

fn scene(speed: f64, thickness: f64) -> Scene {
    let wall = BodySpec { position: [0.5 * thickness, 0.0], ..block(thickness, 40.0) };
    let disc = |lane: u32| {
        let part = f64::from(lane) / f64::from(LANES);
        BodySpec {
            position: [-5.0 - part * speed / 60.0, 0.5 * (f64::from(lane) - 9.5)],
            velocity: [speed, 0.0],
            ..disc(RADIUS)
        }
    };
    Scene { bodies: [wall].into_iter().chain((0..LANES).map(disc)).collect(), ..Scene::default() }
}

fn passing(lab: &mut Lab<'_>, speed: f64, thickness: f64) -> Check {
    let mut run = lab.run(&scene(speed, thickness));
    run.until(10.0 / speed + 0.5);
    // NaN is not on this side.
    let stopped = run.moving().iter().filter(|&&body| run.state(body).position[0] <= 0.5 * thickness).count();
    let share = 1.0 - stopped as f64 / f64::from(LANES);
    Check::at_most(format!("passed at {speed} m/s through {thickness} m"), share, 0.0, SHARE)
}
