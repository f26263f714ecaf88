//! The floor of a step's time: what this machine needs at least for the arithmetic of the sweeps, and for moving what
//! they read and write.

mod peaks;

use rustycs::Settings;
use rustycs::report::Work;

use super::rows::Row;
pub(super) use peaks::Peaks;

/// Passes over the contacts in a substep: a warm start and two sweeps.
const PASSES: f64 = 3.0;

/// The least time of the sweeps of a step, s, and what sets it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Floor {
    pub(super) time: f64,
    /// Whether it is moving bytes, and not arithmetic.
    pub(super) is_memory: bool,
}

/// For as many contacts of two points as the points that a run ended with.
pub(super) fn floor(row: &Row, peaks: &Peaks) -> Floor {
    let Work { operations, bytes } = Work::of_a_contact();
    let [operations, bytes] =
        [operations, bytes].map(|of_one| f64::from(of_one) * 0.5 * row.end.points as f64);
    let substeps = f64::from(Settings::default().substeps);
    let arithmetic = substeps * operations / peaks.operations;
    let memory = substeps * bytes / peaks.bandwidth(bytes / PASSES);
    Floor { time: arithmetic.max(memory), is_memory: memory > arithmetic }
}
