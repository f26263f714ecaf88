//! Which parts of an outline its neighbours cover: where two tiles lie side by side, nothing can touch the faces between them.
//!
//! A contact with a covered face is a ghost. A box that slides over two tiles overlaps both a little, and taken for itself the
//! second one has a side to run into. Taken together they have none: the ground is the union of its pieces, and a contact
//! counts only if its normal is one of the union.
//!
//! - On a face it is, where a part of the face is exposed: no neighbour lies in front of it.
//! - At a corner it is, between the normals of the two surfaces that bound the room around it: see `sector`.
//!
//! Lines are ground as well. They have no thickness to cover with, but bound such room.

mod neighbour;
mod sector;

use crate::math::Vec2;
pub(crate) use crate::shape::exposure::neighbour::{Neighbour, Place};
use crate::shape::exposure::sector::{Beyond, Corner, Sector};
use crate::shape::{Hull, Link, MAX_VERTICES};

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

/// What neighbours leave of an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Exposure {
    /// By face, m along it: from where its first exposed part begins to where the last ends, with what is covered between them, and the overlap
    /// beyond; `None` where all of it is covered.
    faces: [Option<[f32; 2]>; MAX_VERTICES],
    /// By corner, of the face that begins there, and of the one that ends there.
    beyond: [[Beyond; 2]; MAX_VERTICES],
    /// Neighbours are flush within this distance, m.
    gap: f32,
    /// Within this distance of a corner, m, a contact with a face may be with the corner alone.
    overlap: f32,
}

impl Exposure {
    /// Shapes that are farther apart than this, m, leave all of each other.
    pub(crate) const FARTHEST: f32 = 2.0 * LARGEST_GAP;

    /// What some neighbours leave of an outline, those of a link in its chain included; `None` where they leave all of it.
    pub(crate) fn new(hull: &Hull, link: Option<Link>, neighbours: &[Neighbour]) -> Option<Self> {
        let width = if hull.is_segment() { 2.0 * hull.extent() } else { hull.thickness() };
        let gap = LARGEST_GAP.min(GAP_OF_WIDTH * width);
        let count = hull.vertices().len();
        let mut faces = [None; MAX_VERTICES];
        for (face, exposed) in faces.iter_mut().enumerate().take(count) {
            if link.is_none() || face == Link::FACE {
                *exposed = exposed_part(hull, face, neighbours, gap);
            }
        }
        let around = Around { hull, link, neighbours, faces: &faces, reach: 2.0 * gap };
        let mut beyond = [[Beyond::Covered; 2]; MAX_VERTICES];
        for (corner, ends) in beyond.iter_mut().enumerate().take(count) {
            *ends = [around.beyond(corner, corner, -1.0), around.beyond(corner, hull.previous(corner), 1.0)];
        }
        if beyond[..count].iter().all(|ends| *ends == [Beyond::OtherFace; 2])
            && (0..count).all(|face| faces[face] == Some(ends(hull, face)))
        {
            return None;
        }
        let overlap = OVERLAP_OF_WIDTH * width;
        // Not as far as up to what lies over a thin cover.
        let past = |covered: f32| if covered > gap { overlap.min(0.5 * covered) } else { overlap };
        for (face, exposed) in faces.iter_mut().enumerate().take(count) {
            let [start, end] = ends(hull, face);
            if let Some([low, high]) = exposed {
                *low -= past(*low - start);
                *high += past(end - *high);
            }
        }
        Some(Self { faces, beyond, gap, overlap })
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
            return self.faces[face].is_some_and(|exposed| low <= exposed[1] && high >= exposed[0])
                && !self.is_corner_alone(hull, face, [low, high], center);
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

    /// Whether a contact with a face, from one place along it to another, m, is with a corner alone, by a shape that is not in front of the
    /// face there.
    fn is_corner_alone(&self, hull: &Hull, face: usize, [low, high]: [f32; 2], center: Vec2) -> bool {
        let [start, end] = ends(hull, face);
        high < start + self.overlap && self.looks_elsewhere(hull, face, face, center)
            || low > end - self.overlap && self.looks_elsewhere(hull, face, hull.next(face), center)
    }

    /// Whether a place, m, behind a face is in the shape, or not farther from it than what is flush. A line has no inside: any place is
    /// taken for one.
    pub(crate) fn holds(&self, hull: &Hull, place: Vec2) -> bool {
        hull.is_segment() || hull.nearest_face(place).0 <= self.gap
    }

    /// Whether a place, m, is at a corner that neighbours leave alone.
    pub(crate) fn is_bare(&self, hull: &Hull, place: Vec2) -> bool {
        let is_there =
            |&corner: &usize| (hull.vertices[corner] - place).length_squared() <= self.overlap * self.overlap;
        let mut corners = (0..hull.vertices().len()).filter(is_there);
        corners.any(|corner| self.beyond[corner] == [Beyond::OtherFace; 2])
    }

    /// Whether a part of a face is exposed.
    pub(crate) fn is_exposed(&self, face: usize) -> bool {
        self.faces[face].is_some()
    }
}

/// A shape among others, to find what is beyond the ends of its faces.
struct Around<'a> {
    hull: &'a Hull,
    link: Option<Link>,
    neighbours: &'a [Neighbour],
    /// The exposed parts of the faces.
    faces: &'a [Option<[f32; 2]>; MAX_VERTICES],
    /// What is within this distance of a corner, m, is there.
    reach: f32,
}

