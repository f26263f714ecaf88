//! Manifolds within a step: where the bodies are now, and not where they were when the step began.
//!
//! A normal that stands still while a disc rolls on along a curve costs energy, as each step redirects the whole
//! velocity at once; a body that topples over a corner falls too late if its arm lags behind; a corner that has
//! swung on is not where a blow lands. So circles, and corners under load, follow the surface from substep to
//! substep, unless the bodies hardly move, and an impact finds its manifold at its own time.

use crate::body::Bodies;
use crate::collision::{Contact, Contacts, Manifold, Placed, detect_within, without_ghosts};
use crate::compute::{BodyState, Executor, Lane, PairStates};
use crate::math::{Rot, Vec2};
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::constraint_graph::{BlockIndex, ConstraintGraph, GraphIndex};
use crate::resolution::contact_block::{BlockMarks, ContactBlock};
use crate::resolution::kernel::{Kernel, MOST_TURNED};
use crate::resolution::moving_geometry::MovingGeometry;

/// Far enough that the nearest points of two bodies are found wherever they are, m.
const ANY_DISTANCE: f32 = 1e9;

/// By its cosine, to the second order, the angle beyond which a normal that turns in the move lets its contact forget what it bore: discs that
/// roll over each other at 60 m/s took back, along another normal, what had pushed them apart, and left with 1.3 times their energy.
const LEAST_ALIKE: f32 = 1.0 - 0.5 * MOST_TURNED * MOST_TURNED;

/// The manifold of two shapes, with their bodies in the given states and anchors from their centres of mass; empty where they cannot be
/// told apart from bodies that do not touch.
pub(crate) fn manifold_in(colliders: [u32; 2], bodies: &Bodies, [a, b]: [&BodyState; 2]) -> Manifold {
    let [slot_a, slot_b] = colliders.map(|slot| slot as usize);
    let (pose_a, pose_b) = (bodies.motions[slot_a].pose, bodies.motions[slot_b].pose);
    let turned = |state: &BodyState, rotation: Rot| {
        Rot { c: state.delta_rotation.c, s: state.delta_rotation.s } * rotation
    };
    let mut offset = (pose_b.center - pose_a.center) + (b.delta_position - a.delta_position).to_vec2();
    let arms = bodies.arms(colliders);
    if let Some(arms) = arms {
        offset += swung(arms[1], b) - swung(arms[0], a);
    }
    let rotations = [turned(a, pose_a.rotation), turned(b, pose_b.rotation)];
    let shapes = [&bodies.shapes[slot_a], &bodies.shapes[slot_b]];
    let mut found = detect_within(shapes[0], rotations[0], shapes[1], rotations[1], offset, ANY_DISTANCE);
    if let Some(exposures) = bodies.exposures_of(colliders) {
        let placed = Placed { shapes, rotations, offset, margin: ANY_DISTANCE };
        found = found.and_then(|found| without_ghosts(found, exposures, placed));
    }
    let mut manifold = found.unwrap_or_default();
    if let Some(arms) = arms {
        manifold.move_anchors([arms[0] + swung(arms[0], a), arms[1] + swung(arms[1], b)]);
    }
    manifold
}

/// How far the end of an arm, m, has swung as its body turned within the step.
fn swung(arm: Vec2, state: &BodyState) -> Vec2 {
    state.delta_rotation.displacement(arm.into()).to_vec2()
}

/// The constraint of a contact at a place of the graph with its bodies in the given states, and the separation of its first
/// point there, m; `None` where one of its points is gone.
pub(crate) fn constraint_in(
    contact: &Contact,
    home: GraphIndex,
    bodies: &Bodies,
    graph: &ConstraintGraph,
    [a, b]: &[BodyState; 2],
) -> Option<(ContactConstraint<f32>, f32)> {
    let manifold = manifold_in(contact.colliders, bodies, [a, b]).restricted_to(&contact.manifold)?;
    let mut constraint = graph.constraint(home);
    constraint.set_manifold_in(&manifold, a, b);
    Some((constraint, manifold.points()[0].separation))
}

/// Contacts whose geometry moves within the step.
#[derive(Clone, Debug, Default)]
pub(crate) struct MovingContacts {
    /// Whether some blocks have contacts whose geometry moves in closed form.
    has_closed_forms: bool,
    /// By index, and place in the graph: those whose manifold has to be found anew. Where they are left as the step began, card
    /// houses fall and piles do not come to rest.
    found_anew: Vec<(u32, GraphIndex)>,
}

impl MovingContacts {
    pub(crate) fn clear(&mut self) {
        self.has_closed_forms = false;
        self.found_anew.clear();
    }

    /// Takes up those of a block.
    pub(crate) fn take_up_block(&mut self, block: BlockIndex, marks: BlockMarks, graph: &ConstraintGraph) {
        self.has_closed_forms |= marks.moving.any();
        marks.found_anew.for_each(|place| {
            let home = block.contact(place);
            self.found_anew.push((graph.contact_at(home), home));
        });
    }

    /// Brings the constraints up to where the bodies are now.
    pub(crate) fn follow(
        &self,
        executor: Executor<'_>,
        contacts: &Contacts,
        bodies: &mut Bodies,
        graph: &mut ConstraintGraph,
    ) {
        for &(index, place) in &self.found_anew {
            let states = graph.rows(place).map(|row| bodies.states[row as usize]);
            if let Some((constraint, _)) = constraint_in(&contacts[index], place, bodies, graph, &states) {
                graph.set_geometry(place, &constraint);
            }
        }
        if self.has_closed_forms {
            graph.for_each(executor, &mut bodies.states, &Follow);
        }
    }
}

/// Brings the contacts of a block up to where their bodies are.
#[derive(Clone, Debug)]
struct Follow;

impl Kernel for Follow {
    #[inline(always)]
    fn run<L: Lane>(&self, block: &mut ContactBlock, states: &mut PairStates<'_>, place: usize) {
        let Some((geometry, moving)) = block.moving::<L>(place) else { return };
        if block.fit().is_single {
            follow::<L, 1>(&geometry, moving, block, states, place);
        } else {
            follow::<L, 2>(&geometry, moving, block, states, place);
        }
    }
}

#[inline(always)]
fn follow<L: Lane, const POINTS: usize>(
    geometry: &MovingGeometry<L>,
    moving: L::Mask,
    block: &mut ContactBlock,
    states: &PairStates<'_>,
    place: usize,
) {
    let [a, b] = states.gather::<L>(place);
    let geometry = geometry.geometry_in::<POINTS>(&a, &b);
    let before = block.load::<L>(place);
    let mut after = before;
    after.set_geometry_in::<POINTS>(&geometry, &a, &b);
    block.store_geometry(place, &before.with_geometry_where(moving, &after));
    let has_turned = L::both(moving, L::splat(LEAST_ALIKE).greater(before.normal.dot(after.normal)));
    if L::bits(has_turned) != 0 {
        block.forget_load_where::<L, POINTS>(place, has_turned);
    }
}
