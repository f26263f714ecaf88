//! Which impact comes next.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

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
}

/// Expected impacts, earliest first; among equal times, the contact that is first in the constraint graph.
#[derive(Clone, Debug, Default)]
pub(super) struct ImpactQueue {
    heap: BinaryHeap<Reverse<(u32, GraphIndex, u32)>>,
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

#[cfg(test)]
mod tests {
    use super::{Expected, ImpactQueue};
    use crate::resolution::constraint_graph::BlockIndex;

    #[test]
    fn impacts_come_by_time_then_by_contact() {
        let block = BlockIndex::default();
        let mut queue = ImpactQueue::default();
        for (time, place) in [(0.5, 1), (0.0, 9), (0.25, 4), (-0.0, 2), (0.25, 3)] {
            let contact = block.contact(place);
            queue.push(Expected { time, contact, impacts_before: 7 - place as u32 % 7 });
        }
        let order: Vec<_> = std::iter::from_fn(|| queue.pop()).map(|expected| expected.contact).collect();
        assert_eq!(order, [2, 9, 3, 4, 1].map(|place| block.contact(place)));
    }
}
