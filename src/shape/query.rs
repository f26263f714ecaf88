//! Questions to one shape: does it hold a point, where does a ray meet it.
//!
//! Not part of the step. All of it is computed in `f64` and only the answer rounded, so that a hit is where
//! the outline is, also for a ray from afar, and equal shapes in one place are hit at equal fractions.

use crate::math::{Point, Pose, Rot, Vec2};
use crate::shape::hull::Hull;
use crate::shape::{Rounded, Shape};

/// Where a ray first meets the outline of a shape.
///
/// ```
/// use rustycs::prelude::*;
///
/// let wall = Shape::rectangle(1.0, 4.0);
/// let hit = wall.ray_cast(Pose::at([5.0, 0.0]), [0.0, 0.0], [9.0, 0.0], 1.0).unwrap();
/// assert!((hit.fraction - 4.5 / 9.0).abs() < 1e-6);
/// assert_eq!(hit.normal, Vec2::new(-1.0, 0.0)); // light that comes from the left is thrown back to the left
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct OutlineHit {
    /// Part of the ray's translation up to the outline; 0 where the ray starts inside.
    pub fraction: f32,
    /// Outward unit normal of the outline there; zero where the ray starts inside.
    pub normal: Vec2,
}

impl Shape {
    /// Whether the shape at `pose` holds `place`, border included. `Shape::Aabb` ignores the rotation.
    pub fn contains(&self, pose: Pose, place: impl Into<Point>) -> bool {
        self.contains_local(self.place_in_body(pose, place.into()))
    }

    /// Where the ray from `origin` along `translation`, m, first meets the outline of the shape at `pose`, if
    /// it does within `max_fraction` of the translation.
    ///
    /// A ray that starts inside, border included, hits at fraction 0 with a zero normal. One that runs along a segment passes.
    pub fn ray_cast(
        &self,
        pose: Pose,
        origin: impl Into<Point>,
        translation: impl Into<Vec2>,
        max_fraction: f32,
    ) -> Option<OutlineHit> {
        let rotation = self.rotation_at(pose.rotation);
        let start = self.place_in_body(pose, origin.into());
        let hit = if self.contains_local(start) {
            OutlineHit { fraction: 0.0, normal: Vec2::ZERO }
        } else {
            let along = unrotate(rotation, widen(translation.into()));
            match self {
                Self::Circle(circle) => ray_circle(f64::from(circle.radius()), start, along)?,
                Self::Aabb(rectangle) | Self::Obb(rectangle) => ray_hull(&rectangle.hull, start, along)?,
                Self::Polygon(polygon) => ray_hull(&polygon.hull, start, along)?,
                Self::Rounded(rounded) => ray_rounded(rounded, start, along)?,
                Self::Segment(segment) => ray_edges(segment.core(), 0.0, start, along)?,
            }
        };
        (hit.fraction <= max_fraction).then(|| OutlineHit { normal: rotation.rotate(hit.normal), ..hit })
    }

    /// The point of the shape at `pose` that is nearest to `place`, m: `place` itself where the shape holds it.
    pub fn closest_point(&self, pose: Pose, place: impl Into<Point>) -> Point {
        let place = place.into();
        let (x, y) = self.place_in_body(pose, place);
        if self.contains_local((x, y)) {
            return place;
        }
        let (x, y) = match self {
            Self::Circle(circle) => {
                let scale = f64::from(circle.radius()) / (x * x + y * y).sqrt();
                (x * scale, y * scale)
            }
            Self::Aabb(rectangle) | Self::Obb(rectangle) => closest_on_hull(&rectangle.hull, (x, y)),
            Self::Polygon(polygon) => closest_on_hull(&polygon.hull, (x, y)),
            Self::Segment(segment) => closest_on_hull(segment.core(), (x, y)),
            Self::Rounded(rounded) => {
                let (near_x, near_y) = closest_on_hull(rounded.core(), (x, y));
                let (away_x, away_y) = (x - near_x, y - near_y);
                let part = f64::from(rounded.radius()) / (away_x * away_x + away_y * away_y).sqrt();
                (near_x + part * away_x, near_y + part * away_y)
            }
        };
        let (x, y) = unrotate(self.rotation_at(pose.rotation).inverse(), (x, y));
        [pose.center.x + x, pose.center.y + y].into()
    }

