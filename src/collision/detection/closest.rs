//! The nearest points of two hulls that do not overlap: all corners of each against the other.
//!
//! Called where two corners face each other across a gap, and by the time of impact. Of the other hull only the edge counts whose line
//! a corner stands out from furthest, see [`circle_polygon`](super::circle_polygon), and none where even that line is farther
//! than what is nearest so far.

use crate::collision::{Corner, FeatureId, Manifold, ManifoldPoint};
use crate::math::{Rot, Vec2};
use crate::shape::Hull;

/// The nearest points of two hulls with a gap between them, as seen from a's frame.
#[derive(Clone, Copy)]
pub(super) struct Closest {
    on_a: Vec2,
    on_b: Vec2,
    /// Gap between the two, m.
    pub(super) distance: f32,
    /// Unit vector from a to b across the gap.
    pub(super) normal: Vec2,
    feature: FeatureId,
    /// Whether both are corners.
    is_of_corners: bool,
}

impl Closest {
    /// The nearest points, b's frame being turned by `rotation` and centred at `center` in a's; lengths below
    /// `noise`, m, are rounding. `None` where no corner of either is outside of the other. Those farther than `limit`, m,
    /// may be found or not.
    pub(super) fn find(
        a: &Hull,
        b: &Hull,
        rotation: Rot,
        center: Vec2,
        noise: f32,
        limit: f32,
    ) -> Option<Self> {
        let from_a = corner_to_edge(a, b, rotation, center, noise, limit);
        let limit = from_a.map_or(limit, |c| c.distance);
        let from_b = corner_to_edge(b, a, rotation.inverse(), rotation.unrotate(-center), noise, limit);
        let from_b = from_b.map(|c| Self {
            on_a: center + rotation.rotate(c.on_b),
            on_b: center + rotation.rotate(c.on_a),
            normal: -rotation.rotate(c.normal),
            feature: c.feature.flipped(),
            ..c
        });
        match (from_a, from_b) {
            (Some(a), Some(b)) => Some(if b.distance < a.distance { b } else { a }),
            (one, other) => one.or(other),
        }
    }

    /// The manifold of the one point halfway.
    pub(super) fn manifold(&self, rotation_a: Rot, offset: Vec2) -> Manifold {
        let halfway = rotation_a.rotate((self.on_a + self.on_b) * 0.5);
        let point = ManifoldPoint::new(halfway, offset, self.distance, self.feature);
        Manifold::of_one(rotation_a.rotate(self.normal), point)
    }

    /// The same of two cores, whose corners roll on each other.
    pub(super) fn manifold_of_rounded(&self, rotation_a: Rot, offset: Vec2) -> Manifold {
        let mut manifold = self.manifold(rotation_a, offset);
        for point in manifold.points_mut() {
            point.corner = if self.is_of_corners { Corner::OfBoth } else { Corner::Neither };
        }
        manifold
    }
}

/// The corner of b nearest to an edge of a that looks at it, of those whose line is no farther than `limit`, m.
fn corner_to_edge(
    a: &Hull,
    b: &Hull,
    rotation: Rot,
    center: Vec2,
    noise: f32,
    limit: f32,
) -> Option<Closest> {
    let (mut best, mut nearest) = (None, limit);
    for (j, &vertex) in b.vertices().iter().enumerate() {
        let corner = center + rotation.rotate(vertex);
        // The nearest point of the outline is on the edge whose line the corner stands out from furthest.
        let (gap, edge) = a.nearest_face(corner);
        // A line is met from its ends, too. NaN passes neither comparison.
        if (gap > 0.0 || a.is_segment()) && gap <= nearest {
            let closest = to_edge(a, edge, gap, corner, j, noise);
            if best.is_none() || closest.distance < nearest {
                (best, nearest) = (Some(closest), closest.distance);
            }
        }
    }
    best
}

/// From edge `i` of `a` to `corner`, which is vertex `j` of the other hull and `gap` in front of the edge's line.
fn to_edge(a: &Hull, i: usize, gap: f32, corner: Vec2, j: usize, noise: f32) -> Closest {
    let (normal, start, end) = (a.normals[i], a.vertices[i], a.vertices[a.next(i)]);
    let edge = end - start;
    let part = edge.dot(corner - start) / edge.length_squared();
    let nearer = if part < 0.5 { i } else { a.next(i) };
    let feature = FeatureId::of_vertices(nearer as u8, j as u8);
    if (0.0..=1.0).contains(&part) {
        let on_a = corner - normal * gap;
        return Closest { on_a, on_b: corner, distance: gap, normal, feature, is_of_corners: false };
    }
    let on_a = a.vertices[nearer];
    let distance = (corner - on_a).length();
    // Where the gap is all rounding its direction is lost; that of the edge is as good.
    let normal = if distance > noise { (corner - on_a) / distance } else { normal };
    Closest { on_a, on_b: corner, distance, normal, feature, is_of_corners: true }
}
