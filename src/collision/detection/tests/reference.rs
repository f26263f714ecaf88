//! The slow twin: signed distance of two shapes from first principles, in `f64`.

use crate::math::{Rot, Vec2};
use crate::shape::Shape;

type V = [f64; 2];

fn sub(a: V, b: V) -> V {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn wide(v: Vec2) -> V {
    [f64::from(v.x), f64::from(v.y)]
}

/// A convex outline, or a point, with a skin of `radius` around it.
pub(super) struct Solid {
    corners: Vec<V>,
    radius: f64,
}

impl Solid {
    pub(super) fn new(shape: &Shape, rotation: Rot, offset: Vec2) -> Self {
        let rotation = if shape.can_rotate() { rotation } else { Rot::IDENTITY };
        let (c, s, at) = (f64::from(rotation.c), f64::from(rotation.s), wide(offset));
        let place = |v: &Vec2| {
            let [x, y] = wide(*v);
            [at[0] + c * x - s * y, at[1] + s * x + c * y]
        };
        let corners =
            if shape.radius().is_some() { vec![at] } else { shape.vertices().iter().map(place).collect() };
        Self { corners, radius: f64::from(shape.corner_radius()) }
    }

    pub(super) fn moved(&self, by: V) -> Self {
        let corners = self.corners.iter().map(|c| [c[0] + by[0], c[1] + by[1]]).collect();
        Self { corners, radius: self.radius }
    }

    fn edges(&self) -> impl Iterator<Item = (V, V)> + '_ {
        let n = self.corners.len();
        (0..n).map(move |i| (self.corners[i], self.corners[(i + 1) % n]))
    }

    /// Greatest reach along `normal`.
    fn support(&self, normal: V) -> f64 {
        self.corners.iter().map(|&c| dot(normal, c)).fold(f64::NEG_INFINITY, f64::max)
            + self.radius * dot(normal, normal).sqrt()
    }

    /// Least gap behind any line along an edge of `self`; none for a point.
    fn best_line(&self, other: &Self) -> f64 {
        let line = |(start, end): (V, V)| {
            let edge = sub(end, start);
            let length = dot(edge, edge).sqrt();
            let normal = [edge[1] / length, -edge[0] / length];
            other.corners.iter().map(|&c| dot(normal, sub(c, start))).fold(f64::INFINITY, f64::min)
        };
        if self.corners.len() < 2 {
            return f64::NEG_INFINITY;
        }
        self.edges().map(line).fold(f64::NEG_INFINITY, f64::max)
    }

    fn corner_to_edge(&self, other: &Self) -> f64 {
        let mut least = f64::INFINITY;
        for (start, end) in self.edges() {
            for &corner in &other.corners {
                least = least.min(point_to_segment(corner, start, end));
            }
        }
        least
    }

    /// Distance of a point from the outline, on either side of it.
    pub(super) fn distance_to_outline(&self, point: V) -> f64 {
        let core = self.edges().map(|(a, b)| point_to_segment(point, a, b)).fold(f64::INFINITY, f64::min);
        let is_left = |(a, b): (V, V)| {
            let (edge, to) = (sub(b, a), sub(point, a));
            edge[0] * to[1] - edge[1] * to[0] > 0.0
        };
        let is_inside = self.corners.len() > 2 && self.edges().all(is_left);
        (if is_inside { -core } else { core } - self.radius).abs()
    }
}

fn point_to_segment(point: V, start: V, end: V) -> f64 {
    let edge = sub(end, start);
    let squared = dot(edge, edge);
    let part = if squared > 0.0 { (dot(sub(point, start), edge) / squared).clamp(0.0, 1.0) } else { 0.0 };
    let away = sub(point, [start[0] + part * edge[0], start[1] + part * edge[1]]);
    dot(away, away).sqrt()
}

/// Overlapping: the least translation that parts the two, which is along the normal of an edge. Apart: the least
/// distance between a corner of one and an edge of the other.
pub(super) fn signed_distance(a: &Solid, b: &Solid) -> f64 {
    let line = a.best_line(b).max(b.best_line(a));
    let core =
        if line.is_finite() && line <= 0.0 { line } else { a.corner_to_edge(b).min(b.corner_to_edge(a)) };
    core - a.radius - b.radius
}

/// Gap between the two along a unit normal from a to b; at most the signed distance, and equal to it only along
/// the right normal.
pub(super) fn gap_along(a: &Solid, b: &Solid, normal: V) -> f64 {
    -b.support([-normal[0], -normal[1]]) - a.support(normal)
}
