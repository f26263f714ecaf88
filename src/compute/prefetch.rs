//! Hints for the caches.

use core::ops::Range;

/// How long a cache line is, bytes.
pub(crate) const LINE: usize = 64;

/// The first cache line of a value.
pub(crate) const FIRST_LINE: Range<usize> = 0..1;

/// Asks for the value at `index` to be brought close, all of its cache lines; does nothing where there is no such
/// value, or no way to ask.
#[inline(always)]
pub(crate) fn prefetch<T>(values: &[T], index: usize) {
    prefetch_lines(values, index, 0..size_of::<T>().div_ceil(LINE));
}

/// The same for some of its cache lines.
#[inline(always)]
pub(crate) fn prefetch_lines<T>(values: &[T], index: usize, lines: Range<usize>) {
    if let Some(value) = values.get(index) {
        prefetch_at(value, lines);
    }
}

/// The same for the value at an address.
#[inline(always)]
pub(super) fn prefetch_at<T>(value: *const T, lines: Range<usize>) {
    #[cfg(target_arch = "x86_64")]
    for line in lines {
        // SAFETY: SSE is part of the target; a prefetch reads nothing that the program sees, wherever it is.
        unsafe {
            let address = value.cast::<i8>().wrapping_add(line * LINE);
            core::arch::x86_64::_mm_prefetch::<{ core::arch::x86_64::_MM_HINT_T0 }>(address);
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (value, lines);
}
