//! A dynamic tree of bounding boxes.
//!
//! Leaves are the boxes handed in; a box further up holds everything below it, so that a question about a
//! region skips whole subtrees. It is edited in the pairs stage (bodies that left their fat box) and asked
//! there and, between steps, by the user's queries and rays.
//!
//! # Shape
//! A tree costs a query what its inner boxes measure: the chance that a small box meets a node is about
//! proportional to the node's perimeter (the surface-area heuristic). An insertion therefore walks down
//! toward the sibling that adds the least perimeter over all ancestors, and on the way back up each ancestor
//! may exchange a child with a grandchild where that makes the sum smaller (tree rotations).
//!
//! Perimeter alone does not bound the height: a thousand boxes, one within the other, make a list. So the
//! heights of two siblings never differ by more than [`MAX_IMBALANCE`], whatever the boxes are; [`balance`]
//! shows why this can be kept with one rotation per ancestor. The walks rely on it: their stacks are of fixed
//! size.
//!
//! # Layout
//! The two children of a node lie side by side, so one cache line of 64 bytes holds both boxes a walk has to
//! look at, and a node needs one link for two children. The price: nodes change places when the tree is
//! edited, so a leaf is named by a number that a table translates to its place.
//!
//! # Cost
//! Insert, remove and move O(log n), a query O(log n + answers) for boxes of like size. 64 bytes per leaf
//! (two nodes) and 4 for the table. No allocation but for growth, none in a walk.
//!
//! # Source
//! E. Catto, "Dynamic Bounding Volume Hierarchies", GDC 2019 (insertion by greedy descent, rotations);
//! D. Kopta et al., "Fast, Effective BVH Updates for Animated Scenes", I3D 2012 (rotations while refitting);
//! G. Adelson-Velsky and E. Landis, 1962, and C. Foster, "A generalization of AVL trees", CACM 16, 1973
//! (the bound on imbalance).

mod balance;
mod search;
#[cfg(test)]
mod tests;
mod validate;
mod walk;

use crate::compute::prefetch;
use crate::math::{Aabb, Reach};
pub(crate) use search::Search;

/// Largest difference of height between two siblings.
///
/// 1 would be the classical AVL tree, whose many rotations put boxes together that lie apart: its queries are
/// clearly slower. Without a bound a hostile order of insertions makes a list. At 4 the bound hardly ever
/// stands in the way of what the perimeters ask for, and the height stays below 2.47·log₂ n + 4, which the
/// stack of a walk is sized for.
const MAX_IMBALANCE: u32 = 4;

/// A leaf stays with its kin while it moves within the box of its ancestor so many levels up.
///
/// With fewer, more leaves are taken out and put back, at three times the cost. With more, a gas, whose bodies all go
/// far, gets a tree that rotations alone do not keep good: with 7 a step takes a twentieth longer after a minute, and
/// without a bound twice as long.
const KINSHIP: u32 = 5;

/// Place of the root. Its neighbour, place 1, is never used.
const ROOT: u32 = 0;

/// A leaf or an inner node. Siblings lie at places 2k and 2k + 1.
#[derive(Clone, Copy, Debug)]
struct Node {
    reach: Reach,
    /// Inner node: place of the first child. Leaf: the leaf's number.
    link: u32,
    /// Place of the parent; the root is its own.
    parent: u32,
    /// Longest way down to a leaf; 0 is a leaf.
    height: u32,
    /// What the leaf stands for.
    value: u32,
}

/// Two siblings, in one cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Pair([Node; 2]);

const _: () = assert!(size_of::<Pair>() == 64);

impl Node {
    const NOTHING: Self = Self { reach: Reach::NOWHERE, link: 0, parent: ROOT, height: 0, value: 0 };

    #[inline(always)]
    fn is_leaf(&self) -> bool {
        self.height == 0
    }
}

impl Pair {
    const NOTHING: Self = Self([Node::NOTHING; 2]);
}

/// A dynamic tree of bounding boxes, each with a number of the caller's.
#[derive(Debug)]
pub(crate) struct Tree {
    /// The root at place 0, siblings from place 2 on.
    pairs: Vec<Pair>,
    /// First places of pairs that are free.
    free_pairs: Vec<u32>,
    /// Where each leaf is now, by its number.
    leaf_places: Vec<u32>,
    free_leaves: Vec<u32>,
}

clone_into_buffers!(Tree { pairs, free_pairs, leaf_places, free_leaves });

/// Number of the pair that a place is in.
#[inline(always)]
fn pair_of(place: u32) -> usize {
    (place / 2) as usize
}

/// Which of its pair a place is.
#[inline(always)]
fn side_of(place: u32) -> usize {
    (place % 2) as usize
}

impl Default for Tree {
    fn default() -> Self {
        Self {
            pairs: vec![Pair::NOTHING],
            free_pairs: Vec::new(),
            leaf_places: Vec::new(),
            free_leaves: Vec::new(),
        }
    }
}

