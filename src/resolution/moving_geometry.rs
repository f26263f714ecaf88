//! A contact that follows the surface: where it is while its two bodies move within the step, in closed form.
//!
//! What touches is a tip, which is a corner or a circle, and what it touches is a face or another circle. A circle may
//! roll past the end of a face, over the corner there: then it is from the corner that it is apart. A round corner is a circle
//! around the corner of the core, and a face of what has round corners is a radius before that of the core.
//!
//! ```text
//! from a to b  d' = d + Δx_b - Δx_a + (ΔR_b - 1) p_b - (ΔR_a - 1) p_a
//!                                        p: a tip, the centre of a circle, a point of a face; from the body's centre
//! past an end  d' is taken from there
//! normal       n' = ΔR n on a face, turned with the body that has it;  n' = d'/|d'| past its end and between circles
//! gap          s' = n'·d' - r            r: the radii of the circles
//! ```
//!
//! This is what detection finds as long as a tip has no other face to go to, at a fraction of its cost. Many contacts at a
//! time are computed with, those of a [`ContactBlock`](crate::resolution::contact_block::ContactBlock).

use crate::body::{Bodies, Motion};
use crate::collision::{Contact, Corner, Manifold, ManifoldPoint};
use crate::compute::{BodyState, Lane, LaneVec2, columns};
use crate::math::Vec2;
use crate::resolution::constraint::Geometry;
use crate::shape::{Exposure, Hull};

/// What touches at one of the (at most two) points, as the step began.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
struct TouchingPair<C> {
    /// Where the surfaces are, or the centres of circles, from the centres of the bodies, m.
    parts: [LaneVec2<C>; 2],
    /// From that of a to that of b, m.
    apart: LaneVec2<C>,
    /// 1 where the contact point stays with what b touches with, 0 where it stays with a's.
    stays_with_b: C,
    /// Radius of the circle that it stays with, m; 0 for a corner.
    radius: C,
}

columns!(TouchingPair { parts, apart, stays_with_b, radius });

/// A contact that follows the surface, or as many as a lane holds.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct MovingGeometry<C> {
    normal: LaneVec2<C>,
    /// 1 where the normal turns with b, 0 where it turns with a.
    turns_with_b: C,
    /// 1 where two circles touch: the normal is the line of their centres.
    is_of_circles: C,
    /// How far the face goes on from its first point, m: to its start, at most 0, and to its end, at least 0. Infinite for a
    /// corner on a face, which does not go past an end without a new manifold.
    ends: [C; 2],
    /// Sum of the radii of the circles, m.
    radii: C,
    /// Which part of the gap the contact point is away from what it stays with: half, or none on a circle that touches
    /// a face, so that the arm of friction is its radius.
    gap_part: C,
    pairs: [TouchingPair<C>; 2],
}

columns!(MovingGeometry { normal, turns_with_b, is_of_circles, ends, radii, gap_part, pairs });

impl MovingGeometry<f32> {
    /// The contact, whose manifold is that of now, if it is one of two circles, of a circle on a face or the corners at its
    /// ends, or of a corner under load on a face. A circle must not get over the next face within a step of `dt` seconds.
    pub(crate) fn new(contact: &Contact, bodies: &Bodies, dt: f32) -> Option<Self> {
        let motions = contact.colliders.map(|slot| &bodies.motions[slot as usize]);
        let offset = motions[1].pose.center - motions[0].pose.center;
        let arms = bodies.arms(contact.colliders).unwrap_or_default();
        match motions.map(|motion| motion.is_circle) {
            [true, true] => Some(Self::of_circles(contact, motions, arms, offset)),
            [false, false] => Self::of_corner(contact, bodies),
            round => Self::of_circle_on_hull(contact, bodies, usize::from(round[1]), offset, dt),
        }
    }

