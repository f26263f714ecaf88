//! The rows that were measured.

use crate::engine::Fineness;
use crate::fingerprint::word;
use crate::problems::Problem;
use crate::scene::Scene;
use crate::table::{Fields, Record};

/// A problem in an engine at some settings: how wrong it is, and how long it takes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Row {
    pub(crate) problem: String,
    /// Changes with the problem: see [`setup`].
    pub(crate) setup: String,
    pub(crate) engine: String,
    pub(crate) version: String,
    /// Changes with the engine's motions: see [`fingerprint`](crate::fingerprint).
    pub(crate) behaviour: String,
    pub(crate) fineness: Fineness,
    /// In the unit of the problem; infinite if the run came to nothing.
    pub(crate) error: f64,
    /// Empty for parts of a whole.
    pub(crate) unit: String,
    /// Least and middle run time, s per simulated second.
    pub(crate) run_time: [f64; 2],
    /// How many runs were timed.
    pub(crate) runs: usize,
    /// How many were asked for at least.
    pub(crate) repeats: u32,
    /// When the command was given that measured the row.
    pub(crate) begun: String,
}

impl Record for Row {
    const COLUMNS: &[&str] = &[
        "problem",
        "setup",
        "engine",
        "version",
        "behaviour",
        "tick_rate_hz",
        "substeps",
        "error",
        "unit",
        "run_time_least",
        "run_time_median",
        "runs",
        "repeats",
        "begun",
    ];

    /// Whether it is the same problem in the same engine at the same settings.
    fn replaces(&self, other: &Self) -> bool {
        self.problem == other.problem && self.engine == other.engine && self.fineness == other.fineness
    }

    fn lines(&self) -> Vec<Vec<String>> {
        vec![vec![
            self.problem.clone(),
            self.setup.clone(),
            self.engine.clone(),
            self.version.clone(),
            self.behaviour.clone(),
            self.fineness.tick_rate.to_string(),
            self.fineness.substeps.to_string(),
            format!("{:e}", self.error),
            self.unit.clone(),
            format!("{:e}", self.run_time[0]),
            format!("{:e}", self.run_time[1]),
            self.runs.to_string(),
            self.repeats.to_string(),
            self.begun.clone(),
        ]]
    }

    fn read(mut first: Fields, _: &mut dyn Iterator<Item = Fields>) -> Option<Self> {
        Some(Self {
            problem: first.text()?,
            setup: first.text()?,
            engine: first.text()?,
            version: first.text()?,
            behaviour: first.text()?,
            fineness: Fineness { tick_rate: first.number()?, substeps: first.number()? },
            error: first.number()?,
            unit: first.text()?,
            run_time: [first.number()?, first.number()?],
            runs: first.number()?,
            repeats: first.number()?,
            begun: first.text()?,
        })
    }
}

/// A word that changes when the scene, the duration or the measure of a problem does: rows of another problem by the
/// same name are not taken for this one's.
pub(crate) fn setup(problem: &Problem) -> String {
    let Problem { scene, duration, measure, unit, statement, .. } = problem;
    // In no problem anything sleeps.
    let Scene { bodies, gravity, pull, sleeps: _ } = scene;
    let scene = format!("Scene {{ bodies: {bodies:?}, gravity: {gravity:?}, pull: {pull:?} }}");
    let text = format!("{scene} {duration} {measure} {unit:?} {statement}");
    word(text.bytes())
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Some row.
    pub(crate) fn row() -> Row {
        Row {
            problem: "slide".into(),
            setup: "00".into(),
            engine: "Box2D".into(),
            version: "Box2D 3.2.0 (source \"abc\"), SSE2, f32".into(),
            behaviour: "01".into(),
            fineness: Fineness { tick_rate: 60.0, substeps: 4 },
            error: 1.25e-3,
            unit: String::new(),
            run_time: [1e-5, 1.5e-5],
            runs: 7,
            repeats: 5,
            begun: "2026-01-01 12:00".into(),
        }
    }
}
