//! Which parts of an outline its neighbours cover: where two tiles lie side by side, nothing can touch the faces between them.
//!
//! A contact with a covered face is a ghost. A box that slides over two tiles overlaps both a little, and taken for itself the
//! second one has a side to run into. Taken together they have none: the ground is the union of its pieces, and a contact
//! counts only if its normal is one of the union.
//!
//! - On a face it is, where a part of the face is exposed: no neighbour lies in front of it.
//! - At a corner it is, between the normals of the two faces that meet there, as far as these are exposed there. Where one is
//!   covered, the surface goes on along the neighbour's, and so does what is allowed, if that falls away.
//!
//! Lines are ground as well, but have no thickness to cover with: see `line`.

mod line;

use crate::math::{Rot, Vec2};
use crate::shape::exposure::line::Joined;
pub(crate) use crate::shape::exposure::line::Line;
use crate::shape::{Hull, MAX_VERTICES};

/// Neighbours are flush within this share of the width of the shape, no unit, but not more than [`LARGEST_GAP`]: less, and
/// tiles that were placed by hand are not flush; more, and a small step does not hold anything.
const GAP_OF_WIDTH: f32 = 1e-3;
/// At most so far apart are what is flush, m.
const LARGEST_GAP: f32 = 1e-3;

/// So far into what is covered of a face contacts still count, as a share of the width of the shape, no unit: a body that is pressed
/// against a block reaches a little past where the floor under it is exposed, and still stands on the floor.
const OVERLAP_OF_WIDTH: f32 = 0.05;

/// Directions that differ by less than this, rad, are the same: a box at rest that rocks a little tilts by less.
const SAME_DIRECTION: f32 = 0.02;

/// The same of normals that do not rock, rad: those of a contact with a circle, or of a round corner with a corner.
const SAME_EXACT_DIRECTION: f32 = 1e-3;

/// A neighbour, as it is in the frame of the shape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neighbour<'a> {
    pub(crate) hull: &'a Hull,
    pub(crate) rotation: Rot,
    /// Its centre, m.
    pub(crate) center: Vec2,
}

/// What neighbours leave of a corner.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Corner {
    /// Both faces that meet there are exposed.
    Open,
    /// Only this face is: what goes on from there is level with it or rises, and only its own normal is allowed.
    Flush(usize),
    /// Only one of them is, and neighbours fall away from it: normals between these two, counter-clockwise, are allowed.
    Ridge([Vec2; 2]),
    /// Neither is; of a line, both sides go on.
    Covered,
}

/// What neighbours leave of an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Exposure {
    /// By face, m along it: from where its first exposed part begins to where the last ends, with what is covered between them;
    /// `None` where all of it is covered.
    faces: [Option<[f32; 2]>; MAX_VERTICES],
    corners: [Corner; MAX_VERTICES],
    /// By corner, the line that goes on from there.
    joined: [Option<Joined>; MAX_VERTICES],
    /// Neighbours are flush within this distance, m.
    gap: f32,
    /// Contacts up to so far past what is exposed still count, m: the body is pressed into what covers the rest.
    overlap: f32,
}

