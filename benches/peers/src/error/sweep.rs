//! At which settings problems are run.

use crate::engine::Fineness;
use crate::problems::{Problem, Range};

/// Rates (1/s) and substeps of a problem, the coarsest first.
pub(super) fn settings(problem: &Problem, is_quick: bool) -> Vec<Fineness> {
    let (rates, substeps): (&[f64], &[u32]) = match (problem.range, is_quick) {
        (Range::Full, false) => (&[30.0, 60.0, 120.0, 240.0, 480.0, 960.0], &[1, 2, 3, 4, 5, 6, 7, 8]),
        (Range::Full, true) => (&[30.0, 60.0, 120.0, 240.0], &[1, 4]),
        (Range::Short, false) => (&[30.0, 60.0, 120.0, 240.0], &[1, 2, 3, 4, 6, 8]),
        (Range::Short, true) => (&[60.0], &[4]),
        (Range::Few, false) => (&[60.0, 120.0], &[4]),
        (Range::Few, true) => (&[], &[]),
    };
    let with = |tick_rate: f64| substeps.iter().map(move |&substeps| Fineness { tick_rate, substeps });
    rates.iter().flat_map(|&rate| with(rate)).collect()
}

/// Work of a run, in bodies times substeps and ticks: to tell how far the command is.
pub(super) fn work(problem: &Problem, Fineness { tick_rate, substeps }: Fineness) -> f64 {
    problem.duration * tick_rate * f64::from(substeps + 2) * (problem.scene.bodies.len() as f64 + 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::DEFAULT;

    #[test]
    fn every_problem_is_run_at_default_settings() {
        for problem in crate::problems::all() {
            assert!(settings(&problem, false).contains(&DEFAULT), "{}", problem.name);
            assert!(settings(&problem, true).contains(&DEFAULT) || problem.range == Range::Few);
        }
    }
}
