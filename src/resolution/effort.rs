//! How hard the solver works on each island: as hard as the load of its contacts asks, and no harder.
//!
//! What sweeps leave wrong at rest is known beforehand: a contact sags under an impulse λ to where the bias makes up
//! for the compliance, which is 14 % of k λ (see [`softness`](super::softness)). Where that is more than an eightieth
//! of the thinner body, in a contact whose bodies hardly move against each other, for a few steps, the island is solved
//! directly, if that is little work; where it is too much work, and many contacts would be crushed whole, the island
//! gets 2, 4 or 8 times as many substeps. Where the direct solve has not solved a small island, that gets 8 times as many
//! until the next try; a larger one that lies still is not tried again. All of this ends when the load does. Only the
//! state decides, never a clock: a clone works as hard as its original.
//!
//! A heap of great weight that begins at rest is solved directly from its first step on: its loads have yet to build up,
//! and it would fall meanwhile.
//!
//! Islands without such a contact are never looked at. The others are found by walking over their contacts; the
//! bodies of islands with the same effort have neighbouring rows, and colours of the constraint graph of their own.

mod history;

use core::ops::Range;

use crate::body::{Bodies, Effort, NONE};
use crate::collision::{Contact, Contacts};
use crate::resolution::constraint_graph::ConstraintGraph;
use crate::resolution::effort::history::{History, RETRY_STEPS};
use crate::resolution::load::{
    CALM_SHARE, DIRECT_SHARE, LASTING_STEPS, Load, Loads, USUAL_RATE, begins_at_rest,
};
use crate::resolution::softness::sag;
use crate::store::BitSet;

/// Contacts under lasting load are looked at every so many steps: a heap has many, and is left alone for most of the time.
const LOOK_STEPS: u64 = 4;

/// An island that is too large for its load is left alone for so many steps.
const QUIET_STEPS: u64 = 120;

/// More substeps are for an island of which more than this share of the contacts asks for them, no unit: a few light
/// bodies in a heap of heavy ones are not worth the time of all.
const ASKING_SHARE: f32 = 0.05;

/// So many steps in a row must do with less effort before it is taken back.
const CALM_STEPS: u8 = 30;

/// An island that the direct solve has not solved gets more substeps where a contact would sag by more than this share of
/// the width of the thinner body, no unit, ...
const UNSOLVED_SHARE: f32 = 0.05;

/// ... if it has no more bodies than this: those of many take more time than they are worth.
const LARGEST_UNSOLVED_ISLAND: usize = 32;

/// A heap lies still where nothing is faster than this, m/s.
const STILL_SPEED: f32 = 1e-3;

/// Islands of more bodies are not solved directly.
const LARGEST_DIRECT_ISLAND: usize = 256;

/// Nor those whose factorization takes more multiplications.
const LARGEST_FACTORIZATION: u64 = 100_000;

/// A body that touches more others is a hub: a plate on many balls.
const HUB_NEIGHBOURS: usize = 12;

/// What an island may be given.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Allowance {
    /// Whether islands may be given more than others at all.
    pub(crate) adapts: bool,
    /// Whether they may be solved directly: not by schemes that solve velocities once per substep.
    pub(crate) direct: bool,
    /// One over the length of a substep of plain effort, 1/s.
    pub(crate) per_substep: f32,
    /// What all bodies are accelerated by, m/s².
    pub(crate) acceleration: f32,
}

impl Allowance {
    /// The overlap that sweeps would leave in the end in a contact under the weight of `mass`, kg, whose k is `k`, 1/kg,
    /// m.
    fn sag_under(&self, mass: f32, k: f32) -> f32 {
        let rate = self.per_substep.min(USUAL_RATE);
        sag(k * mass * self.acceleration / rate, rate)
    }
}

/// Whether an island may be solved directly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Directness {
    Possible,
    /// Not now, as it was not solved so before.
    Failed,
    /// It is too much work, or left alone, or the scheme has no direct solve.
    RuledOut,
}

/// What is enough for an island under this load that `has` an effort so far.
fn wanted(load: Load, has: Effort, directness: Directness) -> Effort {
    let direct_share = if has == Effort::Direct { CALM_SHARE * DIRECT_SHARE } else { DIRECT_SHARE };
    match directness {
        Directness::Possible if load.largest > direct_share => return Effort::Direct,
        Directness::Failed if load.largest > UNSOLVED_SHARE => return Effort::Eightfold,
        _ => {}
    }
    let more = [Effort::Double, Effort::Fourfold, Effort::Eightfold];
    let asks = |(_, asking): &(Effort, f32)| *asking > ASKING_SHARE * load.contacts;
    more.into_iter().zip(load.asking).take_while(asks).last().map_or(Effort::Plain, |(effort, _)| effort)
}

