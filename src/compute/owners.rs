//! Who writes what, in debug builds: whether the parts of divided work really keep to different elements.

use core::cell::Cell;
#[cfg(debug_assertions)]
use std::sync::{
    Arc,
    atomic::{AtomicU64, Ordering},
};

thread_local! {
    /// The part that this thread works on: a number that no other part has; 0 outside of divided work.
    static PART: Cell<u64> = const { Cell::new(0) };
    /// Whether there may be divided work.
    static IS_EXPECTED: Cell<bool> = const { Cell::new(false) };
}

/// How many numbers there are for the parts of one stretch of work.
const PARTS: u64 = 0x100;

/// Which part has written which element last. Release builds do not ask.
#[derive(Clone, Debug)]
pub(super) struct Owners {
    #[cfg(debug_assertions)]
    parts: Option<Arc<[AtomicU64]>>,
}

/// Whether work will be divided from now on.
pub(super) fn expect_parts(is_expected: bool) {
    IS_EXPECTED.set(is_expected);
}

/// Does work on a part of a stretch of work.
pub(super) fn in_part<R>(stretch: u64, part: usize, work: impl FnOnce() -> R) -> R {
    PART.set(stretch * PARTS + part as u64 + 1);
    let result = work();
    PART.set(0);
    result
}

#[cfg(debug_assertions)]
impl Owners {
    /// For so many elements.
    pub(super) fn new(count: usize) -> Self {
        let parts = || (0..count).map(|_| AtomicU64::new(0)).collect();
        Self { parts: IS_EXPECTED.get().then(parts) }
    }

    /// The part that is worked on writes an element.
    pub(super) fn note_write(&self, index: usize) {
        self.check(index, |owner, part| owner.swap(part, Ordering::Relaxed));
    }

    /// The part that is worked on reads an element.
    pub(super) fn note_read(&self, index: usize) {
        self.check(index, |owner, _| owner.load(Ordering::Relaxed));
    }

    fn check(&self, index: usize, last: impl Fn(&AtomicU64, u64) -> u64) {
        let part = PART.get();
        if let (Some(parts), true) = (&self.parts, part > 0) {
            let last = last(&parts[index], part);
            let is_of_other = last != 0 && last != part && (last - 1) / PARTS == (part - 1) / PARTS;
            assert!(!is_of_other, "two parts of the same work use element {index}");
        }
    }
}

#[cfg(not(debug_assertions))]
#[expect(clippy::unused_self, reason = "debug builds use it")]
impl Owners {
    #[inline(always)]
    pub(super) fn new(_: usize) -> Self {
        Self {}
    }

    #[inline(always)]
    pub(super) fn note_write(&self, _: usize) {}

    #[inline(always)]
    pub(super) fn note_read(&self, _: usize) {}
}
