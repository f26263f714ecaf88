//! Lines as ground: links of chains, and segments.
//!
//! A line has nothing behind its surface, and so covers nothing. But a body that slides off it onto a box that is flush overlaps both a
//! little, and is not to meet the side of the box. So a corner of an outline knows the line that goes on from it. To a body in front of
//! the line, on the side of its surface, line and outline are one there; a body behind the line meets the side.
//!
//! A link of a chain knows its neighbours in the chain by itself. Its right side is covered. An open end from which nothing goes on may be
//! touched, as the end of a wall.

use crate::math::Vec2;
use crate::shape::exposure::{
    Corner, Exposure, GAP_OF_WIDTH, LARGEST_GAP, Neighbour, SAME_EXACT_DIRECTION, ends, falls, most_alike,
    ridge,
};
use crate::shape::{Hull, Link, MAX_VERTICES};

/// A line beside a shape, as it is in the frame of the shape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line<'a> {
    pub(crate) piece: Neighbour<'a>,
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
        let left = self.piece.face(Link::FACE).0;
        let is_link = self.is_link;
        self.piece.faces_from(place, side, reach).filter(move |normal| !is_link || normal.dot(left) > 0.0)
    }
}

impl Joined {
    /// By corner of an outline, the line that goes on from there: of both faces that meet there, from the one that it turns from the least.
    /// One that turns away by a right angle or more does not.
    pub(super) fn at_corners(hull: &Hull, lines: &[Line<'_>], reach: f32) -> [Option<Self>; MAX_VERTICES] {
        let mut at_corners = [None; MAX_VERTICES];
        if lines.is_empty() {
            return at_corners;
        }
        for (corner, joined) in at_corners.iter_mut().enumerate().take(hull.vertices().len()) {
            let from_face = |(face, side): (usize, f32)| {
                let place = hull.vertices[corner];
                let going_on = lines.iter().flat_map(|line| line.faces_from(place, side, reach));
                most_alike(hull.normals[face], going_on).map(|normal| Self { face, normal, side })
            };
            let turn = |line: &Self| hull.normals[line.face].dot(line.normal);
            let from_both = [(corner, -1.0), (hull.previous(corner), 1.0)].into_iter().filter_map(from_face);
            let nearest = from_both.max_by(|one, other| turn(one).total_cmp(&turn(other)));
            *joined = nearest.filter(|line| turn(line) > 0.0);
        }
        at_corners
    }

    /// What is allowed at the corner.
    pub(super) fn corner(&self, hull: &Hull) -> Corner {
        let Self { face, normal, side } = *self;
        let own = hull.normals[face];
        if falls(own, side, normal) { ridge(own, side, normal) } else { Corner::Flush(face) }
    }
}

impl Exposure {
    /// The line that goes on from a corner, if a place, m, is in front of it.
    fn joined_towards(&self, hull: &Hull, corner: usize, place: Vec2) -> Option<Joined> {
        self.joined[corner].filter(|line| line.normal.dot(place - hull.vertices[corner]) > 0.0)
    }

    /// What is left of a corner for a contact with a shape around `center`, m.
    pub(super) fn corner_towards(&self, hull: &Hull, corner: usize, center: Vec2) -> Corner {
        let own = self.corners[corner];
        if hull.is_segment() && own == Corner::Covered {
            // Both sides of it go on.
            let is_left = hull.normals[Link::FACE].dot(center) > 0.0;
            return Corner::Flush(if is_left { Link::FACE } else { 1 - Link::FACE });
        }
        self.joined_towards(hull, corner, center).map_or(own, |line| line.corner(hull))
    }

    /// Whether a contact with a face, from one place along it to another, m, is only the edge of a shape that slides between the other
    /// face of a corner and the line that goes on from there: all of it is at that corner.
    pub(super) fn is_edge_at_line(
        &self,
        hull: &Hull,
        face: usize,
        [low, high]: [f32; 2],
        center: Vec2,
    ) -> bool {
        let slides_past =
            |corner: usize| self.joined_towards(hull, corner, center).is_some_and(|line| line.face != face);
        let [start, end] = ends(hull, face);
        slides_past(face) && high < start + self.overlap
            || slides_past(hull.next(face)) && low > end - self.overlap
    }

    /// What its neighbours leave of a line, those of a link in its chain included. `None` where they leave all of it.
    pub(crate) fn of_line(
        hull: &Hull,
        link: Option<Link>,
        neighbours: &[Neighbour<'_>],
        lines: &[Line<'_>],
    ) -> Option<Self> {
        let mut faces = [None; MAX_VERTICES];
        for (face, exposed) in faces.iter_mut().enumerate().take(hull.normals().len()) {
            let is_exposed = link.is_none() || face == Link::FACE;
            *exposed = is_exposed.then(|| ends(hull, face));
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
        let exposure = Self { faces, corners, joined: [None; MAX_VERTICES], gap, overlap: gap };
        (!leaves_all).then_some(exposure)
    }
}

/// -1 if a face of a line begins at one of its ends, as what goes on from there lies clockwise; 1 if it ends there.
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
    let covers = |normal: Vec2, side: f32| {
        neighbours.iter().any(|piece| piece.covers_beyond(place, normal, side * reach, 0.5 * reach))
    };
    // Unless what goes on falls away.
    let mut rest = if is_link { Corner::Flush(Link::FACE) } else { Corner::Covered };
    let mut goes_on = false;
    for face in if is_link { Link::FACE..Link::FACE + 1 } else { 0..2 } {
        let (own, side) = (hull.normals[face], side_of(corner, face));
        let of_pieces = neighbours.iter().flat_map(|piece| piece.faces_from(place, side, reach));
        let of_pieces = of_pieces.filter(|&normal| !covers(normal, side));
        let of_lines = lines.iter().flat_map(|line| line.faces_from(place, side, reach));
        let next = most_alike(own, of_pieces.chain(of_lines));
        goes_on |= next.is_some() || covers(own, side);
        if let Some(next) = next.filter(|&next| falls(own, side, next)) {
            rest = ridge(own, side, next);
        }
    }
    match (goes_on, is_link) {
        (true, _) => rest,
        (false, false) => Corner::Open,
        // The chain falls away by a right angle.
        (false, true) => {
            let (own, side) = (hull.normals[Link::FACE], side_of(corner, Link::FACE));
            ridge(own, side, own.perp() * side)
        }
    }
}
