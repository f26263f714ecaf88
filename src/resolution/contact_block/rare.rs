//! Columns that few blocks need.

/// Columns that are made when a block first needs them, and kept for its next use; each use begins with the default.
#[derive(Clone, Debug, Default)]
pub(super) struct Rare<T>(Option<Box<Kept<T>>>);

#[derive(Clone, Debug, Default)]
struct Kept<T> {
    columns: T,
    is_used: bool,
}

impl<T: Default> Rare<T> {
    /// The columns, if they are in use.
    #[inline(always)]
    pub(super) fn used(&self) -> Option<&T> {
        self.0.as_ref().filter(|kept| kept.is_used).map(|kept| &kept.columns)
    }

    #[inline(always)]
    pub(super) fn used_mut(&mut self) -> Option<&mut T> {
        self.0.as_mut().filter(|kept| kept.is_used).map(|kept| &mut kept.columns)
    }

    /// The columns, in use from now on.
    pub(super) fn begin_use(&mut self) -> &mut T {
        let kept = self.0.get_or_insert_default();
        if !kept.is_used {
            **kept = Kept { columns: T::default(), is_used: true };
        }
        &mut kept.columns
    }

    pub(super) fn end_use(&mut self) {
        if let Some(kept) = &mut self.0 {
            kept.is_used = false;
        }
    }
}
