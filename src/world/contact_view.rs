//! A contact, as the caller sees it.

use crate::body::BodyId;
use crate::collision::{Contact, Manifold, ManifoldPoint};
use crate::math::{Point, Vec2};
use crate::world::World;

/// Two bodies that touch or are about to, as of the end of the last step.
#[derive(Clone, Copy, Debug)]
pub struct ContactRef<'a> {
    world: &'a World,
    index: u32,
    contact: &'a Contact,
}

impl<'a> ContactRef<'a> {
    pub(in crate::world) fn new(world: &'a World, index: u32, contact: &'a Contact) -> Self {
        Self { world, index, contact }
    }

    /// The body that the normal points away from.
    pub fn a(&self) -> BodyId {
        BodyId(self.world.bodies.records.key_at(self.contact.slots[0]))
    }

    /// The body that the normal points to.
    pub fn b(&self) -> BodyId {
        BodyId(self.world.bodies.records.key_at(self.contact.slots[1]))
    }

    /// Whether the two touch, rather than being about to.
    pub fn is_touching(&self) -> bool {
        self.contact.is_touching
    }

    /// Direction in which b is pushed away from a; length 1.
    pub fn normal(&self) -> Vec2 {
        self.contact.manifold.normal
    }

    /// One or two points, with separation (m) and impulses of the last substep (N s).
    pub fn points(&self) -> &'a [ManifoldPoint] {
        self.contact.manifold.points()
    }

    /// Normal and points together.
    pub fn manifold(&self) -> &'a Manifold {
        &self.contact.manifold
    }

    /// Where each point is in the world, m; as many as [`points`](Self::points).
    pub fn positions(&self) -> impl Iterator<Item = Point> + 'a {
        let center = self.world.bodies.center(self.contact.slots[0]);
        self.points().iter().map(move |point| center + point.anchor_a)
    }

    /// The colour of the constraint graph that the contact is solved in; `None` while it sleeps, where it found no colour,
    /// and where it is solved directly. Contacts of one colour share no body that moves.
    pub fn colour(&self) -> Option<u32> {
        self.world.graph.colour_of(self.index)
    }

    /// Coefficient of friction of the contact.
    pub fn friction(&self) -> f32 {
        self.contact.friction
    }

    /// Coefficient of restitution of the contact.
    pub fn restitution(&self) -> f32 {
        self.contact.restitution
    }
}