    fn of_circles(contact: &Contact, [a, b]: [&Motion; 2], arms: [Vec2; 2], offset: Vec2) -> Self {
        let (parts, apart) = (arms.map(LaneVec2::from), offset.into());
        let pair = TouchingPair { parts, apart, radius: a.extent, ..TouchingPair::default() };
        Self {
            // For circles with one centre, whose line has no direction.
            normal: contact.manifold.normal.into(),
            is_of_circles: 1.0,
            radii: a.extent + b.extent,
            gap_part: 0.5,
            pairs: [pair, TouchingPair::default()],
            ..Self::default()
        }
    }

    /// `circle` is 0 where a is the circle, 1 where b is.
    fn of_circle_on_hull(
        contact: &Contact,
        bodies: &Bodies,
        circle: usize,
        offset: Vec2,
        dt: f32,
    ) -> Option<Self> {
        let [circle_slot, face_slot] = [contact.colliders[circle], contact.colliders[1 - circle]];
        let [circle_arm, face_arm] = [circle_slot, face_slot].map(|slot| bodies.arm(slot));
        let face_motion = &bodies.motions[face_slot as usize];
        let shape = &bodies.shapes[face_slot as usize];
        let ((hull, rounding), rotation) = (shape.core()?, shape.rotation_at(face_motion.pose.rotation));
        // To the circle; first in the frame of the face's body.
        let to_circle = if circle == 1 { offset } else { -offset };
        let center = rotation.unrotate(to_circle);
        let outward = if circle == 1 { contact.manifold.normal } else { -contact.manifold.normal };
        let exposure = bodies.exposures_of(contact.colliders).and_then(|both| both[1 - circle]);
        let (gap, face, ends) = face_below(hull, exposure, center, rotation.unrotate(outward));
        let corners = [hull.vertices[face], hull.vertices[hull.next(face)]];
        // To an end of the face, along a face that meets there.
        let along = |other: usize, end: usize| hull.normals[other].perp().dot(corners[end] - center);
        let [round, flat] = [circle_slot, face_slot].map(|slot| bodies.state(slot));
        let speed = (round.velocity - flat.velocity).to_vec2().length()
            + flat.angular_velocity.abs() * (to_circle + face_arm).length()
            + round.angular_velocity.abs() * circle_arm.length();
        let way = speed * dt;
        let stays_off_last = ends[0] < -way || along(hull.previous(face), 0) < -way;
        let stays_off_next = ends[1] > way || along(hull.next(face), 1) > way;
        // The other face of a capsule is πr away, round its end.
        let stays_on_side = hull.is_segment() && way < 0.5 * rounding;
        let is_followed = gap > 0.0 && (stays_off_last && stays_off_next || stays_on_side);
        if !is_followed {
            return None;
        }
        let face_normal = rotation.rotate(hull.normals[face]);
        let [start, end] = ends;
        let passed_end = (start > 0.0).then_some(0).or((end < 0.0).then_some(1));
        // From the nearest point of the face.
        let (apart, ends) = match passed_end {
            None => (face_normal * gap, ends),
            Some(passed) => {
                (rotation.rotate(center - corners[passed]), ends.map(|other| other - ends[passed]))
            }
        };
        let mut parts = [LaneVec2::default(); 2];
        parts[circle] = circle_arm.into();
        parts[1 - circle] = (face_arm + to_circle - apart).into();
        let sign = if circle == 1 { 1.0 } else { -1.0 };
        let radius = bodies.motions[circle_slot as usize].extent;
        let stays_with_b = circle as f32;
        let pair = TouchingPair { parts, apart: (apart * sign).into(), stays_with_b, radius };
        Some(Self {
            normal: (face_normal * sign).into(),
            turns_with_b: 1.0 - stays_with_b,
            ends,
            radii: radius + rounding,
            pairs: [pair, TouchingPair::default()],
            ..Self::default()
        })
    }

