//! The settings that a study runs.

use core::fmt::Write as _;

use crate::report::error::StudyError;
use crate::world::{PositionCorrection, Settings};

/// The settings to run: every combination of some lists, and more by name.
#[derive(Clone, Debug)]
pub(super) struct Sweep {
    pub(super) base: Settings,
    pub(super) tick_rates: Option<Vec<f32>>,
    pub(super) substeps: Option<Vec<u32>>,
    pub(super) iterations: Option<Vec<u32>>,
    pub(super) adaptive: Option<Vec<bool>>,
    pub(super) named: Vec<(String, Vec<Settings>)>,
}

/// One row to be.
#[derive(Clone, Debug)]
pub(super) struct Variant {
    /// The name the settings came with.
    pub(super) name: Option<String>,
    pub(super) series: String,
    pub(super) label: String,
    pub(super) settings: Settings,
}

/// How often a substep visits all contacts: what settings cost where there is no clock.
pub(super) fn sweeps_per_substep(settings: &Settings) -> f64 {
    let projections = match settings.position_correction {
        PositionCorrection::Bias => 0,
        PositionCorrection::Projection { iterations } => iterations,
    };
    f64::from(settings.iterations + settings.relax_iterations + projections)
}

/// A list that was given, which must not be empty, or the one value of the base.
fn list_or<T: Copy>(list: Option<&Vec<T>>, base: T, name: &'static str) -> Result<Vec<T>, StudyError> {
    match list {
        None => Ok(vec![base]),
        Some(list) if list.is_empty() => Err(StudyError::EmptySweep { list: name }),
        Some(list) => Ok(list.clone()),
    }
}

fn counted(count: u32, one: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {one}s") }
}

impl Sweep {
    /// Every row to be, checked.
    pub(super) fn variants(&self) -> Result<Vec<Variant>, StudyError> {
        let tick_rates = list_or(self.tick_rates.as_ref(), self.base.tick_rate, "tick rates")?;
        let substeps = list_or(self.substeps.as_ref(), self.base.substeps, "substeps")?;
        let iterations = list_or(self.iterations.as_ref(), self.base.iterations, "iterations")?;
        let adaptive = list_or(self.adaptive.as_ref(), self.base.adaptive, "adaptive")?;
        let (names_iterations, names_adaptive) = (iterations.len() > 1, adaptive.len() > 1);
        let mut variants = Vec::new();
        for (&adaptive, &iterations) in adaptive.iter().flat_map(|a| iterations.iter().map(move |i| (a, i))) {
            for (&substeps, &tick_rate) in
                substeps.iter().flat_map(|s| tick_rates.iter().map(move |t| (s, t)))
            {
                let settings = Settings { tick_rate, substeps, adaptive, iterations, ..self.base.clone() };
                let (mut series, mut label) = (counted(substeps, "substep"), short(&settings));
                if names_iterations {
                    _ = write!(series, ", {}", counted(iterations, "iteration"));
                    _ = write!(label, " × {iterations}");
                }
                if adaptive && names_adaptive {
                    series += ", adaptive";
                    label += " adaptive";
                }
                variants.push(Variant { name: None, series, label, settings });
            }
        }
        for (name, list) in &self.named {
            if list.is_empty() {
                return Err(StudyError::EmptySweep { list: "settings with a name" });
            }
            for settings in list {
                let label = format!("{name} {}", short(settings));
                let (name, series) = (Some(name.clone()), name.clone());
                variants.push(Variant { name, series, label, settings: settings.clone() });
            }
        }
        for variant in &variants {
            let refused = |source| StudyError::Settings { label: variant.label.clone(), source };
            variant.settings.validate().map_err(refused)?;
        }
        Ok(variants)
    }
}

/// Ticks per second and substeps.
fn short(settings: &Settings) -> String {
    format!("{} Hz × {}", settings.tick_rate, settings.substeps)
}
