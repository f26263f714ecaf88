//! For a very long time.

use std::f64::consts::TAU;

use rustycs::prelude::{Attractor, Body, BodyId, Settings, Shape, World};

use crate::Rustycs;
use crate::chance::Chance;
use crate::scene::{BodySpec, Scene, block, floor};
use crate::stability::case::{COUNT, Case, Check, Group, SHARE};
use crate::stability::figures::any;
use crate::stability::on_earth;
use crate::stability::rest::{SPEED_AT_REST, Scale};
use crate::stability::run::{Lab, Run, worse};

pub(super) fn cases() -> Vec<Case> {
    vec![
        pile(60).long(),
        pile(5),
        piles(30, 2).long(),
        piles(10, 1),
        asleep(),
        planets(10_000).long(),
        planets(100),
    ]
}

/// What a pile has to settle, s.
const SETTLED: f64 = 60.0;

/// A pile rests when nothing in it has been faster than this for half a second, m/s, ...
const REST_SPEED: f64 = 1e-4;
/// ... and moves again when something is faster than this.
const MOVING_SPEED: f64 = 5e-3;

/// A hundred bodies above a pool. They lose spin to the air, 1/s: a rigid disc rolls without loss, so that one with nothing
/// beside it would roll on, and what lies on one rock, for ever.
fn pool(seed: u64) -> Scene {
    let wall = |side: f64| BodySpec { position: [side * 4.5, 8.0], ..block(1.0, 16.0) };
    let mut chance = Chance(seed);
    let body = |index: u32| {
        let (column, row) = (f64::from(index % 7), f64::from(index / 7));
        let position = [1.1 * (column - 3.0), 0.6 + 1.1 * row];
        BodySpec { position, angular_damping: 1.0, ..any(&mut chance, 0.5) }
    };
    on_earth([floor(), wall(-1.0), wall(1.0)].into_iter().chain((0..100).map(body)))
}

fn pile(minutes: u32) -> Case {
    let statement = format!(
        "A hundred discs, boxes and polygons lie in a pool, nothing sleeps, and what spins is slowed by the air at 1/s. Statics: \
         what is at rest stays. From the first minute to the end of the {minutes}th none moves by more than a thousandth of \
         its size, 1 mm, and in the last second none is faster than 1 mm/s."
    );
    let end = 60.0 * f64::from(minutes);
    let name = format!("pile-{minutes}-minutes");
    let case = Case::new(name, Group::Long, statement, pool(6), move |lab, scene| {
        let mut run = lab.run(scene);
        run.until(SETTLED);
        let before = run.states();
        run.until(end - 1.0);
        let fastest = run.largest(end, Run::fastest);
        lab.picture(&run);
        let creep = run.most(|body, now| {
            let [x, y] = before[body].position;
            (now.position[0] - x).hypot(now.position[1] - y)
        });
        vec![
            Check::at_most("creep", creep, 1e-3, "m"),
            Check::at_most(SPEED_AT_REST, fastest, Scale::of_height(1.0).speed(), "m/s"),
        ]
    });
    case.lasting(end).seen()
}

/// So many piles, each for so many minutes from the moment in which the bodies are let go.
fn piles(count: u64, minutes: u32) -> Case {
    let statement = format!(
        "{count} such piles, for {minutes} min each from when they are let go. What falls with losses comes to rest, and \
         what is at rest stays: each pile comes to rest, which is half a second in which nothing is faster than 0.1 mm/s, and \
         in none that has is anything faster than 5 mm/s again."
    );
    let end = 60.0 * f64::from(minutes);
    let name = format!("{count}-piles");
    let case = Case::new(name, Group::Long, statement, pool(0), move |lab, _| {
        let (mut restless, mut moved_again) = (0, 0);
        for seed in 0..count {
            match run_to_rest(&mut lab.run(&pool(seed)), end) {
                None => restless += 1,
                Some(fastest) => moved_again += u32::from(!(fastest <= MOVING_SPEED)),
            }
        }
        vec![
            Check::at_most("piles that do not come to rest", f64::from(restless), 0.0, COUNT),
            Check::at_most("piles at rest that move again", f64::from(moved_again), 0.0, COUNT),
        ]
    });
    case.lasting(end)
}

/// The largest speed from when the pile has come to rest to the end, m/s; none if it does not.
fn run_to_rest(run: &mut Run, end: f64) -> Option<f64> {
    let mut rested_since = run.time();
    while run.time() - rested_since < 0.5 {
        run.tick();
        // No number is no rest.
        if !(run.fastest() <= REST_SPEED) {
            rested_since = run.time();
        }
        if run.time() >= end {
            return None;
        }
    }
    Some(run.largest(end, Run::fastest))
}

