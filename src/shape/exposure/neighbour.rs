//! Pieces of ground beside a shape, as they are in its frame.

use crate::math::{Rot, Vec2};
use crate::shape::{Hull, Link};

/// Faces with this cosine between them or less may have a gap between them, no unit: the sides of two tiles that were placed by hand. Up to 3°
/// apart; at more, what is between them is a wedge, which is open as far as up to its tip.
const OPPOSITE: f32 = -0.9986;

/// A neighbour, as it is in the frame of the shape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neighbour {
    pub(crate) slot: u32,
    pub(crate) hull: Hull,
    pub(crate) rotation: Rot,
    /// Its centre, m.
    pub(crate) center: Vec2,
    /// Whether it is a link of a chain, and solid on its left only.
    pub(crate) is_link: bool,
}

impl Neighbour {
    /// Normal of a face and its distance from the centre of the shape, m.
    fn face(&self, index: usize) -> (Vec2, f32) {
        let normal = self.rotation.rotate(self.hull.normals[index]);
        (normal, self.hull.planes[index] + normal.dot(self.center))
    }

    /// From where to where it covers the face with a `normal` at a distance from the centre of the shape, m, counted along the face. A line has
    /// nothing behind its surface, and covers nothing.
    pub(super) fn covers(&self, normal: Vec2, distance: f32, gap: f32) -> Option<[f32; 2]> {
        if self.hull.is_segment() {
            return None;
        }
        let along = normal.perp();
        // Just in front of the face: on it, what only adjoins it would cover it; farther out, so would the next face of a finely divided
        // curve.
        let distance = distance + 0.1 * gap;
        let (mut low, mut high) = (f32::NEG_INFINITY, f32::INFINITY);
        for index in 0..self.hull.normals().len() {
            let (face, plane) = self.face(index);
            let room = if face.dot(normal) < OPPOSITE { gap } else { 0.0 };
            let (slope, left) = (face.dot(along), plane + room - distance * face.dot(normal));
            if slope.abs() < 1e-6 {
                if left < 0.0 {
                    return None;
                }
            } else if slope > 0.0 {
                high = high.min(left / slope);
            } else {
                low = low.max(left / slope);
            }
        }
        (low < high).then_some([low, high])
    }

    /// The normals of its faces that go on from a place, m, for at least `reach`, m: counter-clockwise around it where `side` is 1,
    /// clockwise where it is -1. And whether they are solid: the right side of a link is not.
    pub(super) fn faces_from(
        &self,
        place: Vec2,
        side: f32,
        reach: f32,
    ) -> impl Iterator<Item = (Vec2, bool)> {
        let local = self.rotation.unrotate(place - self.center);
        (0..self.hull.normals().len()).filter_map(move |index| {
            let (normal, plane) = self.face(index);
            let [start, end] = self.hull.ends_from(index, local);
            let [behind, ahead] = if side > 0.0 { [-start, end] } else { [end, -start] };
            let is_there = (normal.dot(place) - plane).abs() <= reach && behind >= -reach && ahead >= reach;
            let is_solid = !self.is_link || index == Link::FACE;
            is_there.then_some((normal, is_solid))
        })
    }
}
