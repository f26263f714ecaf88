//! A vector of the plane in `f32`: offsets, directions, velocities, forces.

use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A vector of the plane: an offset (m), a velocity (m/s), a force (N) or a direction.
///
/// It has the layout of two `f32`, and comes from `[f32; 2]`, `(f32, f32)` and, by features, other crates'
/// vectors, so that arguments of the engine can be written as `[1.0, 2.0]`.
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

    /// The vector (x, y).
    pub const fn new(x: f32, y: f32) -> Self {
        Self { x, y }
    }

    /// Both components equal to `value`.
    pub const fn splat(value: f32) -> Self {
        Self::new(value, value)
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
