//! How hard the solver works on each island: as hard as the load of its contacts asks, and no harder.
//!
//! What sweeps leave wrong at rest is known beforehand: a contact sags under an impulse λ to where the bias makes up
//! for the leak, which is 14 % of k λ (see [`softness`](super::softness)). Where that is more than an eightieth
//! of the thinner body, in a contact whose bodies hardly move against each other, for a few steps, the island is solved
//! directly, if that is little work; where it is too much work, and many contacts would be crushed whole, the island
//! gets 2, 4 or 8 times as many substeps. Both end when the load does. Only the state decides, never a clock: a clone
//! works as hard as its original.
//!
//! Islands without such a contact are never looked at. The others are found by walking over their contacts; the
//! bodies of islands with the same effort have neighbouring rows, and colours of the constraint graph of their own.

use core::ops::Range;

use crate::body::{Bodies, Effort, NONE};
use crate::collision::{Contact, Contacts};
use crate::resolution::constraint_graph::ConstraintGraph;
use crate::resolution::softness::sag;
use crate::store::BitSet;

/// Overlap at rest, as a share of the width of the thinner body, from which an island is solved directly.
const DIRECT_SHARE: f32 = 0.0125;

/// The same from which an island gets more substeps: heaps of many bodies are no worse for less, and pay for more.
const SWEEP_SHARE: f32 = 1.0;

/// Substeps per second that sags are told for, if there are no fewer, 1/s.
const USUAL_RATE: f32 = 240.0;

/// A contact must be under such a load for so many steps: a blow is over sooner.
const LASTING_STEPS: u8 = 4;

/// An island that is too large for its load, or that the direct solve could not solve, is left alone for so many steps.
const QUIET_STEPS: u64 = 120;

/// More substeps are for an island of which more than this share of the contacts asks for them, no unit: a few light
/// bodies in a heap of heavy ones are not worth the time of all.
const ASKING_SHARE: f32 = 0.05;

/// So many steps in a row must do with less effort before it is taken back.
const CALM_STEPS: u8 = 30;

/// Less effort is enough only when the load is below this share of what asked for more, so that it does not go to
/// and fro.
const CALM_SHARE: f32 = 0.7;

/// Islands of more bodies are not solved directly.
const LARGEST_DIRECT_ISLAND: usize = 256;

/// Nor those whose factorization takes more multiplications.
const LARGEST_FACTORIZATION: u64 = 100_000;

/// What an island may be given.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Allowance {
    /// Whether islands may be given more than others at all.
    pub(crate) adapts: bool,
    /// Whether they may be solved directly: not by schemes that solve velocities once per substep.
    pub(crate) direct: bool,
}

/// The contacts under lasting load, found at the end of a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Loads {
    /// One over the length of the substep that sags are told for, 1/s, and how many of those of now it takes; 0 where
    /// nothing adapts.
    per_substep: f32,
    factor: f32,
    /// Indices of the contacts.
    pub(crate) lasting: Vec<u32>,
    /// Slots of the bodies of islands that the direct solve could not solve.
    pub(crate) unsolved: Vec<u32>,
}

impl Loads {
    /// Begins a step.
    pub(crate) fn clear(&mut self) {
        self.lasting.clear();
        self.unsolved.clear();
    }

    /// Begins with the contacts of an effort, that are solved in substeps of length 1/`per_substep`. More substeps than
    /// usual do not make an island less worth its effort: they are asked for to have less error.
    pub(crate) fn begin(&mut self, adapts: bool, effort: Effort, per_substep: f32) {
        self.per_substep = (per_substep / effort.substep_factor() as f32).min(USUAL_RATE);
        self.factor = if adapts { per_substep / self.per_substep } else { 0.0 };
    }

    /// How the contacts of an effort are measured.
    pub(crate) fn measure(&self) -> LoadMeasure {
        LoadMeasure { per_substep: self.per_substep, factor: self.factor }
    }
}

/// How loads are told.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoadMeasure {
    per_substep: f32,
    factor: f32,
}

impl LoadMeasure {
    /// Takes note of the load of a contact, whose greatest k λ is `speed`, m/s. Returns whether it lasts.
    #[inline(always)]
    pub(crate) fn is_lasting(self, contact: &mut Contact, speed: f32) -> bool {
        let sag = sag(self.factor * speed, self.per_substep);
        if !contact.is_kept || sag <= CALM_SHARE * DIRECT_SHARE * contact.thickness {
            contact.loaded_steps = 0;
            return false;
        }
        contact.loaded_steps = contact.loaded_steps.saturating_add(1);
        contact.sag = sag / contact.thickness;
        contact.loaded_steps >= LASTING_STEPS
    }
}