impl Around<'_> {
    /// What bounds the sector around a corner in front of a face that ends there, with a `side` of 1, or begins, with -1.
    fn beyond(&self, corner: usize, face: usize, side: f32) -> Beyond {
        let Self { hull, link, .. } = *self;
        if !self.is_exposed_at(face, side) {
            return Beyond::Covered;
        }
        let (own, place) = (hull.normals[face], hull.vertices[corner]);
        let size = |next: Vec2| Sector { own, side, next }.size();
        let in_chain = link.and_then(|link| link.left_of_neighbours()[corner]);
        let surfaces = || {
            let of_pieces =
                self.neighbours.iter().flat_map(|piece| piece.faces_from(place, side, self.reach));
            of_pieces.chain(in_chain.map(|left| (left, true)))
        };
        let next = surfaces().filter(|&(_, is_solid)| is_solid).map(|(normal, _)| normal);
        let other = if face == corner { hull.previous(corner) } else { corner };
        let next = next.min_by(|one, another| size(*one).total_cmp(&size(*another)));
        let next = next.filter(|&next| link.is_some() || size(next) < size(hull.normals[other]));
        let Some(normal) = next else {
            return match link {
                // The chain falls away by a right angle.
                Some(_) => Beyond::Surface { normal: own.perp() * side, screen: None },
                None if self.is_exposed_at(other, -side) => Beyond::OtherFace,
                None => Beyond::Surface { normal: own, screen: None },
            };
        };
        let screens = surfaces().filter(|&(right, is_solid)| !is_solid && size(right) < size(normal));
        Beyond::Surface { normal, screen: screens.map(|(right, _)| -right).next() }
    }

    /// Whether a face is exposed at its end, with a `side` of 1, or where it begins, with -1.
    fn is_exposed_at(&self, face: usize, side: f32) -> bool {
        let [start, end] = ends(self.hull, face);
        self.faces[face].is_some_and(|[low, high]| {
            if side > 0.0 { high >= end - self.reach } else { low <= start + self.reach }
        })
    }
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
fn exposed_part(hull: &Hull, face: usize, neighbours: &[Neighbour], gap: f32) -> Option<[f32; 2]> {
    let [start, end] = ends(hull, face);
    let cover = |neighbour: &Neighbour| neighbour.covers(hull.normals[face], hull.planes[face], gap);
    if !neighbours.iter().filter_map(cover).any(|[low, high]| low < end && high > start) {
        return Some([start, end]);
    }
    let (mut exposed, mut at): (Option<[f32; 2]>, f32) = (None, start);
    while at < end {
        let ahead = neighbours.iter().filter_map(cover).filter(|&[_, high]| high > at);
        let [low, high] = ahead.min_by(|one, other| one[0].total_cmp(&other[0])).unwrap_or([end; 2]);
        let until = low.min(end);
        if until - at > gap {
            exposed = Some([exposed.map_or(at, |[first, _]| first), until]);
        }
        at = high;
    }
    exposed
}

#[cfg(test)]
mod tests;
