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
//! A link of a chain knows its neighbours by itself. Its right side is covered, and at an open end the chain falls away.

use crate::math::{Rot, Vec2};
use crate::shape::{Hull, Link, MAX_VERTICES};

/// Neighbours are flush within this share of the width of the shape, no unit, but not more than [`LARGEST_GAP`]: less, and
/// tiles that were placed by hand are not flush; more, and a small step does not hold anything.
const GAP_OF_WIDTH: f32 = 1e-3;
/// At most so far apart are what is flush, m.
const LARGEST_GAP: f32 = 1e-3;

/// A body that is pressed against a block overlaps it by less than this share of the width of the floor, no unit: it still stands
/// on the floor.
const OVERLAP_OF_WIDTH: f32 = 0.05;

/// Directions that differ by less than this, rad, are the same: what lies flat on a face leans by less as it trembles.
const SAME_DIRECTION: f32 = 0.02;

/// The same where the normal has all its digits, as of a contact with a circle or of a round corner with a corner, rad.
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
    /// Only this face is, and neighbours that are flush with it, or rise, go on from there.
    Flush(usize),
    /// Only one of them is, and neighbours fall away from it: normals between these two, counter-clockwise, are allowed.
    Ridge([Vec2; 2]),
    /// Neither is.
    Covered,
}

