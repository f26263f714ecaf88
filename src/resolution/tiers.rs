//! Which islands are solved directly, and which by sweeps: sweeps are enough for nearly all. Decided at the start of each step, from what the
//! last one noted of loads, see [`load`](super::load), which says what a load is that lasts, or is a blow.
//!
//! What sweeps leave wrong at rest is known beforehand: under a load that is new to it a contact sags to where its bias makes up for what it
//! yields in half a substep, see [`sag`](super::softness::sag). Where that is more than [`DIRECT_SHARE`] of the width
//! of the thinner body, in a contact whose bodies hardly move against each other, for a few steps, the island is solved
//! directly, if that is little work. In a small island one step is enough: that is a blow.
//!
//! The island goes back to sweeps
//! - when its load has been small for [`CALM_STEPS`](super::load::CALM_STEPS) steps in a row, or [`STEPS_AFTER_BLOW`] where no load lasted, and
//!   nothing presses its bodies into each other;
//! - when it has been [squeezed](super::squeezes) for [`LASTING_STEPS`];
//! - at once when the direct solve has taken more than it is worth, as in heaps in which contacts come and go, or would be too much work. It is
//!   always worth it in a small island that no kinematic body drives.
//!
//! Then it has a cooldown, in which it is not looked at, but a small one can be struck at any time. What took too much is tried again only if much
//! would sag, after longer each time, and is given up in the end.
//!
//! A heap of great weight that begins at rest is solved directly from its first step on: its loads have yet to build up,
//! and it would fall meanwhile.
//!
//! Only the state decides, never wall time: a clone is solved as its original. Swept islands in which no load lasts, and none is a
//! blow to a small one, are never looked at.

mod history;
mod loaded_island;
mod tables;

pub(crate) use tables::TierTables;

use crate::body::NONE;
use crate::collision::Contact;
use crate::resolution::direct::work_of_factorization;
use crate::resolution::islands::{Islands, find_island};
use crate::resolution::load::{ContactLoad, DIRECT_SHARE, IslandLoad, LASTING_STEPS, Loads, begins_at_rest};
use crate::resolution::squeezes::is_squeezed;
use crate::resolution::tier::Tier;
use crate::resolution::tier_rule::TierRule;
use crate::resolution::tiers::history::{History, IslandHistory, MOST_OVERSPENT, RETRY_STEPS};
use crate::resolution::tiers::loaded_island::{LoadedIsland, STEPS_AFTER_BLOW};
use crate::store::BitSet;

/// Islands whose factorization takes more multiplications than this are not solved directly: a step of the world would be
/// seen to take long.
const LARGEST_FACTORIZATION: u64 = 100_000;

/// Nor those of more bodies, which are not even ordered for it: heaps of so many take more multiplications. Towers of so many would take
/// fewer.
const LARGEST_DIRECT_ISLAND: usize = 256;

/// Nor those of more bodies that are joined, which take their time in turn with their joints. With two dozen, heaps of ragdolls, which go to and
/// fro between both tiers, come to rest later: one of six moves after ten seconds. With four, a car with a stone under each wheel is swept.
const MOST_DIRECT_JOINED: usize = 8;

/// An island of no more bodies is small: it is solved directly also in the steps after a blow. Swept, what is struck is pressed in, and throws
/// back what strikes it: at an eighth of its speed where masses are equal, at half where they are 10 : 1. Larger islands are struck all
/// the time: with sixteen, a step of boxes on lifts takes twice as long.
const SMALL_ISLAND: usize = 4;

/// The same where any of them are joined, also for blows between bodies that pass each other.
const SMALL_JOINED_ISLAND: usize = MOST_DIRECT_JOINED;

/// The cooldown of an island that asks for the direct solve, but does not suit it: it is too much work, or squeezed. To find it every ten steps, and to order it, takes 7 % of
/// the step of a drum; a heap that comes apart waits for no longer than two seconds.
const UNSUITED_STEPS: u64 = 120;

/// A body that touches more others is a hub: ordered as any other, a plate on 200 balls takes 1.5 times as long.
const HUB_NEIGHBOURS: usize = 12;

