//! Clipping: the stretch that two facing edges have in common, and the manifold made of its ends.
//!
//! The reference edge gives the normal, the incident edge of the other hull is cut off by the lines through the
//! reference edge's ends (I. Sutherland and G. Hodgman, 1974). All in the frame of the reference hull, where its
//! edge is exact.

use crate::collision::{FeatureId, Manifold};
use crate::math::{Rot, Vec2};

/// An edge of a hull and the indices of its ends.
#[derive(Clone, Copy)]
pub(super) struct Edge {
    pub(super) start: Vec2,
    pub(super) end: Vec2,
    pub(super) first: u8,
    pub(super) second: u8,
}

impl Edge {
    /// The edge turned by `rotation`, then moved by `center`: from its hull's frame into the other's.
    #[inline(always)]
    pub(super) fn placed(self, rotation: Rot, center: Vec2) -> Self {
        Self { start: center + rotation.rotate(self.start), end: center + rotation.rotate(self.end), ..self }
    }
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

/// The ends of the common stretch of two edges, in the frame of the reference hull.
pub(super) struct Stretch {
    /// On the incident edge: near the reference edge's start, then near its end.
    points: [Vec2; 2],
    separations: [f32; 2],
    features: [FeatureId; 2],
    /// Length of the stretch along the reference edge, m; negative where the edges lie past each other.
    length: f32,
}

/// Clips the edge `incident` to the sides of `reference`, whose line is at `plane` along `normal`.
#[inline(always)]
pub(super) fn clip(reference: Edge, normal: Vec2, plane: f32, incident: Edge) -> Stretch {
    // Coordinates along the reference edge; the incident edge runs the other way.
    let along = normal.perp();
    let (low, high) = (along.dot(reference.start), along.dot(reference.end));
    let (incident_low, incident_high) = (along.dot(incident.end), along.dot(incident.start));
    // Cut off what is past an end, as a part of the incident edge. One that stands upright has no length along
    // the reference edge; the smallest number in its place keeps 0/0 away.
    let per_length = 1.0 / (incident_high - incident_low).max(f32::MIN_POSITIVE);
    let cut_low = ((low - incident_low) * per_length).clamp(0.0, 1.0);
    let cut_high = ((incident_high - high) * per_length).clamp(0.0, 1.0);
    let edge = incident.start - incident.end;
    let points = [incident.end + edge * cut_low, incident.start - edge * cut_high];
    Stretch {
        points,
        separations: [normal.dot(points[0]) - plane, normal.dot(points[1]) - plane],
        features: [
            FeatureId::of_vertices(reference.first, incident.second),
            FeatureId::of_vertices(reference.second, incident.first),
        ],
        length: high.min(incident_high) - low.max(incident_low),
    }
}

impl Stretch {
    /// Whether an end of the stretch is as near as the lines are, which are `separation` apart: if not, and
    /// there is a gap, the nearest points are corners outside of the stretch.
    #[inline(always)]
    pub(super) fn is_nearest(&self, separation: f32, tolerance: f32) -> bool {
        self.length >= 0.0 && self.separations[0].min(self.separations[1]) <= separation + tolerance
    }

    /// The manifold of the ends whose separation is at most `margin`, the reference hull being a.
    #[inline(always)]
    pub(super) fn manifold(
        &self,
        normal: Vec2,
        rotation_a: Rot,
        offset: Vec2,
        noise: f32,
        margin: f32,
    ) -> Option<Manifold> {
        let mut manifold = Manifold::new(rotation_a.rotate(normal));
        // A stretch without length has one end, not two in one place.
        let count = if self.length > noise { 2 } else { 1 };
        for i in 0..count {
            let separation = self.separations[i];
            // NaN is not within any margin.
            if separation <= margin {
                let halfway = self.points[i] - normal * (0.5 * separation);
                manifold.push(rotation_a.rotate(halfway), offset, separation, self.features[i]);
            }
        }
        (!manifold.points().is_empty()).then_some(manifold)
    }
}
