//! Four numbers in an SSE register, which every x86-64 processor has.

#![allow(clippy::wildcard_imports)]

use core::arch::x86_64::*;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::compute::{BodyState, Column, Lane, RowPairs, RowPlace, each_alone};

#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub(crate) struct F32x4(__m128);

/// All ones where it holds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mask4(__m128);

macro_rules! operator {
    ($trait:ident, $name:ident, $intrinsic:ident) => {
        impl $trait for F32x4 {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                // SAFETY: SSE2 is part of the target.
                Self(unsafe { $intrinsic(self.0, other.0) })
            }
        }
    };
}

operator!(Add, add, _mm_add_ps);
operator!(Sub, sub, _mm_sub_ps);
operator!(Mul, mul, _mm_mul_ps);
operator!(Div, div, _mm_div_ps);

impl Neg for F32x4 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: SSE2 is part of the target.
        Self(unsafe { _mm_xor_ps(self.0, _mm_set1_ps(-0.0)) })
    }
}

/// Four numbers of a row: the first four for `OFFSET` 0, the second four for 4.
///
/// # Safety
/// As for [`Lane::gather`].
#[inline(always)]
unsafe fn load_half<const OFFSET: usize>(states: *const BodyState, row: RowPlace) -> __m128 {
    const { assert!(OFFSET == 0 || OFFSET == 4) };
    // SAFETY: SSE2 is part of the target. The row is there, says the caller. It is
    // eight numbers, aligned to 32 bytes, of which the offset leaves four, aligned to 16.
    unsafe { _mm_load_ps(row.of(states).add(OFFSET)) }
}

/// Four numbers of each of four rows, as four lanes.
///
/// # Safety
/// As for [`Lane::gather`].
#[inline(always)]
unsafe fn gather_half<const OFFSET: usize>(states: *const BodyState, rows: &[RowPlace; 4]) -> [F32x4; 4] {
    // SAFETY: the rows are there, says the caller.
    let halves = unsafe {
        [
            load_half::<OFFSET>(states, rows[0]),
            load_half::<OFFSET>(states, rows[1]),
            load_half::<OFFSET>(states, rows[2]),
            load_half::<OFFSET>(states, rows[3]),
        ]
    };
    let [x, y, z, w] = transpose(halves);
    [F32x4(x), F32x4(y), F32x4(z), F32x4(w)]
}

/// # Safety
/// As for [`Lane::gather`].
#[inline(always)]
unsafe fn gather(states: *const BodyState, rows: &[RowPlace; 4]) -> BodyState<F32x4> {
    // SAFETY: the rows are there, says the caller.
    unsafe { BodyState::of_numbers(gather_half::<0>(states, rows), gather_half::<4>(states, rows)) }
}

/// # Safety
/// As for [`Lane::gather`].
#[inline(always)]
unsafe fn gather_velocities(states: *const BodyState, rows: &[RowPlace; 4]) -> BodyState<F32x4> {
    // SAFETY: the rows are there, says the caller.
    BodyState::of_velocities(unsafe { gather_half::<0>(states, rows) })
}

/// Writes the velocities of the bodies that move to their rows: one bit of `moves` each.
///
/// # Safety
/// As for [`Lane::scatter_velocities`].
#[inline(always)]
unsafe fn scatter(states: *mut BodyState, rows: &[RowPlace; 4], state: &BodyState<F32x4>, moves: u32) {
    let padding = F32x4::splat(0.0);
    let halves = transpose([state.velocity.x.0, state.velocity.y.0, state.angular_velocity.0, padding.0]);
    for (place, half) in halves.into_iter().enumerate() {
        let row = rows[place];
        if moves & 1 << place != 0 {
            // SAFETY: SSE2 is part of the target. The row is there, says the caller. It begins with four numbers, aligned to 16 bytes.
            unsafe { _mm_store_ps(row.of(states).cast_mut(), half) }
        }
    }
}

/// Turns rows into columns.
#[inline(always)]
fn transpose([r0, r1, r2, r3]: [__m128; 4]) -> [__m128; 4] {
    // SAFETY: SSE2 is part of the target.
    unsafe {
        let (t0, t1) = (_mm_unpacklo_ps(r0, r1), _mm_unpackhi_ps(r0, r1));
        let (t2, t3) = (_mm_unpacklo_ps(r2, r3), _mm_unpackhi_ps(r2, r3));
        [_mm_movelh_ps(t0, t2), _mm_movehl_ps(t2, t0), _mm_movelh_ps(t1, t3), _mm_movehl_ps(t3, t1)]
    }
}

