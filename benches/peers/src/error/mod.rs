//! The command `error`: how wrong the engines are on problems with a known outcome, and how long they take for it.

mod compare;
mod measure;
mod page;
mod picture;
pub(crate) mod rows;
mod sweep;

use std::fs;
use std::io;
use std::process::ExitCode;

use rustycs::report::Unit;

use crate::cli::{ErrorOptions, is_asked_for};
use crate::command;
use crate::contestant::Contestant;
use crate::engine::{Engine, Fineness};
use crate::error::measure::Measured;
use crate::error::rows::Row;
use crate::machine;
use crate::problems::{self, Problem};
use crate::table::Table;

/// How often a row is timed at least where nothing is said: in a full run and in a quick one.
const REPEATS: [u32; 2] = [5, 3];

/// Runs what is asked for. The exit code is 130 if Ctrl-C ended it early.
pub(crate) fn run(options: &ErrorOptions) -> ExitCode {
    let problems = problems::all();
    let entries = problems.iter().map(|problem| (problem.name.as_str(), problem.statement.as_str()));
    command::run(&options.shared, entries, |is_stopped| compare_all(options, &problems, is_stopped))
}

/// A problem at a fineness, in the engines that have no row of it yet.
struct Task<'a> {
    problem: &'a Problem,
    fineness: Fineness,
    contestants: Vec<&'a Contestant>,
}

impl Task<'_> {
    fn work(&self) -> f64 {
        sweep::work(self.problem, self.fineness) * self.contestants.len() as f64
    }
}

/// Whether all was run.
fn compare_all(
    options: &ErrorOptions,
    problems: &[Problem],
    is_stopped: &dyn Fn() -> bool,
) -> io::Result<bool> {
    let folder = &options.shared.out;
    fs::create_dir_all(folder)?;
    let contestants = Contestant::all();
    let repeats = options.repeats.unwrap_or(REPEATS[usize::from(options.quick)]);
    let holds = |row: &Row| {
        let is_same = |one: &Contestant| one.is_of(&row.engine, &row.version, &row.behaviour);
        let problem = problems.iter().find(|problem| problem.name == row.problem);
        problem.is_some_and(|problem| rows::setup(problem) == row.setup) && contestants.iter().any(is_same)
    };
    let mut table = Table::open(&folder.join("error.csv"), holds)?;
    let tasks = tasks(options, problems, &contestants, table.rows(), repeats);
    let is_complete = measure(&tasks, &mut table, repeats, is_stopped)?;
    println!("{}: {} rows", table.path().display(), table.rows().len());
    let engines: Vec<&dyn Engine> = contestants.iter().map(|contestant| contestant.engine.as_ref()).collect();
    page::write(folder, problems, &engines, &table.close()?)?;
    Ok(is_complete)
}

/// What is to be run: all that is asked for and not done.
fn tasks<'a>(
    options: &ErrorOptions,
    problems: &'a [Problem],
    contestants: &'a [Contestant],
    done: &[Row],
    repeats: u32,
) -> Vec<Task<'a>> {
    let is_wanted = |problem: &&Problem| is_asked_for(&options.only, &problem.name);
    let mut tasks = Vec::new();
    for problem in problems.iter().filter(is_wanted) {
        for fineness in sweep::settings(problem, options.quick) {
            let is_open = |contestant: &&Contestant| {
                let name = contestant.engine.name();
                let is_it =
                    |row: &Row| row.problem == problem.name && row.engine == name && row.fineness == fineness;
                let is_done = done.iter().any(|row| is_it(row) && row.repeats >= repeats);
                options.engines.include(contestant.engine.as_ref()) && (options.shared.again || !is_done)
            };
            let contestants: Vec<&Contestant> = contestants.iter().filter(is_open).collect();
            if !contestants.is_empty() {
                tasks.push(Task { problem, fineness, contestants });
            }
        }
    }
    tasks
}

