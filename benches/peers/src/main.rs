//! rustycs beside Box2D and Rapier: error, stability and speed, in one process.

mod check;
mod engine;
mod engines;
mod scene;

use std::process::ExitCode;

fn main() -> ExitCode {
    let command = std::env::args().nth(1);
    let result = match command.as_deref() {
        Some("check") => check::check(),
        _ => engines::fair_build(),
    };
    if let Err(reason) = result {
        eprintln!("{reason}");
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}
