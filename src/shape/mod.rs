//! Shapes: the geometry of a body, about its centre of mass.
//!
//! Circle, two kinds of box, convex polygons, of which concave outlines are made up, and both capsules and polygons with round
//! corners, which are one thing: a core and a radius around it. And segments, which have neither thickness nor mass, for ground.
//! Constructors of circles, boxes, capsules and segments take any number; [`Shape::validate`] checks them once, when the body
//! enters the world, so that nothing in the step has to. What is precomputed here (corners, edge normals) is what detection reads
//! at every step.
//!
//! ```
//! use rustycs::prelude::*;
//!
//! let wheel = Shape::circle(0.3);
//! let crate_ = Shape::rectangle(1.0, 0.5);
//! let roof = Shape::polygon([[0.0, 0.0], [4.0, 0.0], [2.0, 1.5]])?;
//! let hero = Shape::capsule([0.0, -0.5], [0.0, 0.5], 0.3);
//! let arrow = Shape::concave([[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [1.0, 1.0]])?; // several
//! assert!(arrow.iter().chain([&wheel, &crate_, &roof, &hero]).all(|shape| shape.area() > 0.0));
//! # Ok::<(), ShapeError>(())
//! ```

mod decomposition;
mod error;
mod exposure;
mod hull;
mod mass;
mod polygon;
mod query;
mod rounded;
mod segment;
#[cfg(test)]
pub(crate) mod testing;
#[cfg(test)]
mod tests;

pub use decomposition::MAX_OUTLINE_POINTS;
pub use error::{Ring, RingPlace, ShapeError};
pub use hull::MAX_VERTICES;
pub use mass::MassProperties;
pub use polygon::Polygon;
pub use query::OutlineHit;
pub use rounded::Rounded;
pub use segment::Segment;

pub(crate) use exposure::{Exposure, Neighbour, Place};
pub(crate) use hull::Hull;
pub(crate) use segment::Link;

use crate::math::{Aabb, Pose, Rot, Vec2};

/// Smallest size of a shape, m. What moves has limits of mass and moment of inertia besides, see
/// [`World::add`](crate::World::add): of 1 kg/m² a box has to be larger than 50 µm.
pub const MIN_SIZE: f32 = 1e-5;

/// Largest size of a shape, m. What moves has limits of mass and moment of inertia besides, see
/// [`World::add`](crate::World::add): of 1 kg/m² a box has to be smaller than 2,700 km.
pub const MAX_SIZE: f32 = 1e8;

/// The geometry of a body, about its centre of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// A disc.
    Circle(Circle),
    /// A box that never turns: its sides stay parallel to the axes of the world.
    Aabb(Rectangle),
    /// A box that turns with its body.
    Obb(Rectangle),
    /// A convex polygon with 3 to 8 corners.
    Polygon(Polygon),
    /// A capsule, or a convex polygon with 3 to 8 round corners.
    Rounded(Rounded),
    /// A line without thickness, for bodies that contacts do not move.
    Segment(Segment),
}

/// A disc.
///
/// ```
/// use rustycs::Shape;
///
/// let ball = Shape::circle(0.5);
/// if let Shape::Circle(circle) = ball {
///     assert_eq!(circle.radius(), 0.5);
/// }
/// assert_eq!((ball.radius(), Shape::rectangle(1.0, 1.0).radius()), (Some(0.5), None));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circle {
    radius: f32,
}

impl Circle {
    /// Radius, m.
    #[inline(always)]
    pub fn radius(&self) -> f32 {
        self.radius
    }
}

/// A box: half sizes first, which is all that detection needs of it in the usual case.
///
/// ```
/// use rustycs::Shape;
///
/// let crate_ = Shape::rectangle(2.0, 1.0);
/// if let Shape::Obb(rectangle) | Shape::Aabb(rectangle) = crate_ {
///     assert_eq!((rectangle.width(), rectangle.height()), (2.0, 1.0)); // for the size of a sprite
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Rectangle {
    half: Vec2,
    hull: Hull,
}

impl Rectangle {
    fn new(width: f32, height: f32) -> Self {
        let half = Vec2::new(0.5 * width, 0.5 * height);
        Self { half, hull: Hull::rectangle(half) }
    }

    /// Full width, m.
    pub fn width(&self) -> f32 {
        2.0 * self.half.x
    }

    /// Full height, m.
    pub fn height(&self) -> f32 {
        2.0 * self.half.y
    }

    /// Half width and half height, m.
    #[inline(always)]
    pub fn half_size(&self) -> Vec2 {
        self.half
    }

    #[inline(always)]
    pub(crate) fn hull(&self) -> &Hull {
        &self.hull
    }
}

impl Shape {
    /// A disc of `radius`, m.
    pub fn circle(radius: f32) -> Self {
        Self::Circle(Circle { radius })
    }