/// Islands that are solved together.
#[derive(Clone, Debug)]
pub(crate) struct EffortClass<'a> {
    pub(crate) effort: Effort,
    /// Rows of their bodies; with plain effort, of kinematic bodies too.
    pub(crate) rows: Range<usize>,
    /// Rows of the kinematic bodies that they touch, with their effort; none with plain effort.
    pub(crate) kinematic: &'a [(Effort, u32)],
    /// The islands that are to be solved directly, one after the other: slots of their bodies, in the order of the
    /// matrix.
    pub(crate) direct: &'a [u32],
    /// Where each of them ends.
    pub(crate) direct_ends: &'a [usize],
}

/// The islands that get more than plain effort.
#[derive(Clone, Debug, Default)]
pub(crate) struct Efforts {
    /// See [`EffortClass`].
    direct: Vec<u32>,
    direct_ends: Vec<usize>,
    kinematic: Vec<(Effort, u32)>,
    most_substeps: u32,
    /// Scratch.
    island: Vec<u32>,
    found: Vec<u32>,
    hubs: Vec<u32>,
    to_move: Vec<u32>,
    seen: BitSet,
    begun: BitSet,
    ordered: BitSet,
    place_of_slot: Vec<u32>,
    first: Vec<u32>,
}

/// The tables that a change of effort changes.
#[derive(Debug)]
pub(crate) struct EffortTables<'a> {
    pub(crate) bodies: &'a mut Bodies,
    pub(crate) contacts: &'a mut Contacts,
    pub(crate) graph: &'a mut ConstraintGraph,
}

impl EffortTables<'_> {
    fn moves(&self, slot: u32) -> bool {
        self.bodies.is_dynamic(slot) && self.bodies.is_awake(slot)
    }

    /// The bodies of a contact that may have ended since it was told of.
    fn slots(&self, index: u32) -> [u32; 2] {
        self.contacts.get(index).map_or([NONE; 2], |contact| contact.slots)
    }

    /// Velocity that a unit of impulse through both centres gives the bodies of a contact, 1/kg.
    fn inverse_mass(&self, contact: &Contact) -> f32 {
        contact.slots.iter().map(|&slot| self.bodies.motions[slot as usize].inverse_mass).sum()
    }

    /// The contacts with points of the body in `slot`, and the bodies on their other side.
    fn neighbours(&self, slot: u32) -> impl Iterator<Item = (u32, u32)> {
        self.contacts
            .of_body(self.bodies, slot)
            .filter(|&index| self.contacts[index].graph_place.is_some())
            .map(move |index| (index, self.contacts[index].other(slot)))
    }
}

impl Efforts {
    /// Forgets the islands of the last step.
    pub(crate) fn clear(&mut self) {
        self.direct.clear();
        self.direct_ends.clear();
        self.kinematic.clear();
        self.most_substeps = 0;
    }

    /// Decides for the next step, from the contacts under lasting load that the last one found.
    pub(crate) fn decide(
        &mut self,
        tick: u64,
        allowance: Allowance,
        loads: &Loads,
        mut tables: EffortTables<'_>,
    ) {
        self.clear();
        self.most_substeps = 1;
        for &slot in &loads.unsolved {
            // It may have been removed since.
            if tables.bodies.records.at(slot).is_some() {
                tables.bodies.records[slot].leave_alone(tick);
            }
        }
        let has_work = !(loads.lasting.is_empty() && loads.begun_at_rest.is_empty());
        if !has_work && tables.bodies.raised_count() == 0 {
            return;
        }
        self.seen.clear();
        if allowance.adapts && allowance.direct && !loads.begun_at_rest.is_empty() {
            self.begun.clear();
            for &index in &loads.begun_at_rest {
                for slot in tables.slots(index) {
                    self.begin_island(slot, allowance, &mut tables);
                }
            }
        }
        let lasting = if tick.is_multiple_of(LOOK_STEPS) { &loads.lasting[..] } else { &[] };
        for &index in lasting {
            for slot in tables.slots(index) {
                self.decide_island(slot, (tick, allowance), &mut tables);
            }
        }
        if tables.bodies.raised_count() > 0 {
            for row in 1..tables.bodies.row_count() {
                let slot = tables.bodies.slot_of_row(row);
                if tables.bodies.records[slot].effort != Effort::Plain {
                    self.decide_island(slot, (tick, allowance), &mut tables);
                }
            }
            tables.bodies.sort_rows_by_effort();
        }
        for (_, slot) in &mut self.kinematic {
            *slot = tables.bodies.motions[*slot as usize].row;
        }
        self.kinematic.sort_unstable();
        self.kinematic.dedup();
    }

