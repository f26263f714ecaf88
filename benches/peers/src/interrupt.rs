//! How far a long command is, and how it ends early.

use std::io;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use indicatif::{ProgressBar, ProgressStyle};

/// Runs a command that says whether it came to its end, and that is to stop early, with what it has, when it is asked to.
/// The exit code is 130 if Ctrl-C ended it.
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

/// A bar that shows how much of some work is done. It goes when it is dropped.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
    /// All that is to be done.
    work: f64,
}

impl Progress {
    const STEPS: f64 = 1000.0;

    pub(crate) fn new(work: f64) -> Self {
        let bar = ProgressBar::new(Self::STEPS as u64);
        // A style that is wrong would be a mistake here; the plain bar does as well.
        if let Ok(style) = ProgressStyle::with_template("{wide_bar} {percent:>3} %  {eta} left  {msg}") {
            bar.set_style(style);
        }
        Self { bar, work }
    }

    /// Says what is done now.
    pub(crate) fn say(&self, what: String) {
        self.bar.set_message(what);
    }

    /// So much is done.
    pub(crate) fn done(&self, work: f64) {
        self.bar.set_position((work / self.work * Self::STEPS) as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