    fn of_corner(contact: &Contact, bodies: &Bodies) -> Option<Self> {
        let manifold = &contact.manifold;
        let loaded = manifold.points().iter().find(|point| point.normal_impulse > 0.0)?;
        let radii = contact.colliders.map(|slot| bodies.shapes[slot as usize].corner_radius());
        let face = match loaded.corner {
            Corner::OfA => 1,
            Corner::OfB => 0,
            Corner::OfBoth => return Some(Self::of_round_corners(manifold, radii)),
            Corner::Neither => return None,
        };
        let normal = manifold.normal;
        let radius = radii[1 - face];
        // Of the face it is the surface that is touched, also where its body has round corners.
        let tip_radii = if face == 0 { [0.0, radius] } else { [radius, 0.0] };
        let pair = |point: &ManifoldPoint| {
            let parts = manifold.corner_centers(point, tip_radii);
            // What is no corner of the other body is where the face ends.
            let is_end = point.corner == Corner::Neither;
            let stays_with = if is_end { face } else { 1 - face };
            TouchingPair {
                parts: parts.map(LaneVec2::from),
                apart: (normal * (point.separation + radius)).into(),
                stays_with_b: stays_with as f32,
                radius: if is_end { 0.0 } else { radius },
            }
        };
        let mut pairs = [TouchingPair::default(); 2];
        for (to, point) in pairs.iter_mut().zip(manifold.points()) {
            *to = pair(point);
        }
        Some(Self {
            normal: normal.into(),
            turns_with_b: face as f32,
            ends: [f32::NEG_INFINITY, f32::INFINITY],
            radii: radius,
            gap_part: 0.5,
            pairs,
            ..Self::default()
        })
    }

    /// Two corners with these radii, m, of which one is round: as two circles around the corners of the cores.
    fn of_round_corners(manifold: &Manifold, radii: [f32; 2]) -> Self {
        let [radius, radius_b] = radii;
        let (normal, point) = (manifold.normal, &manifold.points()[0]);
        let pair = TouchingPair {
            parts: manifold.corner_centers(point, radii).map(LaneVec2::from),
            apart: (normal * (point.separation + radius + radius_b)).into(),
            radius,
            ..TouchingPair::default()
        };
        Self {
            normal: normal.into(),
            is_of_circles: 1.0,
            radii: radius + radius_b,
            gap_part: 0.5,
            pairs: [pair, TouchingPair::default()],
            ..Self::default()
        }
    }
}

/// The face that a circle around `center`, m, is before, with the normal of their contact: its gap and index, and how far it goes
/// on from there to both sides, m. Over neighbours that are flush it is as long as it takes until the next step finds these.
fn face_below(
    hull: &Hull,
    exposure: Option<&Exposure>,
    center: Vec2,
    normal: Vec2,
) -> (f32, usize, [f32; 2]) {
    let (gap, nearest) = hull.nearest_face(center);
    let Some(exposure) = exposure else { return (gap, nearest, hull.ends_from(nearest, center)) };
    // The nearest may be covered, where the circle comes to lie on another within the step.
    let face = Exposure::face_of(hull, normal).unwrap_or(nearest);
    let [start, end] = hull.ends_from(face, center);
    let [before, beyond] = exposure.goes_on(hull, face);
    let ends = [if before { f32::NEG_INFINITY } else { start }, if beyond { f32::INFINITY } else { end }];
    (hull.normals[face].dot(center) - hull.planes[face], face, ends)
}

