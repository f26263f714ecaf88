//! A frame, drawn.

use macroquad::math::Rect;
use macroquad::window::clear_background;
use rustycs::{Pose, Vec2};

use crate::app::mouse::Grip;
use crate::app::{App, SPEEDS};
use crate::camera::Camera;
use crate::canvas::{Canvas, Face, Style};
use crate::command::Command;
use crate::overlay::{Drawer, Overlay, Overlays, Paint, draw_names, draw_sums};
use crate::panel::{Shown, TALL};
use crate::scenery;
use crate::theme::{self, BodyStyle};
use crate::ui::Pointer;
use crate::{compare, help, hover};

const READOUT: Style = Style::new(Face::Regular, 14, theme::ACCENT);
const SCALE_LABEL: Style = Style::new(Face::Mono, 12, theme::MUTED);
const TOOL: Style = Style::new(Face::Regular, 13, theme::MUTED);
const HINT: Style = Style::new(Face::Regular, 14, theme::TEXT);
/// A window that is lower than this has no room for hints, px.
const LOW: f32 = 240.0;

impl App {
    /// Draws the frame, and tells what was pressed in the panel.
    pub(super) fn draw(&mut self, pointer: Pointer) -> Vec<Command> {
        let [r, g, b, a] = theme::BACKGROUND.rgba(255);
        clear_background(macroquad::color::Color::from_rgba(r, g, b, a));
        self.canvas.clear();
        let areas = self.halves();
        let is_split = areas.len() > 1;
        for (copy, &area) in areas.iter().enumerate() {
            if is_split {
                let whole = self.layout.scene;
                self.canvas.begin_sheet(Some(Rect::new(area.x, whole.y, area.w, whole.h)));
            }
            self.draw_copy(copy, self.camera.in_area(area));
        }
        self.canvas.begin_sheet(None);
        self.draw_mouse();
        self.draw_tool();
        if is_split {
            compare::draw_captions(&mut self.canvas, &self.runs, &areas, self.copy);
        }
        if self.overlays.has(Overlay::Sums) {
            for (run, area) in self.runs.iter().zip(&areas) {
                let upper = Vec2::new(area.right() - 14.0, area.y + 14.0);
                let below = Vec2::new(area.center().x + 124.0, area.y + 8.0);
                draw_sums(&mut self.canvas, &run.world, if is_split { below } else { upper });
            }
        }
        let shown = Shown {
            scene: self.scene,
            seed: self.seed,
            runs: &self.runs,
            copy: self.copy,
            is_paused: self.is_paused,
            speed: SPEEDS[self.speed],
            overlays: self.overlays,
            mould: self.mould,
            is_following: self.follows.is_some(),
            edits: self.edits.len(),
            undo_to: self.edits.last().map(|moments| moments[0].seconds),
            draw_time: self.draw_time,
            is_slowed: self.slowed > 0.5,
            is_tall: self.layout.window().h >= TALL && !self.layout.is_upright,
            is_upright: self.layout.is_upright,
            is_folded: self.layout.is_folded,
        };
        let commands = self.panel.draw(&mut self.canvas, self.layout.panel, pointer, shown);
        self.draw_cards();
        self.canvas.draw();
        commands
    }

    /// One copy of the world in its part of the window.
    fn draw_copy(&mut self, copy: usize, camera: Camera) {
        let (canvas, run) = (&mut self.canvas, &self.runs[copy]);
        let shown = self.overlays;
        scenery::draw_grid(canvas.batch(), camera);
        Drawer::draw_below(canvas, run, shown, camera);
        let paint = Paint::of(&run.world, &self.scene.colours(&run.world), shown);
        self.scenery.draw_bodies(canvas.batch(), run, &paint, camera);
        scenery::draw_attractors(canvas.batch(), &run.world, camera);
        let mut words = self.drawer.draw_above(canvas, run, shown, camera);
        if self.runs.len() == 1 {
            words.extend(draw_readout(canvas, self.scene.readout(&run.world), shown, camera));
        }
        if let Some(body) = self.selected.and_then(|id| run.world.body(id)) {
            let reach = body.shape().extent() * camera.scale() + 5.0;
            let at = camera.to_screen(body.pose().center);
            canvas.batch().ring(at, reach, 1.0, theme::ACCENT.rgba(200));
        }
        let labels = self.scene.labels(&run.world);
        if shown.has(Overlay::Names) {
            draw_names(canvas, run, &labels, camera, words);
        }
        if copy == 0 {
            draw_scale_bar(canvas, camera);
        }
    }

    /// What the mouse holds or is about to make.
    fn draw_mouse(&mut self) {
        let at = self.hand.at;
        let camera = self.camera_at(at);
        match self.grip {
            Some(Grip::Spring(spring)) => {
                if let Some(body) = self.run_at(at).world.body(spring.body) {
                    let held = camera.to_screen(spring.held(body.pose()));
                    let batch = self.canvas.batch();
                    batch.line(held, at, 1.5, theme::ACCENT.rgba(220));
                    batch.dot(held, 3.0, theme::ACCENT.rgba(255));
                }
            }
            Some(Grip::Throw(from)) => {
                self.draw_mould(from, camera);
                let way = at - from;
                if way.length() >= 4.0 {
                    self.canvas.batch().arrow(from, way, 2.0, theme::VELOCITY.rgba(255));
                }
            }
            None if self.layout.is_scene(at) && !self.hand.is_touch && self.resting_mouse.is_none() => {
                self.draw_mould(at, camera);
            }
            Some(Grip::Picture(_) | Grip::Attractor(_)) | None => {}
        }
    }

