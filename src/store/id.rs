//! Public id types over [`Key`](super::Key).

/// Declares a public id: a `Key` with a type of its own, so that ids of different things do not mix.
macro_rules! id_type {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        ///
        /// Generational: when the thing is removed its id becomes stale for good and every look-up with it
        /// gives `None`, even after the place has been used again. `Option` of an id is as small as the id. Ids are ordered by
        /// how often their place had been used, then by place.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub(crate) $crate::store::Key);

        impl $name {
            /// The place of the thing: below how many there ever were at once, and no other has it as long as the thing is
            /// there. For a table beside the world, `things[id.index()]`; a place is used again after the thing was
            /// removed, which the id as a whole tells.
            pub fn index(self) -> usize {
                self.0.index() as usize
            }

            /// The id as one number, for keeping outside; [`from_bits`](Self::from_bits) brings it back.
            pub fn to_bits(self) -> u64 {
                self.0.to_bits()
            }

            /// The id that [`to_bits`](Self::to_bits) gave `bits` for, or `None` for a number it never gives.
            pub fn from_bits(bits: u64) -> Option<Self> {
                $crate::store::Key::from_bits(bits).map(Self)
            }
        }

        impl core::fmt::Debug for $name {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                write!(f, "{}({}v{})", stringify!($name), self.0.index(), self.0.generation())
            }
        }
    };
}
pub(crate) use id_type;
