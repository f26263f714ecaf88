//! Box against box: the commonest pair of all, in stacks and walls.
//!
//! The same contact as [`polygon_polygon`](super::polygon_polygon) gives, but the separating axes come from the
//! half sizes and |cos|, |sin| of the angle between the boxes (S. Gottschalk, 1996): 4 axes with 2 products each
//! instead of 32 scalar products.

use crate::collision::Manifold;
use crate::collision::detection::clip::{Edge, Tolerance, clip};
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
    let separation_a = gap_a.x.max(gap_a.y);
    let separation_b = gap_b.x.max(gap_b.y);
    if !within(separation_a.max(separation_b), margin) {
        return None;
    }
    let tolerance = Tolerance::new(half_a.x.min(half_a.y), half_b.x.min(half_b.y), b_in_a);
    if separation_b > separation_a + tolerance.preference {
        let face = side_toward(a_in_b, gap_b.x > gap_b.y);
        let pair = BoxPair { a: b, rotation_a: rotation_b, b: a, rotation_b: rotation_a, offset: -offset };
        pair.face_contact(face, rotation.inverse(), a_in_b, separation_b, tolerance, margin)
            .map(|m| m.flipped())
    } else {
        let face = side_toward(b_in_a, gap_a.x > gap_a.y);
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
        let half = self.a.half_size();
        let normal = NORMALS[face];
        let plane = if face & 1 == 1 { half.x } else { half.y };
        // b's side that looks back along the normal.
        let back = rotation.unrotate(-normal);
        let incident = edge(self.b.half_size(), side_toward(back, back.x.abs() > back.y.abs()));
        let stretch = clip(edge(half, face), normal, plane, incident.placed(rotation, center));
        if separation > tolerance.noise && !stretch.is_nearest(separation, tolerance.preference) {
            let (a, b) = (self.a.hull(), self.b.hull());
            let (rotation_a, rotation_b, offset) = (self.rotation_a, self.rotation_b, self.offset);
            let pair = Pair { a, rotation_a, b, rotation_b, offset };
            return pair.corner_contact(tolerance.noise, margin);
        }
        stretch.manifold(normal, self.rotation_a, self.offset, tolerance.noise, margin)
    }
}

/// Outward normals of the sides: bottom, right, top, left.
const NORMALS: [Vec2; 4] =
    [Vec2::new(0.0, -1.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0), Vec2::new(-1.0, 0.0)];

/// The corners as signs of the half sizes, from the lower left one on.
const CORNERS: [Vec2; 4] =
    [Vec2::new(-1.0, -1.0), Vec2::new(1.0, -1.0), Vec2::new(1.0, 1.0), Vec2::new(-1.0, 1.0)];

/// The side that looks along `direction`, of the two across x or of the two across y.
#[inline(always)]
fn side_toward(direction: Vec2, across_x: bool) -> usize {
    if across_x {
        if direction.x < 0.0 { 3 } else { 1 }
    } else if direction.y < 0.0 {
        0
    } else {
        2
    }
}

#[inline(always)]
fn edge(half: Vec2, side: usize) -> Edge {
    let next = (side + 1) & 3;
    let corner = |i: usize| Vec2::new(CORNERS[i].x * half.x, CORNERS[i].y * half.y);
    Edge { start: corner(side), end: corner(next), first: side as u8, second: next as u8 }
}