/// What neighbours leave of an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Exposure {
    /// By face, m along it: from where its first exposed part begins to where the last ends, with what is covered between them;
    /// `None` where all of it is covered.
    faces: [Option<[f32; 2]>; MAX_VERTICES],
    corners: [Corner; MAX_VERTICES],
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

    /// From where to where it covers a line that runs `along` with a `normal`, at a distance from the centre of the shape, m.
    fn covers(&self, normal: Vec2, distance: f32, gap: f32) -> Option<[f32; 2]> {
        let along = normal.perp();
        // Just in front of the face, so that what lies beside it does not cover it; no farther, as what leans over it at a small
        // angle, as in a finely divided curve, would seem to cover more.
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
        (0..self.hull.normals().len()).filter_map(move |index| {
            let (normal, plane) = self.face(index);
            let local = self.rotation.unrotate(place - self.center);
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

    /// What some neighbours leave of an outline; `None` where they leave all of it.
    pub(crate) fn new(hull: &Hull, neighbours: &[Neighbour<'_>]) -> Option<Self> {
        let gap = LARGEST_GAP.min(GAP_OF_WIDTH * hull.thickness());
        let overlap = OVERLAP_OF_WIDTH * hull.thickness();
        let (faces, corners) = ([None; MAX_VERTICES], [Corner::Covered; MAX_VERTICES]);
        let mut exposure = Self { faces, corners, gap, overlap };
        let mut is_covered = false;
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

    /// What its neighbours leave of a link of a chain.
    pub(crate) fn of_link(hull: &Hull, link: Link) -> Self {
        let (mut faces, mut corners) = ([None; MAX_VERTICES], [Corner::Covered; MAX_VERTICES]);
        let [start, end] = ends(hull, Link::FACE);
        faces[Link::FACE] = Some([start, end]);
        let own = hull.normals[Link::FACE];
        let along = -own.perp();
        let [before, after] = link.left_of_neighbours();
        let side = |next: Vec2, is_after: bool| {
            let falls = if is_after { next.cross(own) } else { own.cross(next) };
            let turns_back = own.dot(next) < 0.0 && falls > -SAME_EXACT_DIRECTION;
            if falls <= SAME_EXACT_DIRECTION && !turns_back {
                Corner::Flush(Link::FACE)
            } else {
                Corner::Ridge(if is_after { [next, own] } else { [own, next] })
            }
        };
        corners[0] = side(before.unwrap_or(-along), false);
        corners[1] = side(after.unwrap_or(along), true);
        let overlap = LARGEST_GAP.min(GAP_OF_WIDTH * (end - start));
        Self { faces, corners, gap: 0.0, overlap }
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
            // Beyond the face that begins here, counter-clockwise, is what lies clockwise, and the other way round.
            (false, true) => (after, -1.0),
            (true, false) => (before, 1.0),
        };
        let (own, place) = (hull.normals[face], hull.vertices[corner]);
        let falls = |other: Vec2| {
            let turn = side * own.cross(other);
            turn > if own.dot(other) > 0.0 { SAME_DIRECTION } else { 0.0 }
        };
        // Pieces meet at corners of the outline with faces that others cover, which are no surface.
        let itself = Neighbour { hull, rotation: Rot::IDENTITY, center: Vec2::ZERO };
        let is_exposed = |other: Vec2| {
            let mut pieces = neighbours.iter().chain([&itself]);
            !pieces.any(|piece| piece.covers_beyond(place, other, side * reach, self.gap))
        };
        let beyond = neighbours.iter().flat_map(|neighbour| neighbour.faces_from(place, side, reach));
        // Of the surfaces that go on from here, the one that falls away least is the next.
        let next = beyond
            .filter(|&other| falls(other) && is_exposed(other))
            .max_by(|one, other| own.dot(*one).total_cmp(&own.dot(*other)));
        match next {
            None => Corner::Flush(face),
            Some(next) => Corner::Ridge(if side < 0.0 { [next, own] } else { [own, next] }),
        }
    }

    /// Whether a contact with the outline counts that has this normal, out of it, at places, m, all in the frame of the shape. The
    /// normal of a contact with a circle, or of a round corner with a corner, is exact.
    pub(crate) fn allows(
        &self,
        hull: &Hull,
        normal: Vec2,
        places: impl Iterator<Item = Vec2>,
        is_round: bool,
    ) -> bool {
        let (face, cosine) = most_along(hull, normal);
        let least = if is_round { SAME_EXACT_DIRECTION } else { SAME_DIRECTION };
        if cosine > 1.0 - 0.5 * least * least {
            let along = hull.normals[face].perp();
            let (low, high) = places
                .map(|place| along.dot(place))
                .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
            return self.faces[face].is_some_and(|exposed| {
                low <= exposed[1] + self.overlap && high >= exposed[0] - self.overlap
            });
        }
        let corner = farthest_corner(hull, normal);
        let [first, second] = match self.corners[corner] {
            Corner::Open => [hull.previous(corner), corner].map(|face| hull.normals[face]),
            Corner::Flush(face) => [hull.normals[face]; 2],
            Corner::Ridge(between) => between,
            Corner::Covered => return false,
        };
        first.cross(normal) >= -least && normal.cross(second) >= -least
    }

    /// The face whose plane goes on beyond the corner that a contact with a normal is at, over neighbours that do not fall away
    /// from it; `None` where there is none, and for a contact on another face.
    pub(crate) fn face_beyond(&self, hull: &Hull, normal: Vec2) -> Option<usize> {
        match self.corners[farthest_corner(hull, normal)] {
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
        [face, hull.next(face)]
            .map(|corner| matches!(self.corners[corner], Corner::Flush(_) | Corner::Covered))
    }

    /// Whether a place, m, behind a face is in the shape, or not farther from it than neighbours are. Behind a line is all that it
    /// has.
    pub(crate) fn holds(&self, hull: &Hull, place: Vec2) -> bool {
        hull.is_segment() || hull.nearest_face(place).0 <= self.gap
    }

    /// Whether a part of a face is exposed.
    pub(crate) fn is_exposed(&self, face: usize) -> bool {
        self.faces[face].is_some()
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
mod tests {
    use super::*;

    fn beside(hull: &Hull, center: [f32; 2]) -> Neighbour<'_> {
        Neighbour { hull, rotation: Rot::IDENTITY, center: center.into() }
    }

    /// Whether a contact at a place counts, with a normal at an angle from upwards to the left, rad.
    fn allows(exposure: &Exposure, hull: &Hull, angle: f32, place: [f32; 2]) -> bool {
        let Rot { c, s } = Rot::from_angle(angle);
        exposure.allows(hull, Vec2::new(-s, c), [place.into()].into_iter(), false)
    }

    const LEFT: f32 = core::f32::consts::FRAC_PI_2;

    #[test]
    fn between_tiles_nothing_can_be_touched_and_on_top_only_from_above() {
        let tile = Hull::rectangle(Vec2::new(0.5, 0.5));
        assert_eq!(Exposure::new(&tile, &[]), None);
        assert_eq!(Exposure::new(&tile, &[beside(&tile, [-1.1, 0.0])]), None, "a gap of 10 cm");
        let middle = Exposure::new(&tile, &[beside(&tile, [-1.0, 0.0]), beside(&tile, [1.0, 0.0])]).unwrap();
        assert_eq!([0, 1, 2, 3].map(|face| middle.is_exposed(face)), [true, false, true, false]);
        assert!(!allows(&middle, &tile, LEFT, [-0.5, 0.49]), "the side");
        assert!(allows(&middle, &tile, 0.0, [-0.5, 0.5]) && allows(&middle, &tile, 0.01, [-0.5, 0.5]));
        assert!(!allows(&middle, &tile, 0.3, [-0.5, 0.5]) && !allows(&middle, &tile, -0.3, [0.5, 0.5]));
        let end = Exposure::new(&tile, &[beside(&tile, [1.0, 0.0])]).unwrap();
        assert!(allows(&end, &tile, LEFT, [-0.5, 0.49]) && allows(&end, &tile, 0.7, [-0.5, 0.5]));
        assert!(!allows(&end, &tile, -LEFT, [0.5, 0.49]));
    }

    /// Its bevels are shorter than tiles may be apart.
    #[test]
    fn a_shape_without_neighbours_is_exposed_however_short_its_faces_are() {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-0.9996, 1.0], [-1.0, 0.9996]];
        let hull = Hull::new(&corners.map(Vec2::from));
        assert_eq!(Exposure::new(&hull, &[]), None);
    }

    #[test]
    fn a_step_of_a_centimetre_has_a_side_and_one_of_less_than_a_gap_has_none() {
        let tile = Hull::rectangle(Vec2::new(0.5, 0.5));
        let above = |step: f32| Exposure::new(&tile, &[beside(&tile, [-1.0, -step])]).unwrap();
        assert!(allows(&above(0.01), &tile, LEFT, [-0.5, 0.495]));
        assert!(allows(&above(0.01), &tile, 0.7, [-0.5, 0.5]), "and a corner");
        assert!(!allows(&above(0.01), &tile, LEFT, [-0.5, 0.3]), "but not below the step");
        assert!(!allows(&above(0.0005), &tile, LEFT, [-0.5, 0.4999]));
        // Where the neighbour stands higher, there is no corner to meet.
        assert!(!allows(&above(-0.01), &tile, 0.7, [-0.5, 0.5]));
    }

    /// A floor under a block bears up to the block, however far that is overlapped there: both sides of it are exposed.
    #[test]
    fn the_floor_beside_a_block_bears_up_to_the_block() {
        let (floor, block) = (Hull::rectangle(Vec2::new(10.0, 0.5)), Hull::rectangle(Vec2::new(1.0, 1.0)));
        assert_eq!(Exposure::new(&floor, &[beside(&block, [3.0, 1.5])]), None);
        let at_end = Exposure::new(&floor, &[beside(&block, [9.0, 1.5])]).unwrap();
        for (at, bears) in [(-9.0, true), (7.9, true), (8.0005, true), (8.5, false)] {
            assert_eq!(allows(&at_end, &floor, 0.0, [at, 0.5]), bears, "at {at} m");
        }
        let of_block = Exposure::new(&block, &[beside(&floor, [-3.0, -1.5])]).unwrap();
        assert!(!allows(&of_block, &block, core::f32::consts::PI, [0.0, -1.0]), "below it is the floor");
        assert!(allows(&of_block, &block, LEFT, [-1.0, -0.999]));
    }

    /// An outline of two pieces, whose common face ends at an outer corner: the corner is met as that of the whole outline, also
    /// where the outline turns by a right angle or more.
    #[test]
    fn a_corner_that_two_pieces_share_is_that_of_the_outline() {
        // The corner is the origin. One edge goes up; the other comes from the right, and turns with the angle.
        for turn in [0.3, 1.2, LEFT, 2.2, 2.8] {
            let ray = |angle: f32, length: f32| Rot::from_angle(angle).rotate(Vec2::new(length, 0.0));
            let interior = core::f32::consts::PI - turn;
            let inner = ray(LEFT - 0.5 * interior, 1.0);
            let left = Hull::new(&[Vec2::ZERO, inner, ray(LEFT, 1.0)]);
            let right = Hull::new(&[Vec2::ZERO, ray(LEFT - interior, 1.0), inner]);
            let exposure = Exposure::new(&left, &[beside(&right, [0.0, 0.0])]).unwrap();
            // Outwards of the upright edge is to the left; from there the normals turn counter-clockwise.
            for (share, counts) in [(0.1, true), (0.5, true), (0.9, true), (1.2, false), (1.5, false)] {
                let angle = LEFT + share * turn;
                assert_eq!(allows(&exposure, &left, angle, [0.0, 0.0]), counts, "{turn}: {share}");
            }
        }
    }

    /// A flat edge of pieces that meet in a point of it, with faces that go down from there at all angles.
    #[test]
    fn covered_faces_make_no_ridge_of_a_flat() {
        let ray = |angle: f32| Rot::from_angle(angle).rotate(Vec2::new(1.0, 0.0));
        let angles = [LEFT, 1.3 * LEFT, 1.8 * LEFT, 2.2 * LEFT, 2.6 * LEFT, 3.0 * LEFT];
        let pieces: Vec<Hull> = angles
            .windows(2)
            .map(|pair| Hull::new(&[Vec2::ZERO, ray(pair[0] + LEFT), ray(pair[1] + LEFT)]))
            .collect();
        for (index, piece) in pieces.iter().enumerate() {
            let others: Vec<Neighbour<'_>> = (0..pieces.len())
                .filter(|&other| other != index)
                .map(|other| beside(&pieces[other], [0.0, 0.0]))
                .collect();
            let exposure = Exposure::new(piece, &others).unwrap();
            for angle in [-1.0, -0.3, 0.3, 1.0] {
                // The ends of the flat are corners, and may be met as such.
                if index == 0 && angle > 0.0 || index + 1 == pieces.len() && angle < 0.0 {
                    continue;
                }
                assert!(!allows(&exposure, piece, angle, [0.0, 0.0]), "piece {index} at {angle}");
            }
        }
    }

    /// Where a slope falls away from a flat, the ridge may be met from between the two.
    #[test]
    fn a_ridge_is_met_from_between_its_slopes() {
        let flat = Hull::rectangle(Vec2::new(2.0, 0.5));
        let slope = Rot::from_angle(0.5);
        // The upper right corner of the slope is the upper left one of the flat.
        let center = Vec2::new(-2.0, 0.5) - slope.rotate(Vec2::new(2.0, 0.5));
        let neighbour = Neighbour { hull: &flat, rotation: slope, center };
        let exposure = Exposure::new(&flat, &[neighbour]).unwrap();
        for (angle, counts) in [(0.0, true), (0.25, true), (0.5, true), (0.6, false), (LEFT, false)] {
            assert_eq!(allows(&exposure, &flat, angle, [-2.0, 0.5]), counts, "{angle} rad");
        }
    }
}
