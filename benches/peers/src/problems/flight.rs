//! Bodies that nothing touches.

use rustycs::report::Unit;

use crate::problems::{Class, G, Problem, Range, Run, disc, distance, on_earth, rectangle};
use crate::scene::{BodySpec, Scene};

pub(super) fn problems() -> Vec<Problem> {
    vec![projectile(), spin()]
}

/// The same throw, where `f32` has few digits left for the place.
pub(super) fn far_problems() -> Vec<Problem> {
    [(4, 1e4), (5, 1e5), (6, 1e6)]
        .map(|(exponent, far)| Problem {
            name: format!("far-1e{exponent}"),
            statement: format!(
                "The throw of `projectile` at x = y = 10^{exponent} m. The `f32` numbers nearest to a place there \
                 are {} m apart.",
                spacing(far)
            ),
            class: Class::Hard,
            note: "",
            ..throw([far, far])
        })
        .into()
}

/// Distance between neighbouring `f32` numbers, m.
fn spacing(value: f64) -> f32 {
    let value = value as f32;
    value.next_up() - value
}

fn projectile() -> Problem {
    throw([0.0, 0.0])
}

/// A disc thrown from here with 3 m/s to the side and 4 m/s upward.
fn throw(from: [f64; 2]) -> Problem {
    const THROW: [f64; 2] = [3.0, 4.0];
    const DURATION: f64 = 2.0;
    let exact = move |t: f64| [from[0] + THROW[0] * t, from[1] + THROW[1] * t - 0.5 * G * t * t];
    let fall = 0.5 * G * DURATION * DURATION;
    Problem {
        name: "projectile".into(),
        statement: "A disc is thrown with (3, 4) m/s: x = v t + g t²/2, for 2 s.".into(),
        measure: "largest distance from the exact place / fall",
        unit: Unit::Part,
        class: Class::Smooth,
        scene: on_earth([BodySpec { position: from, velocity: THROW, ..disc(0.5) }]),
        duration: DURATION,
        error: Box::new(move |run: &mut Run| {
            run.largest(|run| distance(run.state(0).position, exact(run.time()))) / fall
        }),
        range: Range::Full,
        goal: None,
        note: "",
    }
}

fn spin() -> Problem {
    const SPIN: f64 = 20.0;
    const DURATION: f64 = 10.0;
    Problem {
        name: "spin".into(),
        statement: "A box in empty space spins at w = 20 rad/s for 10 s: θ = w t = 200 rad.".into(),
        measure: "largest error of the angle / angle at the end",
        unit: Unit::Part,
        class: Class::Smooth,
        scene: Scene { bodies: vec![BodySpec { spin: SPIN, ..rectangle(1.0, 0.4) }], ..Scene::default() },
        duration: DURATION,
        error: Box::new(|run| {
            run.largest(|run| (run.turned(0) - SPIN * run.time()).abs()) / (SPIN * DURATION)
        }),
        range: Range::Full,
        goal: None,
        note: "",
    }
}
