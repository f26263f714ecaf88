//! Shapes: the geometry of a body, about its centre of mass.
//!
//! Circle, two kinds of box, and convex polygons, of which concave outlines are made up. Constructors of circles and boxes take any number;
//! [`Shape::validate`] checks them once, when the body enters the world, so that nothing in the step has to.
//! What is precomputed here (corners, edge normals) is what detection reads at every step.

mod decomposition;
mod error;
mod exposure;
mod hull;
mod mass;
mod polygon;
mod query;
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

pub(crate) use exposure::{Exposure, Neighbour};
pub(crate) use hull::Hull;

use crate::math::{Aabb, Pose, Vec2};

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
}

/// A disc.
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

    /// Whether the shape can be simulated.
    ///
    /// # Errors
    ///
    /// Names the first length that is not finite or outside [`MIN_SIZE`] to [`MAX_SIZE`].
    pub fn validate(&self) -> Result<(), ShapeError> {
        let check = |what, value: f32| {
            // NaN is in no range.
            if (MIN_SIZE..=MAX_SIZE).contains(&value) {
                Ok(())
            } else {
                Err(ShapeError::Size { what, value })
            }
        };
        match self {
            Self::Circle(circle) => check("radius", circle.radius()),
            Self::Aabb(rectangle) | Self::Obb(rectangle) => {
                check("width", rectangle.width()).and_then(|()| check("height", rectangle.height()))
            }
            Self::Polygon(_) => check("polygon's thickness", self.thickness())
                .and_then(|()| check("polygon's size", self.extent())),
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
            Self::Polygon(polygon) => {
                let (mut low, mut high) = (Vec2::splat(f32::INFINITY), Vec2::splat(f32::NEG_INFINITY));
                for &vertex in polygon.vertices() {
                    let turned = rotation.rotate(vertex);
                    (low, high) = (low.min(turned), high.max(turned));
                }
                (low, high)
            }
        };
        // Turning a corner rounds three times, each by at most half an epsilon of its distance. Not turned, the
        // corner is exact.
        let is_turned = rotation.s != 0.0 || rotation.c != 1.0;
        let size = (high.x - low.x) + (high.y - low.y);
        let slack = Vec2::splat(if is_turned { 2.0 * f32::EPSILON * size } else { 0.0 });
        Aabb::around(pose.center, low - slack, high + slack)
    }

    /// Greatest distance of the outline from the centre, m.
    pub fn extent(&self) -> f32 {
        match self {
            Self::Circle(circle) => circle.radius,
            Self::Aabb(rectangle) | Self::Obb(rectangle) => rectangle.half.length(),
            Self::Polygon(polygon) => polygon.hull.extent(),
        }
    }

    /// Smallest width across, m; the diameter of a circle.
    pub fn thickness(&self) -> f32 {
        match self {
            Self::Circle(circle) => 2.0 * circle.radius,
            Self::Aabb(rectangle) | Self::Obb(rectangle) => 2.0 * rectangle.half.x.min(rectangle.half.y),
            Self::Polygon(polygon) => polygon.hull.thickness(),
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

    /// Where the centre of a polygon was among the points that it was made from, m; the middle for the others.
    pub(crate) fn place_of_input(&self) -> Vec2 {
        match self {
            Self::Polygon(polygon) => polygon.centroid_of_input(),
            _ => Vec2::ZERO,
        }
    }

    /// The corners in the body's frame, m, counter-clockwise; none for a circle.
    pub fn vertices(&self) -> &[Vec2] {
        self.hull().map_or(&[], Hull::vertices)
    }

    /// The outline of boxes and polygons.
    #[inline(always)]
    pub(crate) fn hull(&self) -> Option<&Hull> {
        match self {
            Self::Circle(_) => None,
            Self::Aabb(rectangle) | Self::Obb(rectangle) => Some(&rectangle.hull),
            Self::Polygon(polygon) => Some(&polygon.hull),
        }
    }
}
