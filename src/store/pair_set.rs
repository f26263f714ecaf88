//! A set of unordered pairs of numbers: which bodies already have a contact.

use crate::compute::prefetch;

/// A hash set of unordered pairs with open addressing. It is asked, never walked, so its inner order cannot
/// reach a result.
#[derive(Debug, Default)]
pub(crate) struct PairSet {
    /// Keys, `EMPTY` where there is none; the length is a power of two, at most half of it in use.
    table: Vec<u64>,
    len: usize,
}

clone_into_buffers!(PairSet { table, len });

/// No pair has this key: it would be a number paired with itself.
const EMPTY: u64 = u64::MAX;

/// Length of the table of the first pairs.
const SMALLEST: usize = 32;

fn key_of(a: u32, b: u32) -> u64 {
    debug_assert!(a != b);
    u64::from(a.min(b)) << 32 | u64::from(a.max(b))
}

impl PairSet {
    #[cfg(test)]
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    pub(crate) fn contains(&self, a: u32, b: u32) -> bool {
        !self.table.is_empty() && self.table[self.find(key_of(a, b))] != EMPTY
    }

    /// Asks for the place of the pair to be brought close.
    #[inline(always)]
    pub(crate) fn prefetch(&self, a: u32, b: u32) {
        let mask = self.table.len().wrapping_sub(1);
        prefetch(&self.table, home_of(key_of(a, b), mask));
    }

    /// Adds the pair; returns whether it is new.
    pub(crate) fn insert(&mut self, a: u32, b: u32) -> bool {
        if self.table.len() < 2 * (self.len + 1) {
            self.resize((self.table.len() * 2).max(SMALLEST));
        }
        let key = key_of(a, b);
        let place = self.find(key);
        if self.table[place] == key {
            return false;
        }
        self.table[place] = key;
        self.len += 1;
        true
    }

    /// Takes the pair out; returns whether it was there.
    pub(crate) fn remove(&mut self, a: u32, b: u32) -> bool {
        if self.table.is_empty() {
            return false;
        }
        let mask = self.table.len() - 1;
        let mut hole = self.find(key_of(a, b));
        if self.table[hole] == EMPTY {
            return false;
        }
        // Close the gap: move back each following key whose search would otherwise stop at the hole.
        let mut next = (hole + 1) & mask;
        while self.table[next] != EMPTY {
            let home = home_of(self.table[next], mask);
            if (next.wrapping_sub(home) & mask) >= (next.wrapping_sub(hole) & mask) {
                self.table[hole] = self.table[next];
                hole = next;
            }
            next = (next + 1) & mask;
        }
        self.table[hole] = EMPTY;
        self.len -= 1;
        true
    }

    /// Where `key` is, or the empty place where it would go.
    fn find(&self, key: u64) -> usize {
        let mask = self.table.len() - 1;
        let mut place = home_of(key, mask);
        while self.table[place] != key && self.table[place] != EMPTY {
            place = (place + 1) & mask;
        }
        place
    }

    /// Gives up the room that the pairs do not need.
    pub(crate) fn trim(&mut self) {
        let enough = (2 * self.len).next_power_of_two().max(SMALLEST);
        if enough < self.table.len() {
            self.resize(enough);
        }
    }

    fn resize(&mut self, len: usize) {
        let other = vec![EMPTY; len];
        for key in std::mem::replace(&mut self.table, other) {
            if key != EMPTY {
                let place = self.find(key);
                self.table[place] = key;
            }
        }
    }
}

/// Where the search for `key` begins: the upper bits of a multiplication by 2⁶⁴/φ (Knuth, vol. 3, 6.4).
fn home_of(key: u64, mask: usize) -> usize {
    (key.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 32) as usize & mask
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::PairSet;

    #[test]
    fn agrees_with_an_ordered_set_under_random_edits() {
        let (mut pairs, mut reference) = (PairSet::default(), BTreeSet::new());
        let mut state = 1_u64;
        for _ in 0..50_000 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let (a, b) = ((state >> 40) as u32 % 60, (state >> 50) as u32 % 60);
            if a == b {
                continue;
            }
            if state >> 33 & 1 == 0 {
                assert_eq!(pairs.insert(a, b), reference.insert((a.min(b), a.max(b))));
            } else {
                assert_eq!(pairs.remove(a, b), reference.remove(&(a.min(b), a.max(b))));
            }
            if state >> 55 == 0 {
                pairs.trim();
            }
            assert_eq!(pairs.contains(b, a), reference.contains(&(a.min(b), a.max(b))));
            assert_eq!(pairs.len(), reference.len());
        }
    }
}
