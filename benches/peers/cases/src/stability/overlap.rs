//! How deep bodies are in each other, from their states alone: in `f64`, by separating axes, without any engine.

use crate::engine::State;
use crate::scene::{BodySpec, Kind, Outline};
use crate::stability::run::worse;

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

/// A body in its place, relative to some origin near it.
struct Placed {
    center: [f64; 2],
    /// Of a circle; 0 for polygons.
    radius: f64,
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
        edges(&self.corners).map(|(from, normal)| along(normal, from, point)).fold(f64::NEG_INFINITY, worse)
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
        edges(&self.corners).map(nearest).fold(f64::NEG_INFINITY, worse)
    }

    fn overlap(&self, other: &Self) -> f64 {
        let separation = match (self.corners.is_empty(), other.corners.is_empty()) {
            (true, true) => {
                let [x, y] = [0, 1].map(|axis| self.center[axis] - other.center[axis]);
                x.hypot(y) - self.radius - other.radius
            }
            (true, false) => other.distance(self.center) - self.radius,
            (false, true) => self.distance(other.center) - other.radius,
            (false, false) => worse(self.gap(other), other.gap(self)),
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

/// Depth of the deepest overlap of two bodies, one of them dynamic at least, m; 0 if there is none, and no number if
/// some state is none.
pub(super) fn deepest(bodies: &[BodySpec], states: &[State]) -> f64 {
    let mut placed: Vec<Placed> =
        bodies.iter().zip(states).map(|(spec, state)| Placed::new(spec, state)).collect();
    if placed.iter().any(|body| !body.bounds.as_flattened().iter().all(|end| end.is_finite())) {
        return f64::NAN;
    }
    placed.sort_by(|one, other| one.bounds[0][0].total_cmp(&other.bounds[0][0]));
    let mut deepest = 0.0;
    // What may reach the next ones, from left to right.
    let mut open: Vec<usize> = Vec::new();
    for index in 0..placed.len() {
        let body = &placed[index];
        open.retain(|&other| placed[other].bounds[0][1] > body.bounds[0][0]);
        for &other in &open {
            let other = &placed[other];
            let meets = other.bounds[1][0] < body.bounds[1][1] && body.bounds[1][0] < other.bounds[1][1];
            if meets && (body.is_dynamic || other.is_dynamic) {
                deepest = worse(deepest, body.overlap(other));
            }
        }
        open.push(index);
    }
    deepest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{block, disc, rectangle};

    fn depth(one: BodySpec, other: BodySpec) -> f64 {
        let states: Vec<State> = [&one, &other]
            .iter()
            .map(|spec| State { position: spec.position, angle: spec.angle, ..State::default() })
            .collect();
        deepest(&[one, other], &states)
    }

    fn at(x: f64, y: f64, spec: BodySpec) -> BodySpec {
        BodySpec { position: [x, y], ..spec }
    }

    #[test]
    fn overlaps_are_those_of_the_drawing_board() {
        let near =
            |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        near(depth(disc(1.0), at(1.5, 0.0, disc(1.0))), 0.5);
        near(depth(disc(1.0), at(2.5, 0.0, disc(1.0))), 0.0);
        near(depth(rectangle(1.0, 1.0), at(0.9, 0.3, rectangle(1.0, 1.0))), 0.1);
        // A box on its corner: half its diagonal reaches down.
        let corner = BodySpec { angle: std::f64::consts::FRAC_PI_4, ..at(0.0, 1.2, rectangle(1.0, 1.0)) };
        near(depth(block(4.0, 1.0), corner), 0.5 + 0.5_f64.sqrt() - 1.2);
        near(depth(rectangle(1.0, 1.0), at(0.8, 0.0, disc(0.5))), 0.2);
        // Off the corner, by the corner's distance.
        near(depth(rectangle(1.0, 1.0), at(0.8, 0.9, disc(0.6))), 0.1);
        near(depth(rectangle(1.0, 1.0), at(0.9, 0.9, disc(0.5))), 0.0);
        near(depth(block(1.0, 1.0), at(0.5, 0.0, block(1.0, 1.0))), 0.0);
    }

    #[test]
    fn what_is_no_number_is_not_passed_over() {
        assert!(depth(disc(1.0), at(f64::NAN, 0.0, disc(1.0))).is_nan());
    }
}
