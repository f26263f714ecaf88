//! Pieces of ground beside a shape, as they are in its frame.

use crate::math::{Rot, Vec2};
use crate::shape::{Hull, Link};

/// Faces with this cosine between them or less may have a gap between them, no unit: the sides of two tiles that were placed by hand. Up to 3°
/// apart; at more, what is between them is a wedge, which is open as far as up to its tip.
const OPPOSITE: f32 = -0.9986;

/// A neighbour.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neighbour {
    pub(crate) slot: u32,
    pub(crate) hull: Hull,
    /// Whether it is a link of a chain, and solid on its left only.
    pub(crate) is_link: bool,
    /// Where it is as the step begins, and as it ends: it covers what it covers at both times. A paddle that brushes a wall leaves it open to
    /// what flies there.
    pub(crate) places: [Place; 2],
}

/// Where a neighbour is in the frame of the shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) rotation: Rot,
    /// Its centre, m.
    pub(crate) center: Vec2,
}

impl Neighbour {
    /// One that stays where it is.
    #[cfg(test)]
    pub(super) fn still(hull: Hull, place: Place) -> Self {
        Self { slot: 0, hull, is_link: false, places: [place; 2] }
    }

    /// Where it is at the times that differ.
    fn places(&self) -> &[Place] {
        let [begin, end] = &self.places;
        if begin == end { &self.places[..1] } else { &self.places }
    }

    /// Normal of a face and its distance from the centre of the shape, m, with the neighbour in a place.
    fn face(&self, index: usize, place: &Place) -> (Vec2, f32) {
        let normal = place.rotation.rotate(self.hull.normals[index]);
        (normal, self.hull.planes[index] + normal.dot(place.center))
    }

    /// From where to where it covers the face with a `normal` at a distance from the centre of the shape, m, counted along the face. A line has
    /// nothing behind its surface, and covers nothing.
    pub(super) fn covers(&self, normal: Vec2, distance: f32, gap: f32) -> Option<[f32; 2]> {
        if self.hull.is_segment() {
            return None;
        }
        let mut covered = [f32::NEG_INFINITY, f32::INFINITY];
        for place in self.places() {
            let [low, high] = self.covers_in(place, normal, distance, gap)?;
            covered = [covered[0].max(low), covered[1].min(high)];
        }
        (covered[0] < covered[1]).then_some(covered)
    }

    /// The same in one place.
    fn covers_in(&self, place: &Place, normal: Vec2, distance: f32, gap: f32) -> Option<[f32; 2]> {
        let along = normal.perp();
        // Just in front of the face: on it, what only adjoins it would cover it; farther out, so would the next face of a finely divided
        // curve.
        let distance = distance + 0.1 * gap;
        let (mut low, mut high) = (f32::NEG_INFINITY, f32::INFINITY);
        for index in 0..self.hull.normals().len() {
            let (face, plane) = self.face(index, place);
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
        (0..self.hull.normals().len()).filter_map(move |index| {
            let is_there = |of_self: &Place| {
                let (normal, plane) = self.face(index, of_self);
                let local = of_self.rotation.unrotate(place - of_self.center);
                let [start, end] = self.hull.ends_from(index, local);
                let [behind, ahead] = if side > 0.0 { [-start, end] } else { [end, -start] };
                (normal.dot(place) - plane).abs() <= reach && behind >= -reach && ahead >= reach
            };
            let is_solid = !self.is_link || index == Link::FACE;
            let normal = self.face(index, &self.places[0]).0;
            self.places().iter().all(is_there).then_some((normal, is_solid))
        })
    }
}
