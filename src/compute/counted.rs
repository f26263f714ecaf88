//! Numbers that count what is done with them.

use core::cell::RefCell;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use crate::compute::{BodyState, Column, Lane, RowPairs};

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

/// What has been done so far, and which of the numbers that were loaded have been used.
#[derive(Debug, Default)]
struct Tally {
    count: Count,
    used: Vec<bool>,
}

thread_local! {
    static TALLY: RefCell<Tally> = RefCell::default();
}

/// What `work` does with [`Counted`] numbers.
pub(crate) fn count(work: impl FnOnce()) -> Count {
    TALLY.take();
    work();
    TALLY.take().count
}

fn note(operations: u32, bytes: usize) {
    TALLY.with_borrow_mut(|tally| tally.count += Count { operations, bytes: bytes as u32 });
}

/// A lane of one number. What is loaded counts once, when it is first used: no compiler loads what is not.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Counted {
    value: f32,
    /// Which of the loaded numbers it is, if it is as it was loaded.
    load: Option<usize>,
}

impl Counted {
    fn new(value: f32) -> Self {
        Self { value, load: None }
    }

    fn operation(result: f32) -> Self {
        note(1, 0);
        Self::new(result)
    }

    /// Its value, to do something with.
    fn used(self) -> f32 {
        if let Some(load) = self.load {
            TALLY.with_borrow_mut(|Tally { count, used }| {
                if !std::mem::replace(&mut used[load], true) {
                    count.bytes += size_of::<f32>() as u32;
                }
            });
        }
        self.value
    }
}

macro_rules! operator {
    ($trait:ident, $name:ident) => {
        impl $trait for Counted {
            type Output = Self;
            fn $name(self, other: Self) -> Self {
                Self::operation(self.used().$name(other.used()))
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
        Self::operation(-self.used())
    }
}

/// Half a row is as much as is read or written at least.
const HALF_ROW: usize = size_of::<BodyState>() / 2;

impl Lane for Counted {
    const WIDTH: usize = 1;
    type Mask = bool;

    fn splat(value: f32) -> Self {
        Self::new(value)
    }

    fn load(column: &Column, place: usize) -> Self {
        let load = TALLY.with_borrow_mut(|Tally { used, .. }| {
            used.push(false);
            used.len() - 1
        });
        Self { value: column.get(place), load: Some(load) }
    }

    fn store(self, column: &mut Column, place: usize) {
        note(0, size_of::<f32>());
        column.set(place, self.used());
    }

    fn min(self, other: Self) -> Self {
        Self::operation(Lane::min(self.used(), other.used()))
    }

    fn max(self, other: Self) -> Self {
        Self::operation(Lane::max(self.used(), other.used()))
    }

    fn sqrt(self) -> Self {
        Self::operation(self.used().sqrt())
    }

    fn sin_cos(self) -> (Self, Self) {
        unreachable!("no sweep turns a body")
    }

    fn greater(self, other: Self) -> bool {
        note(1, 0);
        self.used() > other.used()
    }

    fn both(a: bool, b: bool) -> bool {
        note(1, 0);
        a & b
    }

    fn select(mask: bool, yes: Self, no: Self) -> Self {
        let (yes, no) = (yes.used(), no.used());
        Self::operation(if mask { yes } else { no })
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

    fn store_velocities(_: &mut [BodyState], _: usize, _: &BodyState<Self>) {
        unreachable!("sweeps scatter rows")
    }

    unsafe fn gather(_: *const BodyState, _: &RowPairs, _: usize) -> [BodyState<Self>; 2] {
        note(0, 4 * HALF_ROW);
        [BodyState::at_rest(); 2]
    }

    unsafe fn gather_velocities(_: *const BodyState, _: &RowPairs, _: usize) -> [BodyState<Self>; 2] {
        note(0, 2 * HALF_ROW);
        [BodyState::at_rest(); 2]
    }

    unsafe fn scatter_velocities(_: *mut BodyState, _: &RowPairs, _: usize, _: &[BodyState<Self>; 2]) {
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
            let _unused = Counted::load(&column, 2);
            let x = Counted::load(&column, 3);
            let y = x * x + Counted::splat(2.0);
            Counted::select(y.greater(x), y, -x).store(&mut column, 3);
        });
        // Product, sum, comparison, negation, choice; a number read, however often it is used, and one written.
        assert_eq!(found, Count { operations: 5, bytes: 8 });
        assert_eq!(count(|| ()), Count::default());
    }
}