impl<L: Lane> MovingGeometry<L> {
    /// Where the contacts are with their bodies in the states `a` and `b` within the step, up to so many `POINTS`.
    #[inline(always)]
    pub(crate) fn geometry_in<const POINTS: usize>(&self, a: &BodyState<L>, b: &BodyState<L>) -> Geometry<L> {
        let (zero, least) = (L::splat(0.0), L::splat(f32::MIN_POSITIVE));
        let moved = b.delta_position - a.delta_position;
        let turns_with_b = self.turns_with_b.greater(zero);
        let turning = BodyState::select(turns_with_b, b, a).delta_rotation;
        let mut geometry = Geometry::of_normal(self.normal + turning.displacement(self.normal));
        for index in 0..POINTS {
            let pair = &self.pairs[index];
            let [part_a, part_b] = pair.parts;
            let [swung_a, swung_b] =
                [a.delta_rotation.displacement(part_a), b.delta_rotation.displacement(part_b)];
            let mut apart = pair.apart + moved + swung_b - swung_a;
            // A circle has one point. Below the smallest normal number the direction has lost its digits.
            if index == 0 {
                let (edge, [start, end]) = (geometry.normal.perp(), self.ends);
                let along = edge.dot(apart);
                let nearest = along.max(start).min(end);
                let past = (along - nearest) * (along - nearest);
                apart = apart - edge * L::select(past.greater(zero), nearest, zero);
                let squared = apart.dot(apart);
                let is_radial = L::both((self.is_of_circles + past).greater(zero), squared.greater(least));
                let radial = apart * (L::splat(1.0) / squared.max(least).sqrt());
                geometry.normal = LaneVec2::select(is_radial, radial, geometry.normal);
            }
            let separation = geometry.normal.dot(apart) - self.radii;
            let offset = part_a + pair.apart - part_b + moved;
            let away = geometry.normal * (pair.radius + self.gap_part * separation);
            let stays_with_b = pair.stays_with_b.greater(zero);
            let anchor_a =
                LaneVec2::select(stays_with_b, part_b + swung_b - away + offset, part_a + swung_a + away);
            let anchor_b = anchor_a - offset;
            let to = &mut geometry.points[index];
            (to.anchor_a, to.anchor_b, to.separation) = (anchor_a, anchor_b, separation);
        }
        geometry
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Body, Mixed};
    use crate::collision::{Contacts, detect_within};
    use crate::compute::LaneRot;
    use crate::math::Rot;
    use crate::shape::Shape;

    /// A body that has moved by so much, and turned by `angle`, since the step began.
    fn state(moved: [f32; 2], angle: f32) -> BodyState {
        let Rot { c, s } = Rot::from_angle(angle);
        BodyState {
            delta_position: Vec2::from(moved).into(),
            delta_rotation: LaneRot { c, s },
            ..BodyState::REST
        }
    }

    /// Two bodies, the second `offset` from the first, and their contact with its deepest point under load.
    fn touching(shapes: [&Shape; 2], angles: [f32; 2], offset: Vec2) -> (Bodies, Contact) {
        let mut bodies = Bodies::default();
        let at = [Vec2::ZERO, offset];
        let keys = [0, 1].map(|side| {
            let body = Body::dynamic(*shapes[side]).at([at[side].x, at[side].y]).angle(angles[side]);
            bodies.insert(&body)
        });
        let slots = keys.map(|id| id.0.index());
        let mut contacts = Contacts::default();
        let index = contacts.begin(&mut bodies, slots, Mixed::default());
        let mut contact = contacts[index].clone();
        contact.manifold = detected(&bodies, &contact, [&BodyState::REST; 2]);
        let points = contact.manifold.points_mut();
        let deepest = points.iter_mut().min_by(|p, q| p.separation.total_cmp(&q.separation));
        deepest.expect("they touch").normal_impulse = 1.0;
        (bodies, contact)
    }

    /// What detection finds with the bodies in these states.
    fn detected(bodies: &Bodies, contact: &Contact, states: [&BodyState; 2]) -> Manifold {
        let slots = contact.slots.map(|slot| slot as usize);
        let poses = slots.map(|slot| bodies.motions[slot].pose);
        let [p, q] = [0, 1].map(|side| {
            let LaneRot { c, s } = states[side].delta_rotation;
            Rot { c, s } * poses[side].rotation
        });
        let moved = (states[1].delta_position - states[0].delta_position).to_vec2();
        let offset = poses[1].center - poses[0].center + moved;
        let [a, b] = slots.map(|slot| &bodies.shapes[slot]);
        detect_within(a, p, b, q, offset, 0.2).expect("they are near")
    }

