//! What came out of each case in each engine.

use rustycs_cases::stability::{COUNT, Case, Check, Limit, SHARE};

use crate::fingerprint::word;
use crate::table::{Fields, Record};

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
    /// A line with one of the checks, or with none.
    fn line(&self, check: Option<&Check>, checks: usize) -> Vec<String> {
        let [rule, limit] = check.map_or_else(Default::default, |check| match check.limit {
            Limit::AtMost(limit) => ["at most".into(), format!("{limit:e}")],
            Limit::AtLeast(limit) => ["at least".into(), format!("{limit:e}")],
        });
        vec![
            self.case.clone(),
            self.setup.clone(),
            self.engine.clone(),
            self.version.clone(),
            self.behaviour.clone(),
            self.outcome.word().into(),
            checks.to_string(),
            check.map(|check| check.what.clone()).unwrap_or_default(),
            check.map(|check| format!("{:e}", check.value)).unwrap_or_default(),
            rule,
            limit,
            check.map(|check| check.unit.into()).unwrap_or_default(),
            self.step_seconds.map(|seconds| format!("{seconds:e}")).unwrap_or_default(),
            self.begun.clone(),
        ]
    }

    /// A row with the check of this line alone, and how many checks the row has.
    fn of_line(mut line: Fields) -> Option<(Self, usize)> {
        let [case, setup, engine] = [line.text()?, line.text()?, line.text()?];
        let [version, behaviour, word] = [line.text()?, line.text()?, line.text()?];
        let (count, what, value) = (line.number()?, line.text()?, line.text()?);
        let [rule, limit, unit] = [line.text()?, line.text()?, line.text()?];
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
        let step_seconds = line.text()?.parse().ok();
        let begun = line.text()?;
        Some((Self { case, setup, engine, version, behaviour, outcome, step_seconds, begun }, count))
    }
}

impl Record for Row {
    const COLUMNS: &[&str] = &[
        "case",
        "setup",
        "engine",
        "version",
        "behaviour",
        "outcome",
        "checks",
        "what",
        "value",
        "rule",
        "limit",
        "unit",
        "step_seconds",
        "begun",
    ];

    fn replaces(&self, other: &Self) -> bool {
        self.case == other.case && self.engine == other.engine
    }

    /// A line for each check; one if there is none.
    fn lines(&self) -> Vec<Vec<String>> {
        match &self.outcome {
            Outcome::Judged(checks) if !checks.is_empty() => {
                checks.iter().map(|check| self.line(Some(check), checks.len())).collect()
            }
            _ => vec![self.line(None, 0)],
        }
    }

    fn read(first: Fields, next: &mut dyn Iterator<Item = Fields>) -> Option<Self> {
        let (mut row, count) = Self::of_line(first)?;
        let rest: Vec<Self> =
            next.take(count.saturating_sub(1)).filter_map(Self::of_line).map(|(row, _)| row).collect();
        if rest.len() + 1 < count || !rest.iter().all(|other| row.replaces(other)) {
            return None;
        }
        if let Outcome::Judged(checks) = &mut row.outcome {
            for other in rest {
                if let Outcome::Judged(more) = other.outcome {
                    checks.extend(more);
                }
            }
        }
        Some(row)
    }
}

/// A word that changes when the case does : rows of another case by the same name are not taken for this one's.
pub(super) fn setup(case: &Case) -> String {
    let Case { scene, seconds, statement, seen, .. } = case;
    word(format!("{scene:?} {seconds} {statement} {seen:?}").bytes())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::table::Table;

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
            let mut table = Table::<Row>::open(&path, |_| true).unwrap();
            table.add(row("rustycs", Outcome::Panicked)).unwrap();
            for row in &rows {
                table.add(row.clone()).unwrap();
            }
            assert_eq!(table.rows(), rows);
        }
        Table::<Row>::open(&path, |_| true).unwrap().add(row("Bullet", checks())).unwrap();
        // The second of its two lines ends early.
        let text = fs::read_to_string(&path).unwrap();
        let text = &text[..text.len() - 30];
        fs::write(&path, text).unwrap();
        assert_eq!(Table::<Row>::open(&path, |_| true).unwrap().rows(), rows);
        assert_eq!(Table::open(&path, |row: &Row| row.engine == "Box2D").unwrap().rows(), &rows[1..2]);
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
