//! Tangles: bodies of several shapes that are deep in each other, as they were set there.
//!
//! Two convex shapes have one direction in which they part soonest. Of bodies of several shapes one pair of shapes may ask for the
//! opposite of what another asks for, and so may those of a third body. Pushed so, they press against each other. The bodies hardly move,
//! so that no speed tells the solver that it pushes too hard: impulses grow from substep to substep, and become speed when the shapes slip
//! past each other. Two crosses came to 90 m/s in a heap, sixty letters that were set into one place to 130 m/s.
//!
//! So in a tangle the sweeps see no overlap, and each substep begins without impulses; after the substeps the bodies are
//! [moved](crate::resolution::projection) apart, which makes no speed.
//!
//! Looks at each contact once per step, in worlds with bodies of several shapes.

use crate::body::Bodies;
use crate::collision::{Contact, Contacts};
use crate::compute::BodyState;
use crate::math::Vec2;
use crate::resolution::constraint_graph::{ConstraintGraph, GraphIndex};
use crate::resolution::projection::Project;
use crate::resolution::softness::{DEEP_SHARE, PUSH_SPEED};

/// What lies between two others is squeezed by their loads, and may overlap both: up to this share it is pushed apart as all is, no unit.
/// With a tenth, the bodies of a heap sink into each other, and heavy ones push light ones out through walls; with all, five letters in
/// one place come to 16 m/s, at 240 J.
const SQUEEZED_SHARE: f32 = 0.25;

/// What a contact of shapes that are deep in each other does to one of its bodies.
#[derive(Clone, Copy, Debug)]
struct Push {
    /// Slots of the body, and of the one that pushes it.
    bodies: [u32; 2],
    direction: Vec2,
    /// Overlap as a share of the width of the narrower body, no unit.
    depth: f32,
    index: u32,
    home: GraphIndex,
}

impl Push {
    /// What a contact does to both of its bodies, if these are deep in each other, are both moved by contacts, and one of them has several
    /// shapes.
    fn both(index: u32, contact: &Contact, bodies: &Bodies, home: GraphIndex) -> Option<[Self; 2]> {
        let colliders @ [a, b] = contact.colliders;
        if !(bodies.is_one_of_several(a) || bodies.is_one_of_several(b)) {
            return None;
        }
        let are_moved = colliders.iter().all(|&slot| bodies.motions[slot as usize].inverse_mass > 0.0);
        let depth = contact.penetration() / bodies.width_of_body(a).min(bodies.width_of_body(b));
        let ([a, b], normal) = (bodies.bodies_of(colliders), contact.manifold.normal);
        let push = |bodies, direction| Self { bodies, direction, depth, index, home };
        (are_moved && depth > DEEP_SHARE).then(|| [push([a, b], -normal), push([b, a], normal)])
    }

    /// Whether two that push the same body do it more than a right angle apart, and deeper than loads do.
    fn is_opposed_to(&self, other: &Self) -> bool {
        let share = if self.bodies == other.bodies { DEEP_SHARE } else { SQUEEZED_SHARE };
        self.direction.dot(other.direction) < 0.0 && self.depth.min(other.depth) > share
    }
}

/// The stage and its buffers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tangles {
    /// The contacts in them, each once.
    tangled: Vec<(u32, GraphIndex)>,
    /// Scratch: what all do that are deep, by body.
    pushes: Vec<Push>,
}

impl Tangles {
    /// Finds them; other deep contacts are as all contacts are.
    pub(crate) fn prepare(&mut self, bodies: &Bodies, contacts: &Contacts, graph: &mut ConstraintGraph) {
        self.tangled.clear();
        if bodies.compounds.is_empty() {
            return;
        }
        self.pushes.clear();
        for &index in contacts.awake() {
            let pushes = graph.home(index).and_then(|home| Push::both(index, &contacts[index], bodies, home));
            self.pushes.extend(pushes.into_iter().flatten());
        }
        self.pushes.sort_unstable_by_key(|push| (push.bodies, push.index));
        for of_body in self.pushes.chunk_by(|one, other| one.bodies[0] == other.bodies[0]) {
            let is_opposed = |one: &&Push| of_body.iter().any(|other| one.is_opposed_to(other));
            self.tangled.extend(of_body.iter().filter(is_opposed).map(|push| (push.index, push.home)));
        }
        self.tangled.sort_unstable_by_key(|&(index, _)| index);
        self.tangled.dedup_by_key(|&mut (index, _)| index);
        for &(_, home) in &self.tangled {
            graph.set_tangled(home);
        }
    }

    /// Moves their bodies apart at the end of a step of length `dt`, s, no contact faster than others are pushed.
    pub(crate) fn untangle(&self, graph: &mut ConstraintGraph, states: &mut [BodyState], dt: f32) {
        let project = Project { slop: 0.0, farthest: PUSH_SPEED * dt };
        for &(_, home) in &self.tangled {
            graph.run_at(home, states, &project);
        }
    }
}
