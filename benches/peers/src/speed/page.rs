//! The page: every figure on it, and every verdict, is computed from the rows.

use std::fmt::Write as _;
use std::path::Path;
use std::{fs, io};

use rustycs::Lanes;
use rustycs::report::{Unit, Work};

use super::floor::{Floor, Peaks, floor};
use super::picture;
use super::rows::Row;
use super::scenes::{Course, CourseKind};
use crate::engines;
use crate::words::{self, circumstances, goes, middle, spread};

/// What we hold ourselves to: at most this part of the time of Box2D for SSE2 in every scene, ...
const EVERY: f64 = 0.8;
/// ... this part of it in the middle one, ...
const MIDDLE: f64 = 0.65;
/// ... and no more time than the other peers.
const OTHERS: f64 = 1.0;
/// What could bounce, and mostly does not, costs at most this times as much as what cannot, ...
const BOUNCY: f64 = 1.05;
/// ... and of such scenes the middle one takes at most this part of the time of Box2D.
const BOUNCY_MIDDLE: f64 = 0.68;
/// What is solved directly takes at most so many times as long as by the sweeps of Box2D.
const STRUCTURE: f64 = 2.0;
/// An overlap up to this, m, is rest, which soft contacts have by design: below it engines rank alike.
const REST: f64 = 2e-3;

/// A scene and its rows, measured in turn in one go: rustycs, Box2D, Rapier.
pub(super) struct Entry<'a> {
    pub(super) course: &'a Course,
    pub(super) rows: Vec<&'a Row>,
}

impl Entry<'_> {
    /// Our time as a part of that of a peer.
    fn ratio(&self, peer: usize) -> f64 {
        self.rows[0].step_time[0] / self.rows[peer].step_time[0]
    }

    /// Whether our mean overlap at the end is not larger than that of a peer, but for rest.
    fn is_as_tidy(&self, peer: usize) -> bool {
        let mean = |row: usize| self.rows[row].end.overlap.mean;
        mean(0) <= mean(peer).max(REST)
    }
}

/// The scenes that all engines have rows of, with Box2D for these lanes.
fn entries<'a>(courses: &'a [Course], rows: &'a [Row], lanes: &str) -> Vec<Entry<'a>> {
    let names: Vec<&str> = engines::all().iter().map(|engine| engine.name()).collect();
    let entry = |course: &'a Course| {
        let row = |name: &&str| {
            rows.iter().find(|row| row.scene == course.name && row.engine == *name && row.lanes == lanes)
        };
        let rows = names.iter().map(row).collect::<Option<Vec<&Row>>>()?;
        Some(Entry { course, rows })
    };
    courses.iter().filter_map(entry).collect()
}

/// Writes the page and the plots into a folder.
pub(super) fn write(folder: &Path, courses: &[Course], rows: &[Row]) -> io::Result<()> {
    let mut lanes: Vec<&str> = rows.iter().map(|row| row.lanes.as_str()).collect();
    lanes.sort_unstable();
    lanes.dedup();
    // The narrower first: it is what people get if they ask for nothing.
    lanes.reverse();
    let builds = lanes.iter().map(|lanes| (*lanes, entries(courses, rows, lanes)));
    let builds: Vec<(&str, Vec<Entry<'_>>)> = builds.filter(|(_, entries)| !entries.is_empty()).collect();
    let Some((_, first)) = builds.first() else {
        println!("No row was done, so there is no page.");
        return Ok(());
    };
    let plots = folder.join("speed");
    fs::create_dir_all(&plots)?;
    fs::write(plots.join("overlap.svg"), picture::overlaps(first).to_svg())?;
    let sizes = entries_of(first, &CourseKind::Size);
    fs::write(plots.join("size.svg"), picture::sizes(&sizes).to_svg())?;
    let path = folder.join("SPEED.md");
    fs::write(&path, page(&builds, first, rows))?;
    println!("{}: {} scenes", path.display(), first.len());
    Ok(())
}

fn entries_of<'a>(entries: &[Entry<'a>], kind: &CourseKind) -> Vec<Entry<'a>> {
    let of_kind = entries.iter().filter(|entry| entry.course.kind == *kind);
    of_kind.map(|entry| Entry { course: entry.course, rows: entry.rows.clone() }).collect()
}

