//! A report as a picture: error against cost, both in powers of ten.
//!
//! Written by hand, as text: the picture is lines, marks and words, and what makes it legible (which words find
//! room, what stands on the axes, two themes in one file) is nothing that a plotting library without fonts
//! decides for us.

mod axis;
mod canvas;
mod labels;
mod legend;

use core::fmt::Write as _;

use crate::report::plot::axis::Axis;
use crate::report::plot::canvas::{Canvas, Mark, Place, Text};
use crate::report::plot::labels::Labels;
use crate::report::quantity::quantity;
use crate::report::result::{Report, Row};

/// Size of the picture, px.
const SIZE: [f64; 2] = [960.0, 600.0];
/// The part of it that shows rows: left, top, right, bottom, px.
const AREA: [f64; 4] = [96.0, 92.0, 726.0, 526.0];

/// A row in the picture.
struct Dot<'a> {
    row: &'a Row,
    /// Index of its series.
    series: usize,
    place: Place,
}

pub(super) fn svg(report: &Report) -> String {
    let mut canvas = Canvas::new(SIZE);
    headings(report, &mut canvas);
    // What is 0 or not finite has no place on an axis of powers of ten.
    let drawn = |row: &&Row| row.ranked_error() > 0.0 && row.error.is_finite() && row.cost() > 0.0;
    let rows: Vec<&Row> = report.rows.iter().filter(drawn).collect();
    if rows.is_empty() {
        canvas.text(Text::middle([411.0, 300.0], "no row has an error that is neither 0 nor infinite"));
        return canvas.finish();
    }
    let x = Axis::new(rows.iter().map(|row| row.cost()), [AREA[0], AREA[2]]);
    let y = Axis::new(rows.iter().map(|row| row.ranked_error()), [AREA[3], AREA[1]]);
    let names = series_of(&rows);
    let dots: Vec<Dot<'_>> = rows
        .iter()
        .map(|&row| Dot {
            row,
            series: names.iter().position(|name| *name == row.series).unwrap_or_default(),
            place: [x.at(row.cost()), y.at(row.ranked_error())],
        })
        .collect();
    axes(report, &x, &y, &mut canvas);
    floor(report, &y, &mut canvas);
    let mut labels = Labels::new(AREA);
    let guides = guides(&dots, [&x, &y], &mut canvas);
    lines(report, &dots, names.len(), &mut canvas, &mut labels);
    name_front(report, &dots, &mut canvas, &mut labels);
    name_guides(&guides, &mut canvas, &mut labels);
    legend::draw(report, &names, report.rows.len() - rows.len(), &mut canvas);
    canvas.finish()
}

/// The series, in the order of their first row.
fn series_of<'a>(rows: &[&'a Row]) -> Vec<&'a str> {
    let mut names: Vec<&str> = Vec::new();
    for row in rows {
        if !names.contains(&row.series.as_str()) {
            names.push(&row.series);
        }
    }
    names
}

fn headings(report: &Report, canvas: &mut Canvas) {
    let title = format!("{}: error against {}", report.name, report.cost_name());
    canvas.text(Text::start([24.0, 34.0], title).class("title"));
    let mut facts = format!("Measured: {} over {} s.", report.measure, quantity(report.duration, ""));
    if let Some(orders) = report.orders_text() {
        _ = write!(facts, " {orders}");
    }
    if report.is_chaotic {
        facts += " Chaotic: trajectories cannot be compared.";
    }
    if !report.is_complete {
        facts += " Stopped before the last row.";
    }
    canvas.text(Text::start([24.0, 56.0], facts).class("dim"));
    canvas.text(Text::start([24.0, 74.0], report.reference_text()).class("dim"));
}

fn axes(report: &Report, x: &Axis, y: &Axis, canvas: &mut Canvas) {
    let [left, top, right, bottom] = AREA;
    for (value, is_named) in x.ticks() {
        let at = x.at(value);
        canvas.line([at, top], [at, bottom], if is_named { "grid" } else { "fine" });
        if is_named {
            canvas.text(Text::middle([at, bottom + 20.0], report.cost_text(value)).class("dim"));
        }
    }
    for (value, is_named) in y.ticks() {
        let at = y.at(value);
        canvas.line([left, at], [right, at], if is_named { "grid" } else { "fine" });
        if is_named {
            canvas.text(Text::end([left - 10.0, at + 4.0], report.with_unit(value)).class("dim"));
        }
    }
    canvas.frame(AREA);
    canvas.text(Text::middle([0.5 * (left + right), bottom + 48.0], report.cost_name()));
    canvas.upward_text([26.0, 0.5 * (top + bottom)], &report.measure);
}

