//! A plank that turns over its corner.

use rustycs::report::Unit;

use crate::problems::{Class, G, Problem, Range, Run, floor, on_earth, rectangle};
use crate::scene::BodySpec;

/// Width and height of the plank, m.
const PLANK: [f64; 2] = [0.4, 2.0];
/// Friction, far above what the fall needs: up to 46° the corner pulls at the floor with less than 0.4 of its load.
const FRICTION: f64 = 2.0;
/// Leans of the centres from above the corner at the start, rad. Several, as two errors of opposite sign may cancel at
/// one of them.
const STARTS: [f64; 4] = [0.05, 0.07, 0.1, 0.14];
/// Lean at the end, rad.
const END: f64 = 0.8;

/// Distance of the centre from the corner, m, and g d / (k² + d²) of the turn around it, 1/s².
fn pivot() -> (f64, f64) {
    let square = PLANK[0] * PLANK[0] + PLANK[1] * PLANK[1];
    let arm = 0.5 * square.sqrt();
    (arm, G * arm / (square / 12.0 + square / 4.0))
}

/// Seconds from a lean to the end, from rest: φ'' = g d sin φ / (k² + d²), a pendulum upside down, by small
/// steps of the Störmer-Verlet method and a straight line within the last.
fn exact_time(start: f64) -> f64 {
    let (_, rate) = pivot();
    let step = 1e-5;
    let (mut lean, mut speed, mut time) = (start, 0.5 * step * rate * start.sin(), 0.0);
    loop {
        let next = lean + step * speed;
        if next >= END {
            return time + step * (END - lean) / (next - lean);
        }
        lean = next;
        speed += step * rate * lean.sin();
        time += step;
    }
}

pub(super) fn problems() -> Vec<Problem> {
    let exact = STARTS.map(exact_time);
    let (arm, _) = pivot();
    // From the upright plank to the one whose centre is above its corner.
    let diagonal = (PLANK[0] / PLANK[1]).atan();
    let mut bodies = vec![BodySpec { friction: FRICTION, ..floor() }];
    bodies.extend(STARTS.into_iter().enumerate().map(|(index, start)| BodySpec {
        position: [arm * start.sin() + 5.0 * (index as f64 - 1.5), arm * start.cos()],
        angle: -(start + diagonal),
        friction: FRICTION,
        ..rectangle(PLANK[0], PLANK[1])
    }));
    vec![Problem {
        name: "topple".into(),
        statement: format!(
            "Four planks of 0.4 m × 2 m, set on a corner, fall over from leans of {} to {} rad to {END} rad: \
             φ'' = g d sin φ / (k² + d²), in {:.3} to {:.3} s.",
            STARTS[0], STARTS[3], exact[0], exact[3]
        ),
        measure: "largest error of a time / time",
        unit: Unit::Part,
        class: Class::Hard,
        scene: on_earth(bodies),
        duration: 1.2,
        error: Box::new(move |run| largest_error(&exact, run)),
        range: Range::Full,
        goal: None,
        note: "The contact keeps its arms while the plank turns on within a substep, and the next one turns its velocity to \
               the new arms at once, which costs a part of it: first order.",
    }]
}

/// Largest error of the times in which the planks fall, as a part of them.
fn largest_error(exact: &[f64; 4], run: &mut Run) -> f64 {
    let turn = |run: &Run, plank: usize| [-run.turned(plank), -run.state(plank).spin];
    let mut errors = [f64::INFINITY; 4];
    // What stands for twice as long as it should never falls.
    while run.time() < 2.4 && errors.contains(&f64::INFINITY) {
        let before = [0, 1, 2, 3].map(|plank| turn(run, plank));
        run.tick();
        for (plank, error) in errors.iter_mut().enumerate().filter(|(_, error)| error.is_infinite()) {
            let (angle, after) = (END - STARTS[plank], turn(run, plank));
            if after[0] >= angle {
                let part = part_of_tick(angle, before[plank], after, run.tick_seconds());
                let time = run.time() - (1.0 - part) * run.tick_seconds();
                *error = (time / exact[plank] - 1.0).abs();
            }
        }
    }
    errors.into_iter().fold(0.0, f64::max)
}

/// In which part of a tick of length `h` (s) an angle (rad) is passed, by the cubic through angle and spin before and
/// after it.
fn part_of_tick(angle: f64, before: [f64; 2], after: [f64; 2], h: f64) -> f64 {
    let cubic = |part: f64| {
        let rest = 1.0 - part;
        before[0] * rest * rest * (1.0 + 2.0 * part)
            + after[0] * part * part * (1.0 + 2.0 * rest)
            + h * part * rest * (before[1] * rest - after[1] * part)
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if cubic(middle) < angle { low = middle } else { high = middle }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the energy, φ' = √(2 k (cos φ₀ - cos φ)), and t = ∫ dφ / φ'. With φ = φ₀ + u² the integrand is smooth.
    #[test]
    fn the_time_to_topple_is_that_of_the_integral_of_energy() {
        let (_, rate) = pivot();
        for start in STARTS {
            let integrand = |u: f64| {
                // cos φ₀ - cos φ as a product, which does not cancel.
                let (sum, half) = (start + 0.5 * u * u, 0.5 * u * u);
                2.0 * u / (4.0 * rate * sum.sin() * half.sin()).sqrt()
            };
            let (top, cells) = ((END - start).sqrt(), 20_000);
            let step = top / f64::from(cells);
            let time: f64 = (0..cells).map(|cell| step * integrand(step * (f64::from(cell) + 0.5))).sum();
            assert!((exact_time(start) / time - 1.0).abs() < 1e-7, "{} {time}", exact_time(start));
        }
    }

    #[test]
    fn the_part_of_a_tick_is_exact_for_a_cubic() {
        // x = t + 2 t² + t³ on a tick of 0.5 s, and where it is 0.3 of the way in time.
        let (at, rate) = (|t: f64| t + 2.0 * t * t + t.powi(3), |t: f64| 1.0 + 4.0 * t + 3.0 * t * t);
        let part = part_of_tick(at(0.15), [at(0.0), rate(0.0)], [at(0.5), rate(0.5)], 0.5);
        assert!((part - 0.3).abs() < 1e-12, "{part}");
    }
}
