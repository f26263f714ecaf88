//! Which impact comes next: impacts by time, and the contacts of each body.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Expected impacts, earliest first; among equal times, the contact with the smaller number.
#[derive(Clone, Debug, Default)]
pub(crate) struct ImpactQueue {
    heap: BinaryHeap<Reverse<(u32, u32)>>,
}

impl ImpactQueue {
    /// Adds an impact at `time`, 0 s or later, of the contact with this number.
    pub(crate) fn push(&mut self, time: f32, contact: u32) {
        debug_assert!(time >= 0.0);
        // The bits of floats that are 0 or more sort as the floats do; + 0.0 makes a -0.0 positive.
        self.heap.push(Reverse(((time + 0.0).to_bits(), contact)));
    }

    /// Takes the earliest impact: its time, s, and contact.
    pub(crate) fn pop(&mut self) -> Option<(f32, u32)> {
        self.heap.pop().map(|Reverse((bits, contact))| (f32::from_bits(bits), contact))
    }
}

/// For each row, the numbers of the contacts in which it takes part.
#[derive(Clone, Debug, Default)]
pub(crate) struct Neighbours {
    /// Where the contacts of a row begin in `contacts`; one more entry than rows.
    starts: Vec<u32>,
    contacts: Vec<u32>,
}

impl Neighbours {
    /// Sorts the contacts, given with their pairs of rows, by row (counting sort). Row 0, the ground, gets none.
    pub(crate) fn build(&mut self, rows: usize, pairs: impl Iterator<Item = (u32, [u32; 2])> + Clone) {
        self.starts.clear();
        self.starts.resize(rows + 1, 0);
        for row in pairs.clone().flat_map(|(_, pair)| pair).filter(|&row| row != 0) {
            self.starts[row as usize] += 1;
        }
        let mut end = 0;
        for start in &mut self.starts {
            end += *start;
            *start = end;
        }
        self.contacts.clear();
        self.contacts.resize(end as usize, 0);
        // Each start is at the end of its row now and moves to its beginning as the row is filled.
        for (number, pair) in pairs {
            for row in pair.into_iter().filter(|&row| row != 0) {
                let start = &mut self.starts[row as usize];
                *start -= 1;
                self.contacts[*start as usize] = number;
            }
        }
    }

    /// The contacts of a row.
    pub(crate) fn of(&self, row: u32) -> &[u32] {
        let row = row as usize;
        &self.contacts[self.starts[row] as usize..self.starts[row + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::{ImpactQueue, Neighbours};

    #[test]
    fn impacts_come_by_time_then_by_contact() {
        let mut queue = ImpactQueue::default();
        for (time, contact) in [(0.5, 1), (0.0, 9), (0.25, 4), (-0.0, 2), (0.25, 3)] {
            queue.push(time, contact);
        }
        let order: Vec<u32> = std::iter::from_fn(|| queue.pop()).map(|(_, contact)| contact).collect();
        assert_eq!(order, [2, 9, 3, 4, 1]);
    }

    #[test]
    fn every_row_but_the_ground_knows_its_contacts() {
        let mut neighbours = Neighbours::default();
        neighbours.build(4, (0..).zip([[0, 1], [1, 2], [3, 1], [0, 3]]));
        let sorted = |row| {
            let mut contacts = neighbours.of(row).to_vec();
            contacts.sort_unstable();
            contacts
        };
        assert_eq!(
            (sorted(0), sorted(1), sorted(2), sorted(3)),
            (vec![], vec![0, 1, 2], vec![1], vec![2, 3])
        );
    }
}
