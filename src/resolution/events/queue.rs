//! Which impact comes next, and which other contacts a struck body has.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::compute::GROUND_ROW;
use crate::resolution::constraint_graph::GraphIndex;

/// An impact that is expected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Expected {
    /// s.
    pub(super) time: f32,
    /// The contact, by its place in the constraint graph.
    pub(super) contact: GraphIndex,
    /// How many impacts its bodies had been through when it was expected.
    pub(super) impacts_before: u32,
    /// How many looks since then found that they do not meet yet.
    pub(super) looks_in_vain: u8,
}

/// Expected impacts, earliest first; among equal times, the contact that is first in the constraint graph.
#[derive(Clone, Debug, Default)]
pub(super) struct ImpactQueue {
    heap: BinaryHeap<Reverse<(u32, GraphIndex, u32, u8)>>,
}

impl ImpactQueue {
    /// Adds an impact at a time of 0 s or later.
    pub(super) fn push(&mut self, Expected { time, contact, impacts_before, looks_in_vain }: Expected) {
        debug_assert!(time >= 0.0);
        // The bits of floats that are 0 or more sort as the floats do; + 0.0 makes a -0.0 positive.
        self.heap.push(Reverse(((time + 0.0).to_bits(), contact, impacts_before, looks_in_vain)));
    }

    /// Takes the earliest impact.
    pub(super) fn pop(&mut self) -> Option<Expected> {
        let Reverse((bits, contact, impacts_before, looks_in_vain)) = self.heap.pop()?;
        Some(Expected { time: f32::from_bits(bits), contact, impacts_before, looks_in_vain })
    }
}

/// For each row, the contacts in which it takes part, the one that was added last first. The lists that bodies head say the
/// same, but lie all over memory: to follow them takes 7 % of the step of a drum.
#[derive(Clone, Debug, Default)]
pub(super) struct Neighbours {
    /// By row: the number of the link that was added last.
    last: Vec<Option<u32>>,
    links: Vec<Link>,
}

#[derive(Clone, Copy, Debug)]
struct Link {
    contact: GraphIndex,
    /// Number of the link that its row got before it.
    before: Option<u32>,
}

impl Neighbours {
    /// Of so many rows, none has contacts.
    pub(super) fn reset(&mut self, rows: usize) {
        self.last.clear();
        self.last.resize(rows, None);
        self.links.clear();
    }

    /// Whether no contacts were added.
    pub(super) fn is_empty(&self) -> bool {
        self.links.is_empty()
    }

    /// Adds a contact of two rows. The ground gets none.
    #[inline(always)]
    pub(super) fn add(&mut self, contact: GraphIndex, rows: [u32; 2]) {
        for row in rows.into_iter().filter(|&row| row != GROUND_ROW) {
            let before = self.last[row as usize].replace(self.links.len() as u32);
            self.links.push(Link { contact, before });
        }
    }

    /// The contacts of a row.
    pub(super) fn of(&self, row: u32) -> impl Iterator<Item = GraphIndex> {
        let link = |number: u32| self.links[number as usize];
        let first = self.last[row as usize].map(link);
        std::iter::successors(first, move |Link { before, .. }| before.map(link)).map(|link| link.contact)
    }
}

#[cfg(test)]
mod tests {
    use super::{Expected, ImpactQueue, Neighbours};
    use crate::resolution::constraint_graph::BlockIndex;

    #[test]
    fn every_row_but_the_ground_knows_its_contacts() {
        let (block, mut neighbours) = (BlockIndex::default(), Neighbours::default());
        neighbours.reset(4);
        for (place, rows) in [[0, 1], [1, 2], [3, 1], [0, 3]].into_iter().enumerate() {
            neighbours.add(block.contact(place), rows);
        }
        for (row, places) in [(0, &[][..]), (1, &[2, 1, 0]), (2, &[1]), (3, &[3, 2])] {
            let expected: Vec<_> = places.iter().map(|&place| block.contact(place)).collect();
            assert_eq!(neighbours.of(row).collect::<Vec<_>>(), expected, "row {row}");
        }
    }

    #[test]
    fn impacts_come_by_time_then_by_contact() {
        let block = BlockIndex::default();
        let mut queue = ImpactQueue::default();
        for (time, place) in [(0.5, 1), (0.0, 9), (0.25, 4), (-0.0, 2), (0.25, 3)] {
            let contact = block.contact(place);
            queue.push(Expected { time, contact, impacts_before: 7 - place as u32 % 7, looks_in_vain: 0 });
        }
        let order: Vec<_> = std::iter::from_fn(|| queue.pop()).map(|expected| expected.contact).collect();
        assert_eq!(order, [2, 9, 3, 4, 1].map(|place| block.contact(place)));
    }
}
