//! Sets of small numbers, one bit each.

/// The places of the bits that are set, in ascending order.
#[inline(always)]
pub(crate) fn places_of(mut bits: u32) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        let next = (bits != 0).then(|| bits.trailing_zeros() as usize);
        bits &= bits.wrapping_sub(1);
        next
    })
}

/// A set of small numbers, one bit each; it grows as needed.
#[derive(Debug, Default)]
pub(crate) struct BitSet {
    words: Vec<u64>,
}

clone_into_buffers!(BitSet { words });

impl BitSet {
    #[inline(always)]
    pub(crate) fn contains(&self, number: u32) -> bool {
        self.words.get(number as usize / 64).is_some_and(|word| word >> (number % 64) & 1 == 1)
    }

    /// Takes all numbers out.
    pub(crate) fn clear(&mut self) {
        self.words.fill(0);
    }

    /// Gives up the room after the greatest number.
    pub(crate) fn trim(&mut self) {
        let count = self.words.iter().rposition(|&word| word != 0).map_or(0, |last| last + 1);
        self.words.truncate(count);
    }

    /// Makes room for all numbers below `end` at once.
    pub(crate) fn make_room(&mut self, end: usize) {
        let count = end.div_ceil(64);
        if count > self.words.len() {
            self.words.resize(count, 0);
        }
    }

    /// Adds `number`; returns whether it is new.
    pub(crate) fn insert(&mut self, number: u32) -> bool {
        let (index, bit) = (number as usize / 64, 1 << (number % 64));
        self.make_room(number as usize + 1);
        let is_new = self.words[index] & bit == 0;
        self.words[index] |= bit;
        is_new
    }

    /// Takes `number` out; returns whether it was there.
    pub(crate) fn remove(&mut self, number: u32) -> bool {
        let was_there = self.contains(number);
        if was_there {
            self.words[number as usize / 64] &= !(1 << (number % 64));
        }
        was_there
    }
}