    /// Whether the point under load is followed to where detection finds it. Lengths of 1 m round by 6e-8 some ten
    /// times.
    fn check((bodies, contact): &(Bodies, Contact), states: [BodyState; 2]) {
        let [a, b] = &states;
        let moving = MovingGeometry::new(contact, bodies, 0.01).expect("it can be followed");
        let geometry = moving.geometry_in::<2>(a, b);
        let now = detected(bodies, contact, [a, b]);
        let loaded = contact.manifold.points().iter().position(|point| point.normal_impulse > 0.0).unwrap();
        let feature = contact.manifold.points()[loaded].feature;
        let point = &geometry.points[loaded];
        let now_point =
            now.points().iter().find(|point| point.feature == feature).expect("it is still there");
        let far = |one: LaneVec2<f32>, other: Vec2| (one.to_vec2() - other).length() > 1e-6;
        assert!(!far(geometry.normal, now.normal), "{geometry:?} {now:?}");
        assert!((point.separation - now_point.separation).abs() < 1e-6, "{geometry:?} {now:?}");
        assert!(!far(point.anchor_a, now_point.anchor_a), "{geometry:?} {now:?}");
        assert!(!far(point.anchor_b, now_point.anchor_b), "{geometry:?} {now:?}");
    }

    /// Bodies that move and turn by as much as in a step of a fast game, and pairs of them in both orders.
    fn check_in_both_orders(shapes: [&Shape; 2], angles: [f32; 2], offset: Vec2) {
        let ([a, b], [p, q]) = (shapes, angles);
        for sway in [0.0, 0.005, -0.01] {
            let states = [state([0.01, -0.02], 0.03), state([-0.03, sway], -0.05)];
            check(&touching([a, b], [p, q], offset), states);
            check(&touching([b, a], [q, p], -offset), states);
        }
    }

    fn tilted(tilt: f32, [x, y]: [f32; 2]) -> Vec2 {
        Rot::from_angle(tilt).rotate(Vec2::new(x, y))
    }

    #[test]
    fn a_corner_is_followed_to_where_detection_finds_it() {
        let board = Shape::obb(4.0, 0.5);
        let triangle = Shape::polygon([[0.0, -0.6], [0.5, 0.4], [-0.5, 0.4]]).unwrap();
        for (shape, angle, height) in
            [(Shape::obb(1.0, 1.0), 0.6, 0.93), (Shape::obb(0.5, 1.5), -0.3, 1.03), (triangle, 0.2, 0.84)]
        {
            for tilt in [0.0, 0.25, -0.4] {
                check_in_both_orders([&board, &shape], [tilt, tilt + angle], tilted(tilt, [0.3, height]));
            }
        }
    }

    #[test]
    fn a_circle_is_followed_to_where_detection_finds_it() {
        let circle = Shape::circle(0.4);
        let hexagon = Shape::polygon(std::array::from_fn::<[f32; 2], 6, _>(|i| {
            let Rot { c, s } = Rot::from_angle(std::f32::consts::TAU * (i as f32 / 6.0 - 0.25 + 1.0 / 12.0));
            [1.2 * c, 1.2 * s]
        }))
        .unwrap();
        for tilt in [0.0, 0.25, -0.4] {
            check_in_both_orders([&Shape::obb(4.0, 0.5), &circle], [tilt, 0.7], tilted(tilt, [0.3, 0.64]));
            check_in_both_orders([&hexagon, &circle], [tilt, 0.7], tilted(tilt, [0.1, 1.44]));
            check_in_both_orders([&Shape::circle(0.7), &circle], [tilt, 0.7], tilted(tilt, [0.5, 0.97]));
        }
    }

    /// A round end or corner on a face, and faces and ends that are round under a disc.
    #[test]
    fn what_is_round_is_followed_to_where_detection_finds_it() {
        let (board, circle) = (Shape::obb(4.0, 0.5), Shape::circle(0.4));
        let capsule = Shape::capsule([0.0, -0.5], [0.0, 0.5], 0.25);
        let square = [[-0.4, -0.4], [0.4, -0.4], [0.4, 0.4], [-0.4, 0.4]];
        let tile = Shape::rounded(square, 0.1).unwrap();
        let lying = Shape::capsule([-2.0, 0.0], [2.0, 0.0], 0.25);
        for tilt in [0.0, 0.25, -0.4] {
            for floor in [&board, &lying] {
                check_in_both_orders([floor, &capsule], [tilt, tilt + 0.3], tilted(tilt, [0.3, 0.97]));
                check_in_both_orders([floor, &tile], [tilt, tilt + 0.6], tilted(tilt, [0.3, 0.89]));
            }
            for place in [[0.3, 0.64], [1.98, 0.64], [2.1, 0.63], [2.5, 0.4]] {
                check_in_both_orders([&lying, &circle], [tilt, 0.7], tilted(tilt, place));
            }
        }
    }

