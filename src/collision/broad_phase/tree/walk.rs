//! Walks through the tree: which leaves meet a box, which meet a ray, all nodes for an overlay.
//!
//! A walk keeps the pairs of siblings it has still to look at in an array of fixed size. Going depth first it
//! holds at most one pair more than the tree is high, and the bound on imbalance keeps that below
//! [`STACK`] for any number of leaves that a `u32` can count.

use super::{ROOT, Tree};
use crate::math::{Aabb, Point, Reach, Vec2};

/// Pairs a walk can put off: 2.47·log₂(2³¹ leaves) + 4 = 81 levels at most.
pub(super) const STACK: usize = 84;

/// By how much a fraction of a ray is stretched before it is compared with another: the difference and the
/// product that make it round, so it is off by up to 4·2⁻⁵³ of itself. Signs and zeros are exact.
const STRETCH: f64 = 1.0 + 1.0 / (1_u64 << 49) as f64;

/// Places put off, last in first out.
struct Pending {
    pairs: [u32; STACK],
    len: usize,
}

impl Pending {
    #[inline(always)]
    fn new() -> Self {
        Self { pairs: [0; STACK], len: 0 }
    }

    #[inline(always)]
    fn push(&mut self, pair: u32) {
        debug_assert!(self.len < STACK, "the tree is higher than its balance allows");
        self.pairs[self.len] = pair;
        self.len += 1;
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<u32> {
        self.len = self.len.checked_sub(1)?;
        Some(self.pairs[self.len])
    }
}

impl Tree {
    /// Calls `visit` with the value of each leaf whose box meets `aabb`, until it returns false.
    /// Returns false if it did.
    #[inline]
    pub(crate) fn query(&self, aabb: Aabb, mut visit: impl FnMut(u32) -> bool) -> bool {
        let opposite = Reach::from(aabb).opposite();
        let mut pending = Pending::new();
        // The root has no sibling; the box beside it is nowhere and meets nothing.
        pending.push(ROOT);
        while let Some(pair) = pending.pop() {
            for node in self.pair(pair) {
                if !node.reach.meets(opposite) {
                    continue;
                }
                if !node.is_leaf() {
                    pending.push(node.link);
                } else if !visit(node.value) {
                    return false;
                }
            }
        }
        true
    }

    /// Calls `visit` with the value of each leaf whose box meets the segment from `origin` to
    /// `origin + max_fraction · translation`, about from near to far, and with the fraction the segment ends
    /// at by now. `visit` returns the same fraction to go on, a smaller one to clip the segment, 0 to stop.
    /// Returns the last fraction.
    ///
    /// No leaf that the segment touches is missed, wherever in the world it is; a leaf past it by less than
    /// the rounding of `f64` may be visited.
    ///
    /// With a `reach` above 0, m, all leaves whose box is within that of the segment along both axes.
    pub(crate) fn cast(
        &self,
        origin: Point,
        reach: f32,
        translation: Vec2,
        max_fraction: f32,
        mut visit: impl FnMut(u32, f32) -> f32,
    ) -> f32 {
        let ray = Ray::new(origin, reach, translation);
        let mut end = max_fraction;
        let mut pending = Pending::new();
        pending.push(ROOT);
        while let Some(pair) = pending.pop() {
            let [a, b] = self.pair(pair);
            let (enter_a, enter_b) = (ray.enter(a.reach.aabb()), ray.enter(b.reach.aabb()));
            // None < Some, so a box that is missed comes first and is passed over.
            let (near, far) =
                if enter_b < enter_a { ((b, enter_b), (a, enter_a)) } else { ((a, enter_a), (b, enter_b)) };
            let is_before =
                |enter: Option<f64>, end: f32| enter.is_some_and(|at| at <= f64::from(end) * STRETCH);
            for (node, enter) in [near, far] {
                if node.is_leaf() && is_before(enter, end) {
                    end = end.min(visit(node.value, end));
                    if end <= 0.0 {
                        return end;
                    }
                }
            }
            for (node, enter) in [far, near] {
                if !node.is_leaf() && is_before(enter, end) {
                    pending.push(node.link);
                }
            }
        }
        end
    }

