//! Eight numbers in an AVX register.
//!
//! An [`F32x8`] is made only by code that [`run`](crate::compute::run) has started for a [`Width`] of eight, and
//! there is such a width only where the processor has been found to have AVX2: this is the invariant that every
//! `unsafe` block here relies on, and `debug_check` watches it.
//!
//! [`Width`]: crate::compute::Width

#![allow(clippy::wildcard_imports)]

use core::arch::x86_64::*;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::compute::{BodyState, Column, Lane, RowPairs, RowPlace, each_alone};
use crate::math::trig;

#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub(crate) struct F32x8(__m256);

/// All ones where it holds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mask8(__m256);

/// Angles up to this are within an eighth of a turn, rad.
const SMALL: f32 = 0.75;

#[inline(always)]
fn debug_check() {
    debug_assert!(is_x86_feature_detected!("avx2"), "eight numbers at a time need AVX2");
}

macro_rules! operator {
    ($trait:ident, $name:ident, $intrinsic:ident) => {
        impl $trait for F32x8 {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                // SAFETY: there is an F32x8 only where there is AVX2; `splat` and `load` check it in debug.
                Self(unsafe { $intrinsic(self.0, other.0) })
            }
        }
    };
}

operator!(Add, add, _mm256_add_ps);
operator!(Sub, sub, _mm256_sub_ps);
operator!(Mul, mul, _mm256_mul_ps);
operator!(Div, div, _mm256_div_ps);

impl Neg for F32x8 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: there is an F32x8 only where there is AVX2; `splat` and `load` check it in debug.
        Self(unsafe { _mm256_xor_ps(self.0, _mm256_set1_ps(-0.0)) })
    }
}

/// Four numbers of double precision.
#[derive(Clone, Copy)]
struct F64x4(__m256d);

macro_rules! double_operator {
    ($trait:ident, $name:ident, $intrinsic:ident) => {
        impl $trait for F64x4 {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                // SAFETY: there is an F64x4 only where there is AVX2: it is made of an F32x8.
                Self(unsafe { $intrinsic(self.0, other.0) })
            }
        }
    };
}

double_operator!(Add, add, _mm256_add_pd);
double_operator!(Sub, sub, _mm256_sub_pd);
double_operator!(Mul, mul, _mm256_mul_pd);

impl From<f64> for F64x4 {
    #[inline(always)]
    fn from(value: f64) -> Self {
        debug_check();
        // SAFETY: AVX2 is there, see the module.
        Self(unsafe { _mm256_set1_pd(value) })
    }
}

/// Sine and cosine of four small angles.
#[inline(always)]
fn sin_cos_of_small(angles: __m128) -> [__m128; 2] {
    // SAFETY: AVX2 is there, see the module.
    let (sin, cos) = trig::sin_cos_of_small(F64x4(unsafe { _mm256_cvtps_pd(angles) }));
    // SAFETY: AVX2 is there, see the module.
    unsafe { [_mm256_cvtpd_ps(sin.0), _mm256_cvtpd_ps(cos.0)] }
}

/// Numbers of two rows, four each: the first four for `OFFSET` 0, the second four for 4.
///
/// # Safety
/// As for [`Lane::gather`].
#[inline(always)]
unsafe fn load_pair<const OFFSET: usize>(states: *const BodyState, low: RowPlace, high: RowPlace) -> __m256 {
    const { assert!(OFFSET == 0 || OFFSET == 4) };
    // SAFETY: AVX2 is there, see the module. The rows are, says the caller. A row
    // is eight numbers, aligned to 32 bytes, of which the offset leaves four, aligned to 16.
    unsafe {
        let low = low.of(states).add(OFFSET);
        let high = high.of(states).add(OFFSET);
        _mm256_insertf128_ps::<1>(_mm256_castps128_ps256(_mm_load_ps(low)), _mm_load_ps(high))
    }
}

