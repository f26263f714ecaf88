//! Integration: the kick (velocity) and the drift (position) of the substep.
//!
//! A substep kicks half before the drift and half after it (velocity Verlet; L. Verlet, 1967). It costs what
//! one kick costs, as the accelerations of the second half serve the first half of the next substep, and is
//! of second order: bodies under constant forces fall exactly.

use crate::compute::{BodyState, LaneVec2};
use crate::math::{Vec2, trig};

/// What acts on the body of a row, in 32 bytes.
#[repr(C, align(32))]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kick {
    /// Acceleration of the centre where the body is now, m/s².
    pub(crate) acceleration: Vec2,
    /// The part of it that stays the same during the step, m/s².
    pub(crate) steady: Vec2,
    /// What rounding has kept out of the velocity so far, m/s. At 240 Hz and four substeps half a kick of
    /// gravity is 5e-3 m/s; a velocity of 20 m/s in `f32` would lose up to 1e-6 of it, each time to the
    /// same side.
    pub(crate) carry: Vec2,
    /// Angular acceleration, rad/s².
    pub(crate) angular_acceleration: f32,
}

impl Kick {
    /// Nothing acts.
    pub(crate) const NONE: Self =
        Self { acceleration: Vec2::ZERO, steady: Vec2::ZERO, carry: Vec2::ZERO, angular_acceleration: 0.0 };
}

const _: () = assert!(size_of::<Kick>() == 32);

/// Damping of the body of a row, for one half kick.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Damping {
    pub(crate) row: u32,
    /// Share of the velocity that is lost, no unit.
    pub(crate) linear: f32,
    /// Share of the angular velocity that is lost, no unit.
    pub(crate) angular: f32,
}

/// Speeds beyond which velocities are cut, far above use: they keep numbers finite, whatever comes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpeedLimits {
    /// Per component of the velocity, m/s.
    pub(crate) speed: f32,
    /// Angular velocity, rad/s.
    pub(crate) spin: f32,
}

/// Share of a velocity that damping `c` (1/s) takes in the time `t` (s): 1 - e^(-ct) to second order, and
/// between 0 and 1 for every c ≥ 0. The share and not what is left, which so near to 1 has lost its digits.
pub(crate) fn damping_loss(c: f32, t: f32) -> f32 {
    let x = c * t;
    let gain = x + 0.5 * x * x;
    gain / (1.0 + gain)
}

/// v += t·a, with what rounding loses carried to the next kick (Kahan, 1965; sum by Knuth's two-sum).
#[inline(always)]
pub(crate) fn kick(state: &mut BodyState, kick: &mut Kick, t: f32, limits: SpeedLimits) {
    let v = Vec2::from(state.velocity);
    let gain = kick.acceleration * t + kick.carry;
    let sum = v + gain;
    let gained = sum - v;
    let lost = (v - (sum - gained)) + (gain - gained);
    // A speed so great that the sum overflows leaves nothing to carry.
    kick.carry = if lost.is_finite() { lost } else { Vec2::ZERO };
    state.velocity = LaneVec2 { x: clamp(sum.x, limits.speed), y: clamp(sum.y, limits.speed) };
    let w = state.angular_velocity + kick.angular_acceleration * t;
    state.angular_velocity = clamp(w, limits.spin);
}

/// x += h·v, and the rotation turns by exactly h·w.
#[inline(always)]
pub(crate) fn drift(state: &mut BodyState, h: f32) {
    state.delta_position = state.delta_position + state.velocity * h;
    turn(state, state.angular_velocity * h);
}

/// Turns the body by `angle`, rad.
#[inline(always)]
pub(crate) fn turn(state: &mut BodyState, angle: f32) {
    if angle == 0.0 {
        return;
    }
    let (sin, cos) = trig::sin_cos(angle);
    let q = state.delta_rotation;
    state.delta_rotation.c = q.c * cos - q.s * sin;
    state.delta_rotation.s = q.s * cos + q.c * sin;
}

/// `value` cut to [-limit, limit]; 0 for NaN.
fn clamp(value: f32, limit: f32) -> f32 {
    if value.is_nan() { 0.0 } else { value.clamp(-limit, limit) }
}
