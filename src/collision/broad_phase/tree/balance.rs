//! Refitting and rotating the ancestors of a leaf that came, went or moved.
//!
//! A rotation exchanges a child of a node with a grandchild from the other child:
//! ```text
//!        N                    N
//!      /   \                /   \
//!   lone   split    ->     up   split'        split' = lone ∪ stay
//!          /   \                /   \
//!         up   stay          lone   stay
//! ```
//! Only the box of `split` changes, so the perimeter saved is |split| - |lone ∪ stay|. Of the four rotations of
//! a node the one that saves most is made.
//!
//! # Why the heights stay in bound
//! Let K be the bound on the imbalance of siblings, h the heights. An insertion puts a leaf beside a node of
//! height <= K, a removal takes one from beside such a node: in both cases a place's height changes by one.
//! Suppose a child of N changed its height by one and every node below N is in bound.
//! - If N is still in bound, a rotation is made only if it leaves both N and split' in bound and N's height
//!   within one of what it was.
//! - Else h(split) = h(lone) + K + 1. Let `up` be the higher of its children: h(up) = h(split) - 1, and
//!   h(lone) <= h(stay) <= h(lone) + K, so split' is in bound. h(split') = h(stay) + 1 lies between
//!   h(up) - K + 1 and h(up) + 1, so N is in bound, and its height stays or falls by one.
//!
//! So N's height again changed by at most one, and the argument goes on at its parent. It never looks at the
//! boxes: it holds for infinite ones and for numbers that are none.
//!
//! A tree of height h then has at least L(h) = L(h - 1) + L(h - 1 - K) leaves, which for K = 4 grows as
//! 1.3247^h: h <= 2.47·log₂(leaves) + K.

use super::{MAX_IMBALANCE, ROOT, Tree};

/// A rotation: the contents of two places to exchange, and the node between them.
#[derive(Clone, Copy)]
struct Rotation {
    lone: u32,
    split: u32,
    up: u32,
}

impl Tree {
    /// Brings the inner node at `place` and its ancestors up to date, as far as anything changes.
    pub(super) fn refit_upward(&mut self, mut place: u32) {
        while self.refit(place) && place != ROOT {
            place = self.node(place).parent;
        }
    }

    /// Rotates where it helps, then makes box and height from the children; returns whether either changed.
    fn refit(&mut self, place: u32) -> bool {
        if let Some(rotation) = self.best_rotation(place) {
            self.rotate(rotation);
        }
        self.fit(place)
    }

    /// Makes box and height from the children; returns whether either changed.
    fn fit(&mut self, place: u32) -> bool {
        let [a, b] = self.pair(self.node(place).link);
        let reach = a.reach.union(b.reach);
        let height = 1 + a.height.max(b.height);
        let node = self.node_mut(place);
        let changed = node.reach != reach || node.height != height;
        node.reach = reach;
        node.height = height;
        changed
    }

    fn rotate(&mut self, Rotation { lone, split, up }: Rotation) {
        let (lone_node, up_node) = (*self.node(lone), *self.node(up));
        self.put(lone, up_node);
        self.put(up, lone_node);
        self.fit(split);
    }

    /// The rotation of a node that saves most perimeter, if one does; if its children are out of bound, the
    /// one that costs least. The node's height is still the one before the edit.
    fn best_rotation(&self, place: u32) -> Option<Rotation> {
        let node = self.node(place);
        let (first, second) = (node.link, node.link + 1);
        let [a, b] = self.pair(first);
        let out_of_bound = a.height.abs_diff(b.height) > MAX_IMBALANCE;
        let mut best = None;
        let mut best_change = 0.0;
        for (lone, split, [lone_at, split_at]) in [(a, b, [first, second]), (b, a, [second, first])] {
            if split.is_leaf() {
                continue;
            }
            let [c, d] = self.pair(split.link);
            let split_perimeter = split.reach.perimeter();
            for (up, stay, up_at) in [(c, d, split.link), (d, c, split.link + 1)] {
                let change = lone.reach.union(stay.reach).perimeter() - split_perimeter;
                let is_better = change < best_change || (out_of_bound && best.is_none());
                if is_better && keeps_bound(node.height, [lone, up, stay].map(|node| node.height)) {
                    best = Some(Rotation { lone: lone_at, split: split_at, up: up_at });
                    best_change = change;
                }
            }
        }
        best
    }
}

/// Whether a rotation leaves split' and N in bound and N's height within one of `height_before`.
fn keeps_bound(height_before: u32, [lone, up, stay]: [u32; 3]) -> bool {
    let split = 1 + lone.max(stay);
    lone.abs_diff(stay) <= MAX_IMBALANCE
        && up.abs_diff(split) <= MAX_IMBALANCE
        && (1 + up.max(split)).abs_diff(height_before) <= 1
}