fn asleep() -> Case {
    let statement = "The same pile with sleep on, as it is by default: after a minute all sleep, and in an hour none wakes or \
                     moves by a bit.";
    let why = "when bodies sleep is a matter of taste";
    Case::ours("pile-asleep-for-an-hour", Group::Long, statement, why, |lab| {
        let mut world = Rustycs::world(&pool(6), &Settings::default());
        let step = |lab: &mut Lab<'_>, world: &mut World| lab.step(|| world.step());
        for _ in 0..60 * 60 {
            step(lab, &mut world);
        }
        let at_first = world.awake_count();
        let places = |world: &World| -> Vec<[f64; 2]> {
            world.bodies().map(|(_, body)| body.position_f64()).collect()
        };
        let before = places(&world);
        let mut awake = 0;
        for _ in 0..60 * 60 * 59 {
            step(lab, &mut world);
            awake = awake.max(world.awake_count());
        }
        let moved = before.iter().zip(&places(&world)).filter(|(before, after)| before != after).count();
        vec![
            Check::at_most("awake after a minute", at_first as f64, 0.0, COUNT),
            Check::at_most("awake at any time later", awake as f64, 0.0, COUNT),
            Check::at_most("bodies that moved", moved as f64, 0.0, COUNT),
        ]
    })
    .lasting(3600.0)
}

/// Names of the planets, mean distances from the sun in astronomical units, and eccentricities (NASA planetary fact
/// sheet).
const PLANETS: [(&str, f64, f64); 8] = [
    ("Mercury", 0.387, 0.206),
    ("Venus", 0.723, 0.007),
    ("Earth", 1.0, 0.017),
    ("Mars", 1.524, 0.094),
    ("Jupiter", 5.204, 0.049),
    ("Saturn", 9.583, 0.052),
    ("Uranus", 19.19, 0.047),
    ("Neptune", 30.07, 0.010),
];
/// An astronomical unit, m, and the year of the Earth, s, in the case.
const UNIT: f64 = 10.0;
const YEAR: f64 = 10.0;
/// Strength of the sun: GM = (2π/T)² a³, m³/s².
const SUN: f64 = (TAU / YEAR) * (TAU / YEAR) * UNIT * UNIT * UNIT;

/// The planets of the solar system about a sun that stays where it is.
fn planets(orbits: u32) -> Case {
    let statement = format!(
        "The eight planets about the sun, with the orbits they have but for the pull of each other (1 AU is 10 m, a year 10 \
         s), for {orbits} orbits of Mercury. Kepler: after each tenth of that time the semi-major axis and \
         the eccentricity of each orbit are those of the start, within 1 % of the axis and 0.01."
    );
    let why = "their pulls are written by their users";
    let name = format!("solar-system-{orbits}");
    let period = YEAR * PLANETS[0].1.powf(1.5);
    let seconds = f64::from(orbits) * period;
    Case::ours(name, Group::Long, statement, why, move |lab| {
        let mut world = World::new(Settings { sleep: false, ..Settings::default() });
        world.add_attractor(Attractor::global([0.0, 0.0], SUN as f32));
        let ids: Vec<BodyId> = PLANETS.iter().map(|&(_, a, e)| add_planet(&mut world, UNIT * a, e)).collect();
        let (mut axis, mut eccentricity) = (0.0, 0.0);
        for _ in 0..10 {
            for _ in 0..(0.1 * 60.0 * seconds) as u64 {
                lab.step(|| world.step());
            }
            for (&id, &(_, a, e)) in ids.iter().zip(&PLANETS) {
                let [found_a, found_e] = elements(&world, id);
                axis = worse(axis, (found_a / (UNIT * a) - 1.0).abs());
                eccentricity = worse(eccentricity, (found_e - e).abs());
            }
        }
        vec![
            Check::at_most("change of an axis", axis, 0.01, SHARE),
            Check::at_most("change of an eccentricity", eccentricity, 0.01, SHARE),
        ]
    })
    .lasting(seconds)
}

/// Adds a planet at its perihelion.
fn add_planet(world: &mut World, axis: f64, eccentricity: f64) -> BodyId {
    let distance = axis * (1.0 - eccentricity);
    let speed = (SUN / axis * (1.0 + eccentricity) / (1.0 - eccentricity)).sqrt();
    let body = Body::dynamic(Shape::circle(0.05)).at([distance, 0.0]).velocity([0.0, speed as f32]);
    world.add(body).expect("the description is good")
}

/// Semi-major axis, m, and eccentricity of a body's orbit, from where it is and how it moves.
fn elements(world: &World, id: BodyId) -> [f64; 2] {
    let body = world.body(id).expect("nobody removes a planet");
    let ([x, y], velocity) = (body.position_f64(), body.velocity());
    let (u, v) = (f64::from(velocity.x), f64::from(velocity.y));
    let energy = 0.5 * (u * u + v * v) - SUN / x.hypot(y);
    let spin = x * v - y * u;
    [-0.5 * SUN / energy, (1.0 + 2.0 * energy * spin * spin / (SUN * SUN)).max(0.0).sqrt()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_are_those_a_planet_was_given() {
        let mut world = World::new(Settings::default());
        for (_, a, e) in PLANETS {
            let id = add_planet(&mut world, UNIT * a, e);
            let [found_a, found_e] = elements(&world, id);
            // Velocities are f32; the eccentricity is a root of a difference.
            assert!(
                (found_a / (UNIT * a) - 1.0).abs() < 1e-6 && (found_e - e).abs() < 1e-4,
                "{found_a} {found_e}"
            );
        }
    }
}
