//! A row: a coordinate of a joint, and what is asked of it.
//!
//! ```text
//! C(x) = 0 or ≥ 0        constraint on the coordinate x
//! u = J v                how fast it changes
//! J M⁻¹ Jᵀ p             what the impulse p does to u
//! push                   C(x after the drift) = 0: the rotation is exact, and nothing is left for later
//! relax                  u = 0, where the bodies are then
//! ```
//!
//! Push and relax with the geometry of their moments are RATTLE (H. Andersen, 1983): second order, and of an energy that
//! does not drift. A spring acts by the implicit midpoint rule: the impulse p = -h/2 (k (x + h u/2) + c u) before the drift, and
//! the same after it. Its k and c are such that a free spring has the poles of the exact one (A. Tustin, 1947): an undamped one
//! keeps its energy and its time, a damped one decays by its closed form.

use crate::resolution::joint::geometry::{Coordinate, Geometry, JointBody, V3, rotation};

/// What is asked of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Role {
    /// To be 0.
    Rigid,
    /// To be within limits.
    Limits([f64; 2]),
    /// To be pulled to `rest` by the stiffness k, N/m or N m/rad, damped by c, N s/m or N m s/rad, with `max` at most.
    Spring { k: f64, c: f64, rest: f64, max: f64 },
    /// To change at `speed`, with a force or torque of `max` at most.
    Speed { speed: f64, max: f64 },
}

/// Half of a substep.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::resolution) enum Phase {
    /// Before the drift.
    #[default]
    Push,
    /// After it.
    Relax,
}

/// Times of a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Times {
    /// Length of the substep, s.
    pub(super) h: f64,
    /// How long the forces of a phase act, s.
    pub(super) kick: f64,
    /// Which share of the gaps that are there closes in this step, no unit: 0 in a step in which none do.
    pub(super) closing: f64,
}

/// Angles, rad, and lengths, by the lever arms of the joint, up to which a row is where it should be: below, the poses of
/// bodies, in `f32`, are not known.
const EXACT: f64 = 1e-8;

/// A limit is reached within so much of it, as above: some hundred times what is left of it after a push.
const REACHED: f64 = 1e-6;

/// Gaps that are there, as of bodies that were joined apart, were moved by hand or struck, or of joints that contradict each other,
/// close no faster than this, m/s or rad/s, as overlaps of contacts do: closed at once, a gap of a metre would throw its bodies
/// at hundreds of metres per second.
pub(super) const CLOSING_SPEED: f64 = 3.0;

/// A motor yields by this share of what its impulse would do: a limit that it drives against holds, and the motor, of which so
/// much would be asked, is found to be at its bound. Under a load it is slow by a millionth of what that does in a substep.
const MOTOR_SOFTNESS: f64 = 1e-6;

/// A spring that swings by more than this angle in a substep, rad, is solved with its own k and c, and swings slower than the exact one. At π no
/// k has its poles; with 0.5 one of 30 Hz would be 5 % too slow at 240 substeps per second.
const FASTEST_FOLLOWED: f64 = 2.0;

/// A row of a joint.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    pub(super) coordinate: Coordinate,
    pub(super) role: Role,
    /// By how much the coordinate is off what a rigid row asks for when it is 0: a length.
    pub(super) zero: f64,
    /// Whether this row and the next are two components of a vector, which is bounded as one.
    pub(super) heads_pair: bool,
    /// Place of the joint among those of the step, and of its bodies among theirs.
    pub(super) joint: u32,
    pub(super) bodies: [u32; 2],
    pub(super) j: [V3; 2],
    /// J M⁻¹ Jᵀ.
    pub(super) k: f64,
    /// Those of the phase that it has begun.
    pub(super) times: Times,
    /// The coordinate at the beginning of the phase.
    pub(super) x: f64,
    /// Size of the joint, m; 1 for angles.
    pub(super) scale: f64,
    /// By how much it yields to what it bears: speed per unit of impulse, as k.
    pub(super) softness: f64,
    /// What is added to the speed of its coordinate beside, m/s or rad/s.
    pub(super) bias: f64,
    /// Impulse of this phase, and of the push, but for what was taken back of it.
    pub(super) impulse: f64,
    pub(super) pushed: f64,
    /// What of the impulse the direct solve has handed over.
    pub(super) handed: f64,
    /// What the direct solve has borne of the push and taken back, which is to be borne in the relax as well.
    pub(super) taken_back: f64,
    /// Scratch: an impulse to go back to, or to compare with.
    pub(super) kept: f64,
    /// Scratch: the impulse before gaps were closed.
    pub(super) unclosed: f64,
    /// The load as the substep began.
    pub(super) load_before: f64,
    /// Force of the last substep.
    pub(super) load: f64,
    /// Impulse on b, and its moment, in the phases of this substep that are over, and in the substeps of this step that are.
    pub(super) in_substep: V3,
    pub(super) in_step: V3,
    /// Whether it acts: its impulse is to be found.
    pub(super) acts: bool,
    /// Of limits: whether the lower one is the nearer, or has pushed.
    pub(super) is_lower: bool,
    /// Of a limit that bears nothing, but may be met in this phase: at which speed of its coordinate it is, m/s or rad/s.
    pub(super) met_at: Option<f64>,
    /// How fast it is off what is asked for, m/s or rad/s.
    pub(super) residual: f64,
    /// What the impulse would be without bounds.
    pub(super) wanted: f64,
}

