//! A vector of the plane in `f32`: offsets, directions, velocities, forces.

use core::fmt;
use core::iter::Sum;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::math::trig;

/// A vector of the plane: an offset (m), a velocity (m/s), a force (N) or a direction.
///
/// It has the layout of two `f32`, and comes from `[f32; 2]`, `(f32, f32)` and, by features, other crates'
/// vectors, so that arguments of the engine can be written as `[1.0, 2.0]`.
///
/// ```
/// use rustycs::prelude::*;
///
/// // A ball bounces off a slope: v - 2 (v · n) n.
/// let (velocity, normal) = (Vec2::new(3.0, -4.0), Vec2::new(0.0, 1.0));
/// assert_eq!(velocity - 2.0 * velocity.dot(normal) * normal, Vec2::new(3.0, 4.0));
/// assert_eq!(velocity.length(), 5.0);
/// let aim = Vec2::new(30.0, 40.0).clamp_length(10.0); // as far as the arm reaches
/// assert!(aim.distance([6.0, 8.0]) < 1e-5);
/// ```
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec2 {
    /// Component to the right.
    pub x: f32,
    /// Component upward.
    pub y: f32,
}

impl Vec2 {
    /// The vector of length 0.
    pub const ZERO: Self = Self::new(0.0, 0.0);
    /// The vector of length 1 to the right.
    pub const X: Self = Self::new(1.0, 0.0);
    /// The vector of length 1 upward.
    pub const Y: Self = Self::new(0.0, 1.0);

    /// The vector (x, y).
    pub const fn new(x: f32, y: f32) -> Self {
        Self { x, y }
    }

    /// Both components equal to `value`.
    pub const fn splat(value: f32) -> Self {
        Self::new(value, value)
    }

    /// The vector of length 1 at `angle`, rad, counter-clockwise from [`X`](Self::X).
    pub fn from_angle(angle: f32) -> Self {
        let (s, c) = trig::sin_cos(angle);
        Self::new(c, s)
    }

    /// The angle from [`X`](Self::X) to this vector, rad, in (-π, π], counter-clockwise; 0 for the vector of length 0.
    pub fn angle(self) -> f32 {
        trig::atan2(self.y, self.x)
    }

    /// The vector turned by `angle`, rad, counter-clockwise. A [`Rot`](crate::Rot) turns many by the same angle.
    #[must_use]
    pub fn rotated(self, angle: f32) -> Self {
        let Self { x: c, y: s } = Self::from_angle(angle);
        Self::new(c * self.x - s * self.y, s * self.x + c * self.y)
    }

    /// Scalar product: |a|·|b|·cos of the angle between them.
    #[inline(always)]
    pub fn dot(self, other: Self) -> f32 {
        self.x * other.x + self.y * other.y
    }

    /// Third component of the cross product: |a|·|b|·sin of the angle from `self` to `other`.
    #[inline(always)]
    pub fn cross(self, other: Self) -> f32 {
        self.x * other.y - self.y * other.x
    }

    /// The vector turned by a quarter turn counter-clockwise: (-y, x). `w * r.perp()` is the velocity w × r.
    #[inline(always)]
    #[must_use]
    pub fn perp(self) -> Self {
        Self::new(-self.y, self.x)
    }

    /// Square of the length.
    #[inline(always)]
    pub fn length_squared(self) -> f32 {
        self.dot(self)
    }

    /// Length.
    #[inline(always)]
    pub fn length(self) -> f32 {
        self.length_squared().sqrt()
    }

    /// Length of the difference.
    pub fn distance(self, other: impl Into<Self>) -> f32 {
        (other.into() - self).length()
    }

    /// The vector on the straight way from this one (`t` = 0) to `other` (1); both ends are exact.
    #[must_use]
    pub fn lerp(self, other: impl Into<Self>, t: f32) -> Self {
        let other = other.into();
        let way = other - self;
        if t < 0.5 { self + way * t } else { other - way * (1.0 - t) }
    }

    /// The sum of the sizes of both components: at least the length, at most 1.42 times as much, and without a root.
    #[inline(always)]
    pub(crate) fn norm_1(self) -> f32 {
        self.x.abs() + self.y.abs()
    }

    /// The vector of length 1 in the same direction, or `None` where the direction is lost: length 0,
    /// not finite, or so small or large that its square leaves the range of `f32`.
    pub fn normalized(self) -> Option<Self> {
        let length_squared = self.length_squared();
        if length_squared >= f32::MIN_POSITIVE && length_squared.is_finite() {
            Some(self * (1.0 / length_squared.sqrt()))
        } else {
            None
        }
    }

    /// The vector of length 1 in the same direction, whatever its length; `None` where it has none, or one that is not finite.
    pub(crate) fn direction(self) -> Option<Self> {
        let size = self.x.abs().max(self.y.abs());
        self.normalized().or_else(|| Self::new(self.x / size, self.y / size).normalized())
    }

    /// [`normalized`](Self::normalized), or the vector of length 0 where the direction is lost.
    #[must_use]
    pub fn normalized_or_zero(self) -> Self {
        self.normalized().unwrap_or(Self::ZERO)
    }

    /// The vector, shortened to `longest` where it is longer; `longest` is 0 or more.
    #[must_use]
    pub fn clamp_length(self, longest: f32) -> Self {
        let length = self.length();
        if length > longest { self * (longest / length) } else { self }
    }

    /// Smaller of each component.
    #[inline(always)]
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        Self::new(self.x.min(other.x), self.y.min(other.y))
    }

    /// Larger of each component.
    #[inline(always)]
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Self::new(self.x.max(other.x), self.y.max(other.y))
    }

    /// Absolute value of each component.
    #[inline(always)]
    #[must_use]
    pub fn abs(self) -> Self {
        Self::new(self.x.abs(), self.y.abs())
    }

    /// Whether both components are numbers, neither NaN nor infinite.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl Add for Vec2 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y)
    }
}

