//! The page: every figure on it, and every verdict, is computed from the rows.

use std::fmt::Write as _;
use std::path::Path;
use std::{fs, io};

use rustycs::report::Unit;

use crate::engine::Engine;
use crate::error::compare::{Comparison, InTime, Order, ROUNDING, Runs};
use crate::error::rows::Row;
use crate::error::{label, picture};
use crate::problems::{Class, Problem};
use crate::words::{self, circumstances, goes, link, list, spread};

/// What we hold ourselves to in the same time on smooth problems: this part of the best peer's error ...
const TENTH: f64 = 0.1;
/// ... and this order of convergence.
const SECOND: f64 = 1.9;

/// A problem and what was found.
struct Entry<'a> {
    problem: &'a Problem,
    comparison: Comparison<'a>,
}

impl Entry<'_> {
    /// All engines, in the order of tables.
    fn engines(&self) -> Vec<&Runs<'_>> {
        [&self.comparison.ours].into_iter().chain(&self.comparison.peers).collect()
    }

    /// An error in words.
    fn figure(&self, error: f64) -> String {
        if error.is_finite() { self.problem.unit.figure(error) } else { "lost".into() }
    }

    fn is_smooth(&self) -> bool {
        self.problem.class == Class::Smooth
    }

    /// Whether it is at most a tenth in the same time, or rounding; `None` if no peer was run.
    fn is_a_tenth(&self) -> Option<bool> {
        let small =
            |in_time: InTime| in_time.ours <= ROUNDING || in_time.ratio().is_none_or(|ratio| ratio <= TENTH);
        self.comparison.in_default_time().map(small)
    }

    /// Whether at default settings every engine is wrong by the whole.
    fn is_lost_by_all(&self) -> bool {
        let is_lost = |runs: &&Runs<'_>| runs.default_row().is_some_and(|row| row.error >= 1.0);
        self.problem.unit == Unit::Part && self.engines().iter().all(is_lost)
    }

    /// Whether our error at default settings is what we hold ourselves to; `None` if there is no such figure.
    fn meets_goal(&self) -> Option<bool> {
        Some(self.comparison.ours.default_row()?.error <= self.problem.goal?)
    }

    /// Where we fall short, by name.
    fn findings(&self) -> Vec<String> {
        let mut findings = Vec::new();
        if self.comparison.is_best_at_default() == Some(false) {
            findings.push("behind at default settings".into());
        }
        if self.meets_goal() == Some(false) {
            findings.push("not within the figure we hold ourselves to".into());
        }
        let ratio = |in_time: Option<InTime>| in_time.and_then(InTime::ratio).unwrap_or(0.0);
        let at_once = ratio(self.comparison.in_default_time());
        let is_beaten = at_once > 1.0;
        if is_beaten {
            findings.push(format!("{} times the better peer's error in the same time", factor(at_once)));
        } else if self.is_smooth() && self.is_a_tenth() == Some(false) {
            findings.push(format!(
                "{} of the better peer's error in the same time, not a tenth",
                factor(at_once)
            ));
        }
        if let Some(worst) =
            self.comparison.along_the_fronts().filter(|&worst| ratio(Some(worst)) > 1.0 && !is_beaten)
        {
            let time = Unit::Of("s".into()).figure(worst.time);
            findings.push(format!(
                "{} times its error in {time} per simulated second",
                factor(ratio(Some(worst)))
            ));
        }
        if self.is_smooth() && !self.is_of_second_order() {
            findings.push(match self.comparison.ours.order() {
                Order::Observed(order) => format!("of order {order:.1}"),
                Order::Rounding | Order::Unknown => "of no order that can be told".into(),
            });
        }
        findings
    }

    fn is_of_second_order(&self) -> bool {
        match self.comparison.ours.order() {
            Order::Observed(order) => order >= SECOND,
            Order::Rounding => true,
            Order::Unknown => false,
        }
    }
}

