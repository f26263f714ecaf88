//! How deep bodies are in each other, from their outlines and states alone: in `f64`, by separating axes. No engine has
//! a part in it.

use crate::engine::State;
use crate::scene::{BodySpec, Kind, Outline};

/// Overlaps of a scene, m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Overlap {
    /// The deepest of all.
    pub deepest: f64,
    /// The mean over the dynamic bodies of the deepest that each has.
    pub mean: f64,
}

/// Where the corners of a body are, counter-clockwise, m; none for a circle.
#[must_use]
pub fn corners(outline: &Outline, state: &State) -> Vec<[f64; 2]> {
    let (sin, cos) = state.angle.sin_cos();
    let [x, y] = state.position;
    let place = |&[u, v]: &[f64; 2]| [x + cos * u - sin * v, y + sin * u + cos * v];
    match outline {
        Outline::Circle { .. } => Vec::new(),
        Outline::Box { width, height } => {
            let (u, v) = (0.5 * width, 0.5 * height);
            [[-u, -v], [u, -v], [u, v], [-u, v]].iter().map(place).collect()
        }
        Outline::Polygon(corners) => corners.iter().map(place).collect(),
    }
}

/// A body in its place.
struct Placed {
    center: [f64; 2],
    /// Of a circle; 0 for polygons.
    radius: f64,
    /// Counter-clockwise; empty for circles.
    corners: Vec<[f64; 2]>,
    is_dynamic: bool,
    /// From and to, along x and along y.
    bounds: [[f64; 2]; 2],
}

impl Placed {
    fn new(spec: &BodySpec, state: &State) -> Self {
        let corners = corners(&spec.outline, state);
        let radius = if let Outline::Circle { radius } = spec.outline { radius } else { 0.0 };
        let bounds = [0, 1].map(|axis| {
            let center = state.position[axis];
            let ends = corners.iter().map(|corner| corner[axis]);
            match radius {
                0.0 => [ends.clone().fold(f64::INFINITY, f64::min), ends.fold(f64::NEG_INFINITY, f64::max)],
                radius => [center - radius, center + radius],
            }
        });
        Self { center: state.position, radius, corners, is_dynamic: spec.kind == Kind::Dynamic, bounds }
    }

    /// Largest distance of a point from the edges of the polygon, negative within it, m.
    fn outside(&self, point: [f64; 2]) -> f64 {
        edges(&self.corners)
            .map(|(from, normal)| along(normal, from, point))
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// Distance of a point from the polygon, negative within it, m.
    fn distance(&self, point: [f64; 2]) -> f64 {
        let outside = self.outside(point);
        if outside <= 0.0 {
            return outside;
        }
        let ends = self.corners.iter().zip(self.corners.iter().cycle().skip(1));
        ends.map(|(&from, &to)| distance_to_segment(from, to, point)).fold(f64::INFINITY, f64::min)
    }

    /// Largest gap to another polygon along the normals of this one, negative if there is none, m.
    fn gap(&self, other: &Self) -> f64 {
        let nearest = |(from, normal): ([f64; 2], [f64; 2])| {
            other.corners.iter().map(|&corner| along(normal, from, corner)).fold(f64::INFINITY, f64::min)
        };
        edges(&self.corners).map(nearest).fold(f64::NEG_INFINITY, f64::max)
    }

    /// By how much one of the two would have to be moved until they part, m; less than 0 where they are apart.
    fn depth(&self, other: &Self) -> f64 {
        let separation = match (self.corners.is_empty(), other.corners.is_empty()) {
            (true, true) => {
                let [x, y] = [0, 1].map(|axis| self.center[axis] - other.center[axis]);
                x.hypot(y) - (self.radius + other.radius)
            }
            (true, false) => other.distance(self.center) - self.radius,
            (false, true) => self.distance(other.center) - other.radius,
            // Convex outlines part soonest along the normal of an edge of one of them.
            (false, false) => self.gap(other).max(other.gap(self)),
        };
        -separation
    }
}

/// A point of each edge, and its normal outwards.
fn edges(corners: &[[f64; 2]]) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(&from, &to)| {
        let [x, y] = [to[0] - from[0], to[1] - from[1]];
        let length = x.hypot(y);
        (from, [y / length, -x / length])
    })
}

fn along(normal: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    normal[0] * (to[0] - from[0]) + normal[1] * (to[1] - from[1])
}

fn distance_to_segment(from: [f64; 2], to: [f64; 2], point: [f64; 2]) -> f64 {
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    let part = (((point[0] - from[0]) * x + (point[1] - from[1]) * y) / (x * x + y * y)).clamp(0.0, 1.0);
    (point[0] - from[0] - part * x).hypot(point[1] - from[1] - part * y)
}

