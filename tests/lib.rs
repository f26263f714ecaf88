//! What both test binaries need: `it`, the laws of physics and the use of the library, and `bits`, that the bits of a run hang on
//! nothing but its inputs. This package holds the tests, so that the library has no development dependencies.

#[allow(clippy::missing_panics_doc)] // A test panics where something is wrong.
pub mod support;
