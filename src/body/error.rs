//! Why a body was refused.

use core::fmt;

use crate::body::BodyType;
use crate::shape::ShapeError;

/// Why a body, or a change to one, was refused. The world is as it was before.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// let ball = Body::dynamic(Shape::circle(0.5)).friction(-0.1);
/// let error = world.add(ball).unwrap_err();
/// assert!(matches!(error, BodyError::OutOfRange { quantity: "the friction", .. }));
/// assert_eq!(error.to_string(), "the friction is -0.1; give a finite number from 0 to 1e6");
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum BodyError {
    /// The shape cannot be simulated.
    Shape(ShapeError),
    /// The body was made of no piece at all.
    NoShape,
    /// The body was made of a map of tiles of which none is solid.
    NoSolidTile,
    /// A dynamic body has a segment, which has no mass.
    DynamicSegment,
    /// A quantity is NaN, infinite, or outside the range that the engine can compute with.
    OutOfRange {
        /// What was given.
        quantity: &'static str,
        /// The number given.
        value: f64,
        /// Smallest number allowed.
        min: f64,
        /// Largest number allowed.
        max: f64,
        /// Unit of the three numbers; empty for a number without one.
        unit: &'static str,
    },
    /// A body that is not kinematic was to be moved to a pose.
    NotKinematic {
        /// What it is.
        body_type: BodyType,
    },
}

impl fmt::Display for BodyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Shape(error) => write!(f, "the body's shape cannot be used: {error}"),
            Self::NoShape => write!(f, "the body has no shape: give it a piece at least"),
            Self::NoSolidTile => write!(
                f,
                "no tile of the map is solid: give it one at least, in rows of 1 tile or more, or use a TileMap, which may be empty"
            ),
            Self::DynamicSegment => write!(
                f,
                "a segment has no thickness and no mass: make the body fixed or kinematic, or give it a capsule in the place of \
                 the segment"
            ),
            Self::OutOfRange { quantity, value, min, max, unit } => {
                let [value, min, max] = [*value, *min, *max].map(Number);
                let space = if unit.is_empty() { "" } else { " " };
                write!(
                    f,
                    "{quantity} is {value}{space}{unit}; give a finite number from {min} to {max}{space}{unit}"
                )
            }
            Self::NotKinematic { body_type } => write!(
                f,
                "a body that is {body_type} cannot be moved to a pose; give it one by set_pose, or make it kinematic"
            ),
        }
    }
}

impl std::error::Error for BodyError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Shape(error) => Some(error),
            Self::NoShape
            | Self::NoSolidTile
            | Self::DynamicSegment
            | Self::OutOfRange { .. }
            | Self::NotKinematic { .. } => None,
        }
    }
}

impl From<ShapeError> for BodyError {
    fn from(error: ShapeError) -> Self {
        Self::Shape(error)
    }
}

/// A number in an error: as the caller wrote it, 0.1 and not the 0.10000000149 that its `f32` is, 60 and not 60.0, 1e18 and
/// not nineteen digits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Number(pub(crate) f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let narrow = self.0 as f32;
        let is_plain = self.0 == 0.0 || (1e-4..1e6).contains(&self.0.abs()) || !self.0.is_finite();
        match (is_plain, f64::from(narrow) == self.0) {
            (true, true) => write!(f, "{narrow}"),
            (true, false) => write!(f, "{}", self.0),
            (false, true) => write!(f, "{narrow:e}"),
            (false, false) => write!(f, "{:e}", self.0),
        }
    }
}

/// Checks that `value` is a number from `min` to `max`.
pub(crate) fn check_range(
    quantity: &'static str,
    value: f64,
    [min, max]: [f64; 2],
    unit: &'static str,
) -> Result<(), BodyError> {
    // The bounds themselves are in range also where an f32 can only come close. NaN fails the comparisons.
    let is_bound = value as f32 == min as f32 || value as f32 == max as f32;
    if value >= min && value <= max || is_bound {
        Ok(())
    } else {
        Err(BodyError::OutOfRange { quantity, value, min, max, unit })
    }
}