/// Writes the page and the plots into a folder.
pub(super) fn write(
    folder: &Path,
    problems: &[Problem],
    engines: &[&dyn Engine],
    rows: &[Row],
) -> io::Result<()> {
    let entries: Vec<Entry<'_>> =
        problems.iter().filter_map(|problem| entry(problem, engines, rows)).collect();
    if entries.is_empty() {
        println!("No row was done, so there is no page.");
        return Ok(());
    }
    let plots = folder.join("error");
    fs::create_dir_all(&plots)?;
    for entry in &entries {
        let svg = picture::chart(entry.problem, &entry.engines()).to_svg();
        fs::write(plots.join(format!("{}.svg", entry.problem.name)), svg)?;
    }
    let path = folder.join("ERROR.md");
    fs::write(&path, page(&entries, engines, rows))?;
    println!("{}: {} problems", path.display(), entries.len());
    Ok(())
}

/// The rows of a problem, by engine; the first engine is ours.
fn entry<'a>(problem: &'a Problem, engines: &[&'a dyn Engine], rows: &'a [Row]) -> Option<Entry<'a>> {
    let runs = |engine: &'a dyn Engine| {
        let is_one = |row: &&Row| row.problem == problem.name && row.engine == engine.name();
        Runs::new(engine.name(), rows.iter().filter(is_one).collect())
    };
    let mut all: Vec<Runs<'a>> = engines.iter().map(|&engine| runs(engine)).collect();
    if all.iter().all(|runs| runs.rows.is_empty()) {
        return None;
    }
    let ours = all.remove(0);
    Some(Entry { problem, comparison: Comparison { ours, peers: all } })
}

fn page(entries: &[Entry<'_>], engines: &[&dyn Engine], rows: &[Row]) -> String {
    let mut text = String::from("# Error against run time: rustycs, Box2D, Rapier\n\n");
    text += "Written by `cargo run --release -p rustycs-peers -- error`; the rows are in [error.csv](error.csv).\n\n";
    what_was_run(engines, rows, &mut text);
    in_short(entries, &mut text);
    how_to_read(&mut text);
    at_default(entries, &mut text);
    in_equal_time(entries, &mut text);
    orders(entries, &mut text);
    losses(entries, &mut text);
    one_by_one(entries, &mut text);
    text
}

fn what_was_run(engines: &[&dyn Engine], rows: &[Row], text: &mut String) {
    circumstances(engines.iter().map(|engine| engine.version()), text);
    let when = goes(rows.iter().map(|row| row.begun.as_str()));
    _ = writeln!(
        text,
        "- {} rows, {when}. The engines take turns in one process; a run time is the least of {} or more, of whole runs \
         with forces and without the making of the world. The middle one is at most {} longer in half of the rows, which \
         tells how quiet the machine was.\n",
        rows.len(),
        rows.iter().map(|row| row.runs).min().unwrap_or_default(),
        spread(rows.iter().map(|row| row.run_time)),
    );
}

/// How many problems keep to something, and the names of those that do not.
fn tally<'a>(what: &str, entries: &[&'a Entry<'a>], holds: impl Fn(&Entry<'a>) -> bool) -> String {
    words::tally(what, entries.iter().map(|entry| (entry.problem.name.as_str(), holds(entry))))
}

