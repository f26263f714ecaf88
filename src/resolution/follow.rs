//! Manifolds within a step: where the bodies are now, and not where they were when the step began.
//!
//! A normal that stands still while a disc rolls on along a curve costs energy, as each step redirects the whole
//! velocity at once; a body that topples over a corner falls too late if its arm lags behind; a corner that has
//! swung on is not where a blow lands. So circles, and corners under load, follow the surface from substep to
//! substep, unless their manifold is kept because the bodies hardly move, and an impact finds its manifold at its
//! own time.

use crate::body::Bodies;
use crate::collision::{Contact, Contacts, Manifold, detect_within};
use crate::compute::{BodyState, GROUND_ROW};
use crate::math::{Rot, Vec2};
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::constraint_graph::ConstraintGraph;
use crate::resolution::pivot::Pivot;

/// Far enough that the nearest points of two bodies are found wherever they are, m.
const ANY_DISTANCE: f32 = 1e9;

/// The manifold of a contact with its bodies in the given states; empty where they cannot be told apart from
/// bodies that do not touch.
pub(crate) fn manifold_in(contact: &Contact, bodies: &Bodies, [a, b]: [&BodyState; 2]) -> Manifold {
    let [slot_a, slot_b] = contact.slots.map(|slot| slot as usize);
    let (pose_a, pose_b) = (bodies.motions[slot_a].pose, bodies.motions[slot_b].pose);
    let turned = |state: &BodyState, rotation: Rot| {
        Rot { c: state.delta_rotation.c, s: state.delta_rotation.s } * rotation
    };
    let offset = (pose_b.center - pose_a.center) + Vec2::from(b.delta_position - a.delta_position);
    let rotations = [turned(a, pose_a.rotation), turned(b, pose_b.rotation)];
    let shapes = [&bodies.shapes[slot_a], &bodies.shapes[slot_b]];
    detect_within(shapes[0], rotations[0], shapes[1], rotations[1], offset, ANY_DISTANCE).unwrap_or_default()
}

/// Contacts that follow the surface within the step, with their places in the constraint graph.
#[derive(Clone, Debug, Default)]
pub(crate) struct Followers {
    /// By index: those whose manifold has to be found anew.
    found_anew: Vec<(u32, (u32, u32))>,
    /// Those of a corner on a face.
    pivots: Vec<(Pivot, (u32, u32))>,
}

impl Followers {
    pub(crate) fn clear(&mut self) {
        self.found_anew.clear();
        self.pivots.clear();
    }

    /// Takes up a contact with a circle, or of a single corner under load, if its manifold was found anew. A
    /// corner that is still on its way has the manifold of the place where it will land.
    pub(crate) fn consider(&mut self, index: u32, contact: &Contact, bodies: &Bodies) {
        let (false, Some(place)) = (contact.is_kept, contact.graph_place) else { return };
        let has_circle = contact.slots.into_iter().any(|slot| bodies.motions[slot as usize].is_round);
        if has_circle || contact.pivots() {
            let [a, b] = contact.slots.map(|slot| bodies.motions[slot as usize].pose.center);
            let extents = contact.slots.map(|slot| bodies.motions[slot as usize].extent);
            match Pivot::new(&contact.manifold, b - a, extents) {
                Some(pivot) => self.pivots.push((pivot, place)),
                None => self.found_anew.push((index, place)),
            }
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.found_anew.is_empty() && self.pivots.is_empty()
    }

    /// Brings the constraints up to where the bodies are now.
    pub(crate) fn follow(&self, contacts: &Contacts, bodies: &Bodies, constraints: &mut Constraints<'_>) {
        for (number, &(index, place)) in self.found_anew.iter().enumerate() {
            let ahead = |by: usize| self.found_anew.get(number + by).map(|&(index, _)| index);
            contacts.prefetch_ahead(bodies, ahead);
            let [a, b] = constraints.graph.rows(place).map(|row| &bodies.states[row as usize]);
            let contact = &contacts[index];
            if let Some(manifold) = manifold_in(contact, bodies, [a, b]).restricted_to(&contact.manifold) {
                constraints.bring_to(place, &manifold, [a, b]);
            }
        }
        for (pivot, place) in &self.pivots {
            let [a, b] = constraints.graph.rows(*place).map(|row| &bodies.states[row as usize]);
            if let Some(manifold) = pivot.manifold_in(a, b) {
                constraints.bring_to(*place, &manifold, [a, b]);
            }
        }
    }
}

/// Constraints that are brought up to date within the step.
#[derive(Debug)]
pub(crate) struct Constraints<'a> {
    pub(crate) graph: &'a mut ConstraintGraph,
    /// By row: what of the warm start the bodies still get; none where they get nothing.
    pub(crate) shares: &'a mut [BodyState],
}

impl Constraints<'_> {
    /// Gives the constraint at a place of the graph the normal and the points of a manifold of its bodies in the states
    /// `a` and `b`, and turns its part of the shares.
    fn bring_to(&mut self, place: (u32, u32), manifold: &Manifold, [a, b]: [&BodyState; 2]) {
        let (block, place) = self.graph.block_mut(place);
        let before = block.load_one(place);
        let mut constraint = before;
        constraint.set_geometry_in(manifold, a, b);
        block.store_geometry(place, &constraint);
        let has_share = before.frictions.iter().any(|friction| friction.normal_share > 0.0);
        if has_share && !self.shares.is_empty() {
            let rows = block.moved_rows(place);
            add_shares([(&before, -1.0), (&constraint, 1.0)], rows, self.shares);
        }
    }
}

/// Adds what the share of a contact gives its bodies, times a factor, to their rows; of each of `constraints`, which
/// are the contact with different geometries. Before the sweep after the move, the impulse along the tangent is the
/// share.
pub(crate) fn add_shares<const N: usize>(
    constraints: [(&ContactConstraint<f32>, f32); N],
    rows: [u32; 2],
    shares: &mut [BodyState],
) {
    let mut pair = rows.map(|row| shares[row as usize]);
    let [a, b] = &mut pair;
    for (constraint, factor) in constraints {
        for (point, friction) in constraint.points.iter().zip(&constraint.frictions) {
            if friction.normal_share > 0.0 || friction.impulse != 0.0 {
                let normal = constraint.normal * (factor * friction.normal_share);
                let tangent = constraint.normal.perp() * (factor * friction.impulse);
                constraint.apply(point, normal + tangent, a, b);
            }
        }
    }
    for (row, share) in rows.into_iter().zip(pair) {
        if row != GROUND_ROW {
            shares[row as usize] = share;
        }
    }
}
