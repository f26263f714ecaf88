//! Everything that can be done, and the keys that do it. Buttons of the panel do the same by the same commands.

use macroquad::input::{KeyCode, is_key_down, is_key_pressed};

use crate::knob::Knob;
use crate::overlay::Overlay;
use crate::panel::Tab;
use crate::tool::Tool;

/// Something to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Command {
    Pause,
    /// A single tick; pauses.
    Tick,
    Restart,
    /// Back by a quarter of a second; pauses.
    Rewind,
    /// Takes back the last edit.
    Undo,
    /// Faster (positive) or slower.
    Speed(i32),
    /// The scene so many further on in the list.
    Further(i32),
    /// The scene at a place of the list.
    Scene(usize),
    Seed(i32),
    Toggle(Overlay),
    Tool(Tool),
    Size(i32),
    Corners(i32),
    Material(i32),
    Count(i32),
    /// Dynamic or fixed.
    Kind,
    /// Makes what the tool makes at the mouse.
    Make,
    /// Removes what is under the mouse.
    Delete,
    /// Follows the body under the mouse, or none.
    Follow,
    WholeScene,
    Zoom(i32),
    Pan(i32, i32),
    /// Two copies side by side, or one.
    Compare,
    /// The settings of the other copy.
    OtherCopy,
    Turn(Knob, i32),
    /// Hides the panel, or shows it again.
    Fold,
    Tab(Tab),
    NextTab,
    /// The next thing in the panel that can be pressed.
    Focus(i32),
    /// Presses it.
    Press,
    /// Turns it up or down.
    Sideways(i32),
    Help,
    Close,
}

/// A modifier that has to be held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Held {
    None,
    Shift,
    Control,
}

/// Keys that do something.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Binding {
    pub(crate) keys: &'static [KeyCode],
    pub(crate) held: Held,
    /// Whether it goes on while the key is held.
    pub(crate) repeats: bool,
    pub(crate) command: Command,
}

const fn on(keys: &'static [KeyCode], command: Command) -> Binding {
    Binding { keys, held: Held::None, repeats: false, command }
}

const fn while_on(keys: &'static [KeyCode], held: Held, command: Command) -> Binding {
    Binding { keys, held, repeats: true, command }
}

use KeyCode as K;

/// All keys but those of the overlays, which these know themselves.
const BINDINGS: &[Binding] = &[
    on(&[K::Space], Command::Pause),
    while_on(&[K::S, K::Period], Held::None, Command::Tick),
    on(&[K::R], Command::Restart),
    while_on(&[K::Backspace], Held::None, Command::Rewind),
    on(&[K::U], Command::Undo),
    Binding { keys: &[K::Z], held: Held::Control, repeats: false, command: Command::Undo },
    on(&[K::Minus, K::KpSubtract], Command::Speed(-1)),
    on(&[K::Equal, K::KpAdd], Command::Speed(1)),
    on(&[K::N], Command::Further(1)),
    on(&[K::P], Command::Further(-1)),
    on(&[K::Right], Command::Sideways(1)),
    on(&[K::Left], Command::Sideways(-1)),
    on(&[K::K], Command::Seed(1)),
    Binding { keys: &[K::K], held: Held::Shift, repeats: false, command: Command::Seed(-1) },
    on(&[K::Key1], Command::Tool(Tool::Hand)),
    on(&[K::Key2], Command::Tool(Tool::Circle)),
    on(&[K::Key3], Command::Tool(Tool::Aabb)),
    on(&[K::Key4], Command::Tool(Tool::Obb)),
    on(&[K::Key5], Command::Tool(Tool::Polygon)),
    on(&[K::Key6], Command::Tool(Tool::Global)),
    on(&[K::Key7], Command::Tool(Tool::Local)),
    on(&[K::Key8], Command::Tool(Tool::Eraser)),
    on(&[K::LeftBracket], Command::Size(-1)),
    on(&[K::RightBracket], Command::Size(1)),
    on(&[K::A], Command::Material(1)),
    on(&[K::Q], Command::Corners(1)),
    Binding { keys: &[K::Q], held: Held::Shift, repeats: false, command: Command::Corners(-1) },
    on(&[K::W], Command::Count(1)),
    Binding { keys: &[K::W], held: Held::Shift, repeats: false, command: Command::Count(-1) },
    on(&[K::Y], Command::Kind),
    on(&[K::Insert, K::Apostrophe], Command::Make),
    on(&[K::Delete], Command::Delete),
    on(&[K::F], Command::Follow),
    on(&[K::Home], Command::WholeScene),
    while_on(&[K::PageUp], Held::None, Command::Zoom(1)),
    while_on(&[K::PageDown], Held::None, Command::Zoom(-1)),
    while_on(&[K::Left], Held::Shift, Command::Pan(1, 0)),
    while_on(&[K::Right], Held::Shift, Command::Pan(-1, 0)),
    while_on(&[K::Up], Held::Shift, Command::Pan(0, 1)),
    while_on(&[K::Down], Held::Shift, Command::Pan(0, -1)),
    on(&[K::X], Command::Compare),
    Binding { keys: &[K::X], held: Held::Shift, repeats: false, command: Command::OtherCopy },
    on(&[K::F2], Command::Fold),
    on(&[K::Tab], Command::NextTab),
    on(&[K::Down], Command::Focus(1)),
    on(&[K::Up], Command::Focus(-1)),
    on(&[K::Enter, K::KpEnter], Command::Press),
    on(&[K::H, K::F1], Command::Help),
    on(&[K::Escape], Command::Close),
];

