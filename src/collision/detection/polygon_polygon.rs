//! Convex polygon against convex polygon, by separating axes and clipping.
//!
//! Two convex outlines are apart exactly if a line along one of their edges is between them (the separating axis
//! theorem; S. Gottschalk, 1996). Where they overlap, the edge whose line comes nearest to that is the one to push
//! along: it is the reference face, and the other outline's edge that faces it most directly is clipped to it
//! (E. Catto, "Contact Manifolds", GDC 2007). Costs 2·n·m scalar products for outlines of n and m edges.
//!
//! Across a gap the lines only bound the distance from below. Where two corners are nearest, the distance and the
//! normal are those between the corners.

use crate::collision::Manifold;
use crate::collision::detection::clip::{Incident, Reference, Stretch, Tolerance, clip};
use crate::collision::detection::closest::Closest;
use crate::collision::detection::within;
use crate::math::{Rot, Vec2};
use crate::shape::Hull;

pub(super) fn detect(
    a: &Hull,
    rotation_a: Rot,
    b: &Hull,
    rotation_b: Rot,
    offset: Vec2,
    margin: f32,
) -> Option<Manifold> {
    let rotation = rotation_a.inverse() * rotation_b;
    let center = rotation_a.unrotate(offset);
    let face_a = best_face(a, b, rotation, center);
    if !within(face_a.separation, margin) {
        return None;
    }
    let face_b = best_face(b, a, rotation.inverse(), rotation.unrotate(-center));
    if !within(face_b.separation, margin) {
        return None;
    }
    let tolerance = Tolerance::new(a.inradius, b.inradius, center);
    if face_b.separation > face_a.separation + tolerance.preference {
        let pair = Pair { a: b, rotation_a: rotation_b, b: a, rotation_b: rotation_a, offset: -offset };
        pair.face_contact(face_b, tolerance, margin).map(|m| m.flipped())
    } else {
        let pair = Pair { a, rotation_a, b, rotation_b, offset };
        pair.face_contact(face_a, tolerance, margin)
    }
}

/// The manifold of b on a face of a, if an edge of it has a part over the face, not farther than `margin`, m: the edge that faces it,
/// or, if that lies over a neighbour, the nearest. There is none where b is behind the face: its centre, and all points.
pub(in crate::collision) fn on_face(
    a: &Hull,
    rotation_a: Rot,
    b: &Hull,
    rotation_b: Rot,
    offset: Vec2,
    face: usize,
    margin: f32,
) -> Option<Manifold> {
    let pair = Pair { a, rotation_a, b, rotation_b, offset };
    let normal = pair.in_b(a.normals[face]);
    let (facing, turn) = pair.common_stretch(face);
    let stretch = if facing.is_empty() {
        let edges = (0..b.normals().len()).filter(|&edge| b.normals[edge].dot(normal) < 0.0);
        let over_face =
            edges.map(|edge| pair.stretch_with(face, edge).0).filter(|stretch| !stretch.is_empty());
        over_face.min_by(|one, other| one.separation().total_cmp(&other.separation()))?
    } else {
        facing
    };
    let noise = Tolerance::new(a.inradius, b.inradius, offset).noise;
    let center_gap = a.normals[face].dot(rotation_a.unrotate(offset)) - a.planes[face];
    let found = stretch.manifold(rotation_a * turn, offset, noise, margin)?;
    // A part of a long line may be in front of the face, and its centre far off to the side, behind the plane.
    let is_in_front = center_gap > 0.0 || found.points().iter().any(|point| point.separation > 0.0);
    is_in_front.then_some(found)
}

/// An edge of a hull and how far the other hull is outside of its line.
#[derive(Clone, Copy)]
pub(super) struct Face {
    pub(super) index: usize,
    /// Least distance of the other hull's corners from the line, m; negative where one is behind it.
    pub(super) separation: f32,
}

/// The face of `a` that b stands out from furthest; b's frame is turned by `rotation` and centred at `center` in
/// a's.
#[inline(always)]
pub(super) fn best_face(a: &Hull, b: &Hull, rotation: Rot, center: Vec2) -> Face {
    let mut best = Face { index: 0, separation: f32::NEG_INFINITY };
    for (index, (normal, plane)) in a.normals().iter().zip(&a.planes).enumerate() {
        let normal_in_b = rotation.unrotate(*normal);
        let depth = b.vertices().iter().fold(f32::INFINITY, |least, v| {
            let reach = normal_in_b.dot(*v);
            if reach < least { reach } else { least }
        });
        let separation = (normal.dot(center) - plane) + depth;
        if separation > best.separation {
            best = Face { index, separation };
        }
    }
    best
}

