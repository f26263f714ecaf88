//! Things in the panel that are read and pressed: each is drawn, and asked whether it was pressed, at once.

use rustycs::Vec2;

use crate::canvas::{Canvas, Face, Style};
use crate::gauges::{CURVE_LENGTH, Curve};
use crate::icon::Icon;
use crate::theme::{self, Tone};

pub(crate) const HEADING: Style = Style::new(Face::Strong, 12, theme::FAINT);
pub(crate) const WORDS: Style = Style::new(Face::Regular, 13, theme::MUTED);
pub(crate) const FIGURE: Style = Style::new(Face::Mono, 13, theme::TEXT);
const LABEL: Style = Style::new(Face::Regular, 13, theme::TEXT);
const KEY: Style = Style::new(Face::Mono, 12, theme::FAINT);

/// Height of a line of text, px.
const LINE: f32 = 20.0;
/// Height of a thing that can be pressed by a mouse, and by a finger, px.
pub(crate) const PRESS: f32 = 24.0;
pub(crate) const FINGER: f32 = 38.0;
/// Height of a curve, px.
const CURVE: f32 = 36.0;

/// The mouse in this frame.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Pointer {
    /// Where it is, px.
    pub(crate) at: Vec2,
    /// Whether its left button has just gone down.
    pub(crate) pressed: bool,
    /// Whether it has been down for so long that what it presses is pressed again.
    pub(crate) repeats: bool,
    /// Notches of the wheel, up positive.
    pub(crate) wheel: f32,
    /// How far a finger that went down in the panel has moved down since the last frame, px.
    pub(crate) drag: Option<f32>,
    /// Whether it is a finger.
    pub(crate) is_touch: bool,
}

/// What the keys do to the thing that is chosen by keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Nudge {
    Press,
    /// Less (negative) or more.
    Turn(i32),
}

/// Which thing is chosen by keys, counted from the top, and what keys do to it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Focus {
    pub(crate) index: Option<usize>,
    pub(crate) nudge: Option<Nudge>,
    /// How many things there are, after all of them were drawn.
    pub(crate) count: usize,
    /// How far the chosen thing is out of sight, px: positive below.
    pub(crate) hidden: f32,
}

/// A box in the window, px.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) min: Vec2,
    pub(crate) max: Vec2,
}

impl Place {
    fn contains(self, at: Vec2) -> bool {
        (self.min.x..self.max.x).contains(&at.x) && (self.min.y..self.max.y).contains(&at.y)
    }

    pub(crate) fn middle(self) -> Vec2 {
        (self.min + self.max) * 0.5
    }
}

/// How a thing that can be pressed stands in this frame.
#[derive(Clone, Copy, Debug)]
struct Press {
    is_hovered: bool,
    is_focused: bool,
    is_pressed: bool,
    /// Turned by keys.
    turned: i32,
}

/// A column of things, from the top down.
pub(crate) struct Ui<'a> {
    pub(crate) canvas: &'a mut Canvas,
    pub(crate) left: f32,
    pub(crate) right: f32,
    /// Top of the next thing, px.
    pub(crate) y: f32,
    /// What is not wholly between these heights is not drawn, px.
    pub(crate) sight: [f32; 2],
    pub(crate) pointer: Pointer,
    pub(crate) focus: &'a mut Focus,
    /// Height of a thing that can be pressed, px.
    pub(crate) press: f32,
    /// Where the last thing is, if it is in sight.
    pub(crate) last: Option<Place>,
    /// What is to be said about the thing under the mouse.
    pub(crate) tip: Option<(Place, &'static str)>,
}

