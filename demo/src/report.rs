//! The state of the window as lines of text: for those who drive it from outside.

use std::fmt;

use rustycs::{BodyId, Vec2};

/// What there is to say about the window.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct State {
    pub(crate) scene: &'static str,
    pub(crate) seed: u64,
    pub(crate) tick: u64,
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

/// A state, with the hash of the places and velocities of all bodies, which takes a look at each.
struct Line<'a> {
    state: &'a State,
    hash: u64,
}

/// `state` and words with values, in one line.
impl fmt::Display for Line<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { state, hash } = self;
        let yes = |is: bool| if is { "yes" } else { "no" };
        let id = |id: Option<BodyId>| id.map_or_else(|| "-".to_owned(), |id| id.to_bits().to_string());
        let at = state.at.map_or_else(|| "-".to_owned(), |at| format!("{:.2},{:.2}", at.x, at.y));
        write!(f, "state scene={} seed={} tick={} hash={:016x}", state.scene, state.seed, state.tick, hash)?;
        let other = state.other_tick.map_or_else(|| "-".to_owned(), |tick| tick.to_string());
        write!(f, " other={other} folded={}", yes(state.is_folded))?;
        write!(f, " paused={} speed={} copies={}", yes(state.is_paused), state.speed, state.copies)?;
        write!(f, " scheme={} substeps={}", state.scheme, state.substeps)?;
        write!(f, " bodies={} attractors={}", state.bodies, state.attractors)?;
        write!(f, " held={} selected={}", id(state.held), id(state.selected))?;
        write!(f, " follows={} hovered={}", id(state.follows), id(state.hovered))?;
        write!(f, " at={at} tool={} tab={} help={}", state.tool, state.tab, yes(state.shows_help))?;
        write!(f, " edits={} overlays={}", state.edits, state.overlays)?;
        write!(
            f,
            " scroll={:.0} zoom={:.2} size={:.0}x{:.0}",
            state.scroll, state.zoom, state.size[0], state.size[1]
        )?;
        write!(f, " step_ms={:.4} draw_ms={:.3}", state.step_time * 1e3, state.draw_time * 1e3)
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
    /// Looks at the state at a time, s. The hash is computed only where a line is written.
    pub(crate) fn observe(&mut self, state: State, now: f64, hash: impl FnOnce() -> u64) {
        let is_new = self
            .last
            .as_ref()
            .is_none_or(|(last, then)| now - then >= INTERVAL || last.lasting() != state.lasting());
        if is_new {
            say(&state, hash());
            self.last = Some((state, now));
        }
    }
}

/// A line on the standard output, or in the console of the page.
pub(crate) fn say(state: &State, hash: u64) {
    let line = Line { state, hash };
    #[cfg(target_family = "wasm")]
    macroquad::miniquad::info!("{}", line);
    #[cfg(not(target_family = "wasm"))]
    println!("{line}");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_computed_only_where_a_line_is_written() {
        let (mut reporter, mut hashes) = (Reporter::default(), 0);
        for frame in 0..150_u32 {
            let state = State { tick: frame.into(), is_paused: frame >= 100, ..State::default() };
            reporter.observe(state, f64::from(frame) / 60.0, || {
                hashes += 1;
                0
            });
        }
        // At 0 s, at 1 s, as it is paused after 100 frames, and no more until a second later.
        assert_eq!(hashes, 3);
    }
}