/// The overlaps of pairs of bodies, one of them dynamic at least, by a sweep along x: 0 where there are none, and no
/// numbers if some state is none.
#[must_use]
pub fn overlap(bodies: &[BodySpec], states: &[State]) -> Overlap {
    let mut placed: Vec<Placed> =
        bodies.iter().zip(states).map(|(spec, state)| Placed::new(spec, state)).collect();
    if placed.iter().any(|body| !body.bounds.as_flattened().iter().all(|end| end.is_finite())) {
        return Overlap { deepest: f64::NAN, mean: f64::NAN };
    }
    placed.sort_by(|one, other| one.bounds[0][0].total_cmp(&other.bounds[0][0]));
    // The deepest that each has.
    let mut deepest = vec![0.0_f64; placed.len()];
    // What may reach the next ones, from left to right.
    let mut open: Vec<usize> = Vec::new();
    for (index, body) in placed.iter().enumerate() {
        open.retain(|&other| placed[other].bounds[0][1] > body.bounds[0][0]);
        for &at in &open {
            let other = &placed[at];
            let meets = other.bounds[1][0] < body.bounds[1][1] && body.bounds[1][0] < other.bounds[1][1];
            if meets && (body.is_dynamic || other.is_dynamic) {
                let depth = body.depth(other);
                deepest[index] = deepest[index].max(depth);
                deepest[at] = deepest[at].max(depth);
            }
        }
        open.push(index);
    }
    let of_dynamic = placed.iter().zip(deepest).filter(|(body, _)| body.is_dynamic).map(|(_, depth)| depth);
    let of_dynamic: Vec<f64> = of_dynamic.collect();
    Overlap {
        deepest: of_dynamic.iter().copied().fold(0.0, f64::max),
        mean: of_dynamic.iter().sum::<f64>() / of_dynamic.len().max(1) as f64,
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_4;

    use super::*;
    use crate::scene::{block, disc, rectangle};

    fn of(bodies: &[BodySpec]) -> Overlap {
        let state =
            |spec: &BodySpec| State { position: spec.position, angle: spec.angle, ..State::default() };
        overlap(bodies, &bodies.iter().map(state).collect::<Vec<_>>())
    }

    fn at(x: f64, y: f64, spec: BodySpec) -> BodySpec {
        BodySpec { position: [x, y], ..spec }
    }

    fn near(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-12, "{found}, expected {expected}");
    }

    #[test]
    fn overlaps_are_those_of_plane_geometry() {
        let (cube, turned) = (rectangle(1.0, 1.0), BodySpec { angle: FRAC_PI_4, ..rectangle(1.0, 1.0) });
        let half_diagonal = 0.5_f64.sqrt();
        for (one, other, expected) in [
            (disc(1.0), at(1.5, 0.0, disc(1.0)), 0.5),
            (disc(1.0), at(2.5, 0.0, disc(1.0)), 0.0),
            (cube.clone(), at(0.9, 0.3, cube.clone()), 0.1),
            (cube.clone(), at(1.1, 0.0, cube.clone()), 0.0),
            // A box on its corner: half its diagonal reaches out.
            (cube.clone(), at(1.1, 0.0, turned.clone()), half_diagonal - 0.6),
            (block(4.0, 1.0), at(0.0, 1.2, turned.clone()), 0.5 + half_diagonal - 1.2),
            // From the side of a box, off its corner, and a corner that comes to 0.1 m before the rim.
            (cube.clone(), at(0.8, 0.0, disc(0.5)), 0.2),
            (disc(0.5), at(1.01, 0.0, cube.clone()), 0.0),
            (cube.clone(), at(0.8, 0.9, disc(0.6)), 0.1),
            (cube.clone(), at(0.9, 0.9, disc(0.5)), 0.0),
            (disc(0.5), at(0.4 + half_diagonal, 0.0, turned), 0.1),
            // The centre of the disc is 0.2 m within the box.
            (cube.clone(), at(0.3, 0.1, disc(0.5)), 0.7),
        ] {
            for found in [of(&[one.clone(), other.clone()]), of(&[other, one])] {
                near(found.deepest, expected);
            }
        }
    }

    #[test]
    fn the_mean_is_that_of_the_deepest_of_each_dynamic_body() {
        // Overlaps of 0.1 m and 0.3 m in a row: the one in the middle has both, the fixed one does not count.
        let row = [block(1.0, 1.0), at(0.9, 0.0, rectangle(1.0, 1.0)), at(1.6, 0.0, rectangle(1.0, 1.0))];
        let found = of(&row);
        near(found.deepest, 0.3);
        near(found.mean, 0.3);
        let found = of(&[row[0].clone(), row[1].clone(), at(9.0, 0.0, disc(1.0))]);
        near(found.deepest, 0.1);
        near(found.mean, 0.05);
        assert_eq!(of(&[block(1.0, 1.0), at(0.5, 0.0, block(1.0, 1.0))]), Overlap::default());
    }

    #[test]
    fn what_is_no_number_is_not_passed_over() {
        let found = of(&[disc(1.0), at(f64::NAN, 0.0, disc(1.0))]);
        assert!(found.deepest.is_nan() && found.mean.is_nan());
    }
}
