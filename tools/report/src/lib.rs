//! Error against run time for the scenes of the demo.
//!
//! ```text
//! cargo run --release --example error_report -- --scene tower --tolerance 1mm
//! ```
//!
//! A library with an example for its only program, so that `cargo run` goes on to mean the demo. Ctrl-C ends it early;
//! what is done by then is shown and written.

mod cli;

use std::ops::ControlFlow;
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::Instant;
use std::{fs, io};

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use rustycs::Settings;
use rustycs::report::{Progress, Report, Row, Study, StudyError};

use crate::cli::{Cli, Tolerance};

/// Seconds since the first call.
fn clock() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_secs_f64()
}

/// The tick rates and numbers of substeps to run, and how often each is timed.
fn sweep(is_quick: bool) -> (&'static [f32], &'static [u32], u32) {
    if is_quick {
        (&[30.0, 60.0, 120.0], &[1, 4], 1)
    } else {
        (&[30.0, 60.0, 120.0, 240.0], &[1, 2, 4, 8], 3)
    }
}

fn study(cli: &Cli) -> Result<Report, StudyError> {
    const STEPS: u64 = 1000;
    let is_stopped = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&is_stopped);
    if let Err(error) = ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed)) {
        eprintln!("Ctrl-C will end the program without a report: {error}");
    }
    let bar = ProgressBar::new(STEPS);
    // A style that is wrong would be a mistake here; the plain bar does as well.
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} {percent:>3} %  {eta} left  {msg}") {
        bar.set_style(style);
    }
    let progress = |progress: &Progress<'_>| {
        bar.set_position((progress.done * STEPS as f64) as u64);
        bar.set_message(progress.label.to_string());
        if is_stopped.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let (tick_rates, substeps, repeats) = sweep(cli.quick);
    let scene = cli.scene;
    let report = Study::with_seeds(cli.seeds.iter().copied(), |seed, settings| scene.build(seed, settings))
        .name(scene.name)
        .before_each_tick(|world| scene.before_tick(world))
        .duration(cli.duration)
        .measure(cli.measure.measure())
        .tick_rates(tick_rates.iter().copied())
        .substeps(substeps.iter().copied())
        .also(
            "plain",
            tick_rates.iter().map(|&tick_rate| Settings {
                tick_rate,
                adaptive: false,
                ..Settings::default()
            }),
        )
        .also("classic", tick_rates.iter().map(|&tick_rate| Settings { tick_rate, ..Settings::classic() }))
        .repeats(repeats)
        .clock(clock)
        .progress(progress)
        .run();
    bar.finish_and_clear();
    report
}

fn write(report: &Report, folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    for (ending, text) in [("csv", report.to_csv()), ("md", report.to_markdown()), ("svg", report.to_svg())] {
        let path = folder.join(format!("{}.{ending}", report.name()));
        fs::write(&path, text)?;
        println!("written: {}", path.display());
    }
    Ok(())
}

/// What to choose, in a sentence.
fn choice(report: &Report, tolerance: Tolerance) -> String {
    let Tolerance { value, unit } = tolerance;
    let measure = report.measure();
    if unit.is_some_and(|unit| unit != report.unit()) {
        let unit = if report.unit().is_empty() { "a part of 1 or per cent" } else { report.unit() };
        return format!("The {measure} is in {unit}: give --tolerance in that for a recommendation.");
    }
    let allowed = report.with_unit(value);
    let Some(row) = report.recommend(value) else {
        let best = report.rows().iter().map(Row::bound).fold(f64::INFINITY, f64::min);
        let best = report.with_unit(best);
        return format!("None of these settings is known to be within {allowed}; the best is within {best}.");
    };
    let Settings { tick_rate, substeps, .. } = row.settings;
    let name = row.name.as_deref().map_or(String::new(), |name| format!(" ({name})"));
    let bound = report.with_unit(row.bound());
    let time = row
        .run_time
        .map_or(String::new(), |time| format!(", for {:.3} ms per simulated second", time.least * 1e3));
    format!(
        "Take tick_rate: {tick_rate:?}, substeps: {substeps}{name}: the {measure} is {bound} at most, where \
         {allowed} is allowed{time}."
    )
}

/// Reads the command line and does what it asks. The exit code is 130 if Ctrl-C ended the study early.
pub fn run() -> ExitCode {
    let cli = Cli::parse();
    if cli.list {
        for scene in rustycs_scenes::all() {
            println!("{:<14} {}", scene.name, scene.summary);
        }
        return ExitCode::SUCCESS;
    }
    let report = match study(&cli) {
        Ok(report) => report,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    };
    println!("{}", report.to_markdown());
    println!("{}", choice(&report, cli.tolerance));
    if let Some(Err(error)) = cli.out.as_deref().map(|folder| write(&report, folder)) {
        eprintln!("the report could not be written: {error}");
        return ExitCode::FAILURE;
    }
    if report.is_complete() { ExitCode::SUCCESS } else { ExitCode::from(130) }
}
