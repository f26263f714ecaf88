//! Worlds by chance.

use crate::chance::Chance;
use crate::scene::{BodySpec, Scene, block};
use crate::stability::case::{COUNT, Case, Check, Group};
use crate::stability::figures::any;
use crate::stability::run::{Lab, worse};

pub(super) fn cases() -> Vec<Case> {
    vec![worlds(10_000).long(), worlds(100)]
}

/// Overlap after settling, m.
const OVERLAP: f64 = 0.01;
/// How long each is run, s.
const SECONDS: f64 = 10.0;

fn worlds(count: u32) -> Case {
    let statement = format!(
        "{count} worlds of 2 to 16 bodies in a pool of 8 m: discs, boxes and polygons of 0.2 to 1 m, of densities from 0.1 to \
         10, frictions up to 1 and restitutions up to 0.5, spinning and flying at up to 5 m/s, under a gravity of 0 to 20 m/s² \
         downwards and up to 3 m/s² aside. Whatever happens, every number stays one, none leaves the pool, and after \
         {SECONDS} s what is rigid does not overlap, by more than 1 cm."
    );
    let case =
        Case::new(format!("random-worlds-{count}"), Group::Random, statement, world(0), move |lab, _| {
            let (mut lost, mut outside, mut deep, mut deepest) = (0, 0, 0, 0.0);
            for seed in 0..count {
                let [is_lost, is_outside, overlap] = play(lab, seed);
                lost += u32::from(is_lost > 0.0);
                outside += u32::from(is_outside > 0.0);
                deep += u32::from(!(overlap <= OVERLAP));
                deepest = worse(deepest, overlap);
            }
            vec![
                Check::at_most("worlds with a NaN", f64::from(lost), 0.0, COUNT),
                Check::at_most("worlds with a body outside", f64::from(outside), 0.0, COUNT),
                Check::at_most("worlds with an overlap of more than 1 cm", f64::from(deep), 0.0, COUNT),
                Check::at_most("deepest overlap of all", deepest, OVERLAP, "m"),
            ]
        });
    case.lasting(SECONDS)
}

/// How many bodies are lost, and outside; and the deepest overlap, m.
fn play(lab: &mut Lab<'_>, seed: u32) -> [f64; 3] {
    let mut run = lab.run(&world(seed));
    run.until(SECONDS);
    let is_inside = |body: &&usize| {
        let [x, y] = run.state(**body).position;
        x.abs() <= 4.0 && y >= 0.0
    };
    let outside = run.moving().len() - run.moving().iter().filter(is_inside).count();
    [run.lost() as f64, outside as f64, run.deepest_overlap()]
}

/// A world by chance.
fn world(seed: u32) -> Scene {
    let mut chance = Chance(u64::from(seed));
    let wall = |side: f64| BodySpec { position: [side * 5.0, 40.0], ..block(2.0, 84.0) };
    let ground = BodySpec { position: [0.0, -1.0], ..block(12.0, 2.0) };
    let mut bodies = vec![ground, wall(-1.0), wall(1.0)];
    for index in 0..2 + chance.one_of(15) {
        let radius = chance.between(0.1, 0.5);
        let place = [f64::from(index % 7) - 3.0, 0.6 + f64::from(index / 7) * 1.05].map(|x| 1.05 * x);
        bodies.push(BodySpec {
            position: place,
            velocity: [chance.between(-3.5, 3.5), chance.between(-3.5, 3.5)],
            spin: chance.between(-5.0, 5.0),
            density: 10.0_f64.powf(chance.between(-1.0, 1.0)),
            friction: chance.between(0.0, 1.0),
            restitution: chance.between(0.0, 0.5),
            ..any(&mut chance, radius)
        });
    }
    let gravity = [chance.between(-3.0, 3.0), -chance.between(0.0, 20.0)];
    Scene { bodies, gravity, ..Scene::default() }
}
