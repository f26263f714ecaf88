//! What came out of each case in each engine, as a table that is written while it comes and read again by the next run.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write as _};
use std::path::Path;

use rustycs_cases::stability::{COUNT, Case, Check, Limit, SHARE};

use crate::fingerprint::hash;
use crate::table::{fields, quoted};

const COLUMNS: &str =
    "case,setup,engine,version,behaviour,outcome,checks,what,value,rule,limit,unit,step_seconds,begun\n";

/// What came out of a case in an engine.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Outcome {
    /// What was found, of everything that must hold.
    Judged(Vec<Check>),
    /// It is no case for this engine.
    NotAsked,
    /// The engine did not take one of the bodies.
    Refused,
    /// The engine gave up in the middle.
    Panicked,
}

impl Outcome {
    /// Whether everything holds; `None` if the engine was not asked, or refused.
    pub(super) fn verdict(&self) -> Option<bool> {
        match self {
            Self::Judged(checks) => Some(checks.iter().all(Check::holds)),
            Self::NotAsked | Self::Refused => None,
            Self::Panicked => Some(false),
        }
    }

    fn word(&self) -> &'static str {
        match self {
            Self::Judged(_) => "judged",
            Self::NotAsked => "not asked",
            Self::Refused => "refused",
            Self::Panicked => "panicked",
        }
    }
}

/// A case in an engine.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) case: String,
    /// Changes with the case: see [`setup`].
    pub(super) setup: String,
    pub(super) engine: String,
    pub(super) version: String,
    /// Changes with the engine's motions: see [`fingerprint`](crate::fingerprint).
    pub(super) behaviour: String,
    pub(super) outcome: Outcome,
    /// Mean time of a step, s; none if none was taken.
    pub(super) step_seconds: Option<f64>,
    /// When the command was given.
    pub(super) begun: String,
}

impl Row {
    fn is_same(&self, other: &Self) -> bool {
        self.case == other.case && self.engine == other.engine
    }

    /// A line for each check; one if there is none.
    fn lines(&self) -> String {
        let checks: &[Check] = if let Outcome::Judged(checks) = &self.outcome { checks } else { &[] };
        let line = |check: Option<&Check>| {
            let [rule, limit] = check.map_or_else(Default::default, |check| match check.limit {
                Limit::AtMost(limit) => ["at most".into(), format!("{limit:e}")],
                Limit::AtLeast(limit) => ["at least".into(), format!("{limit:e}")],
            });
            let fields = [
                quoted(&self.case),
                self.setup.clone(),
                quoted(&self.engine),
                quoted(&self.version),
                self.behaviour.clone(),
                self.outcome.word().into(),
                checks.len().to_string(),
                check.map(|check| quoted(&check.what)).unwrap_or_default(),
                check.map(|check| format!("{:e}", check.value)).unwrap_or_default(),
                rule,
                limit,
                check.map(|check| check.unit.into()).unwrap_or_default(),
                self.step_seconds.map(|seconds| format!("{seconds:e}")).unwrap_or_default(),
                quoted(&self.begun),
            ];
            fields.join(",") + "\n"
        };
        if checks.is_empty() { line(None) } else { checks.iter().map(|check| line(Some(check))).collect() }
    }

    /// A row with the check of this line alone, and how many checks the row has.
    fn read(line: &str) -> Option<(Self, usize)> {
        let mut fields = fields(line).into_iter();
        let mut next = || fields.next();
        let [case, setup, engine, version, behaviour] = [next()?, next()?, next()?, next()?, next()?];
        let (word, count) = (next()?, next()?.parse().ok()?);
        let (what, value, rule, limit, unit) = (next()?, next()?, next()?, next()?, next()?);
        let outcome = match word.as_str() {
            "judged" => {
                let limit = limit.parse().ok()?;
                let limit = if rule == "at most" { Limit::AtMost(limit) } else { Limit::AtLeast(limit) };
                // Units are few, and each is one of these.
                let unit = *[COUNT, SHARE, "m", "m/s", "rad"].iter().find(|known| **known == unit)?;
                Outcome::Judged(vec![Check { what, value: value.parse().ok()?, limit, unit }])
            }
            "not asked" => Outcome::NotAsked,
            "refused" => Outcome::Refused,
            "panicked" => Outcome::Panicked,
            _ => return None,
        };
        let step_seconds = next()?.parse().ok();
        Some((Self { case, setup, engine, version, behaviour, outcome, step_seconds, begun: next()? }, count))
    }
}