/// Chooses the tier of each island.
#[derive(Debug, Default)]
pub(crate) struct Tiers {
    /// The islands that are solved directly, their bodies in the order of the matrix.
    pub(crate) direct: Islands,
    /// By slot; shorter where no island of later slots was ever looked at.
    histories: Vec<History>,
    /// Scratch.
    island: Vec<u32>,
    found: Vec<u32>,
    hubs: Vec<u32>,
    to_move: Vec<u32>,
    /// Bodies whose island was decided for in this step.
    seen: BitSet,
    /// Bodies that were found to be in an island that is not small.
    large: BitSet,
    /// Bodies of the islands that may begin at rest.
    begun: BitSet,
    ordered: BitSet,
    /// By slot, the row of the matrix.
    place_of_slot: Vec<u32>,
    /// By row of the matrix, its first column.
    first: Vec<u32>,
}

clone_into_buffers!(Tiers {
    direct, histories
} scratch {
    island, found, hubs, to_move, seen, large, begun, ordered, place_of_slot, first
});

impl Tiers {
    /// Nothing is solved.
    pub(crate) fn clear(&mut self) {
        self.direct.clear();
    }

    /// Gives up what is not needed for so many slots, and scratch.
    pub(crate) fn trim(&mut self, slots: usize) {
        let Self { direct, mut histories, .. } = core::mem::take(self);
        histories.truncate(slots);
        *self = Self { direct, histories, ..Self::default() };
    }

    /// Whether the body in `slot`, at rest in an island of this tier, will be moved by a change of it after `tick`.
    pub(crate) fn is_to_change(&self, slot: u32, tick: u64, tier: Tier) -> bool {
        self.histories.get(slot as usize).is_some_and(|history| history.is_to_change(tick, tier))
    }

    /// Forgets what the body that had a slot has been through.
    pub(crate) fn forget(&mut self, slot: u32) {
        if let Some(history) = self.histories.get_mut(slot as usize) {
            *history = History::default();
        }
    }

    /// Decides for the next step, from what the last one noted.
    pub(crate) fn decide(
        &mut self,
        tick: u64,
        rule: TierRule<'_>,
        loads: &Loads,
        mut tables: TierTables<'_>,
    ) {
        self.direct.clear();
        for outcome in &loads.outcomes {
            self.histories[outcome.slot as usize].take_note(outcome);
        }
        let has_work = !(loads.notable.is_empty() && loads.begun_at_rest.is_empty());
        if !has_work && !tables.graph.solves_directly() {
            return;
        }
        self.histories.resize(tables.bodies.motions.len(), History::default());
        self.seen.clear();
        self.large.clear();
        if rule.adapts && !loads.begun_at_rest.is_empty() {
            self.begun.clear();
            for &index in &loads.begun_at_rest {
                for slot in tables.slots(index) {
                    self.begin_island(slot, rule, &mut tables);
                }
            }
        }
        for &index in &loads.notable {
            let load = loads.of_contact[index as usize];
            if !load.lasts_or_is_blow() {
                continue;
            }
            for slot in tables.slots(index) {
                if load.lasts() || self.may_blow_count(slot, load, &tables) {
                    self.decide_island(slot, tick, rule, loads, &mut tables);
                }
            }
        }
        if tables.graph.solves_directly() {
            for row in 1..tables.bodies.row_count() {
                let slot = tables.bodies.slot_of_row(row);
                if tables.graph.is_direct(slot) {
                    self.decide_island(slot, tick, rule, loads, &mut tables);
                }
            }
        }
    }

    /// Whether a blow to the body in `slot` may be a reason to solve its island directly. [`Self::decide_island`] has the last word: only there it is
    /// known whether a kinematic body drives the island.
    fn may_blow_count(&mut self, slot: u32, blow: ContactLoad, tables: &TierTables<'_>) -> bool {
        !self.seen.contains(slot)
            && small_island(slot, tables, &mut self.large)
                .is_some_and(|is_joined| is_joined || !blow.is_passing())
    }

