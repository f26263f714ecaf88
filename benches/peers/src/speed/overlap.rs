//! How far bodies are in each other, from their outlines and poses alone, in `f64`: no engine has a part in it.

use crate::engine::State;
use crate::scene::{Kind, Outline, Scene};

/// Overlaps of a scene, m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Overlap {
    /// The largest of all.
    pub(super) deepest: f64,
    /// The mean over the dynamic bodies of the largest that each has.
    pub(super) mean: f64,
}

/// An outline where it is.
struct Placed {
    center: [f64; 2],
    /// 0 for polygons.
    radius: f64,
    /// Counter-clockwise; empty for circles.
    corners: Vec<[f64; 2]>,
    /// Least and largest coordinates.
    bounds: [[f64; 2]; 2],
    is_dynamic: bool,
}

/// All overlaps, by a sweep along x.
pub(super) fn overlap(scene: &Scene, state: impl Fn(usize) -> State) -> Overlap {
    let mut placed: Vec<Placed> = scene
        .bodies
        .iter()
        .enumerate()
        .map(|(index, body)| place(&body.outline, body.kind == Kind::Dynamic, state(index)))
        .collect();
    placed.sort_by(|one, other| one.bounds[0][0].total_cmp(&other.bounds[0][0]));
    let mut largest = vec![0.0_f64; placed.len()];
    for (i, one) in placed.iter().enumerate() {
        for (j, other) in placed.iter().enumerate().skip(i + 1) {
            if other.bounds[0][0] > one.bounds[1][0] {
                break;
            }
            let is_apart = other.bounds[0][1] > one.bounds[1][1] || one.bounds[0][1] > other.bounds[1][1];
            if is_apart || !(one.is_dynamic || other.is_dynamic) {
                continue;
            }
            let depth = -separation(one, other);
            largest[i] = largest[i].max(depth);
            largest[j] = largest[j].max(depth);
        }
    }
    let of_dynamic =
        || placed.iter().zip(&largest).filter(|(body, _)| body.is_dynamic).map(|(_, depth)| *depth);
    Overlap {
        deepest: of_dynamic().fold(0.0, f64::max),
        mean: of_dynamic().sum::<f64>() / of_dynamic().count().max(1) as f64,
    }
}

fn place(outline: &Outline, is_dynamic: bool, State { position, angle, .. }: State) -> Placed {
    let (sin, cos) = angle.sin_cos();
    let turned = |[x, y]: [f64; 2]| [position[0] + cos * x - sin * y, position[1] + sin * x + cos * y];
    let (radius, corners) = match outline {
        Outline::Circle { radius } => (*radius, Vec::new()),
        Outline::Box { width, height } => {
            let [w, h] = [0.5 * width, 0.5 * height];
            (0.0, [[-w, -h], [w, -h], [w, h], [-w, h]].map(turned).into())
        }
        Outline::Polygon(corners) => (0.0, corners.iter().copied().map(turned).collect()),
    };
    let points = if corners.is_empty() { vec![position] } else { corners.clone() };
    let least = |axis: usize| points.iter().map(|point| point[axis]).fold(f64::INFINITY, f64::min) - radius;
    let most = |axis: usize| points.iter().map(|point| point[axis]).fold(-f64::INFINITY, f64::max) + radius;
    let bounds = [[least(0), least(1)], [most(0), most(1)]];
    Placed { center: position, radius, corners, bounds, is_dynamic }
}

/// Distance, m, where they are apart (at most; corners may be further apart), and less than 0 where they overlap: by
/// how much one would have to be moved.
fn separation(one: &Placed, other: &Placed) -> f64 {
    match (one.corners.is_empty(), other.corners.is_empty()) {
        (true, true) => {
            let [x, y] = [other.center[0] - one.center[0], other.center[1] - one.center[1]];
            x.hypot(y) - one.radius - other.radius
        }
        (false, true) => from_polygon(&one.corners, other.center) - other.radius,
        (true, false) => from_polygon(&other.corners, one.center) - one.radius,
        // Convex outlines part soonest along the normal of a side of one of them.
        (false, false) => {
            along_normals(&one.corners, &other.corners).max(along_normals(&other.corners, &one.corners))
        }
    }
}

/// Sides of a polygon: a corner and the unit normal outward.
fn sides(corners: &[[f64; 2]]) -> impl Iterator<Item = ([f64; 2], [f64; 2], [f64; 2])> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(&[x, y], &[u, v])| {
        let length = (u - x).hypot(v - y);
        ([x, y], [u, v], [(v - y) / length, (x - u) / length])
    })
}

fn along_normals(corners: &[[f64; 2]], points: &[[f64; 2]]) -> f64 {
    sides(corners)
        .map(|(from, _, normal)| {
            let above = |p: &[f64; 2]| (p[0] - from[0]) * normal[0] + (p[1] - from[1]) * normal[1];
            points.iter().map(above).fold(f64::INFINITY, f64::min)
        })
        .fold(-f64::INFINITY, f64::max)
}

/// Distance of a point from a polygon, less than 0 within.
fn from_polygon(corners: &[[f64; 2]], point: [f64; 2]) -> f64 {
    let within = along_normals(corners, &[point]);
    if within <= 0.0 {
        return within;
    }
    sides(corners)
        .map(|(from, to, _)| {
            let side = [to[0] - from[0], to[1] - from[1]];
            let offset = [point[0] - from[0], point[1] - from[1]];
            let part = (offset[0] * side[0] + offset[1] * side[1]) / (side[0] * side[0] + side[1] * side[1]);
            let part = part.clamp(0.0, 1.0);
            (offset[0] - part * side[0]).hypot(offset[1] - part * side[1])
        })
        .fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::BodySpec;

    /// Overlap of two bodies, the second this far to the right and turned.
    fn of_two(one: Outline, other: Outline, right: f64, angle: f64) -> Overlap {
        let bodies = [one, other].map(|outline| BodySpec::new(Kind::Dynamic, outline)).into();
        let scene = Scene { bodies, ..Scene::default() };
        let state = |index: usize| State {
            position: [right * index as f64, 0.0],
            angle: angle * index as f64,
            ..State::default()
        };
        overlap(&scene, state)
    }

    #[test]
    fn overlaps_are_those_of_plane_geometry() {
        let unit = || Outline::Box { width: 1.0, height: 1.0 };
        let disc = || Outline::Circle { radius: 0.5 };
        let half_diagonal = 0.5_f64.sqrt();
        for (one, other, right, angle, expected) in [
            (unit(), unit(), 0.9, 0.0, 0.1),
            (unit(), unit(), 1.1, 0.0, 0.0),
            (unit(), unit(), 1.1, std::f64::consts::FRAC_PI_4, half_diagonal - 0.6),
            (disc(), disc(), 0.75, 0.3, 0.25),
            (unit(), disc(), 0.8, 0.0, 0.2),
            (disc(), unit(), 1.01, 0.0, 0.0),
            // The corner of the turned box comes to 0.1 m before the rim.
            (disc(), unit(), 0.4 + half_diagonal, std::f64::consts::FRAC_PI_4, 0.1),
        ] {
            let found = of_two(one, other, right, angle);
            assert!((found.deepest - expected).abs() < 1e-12, "{found:?}, expected {expected}");
            assert!((found.mean - expected).abs() < 1e-12, "{found:?}, expected {expected}");
        }
    }
}
