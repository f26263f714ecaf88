//! What the effort for islands is decided by, whatever is in them: see [`tiers`](super::tiers) and [`refinement`](super::refinement).

use crate::resolution::load::sag_rate;
use crate::resolution::softness::sag;

/// When islands may be solved directly, and substeps refined.
#[derive(Clone, Copy)]
pub(crate) struct TierRule<'a> {
    /// Whether at all: not by schemes that solve velocities once per substep.
    pub(crate) adapts: bool,
    /// One over the length of the substeps that are asked for, 1/s.
    pub(crate) substep_rate: f32,
    /// The length of the substeps that the impulses of contacts are of, s; 0 before the first.
    pub(crate) impulses_of: f32,
    /// The force on the body in a slot, N: of all that acts on it beside contacts and joints.
    pub(crate) force_on: &'a dyn Fn(u32) -> f32,
}

impl TierRule<'_> {
    /// What an island presses with where it lies, N.
    pub(super) fn weight(&self, island: &[u32]) -> f32 {
        island.iter().map(|&slot| (self.force_on)(slot)).sum()
    }

    /// The sag share of a contact under a `weight`, N; `k_over_width`, 1/(kg m), is its k over the width of the thinner body.
    pub(super) fn sag_share_under(&self, weight: f32, k_over_width: f32) -> f32 {
        let rate = sag_rate(self.substep_rate);
        sag(k_over_width * weight / rate, rate)
    }
}