    /// A box of full `width` and `height`, m, that turns with its body.
    pub fn rectangle(width: f32, height: f32) -> Self {
        Self::obb(width, height)
    }

    /// An axis-aligned box of full `width` and `height`, m: its sides stay parallel to the axes of the world, whatever angle
    /// or spin its body is given. One that can turn is a [`rectangle`](Self::rectangle).
    pub fn aabb(width: f32, height: f32) -> Self {
        Self::Aabb(Rectangle::new(width, height))
    }

    /// An oriented box of full `width` and `height`, m, that turns with its body: a [`rectangle`](Self::rectangle).
    pub fn obb(width: f32, height: f32) -> Self {
        Self::Obb(Rectangle::new(width, height))
    }

    /// A convex polygon from the points of its outline, m, in order, either way round, anywhere.
    ///
    /// It is moved so that its centre of mass is the origin of the body's frame;
    /// [`Polygon::centroid_of_input`] tells where that was. Points that repeat the one before or lie on a
    /// straight edge, to 1e-5 of the size, are dropped.
    ///
    /// # Errors
    ///
    /// Refuses coordinates that are not finite, fewer than 3 or more than 8 corners, outlines that are concave,
    /// cross themselves or lie on a line, and sizes outside [`MIN_SIZE`] to [`MAX_SIZE`].
    ///
    /// ```
    /// use rustycs::shape::{Shape, ShapeError};
    ///
    /// let triangle = Shape::polygon([[0.0, 0.0], [3.0, 0.0], [0.0, 3.0]])?;
    /// assert_eq!(triangle.area(), 4.5);
    /// assert_eq!(triangle.vertices()[0], [-1.0, -1.0].into());
    ///
    /// let arrow = Shape::polygon([[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [1.0, 1.0]]);
    /// assert_eq!(arrow, Err(ShapeError::Concave { index: 3 }));
    /// # Ok::<(), ShapeError>(())
    /// ```
    pub fn polygon<P: Into<Vec2>>(points: impl IntoIterator<Item = P>) -> Result<Self, ShapeError> {
        Polygon::new(points).map(Self::Polygon)
    }

    /// A capsule: all that is within `radius`, m, of the line from `a` to `b`, m.
    ///
    /// It is moved so that its middle is the origin of the body's frame; [`Rounded::centroid_of_input`] tells where that was.
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// // 1.6 m tall. A disc and a rectangle: π r² + 2 r l.
    /// let capsule = Shape::capsule([0.0, -0.5], [0.0, 0.5], 0.3);
    /// assert!((capsule.area() - (std::f32::consts::PI * 0.09 + 0.6)).abs() < 1e-6);
    /// assert_eq!(capsule.vertices(), [[0.0, -0.5].into(), [0.0, 0.5].into()]);
    /// ```
    pub fn capsule(a: impl Into<Vec2>, b: impl Into<Vec2>, radius: f32) -> Self {
        Self::Rounded(Rounded::capsule(a.into(), b.into(), radius))
    }

    /// All that is within `radius`, m, of the convex polygon of some points, m, given as for [`polygon`](Self::polygon): its
    /// corners are round, and its faces a radius farther out. Two points make a [`capsule`](Self::capsule).
    ///
    /// It is moved so that its centre of mass is the origin of the body's frame; [`Rounded::centroid_of_input`] tells where that
    /// was.
    ///
    /// # Errors
    ///
    /// Refuses what [`polygon`](Self::polygon) refuses, except for two points, and a radius outside [`MIN_SIZE`] to
    /// [`MAX_SIZE`].
    ///
    /// ```
    /// use rustycs::shape::{Shape, ShapeError};
    ///
    /// // A square of 1 m with corners of 10 cm.
    /// let tile = Shape::rounded([[0.1, 0.1], [0.9, 0.1], [0.9, 0.9], [0.1, 0.9]], 0.1)?;
    /// assert!((tile.area() - (1.0 - 0.04 + std::f32::consts::PI * 0.01)).abs() < 1e-6);
    /// # Ok::<(), ShapeError>(())
    /// ```
    pub fn rounded<P: Into<Vec2>>(
        points: impl IntoIterator<Item = P>,
        radius: f32,
    ) -> Result<Self, ShapeError> {
        check("radius", radius)?;
        polygon::rounded(points, radius).map(Self::Rounded)
    }

