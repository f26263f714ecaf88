//! Columns: how numbers that are computed with in lanes are stored, and rows: which bodies they belong to.
//!
//! A column has a place for as many numbers as the widest lane, whatever lane is in use. A narrower lane takes it
//! in parts, so that the layout, and all code that looks at one place only, know nothing of lanes.

use crate::compute::{BodyState, Lane};

/// How many numbers a column holds: as many as the widest lane.
pub(crate) const COLUMN: usize = 16;

/// Sixteen numbers side by side, aligned for one load of the widest lane.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Column([f32; COLUMN]);

const _: () = assert!(size_of::<Column>() == 64);

impl Column {
    /// What stands at `place`, below [`COLUMN`].
    #[inline(always)]
    pub(crate) fn get(&self, place: usize) -> f32 {
        debug_assert!(place < COLUMN);
        self.0[place % COLUMN]
    }

    /// Writes to `place`, below [`COLUMN`].
    #[inline(always)]
    pub(crate) fn set(&mut self, place: usize, value: f32) {
        debug_assert!(place < COLUMN);
        self.0[place % COLUMN] = value;
    }

    /// The greatest of the numbers, none of them NaN: of halves, of halves of these, and so on.
    #[inline(always)]
    pub(crate) fn greatest(&self) -> f32 {
        let mut numbers = self.0;
        let mut half = COLUMN / 2;
        while half > 0 {
            for place in 0..half {
                let other = numbers[place + half];
                numbers[place] = if other > numbers[place] { other } else { numbers[place] };
            }
            half /= 2;
        }
        numbers[0]
    }

    /// The `N` numbers from `place` on, a multiple of `N`, which divides [`COLUMN`].
    #[inline(always)]
    pub(super) fn part<const N: usize>(&self, place: usize) -> &[f32; N] {
        part_of(&self.0, place)
    }

    /// The same, for changing them.
    #[inline(always)]
    pub(super) fn part_mut<const N: usize>(&mut self, place: usize) -> &mut [f32; N] {
        const { assert!(COLUMN.is_multiple_of(N)) };
        debug_assert!(place.is_multiple_of(N) && place < COLUMN);
        let start = place % COLUMN / N * N;
        self.0[start..start + N].first_chunk_mut().expect("N numbers")
    }
}

/// Where a row of [`BodyState`] begins, in steps of eight bytes: a processor multiplies by eight as it loads, but not by
/// the 32 bytes of a row.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct RowPlace(u32);

/// So long is a step.
const STEP: usize = 8;

/// And so many of them a row.
const STEPS: u32 = (size_of::<BodyState>() / STEP) as u32;

// Portable lanes read and write row by row.
#[cfg_attr(not(any(target_arch = "x86_64", target_arch = "aarch64")), allow(dead_code))]
impl RowPlace {
    /// That of a row. Those from 2³⁰ on have one in common, as there are not as many.
    #[inline(always)]
    pub(super) const fn new(row: u32) -> Self {
        Self(if row < u32::MAX / STEPS { row } else { u32::MAX / STEPS } * STEPS)
    }

    /// Those of the first `N` rows.
    #[inline(always)]
    pub(super) const fn first<const N: usize>() -> [Self; N] {
        let mut all = [Self(0); N];
        let mut row = 0;
        while row < N {
            all[row] = Self::new(row as u32);
            row += 1;
        }
        all
    }

    /// Its number.
    #[inline(always)]
    pub(super) fn row(self) -> u32 {
        self.0 / STEPS
    }

    /// Its numbers, where `first` is the first row.
    #[inline(always)]
    pub(super) fn of(self, first: *const BodyState) -> *const f32 {
        first.cast::<[u8; STEP]>().wrapping_add(self.0 as usize).cast()
    }
}

/// Which rows of [`BodyState`] sixteen pairs of bodies have, and which of them the pairs move. There are no others that
/// lanes read and write.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RowPairs {
    a: [RowPlace; COLUMN],
    b: [RowPlace; COLUMN],
    /// No row is greater: one number to compare, and all rows are known to be there.
    greatest: RowPlace,
    /// Of a and of b: one bit per place, set where the pair moves the body.
    moves: [[u8; COLUMN / 8]; 2],
}

