//! What bodies have been through in their islands: for how long sweeps would have been enough, and how often the direct solve took more than it
//! is worth. After that it is not tried for a while, a cooldown.
//!
//! Islands are found anew in each step, so what is known of them is kept in their bodies.

use crate::resolution::load::{CALM_STEPS, DIRECT_SHARE, DirectOutcome};
use crate::resolution::tier::Tier;

/// Cooldown of an island that was left to sweeps as its load is too small, and the first cooldown of one whose direct solve took too much:
/// it may have come into another state by then, and to look at it takes time.
pub(super) const RETRY_STEPS: u64 = 10;

/// The solve is given up when it has taken too much so many times. Each cooldown is twice as long as the one before: it takes little where
/// bodies have come to another place. But a heap that sags under sweeps is lifted by each try, and sinks back. With six,
/// half of all heaps of fifty boxes with densities 100 : 1 move at more than 0.1 m/s after eight seconds, with this one in forty; with none,
/// heaps of gravel keep an overlap of a millimetre.
const MOST_TIMES_DEAR: u8 = 4;

/// What was left alone for so many steps beyond its cooldown bore no great load, is in another place, and may be solved directly again.
const FORGOTTEN_STEPS: u64 = 120;

/// What the direct solve is worth: so many multiplications for each body in each substep that was asked for, for each [`DIRECT_SHARE`] of
/// the sag share that sweeps would leave, and at least for one. What it does not solve is worth nothing. Sweeps of the island take half of
/// it. Where substeps are refined a solve takes as many times more, and is worth no more. Towers, houses of cards and plates on balls at
/// rest take 10 to 60; a heap of boxes of one density, whose contacts come and go, takes 750.
const WORTH: f32 = 500.0;

/// What the direct solve of an island may take beyond its worth: multiplications for each body in each substep, summed over the steps since it
/// began. Steps that take less than their worth make up for others. A house of cards of eight levels comes to 48,000 until its loads
/// are there, and falls if it may not. The heap comes to this within ten steps after it has landed, which is too short to be seen.
pub(super) const MOST_OVERSPENT: f32 = 62_500.0;

/// What a body has been through in its islands.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct History {
    /// The tick from which on a swept island is looked at again.
    pub(super) cooldown_end: u64,
    /// The tick from which on the direct solve is tried again after it took too much. What is at rest sleeps only [`RETRY_STEPS`] later.
    retry_tick: u64,
    /// How many times it took too much.
    pub(super) times_dear: u8,
    /// What is known of the direct solve; not read while the body is swept.
    pub(super) direct: DirectHistory,
}

/// How the direct solve goes, since the island is solved so.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct DirectHistory {
    /// For how many steps more in which sweeps would be enough it is solved so, up to [`CALM_STEPS`].
    pub(super) calm_steps_left: u8,
    /// What it has taken beyond its worth, in the unit of [`MOST_OVERSPENT`].
    pub(super) overspent: f32,
    /// Multiplications for each body in each substep that was asked for, in the last step.
    work: f32,
    /// Whether the last step did not solve the island.
    was_in_vain: bool,
    /// The sag share that sweeps would leave under the impulses that push the bodies apart.
    pub(super) sag_share: f32,
    /// For how many steps in a row it has been squeezed.
    pub(super) squeezed_steps: u8,
}

impl History {
    /// Takes note of how the direct solve went in the last step.
    pub(super) fn take_note(&mut self, outcome: &DirectOutcome) {
        let of_direct = &mut self.direct;
        (of_direct.work, of_direct.was_in_vain) = (outcome.work, !outcome.is_solved);
        of_direct.sag_share = outcome.sag_share;
    }

    /// Forgets how often the direct solve took too much, if the island has borne nothing for long.
    pub(super) fn forget_what_was_long_before(&mut self, tick: u64) {
        if tick > self.cooldown_end + FORGOTTEN_STEPS {
            self.times_dear = 0;
        }
    }

    /// Whether an island at rest is still to change its tier after `tick`, which moves it: the direct solve will be tried
    /// again, or is about to end.
    pub(super) fn is_to_change(&self, tick: u64, tier: Tier) -> bool {
        match tier {
            Tier::Direct => self.direct.calm_steps_left < CALM_STEPS,
            Tier::Swept => !is_given_up(self.times_dear) && self.retry_tick + RETRY_STEPS > tick,
        }
    }

    /// Begins the cooldown after a direct solve that took too much.
    pub(super) fn leave_alone(&mut self, tick: u64) {
        self.retry_tick = tick + (RETRY_STEPS << self.times_dear);
        self.cooldown_end = self.retry_tick;
        self.times_dear = (self.times_dear + 1).min(MOST_TIMES_DEAR);
    }
}

/// What an island has been through: the worst of its bodies.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct IslandHistory {
    pub(super) cooldown_end: u64,
    pub(super) times_dear: u8,
    /// Of those of its bodies that were solved directly; the default if none was. What a swept body has is of a direct solve that has ended.
    pub(super) direct: DirectHistory,
}

