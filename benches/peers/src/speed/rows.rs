//! The rows that were measured.

use rustycs_cases::overlap::Overlap;

use super::measure::End;
use super::scenes::Course;
use crate::fingerprint::word;
use crate::table::{Fields, Record};

/// A scene in an engine: how long a step takes, and in what state it ends.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) scene: String,
    /// Changes with the scene: see [`setup`].
    pub(super) setup: String,
    pub(super) engine: String,
    pub(super) version: String,
    /// What the engines of this row were measured with: Box2D for SSE2 or for AVX2.
    pub(super) lanes: String,
    /// Changes with the program: see [`build`].
    pub(super) build: String,
    /// Dynamic bodies.
    pub(super) bodies: usize,
    /// Least and middle time of a step, s.
    pub(super) step_time: [f64; 2],
    pub(super) end: End,
    /// `name share` of each stage of a step, in per cent; empty for the peers.
    pub(super) stages: String,
    pub(super) repeats: u32,
    /// When the command was given that measured the row.
    pub(super) begun: String,
}

impl Record for Row {
    const COLUMNS: &[&str] = &[
        "scene",
        "setup",
        "engine",
        "version",
        "box2d_lanes",
        "build",
        "bodies",
        "step_s_least",
        "step_s_median",
        "deepest_overlap_m",
        "mean_overlap_m",
        "kinetic_energy_j",
        "energy_part_of_start",
        "contact_points",
        "stages_per_cent",
        "repeats",
        "begun",
    ];

    fn replaces(&self, other: &Self) -> bool {
        self.scene == other.scene && self.engine == other.engine && self.lanes == other.lanes
    }

    fn lines(&self) -> Vec<Vec<String>> {
        vec![vec![
            self.scene.clone(),
            self.setup.clone(),
            self.engine.clone(),
            self.version.clone(),
            self.lanes.clone(),
            self.build.clone(),
            self.bodies.to_string(),
            format!("{:e}", self.step_time[0]),
            format!("{:e}", self.step_time[1]),
            format!("{:e}", self.end.overlap.deepest),
            format!("{:e}", self.end.overlap.mean),
            format!("{:e}", self.end.kinetic_energy),
            format!("{:e}", self.end.energy),
            self.end.points.to_string(),
            self.stages.clone(),
            self.repeats.to_string(),
            self.begun.clone(),
        ]]
    }

    fn read(mut first: Fields, _: &mut dyn Iterator<Item = Fields>) -> Option<Self> {
        Some(Self {
            scene: first.text()?,
            setup: first.text()?,
            engine: first.text()?,
            version: first.text()?,
            lanes: first.text()?,
            build: first.text()?,
            bodies: first.number()?,
            step_time: [first.number()?, first.number()?],
            end: End {
                overlap: Overlap { deepest: first.number()?, mean: first.number()? },
                kinetic_energy: first.number()?,
                energy: first.number()?,
                points: first.number()?,
            },
            stages: first.text()?,
            repeats: first.number()?,
            begun: first.text()?,
        })
    }
}

/// A word that changes when the scene or its duration does.
pub(super) fn setup(course: &Course) -> String {
    let Course { scene, drum, warm_up, ticks, .. } = course;
    word(format!("{scene:?} {drum:?} {warm_up} {ticks}").bytes())
}

/// A word that changes when this program does: times of another one are measured again.
pub(super) fn build() -> String {
    word(std::env::current_exe().and_then(std::fs::read).unwrap_or_default())
}
