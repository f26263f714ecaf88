//! Joints that form loops yield a little.
//!
//! They may hold something more than once, as a third crank beside two parallel ones, or contradict each other, as those of a body
//! that was put elsewhere by hand. Then A = J M⁻¹ Jᵀ is singular, or almost, and what rows bear against each other has no end. With
//! a small share ε of its diagonal more (the constraint force mixing of R. Smith's Open Dynamics Engine) it has: what is held twice is
//! borne by both, and what cannot be held is between what the two ask for. Joints that form none are exact, and those that are swept over
//! are each solved by itself.

use crate::resolution::joint::JointSolver;
use crate::resolution::joint::plan::Island;

/// ε, no unit. With a tenth of it, one pair in a hundred of joints that cannot both be as they ask gains energy; with ten times, the pins of
/// a rope between two posts open by 25 µm where a ball of 1,000 times the mass of a link hangs in its middle.
pub(super) const SHARE: f64 = 1e-7;

/// The same for what closes gaps, which may be against each other by more. With a tenth of it, one in some hundreds of those pairs gains energy;
/// with ten times, gaps close slower by a tenth, and those of a straight bridge hardly.
pub(super) const SHARE_TO_CLOSE: f64 = 1e-2;

impl JointSolver {
    /// Has rows of loops yield to all that they bear, as a phase begins.
    pub(super) fn begin_to_yield(&mut self, island: &Island) {
        for &row in &island.yielding {
            self.rows[row as usize].yield_beyond(0.0, SHARE);
        }
    }

    /// Has them yield as fast as they do to what they bear, and by another share to what is to come.
    pub(super) fn go_on_to_yield(&mut self, island: &mut Island, share: f64) {
        for &row in &island.yielding {
            let row = &mut self.rows[row as usize];
            row.go_on_to_yield(share, row.yielding());
        }
        island.forget_factors();
    }

    /// Has them go back to what they bore before gaps closed, and yield as fast as the part of the way tells that is gone.
    pub(super) fn take_back_yielding(&mut self, island: &mut Island) {
        let part = island.times.closing;
        for &row in &island.yielding {
            let row = &mut self.rows[row as usize];
            let closed = row.yielding();
            row.impulse = row.unclosed;
            let unclosed = row.yielding();
            let speed = if part > 0.0 { unclosed + part * (closed - unclosed) } else { unclosed };
            row.go_on_to_yield(SHARE, speed);
        }
        island.forget_factors();
    }
}
