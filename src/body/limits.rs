//! The numbers that a body may be given.

use crate::body::BodyError;
use crate::body::error::check_range;
use crate::math::{Point, Rot, Vec2};

/// Largest coordinate, m, that a body can be given, or get to: there a step of `f64` is 0.1 mm.
pub(crate) const FARTHEST: f64 = 1e12;
/// Largest speed (m/s), spin (rad/s), force (N) or impulse (N s) that can be given: its square stays in `f32`.
pub(crate) const STRONGEST: f64 = 1e18;
/// Masses (kg) with which the solver's products of inverse masses stay within `f32`.
pub(super) const MASSES: [f64; 2] = [1e-12, 1e15];
/// Moments of inertia, kg m²: the masses times the squares of reasonable extents.
pub(super) const INERTIAS: [f64; 2] = [1e-18, 1e25];
/// Largest coefficient of friction, gravity scale, damping (1/s) or surface speed (m/s): far above use, far from overflow.
const LARGEST_FACTOR: f64 = 1e6;
/// Farthest that a collider may be from the body's own shape, m: as large as a shape may be.
pub(super) const LARGEST_LENGTH: f64 = 1e8;

pub(crate) fn check_place(center: Point) -> Result<(), BodyError> {
    check_range("the x of the position", center.x, [-FARTHEST, FARTHEST], "m")?;
    check_range("the y of the position", center.y, [-FARTHEST, FARTHEST], "m")
}

/// Checks that the two numbers are cosine and sine of an angle.
pub(crate) fn check_rotation(Rot { c, s }: Rot) -> Result<(), BodyError> {
    let square = f64::from(c) * f64::from(c) + f64::from(s) * f64::from(s);
    check_range("the c² + s² of the rotation", square, [0.999, 1.001], "")
}

pub(crate) fn check_strength(
    quantity: &'static str,
    value: f32,
    unit: &'static str,
) -> Result<(), BodyError> {
    check_range(quantity, f64::from(value), [-STRONGEST, STRONGEST], unit)
}

pub(crate) fn check_vector(quantity: &'static str, value: Vec2, unit: &'static str) -> Result<(), BodyError> {
    check_strength(quantity, value.x, unit)?;
    check_strength(quantity, value.y, unit)
}

pub(crate) fn check_friction(friction: f32) -> Result<(), BodyError> {
    check_range("the friction", f64::from(friction), [0.0, LARGEST_FACTOR], "")
}

pub(crate) fn check_restitution(restitution: f32) -> Result<(), BodyError> {
    check_range("the restitution", f64::from(restitution), [0.0, 1.0], "")
}

pub(crate) fn check_surface_speed(speed: f32) -> Result<(), BodyError> {
    check_range("the surface speed", f64::from(speed), [-LARGEST_FACTOR, LARGEST_FACTOR], "m/s")
}

pub(crate) fn check_rolling_resistance(coefficient: f32) -> Result<(), BodyError> {
    check_range("the rolling resistance", f64::from(coefficient), [0.0, LARGEST_FACTOR], "")
}

/// Checks that a direction, if there is one, has a length: 1, or what is none.
pub(crate) fn check_one_way(direction: Option<Vec2>) -> Result<(), BodyError> {
    let length = direction.map_or(1.0, |direction| f64::from(direction.length()));
    check_range("the length of the one-way direction", length, [1e-6, 1e6], "")
}

pub(crate) fn check_gravity_scale(scale: f32) -> Result<(), BodyError> {
    check_range("the gravity scale", f64::from(scale), [-LARGEST_FACTOR, LARGEST_FACTOR], "")
}

pub(crate) fn check_damping(quantity: &'static str, damping: f32) -> Result<(), BodyError> {
    check_range(quantity, f64::from(damping), [0.0, LARGEST_FACTOR], "1/s")
}
