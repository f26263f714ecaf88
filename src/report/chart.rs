//! A picture of errors against costs, in plain data: that of a report, or anybody's own.

use core::fmt::Write as _;

use crate::report::plot;
use crate::report::quantity::{Unit, quantity};
use crate::report::result::{Report, Row};

/// A work-precision diagram: error against cost, both in powers of ten.
///
/// ```
/// use rustycs::report::{Axis, Chart, Mark, Point, Series, Unit};
///
/// let point = |cost: f64, error: f64| Point { cost, error, label: String::new(), mark: Mark::Plain };
/// let chart = Chart {
///     title: "a method".into(),
///     facts: vec!["Each step costs a microsecond.".into()],
///     cost: Axis { name: "run time".into(), unit: Unit::Of("s".into()) },
///     error: Axis { name: "error".into(), unit: Unit::Part },
///     series: vec![Series { name: "order 1".into(), points: vec![point(1e-6, 0.1), point(1e-5, 0.01)] }],
///     front: Vec::new(),
///     has_slopes: true,
/// };
/// assert!(chart.to_svg().starts_with("<svg"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Its heading.
    pub title: String,
    /// Two sentences or so beneath the heading, each from a line of its own on; three lines in all find room.
    pub facts: Vec<String>,
    /// The axis to the right.
    pub cost: Axis,
    /// The axis upward.
    pub error: Axis,
    /// What is compared.
    pub series: Vec<Series>,
    /// Places, as [cost, error], that a broad band joins: the front of all series, where that is of interest.
    pub front: Vec<[f64; 2]>,
    /// Whether the slopes of first and second order are drawn, from the cheapest point on: for what cost buys.
    pub has_slopes: bool,
}

/// What an axis shows.
///
/// ```
/// use rustycs::report::{Axis, Unit};
///
/// let error = Axis { name: "overlap".into(), unit: Unit::Of("m".into()) }; // 3 mm, 20 µm
/// let cost = Axis { name: "share of a frame".into(), unit: Unit::Part }; // 12 %
/// assert_ne!(error.unit, cost.unit);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Axis {
    /// In words.
    pub name: String,
    /// How its figures are written.
    pub unit: Unit,
}

/// Points of one colour and form.
///
/// ```
/// use rustycs::report::{Mark, Point, Series};
///
/// // Twice the steps, half the error.
/// let point = |steps: f64| Point { cost: steps, error: 1.0 / steps, label: String::new(), mark: Mark::Plain };
/// let euler = Series { name: "Euler".into(), points: [10.0, 20.0, 40.0].map(point).to_vec() };
/// assert_eq!(euler.points[2].error, 0.025);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// As the legend calls it.
    pub name: String,
    /// Its points. A line joins those that are not [apart](Mark::Apart) or [aside](Mark::Aside), in this order.
    pub points: Vec<Point>,
}

/// A run. Where an error or a cost is 0 or not finite it has no place in the picture, and the legend counts it.
///
/// ```
/// use rustycs::report::{Mark, Point};
///
/// let best = Point { cost: 2e-3, error: 1e-4, label: "120 Hz".into(), mark: Mark::Plain }; // s, m
/// let exploded = Point { cost: 1e-3, error: f64::NAN, label: String::new(), mark: Mark::Apart }; // only counted
/// assert!(best.error < 1e-3 && exploded.error.is_nan());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// What it costs.
    pub cost: f64,
    /// How wrong it is.
    pub error: f64,
    /// Written beside the point if there is room; may be empty.
    pub label: String,
    /// How it is drawn.
    pub mark: Mark,
}

/// How a point is drawn.
///
/// ```
/// use rustycs::report::{Mark, Point};
///
/// let limit = 1e-7; // what the reference is good to, m
/// let mark = |error: f64| if error < limit { Mark::AsGoodAsReference } else { Mark::Plain };
/// let points = [1e-3, 1e-5, 1e-8].map(|error| Point { cost: 1.0, error, label: String::new(), mark: mark(error) });
/// assert_eq!(points[2].mark, Mark::AsGoodAsReference);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Filled.
    Plain,
    /// Hollow, with the ground below it shaded: as good as the reference, which is all that is known of it.
    AsGoodAsReference,
    /// Filled, but off the line.
    Apart,
    /// A faint dot off the line: a run that is not worth its cost.
    Aside,
}

impl Chart {
    /// The picture. It needs no font and follows the reader's choice of light or dark.
    pub fn to_svg(&self) -> String {
        plot::svg(self)
    }
}

impl Report {
    /// The report as a chart: a series for each number of substeps and each name, the front beneath them, and the
    /// settings of the front by name.
    pub fn chart(&self) -> Chart {
        let mut series: Vec<Series> = Vec::new();
        for row in self.by_fineness() {
            let point = self.point(row);
            match series.iter_mut().find(|series| series.name == row.series) {
                Some(series) => series.points.push(point),
                None => series.push(Series { name: row.series.clone(), points: vec![point] }),
            }
        }
        // The legend keeps the order in which the series were asked for.
        series.sort_by_key(|series| self.rows.iter().position(|row| row.series == series.name));
        Chart {
            title: format!("{}: error against {}", self.name, self.cost_name()),
            facts: vec![self.facts(), self.reference_text()],
            cost: Axis { name: self.cost_name().into(), unit: self.cost_unit() },
            error: Axis { name: self.measure.clone(), unit: self.error_unit() },
            series,
            front: self.front().into_iter().map(|row| [row.cost(), row.ranked_error()]).collect(),
            has_slopes: true,
        }
    }

    /// The rows, those with the longest substeps first.
    fn by_fineness(&self) -> Vec<&Row> {
        let fineness = |row: &Row| f64::from(row.settings.tick_rate) * f64::from(row.settings.substeps);
        let mut rows: Vec<&Row> = self.rows.iter().collect();
        rows.sort_by(|one, other| fineness(one).total_cmp(&fineness(other)));
        rows
    }

    fn point(&self, row: &Row) -> Point {
        let is_as_good = row.is_as_good_as_reference();
        Point {
            cost: row.cost(),
            error: row.ranked_error(),
            label: if self.is_on_front(row) { row.label.clone() } else { String::new() },
            mark: if is_as_good { Mark::AsGoodAsReference } else { Mark::Plain },
        }
    }

    fn facts(&self) -> String {
        let mut facts = format!("Measured: {} over {}.", self.measure, quantity(self.duration, "s"));
        if let Some(orders) = self.orders_text() {
            _ = write!(facts, " {orders}");
        }
        if self.is_chaotic {
            facts += " Chaotic: trajectories cannot be compared.";
        }
        if !self.is_complete {
            facts += " Stopped before the last row.";
        }
        facts
    }
}
