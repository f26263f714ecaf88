//! What the window shows, and how keys and mouse change it.

use macroquad::input::{
    KeyCode, MouseButton, is_key_pressed, is_mouse_button_down, is_mouse_button_pressed, mouse_position,
    mouse_wheel,
};
use macroquad::math::Rect;
use macroquad::time::get_time;
use macroquad::window::{clear_background, screen_height, screen_width};
use rustycs::{Settings, Vec2, World};
use rustycs_scenes::Scene;

use crate::camera::Camera;
use crate::canvas::{Canvas, Face, Style};
use crate::help;
use crate::panel::{Panel, Status};
use crate::poses::Poses;
use crate::scenery::{self, Scenery};
use crate::theme;

/// How much a notch of the wheel zooms.
const ZOOM: f32 = 1.15;
const SCALE_LABEL: Style = Style::new(Face::Mono, 12, theme::MUTED);

/// Buttons that move the picture when dragged.
const DRAG_BUTTONS: [MouseButton; 3] = [MouseButton::Left, MouseButton::Middle, MouseButton::Right];

/// What is drawn over the scene.
#[derive(Clone, Copy, Debug, Default)]
struct Overlays {
    contacts: bool,
    boxes: bool,
    help: bool,
}

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
    world: World,
    poses: Poses,
    is_paused: bool,
    overlays: Overlays,
    camera: Camera,
    /// Where the mouse was in the last frame while it drags the picture, px.
    drag: Option<Vec2>,
    panel: Panel,
    scenery: Scenery,
    canvas: Canvas,
}

impl App {
    /// A scene at time 0. Needs an open window.
    pub(crate) fn new(scene: &'static Scene, seed: u64) -> Self {
        let camera = Camera::new(scene.view, scene_area());
        Self {
            scene,
            seed,
            world: build(scene, seed),
            poses: Poses::default(),
            is_paused: false,
            overlays: Overlays::default(),
            camera,
            drag: None,
            panel: Panel::default(),
            scenery: Scenery::default(),
            canvas: Canvas::new(),
        }
    }

    /// A frame: input, time, picture.
    pub(crate) fn frame(&mut self, time: FrameTime) {
        self.camera.set_area(scene_area());
        self.read_keys();
        self.read_mouse();
        self.pass(time);
        self.draw();
    }

    fn read_keys(&mut self) {
        let pressed = |keys: &[KeyCode]| keys.iter().any(|&key| is_key_pressed(key));
        if pressed(&[KeyCode::Space]) {
            self.is_paused = !self.is_paused;
        }
        if pressed(&[KeyCode::S, KeyCode::Period]) {
            self.is_paused = true;
            self.step();
        }
        if pressed(&[KeyCode::R]) {
            self.restart();
        }
        if pressed(&[KeyCode::N, KeyCode::Right]) {
            self.go_to_neighbour(1);
        }
        if pressed(&[KeyCode::P, KeyCode::Left]) {
            self.go_to_neighbour(rustycs_scenes::all().len() - 1);
        }
        if pressed(&[KeyCode::Home]) {
            self.camera.show(self.scene.view);
        }
        self.overlays.contacts ^= pressed(&[KeyCode::C]);
        self.overlays.boxes ^= pressed(&[KeyCode::B]);
        self.overlays.help ^= pressed(&[KeyCode::H, KeyCode::F1]);
        self.overlays.help &= !pressed(&[KeyCode::Escape]);
    }

    fn read_mouse(&mut self) {
        let mouse = Vec2::from(mouse_position());
        let is_over_scene = self.camera.area().contains([mouse.x, mouse.y].into());
        // A notch is 1 on the desktop and 120 on the web; the sign is the same.
        let (_, wheel) = mouse_wheel();
        if is_over_scene && wheel != 0.0 {
            self.camera.zoom_at(mouse, if wheel > 0.0 { ZOOM } else { 1.0 / ZOOM });
        }
        if is_over_scene && DRAG_BUTTONS.into_iter().any(is_mouse_button_pressed) {
            self.drag = Some(mouse);
        }
        if !DRAG_BUTTONS.into_iter().any(is_mouse_button_down) {
            self.drag = None;
        }
        if let Some(before) = self.drag.filter(|&before| before != mouse) {
            self.camera.pan(mouse - before);
            self.drag = Some(mouse);
        }
    }

