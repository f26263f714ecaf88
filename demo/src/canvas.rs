//! What a frame is drawn on: sheets, one over the other; on each triangles first, then text, so that nothing is
//! drawn over the text of its own sheet.

use macroquad::camera::{Camera2D, set_camera, set_default_camera};
use macroquad::math::Rect;
use macroquad::text::{Font, TextParams, draw_text_ex, load_ttf_font_from_bytes, measure_text};
use macroquad::window::{screen_dpi_scale, screen_height};
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

    /// The same in another colour.
    pub(crate) const fn toned(self, tone: Tone) -> Self {
        Self { tone, ..self }
    }
}

/// A text at its place: the left end of its base line, px.
struct Label {
    text: String,
    place: Vec2,
    style: Style,
}

/// A layer of the picture.
#[derive(Default)]
struct Sheet {
    batch: Batch,
    labels: Vec<Label>,
    /// The part of the window that the sheet is cut to, px; all of it where there is none.
    clip: Option<Rect>,
}

/// What a frame is drawn on.
pub(crate) struct Canvas {
    sheets: Vec<Sheet>,
    /// Sheets in use in this frame; those beyond keep their memory for later frames.
    used: usize,
    fonts: [Font; 3],
}

impl Canvas {
    /// An empty canvas. Needs an open window: fonts are kept on the graphics card.
    pub(crate) fn new() -> Self {
        let fonts = Face::ALL.map(|face| {
            load_ttf_font_from_bytes(face.bytes()).expect("the fonts that are built in are fonts")
        });
        Self { sheets: vec![Sheet::default()], used: 1, fonts }
    }

    /// Forgets what was drawn and begins with one sheet.
    pub(crate) fn clear(&mut self) {
        self.used = 0;
        self.begin_sheet(None);
    }

    /// Begins another sheet, over all that is drawn already.
    ///
    /// A sheet that is cut to a part of the window costs a round of draw calls of its own.
    pub(crate) fn begin_sheet(&mut self, clip: Option<Rect>) {
        if self.used == self.sheets.len() {
            self.sheets.push(Sheet::default());
        }
        let sheet = &mut self.sheets[self.used];
        sheet.batch.clear();
        sheet.labels.clear();
        sheet.clip = clip;
        self.used += 1;
    }

    /// The triangles of the uppermost sheet.
    pub(crate) fn batch(&mut self) -> &mut Batch {
        &mut self.sheets[self.used - 1].batch
    }

    /// A text from `place`, the left end of its base line, to the right.
    pub(crate) fn text(&mut self, text: impl Into<String>, place: Vec2, style: Style) {
        self.sheets[self.used - 1].labels.push(Label { text: text.into(), place, style });
    }

    /// A text up to `place`, the right end of its base line.
    pub(crate) fn text_up_to(&mut self, text: impl Into<String>, place: Vec2, style: Style) {
        let text = text.into();
        let left = place.x - self.width_of(&text, style);
        self.text(text, Vec2::new(left, place.y), style);
    }

    /// A text with `place` in the middle of its base line.
    pub(crate) fn text_around(&mut self, text: impl Into<String>, place: Vec2, style: Style) {
        let text = text.into();
        let left = place.x - 0.5 * self.width_of(&text, style);
        self.text(text, Vec2::new(left, place.y), style);
    }

    /// A text on a ground that keeps it readable over bodies; `place` is the left end of its base line.
    pub(crate) fn tag(&mut self, text: impl Into<String>, place: Vec2, style: Style) {
        let text = text.into();
        let size = f32::from(style.size);
        let max = place + Vec2::new(self.width_of(&text, style) + 4.0, 0.32 * size);
        self.batch().rectangle(place - Vec2::new(4.0, size), max, crate::theme::BACKGROUND.rgba(190));
        self.text(text, place, style);
    }

    /// As much of a text as fits into a width, px, with an ellipsis where that is not all.
    pub(crate) fn fitting(&self, text: &str, width: f32, style: Style) -> String {
        if self.width_of(text, style) <= width {
            return text.to_owned();
        }
        let ends = text.char_indices().map(|(at, _)| at).rev();
        let shorter = ends.map(|end| format!("{}…", text[..end].trim_end()));
        shorter.into_iter().find(|text| self.width_of(text, style) <= width).unwrap_or_default()
    }

    /// A text in as many lines as a width (px) asks for.
    pub(crate) fn lines(&self, text: &str, width: f32, style: Style) -> Vec<String> {
        wrap(text, |line| self.width_of(line, style) <= width)
    }

    /// Width of a text, px.
    pub(crate) fn width_of(&self, text: &str, style: Style) -> f32 {
        measure_text(text, Some(&self.fonts[style.face as usize]), style.size, 1.0).width
    }

    /// Draws every sheet.
    pub(crate) fn draw(&self) {
        self.prepare_text();
        let mut is_cut = false;
        for sheet in &self.sheets[..self.used] {
            match sheet.clip {
                Some(part) => set_camera(&camera_of(part)),
                None if is_cut => set_default_camera(),
                None => {}
            }
            is_cut = sheet.clip.is_some();
            self.draw_sheet(sheet);
        }
        if is_cut {
            set_default_camera();
        }
    }

    /// Puts every letter of the frame on the picture of its font before the first is drawn.
    ///
    /// A picture that grows is a new one, and the old one is deleted: what was drawn from that earlier in the frame would be lost.
    fn prepare_text(&self) {
        for label in self.sheets[..self.used].iter().flat_map(|sheet| &sheet.labels) {
            self.width_of(&label.text, label.style);
        }
    }

    /// Triangles, then the text of one typeface after the other, each of which is one draw call. Text begins at
    /// whole pixels, where it is sharpest.
    fn draw_sheet(&self, sheet: &Sheet) {
        sheet.batch.draw();
        for face in Face::ALL {
            for Label { text, place, style } in sheet.labels.iter().filter(|label| label.style.face == face) {
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

/// A camera that shows what lies in a part of the window where it lies, and nothing beyond.
fn camera_of(part: Rect) -> Camera2D {
    let dpi = screen_dpi_scale();
    let pixels = |length: f32| (length * dpi).round() as i32;
    // The graphics card counts rows from the bottom.
    let bottom = screen_height() - part.y - part.h;
    Camera2D {
        target: part.center(),
        zoom: macroquad::math::vec2(2.0 / part.w, 2.0 / part.h),
        viewport: Some((pixels(part.x), pixels(bottom), pixels(part.w), pixels(part.h))),
        ..Camera2D::default()
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
