//! Why a joint was refused.

use core::fmt;

use crate::body::Number;
use crate::joint::JointKind;

/// Why a joint, or a change to one, was refused. The world is as it was before.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// let door = world.add(Body::dynamic(Shape::rectangle(1.0, 0.1)))?;
/// let hinge = Joint::revolute(door, None).at([-0.5, 0.0]);
/// let error = world.add_joint(hinge.limits(1.0..=-1.0)).unwrap_err();
/// assert_eq!(error, JointError::LimitsCrossed { lower: 1.0, upper: -1.0 });
/// assert_eq!(error.to_string(), "the lower limit 1 is above the upper limit -1; exchange them");
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum JointError {
    /// A body of the joint has been removed.
    NoBody {
        /// Which of its bodies: "first" or "second".
        which: &'static str,
    },
    /// Both bodies are one and the same.
    SameBody,
    /// None of its bodies is dynamic: nothing that it does would move one.
    NoDynamicBody,
    /// The lower limit is above the upper one.
    LimitsCrossed {
        /// The lower limit, m or rad.
        lower: f64,
        /// The upper limit, m or rad.
        upper: f64,
    },
    /// The kind has no such option.
    NoSuchOption {
        /// What kind of joint it is.
        kind: JointKind,
        /// What was given.
        option: &'static str,
        /// The kinds that have it.
        kinds: &'static [JointKind],
    },
    /// The axis has no direction.
    NoAxis,
    /// A friction joint that resists nothing.
    NoStrength,
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
}

impl fmt::Display for JointError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoBody { which } => {
                write!(f, "the {which} body of the joint has been removed; give the id of one that is there")
            }
            Self::SameBody => {
                f.write_str("a joint cannot join a body to itself; give two bodies, or None for the world")
            }
            Self::NoDynamicBody => f.write_str(
                "a joint moves dynamic bodies only; give one that is dynamic, or make it dynamic before the joint is added",
            ),
            Self::LimitsCrossed { lower, upper } => write!(
                f,
                "the lower limit {} is above the upper limit {}; exchange them",
                Number(*lower),
                Number(*upper)
            ),
            Self::NoSuchOption { kind, option, kinds } => {
                write!(f, "a {kind} joint has no {option}; leave it out, or take one of these kinds: ")?;
                for (number, kind) in kinds.iter().enumerate() {
                    write!(f, "{}{kind}", if number == 0 { "" } else { ", " })?;
                }
                Ok(())
            }
            Self::NoAxis => {
                f.write_str("the axis has no direction; give a vector that is finite and not zero")
            }
            Self::NoStrength => f.write_str(
                "a friction joint without a greatest force or torque resists nothing; give max_force (N), max_torque (N m), or both",
            ),
            Self::OutOfRange { quantity, value, min, max, unit } => {
                let space = if unit.is_empty() { "" } else { " " };
                write!(f, "{quantity} is {}{space}{unit}; give ", Number(*value))?;
                let [least, most] = [min, max].map(|bound| Number(*bound));
                match (min.is_finite(), max.is_finite()) {
                    (true, true) => write!(f, "a finite number from {least} to {most}{space}{unit}"),
                    (true, false) => write!(f, "a number of {least}{space}{unit} or more"),
                    (false, _) => write!(f, "a number of {most}{space}{unit} or less"),
                }
            }
        }
    }
}

impl std::error::Error for JointError {}
