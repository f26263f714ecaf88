//! The command line.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};

use crate::engine::Engine;
use crate::speed::{self, scenes};
use crate::{check, continuous, engines, error, footprint, problems, stability};

/// rustycs beside Box2D and Rapier.
#[derive(Debug, Parser)]
#[command(name = "rustycs-peers", version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Proves that the engines are set up to solve the same problem, and built for a fair race.
    Check,
    /// Measures how wrong the engines are on problems with a known outcome, and how long they take for it, over a
    /// range of settings. Writes error.csv, ERROR.md and a plot for each problem.
    Error(ErrorOptions),
    /// Measures how long steps take in large scenes and in everyday ones, beside the overlap and the energy that the
    /// engines end with. Writes speed.csv, SPEED.md and two plots. Only scenes that this very program has measured
    /// count as run before.
    Speed(SpeedOptions),
    /// Plays stiff and extreme cases in the engines and judges each by statics or a law of conservation. Writes
    /// stability.csv, STABILITY.md and pictures of how the cases end.
    Stability(StabilityOptions),
    /// Throws bodies at walls, at all speeds, and counts what passes. Writes continuous.csv, CONTINUOUS.md and a map for each
    /// engine.
    Continuous(ContinuousOptions),
    /// Counts instructions, memory, allocations, and what it takes to build a small program. Writes FOOTPRINT.md.
    Footprint(FootprintOptions),
}

/// Options of every command that writes a page.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct SharedOptions {
    /// Runs again what was run before.
    #[arg(long)]
    pub(crate) again: bool,

    /// Where to write; what is found there, and still holds, is not run again.
    #[arg(long, value_name = "DIR", default_value = "benches/results")]
    pub(crate) out: PathBuf,

    /// Names what there is to run, with what happens or must hold in each, and runs nothing.
    #[arg(long, display_order = 0)]
    pub(crate) list: bool,
}

/// Which engines are run.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct EngineOptions {
    /// The engines to run: rustycs, box2d, rapier.
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = engine_name)]
    pub(crate) engines: Vec<String>,
}

impl EngineOptions {
    /// Whether an engine is asked for, by name or as one of all.
    pub(crate) fn include(&self, engine: &dyn Engine) -> bool {
        self.engines.is_empty() || self.engines.contains(&engine.name().to_lowercase())
    }
}

/// Options of the command `error`.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct ErrorOptions {
    /// Runs fewer settings, each timed less often, and not the dearest problems.
    #[arg(long)]
    pub(crate) quick: bool,

    /// The problems to run: names, or how they begin (`stack` for all stacks).
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = problem_name)]
    pub(crate) only: Vec<String>,

    #[command(flatten)]
    pub(crate) engines: EngineOptions,

    /// How often each row is timed at least: 5, or 3 in a quick run, if nothing is said.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) repeats: Option<u32>,

    #[command(flatten)]
    pub(crate) shared: SharedOptions,
}

/// Options of the command `speed`.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct SpeedOptions {
    /// Runs each scene less often, and not the largest.
    #[arg(long)]
    pub(crate) quick: bool,

    /// The scenes to run: names, or how they begin (`pile` for all sizes of the pile).
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = scene_name)]
    pub(crate) only: Vec<String>,

    /// How often each scene is run: 5 times, or twice in a quick run, if nothing is said.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) repeats: Option<u32>,

    #[command(flatten)]
    pub(crate) shared: SharedOptions,
}

/// Options of the command `stability`.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct StabilityOptions {
    /// Leaves out what takes many seconds.
    #[arg(long)]
    pub(crate) quick: bool,

    /// The cases to play: names, or how they begin (`stack` for all stacks).
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = case_name)]
    pub(crate) only: Vec<String>,

    #[command(flatten)]
    pub(crate) engines: EngineOptions,

    #[command(flatten)]
    pub(crate) shared: SharedOptions,
}

/// Options of the command `continuous`.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct ContinuousOptions {
    /// Runs a tenth of the trials.
    #[arg(long)]
    pub(crate) quick: bool,

    /// What to throw: names, or how they begin (`spinning` for all that spins).
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    pub(crate) only: Vec<String>,

    #[command(flatten)]
    pub(crate) shared: SharedOptions,
}

/// Whether something by this name is asked for, by one of these beginnings of names or, where there are none, as one of
/// all.
pub(crate) fn is_asked_for(only: &[String], name: &str) -> bool {
    only.is_empty() || only.iter().any(|beginning| name.starts_with(beginning))
}

/// Options of the command `footprint`.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct FootprintOptions {
    /// Leaves out the cold builds, which take minutes, and counts fewer steps.
    #[arg(long)]
    pub(crate) quick: bool,

    /// Where to write the page.
    #[arg(long, value_name = "DIR", default_value = "benches/results")]
    pub(crate) out: PathBuf,

    /// Does one measurement in this process, which the command starts for it: what, engine, scene and steps.
    #[arg(long, hide = true, num_args = 4)]
    pub(crate) alone: Vec<String>,
}

/// The beginning of some problem's name.
fn problem_name(name: &str) -> Result<String, String> {
    beginning(name, "problems", problems::all().into_iter().map(|problem| problem.name))
}

/// The beginning of some scene's name.
fn scene_name(name: &str) -> Result<String, String> {
    beginning(name, "scenes", scenes::all().into_iter().map(|course| course.name))
}

/// The beginning of some case's name.
fn case_name(name: &str) -> Result<String, String> {
    beginning(name, "cases", rustycs_cases::stability::all().into_iter().map(|case| case.name))
}

/// A name, if one of these begins with it.
fn beginning(name: &str, what: &str, names: impl Iterator<Item = String>) -> Result<String, String> {
    let names: Vec<String> = names.collect();
    if !name.is_empty() && names.iter().any(|full| full.starts_with(name)) {
        Ok(name.into())
    } else {
        Err(format!("the {what} are {}", names.join(", ")))
    }
}

/// The name of an engine, whatever its capitals.
fn engine_name(name: &str) -> Result<String, String> {
    let names: Vec<String> = engines::all().iter().map(|engine| engine.name().to_lowercase()).collect();
    let name = name.to_lowercase();
    if names.contains(&name) { Ok(name) } else { Err(format!("the engines are {}", names.join(", "))) }
}

/// Reads the command line and does what it asks. The exit code is 130 if Ctrl-C ended it early.
pub(crate) fn run() -> ExitCode {
    match Cli::parse().command {
        Command::Check => match check::check() {
            Ok(()) => ExitCode::SUCCESS,
            Err(reason) => {
                eprintln!("{reason}");
                ExitCode::FAILURE
            }
        },
        Command::Error(options) => error::run(&options),
        Command::Speed(options) => speed::run(&options),
        Command::Stability(options) => stability::run(&options),
        Command::Continuous(options) => continuous::run(&options),
        Command::Footprint(options) => footprint::run(&options),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn what_is_run_goes_by_the_beginning_of_its_name_and_engines_by_any_capitals() {
        assert!(problem_name("stack").is_ok() && scene_name("pile").is_ok() && case_name("arch").is_ok());
        assert!(problem_name("tack").is_err() && problem_name("").is_err());
        assert_eq!(engine_name("Box2D"), Ok("box2d".into()));
        assert!(engine_name("bullet").is_err());
    }
}