/// Four numbers of each of eight rows, as four lanes.
///
/// # Safety
/// As for [`Lane::gather`].
#[inline(always)]
unsafe fn gather_half<const OFFSET: usize>(states: *const BodyState, rows: &[RowPlace; 8]) -> [F32x8; 4] {
    // SAFETY: the rows are there, says the caller.
    let pairs = unsafe {
        [
            load_pair::<OFFSET>(states, rows[0], rows[4]),
            load_pair::<OFFSET>(states, rows[1], rows[5]),
            load_pair::<OFFSET>(states, rows[2], rows[6]),
            load_pair::<OFFSET>(states, rows[3], rows[7]),
        ]
    };
    let [x, y, z, w] = transpose(pairs);
    [F32x8(x), F32x8(y), F32x8(z), F32x8(w)]
}

/// # Safety
/// As for [`Lane::gather`].
#[inline(always)]
unsafe fn gather(states: *const BodyState, rows: &[RowPlace; 8]) -> BodyState<F32x8> {
    // SAFETY: the rows are there, says the caller.
    unsafe { BodyState::of_numbers(gather_half::<0>(states, rows), gather_half::<4>(states, rows)) }
}

/// # Safety
/// As for [`Lane::gather`].
#[inline(always)]
unsafe fn gather_velocities(states: *const BodyState, rows: &[RowPlace; 8]) -> BodyState<F32x8> {
    // SAFETY: the rows are there, says the caller.
    BodyState::of_velocities(unsafe { gather_half::<0>(states, rows) })
}

/// Writes the velocities of the bodies that move to their rows: one bit of `moves` each.
///
/// # Safety
/// As for [`Lane::scatter_velocities`].
#[inline(always)]
unsafe fn scatter(states: *mut BodyState, rows: &[RowPlace; 8], state: &BodyState<F32x8>, moves: u32) {
    if moves == 0 {
        return;
    }
    let padding = F32x8::splat(0.0);
    let pairs = transpose([state.velocity.x.0, state.velocity.y.0, state.angular_velocity.0, padding.0]);
    // Usually all of them move: then eight jumps are saved.
    let all_move = moves == 0xFF;
    for (place, pair) in pairs.into_iter().enumerate() {
        let (low, high) = (rows[place], rows[place + 4]);
        // SAFETY: AVX2 is there, see the module. The rows are, says the caller. A
        // row begins with four numbers, aligned to 16 bytes.
        unsafe {
            if all_move || moves & 1 << place != 0 {
                _mm_store_ps(low.of(states).cast_mut(), _mm256_castps256_ps128(pair));
            }
            if all_move || moves & 1 << (place + 4) != 0 {
                _mm_store_ps(high.of(states).cast_mut(), _mm256_extractf128_ps::<1>(pair));
            }
        }
    }
}

/// Turns rows of four into columns, in each half on its own.
#[inline(always)]
fn transpose([r0, r1, r2, r3]: [__m256; 4]) -> [__m256; 4] {
    // SAFETY: AVX2 is there, see the module.
    unsafe {
        let (t0, t1) = (_mm256_unpacklo_ps(r0, r1), _mm256_unpackhi_ps(r0, r1));
        let (t2, t3) = (_mm256_unpacklo_ps(r2, r3), _mm256_unpackhi_ps(r2, r3));
        [
            _mm256_shuffle_ps::<0b01_00_01_00>(t0, t2),
            _mm256_shuffle_ps::<0b11_10_11_10>(t0, t2),
            _mm256_shuffle_ps::<0b01_00_01_00>(t1, t3),
            _mm256_shuffle_ps::<0b11_10_11_10>(t1, t3),
        ]
    }
}

