//! A ball that bounces on a floor.

use rustycs::report::Unit;

use crate::problems::{Class, G, Problem, Range, Run, disc, floor, on_earth};
use crate::scene::{BodySpec, Scene};

pub(super) fn problems() -> Vec<Problem> {
    vec![elastic(), half_elastic()]
}

const RADIUS: f64 = 0.25;

/// A ball with its lowest point this high above a floor, and the floor.
fn drop(height: f64, restitution: f64) -> Scene {
    let ball = BodySpec { position: [0.0, RADIUS + height], restitution, ..disc(RADIUS) };
    on_earth([BodySpec { restitution, ..floor() }, ball])
}

/// The height to which the ball would rise from here, m: its energy over its weight.
fn height(run: &Run) -> f64 {
    let state = run.state(0);
    state.position[1] - RADIUS + state.velocity[1] * state.velocity[1] / (2.0 * G)
}

fn elastic() -> Problem {
    const DROP: f64 = 1.0;
    Problem {
        name: "bounce-1".into(),
        statement: "A ball of restitution 1 falls from 1 m for 91 s, about 100 bounces: its energy stays. In each second \
                    the largest counts, as a contact may keep some for a moment."
            .into(),
        measure: "largest change of the energy / energy",
        unit: Unit::Part,
        class: Class::Impact,
        scene: drop(DROP, 1.0),
        // A bounce takes 2 √(2 · 1 m / g) = 0.903 s.
        duration: 91.0,
        error: Box::new(|run| {
            let mut worst = 0.0_f64;
            while !run.is_over() {
                let second = run.time() + 1.0;
                let mut highest = f64::NEG_INFINITY;
                while run.time() < second {
                    run.tick();
                    highest = highest.max(height(run));
                }
                worst = worst.max((highest / DROP - 1.0).abs());
            }
            worst
        }),
        range: Range::Full,
        goal: Some(1e-4),
        note: "",
    }
}

fn half_elastic() -> Problem {
    const DROP: f64 = 8.0;
    const RESTITUTION: f64 = 0.5;
    Problem {
        name: "bounce-0.5".into(),
        statement: "A ball of restitution e = 0.5 falls from 8 m: it rises to 8 m · e², e⁴, e⁶, e⁸ after its first four \
                    bounces, with impacts at 12.5 to 1.6 m/s."
            .into(),
        measure: "largest error of a height / that height",
        unit: Unit::Part,
        class: Class::Impact,
        scene: drop(DROP, RESTITUTION),
        duration: 4.0,
        error: Box::new(|run| {
            let mut before = run.state(0).velocity[1];
            let (mut bounces, mut worst) = (0, 0.0_f64);
            while !run.is_over() && bounces < 4 {
                let rising = height(run);
                run.tick();
                let now = run.state(0).velocity[1];
                if before > 0.0 && now <= 0.0 {
                    bounces += 1;
                    // From the tick before the apex: at the one after it, a low bounce may be over.
                    let exact = DROP * RESTITUTION.powi(2 * bounces);
                    worst = worst.max((rising / exact - 1.0).abs());
                }
                before = now;
            }
            if bounces < 4 { 1.0 } else { worst }
        }),
        range: Range::Full,
        goal: None,
        note: "",
    }
}
