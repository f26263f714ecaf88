//! What each command does.

use rustycs::Vec2;

use crate::app::{App, NORMAL_SPEED, SPEEDS};
use crate::command::Command;
use crate::overlay::{Overlay, Overlays};
use crate::run::Run;
use crate::ui::Nudge;

/// How much a notch of the wheel, or a press of a key, zooms.
const ZOOM: f64 = 1.15;
/// How far a press of a key moves the picture, px.
const PAN: f32 = 40.0;

impl App {
    pub(super) fn act(&mut self, command: Command) {
        match command {
            Command::Pause => self.is_paused = !self.is_paused,
            Command::Tick => self.single_tick(),
            Command::Restart => self.restart(),
            Command::Rewind => self.rewind(),
            Command::Undo => self.undo(),
            Command::Speed(by) => {
                self.speed = self.speed.saturating_add_signed(by as isize).min(SPEEDS.len() - 1);
            }
            Command::Further(by) => self.go_further(by),
            Command::Scene(index) => self.go_to(index),
            Command::Seed(by) => {
                self.seed = self.seed.saturating_add_signed(i64::from(by));
                self.restart();
            }
            Command::Toggle(overlay) => {
                self.overlays.toggle(overlay);
                if overlay == Overlay::Trails {
                    self.runs.iter_mut().for_each(|run| run.trails.clear());
                }
            }
            Command::Tool(_)
            | Command::Size(_)
            | Command::Corners(_)
            | Command::Material(_)
            | Command::Count(_)
            | Command::Kind => self.set_mould(command),
            Command::Make => self.make(self.mouse_place(), Vec2::ZERO),
            Command::Delete => self.delete(self.mouse_place()),
            Command::Follow => self.follow(),
            Command::WholeScene => self.show_whole_scene(),
            Command::Zoom(by) => self.zoom(by as f32),
            Command::Pan(x, y) => {
                self.follows = None;
                self.camera.pan(Vec2::new(x as f32, y as f32) * PAN);
            }
            Command::Compare => self.compare(),
            Command::OtherCopy => self.copy = (self.copy + 1) % self.runs.len(),
            Command::Turn(knob, by) => knob.turn(&mut self.runs[self.copy].world, by),
            Command::Help => self.shows_help = !self.shows_help,
            Command::Close => {
                if !self.panel.lose_focus() {
                    self.shows_help = false;
                }
            }
            Command::Fold => self.is_folded = Some(!self.layout.is_folded),
            Command::Tab(_)
            | Command::NextTab
            | Command::Focus(_)
            | Command::Press
            | Command::Sideways(_) => self.act_on_panel(command),
        }
    }

    fn act_on_panel(&mut self, command: Command) {
        match command {
            Command::Tab(tab) => self.panel.tab = tab,
            Command::NextTab => self.panel.tab = self.panel.tab.next(),
            Command::Focus(by) => self.panel.move_focus(by),
            Command::Press => {
                self.panel.nudge(Nudge::Press);
            }
            Command::Sideways(by) => {
                self.panel.nudge(Nudge::Turn(by));
            }
            _ => {}
        }
        // Whoever turns to the panel wants to see it.
        if self.layout.is_folded && !matches!(command, Command::Sideways(_)) {
            self.is_folded = Some(false);
        }
    }

    fn set_mould(&mut self, command: Command) {
        let mould = &mut self.mould;
        match command {
            Command::Tool(tool) => {
                mould.tool = tool;
                self.grip = None;
            }
            Command::Size(by) => mould.resize(by),
            Command::Corners(by) => mould.change_corners(by),
            Command::Material(by) => mould.change_material(by),
            Command::Count(by) => mould.change_count(by),
            Command::Kind => mould.is_fixed = !mould.is_fixed,
            _ => {}
        }
    }

    /// A single tick; the bodies are shown where it leaves them.
    fn single_tick(&mut self) {
        self.is_paused = true;
        self.runs.iter_mut().for_each(Run::settle);
        self.advance(self.runs[0].world.settings().tick_seconds());
        self.runs[0].settle();
    }

    /// The scene from its beginning, with the settings of now.
    pub(super) fn restart(&mut self) {
        for run in &mut self.runs {
            let settings = run.world.settings().clone();
            *run = Run::new(self.scene, self.seed);
            run.world.set_settings(settings).expect("settings that are in force are in range");
        }
        self.forget_bodies();
    }

    fn forget_bodies(&mut self) {
        self.edits.clear();
        self.grip = None;
        self.follows = None;
        self.hovered = None;
        self.selected = None;
    }

    fn rewind(&mut self) {
        self.is_paused = true;
        self.grip = None;
        self.runs.iter_mut().for_each(Run::rewind);
    }

    /// The worlds as they were before the last edit.
    fn undo(&mut self) {
        if let Some(moments) = self.edits.pop() {
            self.grip = None;
            for (run, moment) in self.runs.iter_mut().zip(moments) {
                run.history.before(moment.seconds);
                run.go_to(moment);
            }
        }
    }

    /// The scene so many further on in the list, round its end.
    fn go_further(&mut self, by: i32) {
        let all = rustycs_scenes::all();
        let here = all.iter().position(|scene| scene.name == self.scene.name).unwrap_or(0);
        self.go_to((here as i32 + by).rem_euclid(all.len() as i32) as usize);
    }

    /// Another scene, with settings of its own; two copies stay two.
    fn go_to(&mut self, index: usize) {
        let before = self.scene;
        self.scene = &rustycs_scenes::all()[index];
        self.overlays =
            self.overlays.without(Overlays::of_scene(before)).with(Overlays::of_scene(self.scene));
        let compares = self.runs.len() > 1;
        self.runs = vec![Run::new(self.scene, self.seed)];
        self.speed = NORMAL_SPEED;
        self.player = None;
        self.forget_bodies();
        if compares {
            self.compare();
        }
        self.show_whole_scene();
    }

    fn show_whole_scene(&mut self) {
        self.follows = None;
        self.camera.show(self.scene.view);
    }

    /// Zooms by so many notches at the mouse, or at the middle of the scene where the mouse is elsewhere.
    pub(super) fn zoom(&mut self, notches: f32) {
        let (mouse, area) = (self.hand.at, self.layout.scene);
        let is_over = self.layout.is_scene(mouse) && !self.hand.is_touch;
        let at = if is_over { mouse } else { Vec2::from([area.center().x, area.center().y]) };
        self.zoom_at(at, ZOOM.powf(f64::from(notches)) as f32);
    }

    /// Zooms by a factor at a place in the window.
    pub(super) fn zoom_at(&mut self, at: Vec2, factor: f32) {
        // Both copies show the same place: what is at the mouse in one is at the same place in the other.
        let shift = self.camera_at(at).area().x - self.camera.area().x;
        self.camera.zoom_at(at - Vec2::new(shift, 0.0), factor);
    }

    /// Follows the body under the mouse, or else the one last taken hold of; or none.
    fn follow(&mut self) {
        self.follows = match self.follows {
            Some(_) => None,
            None => self.hovered.or(self.selected).or_else(|| self.most_moving()),
        };
        if let Some(body) = self.follows.and_then(|id| self.runs[0].world.body(id)) {
            self.camera.look_at(body.pose().center);
        }
    }

    /// What to follow where nothing is under the mouse: the fastest body.
    fn most_moving(&self) -> Option<rustycs::BodyId> {
        let bodies = self.runs[0].world.bodies();
        let fastest = bodies.max_by(|(_, one), (_, other)| {
            one.velocity().length_squared().total_cmp(&other.velocity().length_squared())
        });
        fastest.map(|(id, _)| id)
    }
}
