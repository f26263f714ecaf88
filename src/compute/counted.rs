//! Numbers that count what is done with them.

use core::cell::Cell;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use crate::compute::{BodyState, Column, Lane, LaneRot, LaneVec2, RowPairs, Rows, Shared};

/// What was done for one number of a lane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Count {
    /// Operations: sums, products, quotients, roots, comparisons, choices.
    pub(crate) operations: u32,
    /// Bytes that were read from memory, and written to it.
    pub(crate) bytes: u32,
}

impl AddAssign for Count {
    fn add_assign(&mut self, other: Self) {
        self.operations += other.operations;
        self.bytes += other.bytes;
    }
}

thread_local! {
    static COUNT: Cell<Count> = const { Cell::new(Count { operations: 0, bytes: 0 }) };
}

/// What `work` does with [`Counted`] numbers.
pub(crate) fn count(work: impl FnOnce()) -> Count {
    COUNT.set(Count::default());
    work();
    COUNT.get()
}

fn note(operations: u32, bytes: usize) {
    let mut count = COUNT.get();
    count += Count { operations, bytes: bytes as u32 };
    COUNT.set(count);
}

/// A lane of one number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Counted(f32);

impl Counted {
    fn operation(result: f32) -> Self {
        note(1, 0);
        Self(result)
    }
}

macro_rules! operator {
    ($trait:ident, $name:ident) => {
        impl $trait for Counted {
            type Output = Self;
            fn $name(self, other: Self) -> Self {
                Self::operation(self.0.$name(other.0))
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        Self::operation(-self.0)
    }
}

/// Half a row is as much as is read or written at least.
const HALF_ROW: usize = size_of::<BodyState>() / 2;

fn counted(state: &BodyState) -> BodyState<Counted> {
    let [velocity, moved] = [state.velocity, state.delta_position]
        .map(|LaneVec2 { x, y }| LaneVec2 { x: Counted(x), y: Counted(y) });
    BodyState {
        velocity,
        angular_velocity: Counted(state.angular_velocity),
        padding: Counted(state.padding),
        delta_position: moved,
        delta_rotation: LaneRot { c: Counted(state.delta_rotation.c), s: Counted(state.delta_rotation.s) },
    }
}

impl Lane for Counted {
    const WIDTH: usize = 1;
    type Mask = bool;

    fn splat(value: f32) -> Self {
        Self(value)
    }

    fn load(column: &Column, place: usize) -> Self {
        note(0, size_of::<f32>());
        Self(column.get(place))
    }

    fn store(self, column: &mut Column, place: usize) {
        note(0, size_of::<f32>());
        column.set(place, self.0);
    }

    fn min(self, other: Self) -> Self {
        Self::operation(Lane::min(self.0, other.0))
    }

    fn max(self, other: Self) -> Self {
        Self::operation(Lane::max(self.0, other.0))
    }

    fn sqrt(self) -> Self {
        Self::operation(self.0.sqrt())
    }

    fn sin_cos(self) -> (Self, Self) {
        unreachable!("no sweep turns a body")
    }

    fn greater(self, other: Self) -> bool {
        note(1, 0);
        self.0 > other.0
    }

    fn both(a: bool, b: bool) -> bool {
        note(1, 0);
        a & b
    }

    fn select(mask: bool, yes: Self, no: Self) -> Self {
        Self::operation(if mask { yes.0 } else { no.0 })
    }

    fn bits(mask: bool) -> u32 {
        u32::from(mask)
    }

    fn load_rows(_: &[BodyState], _: usize) -> BodyState<Self> {
        unreachable!("sweeps gather rows")
    }

    fn store_rows(_: &mut [BodyState], _: usize, _: &BodyState<Self>) {
        unreachable!("sweeps scatter rows")
    }

    fn gather(states: &(impl Rows + ?Sized), rows: &RowPairs, place: usize) -> [BodyState<Self>; 2] {
        note(0, 4 * HALF_ROW);
        rows.get(place).map(|row| counted(&states.row(row)))
    }

    fn gather_velocities(
        states: &(impl Rows + ?Sized),
        rows: &RowPairs,
        place: usize,
    ) -> [BodyState<Self>; 2] {
        note(0, 2 * HALF_ROW);
        rows.get(place).map(|row| counted(&states.row(row)))
    }

    fn scatter_velocities(
        _: &Shared<'_, BodyState>,
        _: &RowPairs,
        _: usize,
        _: &[BodyState<Self>; 2],
        _: [bool; 2],
    ) {
        note(0, 2 * HALF_ROW);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operations_and_bytes_are_counted_and_each_count_is_of_its_own() {
        let mut column = Column::default();
        let found = count(|| {
            let x = Counted::load(&column, 3);
            let y = x * x + Counted::splat(2.0);
            Counted::select(y.greater(x), y, -x).store(&mut column, 3);
        });
        // Product, sum, comparison, negation, choice; a number read and one written.
        assert_eq!(found, Count { operations: 5, bytes: 8 });
        assert_eq!(count(|| ()), Count::default());
    }
}
