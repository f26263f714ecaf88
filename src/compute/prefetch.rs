//! Hints for the caches.

/// Asks for the value at `index` to be brought close, all of its cache lines; does nothing where there is no such
/// value, or no way to ask.
#[inline(always)]
pub(crate) fn prefetch<T>(values: &[T], index: usize) {
    #[cfg(target_arch = "x86_64")]
    if let Some(value) = values.get(index) {
        let address: *const i8 = (&raw const *value).cast();
        for line in (0..size_of::<T>()).step_by(64) {
            // SAFETY: SSE is part of the target; a prefetch reads nothing that the program sees, and the address is
            // within the value.
            unsafe {
                core::arch::x86_64::_mm_prefetch::<{ core::arch::x86_64::_MM_HINT_T0 }>(address.add(line));
            }
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (values, index);
}
