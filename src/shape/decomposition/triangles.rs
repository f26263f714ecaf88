//! Cuts an area into triangles, and makes these as little thin as may be.
//!
//! Monotone parts are cut from left to right: what was passed and is not cut off yet is a chain that bends inward, of which each
//! next point cuts off what it sees (M. Garey et al., 1978). Then the diagonals of pairs of triangles are exchanged until no
//! corner lies in the circle around a neighbour (C. Lawson, 1977). Pieces made of thin triangles would be thin.

use core::cmp::Ordering;

use crate::math::Vec2;
use crate::shape::decomposition::crossings::is_before;
use crate::shape::decomposition::orientation::turn;
use crate::shape::decomposition::rings::Node;

/// One side of a triangle.
pub(super) type Side = usize;

/// Triangles, counter-clockwise: triangle t has the sides 3 t, 3 t + 1 and 3 t + 2.
#[derive(Debug, Default)]
pub(super) struct Triangles {
    /// Where each side begins, by its index in `points`.
    pub(super) starts: Vec<usize>,
    /// The side of the neighbour that runs along each side, the other way.
    pub(super) twins: Vec<Option<Side>>,
    pub(super) points: Vec<Vec2>,
}

/// The side of the same triangle that follows.
pub(super) fn next_of(side: Side) -> Side {
    if side % 3 == 2 { side - 2 } else { side + 1 }
}

/// A corner lies in the circle of a neighbour if it does by more than this share of what is computed, no unit: less is rounding,
/// and either diagonal as good as the other.
const ON_CIRCLE: f64 = 1e-9;

/// Most exchanges for each side. Few sides are exchanged more than twice.
const MOST_EXCHANGES: usize = 32;

impl Triangles {
    /// Triangles of monotone parts. The points of copied nodes are those of their originals.
    pub(super) fn new(nodes: &[Node]) -> Self {
        let mut triangles = Self::default();
        let mut is_done = vec![false; nodes.len()];
        for first in 0..nodes.len() {
            let (mut part, mut here) = (Vec::new(), first);
            while !is_done[here] {
                is_done[here] = true;
                part.push(nodes[here].point);
                here = nodes[here].next;
            }
            if part.len() >= 3 {
                triangles.add_monotone(&part);
            }
        }
        triangles.weld();
        triangles.find_twins();
        triangles.exchange_diagonals();
        triangles
    }

    fn push(&mut self, corners: [Vec2; 3]) {
        for corner in corners {
            self.starts.push(self.points.len());
            self.points.push(corner);
        }
    }

    /// Cuts a part that is counter-clockwise and monotone.
    fn add_monotone(&mut self, part: &[Vec2]) {
        let count = part.len();
        let order = |one: &usize, other: &usize| {
            let [a, b] = [part[*one], part[*other]];
            if is_before(a, b) { Ordering::Less } else { Ordering::Greater }
        };
        let first = (0..count).min_by(order).unwrap_or(0);
        // Both chains from the first point, the lower one along the way.
        let (mut low, mut high) = ((first + 1) % count, (first + count - 1) % count);
        let mut chain = vec![(part[first], true)];
        for left in (1..count).rev() {
            let is_low = left == 1 || is_before(part[low], part[high]);
            let point = if is_low { part[low] } else { part[high] };
            if is_low {
                low = (low + 1) % count;
            } else {
                high = (high + count - 1) % count;
            }
            // The last point ends both chains: it sees all that is left.
            let last_is_low = chain.last().is_some_and(|&(_, is_low)| is_low);
            if chain.len() > 1 && (left == 1 || last_is_low != is_low) {
                self.cut_fan(&mut chain, point, last_is_low);
            } else {
                self.cut_ears(&mut chain, point, is_low);
            }
            chain.push((point, is_low));
        }
    }

    /// Cuts off the triangles between a point and the whole chain, which is below or above it.
    fn cut_fan(&mut self, chain: &mut Vec<(Vec2, bool)>, point: Vec2, chain_is_low: bool) {
        for pair in chain.windows(2) {
            let [(a, _), (b, _)] = [pair[0], pair[1]];
            self.push(if chain_is_low { [a, b, point] } else { [b, a, point] });
        }
        chain.drain(..chain.len() - 1);
    }

    /// Cuts off the corners of the chain that bend outward now that a point is added.
    fn cut_ears(&mut self, chain: &mut Vec<(Vec2, bool)>, point: Vec2, is_low: bool) {
        let outward = if is_low { Ordering::Greater } else { Ordering::Less };
        while let [.., (a, _), (b, _)] = chain[..] {
            if turn(a, b, point) != outward {
                break;
            }
            self.push(if is_low { [a, b, point] } else { [b, a, point] });
            chain.pop();
        }
    }

