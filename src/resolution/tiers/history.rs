//! What an island has been through: how long sweeps would have done, and how often the direct solve was in vain.

/// An island that is not solved directly, as it is too large, its load too small, or Newton's method came to no end, is
/// left alone for so many steps: it may have come into another state by then, and to look at it takes time.
pub(super) const RETRY_STEPS: u64 = 10;

/// Each further time that it was not solved, it is left alone for twice as long, so many times: Newton's method comes to
/// an end where bodies have come to another place. Then it is given up until a load is new: a heap that sags under sweeps
/// is lifted by each try, sinks back, and would never lie still.
const MOST_UNSOLVED_TIMES: u8 = 6;

/// What a body has been through in its islands, or an island, which is the worst of its bodies.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct History {
    /// For how many steps sweeps would have been enough.
    pub(super) calm_steps: u8,
    /// The tick from which on the direct solve may be thought of.
    pub(super) quiet_until: u64,
    /// How many times it did not solve the island.
    pub(super) unsolved_times: u8,
}

impl History {
    /// That of an island, of the histories of its bodies.
    pub(super) fn of_island(bodies: impl Iterator<Item = Self>) -> Self {
        let none = Self { calm_steps: u8::MAX, ..Self::default() };
        bodies.fold(none, |one, other| Self {
            calm_steps: one.calm_steps.min(other.calm_steps),
            quiet_until: one.quiet_until.max(other.quiet_until),
            unsolved_times: one.unsolved_times.max(other.unsolved_times),
        })
    }

    /// Whether the direct solve has failed so often that it is not tried again under the same load.
    pub(super) fn is_given_up(&self) -> bool {
        self.unsolved_times == MOST_UNSOLVED_TIMES
    }

    /// Leaves the island alone for a while, as it could not be solved directly.
    pub(super) fn leave_alone(&mut self, tick: u64) {
        self.quiet_until = tick + (RETRY_STEPS << self.unsolved_times);
        self.unsolved_times = (self.unsolved_times + 1).min(MOST_UNSOLVED_TIMES);
    }
}

#[cfg(test)]
mod tests {
    use super::{History, MOST_UNSOLVED_TIMES, RETRY_STEPS};

    #[test]
    fn an_island_has_the_worst_of_its_bodies() {
        let calm = History { calm_steps: 9, quiet_until: 3, unsolved_times: 0 };
        let troubled = History { calm_steps: 2, quiet_until: 7, unsolved_times: 1 };
        let island = History::of_island([calm, troubled].into_iter());
        assert_eq!((island.calm_steps, island.quiet_until, island.unsolved_times), (2, 7, 1));
    }

    #[test]
    fn what_is_not_solved_is_tried_again_after_twice_as_long_each_time_and_then_given_up() {
        let mut history = History::default();
        let mut waits = Vec::new();
        while !history.is_given_up() {
            history.leave_alone(1000);
            waits.push((history.quiet_until - 1000) / RETRY_STEPS);
        }
        assert_eq!(waits.len(), usize::from(MOST_UNSOLVED_TIMES));
        assert!(waits[0] == 1 && waits.windows(2).all(|pair| pair[1] == 2 * pair[0]), "{waits:?}");
    }
}
