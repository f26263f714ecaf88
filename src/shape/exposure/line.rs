//! Lines as ground: links of chains, and segments.
//!
//! A line has nothing behind its surface, and so covers nothing. But what comes along it goes over onto what is flush with its end: it
//! overlaps both a little, and is not to meet the side of a box there. So a corner of an outline knows the line that goes on
//! from it, and counts as joined for what is before the line: on the side of its surface. A body behind the line meets the side.
//!
//! A link of a chain knows its neighbours in the chain by itself. Its right side is covered, and where nothing goes on from an
//! open end, the chain falls away.

use crate::math::Vec2;
use crate::shape::exposure::{
    Corner, Exposure, GAP_OF_WIDTH, LARGEST_GAP, Neighbour, SAME_EXACT_DIRECTION, ends, falls, ridge,
};
use crate::shape::{Hull, Link, MAX_VERTICES};

/// A line beside a shape, as it is in the frame of the shape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line<'a> {
    pub(crate) at: Neighbour<'a>,
    /// Whether it is solid on its left only.
    pub(crate) is_link: bool,
}

/// A line that goes on from a face at a corner where it begins or ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Joined {
    face: usize,
    /// Normal of the line, on the side that goes on from the face.
    normal: Vec2,
    /// On which side of the face it goes on: 1 counter-clockwise, -1 clockwise.
    side: f32,
}

impl Line<'_> {
    /// The normals of its surfaces that go on from a place, as [`Neighbour::faces_from`] tells.
    fn faces_from(&self, place: Vec2, side: f32, reach: f32) -> impl Iterator<Item = Vec2> {
        let left = self.at.face(Link::FACE).0;
        let is_link = self.is_link;
        self.at.faces_from(place, side, reach).filter(move |normal| !is_link || normal.dot(left) > 0.0)
    }
}

impl Joined {
    /// By corner of an outline, the line that goes on from there. One that turns away by a right angle or more does not.
    pub(super) fn at_corners(hull: &Hull, lines: &[Line<'_>], reach: f32) -> [Option<Self>; MAX_VERTICES] {
        let mut joined = [None; MAX_VERTICES];
        if lines.is_empty() {
            return joined;
        }
        for (corner, joined) in joined.iter_mut().enumerate().take(hull.vertices().len()) {
            for (face, side) in [(corner, -1.0), (hull.previous(corner), 1.0)] {
                let own = hull.normals[face];
                let going_on =
                    lines.iter().flat_map(|line| line.faces_from(hull.vertices[corner], side, reach));
                let next = going_on
                    .filter(|normal| own.dot(*normal) > 0.0)
                    .max_by(|one, other| own.dot(*one).total_cmp(&own.dot(*other)));
                *joined = next.map(|normal| Self { face, normal, side }).or(*joined);
            }
        }
        joined
    }

    /// What is allowed at the corner.
    pub(super) fn corner(&self, hull: &Hull) -> Corner {
        let Self { face, normal, side } = *self;
        let own = hull.normals[face];
        if falls(own, side, normal) { ridge(own, side, normal) } else { Corner::Flush(face) }
    }
}

impl Exposure {
    /// The line that goes on from a corner, if a place, m, is before it.
    fn joined_towards(&self, hull: &Hull, corner: usize, place: Vec2) -> Option<Joined> {
        self.joined[corner].filter(|line| line.normal.dot(place - hull.vertices[corner]) > 0.0)
    }

    /// What is left of a corner for a contact with a shape around `center`, m.
    pub(super) fn corner_towards(&self, hull: &Hull, corner: usize, center: Vec2) -> Corner {
        let own = self.corners[corner];
        if hull.is_segment() && own == Corner::Covered {
            // Both sides go on.
            let is_left = hull.normals[Link::FACE].dot(center) > 0.0;
            return Corner::Flush(if is_left { Link::FACE } else { 1 - Link::FACE });
        }
        self.joined_towards(hull, corner, center).map_or(own, |line| line.corner(hull))
    }

