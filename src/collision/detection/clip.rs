//! Clipping: the stretch that two facing edges have in common, and the manifold made of its ends.
//!
//! The reference edge gives the normal, the incident edge of the other hull is cut off by the lines through the
//! reference edge's ends (I. Sutherland and G. Hodgman, 1974).
//!
//! All in the frame of the face: from the centre of the reference hull, x along the face's outward normal, y along
//! its edge. There a distance from the face is an x, and what is past its ends shows in y.

use crate::collision::detection::within;
use crate::collision::manifold::Corner;
use crate::collision::{FeatureId, Manifold, ManifoldPoint};
use crate::math::{Rot, Vec2};

/// The edge that gives the normal: it stands upright at x = `plane` and runs from y = `low` up to y = `high`, m.
#[derive(Clone, Copy)]
pub(super) struct Reference {
    pub(super) plane: f32,
    pub(super) low: f32,
    pub(super) high: f32,
    /// Index of the vertex at its lower end, then of the one at its upper end.
    pub(super) vertices: [u8; 2],
}

/// The edge that faces the reference edge, so that it runs down; in the frame of the face, m.
#[derive(Clone, Copy)]
pub(super) struct Incident {
    pub(super) start: Vec2,
    pub(super) end: Vec2,
    /// Index of the vertex at its start, then of the one at its end.
    pub(super) vertices: [u8; 2],
}

/// What the choice of the reference face may leave open.
#[derive(Clone, Copy)]
pub(super) struct Tolerance {
    /// Lengths below this are rounding, m.
    pub(super) noise: f32,
    /// How much a face of b must be the better reference to be taken over a's, m.
    pub(super) preference: f32,
}

impl Tolerance {
    /// How much better a face of b must be, as a part of the thinner hull's inradius. Two faces that lie flat
    /// on each other are equally good references; without a preference, rounding would choose anew at each
    /// step and move the points. The depth is then short by at most this, 0.5 mm for a box of 1 m, a tenth of
    /// the overlap that the solver leaves.
    const PREFERENCE: f32 = 1e-3;

    /// Sums of a few lengths of the size of the offset round by a few half epsilons of it.
    const NOISE: f32 = 4.0 * f32::EPSILON;

    #[inline(always)]
    pub(super) fn new(inradius_a: f32, inradius_b: f32, offset: Vec2) -> Self {
        let noise = Self::NOISE * (offset.x.abs() + offset.y.abs());
        Self { noise, preference: noise + Self::PREFERENCE * inradius_a.min(inradius_b) }
    }
}

/// The common stretch of two edges.
pub(super) struct Stretch {
    /// Its ends on the incident edge: the lower one, then the upper one.
    points: [Vec2; 2],
    separations: [f32; 2],
    features: [FeatureId; 2],
    /// Whether they are corners of the incident hull, and not where the reference edge ends.
    are_corners: [bool; 2],
    /// Whether the edges lie past each other; the ends are then one and the same.
    is_empty: bool,
}

/// Cuts off what of `incident` is past the ends of `reference`.
#[inline(always)]
pub(super) fn clip(reference: Reference, incident: Incident) -> Stretch {
    let Reference { plane, low, high, vertices: [first, second] } = reference;
    let Incident { start, end, vertices: [incident_first, incident_second] } = incident;
    // How much to cut, as parts of the incident edge. One that lies along x has no length in y; the smallest
    // number in its place keeps 0/0 away.
    let per_length = 1.0 / (start.y - end.y).max(f32::MIN_POSITIVE);
    let cut_low = ((low - end.y) * per_length).clamp(0.0, 1.0);
    let cut_high = ((start.y - high) * per_length).clamp(0.0, 1.0);
    let edge = start - end;
    let points = [end + edge * cut_low, start - edge * cut_high];
    Stretch {
        points,
        separations: [points[0].x - plane, points[1].x - plane],
        features: [
            FeatureId::of_vertices(first, incident_second),
            FeatureId::of_vertices(second, incident_first),
        ],
        are_corners: [cut_low == 0.0, cut_high == 0.0],
        is_empty: start.y < low || end.y > high,
    }
}

impl Stretch {
    /// Whether the edges lie past each other.
    pub(super) fn is_empty(&self) -> bool {
        self.is_empty
    }

    /// How far its nearer end is from the reference edge, m.
    pub(super) fn separation(&self) -> f32 {
        let [first, second] = self.separations;
        first.min(second)
    }

    /// Its nearer end twice, if it has no length: the other end of an edge that stands upright on the face.
    pub(super) fn without_far_end(mut self, noise: f32) -> Self {
        let [first, second] = self.points;
        if second.y - first.y <= noise {
            let nearer = usize::from(self.separations[1] < self.separations[0]);
            self.points = [self.points[nearer]; 2];
            self.separations = [self.separations[nearer]; 2];
            self.features = [self.features[nearer]; 2];
            self.are_corners = [self.are_corners[nearer]; 2];
        }
        self
    }

    /// Whether an end of the stretch is as near as the lines are, which are `separation` apart: if not, and
    /// there is a gap, the nearest points are corners outside of the stretch.
    #[inline(always)]
    pub(super) fn is_nearest(&self, separation: f32, tolerance: f32) -> bool {
        let nearest = separation + tolerance;
        !self.is_empty && (self.separations[0] <= nearest || self.separations[1] <= nearest)
    }

    /// The manifold of the ends whose separation is at most `margin`, the reference hull being a. `face` turns the
    /// frame of the face into the world's.
    #[inline(always)]
    pub(super) fn manifold(&self, face: Rot, offset: Vec2, noise: f32, margin: f32) -> Option<Manifold> {
        // Both points are made and the ones that count are chosen after: the usual case has both.
        let point = |i: usize| {
            let halfway = Vec2::new(self.points[i].x - 0.5 * self.separations[i], self.points[i].y);
            let corner = if self.are_corners[i] { Corner::OfB } else { Corner::Neither };
            let anchor = face.rotate(halfway);
            ManifoldPoint {
                corner,
                ..ManifoldPoint::new(anchor, offset, self.separations[i], self.features[i])
            }
        };
        let (first, second) = (point(0), point(1));
        let normal = Vec2::new(face.c, face.s);
        let length = self.points[1].y - self.points[0].y;
        // NaN is within no margin. A stretch without length has one end, not two in one place.
        let has_first = within(first.separation, margin);
        let has_second = within(second.separation, margin) && (length > noise || !has_first);
        match (has_first, has_second) {
            (true, true) => Some(Manifold::of_two(normal, first, second)),
            (true, false) => Some(Manifold::of_one(normal, first)),
            (false, true) => Some(Manifold::of_one(normal, second)),
            (false, false) => None,
        }
    }
}
