//! A place in the world in `f64`.

use core::ops::{Add, AddAssign, Sub};

use crate::math::Vec2;

/// A place in the world, in metres, in `f64`.
///
/// Subtracting two points gives the [`Vec2`] between them, exact to `f32` rounding wherever in the world the
/// two are; adding a vector moves a point. Arguments that mean a place take `impl Into<Point>`: `[1.0, 2.0]`,
/// `(1.0, 2.0)`, a `Vec2`, in `f32` or `f64`.
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