/// The page of all builds of Box2D; what is said of one build only is said of the first.
fn page(builds: &[(&str, Vec<Entry<'_>>)], first: &[Entry<'_>], rows: &[Row]) -> String {
    let mut text = String::from("# Time of a step: rustycs, Box2D, Rapier\n\n");
    text += "Written by `cargo run --release -p rustycs-peers -- speed`, with `--features avx2` for Box2D with lanes of \
             eight; the rows are in [speed.csv](speed.csv).\n\n";
    what_was_run(rows, &mut text);
    for (lanes, entries) in builds {
        in_short(lanes, entries, &mut text);
    }
    how_to_read(&mut text);
    for (lanes, entries) in builds {
        times(lanes, entries, &mut text);
    }
    structures(first, &mut text);
    materials(first, &mut text);
    for (lanes, entries) in builds {
        ends(lanes, entries, &mut text);
    }
    growth(first, &mut text);
    stages(first, &mut text);
    floors(first, &mut text);
    text += "![Overlap against time by scene](speed/overlap.svg)\n\n## The scenes\n\n";
    for entry in first {
        let Course { name, statement, warm_up, ticks, .. } = entry.course;
        _ = writeln!(text, "- `{name}`: {statement} {ticks} ticks, after {warm_up} that are not timed.");
    }
    text
}

fn what_was_run(rows: &[Row], text: &mut String) {
    let mut versions: Vec<&str> = Vec::new();
    for row in rows {
        if !versions.contains(&row.version.as_str()) {
            versions.push(&row.version);
        }
    }
    circumstances(versions, text);
    _ = writeln!(
        text,
        "- rustycs asks the processor what lanes it has, and solves up to {} contacts at a time here.",
        Lanes::Auto.count()
    );
    let when = goes(rows.iter().map(|row| row.begun.as_str()));
    _ = writeln!(
        text,
        "- {} rows, {when}, {} runs each or more. The three engines of a scene take turns in one process, on one thread, \
         at 60 Hz with 4 substeps. The middle run is longer than the least by at most {} in half of the rows, which tells \
         how quiet the machine was.\n",
        rows.len(),
        rows.iter().map(|row| row.repeats).min().unwrap_or_default(),
        spread(rows.iter().map(|row| row.step_time)),
    );
}

/// On how many scenes something holds, and the names of those where it does not.
fn tally<'a>(entries: &'a [Entry<'a>], holds: impl Fn(&Entry<'a>) -> bool) -> String {
    let verdicts = entries.iter().map(|entry| (entry.course.name.as_str(), holds(entry)));
    format!("on {}", words::tally("scenes", verdicts))
}

fn in_short(lanes: &str, entries: &[Entry<'_>], text: &mut String) {
    // What we hold ourselves to is said of the build of Box2D that people get if they ask for nothing.
    let most = if lanes == "AVX2" { OTHERS } else { EVERY };
    let entries = &plain(entries);
    if entries.is_empty() {
        return;
    }
    let box2d = entries.iter().map(|entry| entry.ratio(1)).collect();
    let rapier = entries.iter().map(|entry| entry.ratio(2)).collect();
    _ = writeln!(text, "## In short, with Box2D for {lanes}\n");
    _ = writeln!(
        text,
        "- Time of rustycs: in the middle scene {} of that of Box2D{}, and {} of that of Rapier.",
        factor(middle(box2d)),
        if lanes == "AVX2" { String::new() } else { format!(" (we want {MIDDLE})") },
        factor(middle(rapier)),
    );
    _ = writeln!(
        text,
        "- It is at most {most} of that of Box2D {}.",
        tally(entries, |entry| entry.ratio(1) <= most)
    );
    _ = writeln!(
        text,
        "- It is no longer than that of Rapier {}.",
        tally(entries, |entry| entry.ratio(2) <= OTHERS)
    );
    for (peer, name) in [(1, "Box2D"), (2, "Rapier")] {
        _ = writeln!(
            text,
            "- Its mean overlap at the end is no larger than that of {name}, or at most {}, {}.",
            Unit::Of("m".into()).figure(REST),
            tally(entries, |entry| entry.is_as_tidy(peer))
        );
    }
    text.push('\n');
}

/// The scenes that are solved by sweeps, but for those that are another one with other materials.
fn plain<'a>(entries: &[Entry<'a>]) -> Vec<Entry<'a>> {
    let is_plain = |entry: &&Entry<'_>| {
        !matches!(entry.course.kind, CourseKind::Material { .. } | CourseKind::Structure)
    };
    let own = entries.iter().filter(is_plain);
    own.map(|entry| Entry { course: entry.course, rows: entry.rows.clone() }).collect()
}