    /// The rotation that the shape takes on in a body turned by `rotation`: none for `Shape::Aabb`.
    #[inline(always)]
    pub(crate) fn rotation_at(&self, rotation: Rot) -> Rot {
        if self.can_rotate() { rotation } else { Rot::IDENTITY }
    }

    fn place_in_body(&self, pose: Pose, place: Point) -> (f64, f64) {
        let offset = (place.x - pose.center.x, place.y - pose.center.y);
        unrotate(self.rotation_at(pose.rotation), offset)
    }

    fn contains_local(&self, (x, y): (f64, f64)) -> bool {
        let hull_contains = |hull: &Hull| {
            (0..hull.count as usize).all(|i| {
                let (start_x, start_y) = widen(hull.vertices[i]);
                let (end_x, end_y) = widen(hull.vertices[hull.next(i)]);
                (end_x - start_x) * (y - start_y) - (end_y - start_y) * (x - start_x) >= 0.0
            })
        };
        match self {
            Self::Circle(circle) => {
                let radius = f64::from(circle.radius());
                x * x + y * y <= radius * radius
            }
            Self::Aabb(rectangle) | Self::Obb(rectangle) => {
                let (half_x, half_y) = widen(rectangle.half_size());
                x.abs() <= half_x && y.abs() <= half_y
            }
            Self::Polygon(polygon) => hull_contains(&polygon.hull),
            Self::Segment(segment) => closest_on_hull(segment.core(), (x, y)) == (x, y),
            Self::Rounded(rounded) => {
                let core = rounded.core();
                let (near_x, near_y) = closest_on_hull(core, (x, y));
                let (away_x, away_y) = (x - near_x, y - near_y);
                let radius = f64::from(rounded.radius());
                away_x * away_x + away_y * away_y <= radius * radius
                    || !core.is_segment() && hull_contains(core)
            }
        }
    }
}

fn widen(v: Vec2) -> (f64, f64) {
    (f64::from(v.x), f64::from(v.y))
}

/// The vector that `rotation` turns into `v`: divided by c² + s², which is 1 only to rounding and would move
/// what is seen from afar.
fn unrotate(rotation: Rot, (x, y): (f64, f64)) -> (f64, f64) {
    let (c, s) = (f64::from(rotation.c), f64::from(rotation.s));
    let scale = 1.0 / (c * c + s * s);
    ((c * x + s * y) * scale, (c * y - s * x) * scale)
}

/// The nearest point of a hull's outline.
fn closest_on_hull(hull: &Hull, (x, y): (f64, f64)) -> (f64, f64) {
    let on_edge = |index: usize| {
        let (start, end) = (widen(hull.vertices[index]), widen(hull.vertices[hull.next(index)]));
        let edge = (end.0 - start.0, end.1 - start.1);
        let along = (x - start.0) * edge.0 + (y - start.1) * edge.1;
        let part = (along / (edge.0 * edge.0 + edge.1 * edge.1)).clamp(0.0, 1.0);
        (start.0 + part * edge.0, start.1 + part * edge.1)
    };
    let distance = |point: (f64, f64)| (point.0 - x).powi(2) + (point.1 - y).powi(2);
    let nearer = |one, other| if distance(other) < distance(one) { other } else { one };
    (1..hull.count as usize).map(on_edge).fold(on_edge(0), nearer)
}

