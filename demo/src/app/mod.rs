//! What the window shows, and how it changes from frame to frame.
//!
//! | file | what it holds |
//! |---|---|
//! | `act` | what each command does |
//! | `hand` | the mouse, or fingers in its place |
//! | `mouse` | what the mouse does in the scene |
//! | `picture` | a frame, drawn |

mod act;
mod hand;
mod mouse;
mod picture;

use macroquad::input::{KeyCode, is_key_down, mouse_position};
use macroquad::math::Rect;
use macroquad::time::get_time;
use macroquad::window::{screen_height, screen_width};
use rustycs::{BodyId, Vec2, World};
use rustycs_scenes::Scene;

use crate::camera::Camera;
use crate::canvas::Canvas;
use crate::cli::Start;
use crate::command::{Keys, Repeat};
use crate::history::Moment;
use crate::knob;
use crate::layout::Layout;
use crate::overlay::{Drawer, Overlays};
use crate::panel::Panel;
use crate::report::State;
use crate::run::{Run, Tick};
use crate::scenery::Scenery;
use crate::tool::Mould;

use hand::Hand;
use mouse::Grip;

/// Simulated seconds per second that the keys go through.
const SPEEDS: [f64; 9] = [0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0];
const NORMAL_SPEED: usize = 4;
/// Time of a frame that the world follows, s. Where frames take longer it falls behind, instead of making the next
/// frame slower still.
const LONGEST_FRAME: f64 = 1.0 / 15.0;
/// Edits that can be taken back.
const MOST_EDITS: usize = 24;
/// Share of a new measurement in the time shown.
const SMOOTHING: f64 = 0.06;
/// Share of a new frame in the share of slow ones.
const SLOWING: f32 = 0.1;

/// Time that a frame gives to the world.
#[derive(Clone, Copy, Debug)]
pub(crate) enum FrameTime {
    /// One tick, whatever the clock says: the same in every run.
    OneTick,
    /// What has passed since the last frame, s.
    Seconds(f64),
}

/// What the window shows.
pub(crate) struct App {
    scene: &'static Scene,
    seed: u64,
    /// The world, or two copies of it with settings of their own.
    runs: Vec<Run>,
    /// The copy whose settings are turned.
    copy: usize,
    is_paused: bool,
    speed: usize,
    overlays: Overlays,
    camera: Camera,
    follows: Option<BodyId>,
    /// What is under the mouse.
    hovered: Option<BodyId>,
    /// What was last taken hold of.
    selected: Option<BodyId>,
    mould: Mould,
    /// The left and the right key, once somebody plays the scene.
    player: Option<[bool; 2]>,
    hand: Hand,
    grip: Option<Grip>,
    /// Where the mouse was when the window opened, px, until it has moved: somewhere by accident.
    resting_mouse: Option<Vec2>,
    /// Worlds before each of the last edits.
    edits: Vec<Vec<Moment>>,
    shows_help: bool,
    /// Share of the last frames that took so long that the world fell behind.
    slowed: f32,
    panel: Panel,
    layout: Layout,
    /// Whether the panel was folded, or unfolded, on purpose.
    is_folded: Option<bool>,
    keys: Keys,
    mouse_repeat: Repeat,
    drawer: Drawer,
    scenery: Scenery,
    canvas: Canvas,
    /// CPU time to draw a frame, s, smoothed.
    draw_time: f64,
}

