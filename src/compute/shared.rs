//! A slice that the parts of divided work write to, each to other places.

use core::marker::PhantomData;
use core::ops::Range;
use core::ptr::NonNull;

use crate::compute::BodyState;
use crate::compute::owners::Owners;

/// A slice in which several threads change elements at once: each its own. Which are whose cannot be said by dividing
/// the slice, but is so by construction, as the colours of the constraint graph share no body; debug builds check it,
/// element by element.
#[derive(Clone, Debug)]
pub(crate) struct Shared<'a, T> {
    first: NonNull<T>,
    len: usize,
    slice: PhantomData<&'a mut [T]>,
    owners: Owners,
}

// SAFETY: it gives out what a `&mut [T]` does; that no two threads use the same element is what every use of it says,
// and what `Owners` checks in debug.
unsafe impl<T: Send + Sync> Sync for Shared<'_, T> {}
// SAFETY: as above.
unsafe impl<T: Send> Send for Shared<'_, T> {}

impl<'a, T> Shared<'a, T> {
    #[inline(always)]
    pub(crate) fn new(slice: &'a mut [T]) -> Self {
        Self {
            owners: Owners::new(slice.len()),
            len: slice.len(),
            first: NonNull::from(slice).cast(),
            slice: PhantomData,
        }
    }

    /// Notes that the part that is worked on writes the element.
    #[inline(always)]
    pub(super) fn note_write(&self, index: usize) {
        debug_assert!(index < self.len);
        self.owners.note_write(index);
    }

    /// Checks that no other part has written the element.
    #[inline(always)]
    pub(super) fn note_read(&self, index: usize) {
        debug_assert!(index < self.len);
        self.owners.note_read(index);
    }

    #[inline(always)]
    pub(super) fn as_mut_ptr(&self) -> *mut T {
        self.first.as_ptr()
    }

    /// Changes an element, which belongs to the part that is worked on.
    ///
    /// # Panics
    /// If there is no such element.
    #[inline(always)]
    pub(crate) fn change<R>(&self, index: usize, change: impl FnOnce(&mut T) -> R) -> R {
        assert!(index < self.len, "an element beyond the {} there are", self.len);
        self.note_write(index);
        // SAFETY: the element is there. No other part uses it, checked above in debug, and `change`, which has no way
        // to this slice but through the element, is done with it when it returns.
        change(unsafe { &mut *self.first.as_ptr().add(index) })
    }

    /// Asks for some cache lines of an element to be brought close, if there is one.
    #[inline(always)]
    pub(crate) fn prefetch(&self, index: usize, lines: Range<usize>) {
        if index < self.len {
            crate::compute::prefetch::prefetch_at(self.first.as_ptr().wrapping_add(index), lines);
        }
    }
}

impl<T: Copy> Shared<'_, T> {
    /// An element that no other part writes.
    ///
    /// # Panics
    /// If there is no such element.
    #[inline(always)]
    pub(crate) fn get(&self, index: usize) -> T {
        assert!(index < self.len, "an element beyond the {} there are", self.len);
        self.note_read(index);
        // SAFETY: the element is there. No other part writes it, checked above in debug.
        unsafe { *self.first.as_ptr().add(index) }
    }
}

/// Rows that lanes gather: of a slice, or of one that several threads write to.
///
/// # Safety
/// `first_row` points to `row_count` states in a row that may be read for as long as the rows are borrowed: lanes read
/// them through the pointer, with no other check than that.
pub(crate) unsafe trait Rows {
    fn row_count(&self) -> usize;
    /// Where the rows begin; read only, and only those of which `note_read` was told.
    fn first_row(&self) -> *const BodyState;
    /// A row is about to be read.
    fn note_read(&self, row: usize);
    /// The state in a row.
    ///
    /// # Panics
    /// If there is no such row.
    fn row(&self, row: u32) -> BodyState;
}

// SAFETY: the pointer and the count are those of the slice.
unsafe impl Rows for [BodyState] {
    #[inline(always)]
    fn row_count(&self) -> usize {
        self.len()
    }

    #[inline(always)]
    fn first_row(&self) -> *const BodyState {
        self.as_ptr()
    }

    #[inline(always)]
    fn note_read(&self, row: usize) {
        debug_assert!(row < self.len());
    }

    #[inline(always)]
    fn row(&self, row: u32) -> BodyState {
        self[row as usize]
    }
}

// SAFETY: the pointer and the count are those of the slice that it was made from, and borrows.
unsafe impl Rows for Shared<'_, BodyState> {
    #[inline(always)]
    fn row_count(&self) -> usize {
        self.len
    }

    #[inline(always)]
    fn first_row(&self) -> *const BodyState {
        self.first.as_ptr()
    }

    #[inline(always)]
    fn note_read(&self, row: usize) {
        Shared::note_read(self, row);
    }

    #[inline(always)]
    fn row(&self, row: u32) -> BodyState {
        self.get(row as usize)
    }
}
