//! Hints for the caches.

/// Asks for the value at `index` to be brought close, all of its cache lines; does nothing where there is no such
/// value, or no way to ask.
#[inline(always)]
pub(crate) fn prefetch<T>(values: &[T], index: usize) {
    if let Some(value) = values.get(index) {
        prefetch_at(value);
    }
}

/// The same for the value at an address.
#[inline(always)]
pub(super) fn prefetch_at<T>(value: *const T) {
    #[cfg(target_arch = "x86_64")]
    for line in (0..size_of::<T>()).step_by(64) {
        // SAFETY: SSE is part of the target; a prefetch reads nothing that the program sees, wherever it is.
        unsafe {
            let address = value.cast::<i8>().wrapping_add(line);
            core::arch::x86_64::_mm_prefetch::<{ core::arch::x86_64::_MM_HINT_T0 }>(address);
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = value;
}
