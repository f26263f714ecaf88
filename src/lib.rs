//! rustycs: 2D rigid-body physics.
pub mod math;
pub(crate) mod store;
