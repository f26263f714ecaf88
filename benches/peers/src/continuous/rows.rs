//! How many trials of a kind pass in an engine.

use crate::continuous::trial::SPEEDS;
use crate::table::{Fields, Record};

/// What is thrown at a wall in an engine, at all speeds.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) throw: String,
    /// Of the wall, m.
    pub(super) thickness: f64,
    pub(super) engine: String,
    pub(super) version: String,
    /// Changes with the engine's motions: see [`fingerprint`](crate::fingerprint).
    pub(super) behaviour: String,
    /// How many trials there were at each speed.
    pub(super) trials: u32,
    /// How many of them passed, by speed.
    pub(super) passed: [u32; SPEEDS.len()],
    /// When the command was given.
    pub(super) begun: String,
}

impl Record for Row {
    const COLUMNS: &[&str] =
        &["throw", "thickness", "engine", "version", "behaviour", "trials", "passed", "begun"];

    fn replaces(&self, other: &Self) -> bool {
        self.throw == other.throw && self.thickness == other.thickness && self.engine == other.engine
    }

    fn lines(&self) -> Vec<Vec<String>> {
        let passed = self.passed.map(|count| count.to_string()).join(" ");
        vec![vec![
            self.throw.clone(),
            self.thickness.to_string(),
            self.engine.clone(),
            self.version.clone(),
            self.behaviour.clone(),
            self.trials.to_string(),
            passed,
            self.begun.clone(),
        ]]
    }

    fn read(mut line: Fields, _: &mut dyn Iterator<Item = Fields>) -> Option<Self> {
        let (throw, thickness, engine) = (line.text()?, line.number()?, line.text()?);
        let (version, behaviour, trials) = (line.text()?, line.text()?, line.number()?);
        let counts: Option<Vec<u32>> = line.text()?.split(' ').map(|count| count.parse().ok()).collect();
        let passed = counts?.try_into().ok()?;
        Some(Self { throw, thickness, engine, version, behaviour, trials, passed, begun: line.text()? })
    }
}
