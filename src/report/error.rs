//! Why a study was not run.

use core::fmt;

use crate::world::SettingsError;

/// Why a study was not run, or has no result.
///
/// ```
/// # use rustycs::prelude::*;
/// # let throw = |settings: Settings| {
/// #     let mut world = World::new(settings);
/// #     world.add_force(Force::EARTH_GRAVITY);
/// #     world.add(Body::dynamic(Shape::circle(0.5)).velocity([3.0, 4.0])).unwrap();
/// #     world
/// # };
/// use rustycs::report::{Study, StudyError};
///
/// let error = Study::new(throw).duration(0.0).run().unwrap_err();
/// assert_eq!(error, StudyError::Duration(0.0));
/// println!("{error}");
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum StudyError {
    /// A list to sweep over is empty.
    EmptySweep {
        /// Which list.
        list: &'static str,
    },
    /// The duration, s, is not a positive finite number.
    Duration(f64),
    /// A count that must be 1 or more is 0.
    Zero {
        /// Which count.
        count: &'static str,
    },
    /// Settings were refused.
    Settings {
        /// The row they belong to.
        label: String,
        /// What is wrong with them.
        source: SettingsError,
    },
    /// The scene builds a world with other settings than it was asked to.
    SettingsIgnored {
        /// The row that was asked for.
        label: String,
        /// Name of the field.
        field: &'static str,
        /// What was asked for.
        asked: f64,
        /// What the world has.
        found: f64,
    },
    /// The scene builds a world without bodies.
    NoBodies,
    /// A trajectory was to be measured, and all bodies are fixed.
    NothingMoves,
    /// The scene builds other bodies for other settings.
    DifferentBodies {
        /// The row whose bodies differ from the reference's.
        label: String,
    },
    /// The closed form gives a different number of bodies than move.
    ExactCount {
        /// How many it gives.
        given: usize,
        /// How many move.
        moving: usize,
    },
    /// The closed form is for another kind of measure.
    ExactKind {
        /// The method that fits the measure.
        method: &'static str,
    },
    /// The progress function stopped the study before the first row.
    Interrupted,
}

impl fmt::Display for StudyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::EmptySweep { list } => write!(f, "the list of {list} is empty; give at least one"),
            Self::Duration(duration) => {
                write!(f, "the duration is {duration} s; give a positive number of seconds")
            }
            Self::Zero { count } => write!(f, "the number of {count} is 0; give 1 or more"),
            Self::Settings { label, source } => write!(f, "{label}: {source}"),
            Self::SettingsIgnored { label, field, asked, found } => write!(
                f,
                "{label}: the scene was asked for a {field} of {asked} and builds a world with {found}; let it \
                 hand on the settings that it is given"
            ),
            Self::NoBodies => f.write_str("the scene builds a world without bodies; add one"),
            Self::NothingMoves => f.write_str(
                "all bodies of the scene are fixed, so there is no trajectory; add a dynamic or kinematic one",
            ),
            Self::DifferentBodies { label } => write!(
                f,
                "{label}: the bodies are not those of the reference; build the same ones, in the same order, \
                 for all settings"
            ),
            Self::ExactCount { given, moving } => write!(
                f,
                "the closed form gives {given} bodies, and {moving} move; give one for each that is not fixed, \
                 in the order in which the scene adds them"
            ),
            Self::ExactKind { method } => {
                write!(f, "the closed form does not fit what is measured; use {method}")
            }
            Self::Interrupted => f.write_str("the study was stopped before its first row was done"),
        }
    }
}

impl std::error::Error for StudyError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Settings { source, .. } => Some(source),
            _ => None,
        }
    }
}