    /// A segment: the line from `a` to `b`, m, without thickness, and solid on both sides. It has no mass, so that only
    /// fixed and kinematic bodies can be made of it. Fixed ones that meet end to end, or are flush with boxes, do not catch what slides
    /// over them; ground of many is a [`Ground::chain`](crate::Ground::chain) as a rule.
    ///
    /// It is moved so that its middle is the origin of the body's frame; [`Segment::centroid_of_input`] tells where that was.
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// let mut world = World::new(Settings::default());
    /// world.add_force(Force::EARTH_GRAVITY);
    /// world.add(Body::fixed(Shape::segment([-5.0, 0.0], [5.0, 0.0])))?;
    /// let crate_ = world.add(Body::dynamic(Shape::rectangle(1.0, 1.0)).at([0.0, 0.5]))?;
    /// for _ in 0..60 {
    ///     world.step();
    /// }
    /// assert!((world.body(crate_).unwrap().position().y - 0.5).abs() < 1e-3);
    /// # Ok::<(), BodyError>(())
    /// ```
    pub fn segment(a: impl Into<Vec2>, b: impl Into<Vec2>) -> Self {
        Self::Segment(Segment::new(a.into(), b.into()))
    }

    /// Whether the shape can be simulated.
    ///
    /// # Errors
    ///
    /// Names the first length that is not finite or outside [`MIN_SIZE`] to [`MAX_SIZE`], or the end of a capsule or segment that is not finite.
    pub fn validate(&self) -> Result<(), ShapeError> {
        match self {
            Self::Circle(circle) => check("radius", circle.radius()),
            Self::Aabb(rectangle) | Self::Obb(rectangle) => {
                check("width", rectangle.width()).and_then(|()| check("height", rectangle.height()))
            }
            Self::Polygon(_) => check("polygon's thickness", self.thickness())
                .and_then(|()| check("polygon's size", self.extent())),
            Self::Rounded(rounded) => check("radius", rounded.radius()).and_then(|()| {
                let what = if rounded.is_capsule() { "capsule's length" } else { "polygon's size" };
                let across = 2.0 * rounded.core().extent();
                check_ends("capsule", rounded.core())?;
                check(what, across).and_then(|()| check(what, across + 2.0 * rounded.radius()))
            }),
            Self::Segment(segment) => check_ends("segment", segment.core())
                .and_then(|()| check("segment's length", segment.length())),
        }
    }

    /// The smallest box with sides parallel to the axes that holds the shape at `pose`, rounded outward.
    pub fn bounding_box(&self, pose: Pose) -> Aabb {
        let rotation = self.rotation_at(pose.rotation);
        let (low, high) = match self {
            Self::Circle(circle) => (-Vec2::splat(circle.radius), Vec2::splat(circle.radius)),
            Self::Aabb(rectangle) => (-rectangle.half, rectangle.half),
            Self::Obb(rectangle) => {
                let (h, c, s) = (rectangle.half, rotation.c.abs(), rotation.s.abs());
                let half = Vec2::new(c * h.x + s * h.y, s * h.x + c * h.y);
                (-half, half)
            }
            Self::Polygon(polygon) => bounds_of(polygon.vertices(), rotation),
            Self::Segment(segment) => bounds_of(segment.vertices(), rotation),
            Self::Rounded(rounded) => {
                let (low, high) = bounds_of(rounded.vertices(), rotation);
                let radius = Vec2::splat(rounded.radius());
                (low - radius, high + radius)
            }
        };
        // Turning a corner rounds three times, each by at most half an epsilon of its distance. Not turned, the
        // corner is exact; adding a radius rounds once.
        let is_exact = !matches!(self, Self::Rounded(_)) && rotation == Rot::IDENTITY;
        let size = (high.x - low.x) + (high.y - low.y);
        let slack = Vec2::splat(if is_exact { 0.0 } else { 2.0 * f32::EPSILON * size });
        Aabb::around(pose.center, low - slack, high + slack)
    }

    /// Greatest distance of the outline from the centre, m.
    pub fn extent(&self) -> f32 {
        match self {
            Self::Circle(circle) => circle.radius,
            Self::Aabb(rectangle) | Self::Obb(rectangle) => rectangle.half.length(),
            Self::Polygon(polygon) => polygon.hull.extent(),
            Self::Rounded(rounded) => rounded.core().extent() + rounded.radius(),
            Self::Segment(segment) => segment.core().extent(),
        }
    }

    /// Smallest width across, m; the diameter of a circle, 0 for a segment.
    pub fn thickness(&self) -> f32 {
        match self {
            Self::Circle(circle) => 2.0 * circle.radius,
            Self::Aabb(rectangle) | Self::Obb(rectangle) => 2.0 * rectangle.half.x.min(rectangle.half.y),
            Self::Polygon(polygon) => polygon.hull.thickness(),
            Self::Rounded(rounded) => rounded.core().thickness() + 2.0 * rounded.radius(),
            Self::Segment(_) => 0.0,
        }
    }

    /// The width by which it is judged how deep an overlap with the shape is, m: its thickness. A segment has none, and leaves it to
    /// what it meets: its is infinite.
    pub(crate) fn width_of_overlaps(&self) -> f32 {
        if self.is_segment() { f32::INFINITY } else { self.thickness() }
    }

