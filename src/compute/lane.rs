//! The trait of a lane and its scalar implementation.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::compute::{BodyState, Column, RowPairs};
use crate::math::trig;

/// `WIDTH` numbers that are computed with at once. Every operation rounds as IEEE 754 says for each number
/// on its own, so results do not depend on the width.
pub(crate) trait Lane:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// How many numbers a lane holds: a divisor of [`COLUMN`](crate::compute::COLUMN).
    const WIDTH: usize;
    /// One truth value per number.
    type Mask: Copy;

    /// The same number in every place.
    fn splat(value: f32) -> Self;
    /// The numbers of a column from `place` on, a multiple of `WIDTH`.
    fn load(column: &Column, place: usize) -> Self;
    /// Writes the numbers to a column from `place` on, a multiple of `WIDTH`.
    fn store(self, column: &mut Column, place: usize);

    /// `self` where it is smaller, else `other`: also where one of them is NaN or both are zeros.
    fn min(self, other: Self) -> Self;
    /// `self` where it is larger, else `other`: also where one of them is NaN or both are zeros.
    fn max(self, other: Self) -> Self;
    /// Without its sign.
    #[inline(always)]
    fn abs(self) -> Self {
        self.max(-self)
    }
    /// Square root.
    fn sqrt(self) -> Self;
    /// Sine and cosine, as [`trig::sin_cos`] finds them, bit for bit.
    fn sin_cos(self) -> (Self, Self);
    /// Where `self > other`.
    fn greater(self, other: Self) -> Self::Mask;
    /// Where both hold.
    fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// `yes` where the mask holds, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// One bit per number, the first the lowest: set where the mask holds.
    fn bits(mask: Self::Mask) -> u32;

    /// Reads the states in as many rows, from `first` on.
    ///
    /// # Panics
    /// If there are fewer rows.
    fn load_rows(states: &[BodyState], first: usize) -> BodyState<Self>;
    /// Writes the states of as many rows, from `first` on.
    ///
    /// # Panics
    /// If there are fewer rows.
    fn store_rows(states: &mut [BodyState], first: usize, state: &BodyState<Self>);
    /// The same where only velocities have changed.
    ///
    /// # Panics
    /// If there are fewer rows.
    fn store_velocities(states: &mut [BodyState], first: usize, state: &BodyState<Self>);

    /// Reads the states of the pairs from `place` on, a multiple of `WIDTH`.
    ///
    /// # Safety
    /// From `states` on there is a state in every one of the rows, and nobody writes it meanwhile.
    unsafe fn gather(states: *const BodyState, rows: &RowPairs, place: usize) -> [BodyState<Self>; 2];
    /// The same where only velocities are needed: the rest is at rest.
    ///
    /// # Safety
    /// As for `gather`.
    unsafe fn gather_velocities(
        states: *const BodyState,
        rows: &RowPairs,
        place: usize,
    ) -> [BodyState<Self>; 2];
    /// Writes the velocities of the bodies that the pairs from `place` on, a multiple of `WIDTH`, move. Their rows
    /// differ from each other.
    ///
    /// # Safety
    /// From `states` on there is a state in every one of the rows. Those that the pairs move may be written, and nobody else
    /// reads or writes them meanwhile.
    unsafe fn scatter_velocities(
        states: *mut BodyState,
        rows: &RowPairs,
        place: usize,
        pair: &[BodyState<Self>; 2],
    );
}

impl Lane for f32 {
    const WIDTH: usize = 1;
    type Mask = bool;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        value
    }

    #[inline(always)]
    fn load(column: &Column, place: usize) -> Self {
        column.get(place)
    }

    #[inline(always)]
    fn store(self, column: &mut Column, place: usize) {
        column.set(place, self);
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        f32::sqrt(self)
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        trig::sin_cos(self)
    }

    #[inline(always)]
    fn greater(self, other: Self) -> bool {
        self > other
    }

    #[inline(always)]
    fn both(a: bool, b: bool) -> bool {
        a & b
    }

    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn bits(mask: bool) -> u32 {
        u32::from(mask)
    }

    #[inline(always)]
    fn load_rows(states: &[BodyState], first: usize) -> BodyState {
        states[first]
    }

    #[inline(always)]
    fn store_rows(states: &mut [BodyState], first: usize, state: &BodyState) {
        states[first] = *state;
    }

    #[inline(always)]
    fn store_velocities(states: &mut [BodyState], first: usize, state: &BodyState) {
        states[first].velocity = state.velocity;
        states[first].angular_velocity = state.angular_velocity;
    }

    #[inline(always)]
    unsafe fn gather(states: *const BodyState, rows: &RowPairs, place: usize) -> [BodyState; 2] {
        // SAFETY: says the caller.
        rows.get(place).map(|row| unsafe { *states.add(row as usize) })
    }

    #[inline(always)]
    unsafe fn gather_velocities(states: *const BodyState, rows: &RowPairs, place: usize) -> [BodyState; 2] {
        rows.get(place).map(|row| {
            // SAFETY: says the caller.
            let BodyState { velocity, angular_velocity, .. } = unsafe { *states.add(row as usize) };
            BodyState { velocity, angular_velocity, ..BodyState::REST }
        })
    }

    #[inline(always)]
    unsafe fn scatter_velocities(
        states: *mut BodyState,
        rows: &RowPairs,
        place: usize,
        pair: &[BodyState; 2],
    ) {
        let rows_and_moves = rows.get(place).into_iter().zip(rows.moves::<1>(place));
        for ((row, moves), state) in rows_and_moves.zip(pair) {
            if moves != 0 {
                // SAFETY: says the caller.
                unsafe {
                    let to = states.add(row as usize);
                    (*to).velocity = state.velocity;
                    (*to).angular_velocity = state.angular_velocity;
                }
            }
        }
    }
}

/// Sine and cosine of one number after the other.
#[inline(always)]
pub(super) fn each_alone<L: Lane>(angles: L) -> (L, L) {
    let (mut sin, mut cos) = (Column::default(), Column::default());
    angles.store(&mut sin, 0);
    for place in 0..L::WIDTH {
        let of_one = trig::sin_cos(sin.get(place));
        sin.set(place, of_one.0);
        cos.set(place, of_one.1);
    }
    (L::load(&sin, 0), L::load(&cos, 0))
}
