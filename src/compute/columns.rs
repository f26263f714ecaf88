//! Structs of columns: what is stored for sixteen at a time, and computed with for as many as a lane holds.
//!
//! `struct X<C>` has numbers of the type `C`: `X<Column>` is how it is stored, `X<L>` how lanes compute with it, `X<f32>`
//! a single one. [`columns`] writes down once how one becomes the other.

use crate::compute::{Column, Lane, LaneVec2};

/// Columns, or a struct of columns.
pub(crate) trait Columns {
    /// As many of it as a lane holds.
    type In<L: Lane>;
    /// Those from `place` on, a multiple of the lane's width. What is not used of them is not read.
    fn load<L: Lane>(&self, place: usize) -> Self::In<L>;
    /// Writes those from `place` on, a multiple of the lane's width.
    fn store<L: Lane>(&mut self, place: usize, values: Self::In<L>);
}

impl Columns for Column {
    type In<L: Lane> = L;

    #[inline(always)]
    fn load<L: Lane>(&self, place: usize) -> L {
        L::load(self, place)
    }

    #[inline(always)]
    fn store<L: Lane>(&mut self, place: usize, values: L) {
        values.store(self, place);
    }
}

impl<C: Columns> Columns for [C; 2] {
    type In<L: Lane> = [C::In<L>; 2];

    #[inline(always)]
    fn load<L: Lane>(&self, place: usize) -> [C::In<L>; 2] {
        [self[0].load::<L>(place), self[1].load::<L>(place)]
    }

    #[inline(always)]
    fn store<L: Lane>(&mut self, place: usize, [first, second]: [C::In<L>; 2]) {
        self[0].store::<L>(place, first);
        self[1].store::<L>(place, second);
    }
}

/// Implements [`Columns`] for a `struct X<C>`, of which all fields are named.
macro_rules! columns {
    ($name:ident { $($field:ident),+ $(,)? }) => {
        impl $crate::compute::Columns for $name<$crate::compute::Column> {
            type In<L: $crate::compute::Lane> = $name<L>;

            #[inline(always)]
            fn load<L: $crate::compute::Lane>(&self, place: usize) -> $name<L> {
                $name { $($field: $crate::compute::Columns::load::<L>(&self.$field, place)),+ }
            }

            #[inline(always)]
            fn store<L: $crate::compute::Lane>(&mut self, place: usize, values: $name<L>) {
                $($crate::compute::Columns::store::<L>(&mut self.$field, place, values.$field);)+
            }
        }
    };
}
pub(crate) use columns;

columns!(LaneVec2 { x, y });
