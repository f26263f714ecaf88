//! How a step is solved.

use crate::compute::Width;
use crate::resolution::asked::Asked;
use crate::resolution::integrate::SpeedLimits;
use crate::resolution::kernel::SweepOver;
use crate::resolution::solve_contact::Sweep;

/// How a step is solved. One text covers the default and the classic scheme: the classic one has a single
/// kick, one substep, many sweeps with friction, none to relax, and projects positions afterwards.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scheme {
    /// Length of the step, s.
    pub(crate) dt: f32,
    pub(crate) substeps: u32,
    /// How many of them are asked for; there may be [more](crate::resolution::refinement).
    pub(crate) asked_substeps: u32,
    /// Sweeps before the bodies move, per substep.
    pub(crate) iterations: u32,
    /// Sweeps after the bodies have moved, per substep.
    pub(crate) relax_iterations: u32,
    /// Half a kick before and half after the drift, rather than a whole one before it.
    pub(crate) split_kick: bool,
    /// Whether islands under great load may be solved directly.
    pub(crate) adapts: bool,
    pub(crate) warm_starting: bool,
    /// Whether bodies that are off course are swept.
    pub(crate) continuous: bool,
    pub(crate) block_solve: bool,
    /// Iterations of position projection at the end of the step, instead of a bias in the sweeps.
    pub(crate) projections: Option<u32>,
    /// Slowest approach that bounces, m/s.
    pub(crate) restitution_threshold: f32,
    /// Whose impulses are added up over the step.
    pub(crate) asked: Asked,
    pub(crate) limits: SpeedLimits,
    /// How many contacts are solved at a time.
    pub(crate) width: Width,
    /// Whether they are solved by kernels that leave out what none of them needs.
    pub(crate) fitted_kernels: bool,
}

impl Scheme {
    /// Length of a substep, s.
    pub(crate) fn substep_time(&self) -> f32 {
        self.dt / self.substeps as f32
    }

    /// How long the forces of one kick act, s.
    pub(crate) fn kick_time(&self) -> f32 {
        if self.split_kick { 0.5 * self.substep_time() } else { self.substep_time() }
    }

    /// The sweeps before the bodies move.
    pub(crate) fn main_sweep(&self) -> Sweep {
        Sweep {
            biased: self.projections.is_none(),
            friction: self.relax_iterations == 0,
            block: self.block_solve,
        }
    }

    /// The sweeps after it.
    pub(crate) fn relax_sweep(&self) -> Sweep {
        Sweep { biased: false, friction: true, ..self.main_sweep() }
    }

    /// A sweep of this kind; `have_moved` says whether bodies have since the last.
    pub(crate) fn sweep_over(&self, sweep: Sweep, have_moved: bool) -> SweepOver {
        let substep_rate = 1.0 / self.substep_time();
        let starts_again = self.split_kick && self.warm_starting;
        SweepOver { sweep, have_moved, substep_rate, is_fitted: self.fitted_kernels, starts_again }
    }

    /// What of the last impulses is applied before the move, and again after it where the kick is split.
    pub(crate) fn warm_part(&self) -> f32 {
        match (self.warm_starting, self.split_kick) {
            (false, _) => 0.0,
            (true, true) => 0.5,
            (true, false) => 1.0,
        }
    }
}
