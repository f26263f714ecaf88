//! The page.

use std::fmt::Write as _;

use rustycs::report::Unit;

use super::build::Build;
use super::{BUILDS, Findings, REMEMBERED};
use crate::engines;
use crate::machine;

/// What we hold ourselves to: at most this part of the time that Rapier takes for a cold build, ...
const BUILD_TIME: f64 = 0.1;
/// ... and this part of the size of its program.
const SIZE: f64 = 0.25;

/// A figure, or that there is none.
fn figure(value: Option<f64>, unit: &str) -> String {
    value.map_or("-".to_owned(), |value| {
        if unit.is_empty() { short(value) } else { Unit::Of(unit.into()).figure(value) }
    })
}

/// A number with at least three digits.
fn short(value: f64) -> String {
    match value {
        value if value >= 1e6 => format!("{:.2} M", 1e-6 * value),
        value if value >= 1e3 => format!("{:.1} k", 1e-3 * value),
        value if value.fract() == 0.0 => format!("{value:.0}"),
        value => format!("{value:.2}"),
    }
}

pub(super) fn page(names: &[&str], findings: &Findings) -> String {
    let mut text = String::from("# Footprint: rustycs, Box2D, Rapier\n\n");
    text += "Written by `cargo run --release -p rustycs-peers -- footprint`. Each figure comes from a process of its own.\n\n";
    _ = writeln!(text, "- Machine: {}.", machine::name());
    for engine in engines::all() {
        _ = writeln!(text, "- {}.", engine.version());
    }
    _ = writeln!(text, "- Ended {}.", machine::now());
    for left_out in &findings.left_out {
        _ = writeln!(text, "- {left_out}");
    }
    text += "\n## In short\n\n";
    in_short(findings, &mut text);
    instructions(names, findings, &mut text);
    memory(names, findings, &mut text);
    allocations(names, findings, &mut text);
    builds(names, findings, &mut text);
    text
}

/// Ours as a part of that of the last engine, Rapier.
fn part(findings: &Findings, of: impl Fn(&Build) -> f64) -> Option<f64> {
    let of_engine = |place: usize| findings.builds.get(place)?.as_ref().ok().map(&of);
    Some(of_engine(0)? / of_engine(2)?)
}

fn in_short(findings: &Findings, text: &mut String) {
    let verdict = |is_met: bool| if is_met { "met" } else { "**not met**" };
    let allocates = findings.allocations.iter().any(|(_, by_engine)| by_engine[0] != Some(0.0));
    _ = writeln!(text, "- No allocation in a settled step: {}.", verdict(!allocates));
    if let Some(part) = part(findings, |build| build.seconds) {
        let is_met = verdict(part <= BUILD_TIME);
        _ = writeln!(
            text,
            "- Cold build in {BUILD_TIME} of the time of Rapier's or less: {is_met} ({part:.3})."
        );
    }
    if let Some(part) = part(findings, |build| build.size as f64) {
        let is_met = verdict(part <= SIZE);
        _ = writeln!(text, "- Program of {SIZE} of the size of Rapier's or less: {is_met} ({part:.3}).");
    }
    text.push('\n');
}

fn head(first: &str, names: &[&str], text: &mut String) {
    _ = writeln!(text, "| {first} | {} |\n|---|{}", names.join(" | "), "---:|".repeat(names.len()));
}

fn row(first: &str, figures: impl Iterator<Item = String>, text: &mut String) {
    _ = writeln!(text, "| {first} | {} |", figures.collect::<Vec<_>>().join(" | "));
}

fn instructions(names: &[&str], findings: &Findings, text: &mut String) {
    if findings.instructions.is_empty() {
        return;
    }
    *text += "## Instructions of a step\n\nCounted by callgrind, which gives the same number each time; the scenes are those \
              of [SPEED.md](SPEED.md). How long an instruction takes differs: one of eight lanes counts as one.\n\n";
    head("scene", names, text);
    for (scene, by_engine) in &findings.instructions {
        row(&format!("`{scene}`"), by_engine.iter().map(|&count| figure(count, "")), text);
    }
    text.push('\n');
}

fn memory(names: &[&str], findings: &Findings, text: &mut String) {
    _ = writeln!(
        text,
        "## Memory\n\nThe most that a process has at a time (`VmHWM`) with the mixed pile of {} bodies, from the start until they \
         have piled up; with an empty world; and the difference for each body.\n",
        REMEMBERED.0
    );
    head("", names, text);
    let memory = &findings.memory;
    row("with the pile", memory.iter().map(|[full, _]| figure(*full, "B")), text);
    row("with an empty world", memory.iter().map(|[_, empty]| figure(*empty, "B")), text);
    let each =
        |[full, empty]: &[Option<f64>; 2]| Some((full.as_ref()? - empty.as_ref()?) / REMEMBERED.0 as f64);
    row("for each body", memory.iter().map(|both| figure(each(both), "B")), text);
    text.push('\n');
}

fn allocations(names: &[&str], findings: &Findings, text: &mut String) {
    *text += "## Allocations\n\nFor each of 60 steps of a scene that has settled, without sleep. Box2D takes its memory from \
              the allocator of this program here, where it is counted.\n\n";
    head("scene", names, text);
    for (scene, by_engine) in &findings.allocations {
        row(&format!("`{scene}`"), by_engine.iter().map(|&count| figure(count, "")), text);
    }
    text.push('\n');
}

fn builds(names: &[&str], findings: &Findings, text: &mut String) {
    if findings.builds.is_empty() {
        return;
    }
    let bare = figure(findings.bare.map(|build| build.size as f64), "B");
    _ = writeln!(
        text,
        "## A small program\n\nA ball that falls onto a floor, with the default features of the engine, built by \
         `cargo build --release` with an empty target folder and packages that were downloaded before: the least time of \
         {BUILDS} builds, taken in turns, with that of starting cargo. Box2D comes with its Rust bindings, `boxdd-sys`. The \
         size is that of the stripped program; one that prints a place and has no engine takes {bare}.\n"
    );
    head("", names, text);
    let builds = || findings.builds.iter().map(|build| build.as_ref().ok());
    row("cold build", builds().map(|build| figure(build.map(|build| build.seconds), "s")), text);
    row(
        "packages compiled",
        builds().map(|build| figure(build.map(|build| build.packages as f64), "")),
        text,
    );
    row("size", builds().map(|build| figure(build.map(|build| build.size as f64), "B")), text);
    for (name, build) in names.iter().zip(&findings.builds) {
        if let Err(reason) = build {
            _ = writeln!(text, "\n{name} could not be built: {reason}");
        }
    }
}
