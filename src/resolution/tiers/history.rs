//! What an island has been through: how long sweeps would have done, and how often the direct solve took more than it is worth.

use crate::resolution::load::{DIRECT_SHARE, DirectOutcome};
use crate::resolution::tier::Tier;

/// An island that is not solved directly, as it is too large, its load too small, or the solve takes too much, is
/// left alone for so many steps: it may have come into another state by then, and to look at it takes time.
pub(super) const RETRY_STEPS: u64 = 10;

/// Each further time that the solve took too much, the island is left alone for twice as long, so many times: it takes little where
/// bodies have come to another place. Then it is given up: a heap that sags under sweeps is lifted by each try, and sinks back. With six,
/// half of all heaps of fifty boxes with densities 100 : 1 move at more than 0.1 m/s after eight seconds, with this one in forty; with none,
/// heaps of gravel keep an overlap of a millimetre.
const MOST_TIMES_DEAR: u8 = 4;

/// What bore no great load for so many steps, after it was to be looked at again, is in another place, and may be solved directly again.
const FORGOTTEN_STEPS: u64 = 120;

/// Multiplications in a substep, for each body, that the direct solve is worth for each [`DIRECT_SHARE`] that sweeps would let a
/// contact sag by, if it comes to an end; sweeps are done in half the time. Towers, houses of cards and plates on balls at rest take 10 to 60; a heap of boxes
/// of one density, whose contacts come and go, takes 750.
const WORTH: f32 = 500.0;

/// What the direct solve of an island may take beyond its worth before it is left to sweeps: the sum over steps of what a substep takes, in
/// multiplications for each body. A house of cards of eight levels takes 48,000 until its loads are there, and falls if it may not. That
/// heap takes this within ten steps after it has landed, which is as long as is not yet seen.
pub(super) const MOST_OVERSPENT: f32 = 62_500.0;

/// What a body has been through in its islands, or an island, which is the worst of its bodies.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct History {
    /// For how many steps sweeps would have been enough.
    pub(super) calm_steps: u8,
    /// The tick from which on the direct solve may be thought of.
    pub(super) quiet_until: u64,
    /// The tick from which on the direct solve is tried again after it took too much.
    pub(super) retry_tick: u64,
    /// How many times it took too much.
    pub(super) times_dear: u8,
    /// Multiplications in a substep, for each body, that the last direct solve took.
    work: f32,
    /// Whether that came to no end.
    was_in_vain: bool,
    /// The overlap that sweeps would leave under its pushes, as a share of the width of the thinner body.
    pub(super) sag: f32,
    /// What direct solves have taken beyond their worth, since the island is solved so.
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
            times_dear: one.times_dear.max(other.times_dear),
            work: one.work.max(other.work),
            was_in_vain: one.was_in_vain || other.was_in_vain,
            sag: one.sag.max(other.sag),
            overspent: one.overspent.max(other.overspent),
        })
    }

    /// Takes note of how the direct solve went in the step before `tick`.
    pub(super) fn take_note(&mut self, outcome: &DirectOutcome) {
        (self.work, self.was_in_vain, self.sag) = (outcome.work, !outcome.is_solved, outcome.sag);
    }

    /// What direct solves have taken beyond their worth, with that of the last step, in an island that sweeps would let sag by this share
    /// of a width.
    pub(super) fn overspent_with(&self, sag: f32) -> f32 {
        let worth = if self.was_in_vain { 0.0 } else { WORTH * (sag / DIRECT_SHARE).max(1.0) };
        (self.overspent + self.work - worth).max(0.0)
    }

    /// Forgets how often the direct solve took too much, if the island has borne nothing for long.
    pub(super) fn forget_what_was_long_before(&mut self, tick: u64) {
        if tick > self.quiet_until + FORGOTTEN_STEPS {
            self.times_dear = 0;
        }
    }

    /// What counts of it while the body is swept: the rest is of a direct solve that has ended.
    pub(super) fn of_swept(self) -> Self {
        let Self { quiet_until, retry_tick, times_dear, .. } = self;
        Self { calm_steps: u8::MAX, quiet_until, retry_tick, times_dear, ..Self::default() }
    }

    /// Whether the direct solve took too much so often that it is not tried again.
    pub(super) fn is_given_up(&self) -> bool {
        self.times_dear == MOST_TIMES_DEAR
    }

    /// Whether an island at rest is still to change its tier after `tick`, which moves it: the direct solve will be tried
    /// again, or is about to end.
    pub(super) fn is_to_change(&self, tick: u64, tier: Tier) -> bool {
        match tier {
            Tier::Direct => self.calm_steps > 0,
            Tier::Swept => !self.is_given_up() && self.retry_tick + RETRY_STEPS > tick,
        }
    }

    /// Leaves the island alone for a while, as the direct solve takes too much.
    pub(super) fn leave_alone(&mut self, tick: u64) {
        self.retry_tick = tick + (RETRY_STEPS << self.times_dear);
        self.quiet_until = self.retry_tick;
        self.times_dear = (self.times_dear + 1).min(MOST_TIMES_DEAR);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_island_has_the_worst_of_its_bodies() {
        let calm = History { calm_steps: 9, quiet_until: 3, ..History::default() };
        let troubled =
            History { calm_steps: 2, quiet_until: 7, retry_tick: 5, times_dear: 1, ..History::default() };
        let island = History::of_island([calm, troubled].into_iter());
        assert_eq!((island.calm_steps, island.quiet_until), (2, 7));
        assert_eq!((island.retry_tick, island.times_dear), (5, 1));
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
    fn what_is_dear_is_tried_again_after_twice_as_long_each_time_and_then_given_up() {
        let mut history = History::default();
        let mut waits = Vec::new();
        while !history.is_given_up() {
            history.leave_alone(1000);
            waits.push((history.quiet_until - 1000) / RETRY_STEPS);
        }
        assert_eq!(waits.len(), usize::from(MOST_TIMES_DEAR));
        assert!(waits[0] == 1 && waits.windows(2).all(|pair| pair[1] == 2 * pair[0]), "{waits:?}");
    }

    #[test]
    fn what_has_borne_nothing_for_long_is_not_given_up_any_more() {
        let mut history = History::default();
        while !history.is_given_up() {
            history.leave_alone(1000);
        }
        let end = history.quiet_until + FORGOTTEN_STEPS;
        history.forget_what_was_long_before(end);
        assert!(history.is_given_up());
        history.forget_what_was_long_before(end + 1);
        assert!(!history.is_given_up());
    }

    #[test]
    fn work_beyond_its_worth_adds_up_and_what_is_in_vain_is_worth_nothing() {
        let mut history = History::default();
        let mut step = |work: f32, is_solved: bool, sag: f32| {
            history.take_note(&DirectOutcome { slot: 0, work, is_solved, sag: 0.0 });
            history.overspent = history.overspent_with(sag);
            history.overspent
        };
        assert_eq!(step(WORTH, true, 0.5 * DIRECT_SHARE), 0.0, "sweeps would hardly let it sag");
        assert_eq!(step(3.0 * WORTH, true, 2.0 * DIRECT_SHARE), WORTH);
        assert_eq!(step(WORTH, false, 100.0 * DIRECT_SHARE), 2.0 * WORTH);
        assert_eq!(step(WORTH, true, 2.0 * DIRECT_SHARE), WORTH, "what takes less makes up for it");
        assert_eq!(step(0.0, true, 2.0 * DIRECT_SHARE), 0.0, "and no more than that");
    }
}
