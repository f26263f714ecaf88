//! Columns: how numbers that are computed with in lanes are stored.
//!
//! A column has a place for as many numbers as the widest lane, whatever lane is in use. A narrower lane takes it
//! in parts, so that the layout, and all code that looks at one place only, know nothing of lanes.

/// How many numbers a column holds: as many as the widest lane.
pub(crate) const COLUMN: usize = 8;

/// Eight numbers side by side, aligned for one load of the widest lane.
#[repr(C, align(32))]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Column<T = f32>([T; COLUMN]);

const _: () = assert!(size_of::<Column>() == 32 && size_of::<Column<u32>>() == 32);

impl<T: Copy> Column<T> {
    /// What stands at `place`, below [`COLUMN`].
    #[inline(always)]
    pub(crate) fn get(&self, place: usize) -> T {
        debug_assert!(place < COLUMN);
        self.0[place % COLUMN]
    }

    /// Writes to `place`, below [`COLUMN`].
    #[inline(always)]
    pub(crate) fn set(&mut self, place: usize, value: T) {
        debug_assert!(place < COLUMN);
        self.0[place % COLUMN] = value;
    }

    /// The `N` numbers from `place` on, a multiple of `N`, which divides [`COLUMN`].
    #[inline(always)]
    pub(super) fn part<const N: usize>(&self, place: usize) -> &[T; N] {
        const { assert!(COLUMN % N == 0) };
        debug_assert!(place % N == 0 && place < COLUMN);
        // Cut so that the compiler sees it to be in range.
        let start = place % COLUMN / N * N;
        self.0[start..start + N].first_chunk().expect("N numbers")
    }

    /// The same, for changing them.
    #[inline(always)]
    pub(super) fn part_mut<const N: usize>(&mut self, place: usize) -> &mut [T; N] {
        const { assert!(COLUMN % N == 0) };
        debug_assert!(place % N == 0 && place < COLUMN);
        let start = place % COLUMN / N * N;
        self.0[start..start + N].first_chunk_mut().expect("N numbers")
    }
}
