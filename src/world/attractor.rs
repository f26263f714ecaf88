//! Attractors: points that pull every dynamic body toward them.

use core::fmt;

use crate::body::{Bodies, Number};
use crate::math::{Point, Vec2};
use crate::resolution::Acceleration;
use crate::store::Slots;

crate::store::id_type! {
    /// Names an attractor of a world.
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// let mut world = World::new(Settings::default());
    /// let magnet = world.add_attractor(Attractor::local([0.0, 3.0], 50.0, 5.0));
    /// world.step();
    /// world.remove_attractor(magnet); // it is switched off
    /// assert!(world.attractor(magnet).is_none());
    /// ```
    AttractorId
}

/// A point with mass that pulls every dynamic body: a = G·mass/r² toward it, whatever the body's mass.
///
/// Within `min_distance` the pull falls off linearly to nothing at the centre, as inside a ring of mass, so
/// that it never becomes infinite. A negative mass pushes.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// // A moon 10 m from a planet goes round it at v² = G M/r.
/// world.add_attractor(Attractor::global([0.0, 0.0], 1000.0)); // G is 1, see `Settings::gravitational_constant`
/// let moon = world.add(Body::dynamic(Shape::circle(0.5)).at([10.0, 0.0]).velocity([0.0, 10.0]))?;
/// for _ in 0..377 {
///     world.step(); // 2π s: once round
/// }
/// assert!(world.body(moon).unwrap().position().distance([10.0, 0.0]) < 0.05);
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Attractor {
    position: Point,
    mass: f32,
    range: Option<f32>,
    min_distance: f32,
}

/// Softening of an attractor where nothing is said, m.
const DEFAULT_MIN_DISTANCE: f32 = 0.1;
/// Bounds that keep G·mass/r² within `f32`, for every G that settings allow.
const LARGEST_MASS: f32 = 1e18;
const DISTANCES: [f32; 2] = [1e-3, 1e12];

impl Attractor {
    /// An attractor with this mass (kg) at `position` (m) that pulls from any distance.
    ///
    /// # Panics
    /// If a number is one that [`try_new`](Self::try_new) refuses.
    #[track_caller]
    pub fn global(position: impl Into<Point>, mass: f32) -> Self {
        match Self::try_new(position, mass, None) {
            Ok(attractor) => attractor,
            Err(error) => panic!("{error}"),
        }
    }

    /// An attractor with this mass (kg) at `position` (m) that does nothing beyond `range` (m).
    ///
    /// # Panics
    /// If a number is one that [`try_new`](Self::try_new) refuses.
    #[track_caller]
    pub fn local(position: impl Into<Point>, mass: f32, range: f32) -> Self {
        match Self::try_new(position, mass, Some(range)) {
            Ok(attractor) => attractor,
            Err(error) => panic!("{error}"),
        }
    }

    /// An attractor with this mass (kg) at `position` (m), with or without a range (m).
    ///
    /// # Errors
    /// [`AttractorError`], if the position is not finite or beyond 10¹² m, the mass is not finite or beyond
    /// ±10¹⁸ kg, or the range is not from 10⁻³ to 10¹² m.
    pub fn try_new(
        position: impl Into<Point>,
        mass: f32,
        range: Option<f32>,
    ) -> Result<Self, AttractorError> {
        let attractor = Self { position: position.into(), mass, range, min_distance: DEFAULT_MIN_DISTANCE };
        attractor.validate().map(|()| attractor)
    }

    /// The attractor with another distance (m) below which its pull falls off instead of growing; 0.1 m if
    /// nothing is said.
    ///
    /// # Errors
    /// [`AttractorError`], if the distance is not from 10⁻³ to 10¹² m.
    pub fn with_min_distance(self, min_distance: f32) -> Result<Self, AttractorError> {
        let attractor = Self { min_distance, ..self };
        attractor.validate().map(|()| attractor)
    }

    /// Where it is, m.
    pub fn position(&self) -> Point {
        self.position
    }

    /// Its mass, kg.
    pub fn mass(&self) -> f32 {
        self.mass
    }

    /// The distance beyond which it does nothing, m; `None` if it is global.
    pub fn range(&self) -> Option<f32> {
        self.range
    }

    /// The distance below which its pull falls off, m.
    pub fn min_distance(&self) -> f32 {
        self.min_distance
    }