impl Ui<'_> {
    /// Room for the next thing; `None` where it would be out of sight.
    fn room(&mut self, height: f32) -> Option<Place> {
        let min = Vec2::new(self.left, self.y);
        let place = Place { min, max: Vec2::new(self.right, self.y + height) };
        self.y += height;
        let is_in_sight = place.min.y >= self.sight[0] && place.max.y <= self.sight[1];
        self.last = is_in_sight.then_some(place);
        self.last
    }

    /// Explains the last thing to whoever points at it.
    pub(crate) fn explain(&mut self, text: &'static str) {
        if let Some(place) = self.last.filter(|place| place.contains(self.pointer.at)) {
            self.tip = Some((place, text));
        }
    }

    pub(crate) fn gap(&mut self, height: f32) {
        self.y += height;
    }

    /// Whether a thing at a place is pressed, by mouse or by keys.
    fn ask(&mut self, place: Option<Place>, bottom: f32) -> Press {
        let is_focused = self.focus.index == Some(self.focus.count);
        self.focus.count += 1;
        if is_focused && place.is_none() {
            self.focus.hidden = if bottom > self.sight[1] { bottom - self.sight[1] } else { -self.press };
        }
        let is_hovered = place.is_some_and(|place| place.contains(self.pointer.at));
        let nudge = self.focus.nudge.filter(|_| is_focused);
        let by_mouse = is_hovered && self.pointer.pressed;
        if by_mouse {
            self.focus.index = None;
        }
        Press {
            is_hovered,
            is_focused,
            is_pressed: by_mouse || nudge == Some(Nudge::Press),
            turned: if let Some(Nudge::Turn(by)) = nudge { by } else { 0 },
        }
    }

    /// The ground of a thing that can be pressed.
    fn ground(&mut self, place: Place, press: Press, is_chosen: bool) {
        let tone = match (is_chosen, press.is_hovered) {
            (true, _) => theme::CHOSEN,
            (false, true) => theme::HOVERED,
            (false, false) => theme::BUTTON,
        };
        self.canvas.batch().rectangle(place.min, place.max, tone.rgba(255));
        if press.is_focused {
            self.canvas.batch().rectangle_outline(place.min, place.max, 1.5, theme::ACCENT.rgba(255));
        }
    }

    pub(crate) fn heading(&mut self, text: &str) {
        self.gap(6.0);
        if let Some(place) = self.room(LINE) {
            self.canvas.text(text, place.min + Vec2::new(0.0, 14.0), HEADING);
        }
    }

    /// Text in as many lines as it takes.
    pub(crate) fn paragraph(&mut self, text: &str, style: Style) {
        for line in self.canvas.lines(text, self.right - self.left, style) {
            if let Some(place) = self.room(18.0) {
                self.canvas.text(line, place.min + Vec2::new(0.0, 13.0), style);
            }
        }
    }

    /// A word on the left, a figure on the right.
    pub(crate) fn figure(&mut self, word: &str, figure: &str, style: Style) {
        if let Some(place) = self.room(LINE) {
            self.canvas.text(word, place.min + Vec2::new(0.0, 14.0), WORDS);
            let used = self.canvas.width_of(word, WORDS) + 8.0;
            let figure = self.canvas.fitting(figure, self.right - self.left - used, style);
            self.canvas.text_up_to(figure, Vec2::new(place.max.x, place.min.y + 14.0), style);
        }
    }

    /// Buttons side by side, some of them chosen; which one is pressed.
    pub(crate) fn buttons(&mut self, labels: &[(&str, bool)]) -> Option<usize> {
        let row = self.room(self.press);
        let bottom = self.y;
        let mut pressed = None;
        // A longer label gets a wider button.
        let widths: Vec<f32> =
            labels.iter().map(|(label, _)| self.canvas.width_of(label, WORDS) + 8.0).collect();
        for (index, &(label, is_chosen)) in labels.iter().enumerate() {
            let place = row.map(|row| part(row, index, &widths));
            let press = self.ask(place, bottom);
            if press.is_pressed {
                pressed = Some(index);
            }
            let Some(place) = place else { continue };
            self.ground(place, press, is_chosen);
            let style = if is_chosen { LABEL } else { WORDS };
            let label = self.canvas.fitting(label, place.max.x - place.min.x - 4.0, style);
            let at = Vec2::new(place.middle().x, place.middle().y + 4.0);
            self.canvas.text_around(label, at, style);
        }
        self.gap(4.0);
        pressed
    }

    /// Buttons with pictures and what they do, side by side; which one is pressed.
    pub(crate) fn icons(&mut self, icons: &[(Icon, bool, &'static str)]) -> Option<usize> {
        let row = self.room(self.press + 4.0);
        let bottom = self.y;
        let mut pressed = None;
        let widths = vec![1.0; icons.len()];
        for (index, &(icon, is_chosen, meaning)) in icons.iter().enumerate() {
            let place = row.map(|row| part(row, index, &widths));
            let press = self.ask(place, bottom);
            if press.is_pressed {
                pressed = Some(index);
            }
            let Some(place) = place else { continue };
            self.ground(place, press, is_chosen);
            if press.is_hovered && !self.pointer.is_touch {
                self.tip = Some((place, meaning));
            }
            icon.draw(self.canvas.batch(), place.middle(), theme::TEXT.rgba(255));
        }
        self.gap(4.0);
        pressed
    }

    /// A button with a picture at a place of its own; whether it is pressed by the mouse.
    pub(crate) fn small_button(&mut self, place: Place, icon: Icon) -> bool {
        // A finger is thicker than the picture.
        let room = Vec2::splat(if self.pointer.is_touch { 8.0 } else { 0.0 });
        let is_hovered = Place { min: place.min - room, max: place.max + room }.contains(self.pointer.at);
        let press = Press { is_hovered, is_focused: false, is_pressed: false, turned: 0 };
        self.ground(place, press, false);
        icon.draw(self.canvas.batch(), place.middle(), theme::MUTED.rgba(255));
        if is_hovered {
            self.tip = Some((place, "Hide the panel, or show it (F2)"));
        }
        is_hovered && self.pointer.pressed
    }

    /// A box with a tick in it or none, a label, and the key that does the same; whether it is pressed.
    pub(crate) fn tick_box(&mut self, label: &str, is_on: bool, key: &str) -> bool {
        let place = self.room(self.press - 2.0);
        let press = self.ask(place, self.y);
        let Some(place) = place else { return press.is_pressed };
        if press.is_hovered || press.is_focused {
            let shown = Press { is_focused: press.is_focused, is_hovered: true, ..press };
            let wider = Vec2::new(5.0, 0.0);
            self.ground(Place { min: place.min - wider, max: place.max + wider }, shown, false);
        }
        let min = Vec2::new(place.min.x, (place.middle().y - 7.0).floor());
        let max = min + Vec2::splat(14.0);
        let batch = self.canvas.batch();
        let tone = if is_on { theme::ACCENT } else { theme::BACKGROUND };
        batch.rectangle(min, max, tone.rgba(255));
        batch.rectangle_outline(min, max, 1.0, theme::BORDER.mixed(theme::TEXT, 0.2).rgba(255));
        if is_on {
            let dark = theme::BACKGROUND.rgba(255);
            let [one, two, three] = [[3.0, 7.5], [6.0, 10.5], [11.5, 4.0]].map(|at| min + Vec2::from(at));
            batch.line(one, two, 2.0, dark);
            batch.line(two, three, 2.0, dark);
        }
        let base = place.middle().y + 4.0;
        self.canvas.text(label, Vec2::new(place.min.x + 22.0, base), if is_on { LABEL } else { WORDS });
        self.canvas.text_up_to(key, Vec2::new(place.max.x, base), KEY);
        press.is_pressed
    }

    /// A line of a list; whether it is pressed.
    pub(crate) fn list_row(&mut self, label: &str, is_chosen: bool) -> bool {
        let place = self.room(self.press - 2.0);
        let press = self.ask(place, self.y);
        let Some(place) = place else { return press.is_pressed };
        if is_chosen || press.is_hovered || press.is_focused {
            self.ground(place, press, is_chosen);
        }
        let style = if is_chosen { LABEL } else { WORDS };
        let label = self.canvas.fitting(label, place.max.x - place.min.x - 16.0, style);
        self.canvas.text(label, Vec2::new(place.min.x + 8.0, place.middle().y + 4.0), style);
        press.is_pressed
    }

    /// A word, what it stands at, and buttons for less and more; by how much it is turned.
    pub(crate) fn stepper(&mut self, word: &str, text: &str) -> i32 {
        /// Width of the buttons with the text between them, as a share of the whole.
        const SHARE: f32 = 0.58;
        let side = self.press - 2.0;
        let place = self.room(self.press);
        let split = self.right - SHARE * (self.right - self.left);
        let less = place.map(|at| Place {
            min: Vec2::new(split, at.min.y + 1.0),
            max: Vec2::new(split + side, at.max.y - 1.0),
        });
        let more = place.map(|at| Place {
            min: Vec2::new(at.max.x - side, at.min.y + 1.0),
            max: at.max - Vec2::new(0.0, 1.0),
        });
        // One thing for the keys, two for the mouse.
        let press = self.ask(less, self.y);
        let is_over_more = more.is_some_and(|more| more.contains(self.pointer.at));
        let is_turned = self.pointer.pressed || self.pointer.repeats;
        let by_mouse = i32::from(is_over_more && is_turned) - i32::from(press.is_hovered && is_turned);
        let by_keys = if press.is_pressed && by_mouse == 0 { 1 } else { press.turned };
        let (Some(place), Some(less), Some(more)) = (place, less, more) else { return by_keys };
        self.canvas.text(word, Vec2::new(place.min.x, place.middle().y + 4.0), WORDS);
        self.ground(less, Press { is_focused: false, ..press }, false);
        self.ground(more, Press { is_focused: false, is_hovered: is_over_more, ..press }, false);
        if press.is_focused {
            self.canvas.batch().rectangle_outline(less.min, more.max, 1.5, theme::ACCENT.rgba(255));
        }
        Icon::Minus.draw(self.canvas.batch(), less.middle(), theme::MUTED.rgba(255));
        Icon::Plus.draw(self.canvas.batch(), more.middle(), theme::MUTED.rgba(255));
        let text = self.canvas.fitting(text, more.min.x - less.max.x - 4.0, FIGURE);
        let middle = 0.5 * (less.max.x + more.min.x);
        self.canvas.text_around(text, Vec2::new(middle, place.middle().y + 4.0), FIGURE);
        by_mouse + by_keys
    }

    /// A word, a bar and a figure; all of it faint where it is left out.
    pub(crate) fn bar(&mut self, word: &str, share: f32, figure: &str, is_left_out: bool) {
        let Some(place) = self.room(LINE) else { return };
        let faded = |style: Style| if is_left_out { style.toned(theme::FAINT) } else { style };
        let (words, style) = (faded(WORDS), faded(FIGURE));
        let base = place.min.y + 14.0;
        self.canvas.text(word, Vec2::new(place.min.x, base), words);
        self.canvas.text_up_to(figure, Vec2::new(place.max.x, base), style);
        let (from, to) = (place.min.x + 66.0, place.max.x - 54.0);
        let end = from + (to - from) * share.clamp(0.0, 1.0);
        let batch = self.canvas.batch();
        batch.rectangle(Vec2::new(from, base - 8.0), Vec2::new(to, base - 2.0), theme::BACKGROUND.rgba(255));
        batch.rectangle(Vec2::new(from, base - 8.0), Vec2::new(end, base - 2.0), theme::ACCENT.rgba(200));
    }

    /// A curve with its name and its last value; from 0 up, or around what it has been.
    pub(crate) fn plot(&mut self, word: &str, figure: &str, curve: &Curve, tone: Tone, from_zero: bool) {
        self.figure(word, figure, FIGURE);
        let Some(place) = self.room(CURVE) else { return };
        let batch = self.canvas.batch();
        batch.rectangle(place.min, place.max, theme::BACKGROUND.rgba(255));
        let (low, high) = curve.range();
        let low = if from_zero { low.min(0.0) } else { low };
        // The box is at least a hundredth of the value high, so that what is kept looks kept.
        let span = (high - low).max(1e-2 * high.abs().max(low.abs())).max(1e-12);
        let count = curve.values().len();
        let pitch = (place.max.x - place.min.x) / (CURVE_LENGTH - 1) as f32;
        let first = CURVE_LENGTH - count;
        let at = |index: usize, value: f64| {
            let height = (CURVE - 6.0) * ((value - low) / span) as f32;
            Vec2::new(place.min.x + (first + index) as f32 * pitch, place.max.y - 3.0 - height)
        };
        let values = curve.values().iter();
        for (index, (one, next)) in values.clone().zip(values.skip(1)).enumerate() {
            batch.line(at(index, *one), at(index + 1, *next), 1.5, tone.rgba(220));
        }
        self.gap(4.0);
    }

    /// A row of coloured squares with names, two in a line.
    pub(crate) fn swatches<'t>(&mut self, swatches: impl IntoIterator<Item = (&'t str, Tone)>) {
        let swatches: Vec<_> = swatches.into_iter().collect();
        for pair in swatches.chunks(2) {
            let Some(place) = self.room(LINE) else { continue };
            for (index, &(name, tone)) in pair.iter().enumerate() {
                let left = place.min.x + 0.5 * index as f32 * (place.max.x - place.min.x);
                let min = Vec2::new(left, place.min.y + 4.0);
                let max = min + Vec2::splat(11.0);
                let batch = self.canvas.batch();
                batch.rectangle(min, max, tone.mixed(theme::BACKGROUND, 0.22).rgba(255));
                batch.rectangle_outline(min, max, 1.5, tone.mixed(theme::TEXT, 0.45).rgba(255));
                self.canvas.text(name, Vec2::new(left + 18.0, place.min.y + 14.0), WORDS);
            }
        }
    }
}

/// One of several parts of a row, with a little space between them, as wide as their share of all widths.
fn part(row: Place, index: usize, widths: &[f32]) -> Place {
    const SPACE: f32 = 4.0;
    let scale = (row.max.x - row.min.x + SPACE) / widths.iter().sum::<f32>();
    let end = |count: usize| row.min.x + scale * widths[..count].iter().sum::<f32>();
    let (left, right) = (end(index).round(), (end(index + 1) - SPACE).round());
    Place { min: Vec2::new(left, row.min.y), max: Vec2::new(right, row.max.y) }
}
