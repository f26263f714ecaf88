//! Which bodies are near enough to each other to be worth a closer look.
//!
//! Every body has a fat box: its tight box with a margin, stretched ahead of its motion. As long as the body
//! stays within it nothing here changes. A body that leaves it gets a new fat box and is marked as moved, and
//! new pairs are looked for around the moved bodies only.
//!
//! - In the step: [`leaves_box`](BroadPhase::leaves_box) and [`give_box`](BroadPhase::give_box) in the finalize stage, for
//!   awake bodies; [`find_pairs`](BroadPhase::find_pairs) in the pairs stage, whose input is the moved bodies.
//! - Cost: a few loads and comparisons for a body within its fat box, O(log n) for one that left it, O(log n +
//!   neighbours) per moved body for the pairs. A settled world costs the comparisons alone. No allocation once
//!   buffers have grown.
//! - Source: E. Catto, "Dynamic Bounding Volume Hierarchies", GDC 2019 (fat boxes, moved set, one tree per
//!   kind of motion).
//!
//! The caller owns the pairs: one lives from the [`find_pairs`](BroadPhase::find_pairs) that reports it
//! until [`forget_pair`](BroadPhase::forget_pair), which the caller calls when the fat boxes no longer overlap
//! or when it takes a body out.

#[cfg(test)]
mod tests;
mod tree;

use tree::Search;
pub(crate) use tree::Tree;

use std::sync::Mutex;

use crate::compute::{ThreadPool, lock, prefetch};
use crate::math::{Aabb, Point, Vec2};
use crate::store::PairSet;

/// Largest margin around a tight box, m.
///
/// Larger: bodies leave their box less often, but more pairs of bodies that do not touch are kept and tested.
/// Smaller: the other way round. A tenth of a metre is a few steps of a body at walking pace.
const MARGIN: f32 = 0.1;

/// Largest margin as a part of the box's mean side, which keeps a heap of gravel from being all neighbours. At a
/// quarter a pile has twice as many pairs as contacts, at this one and a half times as many.
const MARGIN_OF_SIDE: f32 = 0.0625;

/// For how many steps of its motion a fat box is stretched ahead: a body at constant speed is put back into
/// the tree every fifth step. More would make long boxes with many false neighbours.
const STEPS_AHEAD: f32 = 5.0;

/// But not farther than this many mean sides of the tight box, or one step where that is farther: the pairs of long boxes grow
/// with the square of their length. A body that moves so far in a step counts as moved in each, and none of its pairs is kept
/// that does not come within reach in the next.
const SIDES_AHEAD: f32 = 8.0;

/// The same for a body that is near no other, where there are no false neighbours. With [`TOO_BIG`] times
/// [`STEPS_AHEAD`], the box would be too big as soon as a fast body slows down a little.
const STEPS_AHEAD_ALONE: f32 = 9.0;

/// A fat box whose outline is this many times the one it would get now is replaced: the body was fast and has
/// come to rest. The motion has to halve at least before this happens, or to lose a tenth where the body was near no
/// other, so it happens only a few times while a body slows down.
const TOO_BIG: f32 = 2.0;

/// How many bodies ahead memory is asked for: so many take about as long to get a box as memory does.
const AHEAD: usize = 3;

/// So many pairs that were met are looked up together: their places in memory have been asked for before, and come while
/// others are met or looked up.
const ASKED_TOGETHER: usize = 32;

/// What it costs to walk both trees for a body that moved, ns.
const WALK_COST: usize = 250;

/// The tree a body is in and its leaf there.
#[derive(Clone, Copy, Debug, Default)]
enum Home {
    #[default]
    Absent,
    Fixed(u32),
    Movable(u32),
    /// As movable, with a fat box that holds no more than the next step.
    Fast(u32),
}

impl Home {
    /// The leaf of what may move.
    #[inline(always)]
    fn movable(self) -> Option<u32> {
        match self {
            Self::Movable(leaf) | Self::Fast(leaf) => Some(leaf),
            Self::Absent | Self::Fixed(_) => None,
        }
    }
}

