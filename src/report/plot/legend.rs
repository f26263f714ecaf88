//! What the lines and marks are.

use crate::report::plot::AREA;
use crate::report::plot::canvas::{COLOURS, Canvas, Mark, Text};
use crate::report::result::{Report, Row};

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

/// Draws the legend; `missing` rows are not in the picture.
pub(super) fn draw(report: &Report, names: &[&str], missing: usize, canvas: &mut Canvas) {
    let across = |[x, y]: [f64; 2]| [[x - 14.0, y], [x + 14.0, y]];
    let mut legend = Legend { canvas, y: AREA[1] + 12.0 };
    for (series, name) in names.iter().take(MOST_SERIES).enumerate() {
        legend.line(name, |canvas, place| {
            canvas.polyline(&across(place), &format!("line s{}", series % COLOURS));
            canvas.mark(Mark { place, series, is_hollow: false });
        });
    }
    if names.len() > MOST_SERIES {
        legend.line(&format!("and {} more", names.len() - MOST_SERIES), |_, _| ());
    }
    legend.y += 0.5 * LINE;
    if report.front().len() > 1 {
        legend.line("Pareto front", |canvas, place| canvas.polyline(&across(place), "front"));
    }
    legend.line("slopes of order 1 and 2", |canvas, place| {
        let [from, to] = across(place);
        canvas.line(from, to, "guide");
    });
    if report.rows().iter().any(Row::is_as_good_as_reference) {
        legend.line("as good as the reference", |canvas, [x, y]| {
            canvas.rectangle([x - 14.0, y - 8.0, x + 14.0, y + 8.0], "floor");
            canvas.mark(Mark { place: [x, y], series: 0, is_hollow: true });
        });
    }
    if missing > 0 {
        legend.line(&format!("{missing} with error 0 or infinite"), |_, _| ());
    }
}
