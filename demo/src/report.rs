//! The state of the window as lines of text: for those who drive it from outside.

use std::fmt;

use rustycs::{BodyId, Vec2};

/// What there is to say about the window.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct State {
    pub(crate) scene: &'static str,
    pub(crate) seed: u64,
    pub(crate) tick: u64,
    /// Of the places and velocities of all bodies.
    pub(crate) hash: u64,
    /// Ticks of the second copy, if there are two.
    pub(crate) other_tick: Option<u64>,
    pub(crate) is_paused: bool,
    pub(crate) speed: f64,
    pub(crate) copies: usize,
    pub(crate) scheme: &'static str,
    pub(crate) substeps: u32,
    pub(crate) bodies: usize,
    pub(crate) attractors: usize,
    pub(crate) held: Option<BodyId>,
    pub(crate) follows: Option<BodyId>,
    pub(crate) hovered: Option<BodyId>,
    pub(crate) selected: Option<BodyId>,
    /// Where the held or hovered body is, m.
    pub(crate) at: Option<Vec2>,
    pub(crate) tool: &'static str,
    pub(crate) tab: &'static str,
    pub(crate) shows_help: bool,
    pub(crate) is_folded: bool,
    pub(crate) edits: usize,
    pub(crate) overlays: String,
    /// How far the page of the panel is moved up, px.
    pub(crate) scroll: f32,
    /// px/m.
    pub(crate) zoom: f32,
    /// Width and height of the window, px.
    pub(crate) size: [f32; 2],
    /// Time of a step, smoothed, s.
    pub(crate) step_time: f64,
    /// CPU time to draw a frame, s.
    pub(crate) draw_time: f64,
}

impl State {
    /// What does not change on its own while the world runs.
    fn lasting(&self) -> Self {
        Self {
            tick: 0,
            hash: 0,
            other_tick: None,
            at: None,
            hovered: None,
            step_time: 0.0,
            draw_time: 0.0,
            zoom: 0.0,
            scroll: 0.0,
            ..self.clone()
        }
    }
}

/// `state` and words with values, in one line.
impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let yes = |is: bool| if is { "yes" } else { "no" };
        let id = |id: Option<BodyId>| id.map_or_else(|| "-".to_owned(), |id| id.to_bits().to_string());
        let at = self.at.map_or_else(|| "-".to_owned(), |at| format!("{:.2},{:.2}", at.x, at.y));
        write!(
            f,
            "state scene={} seed={} tick={} hash={:016x}",
            self.scene, self.seed, self.tick, self.hash
        )?;
        let other = self.other_tick.map_or_else(|| "-".to_owned(), |tick| tick.to_string());
        write!(f, " other={other} folded={}", yes(self.is_folded))?;
        write!(f, " paused={} speed={} copies={}", yes(self.is_paused), self.speed, self.copies)?;
        write!(f, " scheme={} substeps={}", self.scheme, self.substeps)?;
        write!(f, " bodies={} attractors={}", self.bodies, self.attractors)?;
        write!(f, " held={} selected={}", id(self.held), id(self.selected))?;
        write!(f, " follows={} hovered={}", id(self.follows), id(self.hovered))?;
        write!(f, " at={at} tool={} tab={} help={}", self.tool, self.tab, yes(self.shows_help))?;
        write!(f, " edits={} overlays={}", self.edits, self.overlays)?;
        write!(
            f,
            " scroll={:.0} zoom={:.2} size={:.0}x{:.0}",
            self.scroll, self.zoom, self.size[0], self.size[1]
        )?;
        write!(f, " step_ms={:.4} draw_ms={:.3}", self.step_time * 1e3, self.draw_time * 1e3)
    }
}

/// Seconds between two lines while nothing changes.
const INTERVAL: f64 = 1.0;

/// Writes a line when something changes, and one every second.
#[derive(Debug, Default)]
pub(crate) struct Reporter {
    last: Option<(State, f64)>,
}

impl Reporter {
    /// Looks at the state at a time, s.
    pub(crate) fn observe(&mut self, state: State, now: f64) {
        let is_new = self
            .last
            .as_ref()
            .is_none_or(|(last, then)| now - then >= INTERVAL || last.lasting() != state.lasting());
        if is_new {
            say(&state);
            self.last = Some((state, now));
        }
    }
}

/// A line on the standard output, or in the console of the page.
pub(crate) fn say(state: &State) {
    #[cfg(target_family = "wasm")]
    macroquad::miniquad::info!("{}", state);
    #[cfg(not(target_family = "wasm"))]
    println!("{state}");
}