impl Lane for F32x8 {
    const WIDTH: usize = 8;
    type Mask = Mask8;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        debug_check();
        // SAFETY: AVX2 is there, see the module.
        Self(unsafe { _mm256_set1_ps(value) })
    }

    #[inline(always)]
    fn load(column: &Column, place: usize) -> Self {
        debug_check();
        // SAFETY: AVX2 is there, see the module; the part is eight numbers, aligned as the column is.
        Self(unsafe { _mm256_load_ps(column.part::<8>(place).as_ptr()) })
    }

    #[inline(always)]
    fn store(self, column: &mut Column, place: usize) {
        // SAFETY: AVX2 is there, see the module; the part is eight numbers, aligned as the column is.
        unsafe { _mm256_store_ps(column.part_mut::<8>(place).as_mut_ptr(), self.0) }
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: AVX2 is there, see the module.
        Self(unsafe { _mm256_min_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: AVX2 is there, see the module.
        Self(unsafe { _mm256_max_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: AVX2 is there, see the module.
        Self(unsafe { _mm256_sqrt_ps(self.0) })
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        if Self::bits(Self::splat(SMALL).greater(self.abs())) != 0xFF {
            return each_alone(self);
        }
        // SAFETY: AVX2 is there, see the module.
        let halves = unsafe { [_mm256_castps256_ps128(self.0), _mm256_extractf128_ps::<1>(self.0)] };
        let [[low_sin, low_cos], [high_sin, high_cos]] =
            [sin_cos_of_small(halves[0]), sin_cos_of_small(halves[1])];
        // SAFETY: AVX2 is there, see the module.
        unsafe { (Self(_mm256_set_m128(high_sin, low_sin)), Self(_mm256_set_m128(high_cos, low_cos))) }
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Mask8 {
        // SAFETY: AVX2 is there, see the module.
        Mask8(unsafe { _mm256_cmp_ps::<_CMP_GT_OQ>(self.0, other.0) })
    }

    #[inline(always)]
    fn both(a: Mask8, b: Mask8) -> Mask8 {
        // SAFETY: AVX2 is there, see the module.
        Mask8(unsafe { _mm256_and_ps(a.0, b.0) })
    }

    #[inline(always)]
    fn select(mask: Mask8, yes: Self, no: Self) -> Self {
        // SAFETY: AVX2 is there, see the module.
        Self(unsafe { _mm256_blendv_ps(no.0, yes.0, mask.0) })
    }

    #[inline(always)]
    fn bits(mask: Mask8) -> u32 {
        // SAFETY: AVX2 is there, see the module.
        unsafe { _mm256_movemask_ps(mask.0) as u32 }
    }

    #[inline(always)]
    fn load_rows(states: &[BodyState], first: usize) -> BodyState<Self> {
        let states: &[BodyState; 8] = states[first..].first_chunk().expect("eight rows");
        // SAFETY: these are the rows of eight states.
        unsafe { gather(states.as_ptr(), const { &RowPlace::first() }) }
    }

    #[inline(always)]
    fn store_rows(states: &mut [BodyState], first: usize, state: &BodyState<Self>) {
        let states: &mut [BodyState; 8] = states[first..].first_chunk_mut().expect("eight rows");
        // One pointer for all: to borrow the states again would end the one before it.
        let states = states.as_mut_ptr();
        let firsts = transpose(state.first_numbers().map(|numbers| numbers.0));
        let seconds = transpose(state.second_numbers().map(|numbers| numbers.0));
        for (place, (first, second)) in firsts.into_iter().zip(seconds).enumerate() {
            // SAFETY: AVX2 is there, see the module. There are eight states of eight numbers, aligned to 32 bytes.
            unsafe {
                let low: *mut f32 = states.add(place).cast();
                let high: *mut f32 = states.add(place + 4).cast();
                _mm256_store_ps(low, _mm256_permute2f128_ps::<0x20>(first, second));
                _mm256_store_ps(high, _mm256_permute2f128_ps::<0x31>(first, second));
            }
        }
    }

    #[inline(always)]
    fn store_velocities(states: &mut [BodyState], first: usize, state: &BodyState<Self>) {
        let states: &mut [BodyState; 8] = states[first..].first_chunk_mut().expect("eight rows");
        // One pointer for all, as in `store_rows`.
        let states = states.as_mut_ptr();
        let pairs = transpose(state.first_numbers().map(|numbers| numbers.0));
        for (place, pair) in pairs.into_iter().enumerate() {
            // SAFETY: AVX2 is there, see the module. There are eight states, which begin with four numbers, aligned to 16
            // bytes.
            unsafe {
                _mm_store_ps(states.add(place).cast(), _mm256_castps256_ps128(pair));
                _mm_store_ps(states.add(place + 4).cast(), _mm256_extractf128_ps::<1>(pair));
            }
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
        let ([rows_a, rows_b], [a_moves, b_moves]) = (rows.part(place), rows.moves::<8>(place));
        // SAFETY: says the caller.
        unsafe {
            scatter(states, rows_a, a, a_moves);
            scatter(states, rows_b, b, b_moves);
        }
    }
}