impl App {
    /// A scene at time 0. Needs an open window.
    pub(crate) fn new(start: &Start) -> Self {
        let layout = Layout::of_window(None);
        macroquad::input::simulate_mouse_with_touch(false);
        let mut app = Self {
            scene: start.scene,
            seed: start.seed,
            runs: vec![Run::new(start.scene, start.seed)],
            copy: 0,
            is_paused: start.is_paused,
            speed: NORMAL_SPEED,
            overlays: start.overlays.as_ref().map_or_else(
                || Overlays::of_scene(start.scene),
                |chosen| Overlays::of(chosen.iter().copied()),
            ),
            camera: Camera::new(start.scene.view, layout.scene),
            follows: None,
            hovered: None,
            selected: None,
            mould: Mould::default(),
            player: None,
            hand: Hand::default(),
            grip: None,
            resting_mouse: Some(Vec2::from(mouse_position())),
            edits: Vec::new(),
            shows_help: false,
            slowed: 0.0,
            panel: Panel::new(start.tab),
            layout,
            is_folded: None,
            keys: Keys::default(),
            mouse_repeat: Repeat::default(),
            drawer: Drawer::default(),
            scenery: Scenery::default(),
            canvas: Canvas::new(),
            draw_time: 0.0,
        };
        if start.compares {
            app.compare();
        }
        if start.crowd > 0 {
            crowd(&mut app.runs, start);
        }
        app
    }

    /// A frame: input, time, picture.
    pub(crate) fn frame(&mut self, time: FrameTime) {
        self.layout = Layout::of_window(self.is_folded);
        self.camera.set_area(self.halves()[0]);
        for command in self.keys.read(get_time()) {
            self.act(command);
        }
        let pointer = self.read_mouse();
        self.read_player();
        self.pass(time);
        let start = get_time();
        let commands = self.draw(pointer);
        let took = get_time() - start;
        let share = if self.draw_time == 0.0 { 1.0 } else { SMOOTHING };
        self.draw_time += (took - self.draw_time) * share;
        for command in commands {
            self.act(command);
        }
    }

    /// Reads the keys of a player, or a finger on one side of the scene, from the first on that somebody presses.
    fn read_player(&mut self) {
        let mut keys = [KeyCode::Left, KeyCode::Right].map(is_key_down);
        let Hand { at, is_down, is_touch, .. } = self.hand;
        if is_down && is_touch && self.layout.is_scene(at) {
            keys[usize::from(at.x > self.layout.scene.center().x)] = true;
        }
        if self.scene.is_playable() && (self.player.is_some() || keys.contains(&true)) {
            self.player = Some(keys);
        }
    }

    /// Lets the world run, unless it is paused.
    fn pass(&mut self, time: FrameTime) {
        if self.is_paused {
            return;
        }
        let tick = self.runs[0].world.settings().tick_seconds();
        let seconds = match time {
            FrameTime::OneTick => tick,
            FrameTime::Seconds(seconds) => {
                let is_slow = f32::from(u8::from(seconds > LONGEST_FRAME));
                self.slowed += (is_slow - self.slowed) * SLOWING;
                seconds.min(LONGEST_FRAME) * SPEEDS[self.speed]
            }
        };
        self.advance(seconds);
        // What comes to an end begins again, unless somebody is at work on it.
        let is_over = self.scene.ends_after.is_some_and(|end| self.runs[0].seconds > f64::from(end));
        if is_over && self.edits.is_empty() && self.follows.is_none() {
            self.restart();
        }
    }

    /// Gives all copies the same simulated time, s.
    fn advance(&mut self, seconds: f64) {
        let spring = match &self.grip {
            Some(Grip::Spring(spring)) => Some(spring),
            _ => None,
        };
        let keeps_trails = self.overlays.has(crate::overlay::Overlay::Trails);
        let tick = Tick { scene: self.scene, player: self.player, spring, keeps_trails };
        for run in &mut self.runs {
            run.advance(seconds, tick);
        }
        if let Some(body) = self.follows.and_then(|id| self.runs[0].world.body(id)) {
            self.camera.look_at(body.pose().center);
        }
    }

    /// Changes all copies in the same way, so that it can be taken back.
    fn edit(&mut self, change: impl Fn(&mut World)) {
        if self.edits.len() == MOST_EDITS {
            self.edits.remove(0);
        }
        self.edits.push(self.runs.iter().map(Run::moment).collect());
        for run in &mut self.runs {
            change(&mut run.world);
        }
    }