    /// Lets the world run, unless it is paused.
    fn pass(&mut self, time: FrameTime) {
        match time {
            _ if self.is_paused => {}
            FrameTime::OneTick => self.step(),
            FrameTime::Seconds(seconds) => {
                self.poses.advance(&mut self.world, seconds, |world| self.panel.observe(world));
            }
        }
    }

    /// A single tick; the bodies are shown where it leaves them.
    fn step(&mut self) {
        self.poses.forget();
        self.world.step();
        self.panel.observe(&self.world);
    }

    fn restart(&mut self) {
        self.world = build(self.scene, self.seed);
        self.poses.forget();
        self.panel = Panel::default();
    }

    /// Shows the scene so many further on in the list, round its end.
    fn go_to_neighbour(&mut self, further: usize) {
        let all = rustycs_scenes::all();
        let here = all.iter().position(|scene| scene.name == self.scene.name).unwrap_or(0);
        self.scene = &all[(here + further) % all.len()];
        self.restart();
        self.camera.show(self.scene.view);
    }

    fn draw(&mut self) {
        let [r, g, b, a] = theme::BACKGROUND.rgba(255);
        clear_background(macroquad::color::Color::from_rgba(r, g, b, a));
        let (canvas, camera, world) = (&mut self.canvas, self.camera, &self.world);
        canvas.clear();
        scenery::draw_grid(&mut canvas.batch, camera);
        self.scenery.draw_bodies(&mut canvas.batch, world, &self.poses, camera);
        if self.overlays.boxes {
            scenery::draw_boxes(&mut canvas.batch, world, camera);
        }
        if self.overlays.contacts {
            scenery::draw_contacts(&mut canvas.batch, world, camera);
        }
        draw_scale_bar(canvas, camera);
        let status = Status { scene: self.scene, seed: self.seed, is_paused: self.is_paused };
        self.panel.draw(canvas, panel_area(), world, status);
        if self.overlays.help {
            help::draw(canvas, camera.area());
        }
        canvas.draw();
    }
}

/// The scene's world, with a clock for its profile.
fn build(scene: &Scene, seed: u64) -> World {
    let mut world = scene.build(seed, Settings::default());
    world.set_clock(Some(get_time));
    world
}

/// The part of the window that shows the world, px.
fn scene_area() -> Rect {
    Rect::new(0.0, 0.0, screen_width() - Panel::width(screen_width()), screen_height())
}

/// The part of the window that shows the figures, px.
fn panel_area() -> Rect {
    let width = Panel::width(screen_width());
    Rect::new(screen_width() - width, 0.0, width, screen_height())
}

/// A bar as long as the distance between two lines of the grid, with that distance.
fn draw_scale_bar(canvas: &mut Canvas, camera: Camera) {
    let pitch = scenery::grid_pitch(camera.scale());
    let length = (pitch as f32 * camera.scale()).round();
    let from = Vec2::new(camera.area().x + 20.0, camera.area().y + 24.0);
    let to = from + Vec2::new(length, 0.0);
    let color = theme::MUTED.rgba(255);
    canvas.batch.rectangle(from + Vec2::new(0.0, -1.0), to + Vec2::new(0.0, 1.0), color);
    for end in [from, to] {
        canvas.batch.rectangle(end + Vec2::new(-1.0, -5.0), end + Vec2::new(1.0, 5.0), color);
    }
    let text = match pitch {
        pitch if pitch >= 1.0 => format!("{pitch:.0} m"),
        pitch if pitch >= 0.01 => format!("{:.0} cm", pitch * 100.0),
        pitch => format!("{:.0} mm", pitch * 1000.0),
    };
    canvas.text(text, to + Vec2::new(10.0, 4.0), SCALE_LABEL);
}
