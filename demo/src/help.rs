//! The keys, on a card above the scene.

use macroquad::math::Rect;
use rustycs::Vec2;

use crate::canvas::{Canvas, Face, Style};
use crate::overlay::Overlay;
use crate::theme;

const HEADING: Style = Style::new(Face::Strong, 12, theme::FAINT);
const KEY: Style = Style::new(Face::Mono, 12, theme::ACCENT);
const WORDS: Style = Style::new(Face::Regular, 13, theme::TEXT);

const RUN: [(&str, &str); 13] = [
    ("Space", "pause, go on"),
    ("S  .", "a single tick"),
    ("R", "restart"),
    ("Backspace", "rewind by 0.25 s"),
    ("U  Ctrl+Z", "undo the last edit"),
    ("-  =", "slower, faster"),
    ("N  P", "next, previous scene"),
    ("K  Shift+K", "next, previous seed"),
    ("X", "two copies side by side"),
    ("Shift+X", "settings of the other"),
    ("Tab", "next page of the panel"),
    ("↑ ↓ Enter", "choose in it; ← → turn"),
    ("F2", "hide the panel"),
];
const TOOLS: [(&str, &str); 15] = [
    ("Drag", "pull a body, or the picture"),
    ("1 … 8", "drag, shapes, pull, delete"),
    ("[  ]", "smaller, larger"),
    ("A  Y", "material, fixed"),
    ("Q  Shift+Q", "corners"),
    ("W  Shift+W", "how many"),
    ("Insert  '", "make at the mouse"),
    ("Delete", "remove at the mouse"),
    ("F", "follow a body"),
    ("Home", "whole scene"),
    ("Wheel", "zoom at the mouse"),
    ("PgUp PgDn", "zoom"),
    ("Right drag", "move the picture"),
    ("Shift+← ↑", "move the picture"),
    ("H  F1", "this card; Esc closes"),
];

/// Width of a column, at least and at most, and of the keys in it, px.
const COLUMN: [f32; 2] = [214.0, 252.0];
const KEYS: f32 = 84.0;
const LINE: f32 = 20.0;
const PADDING: f32 = 20.0;

/// Draws the card in the middle of an area: columns side by side, or as many as fit.
pub(crate) fn draw(canvas: &mut Canvas, area: Rect) {
    let overlays = Overlay::ALL.map(|overlay| (overlay.key().1, overlay.meaning()));
    let groups: [(&str, &[(&str, &str)]); 3] =
        [("RUN", &RUN), ("MOUSE AND TOOLS", &TOOLS), ("OVERLAYS", &overlays)];
    let columns = (((area.w - PADDING) / COLUMN[0]).floor() as usize).clamp(1, groups.len());
    let column = ((area.w - PADDING) / columns as f32).clamp(COLUMN[0], COLUMN[1]);
    // The last group goes below the first where there is no room beside the others.
    let rows = |index: usize| groups[index].1.len() as f32 + 2.0;
    let height = match columns {
        3 => rows(1),
        2 => rows(1).max(rows(0) + (rows(2) / 2.0).ceil() + 1.0),
        _ => rows(0) + rows(1) + rows(2),
    };
    let leading = LINE.min((area.h - 1.4 * PADDING) / height);
    let size = Vec2::new(columns as f32 * column + PADDING, height * leading + 1.2 * PADDING);
    let middle = Vec2::new(area.x + 0.5 * area.w, area.y + 0.5 * area.h);
    let min = middle - size * 0.5;
    let min = Vec2::new(min.x.round().max(area.x), min.y.round().max(area.y));
    canvas.batch().card(min, min + size);
    let at = |place: usize, row: f32| {
        min + Vec2::new(PADDING + place as f32 * column, PADDING + 6.0 + leading * row)
    };
    let step = Vec2::new(column, leading);
    match columns {
        3 => (0..3).for_each(|index| group(canvas, at(index, 0.0), step, groups[index])),
        2 => {
            group(canvas, at(0, 0.0), step, groups[0]);
            group(canvas, at(1, 0.0), step, groups[1]);
            let half = overlays.len().div_ceil(2);
            let below = rows(0).max(rows(1)) - 1.0;
            group(canvas, at(0, below), step, ("OVERLAYS", &overlays[..half]));
            group(canvas, at(1, below), step, ("", &overlays[half..]));
        }
        _ => {
            let mut row = 0.0;
            for (index, of) in groups.into_iter().enumerate() {
                group(canvas, at(0, row), step, of);
                row += rows(index);
            }
        }
    }
}

/// A heading with its keys; `step` is from one column, and from one line, to the next, px.
fn group(canvas: &mut Canvas, place: Vec2, step: Vec2, (heading, keys): (&str, &[(&str, &str)])) {
    canvas.text(heading, place, HEADING);
    for (line, (key, meaning)) in keys.iter().enumerate() {
        let at = place + Vec2::new(0.0, step.y * (line + 1) as f32);
        canvas.text(*key, at, KEY);
        let words = canvas.fitting(meaning, step.x - KEYS - 12.0, WORDS);
        canvas.text(words, at + Vec2::new(KEYS, 0.0), WORDS);
    }
}
