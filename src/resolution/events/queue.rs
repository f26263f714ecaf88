//! Which impact comes next: impacts by time, and the contacts of each body.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::body::NONE;
use crate::compute::GROUND_ROW;

/// An impact that is expected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Expected {
    /// s.
    pub(super) time: f32,
    /// Number of the contact.
    pub(super) contact: u32,
    /// How many impacts its bodies had been through when it was expected.
    pub(super) impacts_before: u32,
}

/// Expected impacts, earliest first; among equal times, the contact with the smaller number.
#[derive(Clone, Debug, Default)]
pub(super) struct ImpactQueue {
    heap: BinaryHeap<Reverse<(u32, u32, u32)>>,
}

impl ImpactQueue {
    /// Adds an impact at a time of 0 s or later.
    pub(super) fn push(&mut self, Expected { time, contact, impacts_before }: Expected) {
        debug_assert!(time >= 0.0);
        // The bits of floats that are 0 or more sort as the floats do; + 0.0 makes a -0.0 positive.
        self.heap.push(Reverse(((time + 0.0).to_bits(), contact, impacts_before)));
    }

    /// Takes the earliest impact.
    pub(super) fn pop(&mut self) -> Option<Expected> {
        let Reverse((bits, contact, impacts_before)) = self.heap.pop()?;
        Some(Expected { time: f32::from_bits(bits), contact, impacts_before })
    }
}

/// For each row, the contacts in which it takes part.
#[derive(Clone, Debug, Default)]
pub(super) struct Neighbours {
    /// By row: the place of the contact that was added last; `NONE` where there is none.
    last: Vec<u32>,
    /// By place: the number of a contact, and the place of the one that its row got before it, or `NONE`.
    contacts: Vec<(u32, u32)>,
}

impl Neighbours {
    /// Makes room for so many rows; none has contacts.
    pub(super) fn clear(&mut self, rows: usize) {
        self.last.clear();
        self.last.resize(rows, NONE);
        self.contacts.clear();
    }

    /// Adds the contact with this number, of two rows. The ground gets none.
    #[inline(always)]
    pub(super) fn add(&mut self, number: u32, rows: [u32; 2]) {
        for row in rows.into_iter().filter(|&row| row != GROUND_ROW) {
            let place = self.contacts.len() as u32;
            let before = std::mem::replace(&mut self.last[row as usize], place);
            self.contacts.push((number, before));
        }
    }

    /// Place of the contact that a row got last, `NONE` if it has none.
    pub(super) fn last(&self, row: u32) -> u32 {
        self.last[row as usize]
    }

    /// The number of the contact at a place, and the place of the one before it, `NONE` if it was the first.
    pub(super) fn get(&self, place: u32) -> Option<(u32, u32)> {
        self.contacts.get(place as usize).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::{Expected, ImpactQueue, Neighbours};

    #[test]
    fn impacts_come_by_time_then_by_contact() {
        let mut queue = ImpactQueue::default();
        for (time, contact) in [(0.5, 1), (0.0, 9), (0.25, 4), (-0.0, 2), (0.25, 3)] {
            queue.push(Expected { time, contact, impacts_before: 7 - contact % 7 });
        }
        let order: Vec<u32> = std::iter::from_fn(|| queue.pop()).map(|expected| expected.contact).collect();
        assert_eq!(order, [2, 9, 3, 4, 1]);
    }

    #[test]
    fn every_row_but_the_ground_knows_its_contacts() {
        let mut neighbours = Neighbours::default();
        neighbours.clear(4);
        for (number, rows) in (0..).zip([[0, 1], [1, 2], [3, 1], [0, 3]]) {
            neighbours.add(number, rows);
        }
        let of = |row| {
            let mut next = neighbours.last(row);
            std::iter::from_fn(|| {
                let (number, before) = neighbours.get(next)?;
                next = before;
                Some(number)
            })
            .collect::<Vec<_>>()
        };
        assert_eq!((of(0), of(1), of(2), of(3)), (vec![], vec![2, 1, 0], vec![1], vec![3, 2]));
    }
}
