//! What a frame is drawn on: triangles first, then text, so that nothing is drawn over text.

use macroquad::text::{Font, TextParams, draw_text_ex, load_ttf_font_from_bytes, measure_text};
use rustycs::Vec2;

use crate::batch::Batch;
use crate::theme::Tone;

/// A typeface of the demo.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Face {
    /// Inter, for words.
    Regular,
    /// Inter, semi-bold, for headings.
    Strong,
    /// A typewriter face, for figures: its digits are all of one width, so that they do not dance.
    Mono,
}

impl Face {
    const ALL: [Self; 3] = [Self::Regular, Self::Strong, Self::Mono];

    /// The font file (SIL Open Font License, beside it).
    fn bytes(self) -> &'static [u8] {
        match self {
            Self::Regular => include_bytes!("../assets/Inter-Regular.otf"),
            Self::Strong => include_bytes!("../assets/Inter-SemiBold.otf"),
            Self::Mono => include_bytes!("../assets/JetBrainsMono-Regular.ttf"),
        }
    }
}

/// How a text is written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Style {
    pub(crate) face: Face,
    /// Height of the font, px.
    pub(crate) size: u16,
    pub(crate) tone: Tone,
}

impl Style {
    pub(crate) const fn new(face: Face, size: u16, tone: Tone) -> Self {
        Self { face, size, tone }
    }
}

/// A text at its place: the left end of its base line, px.
struct Label {
    text: String,
    place: Vec2,
    style: Style,
}

/// What a frame is drawn on.
pub(crate) struct Canvas {
    pub(crate) batch: Batch,
    labels: Vec<Label>,
    fonts: [Font; 3],
}

impl Canvas {
    /// An empty canvas. Needs an open window: fonts are kept on the graphics card.
    pub(crate) fn new() -> Self {
        let fonts = Face::ALL.map(|face| {
            load_ttf_font_from_bytes(face.bytes()).expect("the fonts that are built in are fonts")
        });
        Self { batch: Batch::default(), labels: Vec::new(), fonts }
    }

    /// Forgets what was drawn.
    pub(crate) fn clear(&mut self) {
        self.batch.clear();
        self.labels.clear();
    }

    /// A text from `place`, the left end of its base line, to the right.
    pub(crate) fn text(&mut self, text: impl Into<String>, place: Vec2, style: Style) {
        self.labels.push(Label { text: text.into(), place, style });
    }

    /// A text up to `place`, the right end of its base line.
    pub(crate) fn text_up_to(&mut self, text: impl Into<String>, place: Vec2, style: Style) {
        let text = text.into();
        let left = place.x - self.width_of(&text, style);
        self.text(text, Vec2::new(left, place.y), style);
    }

    /// A text in as many lines as a width (px) asks for, the first base line at `place`; returns their number.
    pub(crate) fn paragraph(
        &mut self,
        text: &str,
        place: Vec2,
        width: f32,
        leading: f32,
        style: Style,
    ) -> usize {
        let lines = wrap(text, |line| self.width_of(line, style) <= width);
        let count = lines.len();
        for (index, line) in lines.into_iter().enumerate() {
            self.text(line, place + Vec2::new(0.0, index as f32 * leading), style);
        }
        count
    }

    /// Width of a text, px.
    pub(crate) fn width_of(&self, text: &str, style: Style) -> f32 {
        measure_text(text, Some(&self.fonts[style.face as usize]), style.size, 1.0).width
    }

    /// Draws everything: triangles, then the text of one typeface after the other, each of which is one draw
    /// call. Text begins at whole pixels, where it is sharpest.
    pub(crate) fn draw(&self) {
        self.batch.draw();
        for face in Face::ALL {
            for Label { text, place, style } in self.labels.iter().filter(|label| label.style.face == face) {
                let [r, g, b, a] = style.tone.rgba(255);
                let params = TextParams {
                    font: Some(&self.fonts[face as usize]),
                    font_size: style.size,
                    color: macroquad::color::Color::from_rgba(r, g, b, a),
                    ..TextParams::default()
                };
                draw_text_ex(text, place.x.round(), place.y.round(), params);
            }
        }
    }
}

/// Words in lines that fit; a word that fits nowhere has a line of its own.
fn wrap(text: &str, fits: impl Fn(&str) -> bool) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let longer = lines.last().map(|line| format!("{line} {word}")).filter(|line| fits(line));
        match longer {
            Some(longer) => *lines.last_mut().expect("there is a line to make longer") = longer,
            None => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::wrap;

    #[test]
    fn lines_are_as_long_as_fits() {
        let lines = wrap("one two three four", |line| line.len() <= 9);
        assert_eq!(lines, ["one two", "three", "four"]);
        assert_eq!(wrap("immeasurable", |_| false), ["immeasurable"]);
        assert!(wrap("", |_| true).is_empty());
    }
}
