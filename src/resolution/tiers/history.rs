//! What an island has been through: how long sweeps would have done, and how often the direct solve was in vain.

use crate::resolution::load::{DIRECT_SHARE, DirectOutcome};
use crate::resolution::tier::Tier;

/// An island that is not solved directly, as it is too large, its load too small, or Newton's method came to no end, is
/// left alone for so many steps: it may have come into another state by then, and to look at it takes time.
pub(super) const RETRY_STEPS: u64 = 10;

/// Each further time that it was not solved, it is left alone for twice as long, so many times: Newton's method comes to
/// an end where bodies have come to another place. Then it is given up until a load is new: a heap that sags under sweeps
/// is lifted by each try, sinks back, and would never lie still.
const MOST_UNSOLVED_TIMES: u8 = 6;

/// Multiplications in a step, for each body, that the direct solve is worth for each [`DIRECT_SHARE`] that sweeps would let a contact
/// sag by: they take as long as two steps of sweeps. Towers, houses of cards and plates on balls at rest take 40 to 250, a heap of boxes
/// of one density, whose contacts come and go, 3,000.
const WORTH: f32 = 2_000.0;

/// What the direct solve may take beyond its worth, in multiplications for each body, before the island is left to sweeps.
/// The loads of a house of cards of eight levels take 190,000 to build up; with less it falls. With twice as much, what such a heap takes
/// as it lands is seen.
pub(super) const MOST_OVERSPENT: f32 = 250_000.0;

/// What a body has been through in its islands, or an island, which is the worst of its bodies.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct History {
    /// For how many steps sweeps would have been enough.
    pub(super) calm_steps: u8,
    /// The tick from which on the direct solve may be thought of.
    pub(super) quiet_until: u64,
    /// The tick from which on the direct solve is tried again after it did not solve the island.
    pub(super) retry_tick: u64,
    /// How many times it did not solve the island.
    pub(super) unsolved_times: u8,
    /// Multiplications for each body that the last direct solve took.
    work: f32,
    /// What it has taken beyond its worth, since the island is solved directly.
    pub(super) overspent: f32,
}

impl History {
    /// That of an island, of the histories of its bodies.
    pub(super) fn of_island(bodies: impl Iterator<Item = Self>) -> Self {
        let none = Self { calm_steps: u8::MAX, ..Self::default() };
        bodies.fold(none, |one, other| Self {
            calm_steps: one.calm_steps.min(other.calm_steps),
            quiet_until: one.quiet_until.max(other.quiet_until),
            retry_tick: one.retry_tick.max(other.retry_tick),
            unsolved_times: one.unsolved_times.max(other.unsolved_times),
            work: one.work.max(other.work),
            overspent: one.overspent.max(other.overspent),
        })
    }

    /// Takes note of how the direct solve went in the step before `tick`.
    pub(super) fn take_note(&mut self, outcome: &DirectOutcome, tick: u64) {
        self.work = outcome.work;
        if outcome.is_given_up {
            self.leave_alone(tick);
        }
    }

    /// What the direct solve has taken beyond its worth, with the last step, in an island that sweeps would let sag by this share of a width.
    pub(super) fn overspent_with(&self, sag: f32) -> f32 {
        (self.overspent + self.work - WORTH * (sag / DIRECT_SHARE).max(1.0)).max(0.0)
    }

    /// Whether the direct solve has failed so often that it is not tried again under the same load.
    pub(super) fn is_given_up(&self) -> bool {
        self.unsolved_times == MOST_UNSOLVED_TIMES
    }

    /// Whether an island at rest is still to change its tier after `tick`, which moves it: the direct solve will be tried
    /// again, or is about to end.
    pub(super) fn is_to_change(&self, tick: u64, tier: Tier) -> bool {
        match tier {
            Tier::Direct => self.calm_steps > 0,
            Tier::Swept => self.retry_tick + RETRY_STEPS > tick,
        }
    }

    /// Leaves the island alone for a while, as it could not be solved directly.
    pub(super) fn leave_alone(&mut self, tick: u64) {
        self.retry_tick = tick + (RETRY_STEPS << self.unsolved_times);
        self.quiet_until = self.retry_tick;
        self.unsolved_times = (self.unsolved_times + 1).min(MOST_UNSOLVED_TIMES);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_island_has_the_worst_of_its_bodies() {
        let calm = History { calm_steps: 9, quiet_until: 3, ..History::default() };
        let troubled =
            History { calm_steps: 2, quiet_until: 7, retry_tick: 5, unsolved_times: 1, ..History::default() };
        let island = History::of_island([calm, troubled].into_iter());
        assert_eq!((island.calm_steps, island.quiet_until), (2, 7));
        assert_eq!((island.retry_tick, island.unsolved_times), (5, 1));
    }

    #[test]
    fn an_island_changes_its_tier_while_a_retry_is_due_and_where_the_direct_solve_is_not_needed() {
        let mut history = History::default();
        assert!(!history.is_to_change(1000, Tier::Swept) && !history.is_to_change(1000, Tier::Direct));
        history.leave_alone(1000);
        assert!(history.is_to_change(history.retry_tick, Tier::Swept));
        assert!(!history.is_to_change(history.retry_tick + RETRY_STEPS, Tier::Swept));
        assert!(History { calm_steps: 1, ..history }.is_to_change(2000, Tier::Direct));
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
