//! Narrow phase: do two shapes touch, where, how deep, and along which normal.
//!
//! Runs once for every pair of overlapping bounding boxes whose relative pose changed. One file for each pair of
//! shapes; the dispatch below brings a pair into the order that its file expects. Everything is computed relative
//! to the centre of one shape, so that `f32` is accurate wherever in the world the two are. No allocation, and no
//! trigonometry: a rotation is kept as its cosine and sine.
//!
//! | pair | method | reports |
//! |---|---|---|
//! | circle, circle | distance of the centres | 1 point |
//! | box, circle | nearest point of the box, by clamping | 1 point |
//! | polygon or rounded, circle | face of greatest separation, then its ends | 1 point |
//! | aabb, aabb | gaps along the two axes | up to 2 |
//! | box, box | separating axes from half sizes, clipping | up to 2 |
//! | polygon, polygon | separating axes over the hulls, clipping | up to 2 |
//! | rounded or segment, any but a circle | the same of the cores, then the radii taken off | up to 2 |
//! | circle 10,000 times as large as the other shape | heights of the ends of a face above it | up to 2 |

mod aabb_aabb;
mod box_box;
mod circle_box;
mod circle_circle;
mod circle_polygon;
mod clip;
mod closest;
mod large_circle;
mod polygon_polygon;
mod rounded;
#[cfg(test)]
mod tests;
mod time_of_impact;
mod touch;

pub(crate) use large_circle::is_flat;
pub(in crate::collision) use polygon_polygon::on_face;
pub(crate) use time_of_impact::{Swept, gap_between, noise_of, time_of_impact};
pub(crate) use touch::Touch;

use core::ops::Neg;

use crate::collision::Manifold;
use crate::math::{Point, Pose, Rot, Vec2};
use crate::shape::{Hull, Shape};

/// Where two shapes touch or overlap, without a world; `None` where there is a gap between them.
///
/// ```
/// use rustycs::collision::detect;
/// use rustycs::math::Pose;
/// use rustycs::shape::Shape;
///
/// let floor = Shape::aabb(20.0, 1.0);
/// let ball = Shape::circle(0.5);
/// let manifold = detect(&floor, Pose::at([0.0, 0.0]), &ball, Pose::at([3.0, 0.75])).unwrap();
/// assert_eq!(manifold.normal, [0.0, 1.0].into()); // from the floor to the ball
/// assert_eq!(manifold.points()[0].separation, -0.25);
///
/// assert!(detect(&floor, Pose::at([0.0, 0.0]), &ball, Pose::at([3.0, 1.25])).is_none());
/// ```
pub fn detect(shape_a: &Shape, pose_a: Pose, shape_b: &Shape, pose_b: Pose) -> Option<Manifold> {
    let offset = Offset::between(pose_a.center, pose_b.center);
    let is_flat =
        is_flat([shape_a, shape_b].map(|shape| (matches!(shape, Shape::Circle(_)), shape.extent())));
    let detect = if is_flat { detect_flat } else { detect_from };
    detect(shape_a, pose_a.rotation, shape_b, pose_b.rotation, offset, 0.0)
}

/// A core, turned, with the radius around it, m.
#[derive(Clone, Copy)]
struct Core<'a> {
    hull: &'a Hull,
    rotation: Rot,
    radius: f32,
}

impl<'a> Core<'a> {
    /// That of a shape that is no circle; boxes, polygons and segments have a radius of 0.
    fn of(shape: &'a Shape, rotation: Rot) -> Option<Self> {
        shape.core().map(|(hull, radius)| Self { hull, rotation, radius })
    }

    /// Distance of the nearest face from the centre, m; infinite for a segment, which is as thick as what it meets.
    fn inradius(&self) -> f32 {
        let has_thickness = self.radius > 0.0 || !self.hull.is_segment();
        if has_thickness { self.hull.inradius + self.radius } else { f32::INFINITY }
    }
}

/// The centre of b from the centre of a, with more digits than `f32` has, m.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Offset {
    /// Rounded to `f32`.
    pub(crate) near: Vec2,
    /// What is missing.
    pub(crate) rest: Vec2,
}

impl Neg for Offset {
    type Output = Self;
    fn neg(self) -> Self {
        Self { near: -self.near, rest: -self.rest }
    }
}

impl Offset {
    #[inline(always)]
    pub(crate) fn between(a: Point, b: Point) -> Self {
        let near = b - a;
        let rest = |b: f64, a: f64, near: f32| (b - a - f64::from(near)) as f32;
        Self { near, rest: Vec2::new(rest(b.x, a.x, near.x), rest(b.y, a.y, near.y)) }
    }

    /// What a gap along the normal misses that was found from `near`, m.
    #[inline(always)]
    pub(crate) fn missing(self, normal: Vec2) -> f32 {
        normal.dot(self.rest)
    }
}

