//! A corner under load on a face: where the contact is while its two bodies move within the step.
//!
//! ```text
//! gap      d' = n s + Δx_b - Δx_a + (ΔR_b - 1) p_b - (ΔR_a - 1) p_a      p: where the surfaces are, from the centres
//! normal   n' = ΔR n, turned with the body that has the face
//! gap      s' = n'·d'
//! point    half of s' from the corner, which turns with its body
//! ```
//!
//! This is what detection finds as long as the corner stays on the face, at a tenth of its cost.

use crate::collision::{Corner, FeatureId, Manifold, ManifoldPoint};
use crate::compute::BodyState;
use crate::math::Vec2;

/// A corner this many times as far from the centre of the other body as any point of its outline has left its face, no
/// unit: what is frozen then is found anew in the next step, and no arm grows without bounds.
const SLACK: f32 = 1.1;

/// One of the (at most two) points of the contact as the step began.
#[derive(Clone, Copy, Debug, Default)]
struct PivotPoint {
    /// Where the surface of each body is, from its centre, m.
    surfaces: [Vec2; 2],
    /// Gap along the normal, m.
    separation: f32,
    /// Which of the bodies it stays with: 0 for a, 1 for b.
    stays_with: usize,
}

/// A corner on a face, and what other point the contact has, as the step began.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pivot {
    normal: Vec2,
    /// Centre of b from the centre of a, m.
    offset: Vec2,
    /// Which of the bodies has the face.
    face: usize,
    /// Square of the distance from its centre at which the corner must have left the face, m².
    reach_squared: f32,
    points: [PivotPoint; 2],
    count: usize,
}

impl Pivot {
    /// A contact that pivots, if it does so on a corner that stands on a face; `offset` is the centre of b from that of
    /// a, m, `extents` the greatest distances of the outlines of a and b from their centres, m.
    pub(crate) fn new(manifold: &Manifold, offset: Vec2, extents: [f32; 2]) -> Option<Self> {
        let loaded = manifold.points().iter().find(|point| point.normal_impulse > 0.0)?;
        let face = match loaded.corner {
            Corner::OfA => 1,
            Corner::OfB => 0,
            Corner::Neither => return None,
        };
        let normal = manifold.normal;
        let mut points = [PivotPoint::default(); 2];
        for (to, point) in points.iter_mut().zip(manifold.points()) {
            let half_gap = normal * (0.5 * point.separation);
            *to = PivotPoint {
                surfaces: [point.anchor_a - half_gap, point.anchor_b + half_gap],
                separation: point.separation,
                // What is no corner of the other body is where the face ends.
                stays_with: if point.corner == Corner::Neither { face } else { 1 - face },
            };
        }
        let reach_squared = (SLACK * extents[face]).powi(2);
        Some(Self { normal, offset, face, reach_squared, points, count: manifold.points().len() })
    }

    /// The manifold with the bodies in the states `a` and `b` within the step, without features and impulses; `None`
    /// where the corner must have left the face.
    pub(crate) fn manifold_in(&self, a: &BodyState, b: &BodyState) -> Option<Manifold> {
        let moved = Vec2::from(b.delta_position - a.delta_position);
        let offset = self.offset + moved;
        let normal = self.normal + displacement([a, b][self.face], self.normal);
        let point = |point: &PivotPoint| {
            let [surface_a, surface_b] = point.surfaces;
            let swung = [displacement(a, surface_a), displacement(b, surface_b)];
            let separation = normal.dot(self.normal * point.separation + moved + swung[1] - swung[0]);
            let half_gap = normal * (0.5 * separation);
            let anchor_a = if point.stays_with == 0 {
                surface_a + swung[0] + half_gap
            } else {
                offset + surface_b + swung[1] - half_gap
            };
            ManifoldPoint::new(anchor_a, offset, separation, FeatureId::default())
        };
        let [first, second] = &self.points;
        let manifold = match self.count {
            1 => Manifold::of_one(normal, point(first)),
            _ => Manifold::of_two(normal, point(first), point(second)),
        };
        let is_on_face = |point: &ManifoldPoint| {
            [point.anchor_a, point.anchor_b][self.face].length_squared() <= self.reach_squared
        };
        manifold.points().iter().all(is_on_face).then_some(manifold)
    }
}

