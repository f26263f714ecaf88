//! The plot of a problem: the fronts of all engines.

use rustycs::report::{Axis, Chart, Mark, Point, Series, Unit};

use crate::engine::DEFAULT;
use crate::error::compare::{Order, Runs};
use crate::error::label;
use crate::error::rows::Row;
use crate::problems::Problem;

/// A series for each engine: its front joined, other settings beside it.
pub(super) fn chart(problem: &Problem, engines: &[&Runs<'_>]) -> Chart {
    Chart {
        title: format!("{}: error against run time", problem.name),
        facts: vec![
            format!("Error: {}.", problem.measure),
            format!("Default: {}. {}", label(DEFAULT), orders(engines)),
        ],
        cost: Axis { name: "run time per simulated second".into(), unit: Unit::Of("s".into()) },
        error: Axis { name: "error".into(), unit: problem.unit.clone() },
        series: engines.iter().map(|runs| series(runs)).collect(),
        front: Vec::new(),
        has_slopes: true,
    }
}

fn orders(engines: &[&Runs<'_>]) -> String {
    let orders: Vec<String> = engines
        .iter()
        .filter_map(|runs| match runs.order() {
            Order::Observed(order) => Some(format!("{} {order:.1}", runs.engine)),
            Order::Rounding | Order::Unknown => None,
        })
        .collect();
    if orders.is_empty() { String::new() } else { format!("Order: {}.", orders.join(", ")) }
}

fn series(runs: &Runs<'_>) -> Series {
    let is_on_front = |row: &Row| runs.front.contains(&[row.run_time[0], row.error]);
    let mut rows = runs.rows.clone();
    rows.sort_by(|one, other| one.run_time[0].total_cmp(&other.run_time[0]));
    let ends = [runs.front.first(), runs.front.last()];
    let point = |row: &&Row| {
        let place = [row.run_time[0], row.error];
        let (is_default, is_end) = (row.fineness == DEFAULT, ends.contains(&Some(&place)));
        Point {
            cost: row.run_time[0],
            error: row.error,
            label: match (is_default, is_end) {
                (true, _) => "default".into(),
                (_, true) => label(row.fineness),
                _ => String::new(),
            },
            mark: match (is_on_front(row), is_default) {
                (true, _) => Mark::Plain,
                (false, true) => Mark::Apart,
                (false, false) => Mark::Aside,
            },
        }
    };
    Series { name: runs.engine.into(), points: rows.iter().map(point).collect() }
}
