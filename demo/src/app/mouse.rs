//! What the mouse does in the scene.

use macroquad::time::get_time;
use rustycs::{Attractor, AttractorId, Point, Vec2, World};

use crate::app::App;
use crate::spring::Spring;
use crate::tool::Tool;
use crate::ui::Pointer;

/// Speed that a body gets per length of the pull with which it is thrown, 1/s.
const THROW: f32 = 3.0;
/// How near the mouse has to be to an attractor to take hold of it or to remove it, px.
const NEAR: f32 = 12.0;

/// What the mouse holds.
#[derive(Clone, Copy, Debug)]
pub(super) enum Grip {
    /// The picture; where the mouse was in the last frame, px.
    Picture(Vec2),
    /// A body.
    Spring(Spring),
    Attractor(AttractorId),
    /// What is about to be made: where the button went down, px.
    Throw(Vec2),
}

impl App {
    /// Where the mouse is, px, kept within the scene.
    pub(super) fn mouse_place(&self) -> Vec2 {
        let (mouse, area) = (self.hand.at, self.layout.scene);
        Vec2::new(mouse.x.clamp(area.x, area.right() - 1.0), mouse.y.clamp(area.y, area.bottom() - 1.0))
    }

    /// Reads the mouse, or the fingers; what they do in the panel is left to the panel.
    pub(super) fn read_mouse(&mut self) -> Pointer {
        self.hand.read();
        let at = self.hand.at;
        // A window that opens under the mouse knows where it is only after a frame.
        let is_first = self.runs[0].world.ticks() < 2 && self.resting_mouse == Some(Vec2::ZERO);
        self.resting_mouse = self.resting_mouse.map(|rest| if is_first { at } else { rest });
        self.resting_mouse = self.resting_mouse.filter(|&rest| rest == at && !self.hand.is_touch);
        let is_over_scene = self.layout.is_scene(at);
        if is_over_scene && self.hand.wheel != 0.0 {
            self.zoom(self.hand.wheel);
        }
        if let Some(pinch) = self.hand.pinch {
            self.grip = None;
            self.follows = None;
            self.camera.pan(pinch.moved);
            self.zoom_at(pinch.at, pinch.factor);
        }
        if self.hand.pressed && self.shows_help {
            self.shows_help = false;
            self.hand.pressed = false;
            self.hand.tap = None;
        } else if is_over_scene && self.grip.is_none() {
            self.begin_grip(at);
        }
        self.hold(at);
        let is_mouse = self.resting_mouse.is_none() && !self.hand.is_touch;
        self.hovered = if is_over_scene && self.grip.is_none() && is_mouse {
            let place = self.camera_at(at).to_world(at);
            self.run_at(at).world.bodies_at(place).last().copied()
        } else {
            None
        };
        self.panel_pointer()
    }

    /// The mouse, as far as it is the panel's.
    fn panel_pointer(&mut self) -> Pointer {
        let hand = &self.hand;
        let is_over_panel = !self.layout.is_scene(hand.at) && self.grip.is_none();
        if hand.is_touch {
            let is_panel = |at: Vec2| !self.layout.is_scene(at);
            let tap = hand.tap.filter(|&at| is_over_panel && is_panel(at));
            let held = Some(hand.at).filter(|_| is_over_panel && hand.is_down && hand.swipe.is_none());
            let drag = hand.swipe.filter(|&(from, _)| is_panel(from)).map(|(_, moved)| moved.y);
            let at = tap.or(held).unwrap_or(Vec2::splat(-1.0));
            return Pointer { at, pressed: tap.is_some(), drag, is_touch: true, ..Pointer::default() };
        }
        let repeats = self.mouse_repeat.is_due(is_over_panel && hand.is_down, get_time());
        Pointer {
            // A mouse that nobody has moved is over nothing.
            at: if self.resting_mouse.is_some() { Vec2::splat(-1.0) } else { hand.at },
            pressed: hand.pressed && is_over_panel,
            repeats,
            wheel: if is_over_panel { hand.wheel } else { 0.0 },
            drag: None,
            is_touch: false,
        }
    }

    /// Takes hold of what is at the mouse, if a button has gone down.
    fn begin_grip(&mut self, at: Vec2) {
        if self.hand.pans {
            self.grip = Some(Grip::Picture(at));
        } else if self.hand.pressed {
            match self.mould.tool {
                Tool::Hand => self.take_hold(at),
                Tool::Eraser => self.delete(at),
                _ => self.grip = Some(Grip::Throw(at)),
            }
        }
    }

    /// Takes hold of an attractor, a body, or else the picture. A drag can be taken back, as every edit can.
    fn take_hold(&mut self, at: Vec2) {
        let place = self.camera_at(at).to_world(at);
        let world = &self.run_at(at).world;
        let spring = Spring::grab(world, place);
        let attractor = attractor_near(world, place, NEAR / self.camera.scale());
        self.selected = spring.filter(|_| attractor.is_none()).map(|spring| spring.body);
        self.grip = Some(match (attractor, spring) {
            (Some(attractor), _) => Grip::Attractor(attractor),
            (None, Some(spring)) => Grip::Spring(spring),
            (None, None) => Grip::Picture(at),
        });
        if attractor.is_some() || spring.is_some() {
            self.edit(|_| {});
        }
    }

    /// Goes on with what the mouse holds, and lets go of it where no button is down any more.
    fn hold(&mut self, at: Vec2) {
        let is_down = self.hand.is_down || self.hand.is_panning;
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
            Some(Grip::Attractor(id)) => {
                let place = self.camera_at(at).to_world(at);
                self.runs.iter_mut().for_each(|run| move_attractor(&mut run.world, id, place));
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

    /// Removes the attractor near a place in the window, or else the body at it.
    pub(super) fn delete(&mut self, at: Vec2) {
        let place = self.camera_at(at).to_world(at);
        let reach = NEAR / self.camera.scale();
        let world = &self.run_at(at).world;
        if let Some(attractor) = attractor_near(world, place, reach) {
            self.edit(|world| {
                world.remove_attractor(attractor);
            });
        } else if let Some(&body) = world.bodies_at(place).last() {
            self.edit(|world| {
                world.remove(body);
            });
            self.hovered = None;
            self.selected = self.selected.filter(|&selected| selected != body);
            self.follows = self.follows.filter(|&follows| follows != body);
        }
    }
}

/// Puts an attractor elsewhere; it stays where it is if the mouse is absurdly far away.
fn move_attractor(world: &mut World, id: AttractorId, place: Point) {
    let Some(old) = world.attractor(id) else { return };
    let moved = Attractor::try_new(place, old.mass(), old.range());
    if let Ok(moved) = moved.and_then(|moved| moved.with_min_distance(old.min_distance())) {
        world.replace_attractor(id, moved);
    }
}

fn attractor_near(world: &World, place: Point, reach: f32) -> Option<AttractorId> {
    let distance = |position: Point| (position - place).length();
    let near = world.attractors().filter(|(_, attractor)| distance(attractor.position()) <= reach);
    let nearest =
        near.min_by(|(_, one), (_, other)| distance(one.position()).total_cmp(&distance(other.position())));
    nearest.map(|(id, _)| id)
}
