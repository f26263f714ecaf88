//! What an island bears and has been through, and what it asks for by that.

use crate::resolution::load::{CALM_STEPS, DIRECT_SHARE, GREAT_SHARE, IslandLoad, LASTING_STEPS};
use crate::resolution::tiers::history::IslandHistory;

/// What the direct solve took too much for is not solved so again unless the sag share of a contact is above this, no unit: it would be lifted
/// out of its sag, and fall back. Where it is tried again all the same, piles at rest move again and card houses of five levels fall.
const RETRY_SHARE: f32 = 0.05;

/// For how many calm steps an island is solved directly after a blow, or as it begins at rest: a load that begins in one of the first two lasts
/// before they are over, and keeps it so for [`CALM_STEPS`]. Two steps less leave none to spare, and no case of stacks, structures or heaps was
/// found that they break.
pub(super) const STEPS_AFTER_BLOW: u8 = LASTING_STEPS + 1;

/// What is known of an island when its tier is decided.
#[derive(Debug)]
pub(super) struct LoadedIsland {
    pub(super) load: IslandLoad,
    /// Whether joints hold any of its bodies.
    pub(super) is_joined: bool,
    /// Whether a blow is a reason to solve it directly: it is small, and no kinematic body that moves touches it. Between walls and what such a
    /// body presses on a blow may have no solution: bodies left a box with a paddle.
    pub(super) counts_blows: bool,
    /// Whether at least half of it was solved directly in the last step: a heap is not solved so because a few bodies that were, as they were
    /// struck, fall on it.
    pub(super) was_direct: bool,
    pub(super) history: IslandHistory,
}

impl LoadedIsland {
    /// The greatest sag share of a load that counts.
    fn sag_share(&self) -> f32 {
        let of_contacts = match (self.counts_blows, self.is_joined) {
            (true, true) => self.load.still.max(self.load.passing),
            (true, false) => self.load.still,
            (false, _) => self.load.lasting,
        };
        // What presses bodies into each other is no load of their contacts when they are solved directly, but sweeps would wind one up.
        if self.was_direct { of_contacts.max(self.history.direct.sag_share) } else { of_contacts }
    }

    /// Whether it is solved directly, and sweeps would be enough now.
    pub(super) fn is_calm(&self) -> bool {
        self.was_direct && self.sag_share() <= GREAT_SHARE
    }

    /// Whether it asks to be solved directly, or to stay so.
    pub(super) fn asks(&self, tick: u64) -> bool {
        let history = &self.history;
        if self.was_direct {
            // Few of its bodies may be in a cooldown, which have come to it since.
            return !self.is_calm() || history.direct.calm_steps_left > 0;
        }
        let is_barred = history.cooldown_end > tick || history.is_given_up();
        let least = if history.times_dear > 0 { RETRY_SHARE } else { DIRECT_SHARE };
        self.sag_share() > least && !is_barred
    }

    /// What direct solves have taken beyond their worth. It is always worth it in an island that counts blows.
    pub(super) fn overspent(&self) -> f32 {
        if self.was_direct && !self.counts_blows {
            self.history.direct.overspent_with(self.sag_share())
        } else {
            0.0
        }
    }

    /// For how many calm steps it is solved directly after the step to come.
    pub(super) fn calm_steps_left(&self) -> u8 {
        let left = self.history.direct.calm_steps_left;
        if !self.was_direct {
            return if self.load.lasting <= DIRECT_SHARE { STEPS_AFTER_BLOW } else { CALM_STEPS };
        }
        if self.is_calm() {
            left.saturating_sub(1)
        } else if self.load.lasting <= GREAT_SHARE {
            left.max(STEPS_AFTER_BLOW)
        } else {
            CALM_STEPS
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A load that lasts, or a blow, whose bodies hardly move against each other, with these sag shares.
    fn island(was_direct: bool, lasting: f32, blow: f32) -> LoadedIsland {
        let load = IslandLoad { lasting, still: lasting.max(blow), ..IslandLoad::default() };
        LoadedIsland {
            load,
            is_joined: false,
            counts_blows: true,
            was_direct,
            history: IslandHistory::default(),
        }
    }

    #[test]
    fn loads_ask_and_blows_of_small_islands() {
        assert!(
            island(false, 1.1 * DIRECT_SHARE, 0.0).asks(0) && !island(false, 0.9 * DIRECT_SHARE, 0.0).asks(0)
        );
        let blow = island(false, 0.0, 1.1 * DIRECT_SHARE);
        assert!(blow.asks(0) && !LoadedIsland { counts_blows: false, ..blow }.asks(0));
        let passing = IslandLoad { passing: 1.1 * DIRECT_SHARE, ..IslandLoad::default() };
        let passed = |is_joined| LoadedIsland { load: passing, is_joined, ..island(false, 0.0, 0.0) };
        assert!(passed(true).asks(0) && !passed(false).asks(0));
    }

    #[test]
    fn what_took_too_much_asks_again_only_if_much_would_sag_and_nothing_asks_in_a_cooldown() {
        let once = IslandHistory { times_dear: 1, ..IslandHistory::default() };
        let asks = |share: f32, history: IslandHistory, tick| {
            LoadedIsland { history, ..island(false, share, 0.0) }.asks(tick)
        };
        assert!(asks(1.1 * RETRY_SHARE, once, 0) && !asks(0.9 * RETRY_SHARE, once, 0));
        let cools = IslandHistory { cooldown_end: 7, ..IslandHistory::default() };
        assert!(!asks(1.0, cools, 6) && asks(1.0, cools, 7));
        let joined_by_one = LoadedIsland { history: cools, ..island(true, 1.0, 0.0) };
        assert!(
            joined_by_one.asks(6),
            "a body that cools down does not end the direct solve of what it falls on"
        );
    }

    #[test]
    fn a_direct_island_is_left_to_sweeps_when_its_calm_steps_are_over_and_a_blow_adds_a_few() {
        let with = |calm_steps_left: u8, lasting: f32, blow: f32| {
            let mut history = IslandHistory::default();
            history.direct.calm_steps_left = calm_steps_left;
            LoadedIsland { history, ..island(true, lasting, blow) }
        };
        let (calm, great) = (0.9 * GREAT_SHARE, 1.1 * GREAT_SHARE);
        assert!(with(1, calm, 0.0).asks(0) && !with(0, calm, 0.0).asks(0) && with(0, great, 0.0).asks(0));
        assert_eq!(with(9, calm, 0.0).calm_steps_left(), 8);
        assert_eq!(with(9, great, 0.0).calm_steps_left(), CALM_STEPS);
        assert_eq!([1, 9].map(|left| with(left, 0.0, great).calm_steps_left()), [STEPS_AFTER_BLOW, 9]);
    }
}