impl Tree {
    /// Takes all leaves out.
    pub(crate) fn clear(&mut self) {
        self.pairs.truncate(1);
        self.pairs[pair_of(ROOT)] = Pair::NOTHING;
        self.free_pairs.clear();
        self.leaf_places.clear();
        self.free_leaves.clear();
    }

    /// How many leaves there are.
    pub(crate) fn len(&self) -> usize {
        self.leaf_places.len() - self.free_leaves.len()
    }

    /// Longest way from the root to a leaf; 0 for a tree of one leaf or none.
    #[cfg(test)]
    pub(crate) fn height(&self) -> u32 {
        self.node(ROOT).height
    }

    #[inline]
    pub(crate) fn aabb(&self, leaf: u32) -> Aabb {
        self.node(self.leaf_places[leaf as usize]).reach.aabb()
    }

    /// Asks for the leaf, whose place is close.
    #[inline(always)]
    pub(crate) fn prefetch(&self, leaf: u32) {
        prefetch(&self.pairs, pair_of(self.leaf_places[leaf as usize]));
    }

    /// Asks for the parent of a leaf, which is close.
    #[inline(always)]
    pub(crate) fn prefetch_parent(&self, leaf: u32) {
        prefetch(&self.pairs, pair_of(self.node(self.leaf_places[leaf as usize]).parent));
    }

    /// Asks for the place of a leaf.
    #[inline(always)]
    pub(crate) fn prefetch_place(&self, leaf: u32) {
        prefetch(&self.leaf_places, leaf as usize);
    }

    #[inline]
    pub(crate) fn value(&self, leaf: u32) -> u32 {
        self.node(self.leaf_places[leaf as usize]).value
    }

    /// Adds a box; the leaf's number stays the same until it is removed.
    pub(crate) fn insert(&mut self, aabb: Aabb, value: u32) -> u32 {
        let leaf = self.free_leaves.pop().unwrap_or(self.leaf_places.len() as u32);
        if leaf as usize == self.leaf_places.len() {
            self.leaf_places.push(ROOT);
        }
        let node = Node { reach: aabb.into(), link: leaf, parent: ROOT, height: 0, value };
        if self.len() == 1 {
            self.put(ROOT, node);
        } else {
            self.attach(node, ROOT);
        }
        leaf
    }

    /// Takes a leaf out and returns its value.
    pub(crate) fn remove(&mut self, leaf: u32) -> u32 {
        let place = self.leaf_places[leaf as usize];
        let value = self.node(place).value;
        if place == ROOT {
            *self.node_mut(ROOT) = Node::NOTHING;
        } else {
            self.detach(place);
        }
        self.free_leaves.push(leaf);
        value
    }

    /// Gives a leaf another box.
    ///
    /// As long as its ancestor [`KINSHIP`] levels up holds the new box, it keeps its sibling, and the rotations on the
    /// way up give it better company where that helps. Else it is taken out and put back, but the search for its new
    /// place starts at the lowest old ancestor that still holds the new box: most moves are short, and the upper half of
    /// the tree need not be read.
    pub(crate) fn move_leaf(&mut self, leaf: u32, aabb: Aabb) {
        let place = self.leaf_places[leaf as usize];
        let node = Node { reach: aabb.into(), ..*self.node(place) };
        if place == ROOT {
            self.put(ROOT, node);
            return;
        }
        let ancestor = (0..KINSHIP).fold(place, |place, _| self.node(place).parent);
        if self.node(ancestor).reach.contains(node.reach) {
            *self.node_mut(place) = node;
            self.refit_upward(node.parent);
            return;
        }
        let mut start = self.detach(place);
        while start != ROOT && !self.node(start).reach.contains(node.reach) {
            start = self.node(start).parent;
        }
        self.attach(node, start);
    }

    /// Gives up the places of nodes that are gone: the others move together, and the shape stays as it is.
    pub(crate) fn trim(&mut self) {
        if self.len() == 0 {
            *self = Self::default();
            return;
        }
        let root = vec![self.pairs[pair_of(ROOT)]];
        let old = std::mem::replace(&mut self.pairs, root);
        self.free_pairs.clear();
        // Every node but the root, from the top down; place 1 is never used.
        let (mut place, mut last_leaf) = (ROOT, 0);
        while pair_of(place) < self.pairs.len() {
            let node = *self.node(place);
            if node.is_leaf() {
                self.leaf_places[node.link as usize] = place;
                last_leaf = last_leaf.max(node.link);
            } else {
                let first = 2 * self.pairs.len() as u32;
                self.pairs.push(old[pair_of(node.link)]);
                self.pair_mut(first).iter_mut().for_each(|child| child.parent = place);
                self.node_mut(place).link = first;
            }
            place = if place == ROOT { 2 } else { place + 1 };
        }
        self.leaf_places.truncate(last_leaf as usize + 1);
        self.free_leaves.retain(|&leaf| leaf < last_leaf);
    }

    #[inline(always)]
    fn node(&self, place: u32) -> &Node {
        &self.pairs[pair_of(place)].0[side_of(place)]
    }