/// What the broad phase keeps of a body.
#[derive(Clone, Copy, Debug, Default)]
struct Proxy {
    /// The same box as in the tree, here so that the step's checks read one place.
    fat: Aabb,
    home: Home,
    /// Where the body stands in the list of moved ones.
    moved_at: Option<u32>,
}

const _: () = assert!(size_of::<Proxy>() == 32);

/// Finds the pairs of bodies whose boxes overlap, from step to step.
///
/// Two trees: one for what never moves, one for what may move. Pairs of two fixed bodies are never looked for.
#[derive(Debug, Default)]
pub(crate) struct BroadPhase {
    /// By the body's number.
    proxies: Vec<Proxy>,
    fixed: Tree,
    movable: Tree,
    /// Bodies with a new fat box since pairs were last looked for. Its order does not reach a result.
    moved: Vec<u32>,
    /// Pairs the caller has been told of and has not ended.
    pairs: PairSet,
}

clone_into_buffers!(BroadPhase { proxies, fixed, movable, moved, pairs });

impl BroadPhase {
    /// Takes in a body, by its slot number, and marks it as moved.
    pub(crate) fn add(&mut self, body: u32, movable: bool, tight: Aabb) {
        if self.proxies.len() <= body as usize {
            self.proxies.resize(body as usize + 1, Proxy::default());
        }
        debug_assert!(
            matches!(self.proxies[body as usize].home, Home::Absent),
            "body {body} is here already"
        );
        let (fat, home) = if movable {
            let fat = fattened(tight, Vec2::ZERO);
            (fat, Home::Movable(self.movable.insert(fat, body)))
        } else {
            (tight, Home::Fixed(self.fixed.insert(tight, body)))
        };
        self.proxies[body as usize] = Proxy { fat, home, moved_at: None };
        self.mark_moved(body);
    }

    /// Takes a body out, also off the list of moved ones. The caller ends its pairs.
    pub(crate) fn remove(&mut self, body: u32) {
        let proxy = std::mem::take(&mut self.proxies[body as usize]);
        match proxy.home {
            Home::Absent => debug_assert!(false, "body {body} is not here"),
            Home::Fixed(leaf) => _ = self.fixed.remove(leaf),
            Home::Movable(leaf) | Home::Fast(leaf) => _ = self.movable.remove(leaf),
        }
        if let Some(at) = proxy.moved_at {
            self.moved.swap_remove(at as usize);
            if let Some(&other) = self.moved.get(at as usize) {
                self.proxies[other as usize].moved_at = Some(at);
            }
        }
    }

    /// Gives up what is not needed for bodies with numbers below `end`: there are no others.
    pub(crate) fn trim(&mut self, end: usize) {
        self.proxies.truncate(end);
        self.pairs.trim();
        self.fixed.trim();
        self.movable.trim();
    }

    /// Takes note of where a body is now and of how far, m, it is expected to move during the next step.
    /// Returns whether it got a new fat box and so counts as moved.
    ///
    /// It gets one if it would leave the old one, or if the old one is [`TOO_BIG`] times too big.
    #[inline]
    pub(crate) fn update(&mut self, body: u32, tight: Aabb, motion: Vec2) -> bool {
        let leaves = self.leaves_box(body, tight, motion);
        if leaves {
            self.give_box(body, tight, motion, false);
        }
        leaves
    }

    /// Whether a body would leave its fat box, or its box is [`TOO_BIG`] times too big.
    #[inline]
    pub(crate) fn leaves_box(&self, body: u32, tight: Aabb, motion: Vec2) -> bool {
        let proxy = &self.proxies[body as usize];
        let (reach, wanted) = match proxy.home {
            Home::Absent => return false,
            Home::Fixed(_) => (tight, tight),
            Home::Movable(_) | Home::Fast(_) => {
                (tight.swept(motion), fattened(tight, motion * steps_ahead(tight, motion, STEPS_AHEAD)))
            }
        };
        let stays = proxy.fat.contains(reach) && proxy.fat.perimeter() <= TOO_BIG * wanted.perimeter();
        !stays
    }

