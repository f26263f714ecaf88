//! The keys, on a card above the scene.

use macroquad::math::Rect;
use rustycs::Vec2;

use crate::canvas::{Canvas, Face, Style};
use crate::theme;

const HEADING: Style = Style::new(Face::Strong, 17, theme::TEXT);
const KEY: Style = Style::new(Face::Mono, 13, theme::ACCENT);
const WORDS: Style = Style::new(Face::Regular, 14, theme::TEXT);

const KEYS: [(&str, &str); 11] = [
    ("Space", "pause, go on"),
    ("S  .", "a single step"),
    ("R", "restart the scene"),
    ("N  →", "next scene"),
    ("P  ←", "previous scene"),
    ("C", "contact points, normals"),
    ("B", "boxes: bodies, broad phase"),
    ("Wheel", "zoom at the mouse"),
    ("Drag", "move the picture"),
    ("Home", "whole scene again"),
    ("H  F1", "this card; Esc closes it"),
];

/// Size of the card, px.
const SIZE: Vec2 = Vec2::new(336.0, 348.0);

/// Draws the card in the middle of an area.
pub(crate) fn draw(canvas: &mut Canvas, area: Rect) {
    let middle = Vec2::new(area.x + 0.5 * area.w, area.y + 0.5 * area.h);
    let round = |at: Vec2| Vec2::new(at.x.round(), at.y.round());
    let (min, max) = (round(middle - SIZE * 0.5), round(middle + SIZE * 0.5));
    canvas.batch.rectangle(min, max, theme::PANEL.rgba(246));
    canvas.batch.rectangle_outline(min, max, 1.0, theme::BORDER.rgba(255));
    canvas.text("Keys", min + Vec2::new(24.0, 38.0), HEADING);
    for (line, (key, meaning)) in KEYS.into_iter().enumerate() {
        let y = 72.0 + 25.0 * line as f32;
        canvas.text(key, min + Vec2::new(24.0, y), KEY);
        canvas.text(meaning, min + Vec2::new(112.0, y), WORDS);
    }
}
