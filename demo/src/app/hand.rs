//! The mouse, or fingers in its place: one finger is a mouse with its left button down, two move and zoom the picture.

use macroquad::input::{
    MouseButton, Touch, TouchPhase, is_mouse_button_down, is_mouse_button_pressed, mouse_position,
    mouse_wheel, touches,
};
use macroquad::window::screen_dpi_scale;
use rustycs::Vec2;

/// A finger that has moved this far does not tap, px.
const TAP: f32 = 10.0;
/// What a notch of the wheel is in the units of the platform: pixels of a page in the browser.
const NOTCH: f32 = if cfg!(target_family = "wasm") { 100.0 } else { 1.0 };
/// Notches that count in a frame at most.
const MOST_NOTCHES: f32 = 4.0;

/// Two fingers in this frame: the place between them, how far it has moved (px), how much further they are apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pinch {
    pub(super) at: Vec2,
    pub(super) moved: Vec2,
    pub(super) factor: f32,
}

/// The finger that stands for the mouse.
#[derive(Clone, Copy, Debug)]
struct Finger {
    id: u64,
    /// Where it went down, and where it is, px.
    from: Vec2,
    at: Vec2,
    has_moved: bool,
}

/// The mouse, or a finger in its place.
#[derive(Debug, Default)]
pub(super) struct Hand {
    /// Where it is, or was last, px.
    pub(super) at: Vec2,
    /// Whether its left button has just gone down, and whether it is down.
    pub(super) pressed: bool,
    pub(super) is_down: bool,
    /// Whether a button has just gone down that moves the picture whatever the tool, and whether one is down.
    pub(super) pans: bool,
    pub(super) is_panning: bool,
    /// Notches of the wheel, up positive; parts of one from a touchpad.
    pub(super) wheel: f32,
    /// Where a finger has gone down and up again, px.
    pub(super) tap: Option<Vec2>,
    /// Where a finger that moves went down, and how far it has moved since the last frame, px.
    pub(super) swipe: Option<(Vec2, Vec2)>,
    pub(super) pinch: Option<Pinch>,
    /// Whether fingers are in use.
    pub(super) is_touch: bool,
    finger: Option<Finger>,
    /// Places of two fingers in the last frame, px.
    pair: Option<[Vec2; 2]>,
    /// Whether two fingers were down since there was none.
    was_pair: bool,
}

impl Hand {
    /// Reads what has happened since the last frame.
    pub(super) fn read(&mut self) {
        (self.tap, self.swipe, self.pinch, self.pressed, self.pans) = (None, None, None, false, false);
        let mut fingers = touches();
        fingers.sort_by_key(|finger| finger.id);
        if fingers.is_empty() {
            self.read_mouse();
        } else {
            self.is_touch = true;
            self.wheel = 0.0;
            self.read_fingers(&fingers);
        }
    }

    fn read_mouse(&mut self) {
        (self.finger, self.pair, self.was_pair) = (None, None, false);
        let at = Vec2::from(mouse_position());
        let presses = [MouseButton::Left, MouseButton::Middle, MouseButton::Right].map(is_mouse_button_down);
        if presses.contains(&true) {
            self.is_touch = false;
        }
        if !self.is_touch {
            self.at = at;
        }
        self.pressed = is_mouse_button_pressed(MouseButton::Left);
        self.pans = [MouseButton::Middle, MouseButton::Right].into_iter().any(is_mouse_button_pressed);
        (self.is_down, self.is_panning) = (presses[0], presses[1] || presses[2]);
        self.wheel = (mouse_wheel().1 / NOTCH).clamp(-MOST_NOTCHES, MOST_NOTCHES);
    }

    fn read_fingers(&mut self, fingers: &[Touch]) {
        let place = |finger: &Touch| Vec2::new(finger.position.x, finger.position.y) / screen_dpi_scale();
        let is_up = |finger: &Touch| matches!(finger.phase, TouchPhase::Ended | TouchPhase::Cancelled);
        self.is_panning = false;
        if let [one, other, ..] = fingers {
            (self.finger, self.is_down, self.was_pair) = (None, false, true);
            let pair = [place(one), place(other)];
            self.pinch = self.pair.map(|before| pinch(before, pair));
            self.pair = Some(pair).filter(|_| !is_up(one) && !is_up(other));
            return;
        }
        self.pair = None;
        let touch = &fingers[0];
        // What is left of two fingers goes on doing nothing.
        if self.was_pair {
            self.was_pair = !is_up(touch);
            return;
        }
        let at = place(touch);
        self.at = at;
        let known = self.finger.filter(|finger| finger.id == touch.id);
        self.pressed = known.is_none();
        let mut finger = known.unwrap_or(Finger { id: touch.id, from: at, at, has_moved: false });
        finger.has_moved |= (at - finger.from).length() > TAP;
        self.swipe = Some((finger.from, at - finger.at)).filter(|_| finger.has_moved);
        finger.at = at;
        self.is_down = !is_up(touch);
        self.tap = Some(at).filter(|_| is_up(touch) && !finger.has_moved);
        self.finger = Some(finger).filter(|_| self.is_down);
    }
}

fn pinch(before: [Vec2; 2], now: [Vec2; 2]) -> Pinch {
    let middle = |[one, other]: [Vec2; 2]| (one + other) * 0.5;
    let apart = |[one, other]: [Vec2; 2]| (one - other).length().max(1.0);
    Pinch { at: middle(now), moved: middle(now) - middle(before), factor: apart(now) / apart(before) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fingers_that_part_zoom_in_where_they_are() {
        let pair = |left: f32, right: f32| [Vec2::new(left, 10.0), Vec2::new(right, 10.0)];
        let pinch = pinch(pair(100.0, 200.0), pair(60.0, 260.0));
        assert_eq!(
            (pinch.factor, pinch.moved, pinch.at),
            (2.0, Vec2::new(10.0, 0.0), Vec2::new(160.0, 10.0))
        );
    }
}
