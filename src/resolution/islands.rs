//! Islands: dynamic bodies that are connected by contacts with points, and by joints.
//!
//! Bodies that nothing moves (fixed, kinematic) do not connect: two stacks on one floor are two islands. Tiers, sleep and
//! [`World::islands`](crate::World::islands) find them by one function, [`find_island`], when they ask about a body: one
//! under load, one that has come to rest. That takes a look at each contact of the island, twice; nothing is kept from step
//! to step, and islands that nobody asks about cost nothing.

use crate::body::{Bodies, NONE};
use crate::collision::{Contact, Contacts};
use crate::joint::Joints;
use crate::store::BitSet;

/// Some islands, each the slots of its bodies.
#[derive(Debug, Default)]
pub(crate) struct Islands {
    slots: Vec<u32>,
    /// Where each of them ends.
    ends: Vec<usize>,
}

clone_into_buffers!(Islands { slots, ends });

impl Islands {
    pub(crate) fn clear(&mut self) {
        self.slots.clear();
        self.ends.clear();
    }

    pub(crate) fn push(&mut self, island: &[u32]) {
        self.slots.extend(island);
        self.ends.push(self.slots.len());
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.ends.len()
    }

    /// How many bodies they have.
    pub(crate) fn body_count(&self) -> usize {
        self.slots.len()
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &[u32]> {
        let starts = core::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| &self.slots[start..end])
    }
}

/// What connects bodies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Connections<'a> {
    pub(crate) contacts: &'a Contacts,
    pub(crate) joints: &'a Joints,
}

/// Appends the body in `slot` to `island`, and all that contacts and joints connect with it, nearest first; none that was `seen`
/// before. Calls `look_at` with index and contact of all of theirs, with those between two of them twice.
pub(crate) fn find_island(
    slot: u32,
    bodies: &Bodies,
    Connections { contacts, joints }: Connections<'_>,
    seen: &mut BitSet,
    island: &mut Vec<u32>,
    mut look_at: impl FnMut(u32, &Contact),
) {
    let mut next = island.len();
    if seen.insert(slot) {
        island.push(slot);
    }
    while let Some(&slot) = island.get(next) {
        next += 1;
        for index in contacts.of_body(bodies, slot) {
            let contact = &contacts[index];
            if contact.manifold.points().is_empty() {
                continue;
            }
            look_at(index, contact);
            let other = contact.other(slot);
            if bodies.is_dynamic(other) && seen.insert(other) {
                island.push(other);
            }
        }
        for index in joints.of_body(slot) {
            let other = joints.all[index].other(slot);
            if other != NONE && bodies.is_dynamic(other) && seen.insert(other) {
                island.push(other);
            }
        }
    }
}
