//! A rotation of the plane as the cosine and sine of its angle.

use core::ops::Mul;

use crate::math::{Vec2, trig};

/// A rotation, kept as (cos, sin) of its angle: turning a vector takes four products and no trigonometry.
///
/// ```
/// use rustycs::prelude::*;
///
/// let quarter = Rot::from_angle(std::f32::consts::FRAC_PI_2);
/// assert!(quarter.rotate(Vec2::new(1.0, 0.0)).distance([0.0, 1.0]) < 1e-6); // counter-clockwise
/// let halfway = Rot::from_angle(0.0).lerp(quarter, 0.5);
/// assert!((halfway.angle() - std::f32::consts::FRAC_PI_4).abs() < 1e-6);
/// ```
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rot {
    /// Cosine of the angle.
    pub c: f32,
    /// Sine of the angle.
    pub s: f32,
}

impl Rot {
    /// The rotation by 0.
    pub const IDENTITY: Self = Self { c: 1.0, s: 0.0 };

    /// The rotation by `angle`, rad, counter-clockwise.
    pub fn from_angle(angle: f32) -> Self {
        let (s, c) = trig::sin_cos(angle);
        Self { c, s }
    }

    /// The angle, rad, in (-π, π].
    pub fn angle(self) -> f32 {
        trig::atan2(self.s, self.c)
    }

    /// The vector turned by this rotation: from the body's frame into the world's.
    #[inline(always)]
    pub fn rotate(self, v: Vec2) -> Vec2 {
        Vec2::new(self.c * v.x - self.s * v.y, self.s * v.x + self.c * v.y)
    }

    /// The vector turned back by this rotation: from the world's frame into the body's.
    #[inline(always)]
    pub fn unrotate(self, v: Vec2) -> Vec2 {
        Vec2::new(self.c * v.x + self.s * v.y, self.c * v.y - self.s * v.x)
    }

    /// The rotation back.
    #[inline(always)]
    #[must_use]
    pub fn inverse(self) -> Self {
        Self { c: self.c, s: -self.s }
    }

    /// The rotation on the way from this one (`t` = 0) to `other` (1), at a constant rate and the shorter way round.
    #[must_use]
    pub fn lerp(self, other: Self, t: f32) -> Self {
        if t == 1.0 || self == other {
            return other;
        }
        Self::from_angle(t * (self.inverse() * other).angle()) * self
    }

    /// The same rotation with c² + s² = 1 again; a product of many drifts from it by rounding.
    #[inline(always)]
    #[must_use]
    pub fn normalized(self) -> Self {
        let length_squared = self.c * self.c + self.s * self.s;
        if length_squared > 0.0 {
            let scale = 1.0 / length_squared.sqrt();
            Self { c: self.c * scale, s: self.s * scale }
        } else {
            Self::IDENTITY
        }
    }
}

impl Default for Rot {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Mul for Rot {
    type Output = Self;
    /// First `other`, then `self`: the angles add.
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { c: self.c * other.c - self.s * other.s, s: self.s * other.c + self.c * other.s }
    }
}