    #[inline(always)]
    fn node_mut(&mut self, place: u32) -> &mut Node {
        &mut self.pairs[pair_of(place)].0[side_of(place)]
    }

    /// Two siblings, by the place of the first.
    #[inline(always)]
    fn pair(&self, first: u32) -> &[Node; 2] {
        &self.pairs[pair_of(first)].0
    }

    #[inline(always)]
    fn pair_mut(&mut self, first: u32) -> &mut [Node; 2] {
        &mut self.pairs[pair_of(first)].0
    }

    /// Puts a node at a place and tells those who point at it. The place keeps its parent.
    fn put(&mut self, place: u32, node: Node) {
        let parent = self.node(place).parent;
        *self.node_mut(place) = Node { parent, ..node };
        if node.is_leaf() {
            self.leaf_places[node.link as usize] = place;
        } else {
            for child in self.pair_mut(node.link) {
                child.parent = place;
            }
        }
    }

    /// Hangs a leaf into the subtree at `start`, next to its best sibling there.
    fn attach(&mut self, leaf: Node, start: u32) {
        let place = self.best_sibling(leaf.reach, start);
        let sibling = *self.node(place);
        let pair = self.free_pairs.pop().unwrap_or(2 * self.pairs.len() as u32);
        if pair_of(pair) == self.pairs.len() {
            self.pairs.push(Pair::NOTHING);
        }
        for child in self.pair_mut(pair) {
            child.parent = place;
        }
        self.put(pair, sibling);
        self.put(pair + 1, leaf);
        // The height stays the old one until the refit, which wants to know by how much it changes.
        self.node_mut(place).link = pair;
        self.refit_upward(place);
    }

    /// Takes the leaf at `place`, which is not the root, out: its sibling moves to their parent's place.
    /// Returns the place of the lowest ancestor left.
    fn detach(&mut self, place: u32) -> u32 {
        let sibling = *self.node(place ^ 1);
        let parent = sibling.parent;
        self.put(parent, sibling);
        self.free_pairs.push(place & !1);
        if parent == ROOT {
            return ROOT;
        }
        let ancestor = self.node(parent).parent;
        self.refit_upward(ancestor);
        ancestor
    }

    /// The node in the subtree at `start` next to which a new leaf adds the least perimeter, found by one walk
    /// down (greedy: the branch with the smaller lower bound).
    ///
    /// With D the new box and |X| the perimeter of X, pairing D with node S costs
    /// ```text
    /// |S ∪ D| + sum over the ancestors A of S of (|A ∪ D| - |A|)
    ///   direct                 inherited
    /// ```
    /// and pairing it anywhere below a node S at least inherited(S) + (|S ∪ D| - |S|) + min(|S|, |D|).
    fn best_sibling(&self, reach: Reach, start: u32) -> u32 {
        let perimeter = reach.perimeter();
        let mut place = start;
        let mut inherited = 0.0;
        let mut direct = self.node(start).reach.union(reach).perimeter();
        let mut best: Option<u32> = None;
        let mut best_cost = f32::INFINITY;
        loop {
            let node = self.node(place);
            // A higher sibling would break the bound on imbalance at once.
            if node.height <= MAX_IMBALANCE && (best.is_none() || inherited + direct < best_cost) {
                best = Some(place);
                best_cost = inherited + direct;
            }
            if node.is_leaf() {
                return best.unwrap_or(place);
            }
            inherited += direct - node.reach.perimeter();

            let [child_a, child_b] = self.pair(node.link);
            let a = Branch::new(child_a, reach, perimeter);
            let b = Branch::new(child_b, reach, perimeter);
            let take_b = b.is_better_than(&a, reach);
            let taken = if take_b { b } else { a };
            if best.is_some() && best_cost <= inherited + taken.least {
                return best.unwrap_or(place);
            }
            place = node.link + u32::from(take_b);
            direct = taken.direct;
        }
    }
}

/// What it would cost to go on into a child while searching for a sibling.
struct Branch<'a> {
    node: &'a Node,
    /// Perimeter of the child's box with the new one.
    direct: f32,
    /// Lower bound of the cost anywhere in the child's subtree, apart from what is inherited above it.
    least: f32,
}

impl<'a> Branch<'a> {
    #[inline(always)]
    fn new(node: &'a Node, reach: Reach, perimeter: f32) -> Self {
        let own = node.reach.perimeter();
        let direct = node.reach.union(reach).perimeter();
        Self { node, direct, least: (direct - own) + own.min(perimeter) }
    }

    /// Where both children hold the new box the bounds are equal: then the nearer middle is better, and for
    /// equal boxes the lower subtree.
    #[inline(always)]
    fn is_better_than(&self, other: &Self, reach: Reach) -> bool {
        if self.least != other.least {
            return self.least < other.least;
        }
        let (own, others) = (self.node.reach.distance(reach), other.node.reach.distance(reach));
        if own == others { self.node.height < other.node.height } else { own < others }
    }
}
