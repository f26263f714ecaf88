//! Convex polygons: checking, welding and centring what the user gives.

use crate::math::Vec2;
use crate::shape::hull::{Hull, MAX_VERTICES};
use crate::shape::{MAX_OUTLINE_POINTS, MAX_SIZE, MIN_SIZE, Rounded, ShapeError};

/// Points closer than this part of the polygon's size are one corner, and a point nearer than this to the
/// line of its neighbours is none. The rounding of `f32` coordinates is 6e-8 of the size: a bend of 1e-5 is
/// far above it, so that every corner kept still bends the right way after centring.
const WELD: f64 = 1e-5;

/// More points than this are refused: counted, but not looked at.
const MAX_GIVEN: usize = 256;

/// A convex polygon with 3 to 8 corners, about its centroid.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// let ramp = Shape::polygon([[0.0, 0.0], [6.0, 0.0], [6.0, 3.0]])?;
/// let Shape::Polygon(polygon) = ramp else { panic!() };
/// assert_eq!(polygon.centroid_of_input(), Vec2::new(4.0, 1.0));
/// // Where its points were given:
/// let ramp = world.add(Body::fixed(ramp).at(polygon.centroid_of_input()))?;
/// assert!(world.body(ramp).unwrap().contains([5.9, 2.9]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polygon {
    pub(super) hull: Hull,
    centroid_of_input: Vec2,
}

impl Polygon {
    /// Checks and centres the outline given by `points`; see [`Shape::polygon`](crate::shape::Shape::polygon).
    pub(super) fn new<P: Into<Vec2>>(points: impl IntoIterator<Item = P>) -> Result<Self, ShapeError> {
        let mut corners = distinct(points)?;
        check_outline(&mut corners)?;
        let (x, y) = centroid(&corners);
        let mut vertices = [Vec2::ZERO; MAX_VERTICES];
        for (vertex, corner) in vertices.iter_mut().zip(&corners) {
            *vertex = Vec2::new((corner.x - x) as f32, (corner.y - y) as f32);
        }
        let hull = Hull::new(&vertices[..corners.len()]);
        Ok(Self { hull, centroid_of_input: Vec2::new(x as f32, y as f32) })
    }

    /// The corners, m from the centroid, counter-clockwise.
    pub fn vertices(&self) -> &[Vec2] {
        self.hull.vertices()
    }

    /// Outward unit normals; the one at i belongs to the edge from vertex i to the next.
    pub fn normals(&self) -> &[Vec2] {
        self.hull.normals()
    }

    #[inline(always)]
    pub(crate) fn hull(&self) -> &Hull {
        &self.hull
    }

    /// Where the centroid was in the coordinates the polygon was made from, m. A body put there, not turned,
    /// has the polygon exactly where its points were given.
    pub fn centroid_of_input(&self) -> Vec2 {
        self.centroid_of_input
    }
}

/// All that is within `radius`, m, of the outline given by `points`; see [`Shape::rounded`](crate::shape::Shape::rounded).
pub(super) fn rounded<P: Into<Vec2>>(
    points: impl IntoIterator<Item = P>,
    radius: f32,
) -> Result<Rounded, ShapeError> {
    let mut corners = distinct(points)?;
    if let [a, b] = corners[..] {
        let [a, b] = [a, b].map(|corner| Vec2::new(corner.x as f32, corner.y as f32));
        let capsule = Rounded::capsule(a, b, radius);
        return crate::shape::Shape::Rounded(capsule).validate().map(|()| capsule);
    }
    check_outline(&mut corners)?;
    let corners: Vec<[f64; 2]> = corners.iter().map(|corner| [corner.x, corner.y]).collect();
    Ok(Rounded::polygon(&corners, radius))
}

/// The points of an outline as they are given, of which none is the next.
fn distinct<P: Into<Vec2>>(points: impl IntoIterator<Item = P>) -> Result<Vec<Corner>, ShapeError> {
    // An endless iterator ends.
    let mut points = points.into_iter().take(MAX_OUTLINE_POINTS + 1);
    let given: Vec<Vec2> = points.by_ref().take(MAX_GIVEN).map(Into::into).collect();
    let beyond = points.count();
    if beyond > 0 {
        return Err(ShapeError::TooManyPoints { count: given.len() + beyond });
    }
    if let Some(index) = given.iter().position(|p| !p.is_finite()) {
        return Err(ShapeError::NotFinite { index, point: given[index].into() });
    }
    let mut corners: Vec<Corner> = given.iter().enumerate().map(|(i, &p)| Corner::new(i, p)).collect();
    let size = size_of(&corners);
    weld_duplicates(&mut corners, WELD * size);
    Ok(corners)
}

/// Makes an outline one of 3 to 8 corners, convex and counter-clockwise, or says why it is none.
fn check_outline(corners: &mut Vec<Corner>) -> Result<(), ShapeError> {
    if corners.len() < 3 {
        return Err(ShapeError::TooFewPoints { count: corners.len() });
    }
    let size = size_of(corners);
    // Written so that a size in between, and only that, passes.
    if !(f64::from(MIN_SIZE)..=f64::from(MAX_SIZE)).contains(&size) {
        return Err(ShapeError::Size { what: "polygon's size", value: size as f32 });
    }
    if lie_on_a_line(corners, WELD * size) {
        return Err(ShapeError::Collinear);
    }
    weld_straight(corners, WELD * size)?;
    check_convex(corners)?;
    if corners.len() > MAX_VERTICES {
        return Err(ShapeError::TooManyPoints { count: corners.len() });
    }
    Ok(())
}

