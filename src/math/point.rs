//! A place in the world in `f64`.

use core::fmt;
use core::ops::{Add, AddAssign, Sub, SubAssign};

use crate::math::Vec2;
use crate::math::vec2::write_pair;

/// A place in the world, in metres, in `f64`.
///
/// Subtracting two points gives the [`Vec2`] between them, exact to `f32` rounding wherever in the world the
/// two are; adding a vector moves a point. Arguments that mean a place take `impl Into<Point>`: `[1.0, 2.0]`,
/// `(1.0, 2.0)`, a `Vec2`, in `f32` or `f64`.
///
/// ```
/// use rustycs::prelude::*;
///
/// let (home, ship) = (Point::new(1e9, 0.0), Point::new(1e9 + 0.25, 0.0));
/// let way: Vec2 = ship - home; // a point minus a point is a vector: exact, a million kilometres from the origin
/// assert_eq!(way, Vec2::new(0.25, 0.0));
/// assert_eq!(home.lerp(ship, 0.5), home + Vec2::new(0.125, 0.0));
/// ```
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// Coordinate to the right, m.
    pub x: f64,
    /// Coordinate upward, m.
    pub y: f64,
}

impl Point {
    /// The origin of the world.
    pub const ORIGIN: Self = Self::new(0.0, 0.0);

    /// The place (x, y), m.
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// Distance of another place, m.
    pub fn distance(self, other: impl Into<Self>) -> f64 {
        let other = other.into();
        let (x, y) = (other.x - self.x, other.y - self.y);
        (x * x + y * y).sqrt()
    }

    /// The place on the straight way from this one (`t` = 0) to `other` (1); both ends are exact.
    #[must_use]
    pub fn lerp(self, other: impl Into<Self>, t: f32) -> Self {
        let (other, t) = (other.into(), f64::from(t));
        let between =
            |from: f64, to: f64| if t < 0.5 { from + (to - from) * t } else { to - (to - from) * (1.0 - t) };
        Self::new(between(self.x, other.x), between(self.y, other.y))
    }

    /// The place rounded to `f32`, as seen from the origin, m.
    pub fn to_vec2(self) -> Vec2 {
        Vec2::new(self.x as f32, self.y as f32)
    }

    /// The nearest place whose coordinates are within ±`limit`, m.
    #[inline(always)]
    pub(crate) fn within(self, limit: f64) -> Self {
        Self::new(self.x.clamp(-limit, limit), self.y.clamp(-limit, limit))
    }

    /// Whether both coordinates are numbers, neither NaN nor infinite.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl Sub for Point {
    type Output = Vec2;
    #[inline(always)]
    fn sub(self, from: Self) -> Vec2 {
        Vec2::new((self.x - from.x) as f32, (self.y - from.y) as f32)
    }
}

impl Add<Vec2> for Point {
    type Output = Self;
    #[inline(always)]
    fn add(self, offset: Vec2) -> Self {
        Self::new(self.x + f64::from(offset.x), self.y + f64::from(offset.y))
    }
}

impl Sub<Vec2> for Point {
    type Output = Self;
    /// The place that `offset` leads from to this one.
    #[inline(always)]
    fn sub(self, offset: Vec2) -> Self {
        Self::new(self.x - f64::from(offset.x), self.y - f64::from(offset.y))
    }
}

impl Sub<Point> for Vec2 {
    type Output = Self;
    /// The vector from a place to the one at `self`, seen from the origin: `body.position() - target`.
    #[inline(always)]
    fn sub(self, from: Point) -> Self {
        Point::from(self) - from
    }
}

impl Add<Point> for Vec2 {
    type Output = Point;
    #[inline(always)]
    fn add(self, place: Point) -> Point {
        place + self
    }
}

impl SubAssign<Vec2> for Point {
    #[inline(always)]
    fn sub_assign(&mut self, offset: Vec2) {
        *self = *self - offset;
    }
}

impl AddAssign<Vec2> for Point {
    #[inline(always)]
    fn add_assign(&mut self, offset: Vec2) {
        *self = *self + offset;
    }
}

impl From<Vec2> for Point {
    fn from(vector: Vec2) -> Self {
        Self::new(f64::from(vector.x), f64::from(vector.y))
    }
}

/// Rounds to `f32`: far from the origin the difference of two points keeps what this loses.
impl From<Point> for Vec2 {
    fn from(point: Point) -> Self {
        point.to_vec2()
    }
}

/// (x, y) in metres; a precision is that of both: `{:.2}`.
impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_pair(f, &self.x, &self.y)
    }
}

impl From<[f64; 2]> for Point {
    fn from([x, y]: [f64; 2]) -> Self {
        Self::new(x, y)
    }
}

impl From<(f64, f64)> for Point {
    fn from((x, y): (f64, f64)) -> Self {
        Self::new(x, y)
    }
}

impl From<[f32; 2]> for Point {
    fn from([x, y]: [f32; 2]) -> Self {
        Self::new(f64::from(x), f64::from(y))
    }
}

impl From<(f32, f32)> for Point {
    fn from((x, y): (f32, f32)) -> Self {
        Self::new(f64::from(x), f64::from(y))
    }
}

impl From<Point> for [f64; 2] {
    fn from(point: Point) -> Self {
        [point.x, point.y]
    }
}

impl From<Point> for (f64, f64) {
    fn from(point: Point) -> Self {
        (point.x, point.y)
    }
}

/// Rounds to `f32`, as drawing wants it.
impl From<Point> for [f32; 2] {
    fn from(point: Point) -> Self {
        point.to_vec2().into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2²⁵ + 1 is no `f32`; differences of such places are exact all the same.
    #[test]
    fn places_and_vectors_add_and_subtract_in_any_order() {
        let far = Point::new(33_554_433.0, 2.0);
        let offset = Vec2::new(0.5, -1.0);
        assert_eq!(far + offset, offset + far);
        assert_eq!((far + offset) - offset, far);
        assert_eq!((far + offset) - far, offset);
        assert_eq!(Vec2::new(4.0, 4.0) - Point::new(1.0, 2.0), Vec2::new(3.0, 2.0));
        let mut place = far;
        place += offset;
        place -= offset;
        assert_eq!(place, far);
        assert_eq!(Vec2::from(far), Vec2::new(33_554_432.0, 2.0));
        assert_eq!((<[f64; 2]>::from(far), <(f64, f64)>::from(far)), ([far.x, 2.0], (far.x, 2.0)));
        assert_eq!(<[f32; 2]>::from(Point::new(0.5, 2.0)), [0.5, 2.0]);
    }

    #[test]
    fn the_ends_of_a_way_are_exact_and_its_middle_is_halfway() {
        let (from, to) = (Point::new(0.1, -3.0), Point::new(0.7, 1e9 + 0.3));
        assert_eq!((from.lerp(to, 0.0), from.lerp(to, 1.0)), (from, to));
        assert_eq!(from.lerp(from, 0.3), from);
        assert_eq!(Point::ORIGIN.lerp([4.0, -2.0], 0.5), Point::new(2.0, -1.0));
        assert_eq!(Point::ORIGIN.distance([3.0, 4.0]), 5.0);
    }

    #[test]
    fn a_place_is_shown_with_the_precision_that_is_asked_for() {
        let place = Point::new(1.25, -2.0);
        assert_eq!((format!("{place}"), format!("{place:.1}")), ("(1.25, -2)".into(), "(1.2, -2.0)".into()));
    }
}
