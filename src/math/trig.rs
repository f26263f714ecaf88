//! Sine, cosine and arc tangent of our own: the standard library's differ in the last bits between machines,
//! and a simulation that must give the same bits everywhere cannot use them.
//!
//! Arguments are reduced in `f64`, the polynomials are the Taylor series cut where the next term is below
//! `f64` × 1e-9, so results are within one unit in the last place of `f32`.
//!
//! ```
//! use rustycs::math::trig::{atan2, sin_cos};
//!
//! let (sin, cos) = sin_cos(0.3);
//! assert!((atan2(sin, cos) - 0.3).abs() < 1e-7);
//! ```

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};
use core::ops::{Add, Mul, Sub};

/// Beyond this, rad, whole turns are taken off first (the remainder is exact), so that quarter turns stay small
/// numbers; an `f32` that large has no digits left that say where in the turn it is.
const LARGE: f32 = 1e9;

/// Sine and cosine of `angle`, rad. Zero and one for an angle that is not finite.
///
/// ```
/// use rustycs::math::trig::sin_cos;
///
/// // A throw at 30°, at 20 m/s: the same bits on every machine.
/// let (sin, cos) = sin_cos(std::f32::consts::PI / 6.0);
/// assert!((20.0 * sin - 10.0).abs() < 1e-5 && (20.0 * cos - 17.320508).abs() < 1e-5);
/// ```
#[inline]
pub fn sin_cos(angle: f32) -> (f32, f32) {
    if !angle.is_finite() {
        return (0.0, 1.0);
    }
    let angle = if angle.abs() > LARGE { f64::from(angle) % TAU } else { f64::from(angle) };
    // angle = quarter_turns·π/2 + x with |x| <= π/4
    let quarter_turns = round(angle * (1.0 / FRAC_PI_2));
    let (sin, cos) = sin_cos_of_small(angle - quarter_turns * FRAC_PI_2);
    let (sin, cos) = match quarter_turns as i64 & 3 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    };
    (sin as f32, cos as f32)
}

/// Sine and cosine of an angle of an eighth of a turn at most, rad: all there is to do for a small one. `X` is `f64`
/// or lanes of it.
#[inline(always)]
pub(crate) fn sin_cos_of_small<X>(x: X) -> (X, X)
where
    X: Copy + From<f64> + Add<Output = X> + Sub<Output = X> + Mul<Output = X>,
{
    let n = X::from;
    let x2 = x * x;
    let sin = x
        * (n(1.0)
            + x2 * (n(-1.0 / 6.0)
                + x2 * (n(1.0 / 120.0) + x2 * (n(-1.0 / 5040.0) + x2 * n(1.0 / 362_880.0)))));
    let cos = n(1.0)
        + x2 * (n(-0.5)
            + x2 * (n(1.0 / 24.0)
                + x2 * (n(-1.0 / 720.0) + x2 * (n(1.0 / 40_320.0) - x2 * n(1.0 / 3_628_800.0)))));
    (sin, cos)
}

/// Angle of the vector (x, y), rad, in (-π, π]; 0 for the zero vector.
///
/// ```
/// use rustycs::math::trig::atan2;
///
/// // The angle to a target 3 m to the left and 3 m up.
/// assert!((atan2(3.0, -3.0) - 0.75 * std::f32::consts::PI).abs() < 1e-6);
/// ```
pub fn atan2(y: f32, x: f32) -> f32 {
    atan2_f64(f64::from(y), f64::from(x)) as f32
}

/// The same, to 10⁻¹⁰ rad.
pub(crate) fn atan2_f64(y: f64, x: f64) -> f64 {
    let (small, large) = if y.abs() < x.abs() { (y.abs(), x.abs()) } else { (x.abs(), y.abs()) };
    if large == 0.0 || !large.is_finite() {
        return 0.0;
    }
    let mut angle = atan_unit(small / large);
    if y.abs() >= x.abs() {
        angle = FRAC_PI_2 - angle;
    }
    if x < 0.0 {
        angle = PI - angle;
    }
    if y < 0.0 { -angle } else { angle }
}

/// Arc tangent for t in [0, 1].
///
/// Twice halved by atan t = 2 atan(t / (1 + √(1 + t²))), which brings t below 0.2, then the Taylor series.
fn atan_unit(t: f64) -> f64 {
    if t == 1.0 {
        return FRAC_PI_4;
    }
    let halve = |t: f64| t / (1.0 + (1.0 + t * t).sqrt());
    let t = halve(halve(t));
    let t2 = t * t;
    let series = 1.0
        + t2 * (-1.0 / 3.0
            + t2 * (1.0 / 5.0
                + t2 * (-1.0 / 7.0 + t2 * (1.0 / 9.0 + t2 * (-1.0 / 11.0 + t2 * (1.0 / 13.0))))));
    4.0 * t * series
}

/// Nearest integer, by adding and taking away 1.5·2⁵²: exact IEEE operations on every machine.
#[inline(always)]
fn round(value: f64) -> f64 {
    const MAGIC: f64 = 6_755_399_441_055_744.0;
    if value.abs() < 2_251_799_813_685_248.0 { (value + MAGIC) - MAGIC } else { value }
}

#[cfg(test)]
mod tests {
    use super::{atan2, sin_cos};

    /// One unit in the last place of a result up to 1 is 6e-8; the angle itself is exact.
    #[test]
    fn sine_and_cosine_agree_with_the_standard_library_in_f64() {
        for i in -200_000..200_000 {
            let angle = i as f32 * 0.001_37;
            let (sin, cos) = sin_cos(angle);
            assert!((f64::from(sin) - f64::from(angle).sin()).abs() < 1e-7, "sin {angle}");
            assert!((f64::from(cos) - f64::from(angle).cos()).abs() < 1e-7, "cos {angle}");
        }
        assert_eq!(sin_cos(f32::NAN), (0.0, 1.0));
        for angle in [1e9, 1e18, -3e38] {
            let (sin, cos) = sin_cos(angle);
            assert!((sin * sin + cos * cos - 1.0).abs() < 1e-6, "{angle}: ({sin}, {cos})");
        }
    }

    #[test]
    fn arc_tangent_agrees_with_the_standard_library_in_f64() {
        for i in -1000..=1000 {
            for j in -50..=50 {
                let (y, x) = (i as f32 * 0.01, j as f32 * 0.2);
                let exact = f64::from(y).atan2(f64::from(x));
                assert!((f64::from(atan2(y, x)) - exact).abs() < 4e-7, "atan2({y}, {x})");
            }
        }
        assert_eq!(atan2(0.0, 0.0), 0.0);
        assert_eq!(atan2(0.0, -1.0), core::f32::consts::PI);
    }
}
