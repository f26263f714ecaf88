//! Why a shape is refused.

use core::fmt;

use crate::shape::{MAX_SIZE, MAX_VERTICES, MIN_SIZE};

/// Why a shape is refused; its text says what to change.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShapeError {
    /// A length of the shape is not a number, or outside [`MIN_SIZE`] to [`MAX_SIZE`].
    Size {
        /// Which length: `"radius"`, `"width"`, `"height"`, `"polygon's size"` or `"polygon's thickness"`.
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
    /// Fewer than three distinct points.
    TooFewPoints {
        /// How many distinct points there are.
        count: usize,
    },
    /// More corners than [`MAX_VERTICES`].
    TooManyPoints {
        /// How many corners there are, points that lie on a straight edge not counted.
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
            Self::TooFewPoints { count } => {
                write!(f, "the polygon has {count} distinct points: give at least 3")
            }
            Self::TooManyPoints { count } => write!(
                f,
                "the polygon has {count} corners, more than {MAX_VERTICES}: use fewer, or several polygons"
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
        }
    }
}

impl core::error::Error for ShapeError {}