fn in_short(entries: &[Entry<'_>], text: &mut String) {
    text.push_str("## In short\n\n");
    let compared: Vec<&Entry<'_>> =
        entries.iter().filter(|entry| entry.comparison.at_default().is_some()).collect();
    if compared.is_empty() {
        text.push_str("- No peer was run at default settings.\n");
    } else {
        beside_peers(compared, text);
    }
    for entry in entries {
        let (Some(goal), Some(row)) = (entry.problem.goal, entry.comparison.ours.default_row()) else {
            continue;
        };
        let verdict = if entry.meets_goal() == Some(true) { "within" } else { "**not** within" };
        let (found, goal, name) = (entry.figure(row.error), entry.figure(goal), &entry.problem.name);
        _ = writeln!(
            text,
            "- `{name}`: {found} at default settings, {verdict} the {goal} we hold ourselves to."
        );
    }
    text.push('\n');
}

/// What we hold ourselves to, on the problems that a peer was run on too.
fn beside_peers(compared: Vec<&Entry<'_>>, text: &mut String) {
    let is_best = |entry: &Entry<'_>| entry.comparison.is_best_at_default() == Some(true);
    _ = writeln!(
        text,
        "- At default settings the error of rustycs is no larger than that of the better peer on {}.",
        tally("problems", &compared, is_best)
    );
    let lost = compared.iter().filter(|entry| entry.is_lost_by_all());
    let lost = list(lost.map(|entry| entry.problem.name.as_str()));
    if !lost.is_empty() {
        _ = writeln!(text, "- At default settings none of the three comes through {lost}.");
    }
    let smooth: Vec<&Entry<'_>> = compared.into_iter().filter(|entry| entry.is_smooth()).collect();
    _ = writeln!(
        text,
        "- In the same time it is at most a tenth of that of the better peer on {}.",
        tally("smooth problems", &smooth, |entry| entry.is_a_tenth() == Some(true))
    );
    _ = writeln!(
        text,
        "- Its observed order of convergence is at least {SECOND}, or all its errors are rounding, on {}.",
        tally("smooth problems", &smooth, Entry::is_of_second_order)
    );
}

fn how_to_read(text: &mut String) {
    let rounding = Unit::Part.figure(ROUNDING);
    _ = writeln!(
        text,
        "## How to read it\n\n\
         - **Error** is that of a whole run against the closed form or a reference in `f64`, as a part of the scale that \
         is named with each problem, or in metres. \"lost\": the run came to nothing. Errors up to {rounding} are \
         rounding of `f32` and rank alike.\n\
         - **Default settings**: 60 Hz and 4 substeps, which all three have.\n\
         - **In the same time**: an engine may take any of its settings that take no longer. Between two settings of a \
         peer's front we draw a straight line (in logarithms) and grant it the error there; we count by settings that \
         were run. Shown is the worst for us of three times: those that the engines take at their defaults. \"Along the \
         fronts\" is the worst for us of the times of all settings on the fronts of the peers, from our fastest setting \
         on.\n\
         - **Order** p: the error falls as the p-th power of the length of a substep. Fitted to the rows, for each number \
         of substeps from the longest substep down to the best, or to the first whose error is less than ten times the \
         least of the engine, or rounding; without errors of 30 % and more. \"rounding\": all errors are. –: fewer than \
         three such rows.\n"
    );
}

/// The heading of a group in a table.
fn class_name(class: Class) -> &'static str {
    match class {
        Class::Smooth => "smooth",
        Class::Impact => "collisions",
        Class::Hard => "rest, and hard cases",
    }
}

