//! What a study found.

use crate::report::measure::Invariants;
use crate::report::{front, order, text};
use crate::world::Settings;

/// A row whose error is within this many times the reference's own is as good as the reference.
const AS_GOOD: f64 = 2.0;

/// How long a row takes, s per simulated second.
///
/// ```
/// # use rustycs::prelude::*;
/// # let throw = |settings: Settings| {
/// #     let mut world = World::new(settings);
/// #     world.add_force(Force::EARTH_GRAVITY);
/// #     world.add(Body::dynamic(Shape::circle(0.5)).velocity([3.0, 4.0])).unwrap();
/// #     world
/// # };
/// use rustycs::report::Study;
///
/// let start = std::time::Instant::now();
/// let report = Study::new(throw).clock(|| start.elapsed().as_secs_f64()).run()?;
/// let run_time = report.rows()[0].run_time.expect("there is a clock");
/// println!("{:.1} µs per simulated second", run_time.median * 1e6);
/// assert!(run_time.least <= run_time.median && run_time.runs >= 3);
/// # Ok::<(), rustycs::report::StudyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RunTime {
    /// Of the fastest run: what it takes when nothing disturbs.
    pub least: f64,
    /// Of the run in the middle.
    pub median: f64,
    /// Of the slowest run.
    pub most: f64,
    /// How many runs were timed.
    pub runs: usize,
}

/// Some settings, how wrong they are and what they cost.
///
/// ```
/// # use rustycs::prelude::*;
/// # let throw = |settings: Settings| {
/// #     let mut world = World::new(settings);
/// #     world.add_force(Force::EARTH_GRAVITY);
/// #     world.add(Body::dynamic(Shape::circle(0.5)).velocity([3.0, 4.0])).unwrap();
/// #     world
/// # };
/// use rustycs::report::Study;
///
/// let report = Study::new(throw).tick_rates([30.0, 60.0]).substeps([1, 4]).run()?;
/// for row in report.rows() {
///     println!("{}: off by {:.1e} m for {} sweeps a second", row.label, row.error, row.sweeps);
/// }
/// assert_eq!(report.rows()[0].settings.tick_rate, 30.0);
/// # Ok::<(), rustycs::report::StudyError>(())
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Row {
    /// The name the settings came with; `None` for those of the sweep.
    pub name: Option<String>,
    /// The line in the plot that it belongs to: the number of substeps, or the name the settings came with.
    pub series: String,
    /// Ticks per second and substeps, after the name if the settings came with one.
    pub label: String,
    /// The settings.
    pub settings: Settings,
    /// The error, in the report's unit.
    pub error: f64,
    /// How wrong the reference is that the error was found with, in the same unit; 0 without a reference.
    pub reference_error: f64,
    /// How long it takes, if there was a clock.
    pub run_time: Option<RunTime>,
    /// How often all contacts are visited, 1 per simulated second.
    pub sweeps: f64,
    /// What should stay as it is, or be 0.
    pub invariants: Invariants,
}

impl Row {
    /// Whether it cannot be told from the reference: what its error really is, only a better one would show.
    pub fn is_as_good_as_reference(&self) -> bool {
        self.reference_error > 0.0 && self.error <= AS_GOOD * self.reference_error
    }

    /// The error, with the doubt about the reference added: the true error is no larger than this, as far as
    /// can be estimated.
    pub fn bound(&self) -> f64 {
        self.error + self.reference_error
    }

    /// The error to rank by: that of rows as good as the reference is the same for all.
    pub(super) fn ranked_error(&self) -> f64 {
        if self.is_as_good_as_reference() { AS_GOOD * self.reference_error } else { self.error }
    }

    /// What it costs: s per simulated second with a clock, visits to all contacts per simulated second
    /// without.
    pub fn cost(&self) -> f64 {
        self.run_time.map_or(self.sweeps, |run_time| run_time.least)
    }
}

/// What rows were measured against.
///
/// ```
/// # use rustycs::prelude::*;
/// # let throw = |settings: Settings| {
/// #     let mut world = World::new(settings);
/// #     world.add_force(Force::EARTH_GRAVITY);
/// #     world.add(Body::dynamic(Shape::circle(0.5)).velocity([3.0, 4.0])).unwrap();
/// #     world
/// # };
/// use rustycs::report::{Exact, Reference, Study};
///
/// let report = Study::new(throw).run()?;
/// assert!(matches!(report.reference(), Reference::Finer(_)), "itself, at finer settings");
/// let by_hand = Study::new(throw).exact(|t| vec![Exact::at([3.0 * t, 4.0 * t - 0.5 * 9.81 * t * t])]).run()?;
/// assert!(matches!(by_hand.reference(), Reference::ClosedForm));
/// # Ok::<(), rustycs::report::StudyError>(())
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Reference {
    /// Nothing: what was measured should be 0.
    NotNeeded,
    /// A closed form.
    ClosedForm,
    /// The scene itself at these settings.
    Finer(Box<Settings>),
}

