//! What the lines and marks are.

use crate::report::chart::{Chart, Mark, Series};
use crate::report::plot::canvas::{COLOURS, Canvas, Sign, Text};
use crate::report::plot::{AREA, is_drawn};

/// Left edge of the legend, px.
const LEFT: f64 = AREA[2] + 22.0;
/// From line to line, px.
const LINE: f64 = 22.0;
/// Series that find room.
const MOST_SERIES: usize = 12;
/// Characters that find room in a line.
const MOST_CHARACTERS: usize = 24;

/// The lines of a legend, from the top down.
struct Legend<'a> {
    canvas: &'a mut Canvas,
    y: f64,
}

impl Legend<'_> {
    /// The next line: draws its sample around the given middle, and the words beside it.
    fn line(&mut self, words: &str, sample: impl FnOnce(&mut Canvas, [f64; 2])) {
        sample(self.canvas, [LEFT + 14.0, self.y]);
        let words = if words.chars().count() > MOST_CHARACTERS {
            format!("{}…", words.chars().take(MOST_CHARACTERS - 1).collect::<String>())
        } else {
            words.to_string()
        };
        self.canvas.text(Text::start([LEFT + 38.0, self.y + 4.0], words));
        self.y += LINE;
    }
}

/// Draws the legend; `has_slopes` says whether slopes are drawn.
pub(super) fn draw(chart: &Chart, has_slopes: bool, canvas: &mut Canvas) {
    let across = |[x, y]: [f64; 2]| [[x - 14.0, y], [x + 14.0, y]];
    let points = || chart.series.iter().flat_map(|series| &series.points);
    let drawn = |mark: Mark| points().any(|point| point.mark == mark && is_drawn(point));
    let mut legend = Legend { canvas, y: AREA[1] + 12.0 };
    // A series without a point in the picture keeps its colour, and has no line here.
    let is_drawn_at_all = |(_, series): &(usize, &Series)| series.points.iter().any(is_drawn);
    let series: Vec<(usize, &Series)> = chart.series.iter().enumerate().filter(is_drawn_at_all).collect();
    for &(series, Series { name, .. }) in series.iter().take(MOST_SERIES) {
        legend.line(name, |canvas, place| {
            canvas.polyline(&across(place), &format!("line s{}", series % COLOURS));
            canvas.sign(Sign { place, series, is_hollow: false });
        });
    }
    if series.len() > MOST_SERIES {
        legend.line(&format!("and {} more", series.len() - MOST_SERIES), |_, _| ());
    }
    legend.y += 0.5 * LINE;
    if chart.front.len() > 1 {
        legend.line("Pareto front", |canvas, place| canvas.polyline(&across(place), "front"));
    }
    if drawn(Mark::Aside) {
        legend.line("not worth their cost", |canvas, place| canvas.dot(place, 0));
    }
    if has_slopes {
        legend.line("slopes of order 1 and 2", |canvas, place| {
            let [from, to] = across(place);
            canvas.line(from, to, "guide");
        });
    }
    if drawn(Mark::AsGoodAsReference) {
        legend.line("as good as the reference", |canvas, [x, y]| {
            canvas.rectangle([x - 14.0, y - 8.0, x + 14.0, y + 8.0], "floor");
            canvas.sign(Sign { place: [x, y], series: 0, is_hollow: true });
        });
    }
    let missing = points().filter(|point| !is_drawn(point)).count();
    if missing > 0 {
        legend.line(&format!("{missing} with error 0 or ∞"), |_, _| ());
    }
}
