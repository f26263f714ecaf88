//! The plots: time against overlap by scene, and time against size.

use rustycs::report::{Axis, Chart, Mark, Point, Series, Unit};

use super::page::Entry;
use super::rows::Row;

/// A point for each scene and engine: what a step of a body costs, and how far bodies are in each other at the end.
pub(super) fn overlaps(entries: &[Entry<'_>]) -> Chart {
    let point = |entry: &Entry<'_>, row: &Row| Point {
        cost: row.step_time[0] / row.bodies as f64,
        error: row.end.overlap.mean,
        label: if row.engine == entry.rows[0].engine { entry.course.name.clone() } else { String::new() },
        mark: Mark::Apart,
    };
    Chart {
        title: "overlap against time, by scene".into(),
        facts: vec![
            "Time of a step and body; mean over the bodies of the deepest overlap at the end.".into(),
        ],
        cost: Axis { name: "time per step and body".into(), unit: Unit::Of("s".into()) },
        error: Axis { name: "mean overlap".into(), unit: Unit::Of("m".into()) },
        series: series(entries, point),
        front: Vec::new(),
        has_slopes: false,
    }
}

/// How the time of a body grows with their number.
pub(super) fn sizes(entries: &[Entry<'_>]) -> Chart {
    let point = |_: &Entry<'_>, row: &Row| Point {
        cost: row.bodies as f64,
        error: row.step_time[0] / row.bodies as f64,
        label: String::new(),
        mark: Mark::Plain,
    };
    Chart {
        title: "time per body against their number, in the mixed pile".into(),
        facts: Vec::new(),
        cost: Axis { name: "bodies".into(), unit: Unit::Of(String::new()) },
        error: Axis { name: "time per step and body".into(), unit: Unit::Of("s".into()) },
        series: series(entries, point),
        front: Vec::new(),
        has_slopes: false,
    }
}

/// A series for each engine.
fn series(entries: &[Entry<'_>], point: impl Fn(&Entry<'_>, &Row) -> Point) -> Vec<Series> {
    let Some(first) = entries.first() else { return Vec::new() };
    (0..first.rows.len())
        .map(|engine| Series {
            name: first.rows[engine].engine.clone(),
            points: entries.iter().map(|entry| point(entry, entry.rows[engine])).collect(),
        })
        .collect()
}
