//! How soft a contact is: what pushes overlapping bodies apart, and what an impulse leaks.
//!
//! A rigid contact asks for vn = 0. A soft one asks for vn + bias(s) + leak·k·λ = 0, where s is the
//! separation, λ the impulse of the substep and k = 1/m_eff. The bias drives the overlap out, the leak lets
//! a redundant stack of contacts share its load instead of fighting over it (E. Catto, "Solver2D", 2024,
//! "soft step"). The bias is a speed per depth in 1/s and not a spring tied to the substep, so that more
//! substeps buy less error: at rest the overlap is s = leak·g·h/(2·BIAS_RATE) per unit of load.

use crate::compute::Lane;

/// Share of its own impulse that a contact gives back per sweep, no unit. It acts on half an impulse, as
/// each half of the kick is solved on its own, and so is about twice what a single kick would take. Overlap
/// at rest goes with `LEAK / BIAS_RATE`: less leak with a slower bias sags alike but lets a large pyramid come to
/// rest more slowly.
const LEAK: f32 = 0.14;

/// A contact leaks in full up to this speed, m/s, and `LEAK_SHARE_BEYOND` of what is more: where heavy bodies
/// press on light ones, the full leak would let them sink in.
const FULL_LEAK_SPEED: f32 = 0.5;

/// What remains of a leak beyond `FULL_LEAK_SPEED`, no unit. It must not be 0: a contact whose leak no longer
/// grows with its load is undamped, and bodies that are pressed together from all sides explode.
const LEAK_SHARE_BEYOND: f32 = 0.15;

/// Overlap up to `SHALLOW` is driven out at this rate, 1/s. Faster with the same leak, and large pyramids do
/// not come to rest; slower, and stacks sag more.
const BIAS_RATE: f32 = 28.0;

/// No more than this share of an overlap is driven out in one substep, no unit: at low tick rates `BIAS_RATE`
/// would ask for so much that a stack overshoots and trembles.
const LARGEST_SHARE: f32 = 0.3;

/// Overlap beyond `SHALLOW` is driven out at this rate, 1/s. One rate for all depths makes bodies that are
/// pressed together from all sides fight each other.
const DEEP_BIAS_RATE: f32 = 9.0;

/// Overlap below which a contact counts as shallow, m.
const SHALLOW: f32 = 0.02;

/// No overlap is driven out faster than this, m/s, so that bodies created in one place part without a bang.
const PUSH_SPEED: f32 = 3.0;

/// Overlap at rest under a load, m, whose impulse times k is `speed`, m/s, per substep: there the bias makes up for
/// the leak of the half of it that acts before the move.
#[inline(always)]
pub(crate) fn sag(speed: f32, per_substep: f32) -> f32 {
    0.5 * LEAK * speed / BIAS_RATE.min(LARGEST_SHARE * per_substep)
}

/// Speed with which the contact wants to close (positive, while apart: it may close the gap s within one
/// substep of length 1/`per_substep`) or to open (negative, where bodies overlap), m/s.
#[inline(always)]
pub(crate) fn bias<L: Lane>(separation: L, per_substep: L) -> L {
    let zero = L::splat(0.0);
    let depth = zero - separation;
    let shallow = depth.min(L::splat(SHALLOW));
    let rate = L::splat(BIAS_RATE).min(L::splat(LARGEST_SHARE) * per_substep);
    let push = rate * shallow + rate.min(L::splat(DEEP_BIAS_RATE)) * (depth - shallow);
    let apart = separation.greater(zero);
    L::select(apart, separation * per_substep, -(push.min(L::splat(PUSH_SPEED))))
}

/// The bias of a sweep that must not push: only the gap counts.
#[inline(always)]
pub(crate) fn gap_bias<L: Lane>(separation: L, per_substep: L) -> L {
    separation.max(L::splat(0.0)) * per_substep
}

/// The leak of a contact with this separation, inverse effective mass `k` and impulse: none while it is
/// apart.
#[inline(always)]
pub(crate) fn leak<L: Lane>(separation: L, k: L, impulse: L) -> L {
    let full = L::splat(FULL_LEAK_SPEED);
    let speed = (L::splat(LEAK) * k * impulse).max(full);
    let share = (full + L::splat(LEAK_SHARE_BEYOND) * (speed - full)) / speed;
    L::select(separation.greater(L::splat(0.0)), L::splat(0.0), L::splat(LEAK) * share)
}