/// What it costs to solve directly.
fn structures(entries: &[Entry<'_>], text: &mut String) {
    let structures = entries_of(entries, &CourseKind::Structure);
    if structures.is_empty() {
        return;
    }
    _ = writeln!(
        text,
        "## Structures\n\nWhat bears great loads rustycs solves directly. It takes at most {STRUCTURE} times as long as Box2D {}:\n",
        tally(&structures, |entry| entry.ratio(1) <= STRUCTURE)
    );
    for entry in &structures {
        _ = writeln!(text, "- `{}`: {} of Box2D.", entry.course.name, factor(entry.ratio(1)));
    }
    text.push('\n');
}

/// What the same scene costs with other materials.
fn materials(entries: &[Entry<'_>], text: &mut String) {
    let same = |entry: &Entry<'_>| match &entry.course.kind {
        CourseKind::Material { of } => entries.iter().position(|other| other.course.name == *of),
        _ => None,
    };
    let pairs: Vec<(&Entry<'_>, &Entry<'_>)> =
        entries.iter().filter_map(|entry| Some((entry, &entries[same(entry)?]))).collect();
    if pairs.is_empty() {
        return;
    }
    let factor_of = |(with, without): &(&Entry<'_>, &Entry<'_>), row: usize| {
        with.rows[row].step_time[0] / without.rows[row].step_time[0]
    };
    let tally = |holds: &dyn Fn(&(&Entry<'_>, &Entry<'_>)) -> bool| {
        words::tally("scenes", pairs.iter().map(|pair| (pair.0.course.name.as_str(), holds(pair))))
    };
    _ = writeln!(
        text,
        "## What could bounce\n\nThe same scenes with the default material, and with a material of its own for each body. \
         \"Of its own\": the time as a part of that of the same scene and engine where nothing bounces.\n\n\
         - Time of rustycs: at most {BOUNCY} of its own on {}.\n\
         - It is at most {EVERY} of that of Box2D on {}; in the middle scene {} (we want {BOUNCY_MIDDLE}).\n\n\
         | scene | rustycs, of its own | Box2D, of its own | Rapier, of its own | of Box2D | of Rapier |\n|---|{}",
        tally(&|pair| factor_of(pair, 0) <= BOUNCY),
        tally(&|pair| pair.0.ratio(1) <= EVERY),
        factor(middle(pairs.iter().map(|pair| pair.0.ratio(1)).collect())),
        "---:|".repeat(5)
    );
    for pair in &pairs {
        _ = writeln!(
            text,
            "| `{}` | {} | {} | {} | {} | {} |",
            pair.0.course.name,
            factor(factor_of(pair, 0)),
            factor(factor_of(pair, 1)),
            factor(factor_of(pair, 2)),
            factor(pair.0.ratio(1)),
            factor(pair.0.ratio(2)),
        );
    }
    text.push('\n');
}

fn how_to_read(text: &mut String) {
    text.push_str(
        "## How to read it\n\n\
         - **Time** of a step: runs are timed in 50 parts; of each part the least over all runs counts, as the same part \
         does the same work in every run. \"Middle\": of whole runs. Ratios carry over from machine to machine; times do \
         not.\n\
         - **Overlap** is found from outlines and poses alone, in `f64`, by the code of this command: the deepest of all, \
         and the mean over the bodies of the deepest that each has.\n\
         - **Energy** at the end, kinetic and potential counted from the lowest floor, as a part of that at the start; and \
         the kinetic part of a body. A pile that sinks into itself has less; a stack that stands has 1 and nothing \
         kinetic.\n\
         - The parts of a drum are kinematic bodies, which are told their velocities before each step, in all engines \
         alike.\n\n",
    );
}

/// A factor with two digits.
fn factor(value: f64) -> String {
    match value {
        value if value < 0.01 => format!("{value:.0e}"),
        value if value < 9.95 => format!("{value:.2}"),
        value => format!("{value:.0}"),
    }
}

fn times(lanes: &str, entries: &[Entry<'_>], text: &mut String) {
    _ = writeln!(
        text,
        "## Times, with Box2D for {lanes}\n\nTime of a step, least and middle; then ours as a part of theirs, of the \
         least.\n\n\
         | scene | bodies | points | rustycs | Box2D | Rapier | of Box2D | of Rapier |\n|---|{}",
        "---:|".repeat(7)
    );
    for entry in entries {
        let most = match entry.course.kind {
            CourseKind::Structure => STRUCTURE,
            _ if lanes == "AVX2" => OTHERS,
            _ => EVERY,
        };
        let time = |row: &&Row| {
            let [least, middle] = row.step_time.map(|time| Unit::Of("s".into()).figure(time));
            format!("{least}, {middle}")
        };
        let times: Vec<String> = entry.rows.iter().map(time).collect();
        let ratio = |peer: usize, most: f64| {
            let ratio = entry.ratio(peer);
            if ratio <= most { factor(ratio) } else { format!("**{}**", factor(ratio)) }
        };
        _ = writeln!(
            text,
            "| `{}` | {} | {} | {} | {} | {} |",
            entry.course.name,
            entry.rows[0].bodies,
            entry.rows[0].end.points,
            times.join(" | "),
            ratio(1, most),
            ratio(2, OTHERS),
        );
    }
    text.push('\n');
}

fn ends(lanes: &str, entries: &[Entry<'_>], text: &mut String) {
    _ = writeln!(
        text,
        "## How they end, with Box2D for {lanes}\n\nMean overlap, deepest overlap; energy as a part of that at the start, \
         kinetic energy of a body.\n\n\
         | scene | rustycs | Box2D | Rapier | rustycs | Box2D | Rapier |\n|---|{}",
        "---:|".repeat(6)
    );
    for entry in entries {
        let metres = |value: f64| Unit::Of("m".into()).figure(value);
        let overlap = |row: &&Row| {
            let overlap = row.end.overlap;
            format!("{}, {}", metres(overlap.mean), metres(overlap.deepest))
        };
        let energy = |row: &&Row| {
            let each = row.end.kinetic_energy / row.bodies as f64;
            format!("{:.4}, {}", row.end.energy, Unit::Of("J".into()).figure(each))
        };
        let mut overlaps: Vec<String> = entry.rows.iter().map(overlap).collect();
        if !(entry.is_as_tidy(1) && entry.is_as_tidy(2)) {
            overlaps[0] = format!("**{}**", overlaps[0]);
        }
        let energies: Vec<String> = entry.rows.iter().map(energy).collect();
        _ = writeln!(
            text,
            "| `{}` | {} | {} |",
            entry.course.name,
            overlaps.join(" | "),
            energies.join(" | ")
        );
    }
    text.push('\n');
}

/// The shares of the stages, a column for each.
fn stages(entries: &[Entry<'_>], text: &mut String) {
    let Some(first) = entries.first() else { return };
    let words = |entry: &Entry<'_>, offset: usize| -> Vec<String> {
        entry.rows[0].stages.split(' ').skip(offset).step_by(2).map(str::to_owned).collect()
    };
    let names = words(first, 0);
    _ = writeln!(
        text,
        "## Where the time of rustycs goes\n\nShares of the stages of a step, in per cent, in a run with a clock between \
         them; and the time of a step for each contact point at the end.\n\n| scene | {} | per point |\n|---|{}",
        names.join(" | "),
        "---:|".repeat(names.len() + 1)
    );
    for entry in entries {
        let row = entry.rows[0];
        let per_point = Unit::Of("s".into()).figure(row.step_time[0] / row.end.points.max(1) as f64);
        _ = writeln!(text, "| `{}` | {} | {per_point} |", entry.course.name, words(entry, 1).join(" | "));
    }
    text.push('\n');
}

/// How far the time of a step is from what its sweeps alone need on this machine.
fn floors(entries: &[Entry<'_>], text: &mut String) {
    let (peaks, Work { operations, bytes }) = (Peaks::find(), Work::of_a_contact());
    _ = writeln!(
        text,
        "## How far from the floor\n\nA substep does {operations} operations for a contact of two points and moves {bytes} \
         bytes, counted by running its warm start and its two sweeps on numbers that count. This machine does up to {:.0} \
         operations a nanosecond on one thread, and moves up to {:.0} bytes a nanosecond where they fit into 256 kB, {:.0} \
         where they need 4 MB, {:.0} where they need 64 MB, as tried while this page was written. The floor is what the \
         sweeps of a step need at that rate for the contact points at the end: of arithmetic and memory the slower. \
         It has no broad phase, no narrow phase and no bodies in it, and it waits for nothing; so it is far where contacts \
         are few. A sweep has to wait: friction hangs on what presses, that of the second point on that of the first, and \
         the next contact of a body on this one. What else there is in `solve`, and most of `contacts`, is done for one contact \
         or body at a time: what was found of it is taken into lanes and out again.\n\n\
         | scene | floor | set by | solve / floor | step / floor |\n|---|---:|---|---:|---:|",
        peaks.operations * 1e-9,
        peaks.bandwidth(2e5) * 1e-9,
        peaks.bandwidth(4e6) * 1e-9,
        peaks.bandwidth(6e7) * 1e-9,
    );
    // Where all sleep there is nothing to solve.
    for entry in entries.iter().filter(|entry| !entry.rows[0].stages.contains("solve 0 ")) {
        let row = entry.rows[0];
        let Floor { time, is_memory } = floor(row, &peaks);
        let limit = if is_memory { "memory" } else { "arithmetic" };
        let mut words = row.stages.split(' ').skip_while(|word| *word != "solve");
        let solve =
            words.nth(1).and_then(|per_cent| per_cent.parse::<f64>().ok()).unwrap_or_default() / 100.0;
        let step = row.step_time[0] / time;
        _ = writeln!(
            text,
            "| `{}` | {} | {limit} | {} | {} |",
            entry.course.name,
            Unit::Of("s".into()).figure(time),
            factor(step * solve),
            factor(step),
        );
    }
    text.push('\n');
}

/// From the smallest to the largest of the sizes.
fn growth(entries: &[Entry<'_>], text: &mut String) {
    let sizes = entries_of(entries, &CourseKind::Size);
    let [first, .., last] = sizes.as_slice() else { return };
    text.push_str("## How the time of a body grows\n\n");
    for (engine, row) in first.rows.iter().enumerate() {
        let per_body = |entry: &Entry<'_>| entry.rows[engine].step_time[0] / entry.rows[engine].bodies as f64;
        _ = writeln!(
            text,
            "- {}: {} per step and body at {}, {} times that at {}.",
            row.engine,
            Unit::Of("s".into()).figure(per_body(first)),
            first.rows[0].bodies,
            factor(per_body(last) / per_body(first)),
            last.rows[0].bodies,
        );
    }
    text.push_str("\n![Time per body against their number](speed/size.svg)\n\n");
}
