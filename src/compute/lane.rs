//! The trait of a lane and its scalar implementation.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::compute::{BodyState, Column, RowPairs};

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
    /// Square root.
    fn sqrt(self) -> Self;
    /// Where `self > other`.
    fn greater(self, other: Self) -> Self::Mask;
    /// Where both hold.
    fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// `yes` where the mask holds, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// Reads the states of the pairs from `place` on, a multiple of `WIDTH`.
    ///
    /// # Panics
    /// If there is no such row.
    fn gather(states: &[BodyState], rows: &RowPairs, place: usize) -> [BodyState<Self>; 2];
    /// The same where only velocities are needed: the rest is at rest.
    ///
    /// # Panics
    /// If there is no such row.
    fn gather_velocities(states: &[BodyState], rows: &RowPairs, place: usize) -> [BodyState<Self>; 2];
    /// Writes the velocities of the pairs from `place` on, a multiple of `WIDTH`, back where `moves` holds. There,
    /// rows differ from each other.
    ///
    /// # Panics
    /// If there is no such row.
    fn scatter_velocities(
        states: &mut [BodyState],
        rows: &RowPairs,
        place: usize,
        pair: &[BodyState<Self>; 2],
        moves: [Self::Mask; 2],
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
    fn gather(states: &[BodyState], rows: &RowPairs, place: usize) -> [BodyState; 2] {
        let [a, b] = rows.get(place);
        [states[a as usize], states[b as usize]]
    }

    #[inline(always)]
    fn gather_velocities(states: &[BodyState], rows: &RowPairs, place: usize) -> [BodyState; 2] {
        let [a, b] = rows.get(place);
        let velocities = |row: u32| {
            let BodyState { velocity, angular_velocity, .. } = states[row as usize];
            BodyState { velocity, angular_velocity, ..BodyState::REST }
        };
        [velocities(a), velocities(b)]
    }

    #[inline(always)]
    fn scatter_velocities(
        states: &mut [BodyState],
        rows: &RowPairs,
        place: usize,
        pair: &[BodyState; 2],
        moves: [bool; 2],
    ) {
        for ((row, state), moves) in rows.get(place).into_iter().zip(pair).zip(moves) {
            if moves {
                let to = &mut states[row as usize];
                to.velocity = state.velocity;
                to.angular_velocity = state.angular_velocity;
            }
        }
    }
}