impl Neighbour<'_> {
    /// Normal of a face and its distance from the centre of the shape, m.
    fn face(&self, index: usize) -> (Vec2, f32) {
        let normal = self.rotation.rotate(self.hull.normals[index]);
        (normal, self.hull.planes[index] + normal.dot(self.center))
    }

    /// From where to where it covers the face with a `normal` at a distance from the centre of the shape, m, counted along the face.
    fn covers(&self, normal: Vec2, distance: f32, gap: f32) -> Option<[f32; 2]> {
        let along = normal.perp();
        // Just in front of the face: on it, what only adjoins it would cover it; farther out, so would the next face of a finely divided
        // curve.
        let distance = distance + 0.1 * gap;
        let (mut low, mut high) = (f32::NEG_INFINITY, f32::INFINITY);
        for index in 0..self.hull.normals().len() {
            let (face, plane) = self.face(index);
            // Between the faces that are turned to each other there may be a gap.
            let room = if face.dot(normal) < -0.9 { gap } else { 0.0 };
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

    /// Whether it covers a line with this normal through a place, so far beyond it, m.
    fn covers_beyond(&self, place: Vec2, normal: Vec2, beyond: f32, gap: f32) -> bool {
        let at = normal.perp().dot(place) + beyond;
        self.covers(normal, normal.dot(place), gap).is_some_and(|[low, high]| low < at && at < high)
    }

    /// The normals of its faces that go on from a place, m, for at least `reach`, m: counter-clockwise around it where `side` is 1,
    /// clockwise where it is -1.
    fn faces_from(&self, place: Vec2, side: f32, reach: f32) -> impl Iterator<Item = Vec2> {
        let local = self.rotation.unrotate(place - self.center);
        (0..self.hull.normals().len()).filter_map(move |index| {
            let (normal, plane) = self.face(index);
            let [start, end] = self.hull.ends_from(index, local);
            let [behind, ahead] = if side > 0.0 { [-start, end] } else { [end, -start] };
            let is_there = (normal.dot(place) - plane).abs() <= reach && behind >= -reach && ahead >= reach;
            is_there.then_some(normal)
        })
    }
}

impl Exposure {
    /// Shapes that are farther apart than this, m, leave all of each other.
    pub(crate) const FARTHEST: f32 = 2.0 * LARGEST_GAP;

    /// What some neighbours leave of an outline, and lines; `None` where they leave all of it.
    pub(crate) fn new(hull: &Hull, neighbours: &[Neighbour<'_>], lines: &[Line<'_>]) -> Option<Self> {
        let gap = LARGEST_GAP.min(GAP_OF_WIDTH * hull.thickness());
        let overlap = OVERLAP_OF_WIDTH * hull.thickness();
        let (faces, corners) = ([None; MAX_VERTICES], [Corner::Covered; MAX_VERTICES]);
        let joined = Joined::at_corners(hull, lines, 2.0 * gap);
        let mut exposure = Self { faces, corners, joined, gap, overlap };
        let mut is_covered = joined.iter().any(Option::is_some);
        for face in 0..hull.normals().len() {
            let exposed = exposed_part(hull, face, neighbours, gap);
            is_covered |= exposed != Some(ends(hull, face));
            exposure.faces[face] = exposed;
        }
        if !is_covered {
            return None;
        }
        for corner in 0..hull.vertices().len() {
            exposure.corners[corner] = exposure.corner(hull, corner, neighbours);
        }
        Some(exposure)
    }

    /// What neighbours leave of a corner.
    fn corner(&self, hull: &Hull, corner: usize, neighbours: &[Neighbour<'_>]) -> Corner {
        let (before, after) = (hull.previous(corner), corner);
        let reach = 2.0 * self.gap;
        let [begins, ends_there] = [ends(hull, after)[0], ends(hull, before)[1]];
        let is_before_exposed = self.faces[before].is_some_and(|[_, high]| high >= ends_there - reach);
        let is_after_exposed = self.faces[after].is_some_and(|[low, _]| low <= begins + reach);
        let (face, side) = match (is_before_exposed, is_after_exposed) {
            (true, true) => return Corner::Open,
            (false, false) => return Corner::Covered,
            // From a face that begins here the surface goes on clockwise, -1, and from one that ends here counter-clockwise, 1.
            (false, true) => (after, -1.0),
            (true, false) => (before, 1.0),
        };
        let (own, place) = (hull.normals[face], hull.vertices[corner]);
        // A face of a neighbour that another piece covers is no part of the surface.
        let itself = Neighbour { hull, rotation: Rot::IDENTITY, center: Vec2::ZERO };
        let is_exposed = |other: Vec2| {
            let mut pieces = neighbours.iter().chain([&itself]);
            !pieces.any(|piece| piece.covers_beyond(place, other, side * reach, self.gap))
        };
        let beyond = neighbours.iter().flat_map(|neighbour| neighbour.faces_from(place, side, reach));
        // Of the surfaces that go on from here, the one that falls away the least is the next.
        let next = beyond.filter(|&other| falls(own, side, other) && is_exposed(other));
        match most_alike(own, next) {
            None => Corner::Flush(face),
            Some(next) => ridge(own, side, next),
        }
    }

    /// Whether a contact with another shape counts. Its normal points out of this one; its places, m, and the centre of the other shape, m, are
    /// in the frame of this one. The normal `is_exact` in a contact with a circle, or of a round corner with a corner.
    pub(crate) fn allows(
        &self,
        hull: &Hull,
        normal: Vec2,
        places: impl Iterator<Item = Vec2>,
        center: Vec2,
        is_exact: bool,
    ) -> bool {
        let (face, cosine) = most_along(hull, normal);
        let least = if is_exact { SAME_EXACT_DIRECTION } else { SAME_DIRECTION };
        if cosine > 1.0 - 0.5 * least * least {
            let along = hull.normals[face].perp();
            let (low, high) = places
                .map(|place| along.dot(place))
                .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
            return self.faces[face].is_some_and(|exposed| {
                low <= exposed[1] + self.overlap && high >= exposed[0] - self.overlap
            }) && !self.is_edge_at_line(hull, face, [low, high], center);
        }
        let corner = farthest_corner(hull, normal);
        let [first, second] = match self.corner_towards(hull, corner, center) {
            Corner::Open => [hull.previous(corner), corner].map(|face| hull.normals[face]),
            Corner::Flush(face) => [hull.normals[face]; 2],
            Corner::Ridge(between) => between,
            Corner::Covered => return false,
        };
        first.cross(normal) >= -least && normal.cross(second) >= -least
    }

    /// The face that goes on from the corner at which a contact with this normal is, with a shape around `center`, m, over neighbours that do
    /// not fall away from it. `None` where none does, and for a contact on the other face there.
    pub(crate) fn face_beyond(&self, hull: &Hull, normal: Vec2, center: Vec2) -> Option<usize> {
        match self.corner_towards(hull, farthest_corner(hull, normal), center) {
            Corner::Flush(face) if Self::face_of(hull, normal).is_none_or(|on| on == face) => Some(face),
            Corner::Flush(_) | Corner::Open | Corner::Ridge(_) | Corner::Covered => None,
        }
    }

    /// The face that a contact with a normal, out of the outline and in its frame, is on; `None` where it is at a corner.
    pub(crate) fn face_of(hull: &Hull, normal: Vec2) -> Option<usize> {
        let (face, cosine) = most_along(hull, normal);
        (cosine > 1.0 - 0.5 * SAME_EXACT_DIRECTION * SAME_EXACT_DIRECTION).then_some(face)
    }

    /// Whether the surface goes on beyond the start and the end of a face, along neighbours that do not fall away from it.
    pub(crate) fn goes_on(&self, hull: &Hull, face: usize) -> [bool; 2] {
        [face, hull.next(face)].map(|corner| {
            let goes_on = matches!(self.corners[corner], Corner::Flush(_) | Corner::Covered);
            goes_on || self.joined[corner].is_some_and(|line| line.corner(hull) == Corner::Flush(face))
        })
    }

    /// Whether a place, m, behind a face is in the shape, or not farther from it than what is flush. A line has no inside: any place is
    /// taken for one.
    pub(crate) fn holds(&self, hull: &Hull, place: Vec2) -> bool {
        hull.is_segment() || hull.nearest_face(place).0 <= self.gap
    }

    /// Whether a part of a face is exposed.
    pub(crate) fn is_exposed(&self, face: usize) -> bool {
        self.faces[face].is_some()
    }
}

/// Whether the surface with the `other` normal falls away from one with its `own`, from which it goes on counter-clockwise where `side` is 1,
/// clockwise where it is -1.
fn falls(own: Vec2, side: f32, other: Vec2) -> bool {
    side * own.cross(other) > if own.dot(other) > 0.0 { SAME_DIRECTION } else { 0.0 }
}

/// Of some normals the one that turns the least from a surface's `own`.
fn most_alike(own: Vec2, normals: impl Iterator<Item = Vec2>) -> Option<Vec2> {
    normals.max_by(|one, other| own.dot(*one).total_cmp(&own.dot(*other)))
}

/// The normals from that of a surface to the `next`, of what falls away from it on this `side`, in counter-clockwise order.
fn ridge(own: Vec2, side: f32, next: Vec2) -> Corner {
    Corner::Ridge(if side < 0.0 { [next, own] } else { [own, next] })
}

/// Where a face begins and ends, m along it.
fn ends(hull: &Hull, face: usize) -> [f32; 2] {
    let along = hull.normals[face].perp();
    [face, hull.next(face)].map(|corner| along.dot(hull.vertices[corner]))
}

/// The corner that is the farthest out in a direction.
fn farthest_corner(hull: &Hull, direction: Vec2) -> usize {
    let reaches = hull.vertices().iter().map(|&corner| direction.dot(corner)).enumerate();
    reaches.max_by(|(_, one), (_, other)| one.total_cmp(other)).map_or(0, |(corner, _)| corner)
}

/// The face whose normal is the most like a direction, and the cosine between them.
fn most_along(hull: &Hull, direction: Vec2) -> (usize, f32) {
    let cosines = hull.normals().iter().map(|normal| normal.dot(direction)).enumerate();
    cosines.max_by(|(_, one), (_, other)| one.total_cmp(other)).unwrap_or((0, 0.0))
}

/// From where the first exposed part of a face begins to where the last ends, m along it. What neighbours leave of it that is
/// shorter than a gap is none.
fn exposed_part(hull: &Hull, face: usize, neighbours: &[Neighbour<'_>], gap: f32) -> Option<[f32; 2]> {
    let [start, end] = ends(hull, face);
    let cover = |neighbour: &Neighbour<'_>| neighbour.covers(hull.normals[face], hull.planes[face], gap);
    let mut covered: Vec<[f32; 2]> = neighbours.iter().filter_map(cover).collect();
    if covered.is_empty() {
        return Some([start, end]);
    }
    covered.sort_unstable_by(|one, other| one[0].total_cmp(&other[0]));
    let (mut exposed, mut at): (Option<[f32; 2]>, f32) = (None, start);
    for [low, high] in covered.into_iter().chain([[end, end]]) {
        let until = low.min(end);
        if until - at > gap {
            exposed = Some([exposed.map_or(at, |[first, _]| first), until]);
        }
        at = at.max(high);
    }
    exposed
}

#[cfg(test)]
mod tests;