/// Time until what is held repeats, and between two repeats, s.
const REPEAT: [f64; 2] = [0.45, 0.07];

/// When something that is held does its work again.
#[derive(Debug, Default)]
pub(crate) struct Repeat {
    /// When it does so next, s.
    next: Option<f64>,
}

impl Repeat {
    /// Whether it does so at this time (s).
    pub(crate) fn is_due(&mut self, is_held: bool, now: f64) -> bool {
        let is_due = is_held && self.next.is_some_and(|next| now >= next);
        self.next = match self.next.filter(|_| is_held) {
            _ if is_due => Some(now + REPEAT[1]),
            None if is_held => Some(now + REPEAT[0]),
            waiting => waiting,
        };
        is_due
    }
}

/// Reads the keys.
#[derive(Debug, Default)]
pub(crate) struct Keys {
    repeat: Repeat,
}

impl Keys {
    /// What the keys of this frame, at a time (s), ask for.
    pub(crate) fn read(&mut self, now: f64) -> Vec<Command> {
        let is_held = |keys: &[KeyCode]| keys.iter().any(|&key| is_key_down(key));
        let control = is_held(&[K::LeftControl, K::RightControl]);
        let shift = is_held(&[K::LeftShift, K::RightShift]);
        let held = match (control, shift) {
            (true, _) => Held::Control,
            (false, true) => Held::Shift,
            (false, false) => Held::None,
        };
        let bindings = || BINDINGS.iter().filter(|binding| binding.held == held);
        let is_held_on = bindings().any(|binding| binding.repeats && is_held(binding.keys));
        let is_due = self.repeat.is_due(is_held_on, now);
        let mut commands: Vec<Command> = bindings()
            .filter(|binding| {
                binding.keys.iter().any(|&key| is_key_pressed(key))
                    || (binding.repeats && is_due && is_held(binding.keys))
            })
            .map(|binding| binding.command)
            .collect();
        if held == Held::None {
            let overlays = Overlay::ALL.into_iter().filter(|overlay| is_key_pressed(overlay.key().0));
            commands.extend(overlays.map(Command::Toggle));
        }
        commands
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_held_repeats_after_a_while() {
        let mut repeat = Repeat::default();
        let times = [0.0, 0.4, 0.5, 0.51, 0.6].map(|now| repeat.is_due(true, now));
        assert_eq!(times, [false, false, true, false, true]);
        assert!(!repeat.is_due(false, 0.9) && !repeat.is_due(true, 1.0));
    }

    #[test]
    fn no_key_does_two_things() {
        let of_overlays = Overlay::ALL.map(|overlay| (overlay.key().0, Held::None));
        let mut keys: Vec<(KeyCode, Held)> = of_overlays.to_vec();
        for binding in BINDINGS {
            keys.extend(binding.keys.iter().map(|&key| (key, binding.held)));
        }
        for (index, key) in keys.iter().enumerate() {
            assert!(!keys[..index].contains(key), "{key:?} does two things");
        }
    }
}
