//! Sixteen numbers in an AVX-512 register.
//!
//! An [`F32x16`] is made only by code that [`run`](crate::compute::run) has started for a [`Width`] of sixteen, and
//! there is such a width only where the processor [`has_avx512`]: this is the invariant that every `unsafe` block here
//! relies on, and `debug_check` watches it.
//!
//! [`Width`]: crate::compute::Width

#![allow(clippy::wildcard_imports)]

use core::arch::x86_64::*;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::compute::{BodyState, Column, Lane, RowPairs, RowPlace, each_alone};
use crate::math::trig;

#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub(crate) struct F32x16(__m512);

/// A bit that is set where it holds.
type Mask16 = __mmask16;

/// Angles up to this are within an eighth of a turn, rad.
const SMALL: f32 = 0.75;

/// Whether the processor has what is used here, and is of a generation that does not lower its clock for it: since Ice
/// Lake (Intel, 2019) and Zen 4 (AMD, 2022), which both brought VBMI2.
pub(super) fn has_avx512() -> bool {
    is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl")
        && is_x86_feature_detected!("avx512vbmi2")
}

#[inline(always)]
fn debug_check() {
    debug_assert!(has_avx512(), "sixteen numbers at a time need AVX-512");
}

macro_rules! operator {
    ($number:ident, $trait:ident, $name:ident, $intrinsic:ident) => {
        impl $trait for $number {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                // SAFETY: there are such numbers only where there is AVX-512; what makes them checks it in debug.
                Self(unsafe { $intrinsic(self.0, other.0) })
            }
        }
    };
}

operator!(F32x16, Add, add, _mm512_add_ps);
operator!(F32x16, Sub, sub, _mm512_sub_ps);
operator!(F32x16, Mul, mul, _mm512_mul_ps);
operator!(F32x16, Div, div, _mm512_div_ps);

impl Neg for F32x16 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: AVX-512 is there, see the module.
        Self(unsafe { _mm512_xor_ps(self.0, _mm512_set1_ps(-0.0)) })
    }
}

/// Eight numbers of double precision.
#[derive(Clone, Copy)]
struct F64x8(__m512d);

operator!(F64x8, Add, add, _mm512_add_pd);
operator!(F64x8, Sub, sub, _mm512_sub_pd);
operator!(F64x8, Mul, mul, _mm512_mul_pd);

impl From<f64> for F64x8 {
    #[inline(always)]
    fn from(value: f64) -> Self {
        debug_check();
        // SAFETY: AVX-512 is there, see the module.
        Self(unsafe { _mm512_set1_pd(value) })
    }
}

/// Sine and cosine of eight small angles.
#[inline(always)]
fn sin_cos_of_small(angles: __m256) -> [__m256; 2] {
    // SAFETY: AVX-512 is there, see the module.
    let (sin, cos) = trig::sin_cos_of_small(F64x8(unsafe { _mm512_cvtps_pd(angles) }));
    // SAFETY: AVX-512 is there, see the module.
    unsafe { [_mm512_cvtpd_ps(sin.0), _mm512_cvtpd_ps(cos.0)] }
}

/// Eight numbers behind eight others.
#[inline(always)]
fn join([low, high]: [__m256; 2]) -> F32x16 {
    // SAFETY: AVX-512 is there, see the module.
    F32x16(unsafe { _mm512_insertf32x8::<1>(_mm512_castps256_ps512(low), high) })
}

/// The four quarters of sixteen numbers.
#[inline(always)]
fn quarters(numbers: __m512) -> [__m128; 4] {
    // SAFETY: AVX-512 is there, see the module.
    unsafe {
        [
            _mm512_castps512_ps128(numbers),
            _mm512_extractf32x4_ps::<1>(numbers),
            _mm512_extractf32x4_ps::<2>(numbers),
            _mm512_extractf32x4_ps::<3>(numbers),
        ]
    }
}

/// Four numbers of a row: the first four for `OFFSET` 0, the second four for 4.
///
/// # Safety
/// As for [`Lane::gather`].
#[inline(always)]
unsafe fn load_quarter<const OFFSET: usize>(states: *const BodyState, row: RowPlace) -> __m128 {
    const { assert!(OFFSET == 0 || OFFSET == 4) };
    // SAFETY: the row is there, says the caller. It is eight numbers, aligned to 32
    // bytes, of which the offset leaves four, aligned to 16.
    unsafe { _mm_load_ps(row.of(states).add(OFFSET)) }
}