    /// Calls `visit` with the value of each leaf whose box is not farther from a place than the `limit` of then, m, about from
    /// near to far. `visit` returns that, or a smaller one. Returns the last.
    pub(crate) fn nearest(&self, place: Point, limit: f64, mut visit: impl FnMut(u32, f64) -> f64) -> f64 {
        let mut limit = limit.min(f64::MAX);
        let mut pending = Pending::new();
        pending.push(ROOT);
        while let Some(pair) = pending.pop() {
            let nodes = self.pair(pair);
            let distances = [0, 1].map(|index| distance_to(nodes[index].reach.aabb(), place));
            let near = usize::from(distances[1] < distances[0]);
            for index in [near, 1 - near] {
                if nodes[index].is_leaf() && distances[index] <= limit {
                    limit = limit.min(visit(nodes[index].value, limit));
                }
            }
            for index in [1 - near, near] {
                if !nodes[index].is_leaf() && distances[index] <= limit {
                    pending.push(nodes[index].link);
                }
            }
        }
        limit
    }

    /// Calls `visit(box, depth, is_leaf)` for every node, the root at depth 0.
    pub(crate) fn for_each_node(&self, mut visit: impl FnMut(Aabb, u32, bool)) {
        if self.len() == 0 {
            return;
        }
        let mut pending = vec![(ROOT, 0)];
        while let Some((place, depth)) = pending.pop() {
            let node = self.node(place);
            visit(node.reach.aabb(), depth, node.is_leaf());
            if !node.is_leaf() {
                pending.extend([(node.link + 1, depth + 1), (node.link, depth + 1)]);
            }
        }
    }
}

/// How far a place is from a box, m, or a little less; 0 within it. A box that is nowhere is infinitely far.
fn distance_to(aabb: Aabb, place: Point) -> f64 {
    if aabb.min.x.is_nan() {
        return f64::INFINITY;
    }
    let beyond = |min: f32, at: f64, max: f32| (f64::from(min) - at).max(at - f64::from(max)).max(0.0);
    let (x, y) = (beyond(aabb.min.x, place.x, aabb.max.x), beyond(aabb.min.y, place.y, aabb.max.y));
    // Less what rounds: one digit of each term and of the root.
    (x * x + y * y).sqrt() * (1.0 - 4.0 * f64::EPSILON)
}

/// A ray in `f64`, ready for boxes in `f32`.
struct Ray {
    origin: [f64; 2],
    /// By how much boxes are grown on each side, m.
    reach: f64,
    /// 1 / translation, infinite along an axis the ray does not move on.
    inverse: [f64; 2],
}

impl Ray {
    fn new(origin: Point, reach: f32, translation: Vec2) -> Self {
        // What grows rounds by a digit of where the box is, which is met from where the ray is.
        let far = origin.x.abs() + origin.y.abs() + f64::from(translation.norm_1());
        let noise = if reach == 0.0 { 0.0 } else { 4.0 * f64::EPSILON * (far + f64::from(reach)) };
        Self {
            origin: [origin.x, origin.y],
            reach: f64::from(reach) + noise,
            inverse: [1.0 / f64::from(translation.x), 1.0 / f64::from(translation.y)],
        }
    }

    /// The fraction at which the ray enters a box, negative where it begins inside; `None` if it misses it.
    #[inline(always)]
    fn enter(&self, aabb: Aabb) -> Option<f64> {
        let (enter_x, exit_x) = self.span(0, aabb.min.x, aabb.max.x);
        let (enter_y, exit_y) = self.span(1, aabb.min.y, aabb.max.y);
        let (enter, exit) = (enter_x.max(enter_y), exit_x.min(exit_y));
        (enter <= exit * STRETCH && exit >= 0.0).then_some(enter)
    }

    /// Between which fractions the ray is between two coordinates of an axis.
    #[inline(always)]
    fn span(&self, axis: usize, min: f32, max: f32) -> (f64, f64) {
        let (min, max) = (f64::from(min) - self.reach, f64::from(max) + self.reach);
        if self.inverse[axis].is_infinite() {
            let is_between = min <= self.origin[axis] && self.origin[axis] <= max;
            let inside = if is_between { f64::INFINITY } else { f64::NEG_INFINITY };
            return (-inside, inside);
        }
        let to_min = (min - self.origin[axis]) * self.inverse[axis];
        let to_max = (max - self.origin[axis]) * self.inverse[axis];
        if self.inverse[axis] < 0.0 { (to_max, to_min) } else { (to_min, to_max) }
    }
}