/// A point of the outline in `f64`, and where in the user's list it was.
#[derive(Clone, Copy)]
struct Corner {
    index: usize,
    x: f64,
    y: f64,
}

impl Corner {
    fn new(index: usize, point: Vec2) -> Self {
        Self { index, x: f64::from(point.x), y: f64::from(point.y) }
    }

    fn distance(self, other: Self) -> f64 {
        let (x, y) = (other.x - self.x, other.y - self.y);
        (x * x + y * y).sqrt()
    }

    /// Twice the signed area of the triangle: positive where `self`, `b`, `c` turn counter-clockwise.
    fn turn(self, b: Self, c: Self) -> f64 {
        (b.x - self.x) * (c.y - self.y) - (b.y - self.y) * (c.x - self.x)
    }

    /// Distance from the line through `a` and `b`, or from `a` where the two are one place.
    fn distance_to_line(self, a: Self, b: Self) -> f64 {
        let length = a.distance(b);
        if length > 0.0 { (a.turn(b, self) / length).abs() } else { self.distance(a) }
    }
}

/// Larger side of the bounding box, m.
fn size_of(corners: &[Corner]) -> f64 {
    let side = |coordinate: fn(&Corner) -> f64| {
        let high = corners.iter().map(coordinate).fold(f64::NEG_INFINITY, f64::max);
        let low = corners.iter().map(coordinate).fold(f64::INFINITY, f64::min);
        high - low
    };
    side(|c| c.x).max(side(|c| c.y))
}

/// Drops each point that lies on the one before it, around the end too.
fn weld_duplicates(corners: &mut Vec<Corner>, tolerance: f64) {
    corners.dedup_by(|next, kept| next.distance(*kept) <= tolerance);
    while corners.len() > 1 && corners[0].distance(corners[corners.len() - 1]) <= tolerance {
        corners.pop();
    }
}

/// Whether all of some points, m, lie on one line, to 1e-5 of their size.
pub(super) fn are_on_a_line(points: &[Vec2]) -> bool {
    let corners: Vec<Corner> = points.iter().enumerate().map(|(i, &p)| Corner::new(i, p)).collect();
    lie_on_a_line(&corners, WELD * size_of(&corners))
}

fn lie_on_a_line(corners: &[Corner], tolerance: f64) -> bool {
    let first = corners[0];
    let farthest = corners
        .iter()
        .fold(first, |best, &c| if first.distance(c) > first.distance(best) { c } else { best });
    corners.iter().all(|c| c.distance_to_line(first, farthest) <= tolerance)
}

/// Drops each point on the straight line between its neighbours; refuses an outline that runs back on itself.
fn weld_straight(corners: &mut Vec<Corner>, tolerance: f64) -> Result<(), ShapeError> {
    let mut i = 0;
    let mut straight_since = 0;
    while straight_since < corners.len() && corners.len() >= 3 {
        let n = corners.len();
        i %= n;
        let (before, here, after) = (corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]);
        if here.distance_to_line(before, after) > tolerance {
            straight_since += 1;
            i += 1;
            continue;
        }
        let onward = (here.x - before.x) * (after.x - here.x) + (here.y - before.y) * (after.y - here.y);
        if onward < 0.0 {
            return Err(ShapeError::Concave { index: here.index });
        }
        corners.remove(i);
        straight_since = 0;
        // The corner before has new neighbours: look at it again.
        i = (i + n - 1) % n;
    }
    if corners.len() < 3 { Err(ShapeError::Collinear) } else { Ok(()) }
}

/// Turns the outline counter-clockwise and refuses it unless every corner lies left of every edge.
///
/// That all corners turn the same way is not enough: those of a pentagram do.
fn check_convex(corners: &mut [Corner]) -> Result<(), ShapeError> {
    let n = corners.len();
    let doubled_area: f64 = (1..n - 1).map(|i| corners[0].turn(corners[i], corners[i + 1])).sum();
    if doubled_area < 0.0 {
        corners.reverse();
    }
    for i in 0..n {
        if corners[i].turn(corners[(i + 1) % n], corners[(i + 2) % n]) <= 0.0 {
            return Err(ShapeError::Concave { index: corners[(i + 1) % n].index });
        }
    }
    for i in 0..n {
        let (start, end) = (corners[i], corners[(i + 1) % n]);
        let others = (2..n).map(|k| corners[(i + k) % n]);
        if others.into_iter().any(|c| start.turn(end, c) <= 0.0) {
            return Err(ShapeError::SelfIntersecting);
        }
    }
    Ok(())
}

/// Centre of area: the centroids of the triangles of a fan, weighted by their areas.
fn centroid(corners: &[Corner]) -> (f64, f64) {
    let origin = corners[0];
    let (mut area, mut x, mut y) = (0.0, 0.0, 0.0);
    for pair in corners[1..].windows(2) {
        let (b, c) = (pair[0], pair[1]);
        let triangle = origin.turn(b, c);
        area += triangle;
        x += triangle * ((b.x - origin.x) + (c.x - origin.x)) / 3.0;
        y += triangle * ((b.y - origin.y) + (c.y - origin.y)) / 3.0;
    }
    (origin.x + x / area, origin.y + y / area)
}
