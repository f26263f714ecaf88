//! How soft a contact is: what pushes overlapping bodies apart, and by how much it yields to an impulse.
//!
//! A rigid contact asks for vn = 0. A soft one asks for vn + bias(s) + γ·k·λ = 0, where s is the
//! separation, λ the impulse of the substep and k = 1/m_eff. The bias drives the overlap out, the compliance γ lets
//! a redundant stack of contacts share its load instead of fighting over it (E. Catto, "Solver2D", 2024,
//! "soft step"). The bias is a speed per depth in 1/s and not a spring tied to the substep, so that more
//! substeps buy less error: at rest the overlap is s = γ·g·h/(2·BIAS_RATE) per unit of load.
//!
//! Under a great load that would be deep. So a contact yields to what its load differs from a part λ* that has lasted,
//! γ·k·(λ - λ*), and λ* follows the load as a lag of the first order does (the multiplier of an augmented Lagrangian; M. R.
//! Hestenes, 1969). What is new is still shared.
//!
//! Where the kick is split, contacts yield in the sweep before the bodies move, to half of the impulse of the substep: k λ is that
//! of this half here, but in [`sag`].

use crate::compute::Lane;

/// Share of its own impulse that a contact gives back per sweep, no unit. It acts on half an impulse, as
/// each half of the kick is solved on its own, and so is about twice what a single kick would take. Overlap
/// at rest goes with `COMPLIANCE / BIAS_RATE`: less compliance with a slower bias sags alike but lets a large pyramid come to
/// rest more slowly.
const COMPLIANCE: f32 = 0.14;

/// A contact yields by γ k λ up to this speed, m/s, and by `COMPLIANCE_SHARE_BEYOND` of what is more: where heavy bodies
/// press on light ones, the full compliance would let them sink in.
const FULL_COMPLIANCE_SPEED: f32 = 0.5;

/// What remains of the compliance beyond `FULL_COMPLIANCE_SPEED`, no unit. It must not be 0: a contact that does not yield
/// more under a greater load is undamped, and bodies that are pressed together from all sides explode.
const COMPLIANCE_SHARE_BEYOND: f32 = 0.15;

/// Beyond this speed, m/s, the compliance does not change any more: it is within 0.3 % of what it comes to.
const LAST_COMPLIANCE_SPEED: f32 = 1e3;

/// To a load that lasts a contact yields by γ k λ up to this speed, m/s, and by `LASTING_SHARE` of what is more: 5 mm of overlap,
/// at `BIAS_RATE`. Of the contacts of the scene `pile` that are deeper than 10 mm without it one in fifteen still is; with twice
/// as much a third are, with half as much a loaded arch trembles at 1 cm/s, and with 0 pyramids of 40 rows fall.
const LASTING_SPEED: f32 = 0.005 * BIAS_RATE;

/// What remains of the compliance to a load that lasts, no unit. With 0.3 half as many contacts again are deeper than 10 mm;
/// with 0.05, light bodies are pressed out of heaps at twice the speed.
const LASTING_SHARE: f32 = 0.1;

/// What lasts of a load follows it with this time constant, s. With a tenth of it four times as many contacts are deeper than 10 mm, as
/// the loads of a heap that is still falling are taken for such; with three times as much it is the same.
const LASTING_TIME: f32 = 0.5;

/// Overlap is driven out at this rate, 1/s. Faster with the same compliance, and large pyramids do not come to rest;
/// slower, and stacks sag more.
const BIAS_RATE: f32 = 28.0;

/// No more than this share of an overlap is driven out in one substep, no unit: at low tick rates `BIAS_RATE`
/// would ask for so much that a stack overshoots and trembles.
const LARGEST_SHARE: f32 = 0.3;

/// No overlap is driven out faster than this, m/s, so that bodies created in one place part without a bang: fifty boxes in
/// one place come to 100 m/s without it.
pub(crate) const PUSH_SPEED: f32 = 3.0;

/// Two bodies are deep in each other where they overlap by this share of the width of the narrower, no unit. What is fitted closely
/// into a hole touches both sides of it, but overlaps them by less. With a quarter, sixty letters in one place still came to 97 m/s;
/// with 3 %, light bodies under heavy ones are twice as fast as with a tenth.
pub(crate) const DEEP_SHARE: f32 = 0.1;

/// Overlap at rest under a load that has not lasted yet, m, whose impulse times k is `speed`, m/s, per substep: there the bias makes up for
/// what yields to the half of it that acts before the move.
#[inline(always)]
pub(crate) fn sag(speed: f32, substep_rate: f32) -> f32 {
    0.5 * COMPLIANCE * speed / BIAS_RATE.min(LARGEST_SHARE * substep_rate)
}

/// Speed with which the contact wants to close (positive, while apart: it may close the gap s within one
/// substep of length 1/`substep_rate`) or to open (negative, where bodies overlap), m/s: the greatest of three straight
/// lines over the separation, each less steep than the one before.
#[inline(always)]
pub(crate) fn bias<L: Lane>(separation: L, substep_rate: L) -> L {
    let rate = L::splat(BIAS_RATE).min(L::splat(LARGEST_SHARE) * substep_rate);
    (separation * substep_rate).max((separation * rate).max(L::splat(-PUSH_SPEED)))
}

