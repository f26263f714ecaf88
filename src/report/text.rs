//! A report as tables: CSV for programs, Markdown for people.

use core::fmt::Write as _;

use crate::report::quantity::{Unit, power_of_ten, quantity};
use crate::report::result::{Reference, Report, Row};

const COLUMNS: &str = "scene,series,settings,tick_rate_hz,substeps,iterations,adaptive,measure,unit,error,\
    reference_error,as_good_as_reference,on_front,sweeps_per_second,run_time_least,run_time_median,\
    run_time_most,timed_runs,energy_drift,energy_gain,momentum_drift,angular_momentum_drift,penetration_m,\
    residual_m_per_s";

/// A field as RFC 4180 has it: in quotes where it needs them.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_string()
    }
}

pub(super) fn csv(report: &Report) -> String {
    let mut text = format!("{COLUMNS}\n");
    for row in &report.rows {
        let Row { settings, invariants, .. } = row;
        let mut fields = [&report.name, &row.series, &row.label].map(|name| quoted(name)).to_vec();
        fields.extend([
            settings.tick_rate.to_string(),
            settings.substeps.to_string(),
            settings.iterations.to_string(),
            settings.adaptive.to_string(),
            quoted(&report.measure),
            quoted(&report.unit),
            format!("{:e}", row.error),
            format!("{:e}", row.reference_error),
            row.is_as_good_as_reference().to_string(),
            report.is_on_front(row).to_string(),
            row.sweeps.to_string(),
        ]);
        let times = row.run_time.map(|time| [time.least, time.median, time.most]);
        fields.extend(
            times.map_or([const { String::new() }; 3], |times| times.map(|time| format!("{time:e}"))),
        );
        fields.push(row.run_time.map_or(String::new(), |time| time.runs.to_string()));
        fields.extend(
            [
                invariants.energy_drift,
                invariants.energy_gain,
                invariants.momentum_drift,
                invariants.angular_momentum_drift,
                invariants.penetration,
                invariants.residual,
            ]
            .map(|value| format!("{value:e}")),
        );
        text += &fields.join(",");
        text.push('\n');
    }
    text
}

impl Report {
    /// An error as tables and plots write it, with its unit: `1.2 mm`, `0.3 %`.
    pub fn with_unit(&self, error: f64) -> String {
        self.error_unit().figure(error)
    }

    /// How errors are written.
    pub(super) fn error_unit(&self) -> Unit {
        if self.unit.is_empty() && self.is_part() { Unit::Part } else { Unit::Of(self.unit.clone()) }
    }

    /// Whether errors are parts of a whole.
    fn is_part(&self) -> bool {
        self.measure.starts_with("drift of") || self.measure.starts_with("gain of")
    }

    /// The error of a row, as far as it is known.
    pub(super) fn row_error_text(&self, row: &Row) -> String {
        if row.is_as_good_as_reference() {
            format!("≤ {}", self.with_unit(row.ranked_error()))
        } else {
            self.with_unit(row.error)
        }
    }

    /// A cost with its unit.
    pub(super) fn cost_text(&self, cost: f64) -> String {
        self.cost_unit().figure(cost)
    }

    /// How costs are written.
    pub(super) fn cost_unit(&self) -> Unit {
        Unit::Of(if self.is_timed { "s" } else { "" }.into())
    }