    /// How far the outline of a body with the box `tight` may at least move, m, until
    /// [`leaves_box`](Self::leaves_box) can say that it leaves its fat box: what is free on the narrowest side, as long
    /// as the fat box is far from [`TOO_BIG`].
    pub(crate) fn room(&self, body: u32, tight: Aabb) -> f32 {
        let fat = self.proxies[body as usize].fat;
        let (low, high) = (tight.min - fat.min, fat.max - tight.max);
        let narrowest = low.x.min(low.y).min(high.x).min(high.y);
        // Bounds are rounded here and where the box is looked at, by one digit each. The hundredth is for the rounding of
        // sizes, and of the ways that are taken off the room.
        let reach = fat.min.abs().max(fat.max.abs());
        let room = 0.99 * narrowest - 4.0 * f32::EPSILON * reach.x.max(reach.y);
        // By then each of four sides may be shorter by twice the room, and the margins, a part of them, by a little.
        let least_perimeter = fattened(tight, Vec2::ZERO).perimeter() - 9.0 * room;
        if fat.perimeter() < 0.99 * TOO_BIG * least_perimeter { room } else { 0.0 }
    }

    /// Asks for the leaves of bodies further on in a list than `place`: what is kept of a body tells its leaf, that
    /// its place in the tree, and what is there its parent.
    #[inline(always)]
    pub(crate) fn prefetch_leaf(&self, list: &[u32], place: usize) {
        let leaf_of = |body: u32| self.proxies[body as usize].home.movable();
        if let Some(leaf) = list.get(place + 1).and_then(|&body| leaf_of(body)) {
            self.movable.prefetch_parent(leaf);
        }
        if let Some(leaf) = list.get(place + AHEAD).and_then(|&body| leaf_of(body)) {
            self.movable.prefetch(leaf);
        }
        if let Some(leaf) = list.get(place + 2 * AHEAD).and_then(|&body| leaf_of(body)) {
            self.movable.prefetch_place(leaf);
        }
        if let Some(&body) = list.get(place + 3 * AHEAD) {
            prefetch(&self.proxies, body as usize);
        }
    }

    /// Gives a body another fat box: one for longer if it is near no other.
    #[cold]
    #[inline(never)]
    pub(crate) fn give_box(&mut self, body: u32, tight: Aabb, motion: Vec2, is_alone: bool) {
        let proxy = &mut self.proxies[body as usize];
        match proxy.home {
            Home::Absent => {}
            Home::Fixed(leaf) => {
                proxy.fat = tight;
                self.fixed.move_leaf(leaf, tight);
            }
            Home::Movable(leaf) | Home::Fast(leaf) => {
                let most = if is_alone { STEPS_AHEAD_ALONE } else { STEPS_AHEAD };
                let steps = steps_ahead(tight, motion, most);
                proxy.home = if steps > 1.0 { Home::Movable(leaf) } else { Home::Fast(leaf) };
                proxy.fat = fattened(tight, motion * steps);
                self.movable.move_leaf(leaf, proxy.fat);
            }
        }
        self.mark_moved(body);
    }

    /// Has pairs of a body looked for again though it did not move: what it may touch has changed.
    pub(crate) fn mark_moved(&mut self, body: u32) {
        let proxy = &mut self.proxies[body as usize];
        if proxy.moved_at.is_none() {
            proxy.moved_at = Some(self.moved.len() as u32);
            self.moved.push(body);
        }
    }

    /// The fat box of a body.
    #[inline]
    pub(crate) fn fat_aabb(&self, body: u32) -> Aabb {
        self.proxies[body as usize].fat
    }

    /// Whether the fat boxes of two bodies overlap: a pair lives while they do.
    #[inline]
    pub(crate) fn overlap(&self, a: u32, b: u32) -> bool {
        self.fat_aabb(a).overlaps(self.fat_aabb(b))
    }

    /// Whether a body moves so far in a step that its pairs are looked for anew in each.
    #[inline]
    pub(crate) fn is_fast(&self, body: u32) -> bool {
        matches!(self.proxies[body as usize].home, Home::Fast(_))
    }

