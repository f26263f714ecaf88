//! The command `continuous`: what is thrown at walls, and how much of it passes through.

mod page;
mod picture;
mod rows;
mod trial;

use std::fs;
use std::io;
use std::process::ExitCode;

use crate::cli::{ContinuousOptions, is_asked_for};
use crate::command;
use crate::contestant::Contestant;
use crate::continuous::rows::Row;
use crate::continuous::trial::{FINENESSES, SPEEDS, THICKNESSES, THROWS, Throw, WORLDS, passes};
use crate::engines;
use crate::machine;
use crate::table::Table;

/// Runs what is asked for. The exit code is 130 if Ctrl-C ended it early.
pub(crate) fn run(options: &ContinuousOptions) -> ExitCode {
    let entries = THROWS.iter().map(|throw| (throw.name, throw.statement));
    command::run(&options.shared, entries, |is_stopped| throw_all(options, is_stopped))
}

/// What is thrown at a wall of some thickness, m, in an engine.
type Task<'a> = (&'static Throw, f64, &'a Contestant);

/// Whether all was thrown.
fn throw_all(options: &ContinuousOptions, is_stopped: &dyn Fn() -> bool) -> io::Result<bool> {
    let folder = &options.shared.out;
    fs::create_dir_all(folder.join("continuous"))?;
    let contestants: Vec<_> = engines::continuous().into_iter().map(Contestant::new).collect();
    let worlds = if options.quick { 2 } else { WORLDS };
    let trials = worlds * FINENESSES.len() as u32;
    let holds = |row: &Row| {
        let is_same = |one: &Contestant| one.is_of(&row.engine, &row.version, &row.behaviour);
        row.trials == trials && contestants.iter().any(is_same)
    };
    let mut table = Table::open(&folder.join("continuous.csv"), holds)?;
    let tasks = tasks(options, &contestants, table.rows());
    let begun = machine::now();
    let is_complete = command::do_all(
        &tasks,
        |_| 1.0,
        |(throw, thickness, contestant)| {
            format!("{} at {thickness} m in {}", throw.name, contestant.engine.name())
        },
        |&(throw, thickness, contestant)| {
            if is_stopped() {
                return Ok(false);
            }
            table.add(Row {
                throw: throw.name.into(),
                thickness,
                engine: contestant.engine.name().into(),
                version: contestant.engine.version(),
                behaviour: contestant.behaviour.clone(),
                trials,
                passed: count(throw, thickness, contestant, worlds),
                begun: begun.clone(),
            })?;
            Ok(true)
        },
    )?;
    page::write(folder, &contestants, &table.close()?)?;
    Ok(is_complete)
}

/// All that is asked for and not done.
fn tasks<'a>(options: &ContinuousOptions, contestants: &'a [Contestant], done: &[Row]) -> Vec<Task<'a>> {
    let wanted = THROWS.iter().filter(|throw| is_asked_for(&options.only, throw.name));
    let at_walls = wanted.flat_map(|throw| THICKNESSES.map(|thickness| (throw, thickness)));
    let all =
        at_walls.flat_map(|(throw, thickness)| contestants.iter().map(move |one| (throw, thickness, one)));
    let is_open = |(throw, thickness, contestant): &Task<'_>| {
        let is_of = |row: &Row| {
            row.throw == throw.name && row.thickness == *thickness && row.engine == contestant.engine.name()
        };
        options.shared.again || !done.iter().any(is_of)
    };
    all.filter(is_open).collect()
}

/// How many trials pass, by speed.
fn count(throw: &Throw, thickness: f64, contestant: &Contestant, worlds: u32) -> [u32; SPEEDS.len()] {
    SPEEDS.map(|speed| {
        let of = |fineness| {
            let is_passed =
                |&trial: &u32| passes(contestant.engine.as_ref(), throw, thickness, speed, fineness, trial);
            (0..worlds).filter(is_passed).count() as u32
        };
        FINENESSES.into_iter().map(of).sum()
    })
}