/// |start + f·along|² = r²: the smaller root, where the ray comes in.
fn ray_circle(radius: f64, start: (f64, f64), along: (f64, f64)) -> Option<OutlineHit> {
    let a = along.0 * along.0 + along.1 * along.1;
    let b = start.0 * along.0 + start.1 * along.1;
    // The line's distance from the centre by a cross product: no difference of large squares.
    let cross = start.0 * along.1 - start.1 * along.0;
    let discriminant = radius * radius * a - cross * cross;
    // b < 0: the ray comes nearer. This also refuses a ray of no length, and NaN.
    if !(b < 0.0 && discriminant >= 0.0) {
        return None;
    }
    let fraction = (-b - discriminant.sqrt()) / a;
    let (x, y) = (start.0 + fraction * along.0, start.1 + fraction * along.1);
    let normal = Vec2::new((x / radius) as f32, (y / radius) as f32);
    Some(OutlineHit { fraction: fraction as f32, normal })
}

/// What is round a core is the discs round its corners and the strips before its edges: the ray comes in where it first comes into
/// one of them.
fn ray_rounded(rounded: &Rounded, start: (f64, f64), along: (f64, f64)) -> Option<OutlineHit> {
    let (core, radius) = (rounded.core(), f64::from(rounded.radius()));
    let round = core.vertices().iter().filter_map(|&vertex| {
        let (x, y) = widen(vertex);
        ray_circle(radius, (start.0 - x, start.1 - y), along)
    });
    let straight = ray_edges(core, radius, start, along);
    round.chain(straight).min_by(|one, other| one.fraction.total_cmp(&other.fraction))
}

/// Where the ray first meets the edges of a core, moved out by a radius, from the front.
fn ray_edges(core: &Hull, radius: f64, start: (f64, f64), along: (f64, f64)) -> Option<OutlineHit> {
    let edges = (0..core.count as usize).filter_map(|edge| {
        let (from, to, (n_x, n_y)) =
            (widen(core.vertices[edge]), widen(core.vertices[core.next(edge)]), widen(core.normals[edge]));
        let gap = n_x * (start.0 - from.0) + n_y * (start.1 - from.1) - radius;
        let speed = n_x * along.0 + n_y * along.1;
        // Where it is before the edge, and comes nearer; NaN is nowhere.
        let fraction = if gap >= 0.0 && speed < 0.0 { gap / -speed } else { return None };
        let (x, y) = (start.0 + fraction * along.0, start.1 + fraction * along.1);
        let edge_along = (to.0 - from.0, to.1 - from.1);
        let part = (x - from.0) * edge_along.0 + (y - from.1) * edge_along.1;
        let squared = edge_along.0 * edge_along.0 + edge_along.1 * edge_along.1;
        let normal = core.normals[edge];
        (0.0..=squared).contains(&part).then_some(OutlineHit { fraction: fraction as f32, normal })
    });
    edges.min_by(|one, other| one.fraction.total_cmp(&other.fraction))
}

/// The ray enters the hull where it has crossed the last of the lines it comes in by, unless it has then
/// already left by another (M. Cyrus and J. Beck, 1978).
fn ray_hull(hull: &Hull, start: (f64, f64), along: (f64, f64)) -> Option<OutlineHit> {
    let (mut enter, mut leave, mut normal) = (f64::NEG_INFINITY, f64::INFINITY, None);
    for i in 0..hull.count as usize {
        let (n_x, n_y) = widen(hull.normals[i]);
        let (v_x, v_y) = widen(hull.vertices[i]);
        let gap = n_x * (start.0 - v_x) + n_y * (start.1 - v_y);
        let speed = n_x * along.0 + n_y * along.1;
        if speed < 0.0 {
            let crossing = gap / -speed;
            if crossing > enter {
                (enter, normal) = (crossing, Some(hull.normals[i]));
            }
        } else if speed > 0.0 {
            leave = leave.min(gap / -speed);
        } else if gap > 0.0 {
            return None;
        }
    }
    (0.0 <= enter && enter <= leave).then_some(OutlineHit { fraction: enter as f32, normal: normal? })
}