/// The part of the picture where rows are as good as the reference.
fn floor(report: &Report, y: &Axis, canvas: &mut Canvas) {
    let [left, _, right, bottom] = AREA;
    let as_good = report.rows.iter().filter(|row| row.is_as_good_as_reference());
    let edge = as_good.map(Row::ranked_error).fold(0.0, f64::max);
    if edge > 0.0 {
        let top = y.at(edge).min(bottom);
        canvas.rectangle([left, top, right, bottom], "floor");
    }
}

/// Lines and marks of all series, and the front beneath them.
fn lines(report: &Report, dots: &[Dot<'_>], series: usize, canvas: &mut Canvas, labels: &mut Labels) {
    let by_cost = |mut dots: Vec<&Dot<'_>>| -> Vec<Place> {
        dots.sort_by(|one, other| one.row.cost().total_cmp(&other.row.cost()));
        dots.iter().map(|dot| dot.place).collect()
    };
    let front = by_cost(dots.iter().filter(|dot| report.is_on_front(dot.row)).collect());
    canvas.polyline(&front, "front");
    for index in 0..series {
        let mut of_series: Vec<&Dot<'_>> = dots.iter().filter(|dot| dot.series == index).collect();
        of_series.sort_by(|one, other| {
            let fineness =
                |dot: &Dot<'_>| f64::from(dot.row.settings.tick_rate) * f64::from(dot.row.settings.substeps);
            fineness(one).total_cmp(&fineness(other))
        });
        let places: Vec<Place> = of_series.iter().map(|dot| dot.place).collect();
        canvas.polyline(&places, &format!("line s{}", index % canvas::COLOURS));
        labels.avoid_line(&places);
    }
    for dot in dots {
        canvas.mark(Mark {
            place: dot.place,
            series: dot.series,
            is_hollow: dot.row.is_as_good_as_reference(),
        });
        labels.avoid_mark(dot.place);
    }
}

/// Names the rows of the front, where there is room.
fn name_front(report: &Report, dots: &[Dot<'_>], canvas: &mut Canvas, labels: &mut Labels) {
    for row in report.front() {
        let Some(dot) = dots.iter().find(|dot| core::ptr::eq(dot.row, row)) else { continue };
        if let Some(text) = labels.beside(dot.place, &row.label) {
            canvas.text(text.class("name"));
        }
    }
}

/// Slopes of first and second order, through the cheapest row: where it would lead if cost were all in steps.
/// Returns both ends of each.
fn guides(dots: &[Dot<'_>], [x, y]: [&Axis; 2], canvas: &mut Canvas) -> Vec<[Place; 2]> {
    let cheapest = dots.iter().min_by(|one, other| one.row.cost().total_cmp(&other.row.cost()));
    let Some(start) = cheapest.map(|dot| dot.place) else { return Vec::new() };
    let mut ends = Vec::new();
    for order in [1.0, 2.0] {
        // Down by `order` decades for each decade to the right.
        let slope = order * y.decade().abs() / x.decade();
        let across = (AREA[2] - start[0]).min((AREA[3] - start[1]) / slope);
        let end = [start[0] + across, start[1] + across * slope];
        canvas.line(start, end, "guide");
        ends.push([start, end]);
    }
    ends
}

/// Names the slopes near their ends, or farther up where there is no room.
fn name_guides(guides: &[[Place; 2]], canvas: &mut Canvas, labels: &mut Labels) {
    for (&[start, end], name) in guides.iter().zip(["order 1", "order 2"]) {
        let places = [1.0, 0.94, 0.88, 0.8, 0.7, 0.6]
            .map(|part| [0, 1].map(|axis| start[axis] + part * (end[axis] - start[axis])));
        let found = places.into_iter().find_map(|place| labels.beside(place, name));
        if let Some(text) = found {
            canvas.text(text.class("dim"));
        }
    }
}

#[cfg(test)]
mod tests;
