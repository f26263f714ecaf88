//! The page: every figure on it, and every verdict, is computed from the rows.

use std::fmt::Write as _;
use std::path::Path;
use std::{fs, io};

use rustycs::report::Unit;
use rustycs_cases::stability::{COUNT, Case, Check, Group, Judge, Limit, SHARE, Seen};

use crate::engine::Engine;
use crate::stability::picture;
use crate::stability::rows::{Outcome, Row};
use crate::words::{circumstances, link, list};

/// A case, and what came out of it in each engine, in their order.
struct Entry<'a> {
    case: &'a Case,
    rows: Vec<Option<&'a Row>>,
}

impl<'a> Entry<'a> {
    fn outcome(&self, engine: usize) -> Option<&'a Outcome> {
        self.rows[engine].map(|row| &row.outcome)
    }

    fn verdict(&self, engine: usize) -> Option<bool> {
        self.outcome(engine)?.verdict()
    }

    /// Time of a step, in words.
    fn step_time(&self, engine: usize) -> String {
        let seconds = self.rows[engine].and_then(|row| row.step_seconds);
        seconds.map_or("–".into(), |seconds| Unit::Of("s".into()).figure(seconds))
    }
}

/// Writes the page into a folder.
pub(super) fn write(folder: &Path, cases: &[Case], engines: &[&dyn Engine], rows: &[Row]) -> io::Result<()> {
    let entries: Vec<Entry<'_>> = cases.iter().filter_map(|case| entry(case, engines, rows)).collect();
    if entries.is_empty() {
        println!("No case was played, so there is no page.");
        return Ok(());
    }
    let path = folder.join("STABILITY.md");
    fs::write(&path, page(folder, &entries, cases, engines, rows))?;
    println!("{}: {} cases", path.display(), entries.len());
    for (index, engine) in engines.iter().enumerate() {
        println!("{:>8}: {}", engine.name(), tally(&entries, index));
    }
    Ok(())
}

fn entry<'a>(case: &'a Case, engines: &[&dyn Engine], rows: &'a [Row]) -> Option<Entry<'a>> {
    let row =
        |engine: &&dyn Engine| rows.iter().find(|row| row.case == case.name && row.engine == engine.name());
    let rows: Vec<Option<&Row>> = engines.iter().map(row).collect();
    rows.iter().any(Option::is_some).then_some(Entry { case, rows })
}

/// A value in words.
fn figure(value: f64, unit: &str) -> String {
    if !value.is_finite() {
        return "no number".into();
    }
    match unit {
        SHARE => Unit::Part.figure(value),
        COUNT => value.to_string(),
        unit => Unit::Of(unit.into()).figure(value),
    }
}

fn limit(check: &Check) -> String {
    match check.limit {
        Limit::AtMost(limit) => format!("≤ {}", figure(limit, check.unit)),
        Limit::AtLeast(limit) => format!("≥ {}", figure(limit, check.unit)),
    }
}

/// What decides: the check that is farthest beyond its limit, or nearest to it.
fn decisive(checks: &[Check]) -> Option<&Check> {
    checks.iter().max_by(|one, other| one.strain().total_cmp(&other.strain()))
}

/// The verdict of an engine, with what decided it.
fn cell(outcome: Option<&Outcome>) -> String {
    match outcome {
        None => "–".into(),
        Some(Outcome::NotAsked) => "not asked".into(),
        Some(Outcome::Refused) => "refuses the shape".into(),
        Some(Outcome::Panicked) => "**✗** gave up".into(),
        Some(Outcome::Judged(checks)) => match decisive(checks) {
            Some(check) if !check.holds() => {
                format!("**✗** {}: {}", check.what, figure(check.value, check.unit))
            }
            _ => "✓".into(),
        },
    }
}

