//! What a run has measured over its last ticks.

use std::collections::VecDeque;

use rustycs::{Stage, World};

/// Share of a new measurement in the figure shown: it settles within half a second and can be read.
const SMOOTHING: f64 = 0.06;
/// Measurements that a curve shows.
pub(crate) const CURVE_LENGTH: usize = 180;

/// A measurement over the last ticks, oldest first.
#[derive(Debug, Default)]
pub(crate) struct Curve {
    values: VecDeque<f64>,
}

impl Curve {
    fn push(&mut self, value: f64) {
        if self.values.len() == CURVE_LENGTH {
            self.values.pop_front();
        }
        self.values.push_back(value);
    }

    pub(crate) fn values(&self) -> &VecDeque<f64> {
        &self.values
    }

    /// The lowest and the highest value; 0 and 0 where there are none.
    pub(crate) fn range(&self) -> (f64, f64) {
        let first = self.values.front().copied().unwrap_or_default();
        self.values.iter().fold((first, first), |(low, high), &value| (low.min(value), high.max(value)))
    }
}

/// What a run has measured over its last ticks.
#[derive(Debug, Default)]
pub(crate) struct Gauges {
    /// Time of each stage, s, smoothed.
    pub(crate) stages: [f64; Stage::ALL.len()],
    /// Time of a step, s, smoothed.
    pub(crate) step: f64,
    /// Time of each step, s.
    pub(crate) steps: Curve,
    /// Energy after each step, J.
    pub(crate) energy: Curve,
    /// Deepest penetration of each step, m.
    pub(crate) penetration: Curve,
    /// Deepest penetration of all steps, m.
    pub(crate) deepest: f64,
    /// Energy after the first step, J.
    pub(crate) first_energy: Option<f64>,
}

impl Gauges {
    /// Measures the step that a world has just taken.
    pub(crate) fn observe(&mut self, world: &World) {
        let share = if self.steps.values.is_empty() { 1.0 } else { SMOOTHING };
        let settle = |shown: &mut f64, measured: f64| *shown += (measured - *shown) * share;
        for (shown, (_, report)) in self.stages.iter_mut().zip(world.profile().stages()) {
            settle(shown, report.seconds.unwrap_or(0.0));
        }
        let seconds = world.profile().seconds().unwrap_or(0.0);
        settle(&mut self.step, seconds);
        // The clock of a browser is coarse: a single step takes 0 or 1 of its ticks.
        self.steps.push(if cfg!(target_family = "wasm") { self.step } else { seconds });
        let (energy, depth) = (world.energy(), f64::from(world.error().penetration));
        self.energy.push(energy);
        self.first_energy.get_or_insert(energy);
        self.penetration.push(depth);
        self.deepest = self.deepest.max(depth);
    }
}