    /// End on end, end on the end of a board, and corner on corner.
    #[test]
    fn round_corners_are_followed_as_they_roll_on_each_other() {
        let board = Shape::obb(2.0, 0.5);
        let [capsule, lying] =
            [[0.0_f32, -0.5], [-0.5, 0.0]].map(|[x, y]| Shape::capsule([x, y], [-x, -y], 0.25));
        for tilt in [0.0, 0.25, -0.4] {
            check_in_both_orders([&capsule, &capsule], [tilt, tilt], tilted(tilt, [0.1, 1.48]));
            check_in_both_orders([&lying, &capsule], [tilt, tilt + 0.2], tilted(tilt, [0.8, 0.93]));
            check_in_both_orders([&board, &capsule], [tilt, tilt], tilted(tilt, [1.15, 0.92]));
        }
    }

    /// Before the end of a face by less than it moves, behind it by less and by more; at both ends, and a sharp corner.
    #[test]
    fn a_circle_is_followed_over_a_corner() {
        let (circle, board) = (Shape::circle(0.8), Shape::obb(2.0, 0.5));
        let triangle = Shape::polygon([[-1.0, -0.25], [1.0, -0.25], [0.0, 0.5]]).unwrap();
        for tilt in [0.0, 0.25, -0.4] {
            for place in [[0.98, 1.04], [1.01, 1.04], [1.4, 0.92], [-0.98, 1.04], [-1.01, 1.04], [-1.4, 0.92]]
            {
                check_in_both_orders([&board, &circle], [tilt, 0.7], tilted(tilt, place));
            }
            for place in [[0.99, -1.04], [1.01, -1.04], [1.5, -0.85], [1.75, -0.1]] {
                check_in_both_orders([&triangle, &circle], [tilt, 0.7], tilted(tilt, place));
            }
        }
    }

    /// Where the next face may come to be the nearest, detection has to be asked.
    #[test]
    fn a_circle_that_may_get_over_the_next_face_is_not_followed() {
        for (place, speed, is_followed) in [
            ([1.9, 0.63], 20.0, true),
            ([1.9, 0.63], 60.0, false),
            ([2.37, 0.3], 20.0, true),
            ([2.37, 0.3], 60.0, false),
        ] {
            let shapes = [&Shape::obb(4.0, 0.5), &Shape::circle(0.4)];
            let (mut bodies, contact) = touching(shapes, [0.0; 2], Vec2::from(place));
            let row = bodies.motions[contact.slots[1] as usize].row as usize;
            bodies.states[row].velocity = Vec2::new(speed, 0.0).into();
            assert_eq!(
                MovingGeometry::new(&contact, &bodies, 0.01).is_some(),
                is_followed,
                "{place:?}, {speed} m/s"
            );
        }
    }

    /// Circles with one centre: what has no direction.
    #[test]
    fn circles_with_one_centre_keep_a_normal() {
        let (bodies, contact) = touching([&Shape::circle(0.5); 2], [0.0; 2], Vec2::new(0.25, 0.0));
        let moving = MovingGeometry::new(&contact, &bodies, 0.01).unwrap();
        let geometry = moving.geometry_in::<1>(&BodyState::REST, &state([-0.25, 0.0], 0.0));
        assert!((geometry.normal.dot(geometry.normal) - 1.0).abs() < 1e-6, "{geometry:?}");
        assert!(geometry.points[0].separation.is_finite(), "{geometry:?}");
    }
}