/// The same as [`detect_within`], to the last digit of the offset.
#[inline]
pub(crate) fn detect_from(
    shape_a: &Shape,
    rotation_a: Rot,
    shape_b: &Shape,
    rotation_b: Rot,
    offset: Offset,
    margin: f32,
) -> Option<Manifold> {
    let mut found = detect_within(shape_a, rotation_a, shape_b, rotation_b, offset.near, margin);
    if let Some(manifold) = &mut found {
        let missing = offset.missing(manifold.normal);
        for point in manifold.points_mut() {
            point.separation += missing;
        }
    }
    found
}

/// The same where one of the two is a circle that the other finds flat, see [`is_flat`].
pub(crate) fn detect_flat(
    shape_a: &Shape,
    rotation_a: Rot,
    shape_b: &Shape,
    rotation_b: Rot,
    offset: Offset,
    margin: f32,
) -> Option<Manifold> {
    let (rot_a, rot_b) = (shape_a.rotation_at(rotation_a), shape_b.rotation_at(rotation_b));
    match (shape_a, shape_b) {
        (Shape::Circle(a), b) if a.radius() > b.extent() => {
            large_circle::detect(*a, b, rot_b, offset, margin)
        }
        (a, Shape::Circle(b)) => flip(large_circle::detect(*b, a, rot_a, -offset, margin)),
        _ => None,
    }
}

/// The manifold of two shapes whose gap is at most `margin`, m; its points are those with a separation of at
/// most `margin`. `offset` is the centre of b minus the centre of a, m. `Shape::Aabb` ignores its rotation.
///
/// `None` for shapes further apart, and where an argument is NaN or infinite.
#[inline]
pub(crate) fn detect_within(
    shape_a: &Shape,
    rotation_a: Rot,
    shape_b: &Shape,
    rotation_b: Rot,
    offset: Vec2,
    margin: f32,
) -> Option<Manifold> {
    use Shape::{Aabb, Circle, Obb, Polygon, Rounded, Segment};
    let (rot_a, rot_b) = (shape_a.rotation_at(rotation_a), shape_b.rotation_at(rotation_b));
    match (shape_a, shape_b) {
        (Circle(_), _) | (_, Circle(_)) => {
            touch(shape_a, rotation_a, shape_b, rotation_b, offset, margin).map(Touch::manifold)
        }
        (Aabb(a), Aabb(b)) => aabb_aabb::detect(a, b, offset, margin),
        (Aabb(a) | Obb(a), Aabb(b) | Obb(b)) => box_box::detect(a, rot_a, b, rot_b, offset, margin),
        (Polygon(a), Polygon(b)) => polygon_polygon::detect(a.hull(), rot_a, b.hull(), rot_b, offset, margin),
        (Polygon(a), Aabb(b) | Obb(b)) => {
            polygon_polygon::detect(a.hull(), rot_a, b.hull(), rot_b, offset, margin)
        }
        (Aabb(a) | Obb(a), Polygon(b)) => {
            polygon_polygon::detect(a.hull(), rot_a, b.hull(), rot_b, offset, margin)
        }
        (Rounded(_) | Segment(_), _) | (_, Rounded(_) | Segment(_)) => {
            rounded::detect(Core::of(shape_a, rot_a)?, Core::of(shape_b, rot_b)?, offset, margin)
        }
    }
}

/// The same for two shapes of which one is a circle; `None` for others.
#[inline]
pub(crate) fn touch(
    shape_a: &Shape,
    rotation_a: Rot,
    shape_b: &Shape,
    rotation_b: Rot,
    offset: Vec2,
    margin: f32,
) -> Option<Touch> {
    use Shape::{Aabb, Circle, Obb, Polygon, Rounded, Segment};
    let (rot_a, rot_b) = (shape_a.rotation_at(rotation_a), shape_b.rotation_at(rotation_b));
    match (shape_a, shape_b) {
        (Circle(a), Circle(b)) => circle_circle::touch(*a, *b, offset, margin),
        (Aabb(a) | Obb(a), Circle(b)) => circle_box::touch(a, rot_a, *b, offset, margin),
        (Circle(a), Aabb(b) | Obb(b)) => circle_box::touch(b, rot_b, *a, -offset, margin).map(Touch::flipped),
        (Polygon(_) | Rounded(_) | Segment(_), Circle(b)) => {
            circle_polygon::touch(Core::of(shape_a, rot_a)?, *b, offset, margin)
        }
        (Circle(a), Polygon(_) | Rounded(_) | Segment(_)) => {
            circle_polygon::touch(Core::of(shape_b, rot_b)?, *a, -offset, margin).map(Touch::flipped)
        }
        _ => None,
    }
}

#[inline(always)]
fn flip(manifold: Option<Manifold>) -> Option<Manifold> {
    manifold.map(|m| m.flipped())
}

/// Whether a separation is at most `margin`; NaN is within none.
#[inline(always)]
fn within(separation: f32, margin: f32) -> bool {
    separation <= margin
}