impl Row {
    pub(super) fn new(coordinate: Coordinate, role: Role) -> Self {
        Self {
            coordinate,
            role,
            zero: 0.0,
            heads_pair: false,
            joint: 0,
            bodies: [0; 2],
            j: [[0.0; 3]; 2],
            k: 0.0,
            times: Times::default(),
            x: 0.0,
            scale: 1.0,
            softness: 0.0,
            bias: 0.0,
            impulse: 0.0,
            pushed: 0.0,
            handed: 0.0,
            taken_back: 0.0,
            kept: 0.0,
            unclosed: 0.0,
            load_before: 0.0,
            load: 0.0,
            in_substep: [0.0; 3],
            in_step: [0.0; 3],
            acts: false,
            is_lower: false,
            met_at: None,
            residual: 0.0,
            wanted: 0.0,
        }
    }

    /// Adds the impulse of a phase that is over to that of the substep.
    pub(super) fn note_impulse(&mut self) {
        self.in_substep = [0, 1, 2].map(|index| self.in_substep[index] + self.j[1][index] * self.impulse);
    }

    /// Begins a phase where the bodies are, with half of the last impulse.
    pub(super) fn begin(&mut self, at: &Geometry, a: &JointBody, b: &JointBody, phase: Phase, times: Times) {
        self.j = self.coordinate.jacobian(at);
        self.times = times;
        self.handed = 0.0;
        self.x = self.value(at);
        self.k = a.coupling(self.j[0], self.j[0]) + b.coupling(self.j[1], self.j[1]);
        (self.softness, self.bias) = match self.role {
            Role::Rigid | Role::Limits(_) => (0.0, 0.0),
            Role::Speed { speed, .. } => (MOTOR_SOFTNESS * self.k, -speed),
            // Those of the push.
            Role::Spring { .. } => (self.softness, self.bias),
        };
        if phase == Phase::Push {
            (self.pushed, self.taken_back) = (0.0, 0.0);
            self.impulse = self.load * times.kick;
            if let Role::Spring { k, c, rest, .. } = self.role {
                self.soften(k, c, rest, times);
            }
        } else if let Role::Spring { .. } = self.role {
            self.impulse = self.pushed + 2.0 * self.taken_back;
            return;
        } else {
            // A limit that bore nothing in the push bears nothing now: what the joint had it bear, before contacts were known, is given back.
            let is_left = matches!(self.role, Role::Limits(_)) && self.pushed + self.taken_back == 0.0;
            self.impulse = if is_left { -self.pushed } else { self.load * times.kick };
        }
        let [least, most] = self.bounds(times);
        self.impulse = self.impulse.max(least).min(most);
    }

    /// Has a rigid row or a limit yield by a share of what its impulse does, and of what `more`, N s or N m s, would do.
    pub(super) fn yield_by(&mut self, share: f64, more: f64) {
        if let Role::Rigid | Role::Limits(_) = self.role {
            (self.softness, self.bias) = (share * self.k, self.k * more);
        }
    }

    /// What is added to the speed of its coordinate, m/s or rad/s.
    fn yielding(&self) -> f64 {
        self.bias + self.softness * self.impulse
    }

    /// Softness and bias of a spring: with a = c h/2 and b = k h²/4 per mass, p = -(2 b x/h + (a + b) u)/K.
    fn soften(&mut self, k: f64, c: f64, rest: f64, times: Times) {
        if times.kick >= times.h {
            // A single kick: implicit Euler, p = -h (k (x + h u) + c u).
            let (a, b) = (c * times.h, k * times.h * times.h);
            self.softness = 1.0 / (a + b);
            self.bias = (self.x - rest) * b / (times.h * (a + b));
            return;
        }
        let [a, b] = midpoint(k * self.k, c * self.k, times.h);
        self.softness = self.k / (a + b);
        self.bias = 2.0 * b * (self.x - rest) / (times.h * (a + b));
    }