    /// The islands of an effort.
    pub(crate) fn class(&self, effort: Effort, bodies: &Bodies) -> EffortClass<'_> {
        let raised = bodies.raised_count();
        let rows = if raised == 0 {
            let all = 1..bodies.row_count();
            if effort == Effort::Plain { all } else { 0..0 }
        } else {
            let effort_of = |slot: &u32| bodies.records[*slot].effort;
            let slots = &bodies.awake;
            1 + slots.partition_point(|slot| effort_of(slot) < effort)
                ..1 + slots.partition_point(|slot| effort_of(slot) <= effort)
        };
        let before = self.kinematic.partition_point(|&(of, _)| of < effort);
        let after = self.kinematic.partition_point(|&(of, _)| of <= effort);
        let is_direct = effort == Effort::Direct;
        EffortClass {
            effort,
            rows,
            kinematic: if effort == Effort::Plain { &[] } else { &self.kinematic[before..after] },
            direct: if is_direct { &self.direct } else { &[] },
            direct_ends: if is_direct { &self.direct_ends } else { &[] },
        }
    }

    /// How many islands are solved directly.
    pub(crate) fn direct_count(&self) -> usize {
        self.direct_ends.len()
    }

    /// How many substeps the hardest island takes for one of the settings; 0 where nothing is solved.
    pub(crate) fn most_substeps(&self) -> u32 {
        self.most_substeps
    }

    /// Decides for the island of the body in `slot`, if that was not done yet.
    fn decide_island(
        &mut self,
        slot: u32,
        (tick, allowance): (u64, Allowance),
        tables: &mut EffortTables<'_>,
    ) {
        if slot == NONE || self.seen.contains(slot) || !tables.moves(slot) {
            return;
        }
        let record = &tables.bodies.records[slot];
        if record.effort == Effort::Plain && record.quiet_until > tick {
            return;
        }
        let mut load = Load::default();
        self.island.clear();
        flood(slot, &mut self.seen, &mut self.island, tables, |contact| load.add(contact));
        let history = History::of(&self.island, tables.bodies);
        let (has, calm) = (history.effort, history.calm_steps);
        let is_quiet =
            history.is_quiet(tick, load.is_recent) || self.is_better_left_alone(history, load, tables);
        let directness = self.directness(history, is_quiet, allowance, tables);
        let may_be_direct = directness == Directness::Possible;
        let wanted = if allowance.adapts { wanted(load, has, directness) } else { Effort::Plain };
        let can_go_on = allowance.adapts && (has != Effort::Direct || may_be_direct);
        let falls = wanted < has && can_go_on;
        let effort = if falls && calm < CALM_STEPS { has } else { wanted };
        self.give(effort, if falls { calm.saturating_add(1) } else { 0 }, tables);
        let has_outgrown = has == Effort::Direct && !may_be_direct && !is_quiet;
        let pause = if may_be_direct { RETRY_STEPS } else { QUIET_STEPS };
        let until = if history.quiet_until > tick { history.quiet_until } else { tick + pause };
        for &slot in &self.island {
            let record = &mut tables.bodies.records[slot];
            if has_outgrown {
                record.leave_alone(tick);
            } else if effort == Effort::Plain {
                record.quiet_until = until;
                if falls {
                    record.unsolved_times = 0;
                }
            }
        }
    }

    /// Whether a heap that lies still was not solved directly before: it would be lifted out of its sag, and fall back.
    fn is_better_left_alone(&self, history: History, load: Load, tables: &EffortTables<'_>) -> bool {
        let lies_still = |&slot: &u32| {
            tables.bodies.motions[slot as usize].top_speed(tables.bodies.state(slot)) < STILL_SPEED
        };
        history.unsolved_times > 0
            && history.effort != Effort::Direct
            && load.largest <= UNSOLVED_SHARE
            && self.island.len() > LARGEST_UNSOLVED_ISLAND
            && self.island.iter().all(lies_still)
    }

    /// Whether the island may be solved directly.
    fn directness(
        &mut self,
        history: History,
        is_quiet: bool,
        allowance: Allowance,
        tables: &EffortTables<'_>,
    ) -> Directness {
        let was_unsolved = history.unsolved_times > 0 && self.island.len() <= LARGEST_UNSOLVED_ISLAND;
        if !allowance.direct || (is_quiet && !was_unsolved) || !self.is_little_work(tables) {
            Directness::RuledOut
        } else if is_quiet {
            Directness::Failed
        } else {
            Directness::Possible
        }
    }

    /// Has the island of the body in `slot` solved directly from its first step on, if all of it begins at rest and some
    /// contact would sag too far if it bore all the weight: sweeps pass the weight on from row to row, and what is to
    /// stand would fall first.
    fn begin_island(&mut self, slot: u32, allowance: Allowance, tables: &mut EffortTables<'_>) {
        if slot == NONE || self.begun.contains(slot) || !tables.moves(slot) {
            return;
        }
        let (mut begins, mut softest) = (true, 0.0_f32);
        let look_at = |contact: &Contact| {
            begins &= begins_at_rest(contact, tables.bodies);
            softest = softest.max(tables.inverse_mass(contact) / contact.thickness);
        };
        self.island.clear();
        flood(slot, &mut self.begun, &mut self.island, tables, look_at);
        let mass =
            self.island.iter().map(|&slot| tables.bodies.motions[slot as usize].inverse_mass.recip()).sum();
        let may_sag = allowance.sag_under(mass, softest) > DIRECT_SHARE;
        if begins && may_sag && self.is_little_work(tables) {
            for &slot in &self.island {
                self.seen.insert(slot);
            }
            // Until it is known what the contacts bear, and no longer if that is little.
            self.give(Effort::Direct, CALM_STEPS - LASTING_STEPS - 1, tables);
        }
    }

    /// Gives the island an effort.
    fn give(&mut self, effort: Effort, calm_steps: u8, tables: &mut EffortTables<'_>) {
        let mut stays_plain = effort == Effort::Plain;
        for &slot in &self.island {
            stays_plain &= tables.bodies.records[slot].effort == Effort::Plain;
            tables.bodies.set_effort(slot, effort);
            tables.bodies.records[slot].calm_steps = calm_steps;
        }
        if stays_plain {
            return;
        }
        for &slot in &self.island {
            for (index, other) in tables.neighbours(slot) {
                self.to_move.push(index);
                if !tables.moves(other) && tables.bodies.is_awake(other) {
                    self.kinematic.push((effort, other));
                }
            }
        }
        for index in self.to_move.drain(..) {
            tables.graph.rehome(tables.contacts, tables.bodies, index);
        }
        self.most_substeps = self.most_substeps.max(effort.substep_factor());
        if effort == Effort::Direct {
            self.direct.extend(&self.island);
            self.direct_ends.push(self.direct.len());
        }
    }

    /// Brings the bodies of the island in an order in which neighbours are near each other: from a far end on, by
    /// distance. Those that touch many others come last, where they fill a row of the matrix and no more.
    fn order(&mut self, tables: &EffortTables<'_>) {
        std::mem::swap(&mut self.found, &mut self.island);
        self.island.clear();
        self.ordered.clear();
        let is_hub = |slot: u32| {
            tables.neighbours(slot).filter(|&(_, other)| tables.moves(other)).nth(HUB_NEIGHBOURS).is_some()
        };
        let hubs = self.found.iter().copied().filter(|&slot| is_hub(slot));
        self.hubs.clear();
        self.hubs.extend(hubs);
        for &slot in &self.hubs {
            self.ordered.insert(slot);
        }
        for &slot in self.found.iter().rev() {
            if !self.ordered.contains(slot) {
                flood(slot, &mut self.ordered, &mut self.island, tables, |_| ());
            }
        }
        self.island.reverse();
        self.island.extend(&self.hubs);
    }

    /// Whether the island is small enough to be solved directly.
    fn is_little_work(&mut self, tables: &EffortTables<'_>) -> bool {
        if self.island.len() > LARGEST_DIRECT_ISLAND {
            return false;
        }
        self.order(tables);
        self.place_of_slot.resize(tables.bodies.motions.len(), NONE);
        for (place, &slot) in (0_u32..).zip(&self.island) {
            self.place_of_slot[slot as usize] = place;
        }
        self.first.clear();
        let mut work = 0;
        for (place, &slot) in (0_u32..).zip(&self.island) {
            let neighbours = tables.neighbours(slot).filter(|&(_, other)| tables.moves(other));
            let first = neighbours.map(|(_, other)| self.place_of_slot[other as usize]).fold(place, u32::min);
            self.first.push(first);
            // Each entry of a row takes the common part of two rows, in blocks of 3 × 3.
            let common = |column: u32| u64::from(column - first.max(self.first[column as usize]) + 1);
            work += 27 * (first..=place).map(common).sum::<u64>();
        }
        work <= LARGEST_FACTORIZATION
    }
}

/// Adds the body in `slot` to the `island`, and all that contacts connect with it, nearest first; looks at every
/// contact.
fn flood(
    slot: u32,
    seen: &mut BitSet,
    island: &mut Vec<u32>,
    tables: &EffortTables<'_>,
    mut look_at: impl FnMut(&Contact),
) {
    let mut next = island.len();
    island.push(slot);
    seen.insert(slot);
    while let Some(&slot) = island.get(next) {
        next += 1;
        for (index, other) in tables.neighbours(slot) {
            look_at(&tables.contacts[index]);
            if tables.moves(other) && seen.insert(other) {
                island.push(other);
            }
        }
    }
}
