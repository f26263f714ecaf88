//! Box against box: the commonest pair of all, in stacks and walls.
//!
//! The same contact as [`polygon_polygon`](super::polygon_polygon) gives, but the separating axes come from the
//! half sizes and |cos|, |sin| of the angle between the boxes (S. Gottschalk, 1996): 4 axes with 2 products each
//! instead of 32 scalar products. And every side of a box is its right side after some quarter turns, which are
//! exact: the contact is written once, for right sides.

use crate::collision::Manifold;
use crate::collision::detection::clip::{Incident, Reference, Tolerance, clip};
use crate::collision::detection::polygon_polygon::Pair;
use crate::collision::detection::within;
use crate::math::{Rot, Vec2};
use crate::shape::Rectangle;

#[inline]
pub(super) fn detect(
    a: &Rectangle,
    rotation_a: Rot,
    b: &Rectangle,
    rotation_b: Rot,
    offset: Vec2,
    margin: f32,
) -> Option<Manifold> {
    let (half_a, half_b) = (a.half_size(), b.half_size());
    let rotation = rotation_a.inverse() * rotation_b;
    let (c, s) = (rotation.c.abs(), rotation.s.abs());
    let b_in_a = rotation_a.unrotate(offset);
    let a_in_b = rotation_b.unrotate(-offset);
    let gap_a = (b_in_a.abs() - half_a) - Vec2::new(c * half_b.x + s * half_b.y, s * half_b.x + c * half_b.y);
    let gap_b = (a_in_b.abs() - half_b) - Vec2::new(c * half_a.x + s * half_a.y, s * half_a.x + c * half_a.y);
    let (across_a, across_b) = (gap_a.x > gap_a.y, gap_b.x > gap_b.y);
    let separation_a = if across_a { gap_a.x } else { gap_a.y };
    let separation_b = if across_b { gap_b.x } else { gap_b.y };
    if !(within(separation_a, margin) && within(separation_b, margin)) {
        return None;
    }
    // Across a corner the gaps along both axes add up. Spares most corners that are too far apart the search below.
    let apart_squared = |gap: Vec2| gap.max(Vec2::ZERO).length_squared();
    if apart_squared(gap_a).max(apart_squared(gap_b)) > margin * margin {
        return None;
    }
    let tolerance = Tolerance::new(half_a.x.min(half_a.y), half_b.x.min(half_b.y), b_in_a);
    if separation_b > separation_a + tolerance.preference {
        let face = side_toward(a_in_b, across_b);
        let pair = BoxPair { a: b, rotation_a: rotation_b, b: a, rotation_b: rotation_a, offset: -offset };
        pair.face_contact(face, rotation.inverse(), a_in_b, separation_b, tolerance, margin)
            .map(|m| m.flipped())
    } else {
        let face = side_toward(b_in_a, across_a);
        let pair = BoxPair { a, rotation_a, b, rotation_b, offset };
        pair.face_contact(face, rotation, b_in_a, separation_a, tolerance, margin)
    }
}

/// Two boxes of which `a` has the reference face.
struct BoxPair<'a> {
    a: &'a Rectangle,
    rotation_a: Rot,
    b: &'a Rectangle,
    rotation_b: Rot,
    offset: Vec2,
}

impl BoxPair<'_> {
    /// `rotation` and `center`: b's frame in a's.
    #[inline(always)]
    fn face_contact(
        &self,
        face: usize,
        rotation: Rot,
        center: Vec2,
        separation: f32,
        tolerance: Tolerance,
        margin: f32,
    ) -> Option<Manifold> {
        let a = RightSide::of(self.a, face);
        // From here on in the frame of the face: b's frame in it, and the side of b that looks back along x.
        let (rotation, center) = (a.turn.inverse() * rotation, a.turn.unrotate(center));
        let back = Vec2::new(-rotation.c, rotation.s);
        let b = RightSide::of(self.b, side_toward(back, back.x.abs() > back.y.abs()));
        let side = rotation * b.turn;
        let (outward, along) = (Vec2::new(side.c, side.s), Vec2::new(-side.s, side.c));
        let middle = center + outward * b.distance;
        let stretch = clip(
            Reference { plane: a.distance, low: -a.reach, high: a.reach, vertices: a.vertices },
            Incident { start: middle - along * b.reach, end: middle + along * b.reach, vertices: b.vertices },
        );
        let Tolerance { noise, preference } = tolerance;
        if separation > noise && !stretch.is_nearest(separation, preference) {
            let (a, b) = (self.a.hull(), self.b.hull());
            let (rotation_a, rotation_b, offset) = (self.rotation_a, self.rotation_b, self.offset);
            return Pair { a, rotation_a, b, rotation_b, offset }.corner_contact(noise, margin);
        }
        stretch.manifold(self.rotation_a * a.turn, self.offset, noise, margin)
    }
}

/// A side of a box as the right side of the box turned by some quarters.
#[derive(Clone, Copy)]
struct RightSide {
    /// The turn that brings the right side to where this side is.
    turn: Rot,
    /// Distance of the side from the centre, m.
    distance: f32,
    /// Half length of the side, m.
    reach: f32,
    /// Indices of its vertices, counter-clockwise.
    vertices: [u8; 2],
}

impl RightSide {
    /// Sides are counted as the edges of the hull: bottom, right, top, left.
    #[inline(always)]
    fn of(rectangle: &Rectangle, side: usize) -> Self {
        let half = rectangle.half_size();
        let (distance, reach) = if side & 1 == 1 { (half.x, half.y) } else { (half.y, half.x) };
        Self { turn: QUARTERS[side], distance, reach, vertices: [side as u8, (side as u8 + 1) & 3] }
    }
}

/// The turns of the right side to the bottom, right, top and left.
const QUARTERS: [Rot; 4] =
    [Rot { c: 0.0, s: -1.0 }, Rot { c: 1.0, s: 0.0 }, Rot { c: 0.0, s: 1.0 }, Rot { c: -1.0, s: 0.0 }];

/// The side that looks along `direction`, of the two across x (1 and 3) or of the two across y (2 and 0).
/// Without a branch: which side it is changes from box to box.
#[inline(always)]
fn side_toward(direction: Vec2, across_x: bool) -> usize {
    let (component, side) = if across_x { (direction.x, 1) } else { (direction.y, 2) };
    (side + 2 * usize::from(component < 0.0)) & 3
}