/// Measures all tasks and keeps their rows. Whether it came to the end.
fn measure(
    tasks: &[Task<'_>],
    table: &mut Table<Row>,
    repeats: u32,
    is_stopped: &dyn Fn() -> bool,
) -> io::Result<bool> {
    let begun = machine::now();
    let name = |task: &Task<'_>| format!("{} {}", task.problem.name, label(task.fineness));
    command::do_all(tasks, Task::work, name, |task| {
        let engines: Vec<&dyn Engine> = task.contestants.iter().map(|one| one.engine.as_ref()).collect();
        let measured = measure::measure(task.problem, &engines, task.fineness, repeats, is_stopped);
        let Some(measured) = measured else { return Ok(false) };
        for (contestant, measured) in task.contestants.iter().zip(&measured) {
            table.add(row(task, contestant, measured, repeats, &begun))?;
        }
        Ok(true)
    })
}

fn row(task: &Task<'_>, contestant: &Contestant, measured: &Measured, repeats: u32, begun: &str) -> Row {
    Row {
        problem: task.problem.name.clone(),
        setup: rows::setup(task.problem),
        engine: contestant.engine.name().into(),
        version: contestant.engine.version(),
        behaviour: contestant.behaviour.clone(),
        fineness: task.fineness,
        error: measured.error,
        unit: match &task.problem.unit {
            Unit::Part => String::new(),
            Unit::Of(unit) => unit.clone(),
        },
        run_time: measured.run_time(),
        runs: measured.runs(),
        repeats,
        begun: begun.into(),
    }
}

/// Ticks per second and substeps.
fn label(Fineness { tick_rate, substeps }: Fineness) -> String {
    format!("{tick_rate} Hz × {substeps}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::{EngineOptions, SharedOptions};
    use crate::engine::DEFAULT;
    use crate::engines;

    fn contestants() -> Vec<Contestant> {
        let contestant = |engine| Contestant { engine, behaviour: String::new() };
        engines::all().into_iter().map(contestant).collect()
    }

    /// What there is to do, as names, beside rows that were done with `repeats` runs each.
    fn open_tasks(
        options: &ErrorOptions,
        done: &[Row],
        repeats: u32,
    ) -> Vec<(String, Fineness, Vec<&'static str>)> {
        let (problems, contestants) = (problems::all(), contestants());
        let names = |task: &Task<'_>| task.contestants.iter().map(|one| one.engine.name()).collect();
        tasks(options, &problems, &contestants, done, repeats)
            .iter()
            .map(|task| (task.problem.name.clone(), task.fineness, names(task)))
            .collect()
    }

    #[test]
    fn what_was_done_is_not_run_again_unless_asked() {
        let slide = ErrorOptions { only: vec!["slide".into()], quick: true, ..ErrorOptions::default() };
        let all = open_tasks(&slide, &[], 3);
        assert!(all.iter().all(|(name, _, engines)| name == "slide" && engines.len() == 3), "{all:?}");
        let done = Row { fineness: DEFAULT, repeats: 3, ..rows::tests::row() };
        assert_eq!((done.problem.as_str(), done.engine.as_str()), ("slide", "Box2D"));
        let at_default = |tasks: &[(String, Fineness, Vec<&'static str>)]| {
            tasks.iter().find(|task| task.1 == DEFAULT).unwrap().2.clone()
        };
        let done = [done];
        assert_eq!(at_default(&open_tasks(&slide, &done, 3)), ["rustycs", "Rapier"]);
        assert_eq!(open_tasks(&slide, &done, 3).len(), all.len());
        assert_eq!(at_default(&open_tasks(&slide, &done, 4)).len(), 3, "more repeats are asked for");
        let again = ErrorOptions {
            shared: SharedOptions { again: true, ..SharedOptions::default() },
            ..slide.clone()
        };
        assert_eq!(at_default(&open_tasks(&again, &done, 3)).len(), 3);
        let one_engine = ErrorOptions { engines: EngineOptions { engines: vec!["box2d".into()] }, ..slide };
        assert!(
            open_tasks(&one_engine, &done, 3).iter().all(|task| task.1 != DEFAULT && task.2 == ["Box2D"])
        );
    }

    /// From the measurement to the page, at one setting and with a stop on the way.
    #[test]
    fn a_run_that_is_stopped_keeps_its_rows_and_the_next_one_goes_on() {
        let folder = std::env::temp_dir().join(format!("rustycs-peers-run-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let (problems, contestants) = (problems::all(), contestants());
        let options = ErrorOptions { only: vec!["head-on".into()], quick: true, ..ErrorOptions::default() };
        let path = folder.join("error.csv");
        let mut table = Table::open(&path, |_| true).unwrap();
        let before = tasks(&options, &problems, &contestants, table.rows(), 1);
        let calls = std::cell::Cell::new(0);
        let stop_soon = || {
            calls.set(calls.get() + 1);
            // Each task asks after three errors and after each timed run.
            calls.get() > 40
        };
        assert!(!measure(&before, &mut table, 1, &stop_soon).unwrap());
        let done = table.rows().len();
        drop(table);
        let mut table = Table::open(&path, |_| true).unwrap();
        assert_eq!(table.rows().len(), done);
        let after = tasks(&options, &problems, &contestants, table.rows(), 1);
        assert_eq!(after.len() + done / 3, before.len());
        assert!(measure(&after, &mut table, 1, &|| false).unwrap());
        let engines: Vec<&dyn Engine> = contestants.iter().map(|one| one.engine.as_ref()).collect();
        page::write(&folder, &problems, &engines, table.rows()).unwrap();
        let page = fs::read_to_string(folder.join("ERROR.md")).unwrap();
        assert!(page.contains("### head-on") && !page.contains("### oblique"), "{page}");
        assert!(fs::read_to_string(folder.join("error/head-on.svg")).unwrap().ends_with("</svg>\n"));
        fs::remove_dir_all(&folder).unwrap();
    }
}
