//! What lengths and colours of the overlays mean, in the lower left corner.

use macroquad::math::Rect;
use rustycs::Vec2;

use crate::camera::Camera;
use crate::canvas::{Canvas, Face, Style};
use crate::quantity::with_unit;
use crate::theme::{self, Tone};

pub(super) const WORDS: Style = Style::new(Face::Mono, 12, theme::MUTED);

/// Length of the line in the legend, px: quantities of 1 to 2.5 times its value are drawn 48 to 120 px long.
pub(super) const LENGTH: f32 = 48.0;
/// From one line of the legend to the next, px.
const LINE: f32 = 20.0;

/// A quantity drawn as a length: how much 48 px stand for. A round figure that follows the largest one seen, but
/// not at once, so that lengths do not dance.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Scale {
    unit: f32,
}

/// The scales of all quantities that are drawn as lengths.
#[derive(Debug, Default)]
pub(super) struct Scales {
    pub(super) impulse: Scale,
    pub(super) depth: Scale,
    pub(super) speed: Scale,
    pub(super) force: Scale,
}

impl Scale {
    /// A scale that follows nothing.
    pub(super) fn fixed(unit: f32) -> Self {
        Self { unit }
    }

    /// Takes the largest quantity of this frame into account.
    pub(super) fn follow(&mut self, largest: f32) {
        if largest > 0.0 && largest.is_finite() {
            let is_apt = (0.5 * self.unit..=3.5 * self.unit).contains(&largest);
            if !is_apt {
                self.unit = round_down(largest);
            }
        }
    }

    /// The length of a quantity, px, up to a little beyond what fits the legend.
    pub(super) fn length(self, quantity: f32) -> f32 {
        if self.unit > 0.0 { (LENGTH * quantity / self.unit).clamp(-190.0, 190.0) } else { 0.0 }
    }

    /// What 48 px stand for.
    pub(super) fn unit(self) -> f32 {
        self.unit
    }
}

/// The largest of 1, 2, 5 times a power of ten that is not above a positive number.
fn round_down(value: f32) -> f32 {
    let power = 10_f32.powi(value.log10().floor() as i32);
    [5.0, 2.0, 1.0].map(|digit| digit * power).into_iter().find(|round| *round <= value).unwrap_or(power)
}

/// Lines of the legend, from the bottom up.
pub(super) struct Legend {
    left: f32,
    bottom: f32,
    /// Base line of the next line, px.
    y: f32,
    /// Width of the widest line, px.
    width: f32,
    /// Other places that have words on them, px.
    words: Vec<Rect>,
}

impl Legend {
    /// An empty legend; with `is_raised` it leaves room for the figures of the grid.
    pub(super) fn new(camera: Camera, is_raised: bool) -> Self {
        let area = camera.area();
        let room = if is_raised { 46.0 } else { 18.0 };
        let (left, bottom) = (area.x + if is_raised { 62.0 } else { 20.0 }, area.y + area.h - room);
        Self { left, bottom, y: bottom, width: 0.0, words: Vec::new() }
    }

    /// Keeps other words away from a place.
    pub(super) fn reserve(&mut self, place: Rect) {
        self.words.push(place);
    }

    /// All places that have words on them, px.
    pub(super) fn places(mut self) -> Vec<Rect> {
        self.words.push(Rect::new(self.left, self.y + 4.0, self.width, self.bottom - self.y));
        self.words
    }

    /// A line that is as long as the quantity beside it is drawn.
    pub(super) fn scale(&mut self, canvas: &mut Canvas, tone: Tone, scale: Scale, unit: &str) {
        if scale.unit > 0.0 {
            let text = with_unit(f64::from(scale.unit), unit);
            let from = Vec2::new(self.left, self.y - 4.0);
            canvas.batch().line(from, from + Vec2::new(LENGTH, 0.0), 2.0, tone.rgba(255));
            self.write(canvas, LENGTH + 10.0, text);
        }
    }

    /// A row of coloured squares with a sentence.
    pub(super) fn swatches(&mut self, canvas: &mut Canvas, tones: &[Tone], text: String) {
        for (index, tone) in tones.iter().enumerate() {
            let min = Vec2::new(self.left + 13.0 * index as f32, self.y - 9.0);
            canvas.batch().rectangle(min, min + Vec2::new(10.0, 10.0), tone.rgba(255));
        }
        self.write(canvas, 13.0 * tones.len() as f32 + 7.0, text);
    }

    /// The text of a line.
    fn write(&mut self, canvas: &mut Canvas, indent: f32, text: String) {
        self.width = self.width.max(indent + canvas.width_of(&text, WORDS) + 8.0);
        canvas.tag(text, Vec2::new(self.left + indent, self.y), WORDS.toned(theme::TEXT));
        self.y -= LINE;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_is_a_round_figure_and_does_not_dance() {
        for (value, round) in [(1.0, 1.0), (4.9, 2.0), (0.07, 0.05), (990.0, 500.0)] {
            assert!((round_down(value) / round - 1.0).abs() < 1e-5, "{value}");
        }
        let mut scale = Scale::default();
        scale.follow(4.0);
        scale.follow(6.0);
        assert_eq!(scale.unit, 2.0);
        scale.follow(8.0);
        assert_eq!(scale.unit, 5.0);
    }
}
