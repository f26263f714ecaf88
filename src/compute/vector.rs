//! Vectors and rotations whose components are lanes.

use core::ops::{Add, Mul, Sub};

use crate::compute::Lane;

/// `WIDTH` vectors of the plane.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LaneVec2<L> {
    pub(crate) x: L,
    pub(crate) y: L,
}

impl<L: Lane> LaneVec2<L> {
    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> L {
        self.x * other.x + self.y * other.y
    }

    #[inline(always)]
    pub(crate) fn cross(self, other: Self) -> L {
        self.x * other.y - self.y * other.x
    }

    /// Turned by a quarter turn counter-clockwise.
    #[inline(always)]
    pub(crate) fn perp(self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    /// `yes` where the mask holds, `no` elsewhere.
    #[inline(always)]
    pub(crate) fn select(mask: L::Mask, yes: Self, no: Self) -> Self {
        Self { x: L::select(mask, yes.x, no.x), y: L::select(mask, yes.y, no.y) }
    }
}

impl<L: Lane> Add for LaneVec2<L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl<L: Lane> Sub for LaneVec2<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl<L: Lane> Mul<L> for LaneVec2<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: L) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }
}

impl From<crate::math::Vec2> for LaneVec2<f32> {
    #[inline(always)]
    fn from(v: crate::math::Vec2) -> Self {
        Self { x: v.x, y: v.y }
    }
}

impl LaneVec2<f32> {
    /// It as a vector. Not by `From`, which the compiler would tell users of who give something else where a vector is wanted.
    #[inline(always)]
    pub(crate) fn to_vec2(self) -> crate::math::Vec2 {
        crate::math::Vec2::new(self.x, self.y)
    }
}

/// `WIDTH` rotations of the plane.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LaneRot<L> {
    pub(crate) c: L,
    pub(crate) s: L,
}

impl<L: Lane> LaneRot<L> {
    /// `yes` where the mask holds, `no` elsewhere.
    #[inline(always)]
    pub(crate) fn select(mask: L::Mask, yes: Self, no: Self) -> Self {
        Self { c: L::select(mask, yes.c, no.c), s: L::select(mask, yes.s, no.s) }
    }

    /// How far the rotation carries the tip of `r`: R r - r. Exactly zero for the rotation by 0, however
    /// long `r` is.
    #[inline(always)]
    pub(crate) fn displacement(self, r: LaneVec2<L>) -> LaneVec2<L> {
        let c = self.c - L::splat(1.0);
        LaneVec2 { x: c * r.x - self.s * r.y, y: c * r.y + self.s * r.x }
    }

    /// The part of the [`displacement`](Self::displacement) along `direction`, from the lever arm r × d that others need
    /// too.
    #[inline(always)]
    pub(crate) fn displacement_along(self, r: LaneVec2<L>, direction: LaneVec2<L>) -> L {
        (self.c - L::splat(1.0)) * direction.dot(r) + self.s * r.cross(direction)
    }
}
