//! Errors and run times of one problem at one fineness, in several engines.

use std::time::Instant;

use crate::engine::{Engine, Fineness};
use crate::problems::{self, Problem, Run};

/// Runs of a row are timed for so long in all at least, s, however short each is ...
const LEAST_SPENT: f64 = 0.02;
/// ... but not more often than this many times what was asked for ...
const MOST_MORE: u32 = 100;
/// ... and, but for a second time, not when so much has been spent, s.
const MOST_SPENT: f64 = 4.0;

/// What was measured of an engine.
#[derive(Clone, Debug, Default)]
pub(super) struct Measured {
    /// In the unit of the problem; infinite if the run came to nothing.
    pub(super) error: f64,
    /// Run times, s per simulated second.
    times: Vec<f64>,
    /// What they took together, s.
    spent: f64,
}

impl Measured {
    /// Least and middle run time, s per simulated second.
    pub(super) fn run_time(&self) -> [f64; 2] {
        let mut times = self.times.clone();
        times.sort_by(f64::total_cmp);
        [times[0], times[times.len() / 2]]
    }

    pub(super) fn runs(&self) -> usize {
        self.times.len()
    }

    fn wants_more(&self, repeats: u32) -> bool {
        let runs = self.times.len();
        let too_few = runs < repeats as usize;
        let too_short = self.spent < LEAST_SPENT && runs < (repeats * MOST_MORE) as usize;
        runs < 2 || ((too_few || too_short) && self.spent < MOST_SPENT)
    }
}

/// The error of one engine, in a run of its own.
pub(super) fn error(problem: &Problem, engine: &dyn Engine, fineness: Fineness) -> f64 {
    let error = (problem.error)(&mut Run::new(problem, engine, fineness));
    if error.is_nan() { f64::INFINITY } else { error }
}

/// Measures all engines: first their errors, then their run times in turn, each on a new world whose making is not
/// timed. `None` if it was stopped.
pub(super) fn measure(
    problem: &Problem,
    engines: &[&dyn Engine],
    fineness: Fineness,
    repeats: u32,
    is_stopped: &dyn Fn() -> bool,
) -> Option<Vec<Measured>> {
    let mut all = Vec::new();
    for &engine in engines {
        all.push(Measured { error: error(problem, engine, fineness), ..Measured::default() });
        if is_stopped() {
            return None;
        }
    }
    let ticks = problems::ticks(problem, fineness);
    while all.iter().any(|measured| measured.wants_more(repeats)) {
        for (measured, engine) in all.iter_mut().zip(engines) {
            if !measured.wants_more(repeats) {
                continue;
            }
            let mut simulation = engine.simulate(&problem.scene, fineness);
            let start = Instant::now();
            for _ in 0..ticks {
                simulation.step();
            }
            let seconds = start.elapsed().as_secs_f64();
            measured.times.push(seconds / problem.duration);
            measured.spent += seconds;
            if is_stopped() {
                return None;
            }
        }
    }
    Some(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::DEFAULT;
    use crate::engines::Misled;
    use crate::scene::Scene;

    /// The error of rustycs on a problem, with something planted, at default settings.
    fn with_planted(name: &str, planted: fn(&mut Scene)) -> f64 {
        let problems = problems::all();
        let problem = problems.iter().find(|problem| problem.name == name).expect("it is one of them");
        let mislead = |scene: &mut Scene, _: &mut Fineness| planted(scene);
        error(problem, &Misled { engine: engines().remove(0), mislead }, DEFAULT)
    }

    fn engines() -> Vec<Box<dyn Engine>> {
        crate::engines::all()
    }

    #[test]
    fn a_planted_error_of_one_per_cent_is_seen() {
        let more_gravity = |scene: &mut Scene| scene.gravity[1] *= 1.01;
        let rougher = |scene: &mut Scene| scene.bodies.iter_mut().for_each(|body| body.friction *= 1.01);
        let livelier = |scene: &mut Scene| scene.bodies.iter_mut().for_each(|body| body.restitution *= 1.01);
        let stronger = |scene: &mut Scene| scene.pull.as_mut().expect("there is one").strength *= 1.01;
        let heavier = |scene: &mut Scene| scene.bodies[0].density *= 1.01;
        let faster = |scene: &mut Scene| scene.bodies[0].spin *= 1.01;
        for (problem, planted, expected) in [
            // 1 % of the fall; of the way v²/(2µg).
            ("projectile", more_gravity as fn(&mut Scene), 0.01),
            ("spin", faster, 0.01),
            ("slide", rougher, 0.01),
            ("roll", more_gravity, 0.01),
            // The part µ cos / (sin - µ cos) of the acceleration, 1.22 for 20° and 0.2.
            ("incline-slide", rougher, 0.0122),
            // (1.01)⁸ - 1.
            ("bounce-0.5", livelier, 0.083),
            // v_b = 2 m_a / (m_a + m_b) v of masses 1.01 and 3: half of 0.0075.
            ("head-on", heavier, 0.0037),
            // T ~ g^(-1/2).
            ("topple", more_gravity, 0.005),
        ] {
            let found = with_planted(problem, planted);
            assert!((found / expected - 1.0).abs() < 0.5, "{problem}: {found}, expected {expected} or so");
        }
        // A period too short by half a per cent, ten times: 0.3 rad ahead at the end.
        let found = with_planted("kepler-0.5", stronger);
        assert!((0.1..1.0).contains(&found), "{found}");
    }

    #[test]
    fn every_problem_gives_a_number_in_every_engine() {
        let dear = ["bounce-1", "stack-50", "stack-100", "gas"];
        for problem in problems::all().iter().filter(|problem| !dear.contains(&problem.name.as_str())) {
            for engine in engines() {
                let error = error(problem, engine.as_ref(), Fineness { tick_rate: 30.0, substeps: 2 });
                assert!(error >= 0.0, "{} in {}: {error}", problem.name, engine.name());
            }
        }
    }

    #[test]
    fn all_engines_are_timed_as_often_as_asked() {
        let problems = problems::all();
        let engines = engines();
        let engines: Vec<&dyn Engine> = engines.iter().map(Box::as_ref).collect();
        let measured = measure(&problems[0], &engines, DEFAULT, 7, &|| false).expect("nobody stops it");
        for one in &measured {
            let [least, median] = one.run_time();
            assert!(one.runs() >= 7 && 0.0 < least && least <= median, "{one:?}");
        }
        assert!(measure(&problems[0], &engines, DEFAULT, 7, &|| true).is_none());
    }
}
