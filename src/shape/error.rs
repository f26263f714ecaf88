//! Why a shape is refused.

use core::fmt;

use crate::shape::{MAX_OUTLINE_POINTS, MAX_SIZE, MAX_VERTICES, MIN_SIZE};

/// An outline or one of its holes.
///
/// ```
/// use rustycs::shape::{Ring, Shape, ShapeError};
///
/// let plate = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
/// let holes = [vec![[1.0, 1.0], [2.0, 1.0], [1.0, 2.0]], vec![[3.0, 3.0], [3.5, 3.0]]];
/// let error = Shape::with_holes(plate, holes).unwrap_err();
/// assert_eq!(error, ShapeError::OutlineTooShort { ring: Ring::Hole(1), count: 2 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ring {
    /// The outline.
    Outline,
    /// The hole with this place in the list of holes, from 0.
    Hole(usize),
}

/// A point of an outline or of a hole, or the edge from there to the next point.
///
/// ```
/// use rustycs::shape::{Ring, RingPlace, Shape, ShapeError};
///
/// // Drawn by hand: the line crosses itself.
/// let drawn = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
/// let Err(ShapeError::OutlineCrosses { edges }) = Shape::concave(drawn) else { panic!() };
/// let edge = |index| RingPlace { ring: Ring::Outline, index };
/// assert_eq!(edges, [edge(0), edge(2)]); // mark these two in the editor
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RingPlace {
    /// Of which outline or hole.
    pub ring: Ring,
    /// Its place in the list of points, from 0.
    pub index: usize,
}

impl fmt::Display for Ring {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Outline => write!(f, "the outline"),
            Self::Hole(index) => write!(f, "hole {index}"),
        }
    }
}

/// Why a shape is refused; its text says what to change.
///
/// ```
/// use rustycs::{Shape, ShapeError};
///
/// let arrow = [[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [1.0, 1.0]];
/// let error = Shape::polygon(arrow).unwrap_err();
/// assert_eq!(error, ShapeError::Concave { index: 3 });
/// assert!(error.to_string().starts_with("the polygon is not convex at point 3: list the points in order"));
/// assert!(Shape::concave(arrow).is_ok()); // as two convex pieces
/// ```
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShapeError {
    /// A length of the shape is not a number, or outside [`MIN_SIZE`] to [`MAX_SIZE`].
    Size {
        /// Which length: `"radius"`, `"width"`, `"height"`, `"capsule's length"`, `"segment's length"`, `"polygon's size"`,
        /// `"polygon's thickness"`, `"outline's size"` or `"size of a tile"`.
        what: &'static str,
        /// Its value, m.
        value: f32,
    },
    /// A point of a polygon has a coordinate that is NaN or infinite.
    NotFinite {
        /// Its place in the list, from 0.
        index: usize,
        /// Its coordinates, m.
        point: [f32; 2],
    },
    /// An end of a capsule or a segment has a coordinate that is NaN or infinite.
    EndNotFinite {
        /// Of which: `"capsule"` or `"segment"`.
        what: &'static str,
        /// Which end: 0 or 1.
        index: usize,
        /// Its coordinates, m.
        point: [f32; 2],
    },
    /// Fewer than three distinct points.
    TooFewPoints {
        /// How many distinct points there are.
        count: usize,
    },
    /// More corners than [`MAX_VERTICES`].
    TooManyPoints {
        /// How many corners there are, points that lie on a straight edge not counted; of more than 256 points, how many points
        /// there are, up to one more than [`MAX_OUTLINE_POINTS`].
        count: usize,
    },
    /// All points of a polygon lie on one line.
    Collinear,
    /// The outline turns the wrong way.
    Concave {
        /// At which point of the list, from 0.
        index: usize,
    },
    /// The outline crosses itself or winds round more than once.
    SelfIntersecting,
    /// A point of an outline or hole has a coordinate that is NaN or infinite.
    OutlineNotFinite {
        /// Which point.
        place: RingPlace,
        /// Its coordinates, m.
        point: [f32; 2],
    },
    /// An outline or a hole of fewer than three points.
    OutlineTooShort {
        /// Which of them.
        ring: Ring,
        /// How many points it has.
        count: usize,
    },
    /// An outline and its holes have more points than [`MAX_OUTLINE_POINTS`](crate::shape::MAX_OUTLINE_POINTS).
    OutlineTooLong {
        /// How many were read.
        count: usize,
    },
    /// Two points of an outline or of holes are one.
    OutlineRepeats {
        /// Which points.
        points: [RingPlace; 2],
    },
    /// Two edges of an outline or of holes cross or touch.
    OutlineCrosses {
        /// Which edges.
        edges: [RingPlace; 2],
    },
    /// What an outline or a hole goes round, or what holes leave of an outline, is too small for its size.
    OutlineTooSmall {
        /// Which of them.
        ring: Ring,
        /// Its area, m².
        area: f32,
    },
    /// A hole is not in the outline.
    HoleOutside {
        /// Its place in the list of holes, from 0.
        hole: usize,
    },
    /// A hole is in another.
    HoleInHole {
        /// Its place in the list of holes, from 0.
        hole: usize,
        /// That of the other.
        other: usize,
    },
    /// A point of a chain has a coordinate that is NaN or infinite.
    ChainNotFinite {
        /// Its place in the list, from 0.
        index: usize,
        /// Its coordinates, m.
        point: [f32; 2],
    },
    /// A chain of fewer than two points, or a ring of fewer than three.
    ChainTooShort {
        /// How many points it has.
        count: usize,
        /// How many it needs.
        least: usize,
    },
    /// All points of a ring lie on one line: it has no inside.
    RingOnALine,
    /// A link of a chain has a length outside [`MIN_SIZE`] to [`MAX_SIZE`]: 0 where two points that follow each other are one.
    ChainLink {
        /// The place of the point it begins at in the list, from 0.
        index: usize,
        /// Its length, m.
        length: f32,
    },
}

