//! Joints that form loops yield a little.
//!
//! They may hold something more than once, as a third crank beside two parallel ones, or contradict each other, as those of a body
//! that was put elsewhere by hand. Then A = J M⁻¹ Jᵀ is singular, or almost, and the impulses by which rows work against each other have no
//! bound. So each row yields to its impulse p, and more to the part q of it that closes gaps:
//!
//! ```text
//! u + ε k p + (c - ε) k q = 0        k = J M⁻¹ Jᵀ of the row
//! ```
//!
//! (the constraint force mixing of R. Smith's Open Dynamics Engine). What is held twice is borne by both, and joints that contradict each other
//! come to rest between. A joint that is in no loop is exact. So are those that are swept over, as each is solved by itself.

use crate::resolution::joint::JointSolver;
use crate::resolution::joint::plan::Island;

/// ε, no unit. With a tenth of it, one in some hundreds of pairs of joints that contradict each other gains energy; with ten times, the pins
/// of a rope between two posts open by 25 µm where a ball of 1,000 times the mass of a link hangs in its middle.
const SHARE: f64 = 1e-7;

/// c, no unit. With a tenth of it, one in some hundreds of those pairs gains energy; with ten times, gaps close slower by a tenth, and
/// those of a straight bridge several times slower.
const SHARE_OF_CLOSING: f64 = 1e-2;

impl JointSolver {
    /// As a phase begins.
    pub(super) fn begin_to_yield(&mut self, island: &Island) {
        for &row in &island.yielding {
            self.rows[row as usize].yield_by(SHARE, 0.0);
        }
    }

    /// Before gaps close: what is added to the impulses of now closes them.
    pub(super) fn begin_to_close(&mut self, island: &mut Island) {
        for &row in &island.yielding {
            let row = &mut self.rows[row as usize];
            row.yield_by(SHARE_OF_CLOSING, -(SHARE_OF_CLOSING - SHARE) * row.unclosed);
        }
        island.forget_factors();
    }

    /// After it, where they close by this part of the way: what is added from now on closes none.
    pub(super) fn end_closing(&mut self, island: &mut Island, part: f64) {
        for &row in &island.yielding {
            let row = &mut self.rows[row as usize];
            let closing = if part > 0.0 { part * (row.impulse - row.unclosed) } else { 0.0 };
            row.yield_by(SHARE, (SHARE_OF_CLOSING - SHARE) * closing);
        }
        island.forget_factors();
    }
}
