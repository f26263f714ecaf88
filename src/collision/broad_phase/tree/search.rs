//! Which leaves meet the box of another: the walk of the pairs stage, made for every body that moved.
//!
//! Whether a box is met nothing foresees, and a processor that has foreseen it wrongly loses more time than looks take.
//! So nothing depends on it but numbers: each box that is looked at is written to the end of a queue, which ends one
//! further on only if the box is met. The queue is read from its front, where boxes have been for a while: many are
//! looked at while it is still being found where the queue ends.

use super::walk::STACK;
use super::{Node, ROOT, Tree};
use crate::math::Opposite;

/// So many pairs, and so many values, have room.
const ROOM: usize = 256;

/// From so many pairs on the latest is looked at next, and not the first: depth first it is at most [`STACK`] more.
const WIDE: usize = 128;

const _: () = assert!(WIDE + STACK < ROOM && ROOM.is_power_of_two());

/// What a search has found so far. It can be used for one search after the other.
pub(crate) struct Search {
    /// Pairs of siblings still to be looked at, by their first places: a ring, from `first` to `end`.
    pairs: [u32; ROOM],
    first: usize,
    end: usize,
    /// Values of the leaves that were met.
    values: [u32; ROOM],
    value_count: usize,
}

impl Search {
    pub(crate) fn new() -> Self {
        Self { pairs: [0; ROOM], first: 0, end: 0, values: [0; ROOM], value_count: 0 }
    }

    /// Takes a node up if it meets the box.
    #[inline(always)]
    fn look_at(&mut self, node: &Node, opposite: Opposite) {
        // 0 or 1, as numbers.
        let (is_met, is_leaf) = (usize::from(node.reach.meets(opposite)), usize::from(node.is_leaf()));
        self.pairs[self.end % ROOM] = node.link;
        self.end += is_met & !is_leaf;
        self.values[self.value_count % ROOM] = node.value;
        self.value_count += is_met & is_leaf;
    }

    /// The pair to look at next.
    #[inline(always)]
    fn next_pair(&mut self) -> Option<u32> {
        let count = self.end - self.first;
        if count == 0 {
            return None;
        }
        debug_assert!(count <= WIDE + STACK, "the tree is higher than its balance allows");
        let place = if count < WIDE {
            self.first += 1;
            self.first - 1
        } else {
            self.end -= 1;
            self.end
        };
        Some(self.pairs[place % ROOM])
    }

    /// Hands the values over that were found.
    fn hand_over(&mut self, visit: &mut impl FnMut(u32)) {
        let count = std::mem::take(&mut self.value_count);
        self.values[..count].iter().for_each(|&value| visit(value));
    }
}

impl Tree {
    /// Calls `visit` with the value of each other leaf whose box meets that of `leaf`.
    ///
    /// It goes up from the leaf, and down from siblings only: what is above the leaf meets its box in any case.
    #[inline]
    pub(crate) fn search_around(&self, leaf: u32, search: &mut Search, mut visit: impl FnMut(u32)) {
        let mut place = self.leaf_places[leaf as usize];
        let opposite = self.node(place).reach.opposite();
        while place != ROOT {
            let sibling = self.node(place ^ 1);
            search.look_at(sibling, opposite);
            place = sibling.parent;
        }
        while let Some(pair) = search.next_pair() {
            for node in self.pair(pair) {
                search.look_at(node, opposite);
            }
            if search.value_count > ROOM - 2 {
                search.hand_over(&mut visit);
            }
        }
        search.hand_over(&mut visit);
    }
}
