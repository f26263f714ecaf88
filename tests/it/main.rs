//! The large test binary: the laws of physics, every part of the interface, bad input, and the house itself.

mod allocation;
mod bad_input;
mod character;
mod closed_worlds;
mod compounds;
mod continuous;
mod ground;
mod house;
mod interface;
mod issues;
mod joints;
mod laws;
mod motion;
mod queries;
mod random_use;
#[cfg(feature = "report")]
mod report;
mod roles;
mod sleep;
mod slow_motion;
mod stability;

use rustycs_tests::support;