    /// The same of two shapes, m: that of the thinner; 0 for two segments.
    pub(crate) fn width_between(&self, other: &Self) -> f32 {
        let thinner = self.width_of_overlaps().min(other.width_of_overlaps());
        if thinner.is_finite() { thinner } else { 0.0 }
    }

    /// Whether the shape has no thickness.
    pub(crate) fn is_segment(&self) -> bool {
        matches!(self, Self::Segment(_))
    }

    /// What a link of a chain knows of its neighbours; `None` for all else.
    pub(crate) fn link(&self) -> Option<Link> {
        match self {
            Self::Segment(segment) => segment.link(),
            _ => None,
        }
    }

    /// Whether the shape turns with its body: all do but [`Shape::Aabb`].
    #[inline(always)]
    pub fn can_rotate(&self) -> bool {
        !matches!(self, Self::Aabb(_))
    }

    /// The radius of a circle, m; `None` for the others.
    pub fn radius(&self) -> Option<f32> {
        match self {
            Self::Circle(circle) => Some(circle.radius),
            _ => None,
        }
    }

    /// Where the centre was among the points that a shape was made from, m; the middle for circles and boxes.
    pub(crate) fn place_of_input(&self) -> Vec2 {
        match self {
            Self::Polygon(polygon) => polygon.centroid_of_input(),
            Self::Rounded(rounded) => rounded.centroid_of_input(),
            Self::Segment(segment) => segment.centroid_of_input(),
            Self::Circle(_) | Self::Aabb(_) | Self::Obb(_) => Vec2::ZERO,
        }
    }

    /// The corners in the body's frame, m, counter-clockwise; none for a circle. Of what is rounded, those of its core: the
    /// centres of the round corners.
    pub fn vertices(&self) -> &[Vec2] {
        self.core().map_or(&[], |(hull, _)| hull.vertices())
    }

    /// Radius of the corners, m: 0 where they are sharp, and that of a circle.
    pub fn corner_radius(&self) -> f32 {
        match self {
            Self::Circle(circle) => circle.radius,
            Self::Aabb(_) | Self::Obb(_) | Self::Polygon(_) | Self::Segment(_) => 0.0,
            Self::Rounded(rounded) => rounded.radius(),
        }
    }

    /// Greatest distance of what the shape is a radius away from, from the centre, m: how far out it is not round.
    pub(crate) fn core_extent(&self) -> f32 {
        match self {
            Self::Circle(_) => 0.0,
            Self::Aabb(_) | Self::Obb(_) | Self::Polygon(_) | Self::Segment(_) => self.extent(),
            Self::Rounded(rounded) => rounded.core().extent(),
        }
    }

    /// What a shape is a radius around, with the radius, m: 0 for boxes, polygons and segments; `None` for a circle.
    #[inline(always)]
    pub(crate) fn core(&self) -> Option<(&Hull, f32)> {
        match self {
            Self::Rounded(rounded) => Some((rounded.core(), rounded.radius())),
            _ => self.hull().map(|hull| (hull, 0.0)),
        }
    }

    /// The outline of boxes, polygons and segments, which have no radius.
    #[inline(always)]
    pub(crate) fn hull(&self) -> Option<&Hull> {
        match self {
            Self::Circle(_) | Self::Rounded(_) => None,
            Self::Aabb(rectangle) | Self::Obb(rectangle) => Some(&rectangle.hull),
            Self::Polygon(polygon) => Some(&polygon.hull),
            Self::Segment(segment) => Some(segment.core()),
        }
    }
}

/// Whether a length is one that shapes may have.
fn check(what: &'static str, value: f32) -> Result<(), ShapeError> {
    // NaN is in no range.
    if (MIN_SIZE..=MAX_SIZE).contains(&value) { Ok(()) } else { Err(ShapeError::Size { what, value }) }
}

/// Whether the ends of a line are places. The corners of a polygon have been checked.
fn check_ends(what: &'static str, line: &Hull) -> Result<(), ShapeError> {
    match line.vertices().iter().position(|end| !end.is_finite()) {
        Some(index) => Err(ShapeError::EndNotFinite { what, index, point: line.vertices()[index].into() }),
        None => Ok(()),
    }
}

/// The lower left and the upper right corner of the box around some corners, turned.
fn bounds_of(vertices: &[Vec2], rotation: Rot) -> (Vec2, Vec2) {
    let (mut low, mut high) = (Vec2::splat(f32::INFINITY), Vec2::splat(f32::NEG_INFINITY));
    for &vertex in vertices {
        let turned = rotation.rotate(vertex);
        (low, high) = (low.min(turned), high.max(turned));
    }
    (low, high)
}