    /// What the impulse of the phase is bounded by. Limits are by their own rule.
    fn bounds(&self, times: Times) -> [f64; 2] {
        match self.role {
            Role::Rigid | Role::Limits(_) => [f64::NEG_INFINITY, f64::INFINITY],
            Role::Spring { .. } | Role::Speed { .. } => {
                let most = self.most(times);
                [self.taken_back - most, self.taken_back + most]
            }
        }
    }

    /// The most that its own force does in the phase, N s: beside what was taken back.
    pub(super) fn most(&self, times: Times) -> f64 {
        match self.role {
            Role::Rigid | Role::Limits(_) => f64::INFINITY,
            Role::Spring { max, .. } | Role::Speed { max, .. } => max * times.kick,
        }
    }

    /// What of its impulse is of its own force.
    pub(super) fn own(&self) -> f64 {
        self.impulse - self.taken_back
    }

    /// How fast the coordinate changes, m/s or rad/s.
    pub(super) fn speed(&self, a: &JointBody, b: &JointBody) -> f64 {
        self.speed_of([a.velocity, b.velocity])
    }

    /// The same with these velocities of its bodies.
    pub(super) fn speed_of(&self, [a, b]: [V3; 2]) -> f64 {
        along(self.j[0], a) + along(self.j[1], b)
    }

    /// What it comes to in a drift of `h`, s, if the bodies go on without turning.
    pub(super) fn ahead(&self, a: &JointBody, b: &JointBody, h: f64) -> f64 {
        self.x + h * self.speed_of([a.mean_velocity(), b.mean_velocity()])
    }

    /// The coordinate, from what a rigid row asks for.
    pub(super) fn value(&self, at: &Geometry) -> f64 {
        self.coordinate.value(at) - self.zero
    }

    /// Finds by how much it is off, and whether it is to act. `ahead` is the coordinate after the drift.
    pub(super) fn look(&mut self, a: &JointBody, b: &JointBody, ahead: Option<f64>, times: Times) {
        let u = self.speed(a, b);
        // Where the coordinate will be, or is.
        let x = ahead.unwrap_or(self.x);
        let is_push = ahead.is_some();
        (self.residual, self.acts) = match self.role {
            Role::Rigid => {
                (if is_push { (x - left(self.x, times)) / times.h } else { u } + self.yielding(), true)
            }
            Role::Limits(limits) => self.look_at_limits(limits, x, u, is_push, times),
            Role::Spring { .. } => {
                // After the drift it bears what it bore before.
                let w = if is_push { u + self.yielding() } else { 0.0 };
                (w, is_push && is_inside(self.own().abs(), self.most(times), self.own() * w))
            }
            Role::Speed { .. } => {
                let w = u + self.yielding();
                (w, is_inside(self.own().abs(), self.most(times), self.own() * w))
            }
        };
        self.acts &= self.k > 0.0;
    }

    /// How fast the gap that is there could close, m/s or rad/s; 0 where it is rounding.
    pub(super) fn closing_speed(&self, times: Times) -> f64 {
        let gap = match self.role {
            Role::Rigid => self.x.abs(),
            Role::Limits([lower, upper]) => (lower - self.x).max(self.x - upper),
            Role::Spring { .. } | Role::Speed { .. } => 0.0,
        };
        if gap > EXACT * self.scale { (gap / times.h).min(CLOSING_SPEED) } else { 0.0 }
    }

    /// Limits act where they are reached, and let go of what leaves them.
    fn look_at_limits(
        &mut self,
        [lower, upper]: [f64; 2],
        x: f64,
        u: f64,
        is_push: bool,
        times: Times,
    ) -> (f64, bool) {
        let of_both_phases = self.pushed + self.impulse;
        let borne = of_both_phases + self.taken_back;
        let is_lower = if borne == 0.0 { x - lower < upper - x } else { borne > 0.0 };
        self.is_lower = is_lower;
        let gap = if is_lower { x - lower } else { x - upper };
        let before = if is_lower { (self.x - lower).min(0.0) } else { (self.x - upper).max(0.0) };
        let w = if is_push { (gap - left(before, times)) / times.h } else { u } + self.yielding();
        let is_reached = is_push || gap.abs() <= REACHED * self.scale || (gap < 0.0) == is_lower;
        let closes = if is_lower { w < 0.0 } else { w > 0.0 };
        let acts = of_both_phases != 0.0 || (is_reached && closes);
        self.met_at = (is_reached && !acts && self.k > 0.0).then_some(u - w);
        if acts { (w, true) } else { (0.0, false) }
    }

