//! A chart as a picture: error against cost, both in powers of ten.
//!
//! Written by hand, as text: the picture is lines, marks and words, and what makes it legible (which words find
//! room, what stands on the axes, two themes in one file) is nothing that a plotting library without fonts
//! decides for us.

mod axis;
mod canvas;
mod labels;
mod legend;

use crate::report::chart::{Chart, Mark, Point};
use crate::report::plot::axis::Axis;
use crate::report::plot::canvas::{Canvas, Place, Sign, Text};
use crate::report::plot::labels::Labels;

/// Size of the picture, px.
const SIZE: [f64; 2] = [960.0, 600.0];
/// The part of it that shows points: left, top, right, bottom, px.
const AREA: [f64; 4] = [96.0, 92.0, 726.0, 526.0];
/// Base line of the first line of facts, from line to line, and end of a line, px.
const FACTS: [f64; 3] = [52.0, 16.0, SIZE[0] - 24.0];
/// Lines of facts that find room above the points.
const MOST_FACTS: usize = 3;

/// A point in the picture.
struct Dot<'a> {
    point: &'a Point,
    /// Index of its series.
    series: usize,
    place: Place,
}

/// From costs and errors to pixels.
struct Axes {
    x: Axis,
    y: Axis,
}

impl Axes {
    fn place(&self, [cost, error]: [f64; 2]) -> Place {
        [self.x.at(cost), self.y.at(error)]
    }
}

/// What is 0 or not finite has no place on an axis of powers of ten.
fn is_drawn(point: &Point) -> bool {
    [point.cost, point.error].iter().all(|value| *value > 0.0 && value.is_finite())
}

pub(super) fn svg(chart: &Chart) -> String {
    let mut canvas = Canvas::new(SIZE);
    headings(chart, &mut canvas);
    let points = || chart.series.iter().flat_map(|series| &series.points).filter(|point| is_drawn(point));
    if points().next().is_none() {
        canvas.text(Text::middle([411.0, 300.0], "no row has an error that is neither 0 nor infinite"));
        return canvas.finish();
    }
    let axes = Axes {
        x: Axis::new(points().map(|point| point.cost), [AREA[0], AREA[2]]),
        y: Axis::new(points().map(|point| point.error), [AREA[3], AREA[1]]),
    };
    let mut dots = Vec::new();
    for (series, points) in chart.series.iter().map(|series| &series.points).enumerate() {
        for point in points.iter().filter(|point| is_drawn(point)) {
            dots.push(Dot { point, series, place: axes.place([point.cost, point.error]) });
        }
    }
    draw_axes(chart, &axes, &mut canvas);
    floor(&dots, &mut canvas);
    let mut labels = Labels::new(AREA);
    let guides = if chart.has_slopes { guides(&dots, &axes, &mut canvas) } else { Vec::new() };
    let front: Vec<Place> = chart.front.iter().map(|&place| axes.place(place)).collect();
    canvas.polyline(&front, "front");
    lines(&dots, chart.series.len(), &mut canvas, &mut labels);
    for dot in dots.iter().filter(|dot| !dot.point.label.is_empty()) {
        if let Some(text) = labels.beside(dot.place, &dot.point.label) {
            canvas.text(text.class(canvas::NAMES[dot.series % canvas::COLOURS]));
        }
    }
    name_guides(&guides, &mut canvas, &mut labels);
    legend::draw(chart, !guides.is_empty(), &mut canvas);
    canvas.finish()
}

fn headings(chart: &Chart, canvas: &mut Canvas) {
    canvas.text(Text::start([24.0, 34.0], &chart.title).class("title"));
    let [first, pitch, end] = FACTS;
    let lines = chart.facts.iter().flat_map(|fact| wrapped(fact, end - 24.0));
    for (index, line) in lines.take(MOST_FACTS).enumerate() {
        canvas.text(Text::start([24.0, first + pitch * index as f64], line).class("dim"));
    }
}

/// A text in lines of at most a width, px; a longer word has a line of its own.
fn wrapped(text: &str, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if canvas::width(line) + canvas::width(" ") + canvas::width(word) <= most => {
                *line = format!("{line} {word}");
            }
            _ => lines.push(word.into()),
        }
    }
    lines
}

fn draw_axes(chart: &Chart, Axes { x, y }: &Axes, canvas: &mut Canvas) {
    let [left, top, right, bottom] = AREA;
    for (value, is_named) in x.ticks() {
        let at = x.at(value);
        canvas.line([at, top], [at, bottom], if is_named { "grid" } else { "fine" });
        if is_named {
            let figure = chart.cost.unit.figure(value);
            canvas.text(Text::middle([at, bottom + 20.0], figure).class("dim"));
        }
    }
    for (value, is_named) in y.ticks() {
        let at = y.at(value);
        canvas.line([left, at], [right, at], if is_named { "grid" } else { "fine" });
        if is_named {
            let figure = chart.error.unit.figure(value);
            canvas.text(Text::end([left - 10.0, at + 4.0], figure).class("dim"));
        }
    }
    canvas.frame(AREA);
    canvas.text(Text::middle([0.5 * (left + right), bottom + 48.0], &chart.cost.name));
    canvas.upward_text([26.0, 0.5 * (top + bottom)], &chart.error.name);
}

/// The part of the picture where runs are as good as the reference.
fn floor(dots: &[Dot<'_>], canvas: &mut Canvas) {
    let [left, top, right, bottom] = AREA;
    let as_good = dots.iter().filter(|dot| dot.point.mark == Mark::AsGoodAsReference);
    if let Some(edge) = as_good.map(|dot| dot.place[1]).reduce(f64::min) {
        canvas.rectangle([left, edge.clamp(top, bottom), right, bottom], "floor");
    }
}

/// Lines and marks of all series.
fn lines(dots: &[Dot<'_>], series: usize, canvas: &mut Canvas, labels: &mut Labels) {
    let (aside, marked): (Vec<&Dot<'_>>, Vec<&Dot<'_>>) =
        dots.iter().partition(|dot| dot.point.mark == Mark::Aside);
    for dot in aside {
        canvas.dot(dot.place, dot.series);
    }
    for index in 0..series {
        let of_series = marked.iter().filter(|dot| dot.series == index && dot.point.mark != Mark::Apart);
        let places: Vec<Place> = of_series.map(|dot| dot.place).collect();
        canvas.polyline(&places, &format!("line s{}", index % canvas::COLOURS));
        labels.avoid_line(&places);
    }
    for dot in marked {
        let is_hollow = dot.point.mark == Mark::AsGoodAsReference;
        canvas.sign(Sign { place: dot.place, series: dot.series, is_hollow });
        labels.avoid_mark(dot.place);
    }
}

/// Slopes of first and second order, through the cheapest point: where it would lead if cost were all in steps.
/// Returns both ends of each; none where the cheapest is as good as the reference, as no error below it is known.
fn guides(dots: &[Dot<'_>], Axes { x, y }: &Axes, canvas: &mut Canvas) -> Vec<[Place; 2]> {
    let cheapest = dots.iter().min_by(|one, other| one.point.cost.total_cmp(&other.point.cost));
    let known = cheapest.filter(|dot| dot.point.mark != Mark::AsGoodAsReference);
    let Some(start) = known.map(|dot| dot.place) else { return Vec::new() };
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