/// The same of four rows, one after every fourth, from `first` on.
///
/// # Safety
/// As for [`Lane::gather`].
#[inline(always)]
unsafe fn load_four<const OFFSET: usize>(
    states: *const BodyState,
    rows: &[RowPlace; 16],
    first: usize,
) -> __m512 {
    // SAFETY: AVX-512 is there, see the module. The rows are, says the caller.
    unsafe {
        let numbers = _mm512_castps128_ps512(load_quarter::<OFFSET>(states, rows[first]));
        let numbers = _mm512_insertf32x4::<1>(numbers, load_quarter::<OFFSET>(states, rows[first + 4]));
        let numbers = _mm512_insertf32x4::<2>(numbers, load_quarter::<OFFSET>(states, rows[first + 8]));
        _mm512_insertf32x4::<3>(numbers, load_quarter::<OFFSET>(states, rows[first + 12]))
    }
}

/// Four numbers of each of sixteen rows, as four lanes.
///
/// # Safety
/// As for [`Lane::gather`].
#[inline(always)]
unsafe fn gather_half<const OFFSET: usize>(states: *const BodyState, rows: &[RowPlace; 16]) -> [F32x16; 4] {
    // SAFETY: the rows are there, says the caller.
    let fours = unsafe {
        [
            load_four::<OFFSET>(states, rows, 0),
            load_four::<OFFSET>(states, rows, 1),
            load_four::<OFFSET>(states, rows, 2),
            load_four::<OFFSET>(states, rows, 3),
        ]
    };
    let [x, y, z, w] = transpose(fours);
    [F32x16(x), F32x16(y), F32x16(z), F32x16(w)]
}

/// # Safety
/// As for [`Lane::gather`].
#[inline(always)]
unsafe fn gather(states: *const BodyState, rows: &[RowPlace; 16]) -> BodyState<F32x16> {
    // SAFETY: the rows are there, says the caller.
    unsafe { BodyState::of_numbers(gather_half::<0>(states, rows), gather_half::<4>(states, rows)) }
}

/// # Safety
/// As for [`Lane::gather`].
#[inline(always)]
unsafe fn gather_velocities(states: *const BodyState, rows: &[RowPlace; 16]) -> BodyState<F32x16> {
    // SAFETY: the rows are there, says the caller.
    BodyState::of_velocities(unsafe { gather_half::<0>(states, rows) })
}

/// Writes the velocities of the bodies that move to their rows: one bit of `moves` each.
///
/// # Safety
/// As for [`Lane::scatter_velocities`].
#[inline(always)]
unsafe fn scatter(states: *mut BodyState, rows: &[RowPlace; 16], state: &BodyState<F32x16>, moves: u32) {
    if moves == 0 {
        return;
    }
    let padding = F32x16::splat(0.0);
    let fours = transpose([state.velocity.x.0, state.velocity.y.0, state.angular_velocity.0, padding.0]);
    // Usually all of them move: then sixteen jumps are saved.
    let all_move = moves == 0xFFFF;
    for (first, four) in fours.into_iter().enumerate() {
        for (number, quarter) in quarters(four).into_iter().enumerate() {
            let place = first + 4 * number;
            if all_move || moves & 1 << place != 0 {
                let row = rows[place];
                // SAFETY: SSE is part of the target. The row is there, says the caller. It begins with four numbers, aligned to 16 bytes.
                unsafe { _mm_store_ps(row.of(states).cast_mut(), quarter) }
            }
        }
    }
}

/// Writes four numbers of each of sixteen rows: the first four for `OFFSET` 0, the second four for 4.
#[inline(always)]
fn store_half<const OFFSET: usize>(states: &mut [BodyState; 16], numbers: [F32x16; 4]) {
    const { assert!(OFFSET == 0 || OFFSET == 4) };
    for (first, four) in transpose(numbers.map(|numbers| numbers.0)).into_iter().enumerate() {
        for (number, quarter) in quarters(four).into_iter().enumerate() {
            let row: *mut BodyState = &raw mut states[first + 4 * number];
            // SAFETY: SSE is part of the target. A row is eight numbers, aligned to 32 bytes, of which the offset leaves
            // four, aligned to 16.
            unsafe { _mm_store_ps(row.cast::<f32>().add(OFFSET), quarter) }
        }
    }
}

