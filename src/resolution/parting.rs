//! Bodies of several shapes that are deep in each other, as they were set there.
//!
//! Two convex shapes have one direction in which they part soonest. Of bodies of several shapes one pair of shapes may ask for the
//! opposite of what another asks for. Pushed so, they press against each other: what they press with grows from substep to
//! substep, as no speed tells that it is too much, and becomes speed when they slip past each other. Two crosses came to
//! 90 m/s in a heap, sixty letters that were set into one place to 130 m/s.
//!
//! So contacts that press against each other are to the sweeps as if their shapes only touched, and begin each substep without
//! impulses; and after the substeps the bodies are [moved](crate::resolution::projection) apart, which makes no speed.
//!
//! Runs once per step, where bodies of several shapes are deep in each other.

use crate::body::Bodies;
use crate::collision::{Contact, Contacts};
use crate::compute::BodyState;
use crate::math::Vec2;
use crate::resolution::constraint_graph::{ConstraintGraph, GraphIndex};
use crate::resolution::projection::Project;

/// Bodies are parted no faster than this, m/s: as fast as others are pushed.
const PARTING_SPEED: f32 = 3.0;

/// A contact of such shapes.
#[derive(Clone, Copy, Debug)]
struct DeepContact {
    /// Slots of the bodies, the lower first.
    bodies: [u32; 2],
    /// From the first to the second.
    normal: Vec2,
    home: GraphIndex,
}

impl DeepContact {
    fn new(home: GraphIndex, contact: &Contact, bodies: &Bodies) -> Self {
        let ([a, b], normal) = (bodies.bodies_of(contact.colliders), contact.manifold.normal);
        if a < b {
            Self { bodies: [a, b], normal, home }
        } else {
            Self { bodies: [b, a], normal: -normal, home }
        }
    }

    /// Whether two of the same bodies push them opposite ways.
    fn is_opposed_to(&self, other: &Self) -> bool {
        self.normal.dot(other.normal) < 0.0
    }
}

/// The stage and its buffers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Parting {
    /// Those that press against each other.
    opposed: Vec<DeepContact>,
    /// Scratch: all that are deep.
    deep: Vec<DeepContact>,
}

impl Parting {
    /// Finds the deep contacts that press against each other; the others are as all contacts are.
    pub(crate) fn prepare(&mut self, bodies: &Bodies, contacts: &Contacts, graph: &mut ConstraintGraph) {
        self.opposed.clear();
        if bodies.compounds.is_empty() {
            return;
        }
        self.deep.clear();
        for (index, block) in graph.blocks() {
            block.marks.deep.for_each(|place| {
                let home = index.contact(place);
                self.deep.push(DeepContact::new(home, &contacts[graph.contact_at(home)], bodies));
            });
        }
        self.deep.sort_by_key(|contact| contact.bodies);
        for of_pair in self.deep.chunk_by(|one, other| one.bodies == other.bodies) {
            let are_opposed = of_pair.iter().any(|one| of_pair.iter().any(|other| one.is_opposed_to(other)));
            for contact in of_pair {
                graph.set_deep(contact.home, are_opposed);
            }
            if are_opposed {
                self.opposed.extend_from_slice(of_pair);
            }
        }
    }

    /// Parts their bodies at the end of a step of length `dt`, s.
    pub(crate) fn part(&self, graph: &mut ConstraintGraph, states: &mut [BodyState], dt: f32) {
        let project = Project { farthest: PARTING_SPEED * dt };
        for contact in &self.opposed {
            graph.run_at(contact.home, states, &project);
        }
    }
}
