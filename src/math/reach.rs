//! A box as it is computed with.

use crate::math::{Aabb, Vec2};

/// How far a box reaches to the left, down, right and up, m: its lower corner negated, and its upper one.
///
/// What is asked of two boxes is the same for all four sides then, so that a processor does it for all at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reach([f32; 4]);

impl Reach {
    /// Of a box no other meets: every comparison with it is false.
    pub(crate) const NOWHERE: Self = Self([f32::NAN; 4]);

    pub(crate) const fn aabb(self) -> Aabb {
        let [left, down, right, up] = self.0;
        Aabb::new(Vec2::new(-left, -down), Vec2::new(right, up))
    }

    /// Length of the outline, m.
    #[inline(always)]
    pub(crate) fn perimeter(self) -> f32 {
        let [left, down, right, up] = self.0;
        2.0 * ((left + right) + (down + up))
    }

    /// Of the smallest box that holds both.
    #[inline(always)]
    pub(crate) fn union(self, other: Self) -> Self {
        let farther = |a: f32, b: f32| if a > b { a } else { b };
        let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
        Self([farther(a, e), farther(b, f), farther(c, g), farther(d, h)])
    }

    /// Whether the other box lies within this one, borders included.
    #[inline(always)]
    #[expect(clippy::needless_bitwise_bool, reason = "branches are as hard to foresee as the answer")]
    pub(crate) fn contains(self, other: Self) -> bool {
        let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
        (a >= e) & (b >= f) & (c >= g) & (d >= h)
    }

    /// How far another box has to reach at least to meet this one.
    #[inline(always)]
    pub(crate) fn opposite(self) -> Opposite {
        let [left, down, right, up] = self.0;
        Opposite(Self([-right, -up, -left, -down]))
    }

    /// Whether the two share a point, borders included.
    #[inline(always)]
    pub(crate) fn meets(self, Opposite(least): Opposite) -> bool {
        self.contains(least)
    }

    /// Between the middles of two boxes, each axis added up; doubled, which does not matter for an order.
    #[inline(always)]
    pub(crate) fn distance(self, other: Self) -> f32 {
        let middle = |Self([left, down, right, up])| [right - left, up - down];
        let ([x, y], [other_x, other_y]) = (middle(self), middle(other));
        (x - other_x).abs() + (y - other_y).abs()
    }
}

impl From<Aabb> for Reach {
    #[inline(always)]
    fn from(aabb: Aabb) -> Self {
        Self([-aabb.min.x, -aabb.min.y, aabb.max.x, aabb.max.y])
    }
}

/// How far a box has to reach at least to meet another, m.
#[derive(Clone, Copy)]
pub(crate) struct Opposite(Reach);