/// How far the turning of a body since the step began carries what is at `from` its centre, m.
fn displacement(state: &BodyState, from: Vec2) -> Vec2 {
    state.delta_rotation.displacement(from.into()).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::detect_within;
    use crate::compute::LaneRot;
    use crate::math::Rot;
    use crate::shape::Shape;

    fn state(moved: [f32; 2], angle: f32) -> BodyState {
        let Rot { c, s } = Rot::from_angle(angle);
        BodyState {
            delta_position: Vec2::from(moved).into(),
            delta_rotation: LaneRot { c, s },
            ..BodyState::at_rest()
        }
    }

    /// Boxes and a triangle that stand on a corner, in both orders, and bodies that move and turn by as much as in a
    /// step of a fast game: what is followed is what detection finds. Lengths of 1 m round by 6e-8 some ten times.
    #[test]
    fn a_corner_that_is_followed_is_where_detection_finds_it() {
        let board = Shape::obb(4.0, 0.5);
        let triangle = Shape::polygon([[0.0, -0.6], [0.5, 0.4], [-0.5, 0.4]]).unwrap();
        for (shape, angle, height) in
            [(Shape::obb(1.0, 1.0), 0.6, 0.93), (Shape::obb(0.5, 1.5), -0.3, 1.03), (triangle, 0.2, 0.84)]
        {
            for (number, tilt) in [0.0, 0.25, -0.4].into_iter().enumerate() {
                let tilt = Rot::from_angle(tilt);
                let (shapes, rotations) = ([&board, &shape], [tilt, tilt * Rot::from_angle(angle)]);
                let offset = tilt.rotate(Vec2::new(0.3, height));
                let states = [state([0.01, -0.02], 0.03), state([-0.03, 0.005 * number as f32], -0.05)];
                for [a, b] in [[0, 1], [1, 0]] {
                    let offset = if a == 0 { offset } else { -offset };
                    let detected = |[p, q]: [Rot; 2], offset: Vec2| {
                        detect_within(shapes[a], p, shapes[b], q, offset, 0.2).expect("they are near")
                    };
                    let mut then = detected([rotations[a], rotations[b]], offset);
                    let deepest =
                        then.points_mut().iter_mut().min_by(|p, q| p.separation.total_cmp(&q.separation));
                    deepest.expect("there is a point").normal_impulse = 1.0;
                    let followed = Pivot::new(&then, offset, [3.0; 2])
                        .expect("it is a corner")
                        .manifold_in(&states[a], &states[b])
                        .expect("it is on the face");
                    let turned = [a, b].map(|side| {
                        let LaneRot { c, s } = states[side].delta_rotation;
                        Rot { c, s } * rotations[side]
                    });
                    let moved = Vec2::from(states[b].delta_position - states[a].delta_position);
                    let now = detected(turned, offset + moved);
                    assert!((followed.normal - now.normal).length() < 1e-6, "{followed:?} {now:?}");
                    let loaded = then.points().iter().position(|point| point.normal_impulse > 0.0).unwrap();
                    let point = &followed.points()[loaded];
                    let feature = then.points()[loaded].feature;
                    let now = now
                        .points()
                        .iter()
                        .find(|point| point.feature == feature)
                        .expect("it is still there");
                    assert!((point.separation - now.separation).abs() < 1e-6, "{point:?} {now:?}");
                    assert!((point.anchor_a - now.anchor_a).length() < 1e-6, "{point:?} {now:?}");
                    assert!((point.anchor_b - now.anchor_b).length() < 1e-6, "{point:?} {now:?}");
                }
            }
        }
    }

    #[test]
    fn a_circle_is_no_pivot() {
        let (floor, ball) = (Shape::aabb(4.0, 1.0), Shape::circle(0.5));
        let offset = Vec2::new(0.3, 0.99);
        let mut manifold = detect_within(&floor, Rot::IDENTITY, &ball, Rot::IDENTITY, offset, 0.0).unwrap();
        manifold.points_mut()[0].normal_impulse = 1.0;
        assert!(Pivot::new(&manifold, offset, [2.1, 0.5]).is_none());
    }
}
