//! Elements of a slice that are named by indices, divided among threads: which are whose cannot be said by dividing the
//! slice, but by dividing the list of indices, as long as none is in it twice.

use core::marker::PhantomData;
use core::ops::{Deref, Range};
use core::ptr::NonNull;

use crate::compute::Divide;
use crate::compute::prefetch::prefetch_at;

/// How many indices a word of [`DistinctIndices`] tells of.
const BITS: usize = 64;

/// A list of indices, none of them twice: one that is there already is refused.
#[derive(Debug, Default)]
pub(crate) struct DistinctIndices {
    list: Vec<u32>,
    /// One bit for each index: set for those in the list, and for no other.
    is_listed: Vec<u64>,
}

clone_into_buffers!(DistinctIndices { list, is_listed });

impl DistinctIndices {
    /// Makes room for an index, so that to add it asks for no memory but that of the list.
    pub(crate) fn make_room(&mut self, index: u32) {
        let words = index as usize / BITS + 1;
        if words > self.is_listed.len() {
            self.is_listed.resize(words, 0);
        }
    }

    /// Gives up the room after the greatest index.
    pub(crate) fn trim(&mut self) {
        let count = self.is_listed.iter().rposition(|&word| word != 0).map_or(0, |last| last + 1);
        self.is_listed.truncate(count);
    }

    /// Adds an index at the end.
    ///
    /// # Panics
    /// If it is in the list.
    pub(crate) fn push(&mut self, index: u32) {
        self.make_room(index);
        let (word, bit) = (&mut self.is_listed[index as usize / BITS], 1 << (index as usize % BITS));
        assert!(*word & bit == 0, "index {index} is in the list");
        *word |= bit;
        self.list.push(index);
    }

    /// Takes the last index out.
    pub(crate) fn pop(&mut self) -> Option<u32> {
        let index = self.list.pop()?;
        self.is_listed[index as usize / BITS] &= !(1 << (index as usize % BITS));
        Some(index)
    }

    /// Takes the index at `place` out; the last moves into the gap.
    ///
    /// # Panics
    /// If there is no such place.
    pub(crate) fn swap_remove(&mut self, place: usize) {
        let last = self.list.len() - 1;
        self.swap(place, last);
        self.pop();
    }

    /// Exchanges the indices at two places.
    ///
    /// # Panics
    /// If there are no such places.
    #[inline(always)]
    pub(crate) fn swap(&mut self, place: usize, other: usize) {
        self.list.swap(place, other);
    }
}

impl Deref for DistinctIndices {
    type Target = [u32];
    #[inline(always)]
    fn deref(&self) -> &[u32] {
        &self.list
    }
}

/// The elements of a slice at some indices, none of them twice, in the order of the indices. Divided, each of them is in
/// one part.
#[derive(Debug)]
pub(crate) struct Chosen<'a, T> {
    /// None of them is twice in all parts of what was divided.
    indices: &'a [u32],
    first: NonNull<T>,
    len: usize,
    slice: PhantomData<&'a mut [T]>,
}

// SAFETY: no other part has an index of this one, so that it is as if it had `&mut T` of each of its elements.
unsafe impl<T: Send> Send for Chosen<'_, T> {}
// SAFETY: shared, it only gives out `&T`.
unsafe impl<T: Sync> Sync for Chosen<'_, T> {}

impl<'a, T> Chosen<'a, T> {
    #[inline(always)]
    pub(crate) fn new(slice: &'a mut [T], indices: &'a DistinctIndices) -> Self {
        let len = slice.len();
        Self { indices, first: NonNull::from(slice).cast(), len, slice: PhantomData }
    }

    /// Those from a place of the list on.
    ///
    /// # Panics
    /// If there is no such place.
    #[inline(always)]
    pub(crate) fn skipping(&mut self, first: usize) -> Chosen<'_, T> {
        Chosen { indices: &self.indices[first..], ..*self }
    }

    /// How many there are.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.indices.len()
    }

    /// The indices.
    #[inline(always)]
    pub(crate) fn indices(&self) -> &'a [u32] {
        self.indices
    }

    #[inline(always)]
    fn address_at(&self, place: usize) -> NonNull<T> {
        let index = self.indices[place] as usize;
        assert!(index < self.len, "an element beyond the {} there are", self.len);
        // SAFETY: the element is there, see the line above.
        unsafe { self.first.add(index) }
    }

    /// The element of the index at `place` of the list.
    ///
    /// # Panics
    /// If there is no such place, or no such element.
    #[inline(always)]
    pub(crate) fn get(&self, place: usize) -> &T {
        // SAFETY: the element is there. The slice is borrowed for 'a and no other part has this index, so that whoever
        // changes the element borrows this part for it.
        unsafe { self.address_at(place).as_ref() }
    }

    /// The same, to change it.
    ///
    /// # Panics
    /// If there is no such place, or no such element.
    #[inline(always)]
    pub(crate) fn get_mut(&mut self, place: usize) -> &mut T {
        // SAFETY: as in `get`.
        unsafe { self.address_at(place).as_mut() }
    }

    /// Asks for some cache lines of the element of the index at `place` to be brought close, if there is one.
    #[inline(always)]
    pub(crate) fn prefetch(&self, place: usize, lines: Range<usize>) {
        if let Some(&index) = self.indices.get(place)
            && (index as usize) < self.len
        {
            prefetch_at(self.first.as_ptr().wrapping_add(index as usize), lines);
        }
    }
}

impl<T: Send> Divide for Chosen<'_, T> {
    fn count(&self) -> usize {
        self.len()
    }

    fn divide(self, at: usize) -> (Self, Self) {
        let (before, after) = self.indices.split_at(at);
        (Self { indices: before, ..self }, Self { indices: after, ..self })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(indices: impl IntoIterator<Item = u32>) -> DistinctIndices {
        let mut list = DistinctIndices::default();
        indices.into_iter().for_each(|index| list.push(index));
        list
    }

    #[test]
    #[should_panic(expected = "index 70 is in the list")]
    fn an_index_that_is_in_the_list_is_refused() {
        list([3, 70, 5]).push(70);
    }

    #[test]
    fn an_index_that_was_taken_out_may_come_back() {
        let mut indices = list([3, 70, 5, 64]);
        indices.swap_remove(1);
        assert_eq!(indices[..], [3, 64, 5]);
        assert_eq!(indices.pop(), Some(5));
        indices.push(70);
        indices.swap(0, 2);
        indices.push(5);
        assert_eq!(indices[..], [70, 64, 3, 5]);
        indices.push(700);
        indices.pop();
        indices.trim();
        indices.push(700);
        assert_eq!(indices[..], [70, 64, 3, 5, 700]);
    }

    #[test]
    fn each_chosen_element_is_in_one_part() {
        let (indices, mut numbers) = (list([4, 0, 3]), [0; 5]);
        let (mut first, rest) = Chosen::new(&mut numbers, &indices).divide(1);
        let (mut second, mut third) = rest.divide(1);
        for (number, part) in (1..).zip([&mut first, &mut second, &mut third]) {
            assert_eq!((part.len(), *part.get(0)), (1, 0));
            *part.get_mut(0) = number;
        }
        assert_eq!(numbers, [2, 0, 0, 3, 1]);
    }

    #[test]
    #[should_panic(expected = "an element beyond the 2 there are")]
    fn an_element_that_is_not_there_is_refused() {
        Chosen::new(&mut [1, 2], &list([0, 2])).get_mut(1);
    }
}
