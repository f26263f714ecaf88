//! rustycs beside Box2D and Rapier: error, stability and speed, in one process.

mod check;
mod cli;
mod engine;
mod engines;
mod error;
mod fingerprint;
mod machine;
mod problems;
mod scene;
mod speed;
mod table;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run()
}
