//! The figures beside the scene.

use macroquad::math::Rect;
use rustycs::{Stage, Vec2, World};
use rustycs_scenes::Scene;

use crate::canvas::{Canvas, Face, Style};
use crate::quantity::{milliseconds, with_unit};
use crate::theme::{self, Tone};

const TITLE: Style = Style::new(Face::Strong, 21, theme::TEXT);
const HEADING: Style = Style::new(Face::Strong, 12, theme::FAINT);
const WORDS: Style = Style::new(Face::Regular, 13, theme::MUTED);
const FIGURE: Style = Style::new(Face::Mono, 13, theme::TEXT);
const IDLE: Style = Style::new(Face::Mono, 13, theme::FAINT);
const IDLE_WORDS: Style = Style::new(Face::Regular, 13, theme::FAINT);

/// Space between the border of the panel and what is on it, px.
const PADDING: f32 = 20.0;
/// From one base line to the next, px.
const LINE: f32 = 20.0;
/// Share of a new measurement in the figure shown: it settles within half a second and can be read.
const SMOOTHING: f64 = 0.06;
/// Step times that the curve shows.
const HISTORY: usize = 120;

/// What the panel says about the run, beside what it asks the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Status {
    pub(crate) scene: &'static Scene,
    pub(crate) seed: u64,
    pub(crate) is_paused: bool,
}

/// The figures beside the scene, with the measurements of the last steps.
#[derive(Debug, Default)]
pub(crate) struct Panel {
    /// Time of each stage, s, smoothed.
    stages: [f64; Stage::ALL.len()],
    /// Time of each of the last steps, s, oldest first.
    steps: Vec<f64>,
    /// Time of a step, s, smoothed.
    step: f64,
}

impl Panel {
    /// Width of the panel, px, in a window of this width.
    pub(crate) fn width(window_width: f32) -> f32 {
        (0.22 * window_width).clamp(228.0, 288.0).round()
    }

    /// Measures the step that a world has just taken.
    pub(crate) fn observe(&mut self, world: &World) {
        let share = if self.steps.is_empty() { 1.0 } else { SMOOTHING };
        let settle = |shown: &mut f64, measured: f64| *shown += (measured - *shown) * share;
        for (shown, (_, report)) in self.stages.iter_mut().zip(world.profile().stages()) {
            settle(shown, report.seconds.unwrap_or(0.0));
        }
        let seconds = world.profile().seconds().unwrap_or(0.0);
        settle(&mut self.step, seconds);
        if self.steps.len() == HISTORY {
            self.steps.remove(0);
        }
        self.steps.push(seconds);
    }

    /// Draws the panel. What does not fit into its height is left out from the bottom.
    pub(crate) fn draw(&self, canvas: &mut Canvas, area: Rect, world: &World, status: Status) {
        let (min, max) = (Vec2::new(area.x, area.y), Vec2::new(area.x + area.w, area.y + area.h));
        canvas.batch.rectangle(min, max, theme::PANEL.rgba(255));
        canvas.batch.rectangle(min, Vec2::new(min.x + 1.0, max.y), theme::BORDER.rgba(255));
        let mut column = Column {
            canvas,
            left: min.x + PADDING,
            right: max.x - PADDING,
            y: min.y + PADDING + 16.0,
            gap: if area.h < 680.0 { 13.0 } else { 24.0 },
        };
        column.title(world, status);
        column.counts(world);
        self.draw_times(&mut column, world);
        column.accuracy(world);
        let materials_end = column.y + theme::MATERIALS.len().div_ceil(2) as f32 * LINE;
        if materials_end < max.y - 2.0 * LINE {
            column.materials();
        }
        let place = Vec2::new(column.left, max.y - 16.0);
        column.canvas.text("H  all keys", place, IDLE_WORDS);
    }

    /// Step time, its curve, and a bar for each stage.
    fn draw_times(&self, column: &mut Column<'_>, world: &World) {
        column.heading("STEP");
        column.figure("total", milliseconds(self.step), FIGURE);
        self.draw_curve(column);
        let stages = || world.profile().stages().zip(self.stages);
        let ran = stages().filter(|((_, report), _)| report.ran);
        let longest = ran.map(|(_, seconds)| seconds).fold(1e-9, f64::max);
        for ((stage, report), seconds) in stages() {
            let share = if report.ran { (seconds / longest) as f32 } else { 0.0 };
            let figure = if report.ran { format!("{:.3}", seconds * 1e3) } else { "–".to_owned() };
            column.bar(stage.name(), report.ran, share, &figure);
        }
        column.y += column.gap;
    }

    /// The times of the last steps as a curve; its top is the longest of them.
    fn draw_curve(&self, column: &mut Column<'_>) {
        const HEIGHT: f32 = 34.0;
        let (top, bottom) = (column.y - 10.0, column.y - 10.0 + HEIGHT);
        let (left, right) = (column.left, column.right);
        let batch = &mut column.canvas.batch;
        batch.rectangle(Vec2::new(left, top), Vec2::new(right, bottom), theme::BACKGROUND.rgba(255));
        let longest = self.steps.iter().copied().fold(1e-9, f64::max);
        let pitch = (right - left) / (HISTORY - 1) as f32;
        let first = HISTORY - self.steps.len();
        let at = |index: usize, seconds: f64| {
            let height = (HEIGHT - 5.0) * (seconds / longest) as f32;
            Vec2::new(left + (first + index) as f32 * pitch, bottom - 2.0 - height)
        };
        for (index, pair) in self.steps.windows(2).enumerate() {
            let (from, to) = (at(index, pair[0]), at(index + 1, pair[1]));
            batch.line(from, to, 1.5, theme::ACCENT.rgba(220));
        }
        column.y += HEIGHT + 10.0;
    }
}