    /// Decides for the island of the body in `slot`, if that was not done yet.
    fn decide_island(
        &mut self,
        slot: u32,
        tick: u64,
        rule: TierRule<'_>,
        loads: &Loads,
        tables: &mut TierTables<'_>,
    ) {
        let is_left_alone =
            !tables.graph.is_direct(slot) && self.histories[slot as usize].cooldown_end > tick;
        if self.seen.contains(slot) || is_left_alone {
            return;
        }
        let island = self.look_at_island(slot, tick, loads, tables);
        let history = &island.history;
        if !rule.adapts || !island.asks(tick) {
            // The next blow may come at any time, and few bodies are soon looked at.
            let steps = if island.counts_blows { 0 } else { RETRY_STEPS };
            self.sweep(history.cooldown_end.max(tick + steps), tables);
            if island.is_calm() {
                self.change_histories(|of_body| of_body.times_dear = 0);
            }
            return;
        }
        let overspent = island.overspent();
        if overspent > MOST_OVERSPENT {
            self.set_tier(Tier::Swept, tables);
            self.change_histories(|of_body| of_body.leave_alone(tick));
            return;
        }
        let (bodies, connections) = (tables.bodies, tables.connections());
        let is_squeezed =
            island.load.lasting > 0.0 && is_squeezed(&self.island, island.load, bodies, connections, rule);
        let squeezed_steps = if is_squeezed { history.direct.squeezed_steps + 1 } else { 0 };
        // What is solved directly may look squeezed in the moment of a blow.
        let stays_squeezed = is_squeezed && (!island.was_direct || squeezed_steps >= LASTING_STEPS);
        if stays_squeezed || !self.order_if_little_work(tables) {
            self.sweep(tick + UNSUITED_STEPS, tables);
            return;
        }
        self.solve_directly([island.calm_steps_left(), squeezed_steps], overspent, tables);
    }

    /// Finds the island of the body in `slot`, and what it bears and has been through.
    fn look_at_island(
        &mut self,
        slot: u32,
        tick: u64,
        loads: &Loads,
        tables: &TierTables<'_>,
    ) -> LoadedIsland {
        let (mut load, mut is_driven, bodies) = (IslandLoad::default(), false, tables.bodies);
        let drives = |slot| !bodies.is_dynamic(slot) && bodies.state(slot).is_moving();
        let look_at = |index: u32, contact: &Contact| {
            load.add(loads.of_contact[index as usize]);
            is_driven |= contact.slots.into_iter().any(drives);
        };
        self.island.clear();
        find_island(slot, bodies, tables.connections(), &mut self.seen, &mut self.island, look_at);
        let is_joined = tables.is_joined(&self.island);
        let direct_count = self.island.iter().filter(|&&slot| tables.graph.is_direct(slot)).count();
        LoadedIsland {
            load,
            is_joined,
            counts_blows: !is_driven && self.island.len() <= most_in_small_island(is_joined),
            was_direct: 2 * direct_count >= self.island.len(),
            history: self.history(tick, tables),
        }
    }

    /// What the island has been through, but for what was long ago.
    fn history(&mut self, tick: u64, tables: &TierTables<'_>) -> IslandHistory {
        IslandHistory::of_bodies(self.island.iter().map(|&slot| {
            let history = &mut self.histories[slot as usize];
            history.forget_what_was_long_before(tick);
            (*history, tables.graph.tier(slot))
        }))
    }

    /// Has the island of the body in `slot` solved directly from its first step on, if all of it begins at rest and some
    /// contact would sag too far if it bore all the weight: sweeps pass the weight on from row to row, and what is to
    /// stand would fall first.
    fn begin_island(&mut self, slot: u32, rule: TierRule<'_>, tables: &mut TierTables<'_>) {
        if self.begun.contains(slot) {
            return;
        }
        let (mut begins, mut softest) = (true, 0.0_f32);
        self.island.clear();
        find_island(
            slot,
            tables.bodies,
            tables.connections(),
            &mut self.begun,
            &mut self.island,
            |_, contact| {
                begins &= begins_at_rest(contact, tables.bodies);
                softest = softest.max(tables.inverse_mass(contact) / contact.thickness);
            },
        );
        let may_sag = rule.sag_share_under(rule.weight(&self.island), softest) > DIRECT_SHARE;
        if begins && may_sag && self.order_if_little_work(tables) {
            for &slot in &self.island {
                self.seen.insert(slot);
            }
            self.solve_directly([STEPS_AFTER_BLOW, 0], 0.0, tables);
        }
    }

    /// Has the island solved directly, its bodies in the order of the matrix.
    fn solve_directly(
        &mut self,
        [calm_steps_left, squeezed_steps]: [u8; 2],
        overspent: f32,
        tables: &mut TierTables<'_>,
    ) {
        self.change_histories(|History { direct, .. }| {
            direct.calm_steps_left = calm_steps_left;
            direct.squeezed_steps = squeezed_steps;
            direct.overspent = overspent;
        });
        self.set_tier(Tier::Direct, tables);
        self.direct.push(&self.island);
    }

