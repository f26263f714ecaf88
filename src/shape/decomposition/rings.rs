//! The rings that bound an area, an outline and its holes: checked, and turned so that the area is on their left.

use core::cmp::Ordering;

use crate::math::Vec2;
use crate::shape::decomposition::crossings::{first_crossing, first_repeat};
use crate::shape::decomposition::orientation::turn;
use crate::shape::{MAX_SIZE, MIN_SIZE, Ring, RingPlace, ShapeError};

/// Most points of an outline with its holes. More are refused, so that an endless iterator ends.
pub const MAX_OUTLINE_POINTS: usize = 65_536;

/// An area is refused whose mean width is below this share of its size, no unit: of a convex polygon that thin all points
/// are on a line.
const THINNEST: f64 = 1e-5;

/// A point of a ring, and its neighbours around the area, which lies on the left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) point: Vec2,
    pub(super) previous: usize,
    pub(super) next: usize,
}

/// One ring as it was given, without what it means.
struct Given {
    ring: Ring,
    points: Vec<Vec2>,
}

/// The outline first, then the holes: each as a circle of nodes, that of the outline counter-clockwise, those of holes clockwise.
/// Points on the straight line between their neighbours are left out.
pub(super) fn rings_of(outline: Vec<Vec2>, holes: Vec<Vec<Vec2>>) -> Result<Vec<Node>, ShapeError> {
    let outline = Given { ring: Ring::Outline, points: outline };
    let holes = holes.into_iter().enumerate();
    let holes = holes.map(|(index, points)| Given { ring: Ring::Hole(index), points });
    let mut rings: Vec<Given> = std::iter::once(outline).chain(holes).collect();
    check_points(&rings)?;
    let edges = edges_of(&rings);
    if let Some(error) = first_repeat(&edges).or_else(|| first_crossing(&edges)) {
        return Err(error);
    }
    check_areas(&rings)?;
    check_holes(&rings)?;
    let mut nodes = Vec::new();
    for Given { ring, points } in &mut rings {
        if (doubled_area(points) > 0.0) != (*ring == Ring::Outline) {
            points.reverse();
        }
        let corners = without_straight(points);
        let (first, count) = (nodes.len(), corners.len());
        nodes.extend(corners.into_iter().enumerate().map(|(index, point)| Node {
            point,
            previous: first + (index + count - 1) % count,
            next: first + (index + 1) % count,
        }));
    }
    Ok(nodes)
}

/// An edge of a ring, from the point of its place to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub(super) place: RingPlace,
    /// The number of points in its ring.
    pub(super) count: usize,
    pub(super) start: Vec2,
    pub(super) end: Vec2,
}

fn edges_of(rings: &[Given]) -> Vec<Edge> {
    let of_ring = |given: &Given| {
        let (ring, count) = (given.ring, given.points.len());
        let ends = given.points.iter().zip(given.points.iter().cycle().skip(1)).enumerate();
        let edges = ends.map(move |(index, (&start, &end))| Edge {
            place: RingPlace { ring, index },
            count,
            start,
            end,
        });
        edges.collect::<Vec<_>>()
    };
    rings.iter().flat_map(of_ring).collect()
}

fn check_points(rings: &[Given]) -> Result<(), ShapeError> {
    let count = rings.iter().map(|given| given.points.len()).sum();
    if count > MAX_OUTLINE_POINTS {
        return Err(ShapeError::OutlineTooLong { count });
    }
    for &Given { ring, ref points } in rings {
        if let Some(index) = points.iter().position(|point| !point.is_finite()) {
            let place = RingPlace { ring, index };
            return Err(ShapeError::OutlineNotFinite { place, point: points[index].into() });
        }
        if points.len() < 3 {
            return Err(ShapeError::OutlineTooShort { ring, count: points.len() });
        }
    }
    let size = f64::from(size_of(&rings[0].points));
    if !(f64::from(MIN_SIZE)..=f64::from(MAX_SIZE)).contains(&size) {
        return Err(ShapeError::Size { what: "outline's size", value: size as f32 });
    }
    Ok(())
}

/// Larger side of the bounding box, m.
fn size_of(points: &[Vec2]) -> f32 {
    let (low, high) = points
        .iter()
        .fold((Vec2::splat(f32::INFINITY), Vec2::splat(f32::NEG_INFINITY)), |(low, high), &point| {
            (low.min(point), high.max(point))
        });
    (high.x - low.x).max(high.y - low.y)
}

/// Twice the signed area, m²: positive counter-clockwise. Counted from the first point, so that it has all its digits far away, and
/// the edge that ends there adds nothing.
fn doubled_area(points: &[Vec2]) -> f64 {
    let from_first = |point: Vec2| {
        [f64::from(point.x) - f64::from(points[0].x), f64::from(point.y) - f64::from(points[0].y)]
    };
    let cross = |pair: &[Vec2]| {
        let [[ax, ay], [bx, by]] = [pair[0], pair[1]].map(from_first);
        ax * by - ay * bx
    };
    points.windows(2).map(cross).sum()
}

fn check_areas(rings: &[Given]) -> Result<(), ShapeError> {
    let mut left = 0.0;
    for &Given { ring, ref points } in rings {
        let (area, size) = (0.5 * doubled_area(points).abs(), f64::from(size_of(points)));
        if !(area > THINNEST * size * size) {
            return Err(ShapeError::OutlineTooSmall { ring, area: area as f32 });
        }
        left += if ring == Ring::Outline { area } else { -area };
    }
    let size = f64::from(size_of(&rings[0].points));
    if left > THINNEST * size * size {
        Ok(())
    } else {
        Err(ShapeError::OutlineTooSmall { ring: Ring::Outline, area: left as f32 })
    }
}

/// Checks that each hole is in the outline, and none in another: no edges cross, so that one point tells.
fn check_holes(rings: &[Given]) -> Result<(), ShapeError> {
    let (outline, holes) = (&rings[0], &rings[1..]);
    for (index, hole) in holes.iter().enumerate() {
        if !holds(&outline.points, hole.points[0]) {
            return Err(ShapeError::HoleOutside { hole: index });
        }
        let mut others = holes.iter().enumerate().filter(|&(other, _)| other != index);
        if let Some((other, _)) = others.find(|(_, other)| holds(&other.points, hole.points[0])) {
            return Err(ShapeError::HoleInHole { hole: index, other });
        }
    }
    Ok(())
}

/// Whether a ring goes round a point that is not on it: whether a ray to the right crosses it an odd number of times.
fn holds(ring: &[Vec2], point: Vec2) -> bool {
    let crosses = |&(&start, &end): &(&Vec2, &Vec2)| {
        let (low, high) = if start.y < end.y { (start, end) } else { (end, start) };
        low.y <= point.y && point.y < high.y && turn(low, high, point) == Ordering::Greater
    };
    ring.iter().zip(ring.iter().cycle().skip(1)).filter(crosses).count() % 2 == 1
}

/// The points that are corners.
fn without_straight(points: &[Vec2]) -> Vec<Vec2> {
    let count = points.len();
    let is_corner = |index: &usize| {
        let (before, after) = (points[(index + count - 1) % count], points[(index + 1) % count]);
        turn(before, points[*index], after) != Ordering::Equal
    };
    (0..count).filter(is_corner).map(|index| points[index]).collect()
}
