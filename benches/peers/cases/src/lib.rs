//! Scenes in words that every engine understands, the engines' common face, how deep bodies are in each other, and hard
//! cases with what must hold in each. The program beside it runs them in other engines too; the tests of rustycs run
//! them in rustycs.

pub mod chance;
pub mod engine;
mod ours;
pub mod overlap;
pub mod scene;
pub mod stability;

pub use ours::Rustycs;
