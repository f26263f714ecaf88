//! What can touch a corner of an outline among others: the surfaces of all that meet there divide the room around it into sectors, and a
//! body that comes near is in one of them.
//!
//! Where the sector is less than half of the room, the corner is in its depth, and only the faces beside it are met. Where it is half,
//! the surface is level. Where it is more, the corner is an edge, and all normals between those of the two surfaces are allowed. A
//! corner that only looks into other sectors is not met at all: below two planks that lie flush there may be a wedge, but what slides
//! over them is not in it.
//!
//! So at each end of a face it is enough to know the next surface around the corner, which bounds the sector in front of the face.

use crate::math::Vec2;
use crate::shape::Hull;
use crate::shape::exposure::{Exposure, SAME_EXACT_DIRECTION};

/// What bounds the sector in front of a face around one of its ends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Beyond {
    /// There is none: a neighbour covers the face.
    #[default]
    Covered,
    /// The other face of the corner: there is nothing else.
    OtherFace,
    /// A surface of a neighbour.
    Surface {
        normal: Vec2,
        /// The left of a link of a chain that is between the two and solid to what is on that side alone.
        screen: Option<Vec2>,
    },
}

/// What is left of a corner for a body in one of its sectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Corner {
    /// Both faces that meet there.
    Open,
    /// The surface goes on level from this face, or rises: only its own normal is allowed.
    Flush(usize),
    /// The surface falls away: normals between these two, counter-clockwise, are allowed.
    Ridge([Vec2; 2]),
    /// Nothing.
    Covered,
}

/// How a surface goes on from another.
#[derive(Clone, Copy, PartialEq)]
enum Turn {
    Rises,
    Level,
    Falls,
}

/// A sector between two surfaces.
#[derive(Clone, Copy)]
pub(super) struct Sector {
    /// Normal of the one.
    pub(super) own: Vec2,
    /// On which side of that the other goes on: 1 counter-clockwise, -1 clockwise.
    pub(super) side: f32,
    /// Normal of the other.
    pub(super) next: Vec2,
}

impl Sector {
    fn turn(self) -> Turn {
        let sine = self.side * self.own.cross(self.next);
        let turns_back = self.own.dot(self.next) < 0.0 && sine > -SAME_EXACT_DIRECTION;
        if sine > SAME_EXACT_DIRECTION || turns_back {
            Turn::Falls
        } else if sine < -SAME_EXACT_DIRECTION {
            Turn::Rises
        } else {
            Turn::Level
        }
    }

    /// Grows with its angle, no unit.
    pub(super) fn size(self) -> f32 {
        let cosine = self.own.dot(self.next);
        if self.turn() == Turn::Rises { cosine - 1.0 } else { 1.0 - cosine }
    }

    /// Whether a direction from the corner leads into it.
    fn holds(self, direction: Vec2) -> bool {
        let [before_own, before_next] = [self.own, self.next].map(|normal| normal.dot(direction) > 0.0);
        if self.turn() == Turn::Rises { before_own && before_next } else { before_own || before_next }
    }
}

impl Exposure {
    /// The faces that meet at a corner, each with the side on which it goes on from there.
    fn faces_at(hull: &Hull, corner: usize) -> [(usize, f32); 2] {
        [(corner, -1.0), (hull.previous(corner), 1.0)]
    }

    /// What bounds the sector in front of a face around its end, with a `side` of 1, or where it begins, with -1.
    fn beyond(&self, hull: &Hull, face: usize, side: f32) -> Beyond {
        if side > 0.0 { self.beyond[hull.next(face)][1] } else { self.beyond[face][0] }
    }

    /// The sector between a face and a surface of a neighbour, if a shape around `center`, m, is in it.
    fn sector_towards(&self, hull: &Hull, (face, side): (usize, f32), center: Vec2) -> Option<Sector> {
        let Beyond::Surface { normal, screen } = self.beyond(hull, face, side) else { return None };
        let corner = if side > 0.0 { hull.next(face) } else { face };
        let direction = center - hull.vertices[corner];
        let sector = Sector { own: hull.normals[face], side, next: normal };
        let is_screened = screen.is_some_and(|left| left.dot(direction) > 0.0);
        (sector.holds(direction) && !is_screened).then_some(sector)
    }

    /// What is left of a corner for a contact with a shape around `center`, m.
    pub(super) fn corner_towards(&self, hull: &Hull, corner: usize, center: Vec2) -> Corner {
        let at = Self::faces_at(hull, corner);
        let found = at.iter().find_map(|&at| Some((at.0, self.sector_towards(hull, at, center)?)));
        match found {
            Some((face, sector)) => match sector.turn() {
                Turn::Rises | Turn::Level => Corner::Flush(face),
                Turn::Falls if sector.side < 0.0 => Corner::Ridge([sector.next, sector.own]),
                Turn::Falls => Corner::Ridge([sector.own, sector.next]),
            },
            None if self.beyond[corner].contains(&Beyond::OtherFace) => Corner::Open,
            None => Corner::Covered,
        }
    }

    /// Whether a face does not look into the sector around one of its corners in which a shape around `center`, m, is.
    pub(super) fn looks_elsewhere(&self, hull: &Hull, face: usize, corner: usize, center: Vec2) -> bool {
        let at = Self::faces_at(hull, corner);
        let is_within = |at: (usize, f32)| self.sector_towards(hull, at, center).is_some();
        at.into_iter().filter(|&(other, _)| other == face).any(|(_, side)| {
            match self.beyond(hull, face, side) {
                Beyond::Covered => false,
                Beyond::OtherFace => at.into_iter().any(is_within),
                Beyond::Surface { .. } => !is_within((face, side)),
            }
        })
    }

    /// Whether the surface goes on beyond the start and the end of a face, along neighbours that do not fall away from it.
    pub(crate) fn goes_on(&self, hull: &Hull, face: usize) -> [bool; 2] {
        [-1.0, 1.0].map(|side| match self.beyond(hull, face, side) {
            Beyond::Covered => true,
            Beyond::OtherFace => false,
            Beyond::Surface { normal, .. } => {
                Sector { own: hull.normals[face], side, next: normal }.turn() != Turn::Falls
            }
        })
    }
}
