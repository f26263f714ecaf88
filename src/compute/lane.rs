//! The trait of a lane and its scalar implementation.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::compute::BodyState;

/// `WIDTH` numbers that are computed with at once. Every operation rounds as IEEE 754 says for each number
/// on its own, so results do not depend on the width.
pub(crate) trait Lane:
    Copy
    + Debug
    + Default
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// How many numbers a lane holds; always `MAX_WIDTH` or less.
    const WIDTH: usize;
    /// One truth value per number.
    type Mask: Copy;
    /// One row number per number: which [`BodyState`] each belongs to.
    type Rows: Copy + Debug + Default;

    /// The same number in every place.
    fn splat(value: f32) -> Self;
    /// The number at `place`, which is below `WIDTH`.
    fn get(&self, place: usize) -> f32;
    /// Puts a number at `place`, which is below `WIDTH`.
    fn set(&mut self, place: usize, value: f32);
    /// Puts a row number at `place`, which is below `WIDTH`.
    fn set_row(rows: &mut Self::Rows, place: usize, row: u32);
    /// Smaller of the two, number by number.
    fn min(self, other: Self) -> Self;
    /// Larger of the two, number by number.
    fn max(self, other: Self) -> Self;
    /// Where `self > other`.
    fn greater(self, other: Self) -> Self::Mask;
    /// Where both hold.
    fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// `yes` where the mask holds, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Reads the states in `rows`.
    fn gather(states: &[BodyState], rows: Self::Rows) -> BodyState<Self>;
    /// Writes the velocities of the states in `rows` back.
    fn scatter_velocities(states: &mut [BodyState], rows: Self::Rows, state: &BodyState<Self>);
}

impl Lane for f32 {
    const WIDTH: usize = 1;
    type Mask = bool;
    type Rows = u32;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        value
    }

    #[inline(always)]
    fn get(&self, _place: usize) -> f32 {
        *self
    }

    #[inline(always)]
    fn set(&mut self, _place: usize, value: f32) {
        *self = value;
    }

    #[inline(always)]
    fn set_row(rows: &mut u32, _place: usize, row: u32) {
        *rows = row;
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // As SSE and AVX do it; `f32::min` treats NaN differently and takes more instructions.
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
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
    fn gather(states: &[BodyState], row: u32) -> BodyState {
        states[row as usize]
    }

    #[inline(always)]
    fn scatter_velocities(states: &mut [BodyState], row: u32, state: &BodyState) {
        let to = &mut states[row as usize];
        to.velocity = state.velocity;
        to.angular_velocity = state.angular_velocity;
    }
}
