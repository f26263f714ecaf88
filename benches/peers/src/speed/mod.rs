//! The command `speed`: how long a step takes, beside the overlap and the energy that the engines end with.

mod floor;
mod measure;
mod page;
mod picture;
mod rows;
pub(crate) mod scenes;

use std::fs;
use std::io;
use std::process::ExitCode;

use crate::cli::{SpeedOptions, is_asked_for};
use crate::command;
use crate::engine::Engine;
use crate::engines;
use crate::machine;
use crate::scene::Kind;
use crate::table::Table;
use rows::Row;
use scenes::Course;

/// How often a scene is run where nothing is said: in a full run and in a quick one.
const REPEATS: [u32; 2] = [5, 2];

/// Runs what is asked for. The exit code is 130 if Ctrl-C ended it early.
pub(crate) fn run(options: &SpeedOptions) -> ExitCode {
    let courses = scenes::all();
    let entries = courses.iter().map(|course| (course.name.as_str(), course.statement.as_str()));
    command::run(&options.shared, entries, |is_stopped| race_all(options, &courses, is_stopped))
}

/// Whether all was run.
fn race_all(options: &SpeedOptions, courses: &[Course], is_stopped: &dyn Fn() -> bool) -> io::Result<bool> {
    let folder = &options.shared.out;
    fs::create_dir_all(folder)?;
    let engines = engines::all();
    let engines: Vec<&dyn Engine> = engines.iter().map(Box::as_ref).collect();
    let repeats = options.repeats.unwrap_or(REPEATS[usize::from(options.quick)]);
    let holds =
        |row: &Row| courses.iter().any(|course| course.name == row.scene && rows::setup(course) == row.setup);
    let mut table = Table::open(&folder.join("speed.csv"), holds)?;
    let is_complete = measure(options, courses, &engines, &mut table, repeats, is_stopped)?;
    println!("{}: {} rows", table.path().display(), table.rows().len());
    page::write(folder, courses, &table.close()?)?;
    Ok(is_complete)
}

/// Measures what is asked for and was not measured by this program before. Whether it came to the end.
fn measure(
    options: &SpeedOptions,
    courses: &[Course],
    engines: &[&dyn Engine],
    table: &mut Table<Row>,
    repeats: u32,
    is_stopped: &dyn Fn() -> bool,
) -> io::Result<bool> {
    let (build, begun) = (rows::build(), machine::now());
    let is_done = |course: &Course| {
        let is_it = |row: &Row, engine: &dyn Engine| {
            row.scene == course.name
                && row.engine == engine.name()
                && row.build == build
                && row.repeats >= repeats
        };
        engines.iter().all(|&engine| table.rows().iter().any(|row| is_it(row, engine)))
    };
    let is_wanted = |course: &&Course| {
        // What is named is run in a quick run too.
        let is_left_out = options.quick && course.is_dear && options.only.is_empty();
        is_asked_for(&options.only, &course.name)
            && !is_left_out
            && (options.shared.again || !is_done(course))
    };
    let tasks: Vec<&Course> = courses.iter().filter(is_wanted).collect();
    command::do_all(
        &tasks,
        |course| work(course),
        |course| course.name.clone(),
        |course| {
            let Some(measured) = measure::measure(course, engines, repeats, is_stopped) else {
                return Ok(false);
            };
            let shares = stages(course);
            for (engine, measured) in engines.iter().zip(&measured) {
                let is_ours = engine.name() == engines[0].name();
                table.add(Row {
                    scene: course.name.clone(),
                    setup: rows::setup(course),
                    engine: engine.name().into(),
                    version: engine.version(),
                    lanes: engines::BOX2D_LANES.into(),
                    build: build.clone(),
                    bodies: bodies(course),
                    step_time: measured.step_time(course),
                    end: measured.end,
                    stages: if is_ours { shares.clone() } else { String::new() },
                    repeats,
                    begun: begun.clone(),
                })?;
            }
            Ok(true)
        },
    )
}

/// The share of each stage in the time of our step.
fn stages(course: &Course) -> String {
    let stages = measure::stages(course);
    let all: f64 = stages.iter().map(|(_, seconds)| seconds).sum();
    // Where all sleep no stage runs.
    let all = all.max(f64::MIN_POSITIVE);
    let shares = stages.iter().map(|(name, seconds)| format!("{name} {:.0}", 100.0 * seconds / all));
    shares.collect::<Vec<_>>().join(" ")
}

/// Dynamic bodies.
fn bodies(course: &Course) -> usize {
    course.scene.bodies.iter().filter(|body| body.kind == Kind::Dynamic).count()
}

/// Bodies times ticks: to tell how far the command is.
fn work(course: &Course) -> f64 {
    bodies(course) as f64 * f64::from(course.warm_up + course.ticks)
}
