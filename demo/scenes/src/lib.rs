//! The scenes.
