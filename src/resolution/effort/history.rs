//! What an island has been through: how hard it was worked on, and how often in vain.

use crate::body::{Bodies, Effort, Record};

/// An island that needs no more effort, or that the direct solve could not solve, is left alone for so many steps: it may
/// have come into another state by then.
pub(super) const RETRY_STEPS: u64 = 10;

/// Each further time that it was not solved, it is left alone for twice as long, so many times: Newton's method comes to
/// an end where bodies have come to another place. Then it is given up until a load is new: a heap that sags under sweeps
/// is lifted by each try, sinks back, and would never lie still.
const MOST_UNSOLVED_TIMES: u8 = 6;

/// What the bodies of an island have been through.
#[derive(Clone, Copy, Debug)]
pub(super) struct History {
    /// The hardest effort that one of them has.
    pub(super) effort: Effort,
    /// For how many steps less would have done.
    pub(super) calm_steps: u8,
    /// The tick from which on more may be thought of.
    pub(super) quiet_until: u64,
    /// How many times the direct solve did not solve their island.
    pub(super) unsolved_times: u8,
}

impl History {
    pub(super) fn of(island: &[u32], bodies: &Bodies) -> Self {
        let none = Self { effort: Effort::Plain, calm_steps: u8::MAX, quiet_until: 0, unsolved_times: 0 };
        island.iter().fold(none, |so_far, &slot| {
            let record = &bodies.records[slot];
            Self {
                effort: so_far.effort.max(record.effort),
                calm_steps: so_far.calm_steps.min(record.calm_steps),
                quiet_until: so_far.quiet_until.max(record.quiet_until),
                unsolved_times: so_far.unsolved_times.max(record.unsolved_times),
            }
        })
    }

    /// Whether the island is to be left alone, under a load that is recent or not.
    pub(super) fn is_quiet(&self, tick: u64, is_recent: bool) -> bool {
        let has_failed = self.unsolved_times == MOST_UNSOLVED_TIMES && self.effort != Effort::Direct;
        self.quiet_until > tick || (has_failed && !is_recent)
    }
}

impl Record {
    /// Leaves the island of the body alone for a while, as it could not be solved directly.
    pub(super) fn leave_alone(&mut self, tick: u64) {
        self.quiet_until = tick + (RETRY_STEPS << self.unsolved_times);
        self.unsolved_times = (self.unsolved_times + 1).min(MOST_UNSOLVED_TIMES);
    }
}
