//! The command `stability`: stiff and extreme cases, each judged by statics or a law of conservation.

mod page;
mod picture;
mod rows;

use std::fs;
use std::io;
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use std::process::ExitCode;

use rustycs_cases::stability::{self, Case, Lab, Seen};

use crate::cli::{StabilityOptions, is_asked_for};
use crate::command;
use crate::contestant::Contestant;
use crate::engine::Engine;
use crate::machine;
use crate::stability::rows::{Outcome, Row};
use crate::table::Table;

/// Runs what is asked for. The exit code is 130 if Ctrl-C ended it early.
pub(crate) fn run(options: &StabilityOptions) -> ExitCode {
    let cases = stability::all();
    let entries = cases.iter().map(|case| (case.name.as_str(), case.statement.as_str()));
    command::run(&options.shared, entries, |is_stopped| judge_all(options, &cases, is_stopped))
}

/// Whether all was played.
fn judge_all(options: &StabilityOptions, cases: &[Case], is_stopped: &dyn Fn() -> bool) -> io::Result<bool> {
    let folder = &options.shared.out;
    fs::create_dir_all(folder.join("stability"))?;
    let contestants = Contestant::all();
    let holds = |row: &Row| {
        let is_same = |one: &Contestant| one.is_of(&row.engine, &row.version, &row.behaviour);
        let case = cases.iter().find(|case| case.name == row.case);
        case.is_some_and(|case| rows::setup(case) == row.setup) && contestants.iter().any(is_same)
    };
    let mut table = Table::open(&folder.join("stability.csv"), holds)?;
    let tasks = tasks(options, cases, &contestants, table.rows());
    let is_complete = play_all(&tasks, folder, &mut table, is_stopped)?;
    let engines: Vec<&dyn Engine> = contestants.iter().map(|contestant| contestant.engine.as_ref()).collect();
    page::write(folder, cases, &engines, &table.close()?)?;
    Ok(is_complete)
}

/// All that is asked for and not done.
fn tasks<'a>(
    options: &StabilityOptions,
    cases: &'a [Case],
    contestants: &'a [Contestant],
    done: &[Row],
) -> Vec<(&'a Case, &'a Contestant)> {
    let is_wanted =
        |case: &&Case| is_asked_for(&options.only, &case.name) && !(options.quick && case.is_long);
    let pairs =
        cases.iter().filter(is_wanted).flat_map(|case| contestants.iter().map(move |one| (case, one)));
    let is_open = |(case, contestant): &(&Case, &Contestant)| {
        let name = contestant.engine.name();
        let is_done = done.iter().any(|row| row.case == case.name && row.engine == name);
        options.engines.include(contestant.engine.as_ref()) && (options.shared.again || !is_done)
    };
    pairs.filter(is_open).collect()
}

/// How long a case takes, in arbitrary units.
fn work(case: &Case) -> f64 {
    case.seconds * (10 + case.scene.bodies.len()) as f64
}

/// Plays all tasks and keeps what came out. Whether it came to the end.
fn play_all(
    tasks: &[(&Case, &Contestant)],
    folder: &Path,
    table: &mut Table<Row>,
    is_stopped: &dyn Fn() -> bool,
) -> io::Result<bool> {
    let begun = machine::now();
    let name =
        |(case, contestant): &(&Case, &Contestant)| format!("{} in {}", case.name, contestant.engine.name());
    command::do_all(
        tasks,
        |(case, _)| work(case),
        name,
        |(case, contestant)| {
            if is_stopped() {
                return Ok(false);
            }
            let engine = contestant.engine.as_ref();
            let (outcome, step_seconds) = play(case, engine, folder)?;
            table.add(Row {
                case: case.name.clone(),
                setup: rows::setup(case),
                engine: engine.name().into(),
                version: engine.version(),
                behaviour: contestant.behaviour.clone(),
                outcome,
                step_seconds,
                begun: begun.clone(),
            })?;
            Ok(true)
        },
    )
}

/// Plays a case, and writes its picture if there is to be one. What came out, and the mean time of a step, s.
fn play(case: &Case, engine: &dyn Engine, folder: &Path) -> io::Result<(Outcome, Option<f64>)> {
    let mut lab = Lab::new(engine);
    let last = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let played = panic::catch_unwind(AssertUnwindSafe(|| case.play(&mut lab)));
    panic::set_hook(last);
    let outcome = match played {
        Ok(Some(checks)) => Outcome::Judged(checks),
        Ok(None) => Outcome::NotAsked,
        Err(_) if lab.is_refused() => Outcome::Refused,
        Err(_) => Outcome::Panicked,
    };
    if let (Outcome::Judged(_), Some(snapshot), true) = (&outcome, lab.seen(), case.seen != Seen::No) {
        let path = folder.join(picture::path(case, engine.name()));
        fs::write(path, picture::svg(case, snapshot, engine.name()))?;
    }
    Ok((outcome, lab.step_seconds()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::SharedOptions;

    /// From the cases to the page, with a stop on the way.
    #[test]
    fn a_run_that_is_stopped_keeps_its_rows_and_the_next_one_goes_on() {
        let folder = std::env::temp_dir().join(format!("rustycs-peers-stability-{}", std::process::id()));
        let only = ["mass-10", "arch", "restitution"].map(String::from).into();
        let shared = SharedOptions { out: folder.clone(), ..SharedOptions::default() };
        let options = StabilityOptions { only, quick: true, shared, ..StabilityOptions::default() };
        let cases = stability::all();
        let calls = std::cell::Cell::new(0);
        let stop_soon = || {
            calls.set(calls.get() + 1);
            calls.get() > 4
        };
        assert!(!judge_all(&options, &cases, &stop_soon).unwrap());
        let path = folder.join("stability.csv");
        assert_eq!(Table::<Row>::open(&path, |_| true).unwrap().rows().len(), 4);
        assert!(judge_all(&options, &cases, &|| false).unwrap());
        let table = Table::<Row>::open(&path, |_| true).unwrap();
        let of_case = |name: &str| table.rows().iter().filter(|row| row.case == name).count();
        assert_eq!([of_case("mass-10"), of_case("arch"), of_case("restitution-above-1")], [3; 3]);
        let page = fs::read_to_string(folder.join("STABILITY.md")).unwrap();
        assert!(page.contains("### arch\n") && page.contains("not asked"), "{page}");
        let picture = fs::read_to_string(folder.join("stability/arch-rustycs.svg")).unwrap();
        assert!(picture.ends_with("</svg>\n"));
        fs::remove_dir_all(&folder).unwrap();
    }
}
