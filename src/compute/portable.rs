//! Four numbers side by side, for processors without a file of their own.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::compute::{BodyState, Column, Lane, LaneRot, LaneVec2, RowPairs, each_alone};

#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub(crate) struct F32x4([f32; 4]);

/// Where it holds.
type Mask4 = [bool; 4];

/// Does to each pair of numbers what `f32` does.
#[inline(always)]
fn each(a: F32x4, b: F32x4, operation: impl Fn(f32, f32) -> f32) -> F32x4 {
    F32x4(core::array::from_fn(|place| operation(a.0[place], b.0[place])))
}

macro_rules! operator {
    ($trait:ident, $name:ident) => {
        impl $trait for F32x4 {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                each(self, other, $trait::$name)
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl Neg for F32x4 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(Neg::neg))
    }
}

/// Four states, as four lanes.
#[inline(always)]
fn transpose(states: [BodyState; 4]) -> BodyState<F32x4> {
    let lane = |number: fn(&BodyState) -> f32| F32x4(states.each_ref().map(number));
    let velocities = [
        lane(|state| state.velocity.x),
        lane(|state| state.velocity.y),
        lane(|state| state.angular_velocity),
        F32x4::splat(0.0),
    ];
    let deltas = [
        lane(|state| state.delta_position.x),
        lane(|state| state.delta_position.y),
        lane(|state| state.delta_rotation.c),
        lane(|state| state.delta_rotation.s),
    ];
    BodyState::of_numbers(velocities, deltas)
}

impl Lane for F32x4 {
    const WIDTH: usize = 4;
    type Mask = Mask4;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self([value; 4])
    }

    #[inline(always)]
    fn load(column: &Column, place: usize) -> Self {
        Self(*column.part(place))
    }

    #[inline(always)]
    fn store(self, column: &mut Column, place: usize) {
        *column.part_mut(place) = self.0;
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        each(self, other, Lane::min)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        each(self, other, Lane::max)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f32::sqrt))
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        each_alone(self)
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Mask4 {
        core::array::from_fn(|place| self.0[place] > other.0[place])
    }

    #[inline(always)]
    fn both(a: Mask4, b: Mask4) -> Mask4 {
        core::array::from_fn(|place| a[place] & b[place])
    }

    #[inline(always)]
    fn select(mask: Mask4, yes: Self, no: Self) -> Self {
        Self(core::array::from_fn(|place| f32::select(mask[place], yes.0[place], no.0[place])))
    }

    #[inline(always)]
    fn bits(mask: Mask4) -> u32 {
        (0..4).fold(0, |bits, place| bits | u32::from(mask[place]) << place)
    }

    #[inline(always)]
    fn load_rows(states: &[BodyState], first: usize) -> BodyState<Self> {
        transpose(*states[first..].first_chunk().expect("four rows"))
    }

    #[inline(always)]
    fn store_rows(states: &mut [BodyState], first: usize, state: &BodyState<Self>) {
        Self::store_velocities(states, first, state);
        for (number, to) in states[first..first + 4].iter_mut().enumerate() {
            let LaneVec2 { x, y } = state.delta_position;
            to.delta_position = LaneVec2 { x: x.0[number], y: y.0[number] };
            let LaneRot { c, s } = state.delta_rotation;
            to.delta_rotation = LaneRot { c: c.0[number], s: s.0[number] };
        }
    }

    #[inline(always)]
    fn store_velocities(states: &mut [BodyState], first: usize, state: &BodyState<Self>) {
        for (number, to) in states[first..first + 4].iter_mut().enumerate() {
            to.velocity = LaneVec2 { x: state.velocity.x.0[number], y: state.velocity.y.0[number] };
            to.angular_velocity = state.angular_velocity.0[number];
        }
    }

    #[inline(always)]
    unsafe fn gather(states: *const BodyState, rows: &RowPairs, place: usize) -> [BodyState<Self>; 2] {
        rows.part::<4>(place).map(|rows| {
            // SAFETY: says the caller.
            transpose(rows.map(|row| unsafe { *states.add(row.row() as usize) }))
        })
    }

    #[inline(always)]
    unsafe fn gather_velocities(
        states: *const BodyState,
        rows: &RowPairs,
        place: usize,
    ) -> [BodyState<Self>; 2] {
        // SAFETY: says the caller.
        let pair = unsafe { Self::gather(states, rows, place) };
        pair.map(|BodyState { velocity, angular_velocity, padding, .. }| {
            BodyState::of_velocities([velocity.x, velocity.y, angular_velocity, padding])
        })
    }

    #[inline(always)]
    unsafe fn scatter_velocities(
        states: *mut BodyState,
        rows: &RowPairs,
        place: usize,
        pair: &[BodyState<Self>; 2],
    ) {
        let rows_and_moves = rows.part::<4>(place).into_iter().zip(rows.moves::<4>(place));
        for ((rows, moves), state) in rows_and_moves.zip(pair) {
            for (number, &row) in rows.iter().enumerate().filter(|&(number, _)| moves & 1 << number != 0) {
                // SAFETY: says the caller.
                unsafe {
                    let to = states.add(row.row() as usize);
                    (*to).velocity =
                        LaneVec2 { x: state.velocity.x.0[number], y: state.velocity.y.0[number] };
                    (*to).angular_velocity = state.angular_velocity.0[number];
                }
            }
        }
    }
}
