//! What the mouse does in the scene.

use macroquad::input::{
    MouseButton, is_mouse_button_down, is_mouse_button_pressed, mouse_position, mouse_wheel,
};
use macroquad::time::get_time;
use rustycs::{AttractorId, Point, Vec2, World};

use crate::app::{App, panel_area, scene_area};
use crate::spring::Spring;
use crate::tool::Tool;
use crate::ui::Pointer;

/// Buttons that move the picture, whatever the tool.
const PAN_BUTTONS: [MouseButton; 2] = [MouseButton::Middle, MouseButton::Right];
/// Speed that a body gets per length of the pull with which it is thrown, 1/s.
const THROW: f32 = 3.0;
/// How near the mouse has to be to an attractor to remove it, px.
const NEAR: f32 = 14.0;

/// What the mouse holds.
#[derive(Clone, Copy, Debug)]
pub(super) enum Grip {
    /// The picture; where the mouse was in the last frame, px.
    Picture(Vec2),
    /// A body.
    Spring(Spring),
    /// What is about to be made: where the button went down, px.
    Throw(Vec2),
}

/// Where the mouse is, px.
pub(super) fn mouse() -> Vec2 {
    Vec2::from(mouse_position())
}

/// Where the mouse is, px, kept within the scene.
pub(super) fn mouse_place() -> Vec2 {
    let (mouse, area) = (mouse(), scene_area());
    Vec2::new(mouse.x.clamp(area.x, area.right() - 1.0), mouse.y.clamp(area.y, area.bottom() - 1.0))
}

impl App {
    /// Reads the mouse; what it does in the panel is left to the panel.
    pub(super) fn read_mouse(&mut self) -> Pointer {
        let at = mouse();
        // A window that opens under the mouse knows where it is only after a frame.
        let is_first = self.runs[0].world.ticks() < 2 && self.resting_mouse == Some(Vec2::ZERO);
        self.resting_mouse = self.resting_mouse.map(|rest| if is_first { at } else { rest });
        self.resting_mouse = self.resting_mouse.filter(|&rest| rest == at);
        // A notch is 1 on the desktop and 120 on the web; the sign is the same.
        let (_, wheel) = mouse_wheel();
        let wheel = if wheel == 0.0 { 0.0 } else { wheel.signum() };
        let pressed = is_mouse_button_pressed(MouseButton::Left);
        let is_over_panel = panel_area().contains([at.x, at.y].into());
        let is_over_scene = scene_area().contains([at.x, at.y].into());
        if is_over_scene && wheel != 0.0 {
            self.zoom(wheel as i32);
        }
        if pressed && self.shows_help && is_over_scene {
            self.shows_help = false;
        } else if is_over_scene && self.grip.is_none() {
            self.begin_grip(at, pressed);
        }
        self.hold(at);
        self.hovered = if is_over_scene && self.grip.is_none() && self.resting_mouse.is_none() {
            let place = self.camera_at(at).to_world(at);
            self.run_at(at).world.bodies_at(place).last().copied()
        } else {
            None
        };
        // A mouse that nobody has moved is over nothing.
        let at = if self.resting_mouse.is_some() { Vec2::splat(-1.0) } else { at };
        let is_held = is_over_panel && self.grip.is_none() && is_mouse_button_down(MouseButton::Left);
        let repeats = self.mouse_repeat.is_due(is_held, get_time());
        let wheel = if is_over_panel { wheel } else { 0.0 };
        Pointer { at, pressed: pressed && is_over_panel, repeats, wheel }
    }

    /// Takes hold of what is at the mouse, if a button has gone down.
    fn begin_grip(&mut self, at: Vec2, pressed: bool) {
        if PAN_BUTTONS.into_iter().any(is_mouse_button_pressed) {
            self.grip = Some(Grip::Picture(at));
        } else if pressed {
            match self.mould.tool {
                Tool::Hand => {
                    let place = self.camera_at(at).to_world(at);
                    let spring = Spring::grab(&self.run_at(at).world, place);
                    self.selected = spring.map(|spring| spring.body);
                    if spring.is_some() {
                        // A drag can be taken back, as every edit can.
                        self.edit(|_| {});
                    }
                    self.grip = Some(spring.map_or(Grip::Picture(at), Grip::Spring));
                }
                Tool::Eraser => self.delete(at),
                _ => self.grip = Some(Grip::Throw(at)),
            }
        }
    }

    /// Goes on with what the mouse holds, and lets go of it where no button is down any more.
    fn hold(&mut self, at: Vec2) {
        let buttons = [MouseButton::Left, MouseButton::Middle, MouseButton::Right];
        let is_down = buttons.into_iter().any(is_mouse_button_down);
        match self.grip {
            Some(Grip::Throw(from)) if !is_down => {
                self.grip = None;
                let pull = at - from;
                let velocity = Vec2::new(pull.x, -pull.y) * (THROW / self.camera.scale());
                self.make(from, if pull.length() < 4.0 { Vec2::ZERO } else { velocity });
            }
            Some(_) if !is_down => self.grip = None,
            Some(Grip::Picture(before)) if before != at => {
                self.follows = None;
                self.camera.pan(at - before);
                self.grip = Some(Grip::Picture(at));
            }
            Some(Grip::Spring(spring)) => {
                let target = self.camera_at(at).to_world(at);
                self.grip = Some(Grip::Spring(spring.toward(target)));
            }
            Some(Grip::Throw(_) | Grip::Picture(_)) | None => {}
        }
    }

    /// Makes what the tool makes; a circle where it makes nothing.
    pub(super) fn make(&mut self, at: Vec2, velocity: Vec2) {
        let place = self.camera_at(at).to_world(at);
        let mut mould = self.mould;
        if !mould.tool.makes() {
            mould.tool = Tool::Circle;
        }
        self.edit(|world| {
            mould.cast(world, place, velocity);
        });
    }

    /// Removes the body at a place in the window, or else the attractor near it.
    pub(super) fn delete(&mut self, at: Vec2) {
        let place = self.camera_at(at).to_world(at);
        let reach = NEAR / self.camera.scale();
        let world = &self.run_at(at).world;
        if let Some(&body) = world.bodies_at(place).last() {
            self.edit(|world| {
                world.remove(body);
            });
            self.hovered = None;
            self.selected = self.selected.filter(|&selected| selected != body);
            self.follows = self.follows.filter(|&follows| follows != body);
        } else if let Some(attractor) = attractor_near(world, place, reach) {
            self.edit(|world| {
                world.remove_attractor(attractor);
            });
        }
    }
}

fn attractor_near(world: &World, place: Point, reach: f32) -> Option<AttractorId> {
    let distance = |position: Point| (position - place).length();
    let near = world.attractors().filter(|(_, attractor)| distance(attractor.position()) <= reach);
    let nearest =
        near.min_by(|(_, one), (_, other)| distance(one.position()).total_cmp(&distance(other.position())));
    nearest.map(|(id, _)| id)
}
