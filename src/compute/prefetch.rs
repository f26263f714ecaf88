//! Hints for the caches.

use core::ops::Range;

/// How long a cache line is.
const LINE: usize = 64;

/// The cache lines of a value.
pub(crate) const fn all_lines<T>() -> Range<usize> {
    0..size_of::<T>().div_ceil(LINE)
}

/// Asks for the value at `index` to be brought close, all of its cache lines; does nothing where there is no such
/// value, or no way to ask.
#[inline(always)]
pub(crate) fn prefetch<T>(values: &[T], index: usize) {
    if let Some(value) = values.get(index) {
        prefetch_at(value, all_lines::<T>());
    }
}

/// The same for some of the lines of the value at an address.
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