/// The load of the contacts of an island.
#[derive(Clone, Copy, Debug, Default)]
struct Load {
    /// Largest sag, as a share of the thickness.
    largest: f32,
    /// How many contacts there are, and how many sag by 1, 2 and 4 times `SWEEP_SHARE`.
    contacts: f32,
    asking: [f32; 3],
}

impl Load {
    fn add(&mut self, contact: &Contact) {
        self.contacts += 1.0;
        if contact.loaded_steps >= LASTING_STEPS {
            self.largest = self.largest.max(contact.sag);
            for (asking, times) in self.asking.iter_mut().zip([1.0, 2.0, 4.0]) {
                *asking += f32::from(u8::from(contact.sag > times * SWEEP_SHARE));
            }
        }
    }
}

/// What is enough for an island under this load that `has` an effort so far.
fn wanted(load: Load, has: Effort, may_be_direct: bool) -> Effort {
    let direct_share = if has == Effort::Direct { CALM_SHARE * DIRECT_SHARE } else { DIRECT_SHARE };
    if may_be_direct && load.largest > direct_share {
        return Effort::Direct;
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
    to_move: Vec<u32>,
    seen: BitSet,
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
                tables.bodies.records[slot].quiet_until = tick + QUIET_STEPS;
            }
        }
        if loads.lasting.is_empty() && tables.bodies.raised_count() == 0 {
            return;
        }
        self.seen.clear();
        for &index in &loads.lasting {
            // It may have ended since.
            for slot in tables.contacts.get(index).map_or([NONE; 2], |contact| contact.slots) {
                self.decide_island(slot, (tick, allowance), &mut tables);
            }
        }
        for row in 1..tables.bodies.states.len() {
            let slot = tables.bodies.slot_of_row[row];
            if tables.bodies.records[slot].effort != Effort::Plain {
                self.decide_island(slot, (tick, allowance), &mut tables);
            }
        }
        tables.bodies.sort_rows_by_effort();
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
            let all = 1..bodies.states.len();
            if effort == Effort::Plain { all } else { 0..0 }
        } else {
            let effort_of = |slot: &u32| bodies.records[*slot].effort;
            let slots = &bodies.slot_of_row[1..];
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
        let load = self.walk(slot, tables);
        let has = self.island.iter().map(|&slot| tables.bodies.records[slot].effort).max();
        let has = has.unwrap_or_default();
        let record_of = |&slot: &u32| &tables.bodies.records[slot];
        let calm = self.island.iter().map(|slot| record_of(slot).calm_steps).min().unwrap_or_default();
        let is_quiet = self.island.iter().any(|slot| record_of(slot).quiet_until > tick);
        let may_be_direct = allowance.direct && !is_quiet && self.is_little_work(tables);
        let wanted = if allowance.adapts { wanted(load, has, may_be_direct) } else { Effort::Plain };
        let can_go_on = allowance.adapts && (has != Effort::Direct || may_be_direct);
        let falls = wanted < has && can_go_on;
        let effort = if falls && calm < CALM_STEPS { has } else { wanted };
        let calm = if falls { calm.saturating_add(1) } else { 0 };
        for &slot in &self.island {
            tables.bodies.set_effort(slot, effort);
            let record = &mut tables.bodies.records[slot];
            record.calm_steps = calm;
            if effort == Effort::Plain {
                record.quiet_until = tick + QUIET_STEPS;
            }
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

    /// Walks over the island of the body in `slot`; returns the load of its contacts. Leaves the bodies in an order in
    /// which neighbours are near each other: from a far end on, by distance.
    fn walk(&mut self, slot: u32, tables: &EffortTables<'_>) -> Load {
        let mut load = Load::default();
        flood(slot, &mut self.seen, &mut self.island, tables, |contact| load.add(contact));
        if self.island.len() <= LARGEST_DIRECT_ISLAND {
            let end = self.island[self.island.len() - 1];
            self.ordered.clear();
            flood(end, &mut self.ordered, &mut self.island, tables, |_| ());
            self.island.reverse();
        }
        load
    }

    /// Whether the island is small enough to be solved directly.
    fn is_little_work(&mut self, tables: &EffortTables<'_>) -> bool {
        if self.island.len() > LARGEST_DIRECT_ISLAND {
            return false;
        }
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

/// Fills `island` with the body in `slot` and all that contacts connect with it, nearest first; looks at every
/// contact.
fn flood(
    slot: u32,
    seen: &mut BitSet,
    island: &mut Vec<u32>,
    tables: &EffortTables<'_>,
    mut look_at: impl FnMut(&Contact),
) {
    island.clear();
    island.push(slot);
    seen.insert(slot);
    let mut next = 0;
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