/// Two hulls of which `a` has the reference face.
pub(super) struct Pair<'a> {
    pub(super) a: &'a Hull,
    pub(super) rotation_a: Rot,
    pub(super) b: &'a Hull,
    pub(super) rotation_b: Rot,
    pub(super) offset: Vec2,
}

impl Pair<'_> {
    #[inline(always)]
    fn face_contact(&self, face: Face, tolerance: Tolerance, margin: f32) -> Option<Manifold> {
        let (stretch, turn) = self.common_stretch(face.index);
        let Tolerance { noise, preference } = tolerance;
        if face.separation > noise && !stretch.is_nearest(face.separation, preference) {
            return self.corner_contact(noise, margin);
        }
        stretch.manifold(self.rotation_a * turn, self.offset, noise, margin)
    }

    /// The stretch that a face of a has in common with the edge of b that faces it, and the turn from the frame of the face into
    /// a's.
    #[inline(always)]
    pub(super) fn common_stretch(&self, face: usize) -> (Stretch, Rot) {
        self.stretch_with(face, facing(self.b, self.in_b(self.a.normals[face])))
    }

    /// A direction in a's frame, as it is in b's.
    fn in_b(&self, direction: Vec2) -> Vec2 {
        (self.rotation_a.inverse() * self.rotation_b).unrotate(direction)
    }

    /// The same with an edge of b.
    #[inline(always)]
    fn stretch_with(&self, face: usize, edge: usize) -> (Stretch, Rot) {
        let rotation = self.rotation_a.inverse() * self.rotation_b;
        let center = self.rotation_a.unrotate(self.offset);
        let normal = self.a.normals[face];
        // From the frame of the face into a's: the turn that brings x to the normal.
        let turn = Rot { c: normal.x, s: normal.y };
        let (i, next) = (face, self.a.next(face));
        let along = normal.perp();
        let reference = Reference {
            plane: self.a.planes[i],
            low: along.dot(self.a.vertices[i]),
            high: along.dot(self.a.vertices[next]),
            vertices: [i as u8, next as u8],
        };
        let next = self.b.next(edge);
        let (rotation, center) = (turn.inverse() * rotation, turn.unrotate(center));
        let incident = Incident {
            start: center + rotation.rotate(self.b.vertices[edge]),
            end: center + rotation.rotate(self.b.vertices[next]),
            vertices: [edge as u8, next as u8],
        };
        (clip(reference, incident), turn)
    }

    /// Whether the edge of b that faces a face of a is as good as parallel to it.
    pub(super) fn is_flat_on(&self, face: usize) -> bool {
        /// rad.
        const FLAT: f32 = 0.02;
        let rotation = self.rotation_a.inverse() * self.rotation_b;
        let normal = rotation.unrotate(self.a.normals[face]);
        normal.cross(self.b.normals[facing(self.b, normal)]).abs() < FLAT
    }

    /// The one point between the two nearest corners.
    #[cold]
    pub(super) fn corner_contact(&self, noise: f32, margin: f32) -> Option<Manifold> {
        let closest = self.closest(noise, margin)?;
        within(closest.distance, margin).then(|| closest.manifold(self.rotation_a, self.offset))
    }

    /// The nearest points of the two, if they are apart, and not farther than `margin`, m.
    pub(super) fn closest(&self, noise: f32, margin: f32) -> Option<Closest> {
        let rotation = self.rotation_a.inverse() * self.rotation_b;
        let center = self.rotation_a.unrotate(self.offset);
        Closest::find(self.a, self.b, rotation, center, noise, margin)
    }
}

/// The edge of a hull whose outward normal is the most opposed to `normal`, in the hull's frame.
#[inline(always)]
pub(super) fn facing(hull: &Hull, normal: Vec2) -> usize {
    let (mut best, mut least) = (0, f32::INFINITY);
    for (i, n) in hull.normals().iter().enumerate() {
        let cosine = n.dot(normal);
        if cosine < least {
            (best, least) = (i, cosine);
        }
    }
    best
}
