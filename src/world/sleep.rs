//! Sleep: islands at rest are taken out of the step until something wakes them.
//!
//! An island sleeps when every body in it has been nearly at rest for a while. Its bodies lose their rows,
//! its contacts leave the constraint graph and keep manifold and impulses, so that the island wakes as it
//! fell asleep.

use crate::body::{Bodies, NONE};
use crate::collision::Contacts;
use crate::resolution::{ConstraintGraph, Islands, find_island};
use crate::store::{BitSet, Slots};

/// Below this speed of any of its points a body counts as nearly at rest, m/s: a pixel per second or two.
pub(crate) const REST_SPEED: f32 = 0.05;

/// An island sleeps after this time of rest, s: long enough for a tower at its tipping point to show it.
pub(crate) const TIME_TO_SLEEP: f32 = 0.5;

/// Islands at rest are looked for so many times a second: to look for them in each step takes a tenth of the time of a
/// heap in which a single body cannot come to rest.
const LOOKS_PER_SECOND: f32 = 8.0;

/// Whether islands at rest are looked for in this tick of a world.
pub(crate) fn is_due(tick: u64, tick_rate: f32) -> bool {
    tick.is_multiple_of((tick_rate / LOOKS_PER_SECOND).max(1.0) as u64)
}

/// Whether the body in `slot` has been nearly at rest for long enough.
fn is_still(bodies: &Bodies, slot: u32) -> bool {
    bodies.motions[slot as usize].still_time >= TIME_TO_SLEEP
}

/// Sleeping islands, each the slots of its bodies.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sleepers {
    groups: Slots<Vec<u32>>,
    /// Scratch: slots of the bodies whose islands have been found, one of these, and those at rest.
    seen: BitSet,
    island: Vec<u32>,
    resting: Islands,
}

/// The tables that putting to sleep and waking change.
#[derive(Debug)]
pub(crate) struct SleepTables<'a> {
    pub(crate) bodies: &'a mut Bodies,
    pub(crate) contacts: &'a mut Contacts,
    pub(crate) graph: &'a mut ConstraintGraph,
}

impl Sleepers {
    /// How many islands sleep.
    pub(crate) fn len(&self) -> usize {
        self.groups.len()
    }

    /// Gives up places of islands that woke, and scratch.
    pub(crate) fn trim(&mut self) {
        let mut groups = std::mem::take(&mut self.groups);
        groups.trim();
        *self = Self { groups, ..Self::default() };
    }

    /// Puts every island to sleep whose bodies have all been at rest for long enough.
    pub(crate) fn put_to_sleep(&mut self, tables: &mut SleepTables<'_>) {
        self.seen.clear();
        self.resting.clear();
        for row in 1..tables.bodies.row_count() {
            let slot = tables.bodies.slot_of_row(row);
            let is_candidate = tables.bodies.is_dynamic(slot) && is_still(tables.bodies, slot);
            if is_candidate && !self.seen.contains(slot) {
                self.look_at_island(slot, tables);
            }
        }
        let resting = std::mem::take(&mut self.resting);
        for island in resting.iter() {
            self.lay_down(tables, island.to_vec());
        }
        self.resting = resting;
    }

    /// Finds the island of the body in `slot`, and whether it is at rest, and so is what it touches.
    fn look_at_island(&mut self, slot: u32, tables: &SleepTables<'_>) {
        let bodies = &*tables.bodies;
        let mut rests = true;
        self.island.clear();
        find_island(slot, bodies, tables.contacts, &mut self.seen, &mut self.island, |_, contact| {
            // What a moving kinematic body touches stays awake.
            let moves = |&slot: &u32| bodies.is_awake(slot) && !is_still(bodies, slot);
            rests &= !contact.slots.iter().any(moves);
        });
        if rests {
            self.island.sort_unstable();
            self.resting.push(&self.island);
        }
    }

    /// Puts the bodies in `slots` to sleep as one group.
    fn lay_down(&mut self, tables: &mut SleepTables<'_>, slots: Vec<u32>) {
        for &slot in &slots {
            tables.bodies.take_row(slot);
        }
        for &slot in &slots {
            let of_body: Vec<u32> = tables.contacts.of_body(tables.bodies, slot).collect();
            for index in of_body {
                tables.graph.leave(tables.contacts, index);
                let other = tables.contacts[index].other(slot);
                if !tables.bodies.is_awake(other) {
                    tables.contacts.set_asleep(index);
                }
            }
        }
        let key = self.groups.insert(slots);
        for &slot in &self.groups[key.index()] {
            tables.bodies.records[slot].sleep_group = key.index();
        }
    }

    /// Wakes the body in `slot` and its whole island, if it sleeps.
    pub(crate) fn wake(&mut self, tables: &mut SleepTables<'_>, slot: u32) {
        tables.bodies.motions[slot as usize].still_time = 0.0;
        let group = tables.bodies.records[slot].sleep_group;
        if group == NONE {
            return;
        }
        let slots = self.groups.remove(self.groups.key_at(group)).unwrap_or_default();
        for &slot in &slots {
            tables.bodies.give_row(slot);
            tables.bodies.motions[slot as usize].still_time = 0.0;
            tables.bodies.records[slot].sleep_group = NONE;
        }
        for &slot in &slots {
            let of_body: Vec<u32> = tables.contacts.of_body(tables.bodies, slot).collect();
            for index in of_body {
                tables.contacts.set_awake(index);
                if tables.contacts[index].manifold.points().is_empty() {
                    continue;
                }
                let other = tables.contacts[index].other(slot);
                let other_group = tables.bodies.records[other].sleep_group;
                if other_group == NONE {
                    tables.graph.enter(tables.contacts, tables.bodies, index);
                }
            }
        }
    }

    /// Wakes everything.
    pub(crate) fn wake_all(&mut self, tables: &mut SleepTables<'_>) {
        let firsts: Vec<u32> = self.groups.iter().filter_map(|(_, slots)| slots.first().copied()).collect();
        for slot in firsts {
            self.wake(tables, slot);
        }
        for motion in &mut tables.bodies.motions {
            motion.still_time = 0.0;
        }
    }

    /// Wakes every body that the body in `slot` is close to.
    pub(crate) fn wake_neighbours(&mut self, tables: &mut SleepTables<'_>, slot: u32) {
        let neighbours: Vec<u32> = tables
            .contacts
            .of_body(tables.bodies, slot)
            .map(|index| tables.contacts[index].other(slot))
            .collect();
        for neighbour in neighbours {
            self.wake(tables, neighbour);
        }
    }
}