impl Lane for F32x4 {
    const WIDTH: usize = 4;
    type Mask = Mask4;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        // SAFETY: SSE2 is part of the target.
        Self(unsafe { _mm_set1_ps(value) })
    }

    #[inline(always)]
    fn load(column: &Column, place: usize) -> Self {
        // SAFETY: SSE2 is part of the target; the part is four numbers. It is aligned, as the column is and `place`
        // is a multiple of four, which `part` sees to.
        Self(unsafe { _mm_load_ps(column.part::<4>(place).as_ptr()) })
    }

    #[inline(always)]
    fn store(self, column: &mut Column, place: usize) {
        // SAFETY: SSE2 is part of the target; the part is four numbers, aligned as in `load`.
        unsafe { _mm_store_ps(column.part_mut::<4>(place).as_mut_ptr(), self.0) }
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: SSE2 is part of the target.
        Self(unsafe { _mm_min_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: SSE2 is part of the target.
        Self(unsafe { _mm_max_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: SSE2 is part of the target.
        Self(unsafe { _mm_sqrt_ps(self.0) })
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        each_alone(self)
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Mask4 {
        // SAFETY: SSE2 is part of the target.
        Mask4(unsafe { _mm_cmpgt_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn both(a: Mask4, b: Mask4) -> Mask4 {
        // SAFETY: SSE2 is part of the target.
        Mask4(unsafe { _mm_and_ps(a.0, b.0) })
    }

    #[inline(always)]
    fn select(mask: Mask4, yes: Self, no: Self) -> Self {
        // SAFETY: SSE2 is part of the target.
        Self(unsafe { _mm_or_ps(_mm_and_ps(mask.0, yes.0), _mm_andnot_ps(mask.0, no.0)) })
    }

    #[inline(always)]
    fn bits(mask: Mask4) -> u32 {
        // SAFETY: SSE2 is part of the target.
        unsafe { _mm_movemask_ps(mask.0) as u32 }
    }

    #[inline(always)]
    fn load_rows(states: &[BodyState], first: usize) -> BodyState<Self> {
        let states: &[BodyState; 4] = states[first..].first_chunk().expect("four rows");
        // SAFETY: these are the rows of four states.
        unsafe { gather(states.as_ptr(), const { &RowPlace::first() }) }
    }

    #[inline(always)]
    fn store_rows(states: &mut [BodyState], first: usize, state: &BodyState<Self>) {
        let states: &mut [BodyState; 4] = states[first..].first_chunk_mut().expect("four rows");
        let firsts = transpose(state.first_numbers().map(|numbers| numbers.0));
        let seconds = transpose(state.second_numbers().map(|numbers| numbers.0));
        for (state, (first, second)) in states.iter_mut().zip(firsts.into_iter().zip(seconds)) {
            let row: *mut BodyState = &raw mut *state;
            // SAFETY: SSE2 is part of the target; a state is eight numbers, aligned to 32 bytes.
            unsafe {
                _mm_store_ps(row.cast(), first);
                _mm_store_ps(row.cast::<f32>().add(4), second);
            }
        }
    }

    #[inline(always)]
    fn store_velocities(states: &mut [BodyState], first: usize, state: &BodyState<Self>) {
        let states: &mut [BodyState; 4] = states[first..].first_chunk_mut().expect("four rows");
        let rows = transpose(state.first_numbers().map(|numbers| numbers.0));
        for (state, numbers) in states.iter_mut().zip(rows) {
            let row: *mut BodyState = &raw mut *state;
            // SAFETY: SSE2 is part of the target; a state begins with four numbers, aligned to 16 bytes.
            unsafe { _mm_store_ps(row.cast(), numbers) }
        }
    }

    #[inline(always)]
    unsafe fn gather(states: *const BodyState, rows: &RowPairs, place: usize) -> [BodyState<Self>; 2] {
        let [a, b] = rows.part(place);
        // SAFETY: says the caller.
        unsafe { [gather(states, a), gather(states, b)] }
    }

    #[inline(always)]
    unsafe fn gather_velocities(
        states: *const BodyState,
        rows: &RowPairs,
        place: usize,
    ) -> [BodyState<Self>; 2] {
        let [a, b] = rows.part(place);
        // SAFETY: says the caller.
        unsafe { [gather_velocities(states, a), gather_velocities(states, b)] }
    }

    #[inline(always)]
    unsafe fn scatter_velocities(
        states: *mut BodyState,
        rows: &RowPairs,
        place: usize,
        [a, b]: &[BodyState<Self>; 2],
    ) {
        let ([rows_a, rows_b], [a_moves, b_moves]) = (rows.part(place), rows.moves::<4>(place));
        // SAFETY: says the caller.
        unsafe {
            scatter(states, rows_a, a, a_moves);
            scatter(states, rows_b, b, b_moves);
        }
    }
}