    /// What the left button does, in the lower right corner; and what to try, until somebody has tried something.
    fn draw_tool(&mut self) {
        let area = self.layout.scene;
        let mould = self.mould;
        let made = if mould.tool.makes() {
            format!(", {} m, {}", mould.size(), mould.material().1)
        } else {
            String::new()
        };
        let moved = if self.camera.is_moved() { "   ·   Home: whole scene" } else { "" };
        let text = format!("tool: {}{made}{moved}", mould.tool.name());
        let left = area.right() - 14.0 - self.canvas.width_of(&text, TOOL);
        self.canvas.tag(text, Vec2::new(left, area.bottom() - 12.0), TOOL);
        let is_new = self.edits.is_empty() && !self.camera.is_moved() && self.runs.len() == 1;
        if let Some(hint) = self.scene.hint.filter(|_| is_new && !self.shows_help && area.h > LOW) {
            let lines = self.canvas.lines(hint, area.w - 48.0, HINT);
            let count = lines.len();
            for (index, line) in lines.into_iter().enumerate() {
                let left = (area.center().x - 0.5 * self.canvas.width_of(&line, HINT)).round();
                let above = 20.0 * (count - index) as f32;
                self.canvas.tag(line, Vec2::new(left, area.bottom() - 26.0 - above), HINT);
            }
        }
    }

    /// The outline of what a click would make.
    fn draw_mould(&mut self, at: Vec2, camera: Camera) {
        let place = camera.to_world(at);
        let constant = self.runs[0].world.settings().gravitational_constant;
        if let Some(attractor) = self.mould.attractor(place, constant) {
            scenery::draw_attractor(self.canvas.batch(), &attractor, camera);
            if attractor.range().is_none() {
                let reach = self.mould.reach() * camera.scale();
                let batch = self.canvas.batch();
                batch.ring(camera.to_screen(place), reach, 1.0, theme::ATTRACTOR.rgba(110));
            }
        }
        if let Some(shape) = self.mould.shape() {
            let tone = theme::ACCENT.mixed(theme::BACKGROUND, 0.5);
            let style = BodyStyle { fill: tone.mixed(theme::BACKGROUND, 0.5), outline: tone };
            for place in self.mould.places(&self.run_at(at).world, place) {
                self.scenery.draw_shape(self.canvas.batch(), &shape, Pose::at(place), style, camera);
            }
        }
    }

    /// Cards over everything: the body under the mouse, the keys.
    fn draw_cards(&mut self) {
        let at = self.hand.at;
        if let Some(id) = self.hovered.filter(|_| !self.shows_help) {
            let run = self.run_at(at);
            let world = &run.world;
            let labels = self.scene.labels(world);
            let name = labels.iter().find(|(named, _)| *named == id).map(|&(_, name)| name);
            if let Some(rows) = hover::rows(world, id, name) {
                self.canvas.begin_sheet(None);
                hover::draw(&mut self.canvas, self.layout.scene, at, &rows);
            }
        }
        if self.shows_help {
            self.canvas.begin_sheet(None);
            help::draw(&mut self.canvas, self.layout.window());
        }
    }
}

/// What the scene measures, below the bar, clear of the sums to the right; returns where it stands.
fn draw_readout(canvas: &mut Canvas, readout: Option<String>, shown: Overlays, camera: Camera) -> Vec<Rect> {
    let area = camera.area();
    let width = area.w - if shown.has(Overlay::Sums) { 0.5 * area.w } else { 40.0 };
    let lines = readout.map_or_else(Vec::new, |readout| canvas.lines(&readout, width, READOUT));
    let mut places = Vec::new();
    for (index, line) in lines.into_iter().enumerate() {
        let place = Vec2::new(area.x + 20.0, area.y + 54.0 + 20.0 * index as f32);
        places.push(Rect::new(place.x, place.y - 16.0, canvas.width_of(&line, READOUT), 20.0));
        canvas.tag(line, place, READOUT);
    }
    places
}

/// A bar as long as the distance between two lines of the grid, with that distance.
fn draw_scale_bar(canvas: &mut Canvas, camera: Camera) {
    let pitch = scenery::grid_pitch(camera.scale());
    let length = (pitch as f32 * camera.scale()).round();
    let from = Vec2::new(camera.area().x + 20.0, camera.area().y + 24.0);
    let to = from + Vec2::new(length, 0.0);
    let color = theme::MUTED.rgba(255);
    // A ground that keeps it readable over bodies.
    let (low, high) = (from - Vec2::new(6.0, 12.0), to + Vec2::new(64.0, 12.0));
    canvas.batch().rectangle(low, high, theme::BACKGROUND.rgba(150));
    canvas.batch().rectangle(from + Vec2::new(0.0, -1.0), to + Vec2::new(0.0, 1.0), color);
    for end in [from, to] {
        canvas.batch().rectangle(end + Vec2::new(-1.0, -5.0), end + Vec2::new(1.0, 5.0), color);
    }
    let text = match pitch {
        pitch if pitch >= 1000.0 => format!("{:.0} km", pitch / 1000.0),
        pitch if pitch >= 1.0 => format!("{pitch:.0} m"),
        pitch if pitch >= 0.01 => format!("{:.0} cm", pitch * 100.0),
        pitch => format!("{:.0} mm", pitch * 1000.0),
    };
    canvas.text(text, to + Vec2::new(10.0, 4.0), SCALE_LABEL);
}