impl fmt::Display for ShapeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Size { what, value } => {
                write!(f, "the {what} is {value} m: choose a finite one from {MIN_SIZE} m to {MAX_SIZE} m")
            }
            Self::NotFinite { index, point: [x, y] } => {
                write!(f, "point {index} of the polygon is ({x}, {y}): give it finite coordinates")
            }
            Self::EndNotFinite { what, index, point: [x, y] } => {
                write!(f, "end {index} of the {what} is ({x}, {y}): give it finite coordinates")
            }
            Self::TooFewPoints { count } => {
                write!(f, "the polygon has {count} distinct points: give at least 3")
            }
            Self::TooManyPoints { count } => write!(
                f,
                "the polygon has {count} corners{}, more than {MAX_VERTICES}: use fewer, or Shape::concave, which makes several \
                 polygons of an outline",
                if count > MAX_OUTLINE_POINTS { " or more" } else { "" }
            ),
            Self::Collinear => {
                write!(f, "all points of the polygon lie on one line: move one of them off it")
            }
            Self::Concave { index } => write!(
                f,
                "the polygon is not convex at point {index}: list the points in order around the outline, or \
                 cut it into convex parts"
            ),
            Self::SelfIntersecting => write!(
                f,
                "the polygon's outline crosses itself: list the points in order around the outline, once"
            ),
            Self::ChainNotFinite { index, point: [x, y] } => {
                write!(f, "point {index} of the chain is ({x}, {y}): give it finite coordinates")
            }
            Self::ChainTooShort { count, least } => {
                write!(f, "the chain has {count} points: give at least {least}")
            }
            Self::RingOnALine => write!(
                f,
                "all points of the ring lie on one line: move one of them off it, or give them to Ground::chain"
            ),
            Self::ChainLink { index, length } => write!(
                f,
                "the link of the chain from point {index} to the next is {length} m long: choose one from {MIN_SIZE} m to \
                 {MAX_SIZE} m, and leave out points that repeat the one before"
            ),
            _ => self.say_of_outline(f),
        }
    }
}

impl ShapeError {
    /// What is wrong with a concave outline.
    fn say_of_outline(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::OutlineNotFinite { place: RingPlace { ring, index }, point: [x, y] } => {
                write!(f, "point {index} of {ring} is ({x}, {y}): give it finite coordinates")
            }
            Self::OutlineTooShort { ring, count } => write!(f, "{ring} has {count} points: give at least 3"),
            Self::OutlineTooLong { count } => write!(
                f,
                "the outline and its holes have {count} points or more: use at most {MAX_OUTLINE_POINTS}"
            ),
            Self::OutlineRepeats { points: [one, other] } => write!(
                f,
                "point {} of {} is at the same place as point {} of {}: leave one of them out",
                other.index, other.ring, one.index, one.ring
            ),
            Self::OutlineCrosses { edges: [one, other] } => write!(
                f,
                "edge {} of {} crosses or touches edge {} of {} (an edge goes from the point of its number to the next): \
                 list the points in order around the area, once",
                one.index, one.ring, other.index, other.ring
            ),
            Self::OutlineTooSmall { ring, area } => write!(
                f,
                "the area of {ring} is {area} m², which is too little for its size: make it wider than 1e-5 of its length"
            ),
            Self::HoleOutside { hole } => {
                write!(f, "hole {hole} is not in the outline: move it in, or leave it out")
            }
            Self::HoleInHole { hole, other } => {
                write!(f, "hole {hole} is in hole {other}: leave one of them out")
            }
            _ => Ok(()),
        }
    }
}

impl core::error::Error for ShapeError {}