    /// How many bodies have a new fat box since pairs were last looked for, or are fast.
    pub(crate) fn moved_count(&self) -> usize {
        self.moved.len()
    }

    /// Appends to `out` the pairs (a < b) that are new: the fat boxes overlap, one of the two moved, one of the
    /// two is movable, the pair is not known yet, and `accept`, told which of the two are fast, takes it. They are in ascending order, and known
    /// from now on. Then no body counts as moved any more, but for those that are fast.
    pub(crate) fn find_pairs(
        &mut self,
        pool: &ThreadPool,
        accept: impl Fn([u32; 2], [bool; 2]) -> bool + Sync,
        out: &mut Vec<(u32, u32)>,
    ) {
        let first_new = out.len();
        let new = Mutex::new(&mut *out);
        let this = &*self;
        pool.run(&this.moved[..], WALK_COST, |moved| this.find_pairs_of(moved, &accept, &new));
        let Self { moved, proxies, .. } = self;
        let mut count = 0;
        moved.retain(|&body| {
            let proxy = &mut proxies[body as usize];
            let is_fast = matches!(proxy.home, Home::Fast(_));
            proxy.moved_at = is_fast.then_some(count);
            count += u32::from(is_fast);
            is_fast
        });
        // The order in which the trees were walked is that of their history; the numbers' is the caller's.
        out[first_new..].sort_unstable();
        for &(a, b) in &out[first_new..] {
            self.pairs.insert(a, b);
        }
    }

    /// Appends the new pairs of some of the moved bodies, in any order.
    fn find_pairs_of(
        &self,
        moved: &[u32],
        accept: &impl Fn([u32; 2], [bool; 2]) -> bool,
        new: &Mutex<&mut Vec<(u32, u32)>>,
    ) {
        let mut search = Search::new();
        // Pairs that were met and may be known.
        let (mut met, mut count) = ([(0, 0); ASKED_TOGETHER], 0);
        let report = |met: &[(u32, u32)]| {
            let is_new = |&(a, b): &(u32, u32)| {
                !self.pairs.contains(a, b) && accept([a, b], [a, b].map(|body| self.is_fast(body)))
            };
            lock(new).extend(met.iter().copied().filter(is_new));
        };
        for (place, &body) in moved.iter().enumerate() {
            self.prefetch_leaf(moved, place);
            let proxy = self.proxies[body as usize];
            let mut meet = |other: u32| {
                let (a, b) = (body.min(other), body.max(other));
                // Two moved bodies find each other; the one with the smaller number reports it.
                let is_reported_by_other = other <= body && self.proxies[other as usize].moved_at.is_some();
                self.pairs.prefetch(a, b);
                met[count] = (a, b);
                count += usize::from(!is_reported_by_other);
                if count == ASKED_TOGETHER {
                    report(&met);
                    count = 0;
                }
            };
            let other_tree = if let Some(leaf) = proxy.home.movable() {
                self.movable.search_around(leaf, &mut search, &mut meet);
                &self.fixed
            } else {
                &self.movable
            };
            other_tree.query(proxy.fat, |other| {
                meet(other);
                true
            });
        }
        report(&met[..count]);
    }

    /// Takes up a pair (a < b) that met without overlapping boxes, if it is not known yet.
    pub(crate) fn take_up_pair(&mut self, [a, b]: [u32; 2]) {
        self.pairs.insert(a, b);
    }

    /// Forgets a pair, which ended: the fat boxes no longer overlap, or a body was taken out. It is reported
    /// again when they overlap and one of the two has moved.
    pub(crate) fn forget_pair(&mut self, a: u32, b: u32) {
        self.pairs.remove(a, b);
    }

    /// Asks for what it takes to forget a pair.
    #[inline(always)]
    pub(crate) fn prefetch_pair(&self, [a, b]: [u32; 2]) {
        self.pairs.prefetch(a, b);
    }

    /// Calls `visit` with each body whose fat box meets `aabb`, until it returns false.
    pub(crate) fn query(&self, aabb: Aabb, mut visit: impl FnMut(u32) -> bool) {
        if self.fixed.query(aabb, &mut visit) {
            self.movable.query(aabb, &mut visit);
        }
    }

