//! The workers without the feature `parallel`: the caller alone.

/// Nobody beside the caller.
#[derive(Clone, Debug, Default)]
pub(super) struct SharedWorkers;

/// There is nobody to let sleep when it goes.
#[must_use = "as that of the feature"]
pub(crate) struct AtWork;

impl AtWork {
    /// Nobody beside the caller is.
    pub(super) const ALONE: Self = Self;
}

#[expect(clippy::unused_self, reason = "it is called as those of the feature are")]
impl SharedWorkers {
    #[inline(always)]
    pub(super) fn keep_only(&mut self, _threads: usize) {}

    #[inline(always)]
    pub(super) fn begin(&mut self, _threads: usize) -> AtWork {
        AtWork::ALONE
    }

    #[inline(always)]
    pub(super) fn end(&mut self, _at_work: AtWork) {}

    #[inline(always)]
    pub(super) fn threads(&self) -> usize {
        1
    }

    pub(super) fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync)) {
        (0..parts).for_each(work);
    }
}
