//! Sleep: islands at rest are taken out of the step until something wakes them.
//!
//! An island sleeps when every body in it has been nearly at rest for a while. Its bodies lose their rows,
//! its contacts leave the constraint graph and keep manifold and impulses, so that the island wakes as it
//! fell asleep.

use crate::body::{Bodies, NONE};
use crate::collision::Contacts;
use crate::compute::GROUND_ROW;
use crate::resolution::{ConstraintGraph, Islands};
use crate::store::Slots;

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

/// Sleeping islands, each the slots of its bodies.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sleepers {
    groups: Slots<Vec<u32>>,
    islands: Islands,
    /// By row, scratch: whether the island named by the row may sleep.
    may_sleep: Vec<bool>,
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

    /// Puts every island to sleep whose bodies have all been at rest for long enough.
    pub(crate) fn put_to_sleep(&mut self, tables: &mut SleepTables<'_>) {
        self.find_islands(tables);
        let mut members: Vec<(u32, u32)> = Vec::new();
        for row in 1..tables.bodies.row_count() as u32 {
            let root = self.islands.root(row);
            let slot = tables.bodies.slot_of_row(row as usize);
            if self.may_sleep[root as usize] && tables.bodies.is_dynamic(slot) {
                members.push((root, slot));
            }
        }
        members.sort_unstable();
        for island in members.chunk_by(|one, next| one.0 == next.0) {
            self.lay_down(tables, island.iter().map(|&(_, slot)| slot).collect());
        }
    }

    /// Joins rows that touch, and finds which islands may sleep.
    fn find_islands(&mut self, tables: &SleepTables<'_>) {
        let bodies = &*tables.bodies;
        self.islands.reset(bodies.row_count());
        let still = |row: u32| {
            let slot = bodies.slot_of_row(row as usize);
            bodies.motions[slot as usize].still_time >= TIME_TO_SLEEP
        };
        for index in tables.graph.contacts() {
            let [a, b] = tables.contacts[index].slots;
            let [row_a, row_b] = [a, b].map(|slot| bodies.motions[slot as usize].row);
            if bodies.is_dynamic(a) && bodies.is_dynamic(b) {
                self.islands.union(row_a, row_b);
            }
        }
        self.may_sleep.clear();
        self.may_sleep.resize(bodies.row_count(), true);
        for row in 1..bodies.row_count() as u32 {
            if !still(row) {
                let root = self.islands.root(row);
                self.may_sleep[root as usize] = false;
            }
        }
        // What a moving kinematic body touches stays awake.
        for index in tables.graph.contacts() {
            let rows = tables.contacts[index].slots.map(|slot| bodies.motions[slot as usize].row);
            for (row, other) in [(rows[0], rows[1]), (rows[1], rows[0])] {
                if row != GROUND_ROW && other != GROUND_ROW && !still(other) {
                    let root = self.islands.root(row);
                    self.may_sleep[root as usize] = false;
                }
            }
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