/// A table with a line for each problem, in groups.
fn table(
    heading: &str,
    entries: &[Entry<'_>],
    text: &mut String,
    line: impl Fn(&Entry<'_>) -> Option<Vec<String>>,
) {
    let columns = heading.matches('|').count() - 1;
    _ = writeln!(text, "{heading}\n|---|{}", "---:|".repeat(columns - 1));
    let mut last = None;
    for entry in entries {
        let Some(cells) = line(entry) else { continue };
        if last != Some(entry.problem.class) {
            last = Some(entry.problem.class);
            _ = writeln!(text, "| *{}* {}", class_name(entry.problem.class), "|".repeat(columns));
        }
        _ = writeln!(text, "| {} | {} |", link(&entry.problem.name), cells.join(" | "));
    }
    text.push('\n');
}

/// A factor with two digits.
fn factor(value: f64) -> String {
    match value {
        0.0 => "0".into(),
        value if !value.is_finite() => "∞".into(),
        value if value < 0.01 => format!("{value:.0e}"),
        value if value < 0.995 => format!("{value:.2}"),
        value if value < 9.95 => format!("{value:.1}"),
        value if value < 9999.5 => format!("{value:.0}"),
        value => format!("{value:.0e}"),
    }
}

fn at_default(entries: &[Entry<'_>], text: &mut String) {
    text.push_str("## Errors at default settings\n\nThe last column: how many times larger the error of the better peer is.\n\n");
    table("| problem | rustycs | Box2D | Rapier | times |", entries, text, |entry| {
        let [ours, theirs] = entry.comparison.at_default()?;
        let mut cells: Vec<String> = entry
            .engines()
            .iter()
            .map(|runs| runs.default_row().map_or("–".into(), |row| entry.figure(row.error)))
            .collect();
        let is_best = entry.comparison.is_best_at_default() == Some(true);
        cells.push(match (ours <= ROUNDING, theirs <= ROUNDING) {
            (true, true) => "rounding".into(),
            _ if is_best => factor(theirs / ours),
            _ => format!("**{}**", factor(theirs / ours)),
        });
        Some(cells)
    });
}

fn in_equal_time(entries: &[Entry<'_>], text: &mut String) {
    text.push_str(
        "## Errors in the same time\n\nTime per simulated second; error of rustycs and of the better peer in that time; the \
         first as a part of the second; and the worst of that along the fronts.\n\n",
    );
    table("| problem | time | rustycs | better peer | part | along the fronts |", entries, text, |entry| {
        let InTime { time, ours, theirs } = entry.comparison.in_default_time()?;
        let part = |in_time: Option<InTime>, limit: f64| match in_time.map(InTime::ratio) {
            None => "–".into(),
            Some(None) => "rounding".into(),
            Some(Some(ratio)) if ratio <= limit => factor(ratio),
            Some(Some(ratio)) => format!("**{}**", factor(ratio)),
        };
        let limit = if entry.is_smooth() { TENTH } else { 1.0 };
        Some(vec![
            Unit::Of("s".into()).figure(time),
            entry.figure(ours),
            entry.figure(theirs),
            part(entry.comparison.in_default_time(), limit),
            part(entry.comparison.along_the_fronts(), limit),
        ])
    });
}

fn orders(entries: &[Entry<'_>], text: &mut String) {
    text.push_str("## Orders of convergence\n\n");
    table("| problem | rustycs | Box2D | Rapier |", entries, text, |entry| {
        let cell = |runs: &&Runs<'_>| match runs.order() {
            Order::Observed(order) => format!("{order:.2}"),
            Order::Rounding => "rounding".into(),
            Order::Unknown => "–".into(),
        };
        Some(entry.engines().iter().map(cell).collect())
    });
}

fn losses(entries: &[Entry<'_>], text: &mut String) {
    text.push_str("## Where we fall short, and why\n\n");
    let mut is_any = false;
    for entry in entries {
        let findings = entry.findings();
        if !findings.is_empty() {
            is_any = true;
            let Problem { name, note, .. } = entry.problem;
            _ = writeln!(text, "- {}: {}. {note}", link(name), findings.join("; "));
        }
    }
    if !is_any {
        text.push_str("Nowhere, by the measures above.\n");
    }
    text.push('\n');
}

fn one_by_one(entries: &[Entry<'_>], text: &mut String) {
    text.push_str("## Problem by problem\n\n");
    for entry in entries {
        let Problem { name, statement, measure, .. } = entry.problem;
        _ = writeln!(text, "### {name}\n\n{statement} Error: {measure}.\n");
        _ = writeln!(text, "![Error against run time, {name}](error/{name}.svg)\n");
        text.push_str(
            "| | default | run time per s | best | at | run time per s |\n|---|---:|---:|---:|---|---:|\n",
        );
        for runs in entry.engines() {
            let time = |row: &Row| Unit::Of("s".into()).figure(row.run_time[0]);
            let [default, default_time] = runs
                .default_row()
                .map_or(["–", "–"].map(String::from), |row| [entry.figure(row.error), time(row)]);
            let [best, at, best_time] =
                runs.best_row().map_or(["–", "–", "–"].map(String::from), |row| {
                    [entry.figure(row.error), label(row.fineness), time(row)]
                });
            _ = writeln!(
                text,
                "| {} | {default} | {default_time} | {best} | {at} | {best_time} |",
                runs.engine
            );
        }
        text.push('\n');
    }
}