    /// Has the island swept, and not looked at until its cooldown ends.
    fn sweep(&mut self, cooldown_end: u64, tables: &mut TierTables<'_>) {
        self.set_tier(Tier::Swept, tables);
        self.change_histories(|of_body| of_body.cooldown_end = cooldown_end);
    }

    /// Changes what the bodies of the island have been through.
    fn change_histories(&mut self, change: impl Fn(&mut History)) {
        for &slot in &self.island {
            change(&mut self.histories[slot as usize]);
        }
    }

    /// Gives the bodies of the island a tier, and their contacts a new home in the graph.
    fn set_tier(&mut self, tier: Tier, tables: &mut TierTables<'_>) {
        for &slot in &self.island {
            if tables.graph.set_tier(slot, tier) {
                self.to_move.extend(tables.contacts.of_body(tables.bodies, slot));
            }
        }
        for index in self.to_move.drain(..) {
            tables.graph.rehome(tables.contacts, tables.bodies, index);
        }
    }

    /// Brings the bodies of the island in an order in which neighbours are near each other: from a far end on, by
    /// distance. Those that touch many others come last, where they fill a row of the matrix and no more.
    fn order(&mut self, tables: &TierTables<'_>) {
        std::mem::swap(&mut self.found, &mut self.island);
        self.island.clear();
        self.ordered.clear();
        let is_hub = |&slot: &u32| tables.neighbours(slot).nth(HUB_NEIGHBOURS).is_some();
        self.hubs.clear();
        self.hubs.extend(self.found.iter().copied().filter(is_hub));
        for &slot in &self.hubs {
            self.ordered.insert(slot);
        }
        for &slot in self.found.iter().rev() {
            if !self.ordered.contains(slot) {
                let (seen, island) = (&mut self.ordered, &mut self.island);
                find_island(slot, tables.bodies, tables.connections(), seen, island, |_, _| ());
            }
        }
        self.island.reverse();
        self.island.extend(&self.hubs);
    }

    /// Brings the island in the order of the matrix, and returns whether it is little enough work to solve it directly. What has too many bodies
    /// is not even ordered.
    fn order_if_little_work(&mut self, tables: &TierTables<'_>) -> bool {
        let joined = self.island.iter().filter(|&&slot| tables.joints.hold(slot)).count();
        if self.island.len() > LARGEST_DIRECT_ISLAND || joined > MOST_DIRECT_JOINED {
            return false;
        }
        self.order(tables);
        self.place_of_slot.resize(tables.bodies.motions.len(), NONE);
        for (place, &slot) in (0_u32..).zip(&self.island) {
            self.place_of_slot[slot as usize] = place;
        }
        self.first.clear();
        for (place, &slot) in (0_u32..).zip(&self.island) {
            let neighbours = tables.neighbours(slot);
            let first = neighbours.map(|other| self.place_of_slot[other as usize]).fold(place, u32::min);
            self.first.push(first);
        }
        work_of_factorization(&self.first) <= LARGEST_FACTORIZATION
    }
}

/// The most bodies of a small island.
fn most_in_small_island(is_joined: bool) -> usize {
    if is_joined { SMALL_JOINED_ISLAND } else { SMALL_ISLAND }
}

/// Whether any body is joined in the island of the body in a slot; none if the island is not small. The bodies that it finds to be in a large
/// one are added to `large`, so that each of a heap is not looked for again from each of its contacts.
fn small_island(slot: u32, tables: &TierTables<'_>, large: &mut BitSet) -> Option<bool> {
    let mut island = [slot; SMALL_JOINED_ISLAND];
    let (mut len, mut next, mut is_large) = (1, 0, large.contains(slot));
    while next < len && !is_large {
        for other in tables.neighbours(island[next]) {
            if !island[..len].contains(&other) {
                is_large |= len == island.len() || large.contains(other);
                if is_large {
                    break;
                }
                island[len] = other;
                len += 1;
            }
        }
        next += 1;
    }
    let is_joined = tables.is_joined(&island[..len]);
    let is_small = !is_large && len <= most_in_small_island(is_joined);
    if !is_small {
        for &slot in &island[..len] {
            large.insert(slot);
        }
    }
    is_small.then_some(is_joined)
}