    /// Gives equal points one index.
    fn weld(&mut self) {
        let place = |point: Vec2| (point.x, point.y);
        let mut order: Vec<usize> = (0..self.points.len()).collect();
        let compare = |one: &usize, other: &usize| {
            let [one, other] = [*one, *other].map(|index| place(self.points[index]));
            one.partial_cmp(&other).unwrap_or(Ordering::Equal)
        };
        order.sort_by(compare);
        let mut points: Vec<Vec2> = Vec::new();
        for index in order {
            let point = self.points[index];
            if points.last() != Some(&point) {
                points.push(point);
            }
            self.starts[index] = points.len() - 1;
        }
        self.points = points;
    }

    fn end_of(&self, side: Side) -> usize {
        self.starts[next_of(side)]
    }

    fn find_twins(&mut self) {
        let ends = |side: Side| {
            let [start, end] = [self.starts[side], self.end_of(side)];
            [start.min(end), start.max(end)]
        };
        let mut order: Vec<Side> = (0..self.starts.len()).collect();
        order.sort_by_key(|&side| ends(side));
        let mut twins = vec![None; self.starts.len()];
        for pair in order.windows(2) {
            if ends(pair[0]) == ends(pair[1]) {
                (twins[pair[0]], twins[pair[1]]) = (Some(pair[1]), Some(pair[0]));
            }
        }
        self.twins = twins;
    }

    fn exchange_diagonals(&mut self) {
        let mut waiting: Vec<Side> = (0..self.starts.len()).collect();
        let mut left = MOST_EXCHANGES * self.starts.len();
        while let Some(side) = waiting.pop() {
            if left == 0 {
                return;
            }
            if let Some(twin) = self.twins[side]
                && self.is_better_exchanged(side, twin)
            {
                self.exchange(side, twin);
                left -= 1;
                let around = [side, twin].map(|side| [side, next_of(side), next_of(next_of(side))]);
                waiting.extend(around.into_iter().flatten());
            }
        }
    }

    /// The corners of two triangles that share a diagonal, from its start on counter-clockwise: the third is its end.
    fn corners_around(&self, side: Side, twin: Side) -> [usize; 4] {
        let opposite = |side: Side| self.starts[next_of(next_of(side))];
        [self.starts[side], opposite(twin), self.starts[twin], opposite(side)]
    }

    /// Whether the other diagonal can be drawn, and the corner across lies in the circle around the triangle.
    fn is_better_exchanged(&self, side: Side, twin: Side) -> bool {
        let [a, d, b, c] = self.corners_around(side, twin).map(|index| self.points[index]);
        let is_convex = turn(c, a, d) == Ordering::Greater && turn(d, b, c) == Ordering::Greater;
        is_convex && is_in_circle([a, b, c], d)
    }

    /// Exchanges a diagonal from a to b for one from d to c. Of the triangle a, b, c becomes d, b, c, of b, a, d becomes c, a, d.
    fn exchange(&mut self, side: Side, twin: Side) {
        let [_, d, _, c] = self.corners_around(side, twin);
        let (c_to_a, d_to_b) = (next_of(next_of(side)), next_of(next_of(twin)));
        let [outside_a, outside_b] = [c_to_a, d_to_b].map(|side| self.twins[side]);
        // The sides from b to c and from a to d stay where they are.
        self.starts[side] = d;
        self.starts[twin] = c;
        self.join(side, outside_b);
        self.join(twin, outside_a);
        self.join(c_to_a, Some(d_to_b));
    }

    /// Has two sides be twins.
    fn join(&mut self, side: Side, twin: Option<Side>) {
        self.twins[side] = twin;
        if let Some(twin) = twin {
            self.twins[twin] = Some(side);
        }
    }
}

/// Whether d lies in the circle around the triangle a, b, c, which is counter-clockwise, and not just by rounding.
fn is_in_circle(corners: [Vec2; 3], d: Vec2) -> bool {
    let [a, b, c] = corners.map(|point| {
        let (x, y) = (f64::from(point.x) - f64::from(d.x), f64::from(point.y) - f64::from(d.y));
        [x, y, x * x + y * y]
    });
    let cross =
        |p: [f64; 3], q: [f64; 3]| (p[0] * q[1] - p[1] * q[0], (p[0] * q[1]).abs() + (p[1] * q[0]).abs());
    let terms = [(a, cross(b, c)), (b, cross(c, a)), (c, cross(a, b))];
    let determinant: f64 = terms.iter().map(|(p, (cross, _))| p[2] * cross).sum();
    let size: f64 = terms.iter().map(|(p, (_, size))| p[2] * size).sum();
    determinant > ON_CIRCLE * size
}