/// The bias of a sweep that must not push: only the gap counts.
#[inline(always)]
pub(crate) fn gap_bias<L: Lane>(separation: L, substep_rate: L) -> L {
    separation.max(L::splat(0.0)) * substep_rate
}

/// 1 + γ of a contact with this separation and `load`, k λ in m/s, as a fraction: numerator and denominator, both
/// from 0.5 to 1100. While it is apart nothing yields.
#[inline(always)]
pub(crate) fn one_and_compliance<L: Lane>(separation: L, load: L) -> [L; 2] {
    let speed = L::splat(COMPLIANCE) * load;
    let whole = speed.max(L::splat(FULL_COMPLIANCE_SPEED)).min(L::splat(LAST_COMPLIANCE_SPEED));
    // COMPLIANCE of what is up to the full speed, COMPLIANCE_SHARE_BEYOND of that of what is more.
    let full = L::splat(COMPLIANCE * (1.0 - COMPLIANCE_SHARE_BEYOND) * FULL_COMPLIANCE_SPEED);
    let soft = L::splat(1.0 + COMPLIANCE * COMPLIANCE_SHARE_BEYOND) * whole + full;
    [L::select(separation.greater(L::splat(0.0)), whole, soft), whole]
}

/// Whether a contact yields in full to a load, k λ of half a substep in m/s, also if that lasts.
#[inline(always)]
pub(crate) fn yields_in_full(half_load: f32) -> bool {
    COMPLIANCE * half_load <= LASTING_SPEED
}

/// What a point with this k, 1/kg, bears without yielding after one more step of length `dt`, s, in which it bore this impulse in
/// half a substep, N s.
#[inline(always)]
pub(crate) fn lasting_after(lasting_impulse: f32, [k, impulse]: [f32; 2], dt: f32) -> f32 {
    if yields_in_full(k * impulse) {
        return 0.0;
    }
    let whole = (1.0 - LASTING_SHARE) * (impulse - LASTING_SPEED / (COMPLIANCE * k));
    let after = lasting_impulse + (whole - lasting_impulse) * (dt / LASTING_TIME).min(1.0);
    // What has ceased to be borne is forgotten at once.
    after.min(whole)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// k (λ - λ*) comes to what lasts of the load k λ, and k λ* at once to no more than the load when that ends. The closed form
    /// of the first order lag after n steps is 1 - (1 - dt/T)ⁿ of the whole.
    #[test]
    fn a_contact_comes_to_yield_to_the_least_part_of_a_load_that_lasts() {
        let (k, dt, whole) = (50.0_f32, 1.0 / 60.0, LASTING_SPEED / COMPLIANCE);
        for load in [0.0, 0.5 * whole, 2.0 * whole, 100.0 * whole] {
            let mut lasting = 0.0;
            for step in 1..=600 {
                lasting = lasting_after(lasting, [k, load / k], dt);
                let left = (1.0 - f64::from(dt / LASTING_TIME)).powi(step);
                let yields = LASTING_SHARE * (load - whole) + whole;
                let expected = f64::from((load - yields).max(0.0)) * (1.0 - left);
                assert!(
                    (f64::from(k * lasting) - expected).abs() <= 1e-5 * f64::from(load),
                    "{load}, {step}"
                );
            }
            // What a tenth less of a load bears is what lasts at once.
            let less = lasting_after(lasting, [k, 0.9 * load / k], dt);
            let expected = (1.0 - LASTING_SHARE) * (0.9 * load - whole).max(0.0);
            assert!((k * less - expected).abs() <= 1e-5 * load, "{load} less a tenth");
            assert_eq!(lasting_after(lasting, [k, 0.0], dt), 0.0, "a load that ended");
        }
    }

    /// The compliance as its constants say it, in `f64`: `COMPLIANCE` of a load up to the full speed,
    /// `COMPLIANCE_SHARE_BEYOND` of that of what is more. Beyond the last speed it is 0.3 % of the compliance off, 1e-4 of the whole; the
    /// rest is rounding.
    #[test]
    fn compliance_is_what_its_constants_say_and_fits_into_products_under_any_load() {
        for load in [0.0, 1.0, 3.5, 3.6, 10.0, 1e3, 1e4, 1e6, 1e27_f32] {
            let [numerator, denominator] = one_and_compliance(-0.01_f32, load);
            assert!((0.5..1100.0).contains(&numerator) && (0.5..1100.0).contains(&denominator), "{load}");
            let (speed, full) = (f64::from(COMPLIANCE) * f64::from(load), f64::from(FULL_COMPLIANCE_SPEED));
            let yielding = speed.min(full) + f64::from(COMPLIANCE_SHARE_BEYOND) * (speed - full).max(0.0);
            let compliance = f64::from(COMPLIANCE) * if speed > 0.0 { yielding / speed } else { 1.0 };
            assert!((f64::from(numerator / denominator) - 1.0 - compliance).abs() < 1e-4, "{load}");
            let [numerator, denominator] = one_and_compliance(0.01_f32, load);
            assert!(numerator == denominator, "apart under {load}");
        }
    }
}