    /// Two copies side by side, or one again. They begin with the scene, or from now where somebody has changed the
    /// world.
    fn compare(&mut self) {
        let is_edited = !self.edits.is_empty();
        self.copy = 0;
        if self.runs.len() > 1 {
            self.edits.clear();
            self.grip = None;
            self.runs.truncate(1);
        } else {
            if !is_edited {
                self.restart();
            }
            self.edits.clear();
            self.grip = None;
            let moment = self.runs[0].moment();
            self.runs[0].gauges = crate::gauges::Gauges::default();
            let mut other = Run::at(moment);
            let mut settings = other.world.settings().clone();
            knob::turn_scheme(&mut settings);
            other.world.set_settings(settings).expect("both schemes are in range");
            self.runs.push(other);
        }
        let areas = self.halves();
        self.camera.set_area(areas[0]);
    }

    /// The parts of the window that show the copies, px; above each of two there is a caption.
    fn halves(&self) -> Vec<Rect> {
        let Rect { x, y, w, h } = self.layout.scene;
        let count = self.runs.len() as f32;
        let caption = if self.runs.len() > 1 { crate::compare::room_for_caption(h) } else { 0.0 };
        let half = |copy: usize| Rect::new(x + w * copy as f32 / count, y + caption, w / count, h - caption);
        (0..self.runs.len()).map(half).collect()
    }

    /// The camera of the copy at a place in the window.
    fn camera_at(&self, pixel: Vec2) -> Camera {
        let areas = self.halves();
        let area = areas.into_iter().rev().find(|area| pixel.x >= area.x);
        self.camera.in_area(area.unwrap_or(self.layout.scene))
    }

    /// The copy at a place in the window.
    fn run_at(&self, pixel: Vec2) -> &Run {
        let copy = self.halves().iter().rposition(|area| pixel.x >= area.x).unwrap_or(0);
        &self.runs[copy]
    }

    /// The hash of the places and velocities of all bodies of the first copy.
    pub(crate) fn hash(&self) -> u64 {
        self.runs[0].world.state_hash()
    }

    /// What there is to say about the app from outside.
    pub(crate) fn state(&self) -> State {
        let run = &self.runs[0];
        let held = match &self.grip {
            Some(Grip::Spring(spring)) => Some(spring.body),
            _ => None,
        };
        State {
            scene: self.scene.name,
            seed: self.seed,
            tick: run.world.ticks(),
            other_tick: self.runs.get(1).map(|other| other.world.ticks()),
            is_paused: self.is_paused,
            speed: SPEEDS[self.speed],
            copies: self.runs.len(),
            scheme: knob::scheme_name(self.runs[self.copy].world.settings()),
            substeps: self.runs[self.copy].world.settings().substeps,
            bodies: run.world.body_count(),
            attractors: run.world.attractors().count(),
            held,
            follows: self.follows,
            hovered: self.hovered,
            selected: self.selected,
            at: held.or(self.hovered).and_then(|id| run.world.body(id)).map(|body| body.position()),
            tool: self.mould.tool.name(),
            tab: self.panel.tab.name(),
            shows_help: self.shows_help,
            is_folded: self.layout.is_folded,
            edits: self.edits.len(),
            overlays: self.overlays.names(),
            scroll: self.panel.scroll(),
            zoom: self.camera.scale(),
            size: [screen_width(), screen_height()],
            step_time: run.gauges.step,
            draw_time: self.draw_time,
        }
    }
}

/// Small bodies in rows over what the scene shows, as many as asked for.
fn crowd(runs: &mut [Run], start: &Start) {
    let view = start.scene.view;
    let columns = (start.crowd as f32 * view.width / view.height).sqrt().ceil().max(1.0) as u32;
    let pitch = view.width / columns as f32;
    let low = view.center - Vec2::new(0.5 * view.width, 0.5 * view.height);
    for run in runs {
        for index in 0..start.crowd {
            let place = Vec2::new((index % columns) as f32 + 0.5, (index / columns) as f32 + 0.5) * pitch;
            if run.world.bodies_at(low + place).is_empty() {
                Mould::add_small(&mut run.world, (low + place).into(), 0.3 * pitch, index);
            }
        }
    }
}
