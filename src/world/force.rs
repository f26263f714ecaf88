//! World forces: named accelerations that act on every dynamic body.

use core::fmt;
use std::borrow::Cow;

use crate::math::Vec2;

crate::store::id_type! {
    /// Names a force of a world.
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// let mut world = World::new(Settings::default());
    /// let gravity = world.add_force(Force::EARTH_GRAVITY);
    /// let on_the_moon = Force::MOON_GRAVITY;
    /// world.remove_force(gravity);
    /// world.add_force(on_the_moon);
    /// assert!(world.force(gravity).is_none() && world.acceleration() == Vec2::new(0.0, -1.62));
    /// ```
    ForceId
}

/// A force that acts everywhere and gives every dynamic body the same acceleration, times its gravity scale.
/// All forces of a world add up.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add_force(Force::EARTH_GRAVITY);
/// let wind = world.add_force(Force::new("wind", [2.0, 0.0])); // m/s²
/// let leaf = world.add(Body::dynamic(Shape::circle(0.1)))?;
/// let anvil = world.add(Body::dynamic(Shape::rectangle(1.0, 0.5)).at([5.0, 0.0]).gravity_scale(0.5))?;
/// for _ in 0..60 {
///     world.step();
/// }
/// assert!(world.body(leaf).unwrap().velocity().distance([2.0, -9.81]) < 1e-4);
/// assert!(world.body(anvil).unwrap().velocity().distance([1.0, -4.905]) < 1e-4); // half of both
/// world.remove_force(wind);
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Debug, PartialEq)]
pub struct Force {
    name: Cow<'static, str>,
    acceleration: Vec2,
}

clone_into_buffers!(Force { name, acceleration });

/// Largest acceleration of a force, m/s²: far above use, far from overflow.
const LARGEST_ACCELERATION: f32 = 1e12;

impl Force {
    /// Gravity on the Earth: 9.81 m/s² downward.
    pub const EARTH_GRAVITY: Self =
        Self { name: Cow::Borrowed("earth gravity"), acceleration: Vec2::new(0.0, -9.81) };
    /// Gravity on the Moon: 1.62 m/s² downward.
    pub const MOON_GRAVITY: Self =
        Self { name: Cow::Borrowed("moon gravity"), acceleration: Vec2::new(0.0, -1.62) };

    /// A force with a name and an acceleration, m/s².
    ///
    /// # Panics
    /// If the acceleration is one that [`try_new`](Self::try_new) refuses.
    #[track_caller]
    pub fn new(name: impl Into<Cow<'static, str>>, acceleration: impl Into<Vec2>) -> Self {
        match Self::try_new(name, acceleration) {
            Ok(force) => force,
            Err(error) => panic!("{error}"),
        }
    }

    /// A force with a name and an acceleration, m/s².
    ///
    /// # Errors
    /// [`ForceError`], if a component of the acceleration is NaN or beyond ±10¹² m/s².
    pub fn try_new(
        name: impl Into<Cow<'static, str>>,
        acceleration: impl Into<Vec2>,
    ) -> Result<Self, ForceError> {
        let (name, acceleration) = (name.into(), acceleration.into());
        let largest = acceleration.abs();
        // NaN fails the comparisons.
        if largest.x <= LARGEST_ACCELERATION && largest.y <= LARGEST_ACCELERATION {
            Ok(Self { name, acceleration })
        } else {
            Err(ForceError { name, acceleration })
        }
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its acceleration, m/s².
    pub fn acceleration(&self) -> Vec2 {
        self.acceleration
    }
}

/// Why a force was refused: its acceleration is not a number the engine can compute with.
///
/// ```
/// use rustycs::prelude::*;
///
/// let error = Force::try_new("wind", [f32::NAN, 0.0]).unwrap_err();
/// assert!(error.to_string().contains("wind"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ForceError {
    name: Cow<'static, str>,
    acceleration: Vec2,
}

impl fmt::Display for ForceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Vec2 { x, y } = self.acceleration;
        let limit = LARGEST_ACCELERATION;
        write!(
            f,
            "the acceleration of the force \"{}\" is ({x}, {y}) m/s²; give finite numbers up to ±{limit:e}",
            self.name
        )
    }
}

impl std::error::Error for ForceError {}