/// What a [`Study`](crate::report::Study) found: error and run time for each of its settings.
///
/// ```
/// # use rustycs::prelude::*;
/// # let throw = |settings: Settings| {
/// #     let mut world = World::new(settings);
/// #     world.add_force(Force::EARTH_GRAVITY);
/// #     world.add(Body::dynamic(Shape::circle(0.5)).velocity([3.0, 4.0])).unwrap();
/// #     world
/// # };
/// use rustycs::report::Study;
///
/// let report = Study::new(throw).name("a throw").tick_rates([30.0, 60.0]).run()?;
/// assert_eq!(report.rows().len(), 2);
/// println!("{}", report.to_markdown());
/// if let Some(row) = report.recommend(1e-3) {
///     println!("good to a millimetre: {}", row.label);
/// }
/// # Ok::<(), rustycs::report::StudyError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Report {
    pub(super) name: String,
    pub(super) duration: f64,
    pub(super) seeds: usize,
    pub(super) measure: String,
    pub(super) unit: String,
    pub(super) reference: Reference,
    pub(super) growth: Option<f64>,
    pub(super) is_chaotic: bool,
    pub(super) is_timed: bool,
    pub(super) is_complete: bool,
    pub(super) rows: Vec<Row>,
}

impl Report {
    /// What the scene is called.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// How long the scene ran, s.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// What the errors are. In a chaotic scene, not what the study asked for.
    pub fn measure(&self) -> &str {
        &self.measure
    }

    /// Unit of the errors; empty for mere numbers.
    pub fn unit(&self) -> &str {
        &self.unit
    }

    /// What the errors were measured against.
    pub fn reference(&self) -> &Reference {
        &self.reference
    }

    /// How wrong the reference is, in the unit of the errors: the largest over all rows and seeds.
    pub fn reference_error(&self) -> f64 {
        self.rows.iter().map(|row| row.reference_error).fold(0.0, f64::max)
    }

    /// How many times farther apart two runs end that begin a micrometre apart; `None` where trajectories
    /// were not measured against finer settings.
    pub fn growth(&self) -> Option<f64> {
        self.growth
    }

    /// Whether a tiny change of the start comes to another outcome, so that the trajectories were not
    /// compared.
    pub fn is_chaotic(&self) -> bool {
        self.is_chaotic
    }

    /// Whether all rows were run; false if the progress function stopped the study.
    pub fn is_complete(&self) -> bool {
        self.is_complete
    }

    /// All rows, in the order in which they were run.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// The Pareto front: rows that are better than every cheaper one, by 2 % at least, cheapest first. Of those
    /// as good as the reference it holds the cheapest.
    pub fn front(&self) -> Vec<&Row> {
        let points: Vec<[f64; 2]> = self.rows.iter().map(|row| [row.cost(), row.ranked_error()]).collect();
        front::front(&points).into_iter().map(|index| &self.rows[index]).collect()
    }

    /// Whether a row is on the [front](Self::front).
    pub(super) fn is_on_front(&self, row: &Row) -> bool {
        self.front().iter().any(|other| core::ptr::eq(*other, row))
    }

    /// The cheapest settings whose error is at most `tolerance`, in the report's unit, even if the reference
    /// is as wrong as it is thought to be; `None` if there are none.
    pub fn recommend(&self, tolerance: f64) -> Option<&Row> {
        let good = self.rows.iter().filter(|row| row.bound() <= tolerance);
        good.min_by(|one, other| {
            one.cost().total_cmp(&other.cost()).then(one.bound().total_cmp(&other.bound()))
        })
    }

    /// The observed order of convergence p of the sweep, error ~ (length of a substep)^p: the slope that fits
    /// all series best, each with its own factor, over the rows whose error is well above the reference's.
    /// `None` if there are not two of them.
    pub fn order(&self) -> Option<f64> {
        order::observed(self.rows.iter().filter(|row| row.name.is_none()))
    }

    /// The same for the settings that came with a name.
    pub fn order_of(&self, name: &str) -> Option<f64> {
        order::observed(self.rows.iter().filter(|row| row.name.as_deref() == Some(name)))
    }

    /// The observed orders in words: those of the sweep and of the settings with a name.
    pub(super) fn orders_text(&self) -> Option<String> {
        let mut names: Vec<&str> = self.rows.iter().filter_map(|row| row.name.as_deref()).collect();
        names.dedup();
        let mut orders: Vec<String> = self.order().map(|order| format!("{order:.2}")).into_iter().collect();
        orders.extend(names.iter().filter_map(|name| Some(format!("{name} {:.2}", self.order_of(name)?))));
        if orders.is_empty() {
            None
        } else {
            Some(format!("Observed order of convergence: {}.", orders.join(", ")))
        }
    }

    /// A table for programs: a row per settings, quantities in SI units, the names of the columns first.
    pub fn to_csv(&self) -> String {
        text::csv(self)
    }

    /// A table for people: what was run, how far to trust it, the rows, and what to choose.
    pub fn to_markdown(&self) -> String {
        text::markdown(self)
    }

    /// A picture of its [chart](Self::chart), as SVG.
    pub fn to_svg(&self) -> String {
        self.chart().to_svg()
    }
}
