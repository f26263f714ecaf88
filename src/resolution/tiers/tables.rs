//! What the choice of tiers reads of the world, and changes in it.

use crate::body::{Bodies, NONE};
use crate::collision::{Contact, Contacts};
use crate::joint::Joints;
use crate::resolution::constraint_graph::ConstraintGraph;
use crate::resolution::islands::Connections;

/// The tables that a change of tier changes.
#[derive(Debug)]
pub(crate) struct TierTables<'a> {
    pub(crate) bodies: &'a Bodies,
    pub(crate) contacts: &'a mut Contacts,
    pub(crate) graph: &'a mut ConstraintGraph,
    pub(crate) joints: &'a Joints,
}

impl TierTables<'_> {
    pub(super) fn moves(&self, slot: u32) -> bool {
        self.bodies.is_dynamic(slot) && self.bodies.is_awake(slot)
    }

    /// The bodies that a contact moves; none if it has ended since the last step noted it.
    pub(super) fn slots(&self, index: u32) -> impl Iterator<Item = u32> + use<> {
        let slots = self.contacts.get(index).map_or([NONE; 2], |contact| contact.slots);
        slots.map(|slot| (slot != NONE && self.moves(slot)).then_some(slot)).into_iter().flatten()
    }

    /// Velocity that a unit of impulse through both centres gives the bodies of a contact, 1/kg.
    pub(super) fn inverse_mass(&self, contact: &Contact) -> f32 {
        contact.slots.iter().map(|&slot| self.bodies.motions[slot as usize].inverse_mass).sum()
    }

    pub(super) fn connections(&self) -> Connections<'_> {
        Connections { contacts: self.contacts, joints: self.joints }
    }

    /// The bodies that the one in `slot` touches, and that contacts move.
    pub(super) fn touching(&self, slot: u32) -> impl Iterator<Item = u32> {
        let has_points = |index: &u32| !self.contacts[*index].manifold.points().is_empty();
        let touching = self.contacts.of_body(self.bodies, slot).filter(has_points);
        touching.map(move |index| self.contacts[index].other(slot)).filter(|&other| self.moves(other))
    }

    /// Those that joints join it to. Disabled joints connect an island as others do; see [`Self::is_joined`].
    pub(super) fn joined(&self, slot: u32) -> impl Iterator<Item = u32> {
        let joined = self.joints.of_body(slot).map(move |index| self.joints.all[index].other(slot));
        joined.filter(|&other| other != NONE && self.moves(other))
    }

    /// Whether a joint acts on any of these bodies: islands of bodies with disabled joints alone are not joined.
    pub(super) fn is_joined(&self, island: &[u32]) -> bool {
        island.iter().any(|&slot| self.joints.hold(slot))
    }

    pub(super) fn neighbours(&self, slot: u32) -> impl Iterator<Item = u32> {
        self.touching(slot).chain(self.joined(slot))
    }
}
