//! Containers the engine keeps its things in: slots with generational ids, a bit set, a set of pairs.
//!
//! All of them are deterministic: what they hold and in which order depends only on what was done to them.

mod bit_set;
mod id;
mod pair_set;
mod slots;

pub(crate) use bit_set::{BitSet, places_of};
pub(crate) use id::id_type;
pub(crate) use pair_set::PairSet;
pub(crate) use slots::{ChosenSlots, Key, Slots};
