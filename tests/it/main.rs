//! One test binary: the laws of physics, twins of fast paths, determinism, bad input, and the house itself.

mod allocation;
mod bad_input;
mod character;
mod closed_worlds;
mod compounds;
mod continuous;
mod determinism;
mod golden;
mod ground;
mod house;
mod interface;
mod issues;
mod joints;
mod lanes;
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
mod support;
mod threads;
mod twins;