    /// Calls `visit` with each body whose fat box meets a segment and with the fraction the segment ends at by
    /// now; `visit` returns the same fraction to go on, a smaller one to clip, 0 to stop. Returns the last
    /// fraction. `max_fraction` is above 0. See [`Tree::cast`].
    pub(crate) fn ray_cast(
        &self,
        origin: Point,
        translation: Vec2,
        max_fraction: f32,
        visit: impl FnMut(u32, f32) -> f32,
    ) -> f32 {
        self.cast(origin, 0.0, translation, max_fraction, visit)
    }

    /// The same with each body whose fat box comes within `reach`, m, of the segment, along both axes.
    pub(crate) fn cast(
        &self,
        origin: Point,
        reach: f32,
        translation: Vec2,
        max_fraction: f32,
        mut visit: impl FnMut(u32, f32) -> f32,
    ) -> f32 {
        let end = self.fixed.cast(origin, reach, translation, max_fraction, &mut visit);
        if end > 0.0 { self.movable.cast(origin, reach, translation, end, &mut visit) } else { end }
    }

    /// Calls `visit` with each body whose fat box is not farther from a place than the `limit` of then, m, which `visit`
    /// returns: the same, or a smaller one.
    pub(crate) fn nearest(&self, place: Point, limit: f64, mut visit: impl FnMut(u32, f64) -> f64) {
        let limit = self.fixed.nearest(place, limit, &mut visit);
        self.movable.nearest(place, limit, &mut visit);
    }

    /// Calls `visit(box, depth, is_leaf)` for every node of both trees, for an overlay.
    pub(crate) fn for_each_node(&self, mut visit: impl FnMut(Aabb, u32, bool)) {
        self.fixed.for_each_node(&mut visit);
        self.movable.for_each_node(&mut visit);
    }

    /// Checks both trees and that every body is in its tree with its box. O(n).
    ///
    /// # Errors
    /// A sentence that names the first thing found wrong.
    pub(crate) fn validate(&self) -> Result<(), String> {
        self.fixed.validate()?;
        self.movable.validate()?;
        let mut present = 0;
        for (body, proxy) in self.proxies.iter().enumerate() {
            let (tree, leaf) = match proxy.home {
                Home::Absent => continue,
                Home::Fixed(leaf) => (&self.fixed, leaf),
                Home::Movable(leaf) | Home::Fast(leaf) => (&self.movable, leaf),
            };
            present += 1;
            if tree.value(leaf) as usize != body || tree.aabb(leaf) != proxy.fat {
                return Err(format!("the leaf of body {body} holds another body or box"));
            }
        }
        if present != self.fixed.len() + self.movable.len() {
            return Err(format!("{present} bodies, but the trees hold others"));
        }
        for (at, &body) in self.moved.iter().enumerate() {
            if self.proxies[body as usize].moved_at != Some(at as u32) {
                return Err(format!("body {body} does not know that it moved"));
            }
        }
        let marked = self.proxies.iter().filter(|proxy| proxy.moved_at.is_some()).count();
        if marked == self.moved.len() {
            Ok(())
        } else {
            Err(format!("{marked} marked as moved, not as listed"))
        }
    }
}

/// How many steps of a body's `motion`, m, its fat box holds, if not the `most`.
#[inline(always)]
fn steps_ahead(tight: Aabb, motion: Vec2, most: f32) -> f32 {
    let longest = 0.25 * SIDES_AHEAD * tight.perimeter();
    // A body at rest has all it may have, as 1/0 is infinite.
    most.min((longest / motion.norm_1()).max(1.0))
}

/// The fat box of a movable body whose motion ahead it is to hold. It holds `tight.swept(ahead)`, and what is swept by a
/// part of that, whatever the rounding: each bound is made from the same number by adding no less.
#[inline(always)]
fn fattened(tight: Aabb, ahead: Vec2) -> Aabb {
    // The mean side is a quarter of the outline.
    let margin = MARGIN.min(0.25 * MARGIN_OF_SIDE * tight.perimeter());
    tight.swept(ahead).grown(margin)
}