    /// Whether a contact with a face, from one place along it to another, m, is with a shape that comes along a line from which it goes
    /// over onto another face: all of it is at the corner there.
    pub(super) fn is_behind_line(
        &self,
        hull: &Hull,
        face: usize,
        [low, high]: [f32; 2],
        center: Vec2,
    ) -> bool {
        let comes_along =
            |corner: usize| self.joined_towards(hull, corner, center).is_some_and(|line| line.face != face);
        let [start, end] = ends(hull, face);
        comes_along(face) && high < start + self.overlap
            || comes_along(hull.next(face)) && low > end - self.overlap
    }

    /// What its neighbours leave of a line: of a link of a chain, those in the chain too. `None` where they leave all of it.
    pub(crate) fn of_line(
        hull: &Hull,
        link: Option<Link>,
        neighbours: &[Neighbour<'_>],
        lines: &[Line<'_>],
    ) -> Option<Self> {
        let mut faces = [None; MAX_VERTICES];
        for (face, exposed) in faces.iter_mut().enumerate().take(hull.normals().len()) {
            let is_solid = link.is_none() || face == Link::FACE;
            *exposed = is_solid.then(|| ends(hull, face));
        }
        let [start, end] = ends(hull, Link::FACE);
        let gap = LARGEST_GAP.min(GAP_OF_WIDTH * (end - start));
        let in_chain = link.map_or([None; 2], |link| link.left_of_neighbours());
        let mut corners = [Corner::Covered; MAX_VERTICES];
        for (corner, in_chain) in in_chain.into_iter().enumerate() {
            corners[corner] = match (link, in_chain) {
                (Some(_), Some(next)) => end_of_link(hull, corner, next),
                (link, _) => end_beside(hull, corner, link.is_some(), neighbours, lines, 2.0 * gap),
            };
        }
        let leaves_all = link.is_none() && corners[..2] == [Corner::Open; 2];
        let exposure = Self { faces, corners, joined: [None; MAX_VERTICES], gap: 0.0, overlap: gap };
        (!leaves_all).then_some(exposure)
    }
}

/// The side on which what is beyond an end of a line lies for one of its faces, which begins or ends there.
fn side_of(corner: usize, face: usize) -> f32 {
    if face == corner { -1.0 } else { 1.0 }
}

/// What is left of the end of a link from which another with this normal goes on.
fn end_of_link(hull: &Hull, corner: usize, next: Vec2) -> Corner {
    let (own, side) = (hull.normals[Link::FACE], side_of(corner, Link::FACE));
    let turn = side * own.cross(next);
    let turns_back = own.dot(next) < 0.0 && turn > -SAME_EXACT_DIRECTION;
    if turn <= SAME_EXACT_DIRECTION && !turns_back {
        Corner::Flush(Link::FACE)
    } else {
        ridge(own, side, next)
    }
}

/// What is left of an open end of a line, beside other ground.
fn end_beside(
    hull: &Hull,
    corner: usize,
    is_link: bool,
    neighbours: &[Neighbour<'_>],
    lines: &[Line<'_>],
    reach: f32,
) -> Corner {
    let place = hull.vertices[corner];
    let gap = 0.5 * reach;
    let covers = |normal: Vec2, side: f32| {
        neighbours.iter().any(|piece| piece.covers_beyond(place, normal, side * reach, gap))
    };
    let (mut left, mut is_joined) = (Corner::Covered, false);
    for face in if is_link { Link::FACE..Link::FACE + 1 } else { 0..2 } {
        let (own, side) = (hull.normals[face], side_of(corner, face));
        let of_pieces = neighbours.iter().flat_map(|piece| piece.faces_from(place, side, reach));
        let of_pieces = of_pieces.filter(|&normal| !covers(normal, side));
        let of_lines = lines.iter().flat_map(|line| line.faces_from(place, side, reach));
        let next = of_pieces.chain(of_lines).max_by(|one, other| own.dot(*one).total_cmp(&own.dot(*other)));
        is_joined |= next.is_some() || covers(own, side);
        match next {
            Some(next) if falls(own, side, next) => left = ridge(own, side, next),
            Some(_) if is_link => left = Corner::Flush(face),
            None if is_link && covers(own, side) => left = Corner::Flush(face),
            _ => {}
        }
    }
    match (is_joined, is_link) {
        (true, _) => left,
        (false, false) => Corner::Open,
        (false, true) => {
            let (own, side) = (hull.normals[Link::FACE], side_of(corner, Link::FACE));
            ridge(own, side, own.perp() * side)
        }
    }
}