fn tally(entries: &[Entry<'_>], engine: usize) -> String {
    let verdicts: Vec<bool> = entries.iter().filter_map(|entry| entry.verdict(engine)).collect();
    let held = verdicts.iter().filter(|holds| **holds).count();
    let count =
        |wanted: &Outcome| entries.iter().filter(|entry| entry.outcome(engine) == Some(wanted)).count();
    let mut text = format!("{held} of {} hold", verdicts.len());
    for (outcome, what) in [(Outcome::Refused, "refused"), (Outcome::NotAsked, "not asked")] {
        let count = count(&outcome);
        if count > 0 {
            _ = write!(text, ", {count} {what}");
        }
    }
    text
}

fn page(
    folder: &Path,
    entries: &[Entry<'_>],
    cases: &[Case],
    engines: &[&dyn Engine],
    rows: &[Row],
) -> String {
    let mut text = String::from("# Stability on stiff and extreme cases: rustycs, Box2D, Rapier\n\n");
    text += "Written by `cargo run --release -p rustycs-peers -- stability`; the rows are in [stability.csv](stability.csv).\n\n";
    what_was_run(engines, rows, &mut text);
    in_short(entries, cases, engines, &mut text);
    how_to_read(&mut text);
    for group in Group::ALL {
        table(group, entries, engines, &mut text);
    }
    failures(entries, &mut text);
    one_by_one(folder, entries, engines, &mut text);
    text
}

fn what_was_run(engines: &[&dyn Engine], rows: &[Row], text: &mut String) {
    circumstances(engines.iter().map(|engine| engine.version()), text);
    let mut times: Vec<&str> = rows.iter().map(|row| row.begun.as_str()).collect();
    times.sort_unstable();
    let [first, .., last] = times.as_slice() else { return };
    _ = writeln!(text, "- Played from {first} to {last}, each case once.\n");
}

fn in_short(entries: &[Entry<'_>], cases: &[Case], engines: &[&dyn Engine], text: &mut String) {
    text.push_str("## In short\n\n");
    for (index, engine) in engines.iter().enumerate() {
        _ = writeln!(text, "- {}: {}.", engine.name(), tally(entries, index));
    }
    let is_absent = |case: &&Case| entries.iter().all(|entry| entry.case.name != case.name);
    let absent = list(cases.iter().filter(is_absent).map(|case| case.name.as_str()));
    if !absent.is_empty() {
        _ = writeln!(text, "- Not played: {absent}.");
    }
    text.push('\n');
}

fn how_to_read(text: &mut String) {
    text.push_str(
        "## How to read it\n\n\
         - Default settings, 60 Hz, 10 s, sleep off, unless a case says otherwise; what the engines have in common and what not \
         stands in `benches/peers/src/engines/mod.rs`.\n\
         - No limit is taken from what an engine does. Each case says from what law it follows. Where rest is asked for, all \
         engines are allowed the same: to sink by 1 % of the height, to drift by a thousandth of a body's size (by 1 % of the \
         height where a structure leans or stands by thrust), to overlap by a hundredth of it, and 1 mm/s, which grows with the root \
         of size and gravity.\n\
         - ✓: everything holds. **✗**: something does not; shown is what is farthest beyond its limit. \"refuses the shape\": the \
         engine takes no such body. \"not asked\": the case has no meaning for it, the case says why.\n\
         - The time is that of a step, the mean of all steps of the case, forces included, played once: good for its size, not for \
         its last digit.\n\n",
    );
}

fn table(group: Group, entries: &[Entry<'_>], engines: &[&dyn Engine], text: &mut String) {
    let of_group: Vec<&Entry<'_>> = entries.iter().filter(|entry| entry.case.group == group).collect();
    if of_group.is_empty() {
        return;
    }
    let names: Vec<&str> = engines.iter().map(|engine| engine.name()).collect();
    let name = group.name();
    _ = writeln!(text, "## {}{}\n", name[..1].to_uppercase(), &name[1..]);
    _ = writeln!(text, "| case | {} | time per step: {} |", names.join(" | "), names.join(" | "));
    _ = writeln!(text, "|---{}{}|", "|---".repeat(names.len()), "|---:".repeat(names.len()));
    for entry in of_group {
        let cells: Vec<String> = (0..engines.len()).map(|engine| cell(entry.outcome(engine))).collect();
        let times: Vec<String> = (0..engines.len()).map(|engine| entry.step_time(engine)).collect();
        _ = writeln!(text, "| {} | {} | {} |", link(&entry.case.name), cells.join(" | "), times.join(" | "));
    }
    text.push('\n');
}

/// Our own, with the reason, if there is one.
fn failures(entries: &[Entry<'_>], text: &mut String) {
    text.push_str("## Where rustycs fails, and why\n\n");
    let failed: Vec<&Entry<'_>> = entries.iter().filter(|entry| entry.verdict(0) == Some(false)).collect();
    if failed.is_empty() {
        text.push_str("Nowhere, by the cases above.\n");
    }
    for Entry { case, rows } in failed {
        let outcome = rows[0].map(|row| &row.outcome);
        let cause = if case.cause().is_empty() { "The cause is not known yet." } else { case.cause() };
        _ = writeln!(text, "- {}: {}. {cause}", link(&case.name), cell(outcome));
    }
    text.push('\n');
}

fn one_by_one(folder: &Path, entries: &[Entry<'_>], engines: &[&dyn Engine], text: &mut String) {
    text.push_str("## Case by case\n\n");
    for entry in entries {
        let Case { name, statement, judge, .. } = entry.case;
        _ = writeln!(text, "### {name}\n\n{statement}\n");
        if let Judge::Ours { why, .. } = judge {
            _ = writeln!(text, "Other engines are not asked: {why}.\n");
        }
        figures(entry, engines, text);
        pictures(folder, entry, engines, text);
    }
}

/// A line for each check, with what each engine has.
fn figures(entry: &Entry<'_>, engines: &[&dyn Engine], text: &mut String) {
    let checks = |engine: usize| match entry.outcome(engine) {
        Some(Outcome::Judged(checks)) => Some(checks),
        _ => None,
    };
    let judged: Vec<usize> = (0..engines.len()).filter(|&engine| checks(engine).is_some()).collect();
    let Some(first) = judged.first().and_then(|&engine| checks(engine)) else { return };
    let names: Vec<&str> = judged.iter().map(|&engine| engines[engine].name()).collect();
    _ = writeln!(text, "| what | limit | {} |\n|---|---{}|", names.join(" | "), "|---:".repeat(names.len()));
    for (index, check) in first.iter().enumerate() {
        let found = |&engine: &usize| match checks(engine).and_then(|checks| checks.get(index)) {
            Some(check) if check.holds() => figure(check.value, check.unit),
            Some(check) => format!("**{}**", figure(check.value, check.unit)),
            None => "–".into(),
        };
        let found: Vec<String> = judged.iter().map(found).collect();
        _ = writeln!(text, "| {} | {} | {} |", check.what, limit(check), found.join(" | "));
    }
    text.push('\n');
}

fn pictures(folder: &Path, entry: &Entry<'_>, engines: &[&dyn Engine], text: &mut String) {
    if entry.case.seen == Seen::No {
        return;
    }
    let of_engine = |engine: &&dyn Engine| {
        let path = picture::path(entry.case, engine.name());
        let is_there = folder.join(&path).exists();
        is_there.then(|| format!("![{} in {}]({})", entry.case.name, engine.name(), path.display()))
    };
    let pictures: Vec<String> = engines.iter().filter_map(of_engine).collect();
    if !pictures.is_empty() {
        _ = writeln!(text, "{}\n", pictures.join(" "));
    }
}