/// Turns rows of four into columns, in each quarter on its own.
#[inline(always)]
fn transpose([r0, r1, r2, r3]: [__m512; 4]) -> [__m512; 4] {
    // SAFETY: AVX-512 is there, see the module.
    unsafe {
        let (t0, t1) = (_mm512_unpacklo_ps(r0, r1), _mm512_unpackhi_ps(r0, r1));
        let (t2, t3) = (_mm512_unpacklo_ps(r2, r3), _mm512_unpackhi_ps(r2, r3));
        [
            _mm512_shuffle_ps::<0b01_00_01_00>(t0, t2),
            _mm512_shuffle_ps::<0b11_10_11_10>(t0, t2),
            _mm512_shuffle_ps::<0b01_00_01_00>(t1, t3),
            _mm512_shuffle_ps::<0b11_10_11_10>(t1, t3),
        ]
    }
}

impl Lane for F32x16 {
    const WIDTH: usize = 16;
    type Mask = Mask16;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        debug_check();
        // SAFETY: AVX-512 is there, see the module.
        Self(unsafe { _mm512_set1_ps(value) })
    }

    #[inline(always)]
    fn load(column: &Column, place: usize) -> Self {
        debug_check();
        // SAFETY: AVX-512 is there, see the module; the part is sixteen numbers, aligned as the column is.
        Self(unsafe { _mm512_load_ps(column.part::<16>(place).as_ptr()) })
    }

    #[inline(always)]
    fn store(self, column: &mut Column, place: usize) {
        // SAFETY: AVX-512 is there, see the module; the part is sixteen numbers, aligned as the column is.
        unsafe { _mm512_store_ps(column.part_mut::<16>(place).as_mut_ptr(), self.0) }
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: AVX-512 is there, see the module.
        Self(unsafe { _mm512_min_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: AVX-512 is there, see the module.
        Self(unsafe { _mm512_max_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: AVX-512 is there, see the module.
        Self(unsafe { _mm512_sqrt_ps(self.0) })
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        if Self::splat(SMALL).greater(self.abs()) != Mask16::MAX {
            return each_alone(self);
        }
        // SAFETY: AVX-512 is there, see the module.
        let halves = unsafe { [_mm512_castps512_ps256(self.0), _mm512_extractf32x8_ps::<1>(self.0)] };
        let [[low_sin, low_cos], [high_sin, high_cos]] =
            [sin_cos_of_small(halves[0]), sin_cos_of_small(halves[1])];
        (join([low_sin, high_sin]), join([low_cos, high_cos]))
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Mask16 {
        // SAFETY: AVX-512 is there, see the module.
        unsafe { _mm512_cmp_ps_mask::<_CMP_GT_OQ>(self.0, other.0) }
    }

    #[inline(always)]
    fn both(a: Mask16, b: Mask16) -> Mask16 {
        a & b
    }

    #[inline(always)]
    fn select(mask: Mask16, yes: Self, no: Self) -> Self {
        // SAFETY: AVX-512 is there, see the module.
        Self(unsafe { _mm512_mask_blend_ps(mask, no.0, yes.0) })
    }

    #[inline(always)]
    fn bits(mask: Mask16) -> u32 {
        u32::from(mask)
    }

    #[inline(always)]
    fn load_rows(states: &[BodyState], first: usize) -> BodyState<Self> {
        let states: &[BodyState; 16] = states[first..].first_chunk().expect("sixteen rows");
        // SAFETY: these are the rows of sixteen states.
        unsafe { gather(states.as_ptr(), const { &RowPlace::first() }) }
    }

    #[inline(always)]
    fn store_rows(states: &mut [BodyState], first: usize, state: &BodyState<Self>) {
        let states: &mut [BodyState; 16] = states[first..].first_chunk_mut().expect("sixteen rows");
        store_half::<0>(states, state.first_numbers());
        store_half::<4>(states, state.second_numbers());
    }

    #[inline(always)]
    fn store_velocities(states: &mut [BodyState], first: usize, state: &BodyState<Self>) {
        let states: &mut [BodyState; 16] = states[first..].first_chunk_mut().expect("sixteen rows");
        store_half::<0>(states, state.first_numbers());
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
        let ([rows_a, rows_b], [a_moves, b_moves]) = (rows.part(place), rows.moves::<16>(place));
        // SAFETY: says the caller.
        unsafe {
            scatter(states, rows_a, a, a_moves);
            scatter(states, rows_b, b, b_moves);
        }
    }
}
