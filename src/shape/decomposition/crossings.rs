//! Which edges cross or touch that should not.
//!
//! Edges are taken in the order in which they begin along one axis, and compared with those that have not ended there: the
//! axis is the one along which they are shorter. Every decision is exact.

use core::cmp::Ordering;

use crate::math::Vec2;
use crate::shape::ShapeError;
use crate::shape::decomposition::orientation::turn;
use crate::shape::decomposition::rings::Edge;

/// An edge with its box.
#[derive(Clone, Copy)]
struct Boxed {
    index: usize,
    /// Along the axis and across it, m.
    low: [f32; 2],
    high: [f32; 2],
}

/// The first point, by its number, that lies on one before it, if there is one.
pub(super) fn first_repeat(edges: &[Edge]) -> Option<ShapeError> {
    let mut order: Vec<usize> = (0..edges.len()).collect();
    let place = |index: &usize| (edges[*index].start.x, edges[*index].start.y);
    // What is equal stays in its order.
    order.sort_by(|one, other| place(one).partial_cmp(&place(other)).unwrap_or(Ordering::Equal));
    let repeats = order.windows(2).filter(|pair| place(&pair[0]) == place(&pair[1]));
    let first = repeats.min_by_key(|pair| pair[1])?;
    Some(ShapeError::OutlineRepeats { points: [edges[first[0]].place, edges[first[1]].place] })
}

/// What is wrong with the first two edges, by their numbers, that cross or touch, though no point is repeated; `None` where all is
/// well.
pub(super) fn first_crossing(edges: &[Edge]) -> Option<ShapeError> {
    let length = |axis: fn(Vec2) -> f32| {
        edges.iter().map(|edge| f64::from((axis(edge.end) - axis(edge.start)).abs())).sum::<f64>()
    };
    let is_along_x = length(|point| point.x) <= length(|point| point.y);
    let boxed = |(index, edge): (usize, &Edge)| {
        let (low, high) = (edge.start.min(edge.end), edge.start.max(edge.end));
        let [low, high] = [low, high].map(|p| if is_along_x { [p.x, p.y] } else { [p.y, p.x] });
        Boxed { index, low, high }
    };
    let mut boxes: Vec<Boxed> = edges.iter().enumerate().map(boxed).collect();
    boxes.sort_by(|one, other| one.low[0].total_cmp(&other.low[0]));
    let mut open: Vec<Boxed> = Vec::new();
    let mut first: Option<[usize; 2]> = None;
    for here in boxes {
        open.retain(|other| other.high[0] >= here.low[0]);
        for other in &open {
            if other.low[1] > here.high[1] || here.low[1] > other.high[1] {
                continue;
            }
            let pair = [here.index.min(other.index), here.index.max(other.index)];
            if first.is_none_or(|best| pair < best) && cross(edges[pair[0]], edges[pair[1]]) {
                first = Some(pair);
            }
        }
        open.push(here);
    }
    first.map(|pair| ShapeError::OutlineCrosses { edges: pair.map(|index| edges[index].place) })
}

/// Whether two edges share more than the point where one goes on as the other.
fn cross(a: Edge, b: Edge) -> bool {
    for (one, next) in [(a, b), (b, a)] {
        let is_of_one_ring = one.place.ring == next.place.ring;
        if is_of_one_ring && (one.place.index + 1) % one.count == next.place.index {
            // They run back over each other if both go the same way from the point that they share.
            let runs_back = is_before(one.start, next.start) == is_before(next.end, next.start);
            return runs_back && turn(one.start, next.start, next.end) == Ordering::Equal;
        }
    }
    touch(a, b)
}

/// Whether two edges share a point.
fn touch(a: Edge, b: Edge) -> bool {
    let sides =
        |of: Edge, points: Edge| [points.start, points.end].map(|point| turn(of.start, of.end, point));
    let (of_b, of_a) = (sides(a, b), sides(b, a));
    if of_b == [Ordering::Equal; 2] {
        // On one line: their boxes overlap.
        let (low, high) = (a.start.min(a.end), a.start.max(a.end));
        let (other_low, other_high) = (b.start.min(b.end), b.start.max(b.end));
        return low.x <= other_high.x
            && other_low.x <= high.x
            && low.y <= other_high.y
            && other_low.y <= high.y;
    }
    let are_apart = |[start, end]: [Ordering; 2]| start == end;
    !are_apart(of_b) && !are_apart(of_a)
}

/// The order of points on a line: from left to right, and from below where they are as far right.
pub(super) fn is_before(a: Vec2, b: Vec2) -> bool {
    (a.x, a.y) < (b.x, b.y)
}
