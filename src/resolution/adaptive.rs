//! How many substeps a step takes: more where contacts under load overlap too far, fewer again when they no longer
//! do.
//!
//! The overlap that a load leaves falls with the length of the substep, so the overlap measured in one step says
//! how many substeps the next one needs. Only the state decides, never a clock: a clone adapts as its original.

use crate::resolution::constraint::StepResidual;

/// Overlap under load that is good enough, m: a hundredth of a body of 0.8 m.
const GOOD_OVERLAP: f32 = 0.008;

/// Adapted substeps are at most this many; more settings may ask for themselves.
const MOST: u32 = 16;

/// So many steps in a row must do with fewer substeps before they are taken.
const CALM_STEPS: u32 = 30;

/// The number is halved only if less than this share of it is wanted, no unit: half and a margin, so that it does
/// not go up and down.
const CALM_SHARE: f32 = 1.0 / 2.3;

/// The substeps in force, and how long fewer would have done.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Adaptive {
    /// 0 before the first step.
    substeps: u32,
    calm_steps: u32,
}

impl Adaptive {
    /// Substeps of the next step, at least `least`; just those if it may not adapt.
    pub(crate) fn substeps(&mut self, may_adapt: bool, least: u32) -> u32 {
        if !may_adapt {
            *self = Self::default();
        }
        self.substeps = self.substeps.clamp(least, least.max(MOST));
        self.substeps
    }

    /// Learns from a step. The overlap falls at least with the square root of the number wanted, and with the
    /// number itself where it is compliance; doubling in between finds the number in a few steps.
    pub(crate) fn learn(&mut self, residual: &StepResidual) {
        let now = self.substeps as f32;
        let wanted = now * (residual.loaded_penetration / GOOD_OVERLAP).sqrt();
        self.calm_steps = if wanted < CALM_SHARE * now { self.calm_steps + 1 } else { 0 };
        if wanted > 2.0 * now {
            self.substeps *= 4;
        } else if wanted > now {
            self.substeps *= 2;
        } else if self.calm_steps >= CALM_STEPS {
            self.calm_steps = 0;
            self.substeps /= 2;
        }
    }
}
