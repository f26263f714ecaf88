//! Finds room for words: beside their point, on no mark and no other word, and off the lines if it can.

use crate::report::plot::canvas::{Place, Text, width};

/// Left, top, right, bottom, px.
type Box4 = [f64; 4];

/// Half the side of a mark, with a little room, px.
const MARK: f64 = 7.0;
/// Above and below the base line of a word, px.
const RISE: [f64; 2] = [10.0, 4.0];
/// Between two points at which a line is looked at, px.
const LINE_STEP: f64 = 5.0;

/// What words must not cover.
#[derive(Debug)]
pub(super) struct Labels {
    area: Box4,
    taken: Vec<Box4>,
    /// Points on lines.
    lines: Vec<Place>,
}

fn overlap(a: &Box4, b: &Box4) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

impl Labels {
    pub(super) fn new(area: Box4) -> Self {
        Self { area, taken: Vec::new(), lines: Vec::new() }
    }

    pub(super) fn avoid_mark(&mut self, [x, y]: Place) {
        self.taken.push([x - MARK, y - MARK, x + MARK, y + MARK]);
    }

    pub(super) fn avoid_line(&mut self, places: &[Place]) {
        for pair in places.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / LINE_STEP).ceil().max(1.0);
            for step in 0..=steps as usize {
                let part = step as f64 / steps;
                self.lines.push([0, 1].map(|axis| from[axis] + part * (to[axis] - from[axis])));
            }
        }
    }

    /// A word beside a point, where it covers least; nothing if there is no room.
    pub(super) fn beside(&mut self, [x, y]: Place, name: &str) -> Option<Text> {
        let wide = width(name);
        // Below on the left first: there the front has nothing.
        let offsets = [
            [-10.0 - wide, 16.0],
            [-12.0 - wide, 4.0],
            [-0.5 * wide, 24.0],
            [10.0, 18.0],
            [12.0, 4.0],
            [10.0, -10.0],
            [-0.5 * wide, -14.0],
            [-10.0 - wide, -10.0],
            [-14.0 - wide, 30.0],
            [14.0, -26.0],
        ];
        let mut best: Option<(usize, [f64; 2], Box4)> = None;
        for [dx, dy] in offsets {
            let at = [x + dx, y + dy];
            let place = [at[0], at[1] - RISE[0], at[0] + wide, at[1] + RISE[1]];
            let [left, top, right, bottom] = self.area;
            let is_inside = place[0] > left && place[1] > top && place[2] < right && place[3] < bottom;
            if !is_inside || self.taken.iter().any(|taken| overlap(taken, &place)) {
                continue;
            }
            let covered = self
                .lines
                .iter()
                .filter(|[x, y]| overlap(&place, &[*x - 1.0, *y - 1.0, *x + 1.0, *y + 1.0]))
                .count();
            if best.is_none_or(|(least, ..)| covered < least) {
                best = Some((covered, at, place));
            }
        }
        let (_, at, place) = best?;
        self.taken.push(place);
        Some(Text::start(at, name))
    }
}
