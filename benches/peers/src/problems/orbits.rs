//! A planet on an ellipse.

use rustycs::report::Unit;

use crate::problems::{Class, Problem, Range, disc, distance};
use crate::scene::{BodySpec, Pull, Scene};

pub(super) fn problems() -> Vec<Problem> {
    vec![kepler(0.5, "kepler-0.5"), kepler(0.9, "kepler-0.9")]
}

/// Half the long axis, m.
const AXIS: f64 = 1.0;
/// Acceleration times distance squared, m³/s²: the period is 2π s.
const STRENGTH: f64 = 1.0;

fn kepler(eccentricity: f64, name: &str) -> Problem {
    let start = Planet::at(0.0, eccentricity);
    let planet = BodySpec { position: start.position, velocity: start.velocity, ..disc(0.01) };
    let pull = Pull { center: [0.0; 2], strength: STRENGTH };
    Problem {
        name: name.into(),
        statement: format!(
            "A planet under a = 1/r² on an ellipse of a = 1 m and e = {eccentricity}, period 2π s, from its far end on \
             for 10 periods: Kepler's equation."
        ),
        measure: "largest distance from the exact place / half axis",
        unit: Unit::Part,
        class: Class::Smooth,
        scene: Scene { bodies: vec![planet], pull: Some(pull), ..Scene::default() },
        duration: 63.0,
        error: Box::new(move |run| {
            run.largest(|run| distance(run.state(0).position, Planet::at(run.time(), eccentricity).position))
                / AXIS
        }),
        range: Range::Full,
        goal: None,
        note: "",
    }
}

/// Place (m) and velocity (m/s) of a planet around the origin.
#[derive(Clone, Copy, Debug)]
struct Planet {
    position: [f64; 2],
    velocity: [f64; 2],
}

impl Planet {
    /// Where it is `time` s after it was at the far end of its ellipse, on the right.
    ///
    /// Kepler's equation M = E - e sin E, with the mean anomaly M from the far end, as E + e sin E from there.
    fn at(time: f64, e: f64) -> Self {
        let rate = (STRENGTH / AXIS.powi(3)).sqrt();
        let mean = rate * time;
        // Newton's method from E = M; where e is large a bisection would be as quick and as safe, so steps are bounded.
        let mut anomaly = mean;
        for _ in 0..100 {
            let step = (anomaly + e * anomaly.sin() - mean) / (1.0 + e * anomaly.cos());
            anomaly -= step.clamp(-0.5, 0.5);
            if step.abs() < 1e-15 * anomaly.abs().max(1.0) {
                break;
            }
        }
        let (sin, cos) = anomaly.sin_cos();
        let minor = AXIS * (1.0 - e * e).sqrt();
        let anomaly_rate = rate / (1.0 + e * cos);
        Self {
            position: [AXIS * (cos + e), minor * sin],
            velocity: [-AXIS * sin * anomaly_rate, minor * cos * anomaly_rate],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn derivative([x, y, u, v]: [f64; 4]) -> [f64; 4] {
        let cube = x.hypot(y).powi(3);
        [u, v, -STRENGTH * x / cube, -STRENGTH * y / cube]
    }

    /// One step of the classic Runge-Kutta method of fourth order.
    fn runge_kutta(state: [f64; 4], step: f64) -> [f64; 4] {
        let moved = |rate: [f64; 4], by: f64| [0, 1, 2, 3].map(|i| state[i] + by * rate[i]);
        let a = derivative(state);
        let b = derivative(moved(a, 0.5 * step));
        let c = derivative(moved(b, 0.5 * step));
        let d = derivative(moved(c, step));
        moved([0, 1, 2, 3].map(|i| (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]) / 6.0), step)
    }

    #[test]
    fn the_closed_form_is_what_the_equation_of_motion_integrates_to() {
        for e in [0.0, 0.5, 0.9] {
            let Planet { position: [x, y], velocity: [u, v] } = Planet::at(0.0, e);
            let mut state = [x, y, u, v];
            let step = 1e-4;
            for tick in 1..=130_000 {
                state = runge_kutta(state, step);
                if tick % 1000 == 0 {
                    let exact = Planet::at(f64::from(tick) * step, e);
                    let [x, y, u, v] = state;
                    assert!(distance(exact.position, [x, y]) < 1e-7, "e = {e}: {exact:?} {state:?}");
                    assert!(distance(exact.velocity, [u, v]) < 1e-5, "e = {e}: {exact:?} {state:?}");
                }
            }
        }
    }
}
