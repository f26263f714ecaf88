//! Where a body is and how it is turned.

use crate::math::{Point, Rot, Vec2};

/// Position of a body's centre of mass and the body's rotation about it.
///
/// ```
/// use rustycs::prelude::*;
///
/// // A ship at (10, 5) m that points upward, and its gun 2 m ahead of its middle.
/// let ship = Pose::new([10.0, 5.0], std::f32::consts::FRAC_PI_2);
/// let muzzle = ship.to_world(Vec2::new(2.0, 0.0));
/// assert!(muzzle.distance([10.0, 7.0]) < 1e-6);
/// assert!(ship.to_local(muzzle).distance([2.0, 0.0]) < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Centre of mass, m.
    pub center: Point,
    /// Rotation from the body's frame into the world's.
    pub rotation: Rot,
}

impl Pose {
    /// The pose at `center`, m, turned by `angle`, rad, counter-clockwise.
    pub fn new(center: impl Into<Point>, angle: f32) -> Self {
        Self { center: center.into(), rotation: Rot::from_angle(angle) }
    }

    /// The pose at `center`, m, not turned.
    pub fn at(center: impl Into<Point>) -> Self {
        Self { center: center.into(), rotation: Rot::IDENTITY }
    }

    /// The pose on the way from this one (`t` = 0) to `other` (1): the centre in a straight line, the rotation the
    /// [shorter way](Rot::lerp).
    #[must_use]
    pub fn lerp(self, other: Self, t: f32) -> Self {
        Self { center: self.center.lerp(other.center, t), rotation: self.rotation.lerp(other.rotation, t) }
    }

    /// The world's place of a point of the body's frame (m from its centre).
    #[inline]
    pub fn to_world(self, local: Vec2) -> Point {
        self.center + self.rotation.rotate(local)
    }

    /// The point of the body's frame (m from its centre) that lies at a place of the world.
    #[inline]
    pub fn to_local(self, place: Point) -> Vec2 {
        self.rotation.unrotate(place - self.center)
    }
}