/// Where the next line goes.
struct Column<'a> {
    canvas: &'a mut Canvas,
    left: f32,
    right: f32,
    /// Base line of the next line, px.
    y: f32,
    /// Space between groups, px.
    gap: f32,
}

impl Column<'_> {
    /// The scene, what to look for in it, and whether it runs.
    fn title(&mut self, world: &World, status: Status) {
        self.canvas.text(status.scene.name.replace('_', " "), Vec2::new(self.left, self.y), TITLE);
        let (state, tone) =
            if status.is_paused { ("paused", theme::PAUSED) } else { ("running", theme::ACCENT) };
        let state_style = Style { tone, ..WORDS };
        self.canvas.text_up_to(state, Vec2::new(self.right, self.y), state_style);
        self.y += 25.0;
        let place = Vec2::new(self.left, self.y);
        let lines = self.canvas.paragraph(status.scene.summary, place, self.right - self.left, 18.0, WORDS);
        self.y += lines as f32 * 18.0 + self.gap - 5.0;
        let seconds = world.ticks() as f64 * world.settings().tick_seconds();
        self.figure("time", format!("{seconds:.2} s"), FIGURE);
        self.figure("seed", status.seed.to_string(), FIGURE);
    }

    /// How much there is.
    fn counts(&mut self, world: &World) {
        let counters = world.profile().counters();
        let touching = world.contacts().filter(rustycs::ContactRef::is_touching).count();
        self.figure("bodies", world.body_count().to_string(), FIGURE);
        let awake = counters.awake_bodies;
        self.figure("awake", awake.to_string(), if awake == 0 { IDLE } else { FIGURE });
        self.figure("contacts", touching.to_string(), FIGURE);
        self.y += self.gap - 2.0;
    }

    /// How far the last step was from perfect, and the energy that is left.
    fn accuracy(&mut self, world: &World) {
        let error = world.error();
        self.heading("STATE");
        self.figure("penetration", with_unit(f64::from(error.penetration), "m"), FIGURE);
        self.figure("residual", with_unit(f64::from(error.velocity_residual), "m/s"), FIGURE);
        self.figure("kinetic", with_unit(world.kinetic_energy(), "J"), FIGURE);
        self.figure("energy", with_unit(world.energy(), "J"), FIGURE);
        self.y += self.gap - 2.0;
    }

    /// Which colour is which material.
    fn materials(&mut self) {
        self.heading("MATERIALS");
        for pair in theme::MATERIALS.chunks(2) {
            for (index, &(_, name, tone)) in pair.iter().enumerate() {
                let left = self.left + index as f32 * 0.5 * (self.right - self.left);
                self.swatch(Vec2::new(left, self.y), tone);
                self.canvas.text(name, Vec2::new(left + 18.0, self.y), WORDS);
            }
            self.y += LINE;
        }
    }

    /// A small square of a material's colour, on the base line at `place`.
    fn swatch(&mut self, place: Vec2, tone: Tone) {
        let (min, max) = (place + Vec2::new(0.0, -10.0), place + Vec2::new(11.0, 1.0));
        self.canvas.batch.rectangle(min, max, tone.mixed(theme::BACKGROUND, 0.22).rgba(255));
        self.canvas.batch.rectangle_outline(min, max, 1.5, tone.mixed(theme::TEXT, 0.45).rgba(255));
    }

    fn heading(&mut self, text: &str) {
        self.canvas.text(text, Vec2::new(self.left, self.y), HEADING);
        self.y += LINE;
    }

    /// A word on the left, a figure on the right.
    fn figure(&mut self, word: &str, figure: String, style: Style) {
        self.canvas.text(word, Vec2::new(self.left, self.y), WORDS);
        self.canvas.text_up_to(figure, Vec2::new(self.right, self.y), style);
        self.y += LINE;
    }

    /// The name of a stage, a bar, and its time, ms; all of it faint where the stage did not run.
    fn bar(&mut self, name: &str, ran: bool, share: f32, figure: &str) {
        let (words, style) = if ran { (WORDS, FIGURE) } else { (IDLE_WORDS, IDLE) };
        self.canvas.text(name, Vec2::new(self.left, self.y), words);
        self.canvas.text_up_to(figure, Vec2::new(self.right, self.y), style);
        let (from, to) = (self.left + 66.0, self.right - 56.0);
        let (top, bottom) = (self.y - 8.0, self.y - 2.0);
        let batch = &mut self.canvas.batch;
        batch.rectangle(Vec2::new(from, top), Vec2::new(to, bottom), theme::BACKGROUND.rgba(255));
        let end = from + (to - from) * share.clamp(0.0, 1.0);
        batch.rectangle(Vec2::new(from, top), Vec2::new(end, bottom), theme::ACCENT.rgba(200));
        self.y += LINE;
    }
}
