//! Error against run time for the scenes of the demo; `--help` lists what can be asked.
//!
//! `cargo run --release --example error_report -- --scene tower --tolerance 1mm`

fn main() -> std::process::ExitCode {
    rustycs_report::run()
}