/// A word that changes when the case does (FNV-1a of what is known of it): rows of another case by the same name are not
/// taken for this one's.
pub(super) fn setup(case: &Case) -> String {
    let Case { scene, seconds, statement, seen, .. } = case;
    format!("{:016x}", hash(format!("{scene:?} {seconds} {statement} {seen:?}").bytes()))
}

fn text_of(rows: &[Row]) -> String {
    let lines: String = rows.iter().map(Row::lines).collect();
    format!("{COLUMNS}{lines}")
}

/// The table and its file.
#[derive(Debug)]
pub(super) struct Table {
    rows: Vec<Row>,
    file: File,
}

impl Table {
    /// Reads the rows of a file for which `keeps` holds, if there is one, and writes them back without the others.
    pub(super) fn open(path: &Path, keeps: impl Fn(&Row) -> bool) -> io::Result<Self> {
        let text = if path.exists() { fs::read_to_string(path)? } else { String::new() };
        let mut rows: Vec<Row> = Vec::new();
        let mut lines = text.lines().skip(1).filter_map(Row::read);
        while let Some((mut row, count)) = lines.next() {
            let rest: Vec<Row> = lines.by_ref().take(count.saturating_sub(1)).map(|(row, _)| row).collect();
            // Lines that were cut short by a sudden end are no row.
            let is_whole = rest.len() + 1 >= count && rest.iter().all(|other| row.is_same(other));
            if let Outcome::Judged(checks) = &mut row.outcome {
                for other in rest {
                    if let Outcome::Judged(more) = other.outcome {
                        checks.extend(more);
                    }
                }
            }
            if is_whole && keeps(&row) {
                rows.retain(|other| !row.is_same(other));
                rows.push(row);
            }
        }
        let new = path.with_extension("csv.new");
        fs::write(&new, text_of(&rows))?;
        fs::rename(&new, path)?;
        Ok(Self { rows, file: OpenOptions::new().append(true).open(path)? })
    }

    pub(super) fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Adds a row, in the file too.
    pub(super) fn add(&mut self, row: Row) -> io::Result<()> {
        self.file.write_all(row.lines().as_bytes())?;
        self.file.flush()?;
        // In the file, the later one of two is read.
        self.rows.retain(|other| !row.is_same(other));
        self.rows.push(row);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(engine: &str, outcome: Outcome) -> Row {
        Row {
            case: "stack-10".into(),
            setup: "00".into(),
            engine: engine.into(),
            version: "1.0, \"quoted\"".into(),
            behaviour: "01".into(),
            outcome,
            step_seconds: Some(1.5e-6),
            begun: "2026-01-01 12:00 UTC".into(),
        }
    }

    fn checks() -> Outcome {
        let limit = Limit::AtMost(0.01);
        let check = |what: &str, value| Check { what: what.into(), value, limit, unit: "m" };
        Outcome::Judged(vec![check("sinking, most", 0.5), check("drifting", f64::INFINITY)])
    }

    #[test]
    fn a_table_is_read_as_it_was_written_but_for_what_was_cut_short() {
        let folder = std::env::temp_dir().join(format!("rustycs-peers-rows-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("stability.csv");
        let rows = [
            row("rustycs", checks()),
            row("Box2D", Outcome::Refused),
            Row { step_seconds: None, ..row("Rapier", Outcome::NotAsked) },
        ];
        {
            let mut table = Table::open(&path, |_| true).unwrap();
            table.add(row("rustycs", Outcome::Panicked)).unwrap();
            for row in &rows {
                table.add(row.clone()).unwrap();
            }
            assert_eq!(table.rows(), rows);
        }
        let cut = row("Bullet", checks()).lines();
        let text = fs::read_to_string(&path).unwrap() + &cut[..cut.len() / 2 + 5];
        fs::write(&path, text).unwrap();
        assert_eq!(Table::open(&path, |_| true).unwrap().rows(), rows);
        assert_eq!(Table::open(&path, |row| row.engine == "Box2D").unwrap().rows(), &rows[1..2]);
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn verdicts_are_those_of_all_checks() {
        assert_eq!(checks().verdict(), Some(false));
        assert_eq!(Outcome::Judged(Vec::new()).verdict(), Some(true));
        assert_eq!(Outcome::Panicked.verdict(), Some(false));
        assert_eq!(Outcome::Refused.verdict(), None);
        let limit = Limit::AtLeast(1.0);
        let nothing = Check { what: String::new(), value: f64::NAN, limit, unit: SHARE };
        assert!(!nothing.holds(), "what is no number keeps to no limit");
    }
}