impl Sub for Vec2 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y)
    }
}

impl Mul<f32> for Vec2 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f32) -> Self {
        Self::new(self.x * factor, self.y * factor)
    }
}

impl Mul<Vec2> for f32 {
    type Output = Vec2;
    #[inline(always)]
    fn mul(self, vector: Vec2) -> Vec2 {
        vector * self
    }
}

impl Div<f32> for Vec2 {
    type Output = Self;
    #[inline(always)]
    fn div(self, divisor: f32) -> Self {
        Self::new(self.x / divisor, self.y / divisor)
    }
}

impl Neg for Vec2 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y)
    }
}

impl AddAssign for Vec2 {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Vec2 {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl MulAssign<f32> for Vec2 {
    #[inline(always)]
    fn mul_assign(&mut self, factor: f32) {
        *self = *self * factor;
    }
}

impl DivAssign<f32> for Vec2 {
    #[inline(always)]
    fn div_assign(&mut self, divisor: f32) {
        *self = *self / divisor;
    }
}

impl Sum for Vec2 {
    fn sum<I: Iterator<Item = Self>>(vectors: I) -> Self {
        vectors.fold(Self::ZERO, Add::add)
    }
}

impl<'a> Sum<&'a Self> for Vec2 {
    fn sum<I: Iterator<Item = &'a Self>>(vectors: I) -> Self {
        vectors.copied().sum()
    }
}

/// Writes (x, y), both in the same format.
pub(super) fn write_pair(
    f: &mut fmt::Formatter<'_>,
    x: &impl fmt::Display,
    y: &impl fmt::Display,
) -> fmt::Result {
    f.write_str("(")?;
    x.fmt(f)?;
    f.write_str(", ")?;
    y.fmt(f)?;
    f.write_str(")")
}

/// (x, y); a precision is that of both: `{:.2}`.
impl fmt::Display for Vec2 {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_pair(f, &self.x, &self.y)
    }
}

impl From<[f32; 2]> for Vec2 {
    fn from([x, y]: [f32; 2]) -> Self {
        Self::new(x, y)
    }
}

impl From<&[f32; 2]> for Vec2 {
    fn from(&[x, y]: &[f32; 2]) -> Self {
        Self::new(x, y)
    }
}

impl From<(f32, f32)> for Vec2 {
    fn from((x, y): (f32, f32)) -> Self {
        Self::new(x, y)
    }
}

impl From<&Vec2> for Vec2 {
    fn from(vector: &Vec2) -> Self {
        *vector
    }
}

impl From<Vec2> for [f32; 2] {
    fn from(vector: Vec2) -> Self {
        [vector.x, vector.y]
    }
}

impl From<Vec2> for (f32, f32) {
    fn from(vector: Vec2) -> Self {
        (vector.x, vector.y)
    }
}

impl From<Vec2> for [f64; 2] {
    fn from(vector: Vec2) -> Self {
        [f64::from(vector.x), f64::from(vector.y)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_quotients_and_constants_are_those_of_the_components() {
        let all = [Vec2::X, 2.0 * Vec2::Y, Vec2::new(-3.0, 0.5)];
        let sum = Vec2::new(-2.0, 2.5);
        assert_eq!((all.iter().sum::<Vec2>(), all.into_iter().sum::<Vec2>()), (sum, sum));
        let mut half = sum;
        half /= 2.0;
        assert_eq!(half, Vec2::new(-1.0, 1.25));
        assert_eq!((<[f64; 2]>::from(sum), sum.to_string()), ([-2.0, 2.5], "(-2, 2.5)".into()));
    }

    #[test]
    fn the_ends_of_a_way_are_exact_and_its_middle_is_halfway() {
        let (from, to) = (Vec2::new(0.1, 1e9), Vec2::new(0.7, -3.3));
        assert_eq!((from.lerp(to, 0.0), from.lerp(to, 1.0), from.lerp(from, 0.3)), (from, to, from));
        assert_eq!(Vec2::ZERO.lerp([4.0, -2.0], 0.5), Vec2::new(2.0, -1.0));
        assert_eq!(Vec2::ZERO.distance([3.0, 4.0]), 5.0);
    }

    /// Sine, cosine and arctangent are right to 1e-6.
    #[test]
    fn angles_lead_there_and_back() {
        for step in -31..=31_i16 {
            let angle = 0.1 * f32::from(step);
            assert!((Vec2::from_angle(angle).angle() - angle).abs() < 2e-6, "{angle}");
            assert!(Vec2::X.rotated(angle).distance(Vec2::from_angle(angle)) < 1e-6, "{angle}");
        }
        assert!(Vec2::Y.rotated(core::f32::consts::FRAC_PI_2).distance(-Vec2::X) < 1e-6);
    }

    #[test]
    fn what_is_too_long_is_shortened_and_what_has_no_direction_stays_none() {
        assert_eq!(Vec2::new(6.0, 8.0).clamp_length(5.0), Vec2::new(3.0, 4.0));
        assert_eq!(Vec2::new(3.0, 4.0).clamp_length(5.0), Vec2::new(3.0, 4.0));
        assert_eq!((Vec2::ZERO.clamp_length(0.0), Vec2::ZERO.normalized_or_zero()), (Vec2::ZERO, Vec2::ZERO));
        assert_eq!(Vec2::new(0.0, -7.0).normalized_or_zero(), -Vec2::Y);
    }
}
