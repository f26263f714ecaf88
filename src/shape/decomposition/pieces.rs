//! Joins triangles to convex pieces of few corners.
//!
//! A diagonal goes if the piece without it is convex, the longest first (S. Hertel and K. Mehlhorn, 1983). Whatever the
//! order, and where corners are not limited, no more than four times as many pieces are left as are needed: every diagonal that
//! stays is needed at a reflex corner of the outline, which needs no more than two.

use core::cmp::Ordering;

use crate::math::Vec2;
use crate::shape::MAX_VERTICES;
use crate::shape::decomposition::orientation::turn;
use crate::shape::decomposition::triangles::{Side, Triangles, next_of};

/// Sides of triangles, linked to the outlines of pieces.
struct Links<'a> {
    triangles: &'a Triangles,
    next: Vec<Side>,
    previous: Vec<Side>,
    /// Whether a side is none any more.
    is_gone: Vec<bool>,
}

/// The outlines of convex pieces, counter-clockwise.
pub(super) fn pieces_of(triangles: &Triangles) -> Vec<Vec<Vec2>> {
    let count = triangles.starts.len();
    let mut links = Links {
        triangles,
        next: (0..count).map(next_of).collect(),
        previous: (0..count).map(|side| next_of(next_of(side))).collect(),
        is_gone: vec![false; count],
    };
    let mut diagonals: Vec<Side> =
        (0..count).filter(|&side| triangles.twins[side].is_some_and(|twin| side < twin)).collect();
    diagonals.sort_by(|&one, &other| links.squared_length(other).total_cmp(&links.squared_length(one)));
    for side in diagonals {
        if let Some(twin) = triangles.twins[side]
            && links.may_go(side, twin)
        {
            links.remove(side, twin);
        }
    }
    links.outlines()
}

impl Links<'_> {
    fn start(&self, side: Side) -> Vec2 {
        self.triangles.points[self.triangles.starts[side]]
    }

    /// The square of the length of a side, m².
    fn squared_length(&self, side: Side) -> f64 {
        let (start, end) = (self.start(side), self.start(next_of(side)));
        let along = [f64::from(end.x) - f64::from(start.x), f64::from(end.y) - f64::from(start.y)];
        along[0] * along[0] + along[1] * along[1]
    }

    /// The sides of a piece, from one on.
    fn sides_from(&self, first: Side) -> impl Iterator<Item = Side> {
        let mut next = Some(first);
        std::iter::from_fn(move || {
            let here = next?;
            next = Some(self.next[here]).filter(|&next| next != first);
            Some(here)
        })
    }

    /// Whether the two pieces along a diagonal are convex together, and have no more corners than a polygon may have.
    fn may_go(&self, side: Side, twin: Side) -> bool {
        let count = self.sides_from(side).count() + self.sides_from(twin).count() - 2;
        // At each end: from the one piece over the end to the other.
        let is_convex = [(side, twin), (twin, side)].into_iter().all(|(side, twin)| {
            let (before, after) = (self.previous[side], self.next[twin]);
            turn(self.start(before), self.start(after), self.start(self.next[after])) != Ordering::Less
        });
        count <= MAX_VERTICES && is_convex
    }

    fn remove(&mut self, side: Side, twin: Side) {
        for (side, twin) in [(side, twin), (twin, side)] {
            let (before, after) = (self.previous[side], self.next[twin]);
            (self.next[before], self.previous[after]) = (after, before);
        }
        (self.is_gone[side], self.is_gone[twin]) = (true, true);
    }

    fn outlines(&self) -> Vec<Vec<Vec2>> {
        let mut is_done = self.is_gone.clone();
        let mut outlines = Vec::new();
        for first in 0..self.next.len() {
            if !is_done[first] {
                let outline = self.sides_from(first).inspect(|&side| is_done[side] = true);
                outlines.push(outline.map(|side| self.start(side)).collect());
            }
        }
        outlines
    }
}
