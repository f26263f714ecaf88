//! Cuts an area into parts that a line sweeps over without leaving them and coming back.
//!
//! A vertical line sweeps from left to right (M. de Berg et al., "Computational Geometry", 3.2; there from above). Points that
//! are as far right are taken from below, as if all were leaning by a trace, so that no edge is vertical. Of the edges that the
//! line meets those are kept that have the area above them, from below, each with the point that was met last between it and the
//! next edge above: its helper. What a point needs is a cut to a helper.

use core::cmp::Ordering;

use crate::math::Vec2;
use crate::shape::decomposition::crossings::is_before;
use crate::shape::decomposition::orientation::turn;
use crate::shape::decomposition::rings::Node;

/// An edge that the line meets, with the area above it.
#[derive(Clone, Copy, Debug)]
struct Floor {
    start: Vec2,
    end: Vec2,
    helper: usize,
    /// Whether two parts of the area have met at the helper, so that it needs a cut to the right.
    is_merge: bool,
}

/// The line, and the cuts so far.
struct Sweep<'a> {
    nodes: &'a [Node],
    /// From below.
    floors: Vec<Floor>,
    /// Pairs of nodes.
    cuts: Vec<[usize; 2]>,
}

/// Cuts an area into monotone parts: the nodes go round the parts then, of which there are more, as those at the ends of a cut
/// are in two parts.
pub(super) fn cut_into_monotone(nodes: &mut Vec<Node>) {
    let mut order: Vec<usize> = (0..nodes.len()).collect();
    order.sort_unstable_by(|&one, &other| {
        let [a, b] = [one, other].map(|index| nodes[index].point);
        (a.x, a.y).partial_cmp(&(b.x, b.y)).unwrap_or(Ordering::Equal)
    });
    let mut sweep = Sweep { nodes, floors: Vec::new(), cuts: Vec::new() };
    for index in order {
        sweep.meet(index);
    }
    let cuts = sweep.cuts;
    let mut copies: Vec<Vec<usize>> = vec![Vec::new(); nodes.len()];
    for [one, other] in cuts {
        cut(nodes, &mut copies, one, other);
    }
}

impl Sweep<'_> {
    /// What happens as the line meets a node.
    fn meet(&mut self, index: usize) {
        let Node { point, previous, next } = self.nodes[index];
        let [before, after] = [previous, next].map(|neighbour| self.nodes[neighbour].point);
        // From below, how many of the floors are below the point; the one that ends there is the next.
        let place =
            self.floors.partition_point(|floor| turn(floor.start, floor.end, point) == Ordering::Greater);
        let is_reflex = turn(before, point, after) == Ordering::Less;
        let floor = Floor { start: point, end: after, helper: index, is_merge: false };
        match (is_before(before, point), is_before(after, point)) {
            // Both edges begin: the area does, or it forks around them.
            (false, false) => {
                if is_reflex {
                    self.cut_to_helper(place - 1, index);
                }
                self.floors.insert(place, floor);
            }
            // Both end: the area does, or its two parts meet.
            (true, true) => {
                self.cut_to_merge(place, index);
                self.floors.remove(place);
                if is_reflex {
                    self.cut_to_merge(place - 1, index);
                    self.floors[place - 1].helper = index;
                    self.floors[place - 1].is_merge = true;
                }
            }
            // A floor goes on.
            (true, false) => {
                self.cut_to_merge(place, index);
                self.floors[place] = floor;
            }
            // So does what is above one.
            (false, true) => {
                self.cut_to_merge(place - 1, index);
                self.floors[place - 1].helper = index;
                self.floors[place - 1].is_merge = false;
            }
        }
    }

    /// Cuts from a node to the helper of a floor, and makes the node its helper.
    fn cut_to_helper(&mut self, place: usize, index: usize) {
        let floor = &mut self.floors[place];
        self.cuts.push([index, floor.helper]);
        (floor.helper, floor.is_merge) = (index, false);
    }

    /// The same if parts of the area have met at the helper.
    fn cut_to_merge(&mut self, place: usize, index: usize) {
        if self.floors[place].is_merge {
            self.cut_to_helper(place, index);
        }
    }
}

/// Cuts from one node to another: of a ring two are made, or of two one.
fn cut(nodes: &mut Vec<Node>, copies: &mut [Vec<usize>], one: usize, other: usize) {
    let [a, b] = [[one, other], [other, one]].map(|[from, to]| {
        let sees = |copy: &usize| sees(nodes, *copy, nodes[to].point);
        // The corner that the cut goes into.
        copies[from].iter().copied().find(sees).unwrap_or(from)
    });
    // Instead of from a to what is after it, and from what is before b to b, the way goes from a to b; the copies are on the other
    // side of the cut, from b to a.
    let (copy_a, copy_b) = (nodes.len(), nodes.len() + 1);
    let (after_a, before_b) = (nodes[a].next, nodes[b].previous);
    nodes.push(Node { point: nodes[a].point, previous: copy_b, next: after_a });
    nodes.push(Node { point: nodes[b].point, previous: before_b, next: copy_a });
    nodes[after_a].previous = copy_a;
    nodes[before_b].next = copy_b;
    nodes[a].next = b;
    nodes[b].previous = a;
    copies[one].push(copy_a);
    copies[other].push(copy_b);
}

/// Whether a point is in the corner of a node, between its two edges.
fn sees(nodes: &[Node], index: usize, to: Vec2) -> bool {
    let Node { point, previous, next } = nodes[index];
    let [before, after] = [previous, next].map(|neighbour| nodes[neighbour].point);
    let is_left_of_next = turn(point, after, to) == Ordering::Greater;
    let is_left_of_previous = turn(before, point, to) == Ordering::Greater;
    if turn(before, point, after) == Ordering::Greater {
        is_left_of_next && is_left_of_previous
    } else {
        is_left_of_next || is_left_of_previous
    }
}
