//! The page of what passes.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::Path;

use crate::contestant::Contestant;
use crate::continuous::picture;
use crate::continuous::rows::Row;
use crate::continuous::trial::{FINENESSES, SPEEDS, THICKNESSES, THROWS};
use crate::words::{circumstances, goes};

/// Writes the page and its pictures.
pub(super) fn write(folder: &Path, contestants: &[Contestant], rows: &[Row]) -> io::Result<()> {
    for contestant in contestants {
        let name = contestant.engine.name();
        fs::write(folder.join(path(name)), picture::svg(name, rows))?;
    }
    fs::write(folder.join("CONTINUOUS.md"), text(contestants, rows))
}

/// Where the map of an engine is, from the page.
fn path(engine: &str) -> String {
    let name: String = engine.chars().filter(|c| c.is_alphanumeric() || *c == ' ').collect();
    format!("continuous/{}.svg", name.to_lowercase().replace(' ', "-"))
}

fn text(contestants: &[Contestant], rows: &[Row]) -> String {
    let names: Vec<&str> = contestants.iter().map(|contestant| contestant.engine.name()).collect();
    let trials = rows.first().map_or(0, |row| row.trials);
    let mut text = String::from(
        "# What passes through a wall\n\nMade by `cargo run --release -p rustycs-peers -- continuous`. Bodies are thrown at walls; \
         one passes if its centre gets behind.\n\n",
    );
    _ = writeln!(
        text,
        "- {trials} random trials in each cell: {} tick rates and substeps (30, 60 and 240 Hz, 1 and 4) times {}; restitution 0, \
         0.2, 0.5 and 1, friction 0.3, places, angles and spins by chance.",
        FINENESSES.len(),
        trials / FINENESSES.len() as u32
    );
    text += "- \"Bullets\" and \"CCD\": all bodies that move have the flag with which the engine sweeps them. rustycs has none; \
             \"off\" is `Settings::continuous` switched off.\n\
             - Box2D cuts speeds to 400 m/s, so that what is thrown faster is thrown with that.\n";
    let mut versions: Vec<String> =
        contestants.iter().map(|contestant| contestant.engine.version()).collect();
    versions.dedup();
    circumstances(versions, &mut text);
    _ = writeln!(text, "- Measured {}.\n", goes(rows.iter().map(|row| row.begun.as_str())));
    text += "## In all\n\n| engine | cells in which something passes | trials that pass |\n|---|---:|---:|\n";
    for name in &names {
        let of = || rows.iter().filter(|row| row.engine == *name);
        let cells = of().count() * SPEEDS.len();
        let open = of().flat_map(|row| row.passed).filter(|&passed| passed > 0).count();
        let passed: u32 = of().flat_map(|row| row.passed).sum();
        let all = cells as u32 * trials;
        _ = writeln!(text, "| {name} | {open} of {cells} | {passed} of {all} |");
    }
    text += "\n## Maps\n\nTo the right, speeds in m/s; downwards, what is thrown and how thick the wall is. Grey: nothing passes; \
             the redder, the more does.\n\n";
    for name in &names {
        _ = writeln!(text, "![{name}]({})", path(name));
    }
    text += "\n## From which speed\n\nThe least speed at which something passes, m/s, and the greatest share that does at any.\n";
    for thickness in THICKNESSES {
        _ = write!(text, "\n### A wall of {thickness} m\n\n| thrown | {} |\n|---|", names.join(" | "));
        text += &"---|".repeat(names.len());
        text.push('\n');
        for throw in THROWS {
            let cell = |name: &&str| cell(rows, throw.name, thickness, name);
            let cells: Vec<String> = names.iter().map(cell).collect();
            _ = writeln!(text, "| {} | {} |", throw.statement, cells.join(" | "));
        }
    }
    text
}

/// What is said of a throw at a wall in an engine.
fn cell(rows: &[Row], throw: &str, thickness: f64, engine: &str) -> String {
    let is_of = |row: &&Row| row.throw == throw && row.thickness == thickness && row.engine == engine;
    let Some(row) = rows.iter().find(is_of) else { return String::new() };
    let Some(first) = row.passed.iter().position(|&passed| passed > 0) else { return "none".into() };
    let most = row.passed.into_iter().max().unwrap_or_default();
    let share = 100.0 * f64::from(most) / f64::from(row.trials);
    let share = if share < 1.0 { format!("{share:.1}") } else { format!("{share:.0}") };
    format!("{} m/s, {share} %", SPEEDS[first])
}