impl IslandHistory {
    /// From the histories and the tiers of its bodies.
    pub(super) fn of_bodies(bodies: impl Iterator<Item = (History, Tier)>) -> Self {
        let (mut island, mut direct) = (Self::default(), None);
        for (body, tier) in bodies {
            island.cooldown_end = island.cooldown_end.max(body.cooldown_end);
            island.times_dear = island.times_dear.max(body.times_dear);
            if tier == Tier::Direct {
                direct = Some(direct.map_or(body.direct, |other| body.direct.worst(other)));
            }
        }
        Self { direct: direct.unwrap_or_default(), ..island }
    }

    /// Whether the direct solve took too much so often that it is not tried again.
    pub(super) fn is_given_up(&self) -> bool {
        is_given_up(self.times_dear)
    }
}

impl DirectHistory {
    fn worst(self, other: Self) -> Self {
        Self {
            calm_steps_left: self.calm_steps_left.max(other.calm_steps_left),
            overspent: self.overspent.max(other.overspent),
            work: self.work.max(other.work),
            was_in_vain: self.was_in_vain || other.was_in_vain,
            sag_share: self.sag_share.max(other.sag_share),
            squeezed_steps: self.squeezed_steps.max(other.squeezed_steps),
        }
    }

    /// What direct solves have taken beyond their worth, with that of the last step, in an island in which sweeps would leave this sag share.
    pub(super) fn overspent_with(&self, sag_share: f32) -> f32 {
        let worth = if self.was_in_vain { 0.0 } else { WORTH * (sag_share / DIRECT_SHARE).max(1.0) };
        (self.overspent + self.work - worth).max(0.0)
    }
}

fn is_given_up(times_dear: u8) -> bool {
    times_dear == MOST_TIMES_DEAR
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_island_has_the_worst_of_its_bodies_and_nothing_of_a_direct_solve_that_has_ended() {
        let direct =
            |calm_steps_left, overspent| DirectHistory { calm_steps_left, overspent, ..Default::default() };
        let calm = History { cooldown_end: 3, direct: direct(2, 1.0), ..History::default() };
        let troubled = History { cooldown_end: 7, times_dear: 1, direct: direct(9, 5.0), ..calm };
        let seen = |tiers: [Tier; 2]| {
            let island = IslandHistory::of_bodies([calm, troubled].into_iter().zip(tiers));
            assert_eq!((island.cooldown_end, island.times_dear), (7, 1));
            (island.direct.calm_steps_left, island.direct.overspent)
        };
        assert_eq!(seen([Tier::Direct, Tier::Direct]), (9, 5.0));
        assert_eq!(seen([Tier::Direct, Tier::Swept]), (2, 1.0));
        assert_eq!(seen([Tier::Swept, Tier::Swept]), (0, 0.0));
    }

    #[test]
    fn an_island_changes_its_tier_while_a_retry_is_due_and_where_the_direct_solve_is_not_needed() {
        let mut history = History::default();
        assert!(!history.is_to_change(1000, Tier::Swept));
        history.leave_alone(1000);
        assert!(history.is_to_change(history.retry_tick, Tier::Swept));
        assert!(!history.is_to_change(history.retry_tick + RETRY_STEPS, Tier::Swept));
        for (calm_steps_left, changes) in [(CALM_STEPS, false), (CALM_STEPS - 1, true), (0, true)] {
            let direct = DirectHistory { calm_steps_left, ..DirectHistory::default() };
            assert_eq!(History { direct, ..history }.is_to_change(2000, Tier::Direct), changes);
        }
    }

    #[test]
    fn what_is_dear_is_tried_again_after_twice_as_long_each_time_and_then_given_up() {
        let mut history = History::default();
        let mut waits = Vec::new();
        while !is_given_up(history.times_dear) {
            history.leave_alone(1000);
            waits.push((history.cooldown_end - 1000) / RETRY_STEPS);
        }
        assert_eq!(waits.len(), usize::from(MOST_TIMES_DEAR));
        assert!(waits[0] == 1 && waits.windows(2).all(|pair| pair[1] == 2 * pair[0]), "{waits:?}");
    }

    #[test]
    fn what_has_borne_nothing_for_long_is_not_given_up_any_more() {
        let mut history = History::default();
        while !is_given_up(history.times_dear) {
            history.leave_alone(1000);
        }
        let end = history.cooldown_end + FORGOTTEN_STEPS;
        history.forget_what_was_long_before(end);
        assert!(is_given_up(history.times_dear));
        history.forget_what_was_long_before(end + 1);
        assert!(!is_given_up(history.times_dear));
    }

    #[test]
    fn work_beyond_its_worth_adds_up_and_what_is_in_vain_is_worth_nothing() {
        let mut history = History::default();
        let mut step = |work: f32, is_solved: bool, sag_share: f32| {
            history.take_note(&DirectOutcome { slot: 0, work, is_solved, sag_share: 0.0 });
            history.direct.overspent = history.direct.overspent_with(sag_share);
            history.direct.overspent
        };
        assert_eq!(step(WORTH, true, 0.5 * DIRECT_SHARE), 0.0, "sweeps would hardly let it sag");
        assert_eq!(step(3.0 * WORTH, true, 2.0 * DIRECT_SHARE), WORTH);
        assert_eq!(step(WORTH, false, 100.0 * DIRECT_SHARE), 2.0 * WORTH);
        assert_eq!(step(WORTH, true, 2.0 * DIRECT_SHARE), WORTH, "what takes less makes up for it");
        assert_eq!(step(0.0, true, 2.0 * DIRECT_SHARE), 0.0, "and no more than that");
    }
}
