//! Tangles: bodies of several shapes that are deep in each other, as they were set there.
//!
//! Two convex shapes have one direction in which they part soonest. Of bodies of several shapes one pair of shapes may ask for the
//! opposite of what another asks for. Pushed so, they press against each other. The bodies hardly move, so that no speed tells the
//! solver that it pushes too hard: impulses grow from substep to substep, and become speed when the shapes slip past each other. Two
//! crosses came to 90 m/s in a heap, sixty letters that were set into one place to 130 m/s.
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
use crate::resolution::softness::PUSH_SPEED;

/// Shapes are deep in each other that overlap by this share of the width of the narrower of their bodies, no unit. What is fitted closely
/// into a hole touches both sides of it, but overlaps them by less. With a quarter, sixty letters in one place still came to 97 m/s; with
/// 3 %, light bodies under heavy ones are twice as fast as with a tenth.
const DEEP_SHARE: f32 = 0.1;

/// Whether shapes are deep in each other, of bodies that are both moved by contacts, and of which one has several.
fn is_deep(contact: &Contact, bodies: &Bodies) -> bool {
    let [a, b] = contact.colliders;
    if !(bodies.is_one_of_several(a) || bodies.is_one_of_several(b)) {
        return false;
    }
    let are_moved = [a, b].iter().all(|&slot| bodies.motions[slot as usize].inverse_mass > 0.0);
    let width = bodies.width_of_body(a).min(bodies.width_of_body(b));
    are_moved && contact.penetration() > DEEP_SHARE * width
}

/// A contact of shapes that are deep in each other.
#[derive(Clone, Copy, Debug)]
struct DeepContact {
    /// Slots of the bodies, the lower first.
    bodies: [u32; 2],
    index: u32,
    /// From the first body to the second.
    normal: Vec2,
    home: GraphIndex,
}

impl DeepContact {
    fn new(index: u32, contact: &Contact, bodies: &Bodies, home: GraphIndex) -> Self {
        let ([a, b], normal) = (bodies.bodies_of(contact.colliders), contact.manifold.normal);
        let (bodies, normal) = if a < b { ([a, b], normal) } else { ([b, a], -normal) };
        Self { bodies, index, normal, home }
    }

    /// Whether two contacts of the same bodies push these more than a right angle apart.
    fn is_opposed_to(&self, other: &Self) -> bool {
        self.normal.dot(other.normal) < 0.0
    }
}

/// The stage and its buffers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tangles {
    /// The deep contacts of the bodies that are in one.
    tangled: Vec<DeepContact>,
    /// Scratch: all that are deep.
    deep: Vec<DeepContact>,
}

impl Tangles {
    /// Finds them; other deep contacts are as all contacts are.
    pub(crate) fn prepare(&mut self, bodies: &Bodies, contacts: &Contacts, graph: &mut ConstraintGraph) {
        self.tangled.clear();
        if bodies.compounds.is_empty() {
            return;
        }
        self.deep.clear();
        for &index in contacts.awake() {
            let contact = &contacts[index];
            if let Some(home) = graph.home(index).filter(|_| is_deep(contact, bodies)) {
                self.deep.push(DeepContact::new(index, contact, bodies, home));
            }
        }
        self.deep.sort_unstable_by_key(|contact| (contact.bodies, contact.index));
        for of_pair in self.deep.chunk_by(|one, other| one.bodies == other.bodies) {
            if of_pair.iter().any(|one| of_pair.iter().any(|other| one.is_opposed_to(other))) {
                self.tangled.extend_from_slice(of_pair);
            }
        }
        for contact in &self.tangled {
            graph.set_tangled(contact.home);
        }
    }

    /// Moves their bodies apart at the end of a step of length `dt`, s, no contact faster than others are pushed.
    pub(crate) fn untangle(&self, graph: &mut ConstraintGraph, states: &mut [BodyState], dt: f32) {
        let project = Project { slop: 0.0, farthest: PUSH_SPEED * dt };
        for contact in &self.tangled {
            graph.run_at(contact.home, states, &project);
        }
    }
}
