//! The one point at which a circle touches another shape.

use crate::collision::{FeatureId, Manifold, ManifoldPoint};
use crate::math::Vec2;

/// Where a circle and another shape touch, or are nearest to each other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch {
    /// Unit vector from a to b.
    pub(crate) normal: Vec2,
    /// The point from a's centre, m.
    pub(crate) anchor_a: Vec2,
    /// The same from b's centre, m.
    pub(crate) anchor_b: Vec2,
    /// Gap between the surfaces along the normal, m.
    pub(crate) separation: f32,
}

impl Touch {
    /// `anchor_a` from a's centre; b's centre is `offset` from a's.
    #[inline(always)]
    pub(in crate::collision) fn new(normal: Vec2, anchor_a: Vec2, offset: Vec2, separation: f32) -> Self {
        Self { normal, anchor_a, anchor_b: anchor_a - offset, separation }
    }

    /// The same with a and b exchanged.
    #[inline(always)]
    pub(super) fn flipped(self) -> Self {
        Self { normal: -self.normal, anchor_a: self.anchor_b, anchor_b: self.anchor_a, ..self }
    }

    /// That of a manifold with a circle, which has one point.
    pub(in crate::collision) fn of(manifold: &Manifold) -> Option<Self> {
        let &ManifoldPoint { anchor_a, anchor_b, separation, .. } = manifold.points().first()?;
        Some(Self { normal: manifold.normal, anchor_a, anchor_b, separation })
    }

    #[inline(always)]
    pub(in crate::collision) fn manifold(self) -> Manifold {
        let Self { normal, anchor_a, anchor_b, separation } = self;
        let feature = FeatureId::SINGLE;
        Manifold::of_one(
            normal,
            ManifoldPoint { anchor_a, anchor_b, separation, feature, ..ManifoldPoint::default() },
        )
    }
}