    /// How far it is off, as a share of what matters.
    pub(super) fn excess(&self, times: Times) -> f64 {
        if self.acts { self.residual.abs() * times.h / (EXACT * self.scale) } else { 0.0 }
    }

    /// Whether it is off by no more than this angle, rad, or this part of the size of the joint.
    pub(super) fn is_within(&self, part: f64, times: Times) -> bool {
        self.residual.abs() * times.h <= part * self.scale
    }

    /// By how much its impulse may change, as it acts now.
    pub(super) fn range_of_change(&self) -> [f64; 2] {
        [f64::NEG_INFINITY, f64::INFINITY].map(|wanted| self.cut(wanted, self.times) - self.impulse)
    }

    /// The impulse cut to what the row may bear.
    pub(super) fn cut(&self, impulse: f64, times: Times) -> f64 {
        if let Role::Limits(_) = self.role {
            return if self.is_lower { impulse.max(-self.pushed) } else { impulse.min(-self.pushed) };
        }
        let [least, most] = self.bounds(times);
        impulse.max(least).min(most)
    }
}

/// Whether an impulse of this size is within its bound, or is to come back from it, as its product with what it is off by, `inward`, tells.
pub(super) fn is_inside(size: f64, bound: f64, inward: f64) -> bool {
    size < bound || (bound > 0.0 && inward > 0.0)
}

/// The speed along a coordinate of a body, m/s or rad/s.
fn along(j: V3, v: V3) -> f64 {
    j[0] * v[0] + j[1] * v[1] + j[2] * v[2]
}

/// What is to be left of a gap after a step: it closes at `CLOSING_SPEED` at most.
fn left(gap: f64, times: Times) -> f64 {
    (gap.abs() - times.closing * gap.abs().min(CLOSING_SPEED * times.h)).copysign(gap)
}

/// a = c h/2 and b = k h²/4 of a spring of one mass with these `k`, 1/s², and `c`, 1/s, of which the midpoint rule makes the poles
/// of the exact one. With trace T and determinant D of the exact map over h:
///
/// ```text
/// D = (1 - a + b)/(1 + a + b)    T = 2 (1 - b)/(1 + a + b)
/// a = 2 (1 - D)/(1 + D + T)      b = (1 + D - T)/(1 + D + T)
/// ```
fn midpoint(k: f64, c: f64, h: f64) -> [f64; 2] {
    let (sigma, discriminant) = (0.5 * c * h, k * h * h - 0.25 * c * c * h * h);
    let angle = discriminant.abs().sqrt();
    let trace = if discriminant > 0.0 {
        if angle > FASTEST_FOLLOWED {
            return [0.5 * c * h, 0.25 * k * h * h];
        }
        2.0 * exp_of_minus(sigma) * rotation(angle)[0]
    } else {
        // σ - √(σ² - k h²), without the difference.
        let slow = k * h * h / (sigma + angle);
        exp_of_minus(slow) + exp_of_minus(sigma + angle)
    };
    let determinant = exp_of_minus(2.0 * sigma);
    let sum = 1.0 + determinant + trace;
    [2.0 * (1.0 - determinant) / sum, (1.0 + determinant - trace) / sum]
}

/// e^-x of a number that is not negative: by its series for a 1024th of it, at most 0.7, squared ten times.
fn exp_of_minus(x: f64) -> f64 {
    if x > 700.0 {
        return 0.0;
    }
    let y = -x / 1024.0;
    // The next term is below 10⁻¹⁷ of it.
    let mut less = y * (2..=16).rev().fold(1.0, |sum, term| 1.0 + y / f64::from(term) * sum);
    if x < 1.0 {
        // (1 + e)² = 1 + (2 e + e²) loses no digits of a small e.
        for _ in 0..10 {
            less = 2.0 * less + less * less;
        }
        return 1.0 + less;
    }
    (0..10).fold(1.0 + less, |value, _| value * value)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the standard library, which tests may use: the sum of the series is good to 10⁻¹⁶, ten squarings to 10⁻¹³.
    #[test]
    #[allow(clippy::disallowed_methods)]
    fn exponentials_are_those_of_the_library() {
        for x in [0.0, 1e-9, 1e-3, 0.1, 0.9, 1.1, 10.0, 600.0] {
            assert!((exp_of_minus(x) / (-x).exp() - 1.0).abs() < 1e-12, "{x}");
        }
    }
}
