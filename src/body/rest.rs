//! Whether a body is at rest, told by how far it strays.
//!
//! Speed does not tell: what begins to slide, roll or topple is slow at first, and what trembles in its place never is. So
//! each slow body is watched: how far does any of its points stray from where the watch began? From rest, with the
//! acceleration a, that is a t²/2 in the time t, and (H/t)² times as far in the time H. A body is at rest if it would stray
//! by no more than [`RestRule::reach`] in the next H = [`HORIZON`], even if it gained speed so:
//!
//! ```text
//! strayed ≤ reach (t/H)²
//! ```
//!
//! Rounding makes a body tremble by less than 1 µm, which half a second allows for. Larger trembling takes a longer watch,
//! and so does what crept when the watch began: a watch that fails is followed by another, twice as long. What does gain
//! speed faster than 2 reach/H² strays further the longer it is watched, at whatever speed it is: it never passes.
//!
//! It runs at the end of a step, on awake bodies, where sleep is on; bodies that plainly move cost a comparison.

use crate::math::Vec2;

/// How far ahead a body at rest must stay where it is, s. Shorter, and what creeps goes on until it is seen; longer, and
/// the trembling of a pile takes more than a second or two to be told from creep.
pub(crate) const HORIZON: f32 = 10.0;

/// What counts as rest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RestRule {
    /// How long a body must have been watched, s.
    pub(crate) time: f32,
    /// How far it may stray within [`HORIZON`], m.
    pub(crate) reach: f32,
    /// Length of a step, s.
    pub(crate) tick: f32,
}

/// How far a body has strayed since it is watched.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RestWatch {
    /// How its centre has moved, m.
    moved: Vec2,
    /// How it has turned, rad.
    turned: f32,
    /// How far any of its points has strayed at most, m.
    strayed: f32,
    /// How long it has been watched, s.
    time: f32,
    /// How long it will be before another watch begins, s.
    length: f32,
}

impl RestWatch {
    /// A watch that begins now.
    pub(crate) fn begin(rule: RestRule) -> Self {
        Self { length: rule.time.max(rule.tick), ..Self::default() }
    }

    /// Takes note of the motion of a step, of a body that reaches `extent` (m) from its centre. Returns whether the body may
    /// still come to rest where the watch began.
    #[inline(always)]
    pub(crate) fn follow(&mut self, by: Vec2, turn: f32, extent: f32, rule: RestRule) -> bool {
        self.moved += by;
        self.turned += turn;
        self.strayed = self.strayed.max(self.moved.length() + self.turned.abs() * extent);
        self.time += rule.tick;
        if self.time >= self.length && !self.is_at_rest(rule) {
            *self = Self { length: 2.0 * self.length, ..Self::default() };
        }
        self.strayed <= rule.reach
    }

    /// Whether the body is at rest.
    #[inline(always)]
    pub(crate) fn is_at_rest(&self, rule: RestRule) -> bool {
        let share = self.time / HORIZON;
        self.time >= rule.time && self.strayed <= rule.reach * share * share
    }

    /// Whether nothing of the body has moved at all.
    pub(crate) fn is_still(&self) -> bool {
        self.strayed == 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RULE: RestRule = RestRule { time: 0.5, reach: 1e-3, tick: 1.0 / 64.0 };

    /// When a body at `place` (m) at a time (s) is first found at rest, s; none if it is not within a minute.
    fn rests_at(place: impl Fn(f32) -> f32) -> Option<f32> {
        let mut watch = RestWatch::begin(RULE);
        (1..3840_u16).map(|tick| f32::from(tick) * RULE.tick).find(|now| {
            let by = Vec2::new(place(*now) - place(now - RULE.tick), 0.0);
            if !watch.follow(by, 0.0, 1.0, RULE) {
                watch = RestWatch::begin(RULE);
            }
            watch.is_at_rest(RULE)
        })
    }

    #[test]
    fn what_lies_still_is_at_rest_after_the_sleep_time() {
        assert_eq!(rests_at(|_| 0.0), Some(0.5));
    }

    /// From rest, a t²/2 ≤ reach (t/H)² holds for ever or never: a ≤ 2 reach/H² = 2e-5 m/s².
    #[test]
    fn what_gains_speed_is_never_at_rest() {
        for (acceleration, rests) in [(1.9e-5, true), (2.1e-5, false), (1e-3, false), (1.0, false)] {
            assert_eq!(rests_at(|t| 0.5 * acceleration * t * t).is_some(), rests, "{acceleration} m/s²");
        }
    }

    /// v t ≤ reach (t/H)² from t = v H²/reach on; past the reach, 1 mm in ten seconds, it begins again.
    #[test]
    fn what_creeps_rests_only_if_it_stays_within_reach() {
        assert_eq!(rests_at(|t| 1e-5 * t), Some(1.0 + 0.5), "after a watch of 0.5 s");
        assert_eq!(rests_at(|t| 1.1e-4 * t), None);
    }

    /// To and fro by 40 µm is within the reach, and shows to be so after 2 s: in the third watch.
    #[test]
    fn what_trembles_in_its_place_is_at_rest() {
        let time = rests_at(|t| 2e-5 * trembling(t)).expect("it does not leave its place");
        assert!((1.5..=3.5).contains(&time), "{time} s");
    }

    /// -1 and 1 by turns, 32 times a second.
    fn trembling(t: f32) -> f32 {
        if ((t / RULE.tick) as u32).is_multiple_of(2) { -1.0 } else { 1.0 }
    }
}