impl RowPairs {
    /// The rows of the pair at `place`, below [`COLUMN`].
    #[inline(always)]
    pub(crate) fn get(&self, place: usize) -> [u32; 2] {
        debug_assert!(place < COLUMN);
        [self.a[place % COLUMN].row(), self.b[place % COLUMN].row()]
    }

    /// With these rows of a and of b; the pairs move none of them.
    #[inline(always)]
    pub(crate) fn new(rows: [[u32; COLUMN]; 2]) -> Self {
        let [a, b] = rows.map(|rows| rows.map(RowPlace::new));
        let greatest = a.into_iter().chain(b).fold(RowPlace::default(), RowPlace::max);
        Self { a, b, greatest, moves: Default::default() }
    }

    /// Writes which bodies the pairs from `place` on move, a multiple of the lane's width: those with a number above 0.
    #[inline(always)]
    pub(crate) fn set_moves<L: Lane>(&mut self, place: usize, inverse_masses: [L; 2]) {
        for (bytes, inverse_mass) in self.moves.iter_mut().zip(inverse_masses) {
            let bits = L::bits(inverse_mass.greater(L::splat(0.0))) as u16;
            let others = !((((1 << L::WIDTH) - 1) as u16) << (place % COLUMN));
            *bytes = (u16::from_le_bytes(*bytes) & others | bits << (place % COLUMN)).to_le_bytes();
        }
    }

    /// Writes the rows of the pair at `place`, below [`COLUMN`], and which of them it moves.
    #[cfg(test)]
    pub(crate) fn set_one(&mut self, place: usize, rows: [u32; 2], moves: [bool; 2]) {
        let [a, b] = rows.map(RowPlace::new);
        self.a[place % COLUMN] = a;
        self.b[place % COLUMN] = b;
        self.greatest = self.greatest.max(a).max(b);
        self.set_moves::<f32>(place, moves.map(|moves| f32::from(u8::from(moves))));
    }

    /// Which bodies the `N` pairs from `place` on move, a multiple of `N`: one bit each, the first the lowest, of a and of
    /// b.
    #[inline(always)]
    pub(crate) fn moves<const N: usize>(&self, place: usize) -> [u32; 2] {
        const { assert!(COLUMN.is_multiple_of(N)) };
        debug_assert!(place.is_multiple_of(N) && place < COLUMN);
        // The byte is found faster than its bits are shifted down.
        self.moves.map(|bytes| match N {
            16 => u32::from(u16::from_le_bytes(bytes)),
            8 => u32::from(bytes[place % COLUMN / 8]),
            _ => u32::from(bytes[place % COLUMN / 8]) >> (place % 8) & ((1 << N) - 1),
        })
    }

    /// No row is greater.
    pub(super) fn greatest_row(&self) -> u32 {
        self.greatest.row()
    }

    /// Checks that there is a state in every one of the rows.
    ///
    /// # Panics
    /// If there is not.
    #[inline(always)]
    pub(super) fn check_among(&self, states: usize) {
        assert!((self.greatest.row() as usize) < states, "a row beyond the {states} there are");
    }

    /// The rows of the `N` bodies from `place` on, a multiple of `N`.
    #[inline(always)]
    pub(super) fn part<const N: usize>(&self, place: usize) -> [&[RowPlace; N]; 2] {
        [part_of(&self.a, place), part_of(&self.b, place)]
    }
}

/// The `N` numbers from `place` on, a multiple of `N`, which divides [`COLUMN`].
#[inline(always)]
fn part_of<const N: usize, T>(all: &[T; COLUMN], place: usize) -> &[T; N] {
    const { assert!(COLUMN.is_multiple_of(N)) };
    debug_assert!(place.is_multiple_of(N) && place < COLUMN);
    // Cut so that the compiler sees it to be in range.
    let start = place % COLUMN / N * N;
    all[start..start + N].first_chunk().expect("N numbers")
}