    fn validate(&self) -> Result<(), AttractorError> {
        let refuse = |quantity, value| Err(AttractorError { quantity, value });
        for coordinate in [self.position.x, self.position.y] {
            // Here and below, NaN fails the comparison.
            if !(coordinate.abs() <= f64::from(DISTANCES[1])) {
                return refuse("position (m, up to ±1e12)", coordinate);
            }
        }
        if !(self.mass.abs() <= LARGEST_MASS) {
            return refuse("mass (kg, up to ±1e18)", f64::from(self.mass));
        }
        for (quantity, distance) in [
            ("range (m, from 1e-3 to 1e12)", self.range.unwrap_or(DISTANCES[1])),
            ("minimum distance (m, from 1e-3 to 1e12)", self.min_distance),
        ] {
            if !(DISTANCES[0]..=DISTANCES[1]).contains(&distance) {
                return refuse(quantity, f64::from(distance));
            }
        }
        Ok(())
    }

    /// Acceleration of a body at `distance` from the attractor (the vector toward it), m/s².
    fn acceleration(&self, toward: Vec2, gravitational_constant: f32) -> Vec2 {
        let distance = toward.length();
        if self.range.is_some_and(|range| distance > range) {
            return Vec2::ZERO;
        }
        let softened = distance.max(self.min_distance);
        // (G m / r²) times the unit vector, in an order that stays within f32.
        toward / softened * (gravitational_constant * self.mass / (softened * softened))
    }

    /// Potential energy per mass at a distance, m²/s²: 0 at infinity, or at the range.
    fn potential(&self, distance: f64, gravitational_constant: f64) -> f64 {
        let strength = gravitational_constant * f64::from(self.mass);
        let soft = f64::from(self.min_distance);
        let depth = |r: f64| {
            if r >= soft {
                strength / r
            } else {
                strength * (3.0 * soft * soft - r * r) / (2.0 * soft.powi(3))
            }
        };
        match self.range.map(f64::from) {
            Some(range) if distance > range => 0.0,
            Some(range) => depth(range) - depth(distance),
            None => -depth(distance),
        }
    }
}

/// Why an attractor was refused: one of its numbers is not one the engine can compute with.
///
/// ```
/// use rustycs::prelude::*;
///
/// let error = Attractor::try_new([0.0, 0.0], f32::NAN, None).unwrap_err();
/// assert!(error.to_string().contains("an attractor cannot have"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct AttractorError {
    quantity: &'static str,
    value: f64,
}

impl fmt::Display for AttractorError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "an attractor cannot have {} as its {}; give a finite number in range",
            Number(self.value),
            self.quantity
        )
    }
}

impl std::error::Error for AttractorError {}

/// Everything that accelerates bodies: the sum of the forces, and the attractors.
#[derive(Debug)]
pub(crate) struct Field<'a> {
    /// The sum of all forces, m/s².
    pub(crate) uniform: Vec2,
    pub(crate) attractors: &'a Slots<Attractor>,
    pub(crate) gravitational_constant: f32,
}

impl Field<'_> {
    /// Potential energy per mass of a body with this gravity scale, m²/s².
    pub(crate) fn potential(&self, center: Point, gravity_scale: f32) -> f64 {
        let uniform = f64::from(self.uniform.x) * center.x + f64::from(self.uniform.y) * center.y;
        let pulled: f64 = self
            .attractors
            .iter()
            .map(|(_, attractor)| {
                let (x, y) = (center.x - attractor.position.x, center.y - attractor.position.y);
                attractor.potential((x * x + y * y).sqrt(), f64::from(self.gravitational_constant))
            })
            .sum();
        pulled - uniform * f64::from(gravity_scale)
    }
}

impl Acceleration for Field<'_> {
    fn uniform(&self) -> Vec2 {
        self.uniform
    }

    fn varies(&self) -> bool {
        self.attractors.len() > 0
    }

    fn at(&self, bodies: &Bodies, slot: u32, delta: Vec2) -> Vec2 {
        let center = bodies.center(slot);
        self.attractors.iter().fold(Vec2::ZERO, |sum, (_, attractor)| {
            let toward = (attractor.position - center) - delta;
            sum + attractor.acceleration(toward, self.gravitational_constant)
        })
    }
}
