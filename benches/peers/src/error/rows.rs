//! The rows that were measured, as a table that is written while they come and read again by the next run.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use crate::engine::Fineness;
use crate::error::fingerprint::hash;
use crate::problems::Problem;

const COLUMNS: [&str; 14] = [
    "problem",
    "setup",
    "engine",
    "version",
    "behaviour",
    "tick_rate_hz",
    "substeps",
    "error",
    "unit",
    "run_time_least",
    "run_time_median",
    "runs",
    "repeats",
    "begun",
];

/// A problem in an engine at some settings: how wrong it is, and how long it takes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) problem: String,
    /// Changes with the problem: see [`setup`].
    pub(super) setup: String,
    pub(super) engine: String,
    pub(super) version: String,
    /// Changes with the engine's motions: see [`fingerprint`](crate::error::fingerprint).
    pub(super) behaviour: String,
    pub(super) fineness: Fineness,
    /// In the unit of the problem; infinite if the run came to nothing.
    pub(super) error: f64,
    /// Empty for parts of a whole.
    pub(super) unit: String,
    /// Least and middle run time, s per simulated second.
    pub(super) run_time: [f64; 2],
    /// How many runs were timed.
    pub(super) runs: usize,
    /// How many were asked for at least.
    pub(super) repeats: u32,
    /// When the command was given that measured the row.
    pub(super) begun: String,
}

impl Row {
    /// Whether it is the same problem in the same engine at the same settings, measured now or before.
    pub(super) fn replaces(&self, other: &Self) -> bool {
        self.problem == other.problem && self.engine == other.engine && self.fineness == other.fineness
    }

    fn line(&self) -> String {
        let fields = [
            quoted(&self.problem),
            self.setup.clone(),
            quoted(&self.engine),
            quoted(&self.version),
            self.behaviour.clone(),
            self.fineness.tick_rate.to_string(),
            self.fineness.substeps.to_string(),
            format!("{:e}", self.error),
            quoted(&self.unit),
            format!("{:e}", self.run_time[0]),
            format!("{:e}", self.run_time[1]),
            self.runs.to_string(),
            self.repeats.to_string(),
            quoted(&self.begun),
        ];
        fields.join(",") + "\n"
    }

    fn read(line: &str) -> Option<Self> {
        let mut fields = fields(line).into_iter();
        let mut next = || fields.next();
        let row = Self {
            problem: next()?,
            setup: next()?,
            engine: next()?,
            version: next()?,
            behaviour: next()?,
            fineness: Fineness { tick_rate: next()?.parse().ok()?, substeps: next()?.parse().ok()? },
            error: next()?.parse().ok()?,
            unit: next()?,
            run_time: [next()?.parse().ok()?, next()?.parse().ok()?],
            runs: next()?.parse().ok()?,
            repeats: next()?.parse().ok()?,
            begun: next()?,
        };
        Some(row)
    }
}

/// A word that changes when the scene, the duration or the measure of a problem does (FNV-1a of all of them): rows of
/// another problem by the same name are not taken for this one's.
pub(super) fn setup(problem: &Problem) -> String {
    let Problem { scene, duration, measure, unit, statement, .. } = problem;
    let text = format!("{scene:?} {duration} {measure} {unit:?} {statement}");
    format!("{:016x}", hash(text.bytes()))
}

/// A field as RFC 4180 has it: in quotes where it needs them.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.into()
    }
}

fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut is_quoted = false;
    let mut characters = line.chars().peekable();
    while let Some(character) = characters.next() {
        let last = fields.len() - 1;
        match character {
            '"' if is_quoted && characters.peek() == Some(&'"') => {
                characters.next();
                fields[last].push('"');
            }
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => fields.push(String::new()),
            character => fields[last].push(character),
        }
    }
    fields
}

/// The table and its file.
#[derive(Debug)]
pub(super) struct Table {
    rows: Vec<Row>,
    path: PathBuf,
    file: File,
}

impl Table {
    /// Reads the rows of a file for which `keeps` holds, if there is one, and writes them back without the others.
    pub(super) fn open(path: &Path, keeps: impl Fn(&Row) -> bool) -> io::Result<Self> {
        let text = if path.exists() { fs::read_to_string(path)? } else { String::new() };
        let mut rows: Vec<Row> = Vec::new();
        // A line that was cut short by a sudden end is no row.
        for row in text.lines().skip(1).filter_map(Row::read).filter(keeps) {
            rows.retain(|other| !row.replaces(other));
            rows.push(row);
        }
        let mut text = COLUMNS.join(",") + "\n";
        text.extend(rows.iter().map(Row::line));
        let new = path.with_extension("csv.new");
        fs::write(&new, text)?;
        fs::rename(&new, path)?;
        Ok(Self { rows, path: path.into(), file: OpenOptions::new().append(true).open(path)? })
    }

    pub(super) fn rows(&self) -> &[Row] {
        &self.rows
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Adds a row, in the file too.
    pub(super) fn add(&mut self, row: Row) -> io::Result<()> {
        self.file.write_all(row.line().as_bytes())?;
        self.file.flush()?;
        self.rows.retain(|other| !row.replaces(other));
        self.rows.push(row);
        Ok(())
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Some row.
    pub(in crate::error) fn row() -> Row {
        Row {
            problem: "slide".into(),
            setup: "00".into(),
            engine: "Box2D".into(),
            version: "Box2D 3.2.0 (source \"abc\"), SSE2, f32".into(),
            behaviour: "01".into(),
            fineness: Fineness { tick_rate: 60.0, substeps: 4 },
            error: 1.25e-3,
            unit: String::new(),
            run_time: [1e-5, 1.5e-5],
            runs: 7,
            repeats: 5,
            begun: "2026-01-01 12:00".into(),
        }
    }

    #[test]
    fn rows_are_read_as_they_were_written() {
        let lost = Row { error: f64::INFINITY, unit: "m".into(), ..row() };
        for row in [row(), lost] {
            assert_eq!(Row::read(row.line().trim_end()), Some(row));
        }
        let cut = row().line();
        assert_eq!(Row::read(&cut[..cut.len() - 25]), None);
    }

    #[test]
    fn a_table_resumes_with_the_rows_that_still_hold() {
        let folder = std::env::temp_dir().join(format!("rustycs-peers-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("error.csv");
        let other = Row { engine: "Rapier".into(), ..row() };
        {
            let mut table = Table::open(&path, |_| true).unwrap();
            table.add(row()).unwrap();
            table.add(other.clone()).unwrap();
            table.add(Row { error: 0.5, ..row() }).unwrap();
            assert_eq!(table.rows().len(), 2, "a row replaces the one before");
        }
        // The end of a process within a line.
        let text = fs::read_to_string(&path).unwrap() + "slide,00,rust";
        fs::write(&path, text).unwrap();
        let table = Table::open(&path, |_| true).unwrap();
        assert_eq!(table.rows(), [other.clone(), Row { error: 0.5, ..row() }]);
        drop(table);
        let mut table = Table::open(&path, |row| row.engine == "Rapier").unwrap();
        assert_eq!(table.rows(), [other]);
        table.add(row()).unwrap();
        assert_eq!(Table::open(&path, |_| true).unwrap().rows().len(), 2);
        fs::remove_dir_all(&folder).unwrap();
    }
}
