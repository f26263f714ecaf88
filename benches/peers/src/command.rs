//! What the commands that write a page have in common: how they begin, how far they are, and how they end early.

use std::io;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use indicatif::{ProgressBar, ProgressStyle};

use crate::cli::SharedOptions;
use crate::engines;

/// Names the entries, each with its statement, if that is asked for; runs the command otherwise, if the engines are
/// built for a fair race. A command says whether it came to its end, and is to stop early, with what it has, when it is
/// asked to. The exit code is 130 if Ctrl-C ended it.
pub(crate) fn run<'a>(
    options: &SharedOptions,
    entries: impl Iterator<Item = (&'a str, &'a str)> + Clone,
    command: impl FnOnce(&dyn Fn() -> bool) -> io::Result<bool>,
) -> ExitCode {
    if options.list {
        let width = entries.clone().map(|(name, _)| name.len()).max().unwrap_or_default() + 1;
        for (name, statement) in entries {
            println!("{name:<width$} {statement}");
        }
        return ExitCode::SUCCESS;
    }
    if let Err(reason) = engines::fair_build() {
        eprintln!("{reason}");
        return ExitCode::FAILURE;
    }
    exit_code(&options.out, command)
}

/// Runs a command that says whether it came to its end, and that is to stop early, with what it has, when it is asked
/// to. The exit code is 130 if Ctrl-C ended it.
pub(crate) fn exit_code(
    folder: &Path,
    command: impl FnOnce(&dyn Fn() -> bool) -> io::Result<bool>,
) -> ExitCode {
    let is_stopped = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&is_stopped);
    if let Err(error) = ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed)) {
        eprintln!("Ctrl-C will end the program without a page: {error}");
    }
    match command(&|| is_stopped.load(Ordering::Relaxed)) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(130),
        Err(error) => {
            eprintln!("nothing could be written to {}: {error}", folder.display());
            ExitCode::FAILURE
        }
    }
}

/// Does tasks one after the other, with a bar that shows how much of their work is done and the name of the one at
/// hand. Whether it came to the end: it stops at a task that was not done.
///
/// # Errors
/// That of the first task that fails.
pub(crate) fn do_all<T>(
    tasks: &[T],
    work: impl Fn(&T) -> f64,
    name: impl Fn(&T) -> String,
    mut is_done: impl FnMut(&T) -> io::Result<bool>,
) -> io::Result<bool> {
    let mut progress = Progress::new(tasks.iter().map(&work).sum());
    for task in tasks {
        progress.say(name(task));
        if !is_done(task)? {
            return Ok(false);
        }
        progress.add(work(task));
    }
    Ok(true)
}

/// A bar that shows how much of some work is done. It goes when it is dropped.
#[derive(Debug)]
struct Progress {
    bar: ProgressBar,
    /// All that is to be done, and what is done.
    all: f64,
    done: f64,
}

impl Progress {
    const STEPS: f64 = 1000.0;

    fn new(all: f64) -> Self {
        let bar = ProgressBar::new(Self::STEPS as u64);
        // A style that is wrong would be a mistake here; the plain bar does as well.
        if let Ok(style) = ProgressStyle::with_template("{wide_bar} {percent:>3} %  {eta} left  {msg}") {
            bar.set_style(style);
        }
        Self { bar, all, done: 0.0 }
    }

    /// Says what is done now.
    fn say(&self, what: String) {
        self.bar.set_message(what);
    }

    /// So much more is done.
    fn add(&mut self, work: f64) {
        self.done += work;
        self.bar.set_position((self.done / self.all * Self::STEPS) as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
