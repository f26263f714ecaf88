//! rustycs beside Box2D and Rapier: error, stability and speed, in one process.

mod check;
mod cli;
mod engines;
mod error;
mod fingerprint;
mod footprint;
mod interrupt;
mod machine;
mod problems;
mod speed;
mod stability;
mod table;

use std::process::ExitCode;

use rustycs_cases::{engine, scene};

fn main() -> ExitCode {
    cli::run()
}