    /// What the cost is.
    pub(super) fn cost_name(&self) -> &'static str {
        if self.is_timed { "run time per simulated second" } else { "sweeps per simulated second" }
    }

    /// What the rows were measured against, in a sentence.
    pub(super) fn reference_text(&self) -> String {
        match &self.reference {
            Reference::NotNeeded => "It should be 0.".into(),
            Reference::ClosedForm if self.reference_error() == 0.0 => "Reference: the closed form.".into(),
            Reference::ClosedForm => {
                let rounding = self.with_unit(self.reference_error());
                format!("Reference: the closed form; rounding makes {rounding}.")
            }
            Reference::Finer(settings) => format!(
                "Reference: the scene itself at {} Hz × {}, which is off by {} or so.",
                settings.tick_rate,
                settings.substeps,
                self.with_unit(self.reference_error()),
            ),
        }
    }

    /// What a tiny change of the start comes to, in a sentence.
    pub(super) fn chaos_text(&self) -> Option<String> {
        let growth = quantity(self.growth?, "");
        Some(if self.is_chaotic {
            format!(
                "**Chaotic**: a change of the start by 1 µm grows by a factor of {growth}, so the trajectory says nothing \
                 about the settings; compared is the {}.",
                self.measure
            )
        } else {
            format!("Not chaotic: a change of the start by 1 µm grows by a factor of {growth}.")
        })
    }
}

/// A cell of a Markdown table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace(['\n', '\r'], " ")
}

pub(super) fn markdown(report: &Report) -> String {
    let mut text = format!("# {}\n\n", cell(&report.name));
    let seeds =
        if report.seeds == 1 { String::new() } else { format!(", the worst of {} seeds", report.seeds) };
    _ = write!(text, "Measured: {} over {} s{seeds}. ", report.measure, report.duration);
    text += &report.reference_text();
    if let Some(sentence) = report.chaos_text() {
        _ = write!(text, " {sentence}");
    }
    if let Some(orders) = report.orders_text() {
        _ = write!(text, " {}", cell(&orders));
    }
    if !report.is_complete {
        text += " **The study was stopped: these are the rows that were done.**";
    }
    text += "\n\n";
    rows(report, &mut text);
    choices(report, &mut text);
    text
}

/// All rows, cheapest first.
fn rows(report: &Report, text: &mut String) {
    let time = if report.is_timed { " spread |" } else { "" };
    _ = writeln!(
        text,
        "| settings (ticks/s × substeps) | {} | {} |{time} |",
        report.measure,
        report.cost_name()
    );
    _ = writeln!(text, "|---|---:|---:|{}---|", if report.is_timed { "---:|" } else { "" });
    let mut rows: Vec<&Row> = report.rows.iter().collect();
    rows.sort_by(|one, other| one.cost().total_cmp(&other.cost()));
    for row in rows {
        let (error, cost) = (report.row_error_text(row), report.cost_text(row.cost()));
        _ = write!(text, "| {} | {error} | {cost} |", cell(&row.label));
        if let Some(time) = row.run_time {
            _ = write!(text, " + {:.0} % |", 100.0 * (time.median / time.least - 1.0));
        }
        let notes = match (report.is_on_front(row), row.is_as_good_as_reference()) {
            (true, true) => "front; as good as the reference",
            (true, false) => "front",
            (false, true) => "as good as the reference",
            (false, false) => "",
        };
        _ = writeln!(text, " {notes} |");
    }
}

/// Power of ten of the smallest tolerance that is looked at.
const LEAST_CHOICE: i32 = -9;

/// What to choose for some tolerances: each power of ten that changes the choice.
fn choices(report: &Report, text: &mut String) {
    let (mut last, mut lines) = ("", String::new());
    let largest = report.rows.iter().map(Row::bound).filter(|bound| bound.is_finite()).fold(0.0, f64::max);
    let first = largest.max(power_of_ten(LEAST_CHOICE)).log10().ceil() as i32;
    for exponent in (LEAST_CHOICE..=first).rev() {
        let tolerance = power_of_ten(exponent);
        let Some(row) = report.recommend(tolerance) else { break };
        if row.label != last {
            let (tolerance, cost) = (report.with_unit(tolerance), report.cost_text(row.cost()));
            _ = writeln!(lines, "| {tolerance} | {} | {cost} |", cell(&row.label));
        }
        last = &row.label;
    }
    if !lines.is_empty() {
        _ = write!(text, "\n| to be within | take | {} |\n|---:|---|---:|\n{lines}", report.cost_name());
    }
}
