//! rustycs beside Box2D and Rapier: error, stability and speed, in one process.

mod check;
mod cli;
mod command;
mod contestant;
mod continuous;
mod engines;
mod error;
mod fingerprint;
mod footprint;
mod machine;
mod problems;
mod speed;
mod stability;
mod table;
mod words;

use std::process::ExitCode;

use rustycs_cases::{engine, scene};

fn main() -> ExitCode {
    cli::run()
}
