//! The tests are in `it`, one binary; this package only holds them, so that the library has no development
//! dependencies.
