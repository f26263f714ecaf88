//! Memory: given back by a world that has become far smaller.
//!
//! Tables grow with a world and are kept, so that a step need not ask for memory. A world of which three quarters are gone
//! gives up what it does not use any more: places after the last body and contact, and the buffers of the step, which the
//! next one makes anew. The rest is copied to where it just fits.
//!
//! - When: after a body was removed, and after a step that ended pairs; a settled step does neither.
//! - Cost: that of what is left, when as much or more has gone since the last time; a comparison otherwise.

use crate::resolution::Solver;
use crate::world::World;

/// A world gives memory back when one in so many of its slots is in use, or one in so many of its pairs is left. With 2,
/// one that goes up and down by half asks for memory again and again.
const FAR_MORE: usize = 4;

/// Fewer slots or pairs stay as they are: they take a megabyte or two.
const FEW: usize = 1024;

/// Each body that is removed pays for so many looks at slots, to find out how many are free at the end: 0.1 µs, where it
/// takes 0.5 µs to remove it. With fewer, a world that loses its bodies in random order waits longer.
const LOOKS_PER_REMOVAL: usize = 64;

/// What tells when memory is to be given back.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::world) struct MemoryUse {
    /// How many slots may be looked at.
    looks: usize,
    /// The most pairs there were since memory was last given back.
    most_pairs: usize,
}

impl World {
    /// Takes note that a body was removed.
    pub(in crate::world) fn note_removal(&mut self) {
        self.memory_use.looks = self.memory_use.looks.saturating_add(LOOKS_PER_REMOVAL);
    }

    /// Gives memory back if the world was far larger, between steps.
    pub(in crate::world) fn give_back_memory(&mut self) {
        let pairs = self.candidates.len() + self.contacts.len();
        let most_pairs = self.memory_use.most_pairs.max(pairs);
        self.memory_use.most_pairs = most_pairs;
        let had_far_more_pairs = most_pairs >= FEW && pairs < most_pairs / FAR_MORE;
        if had_far_more_pairs || self.has_far_more_slots() {
            self.shrink_to_fit();
        }
    }

    /// Whether half of the slots or more can be given up, and few of the others are in use.
    fn has_far_more_slots(&mut self) -> bool {
        let slots = self.bodies.slot_count();
        if slots < FEW || self.body_count() >= slots / FAR_MORE {
            return false;
        }
        let free = self.bodies.records.free_at_end(self.memory_use.looks);
        self.memory_use.looks -= free;
        free >= slots / 2
    }

    /// Gives up all memory that is not used now; ids stay as they are. The next steps ask for what they need anew.
    ///
    /// A world of 1024 bodies or pairs or more does so itself when three quarters of them are gone, unless the body that was added
    /// last is still there.
    #[cold]
    #[inline(never)]
    pub fn shrink_to_fit(&mut self) {
        self.candidates.forget_removed(&mut self.broad_phase);
        self.candidates.trim();
        self.bodies.trim();
        self.contacts.trim();
        self.graph.trim();
        self.sleepers.trim();
        self.sensors.trim();
        let (slots, contacts) = (self.bodies.slot_count(), self.contacts.place_count());
        self.broad_phase.trim(slots);
        self.loads.trim(contacts, slots);
        self.tiers.trim(slots);
        self.joints.trim(slots);
        self.solver = Solver::default();
        self.new_pairs.clear();
        self.is_close_now.clear();
        self.leaves_box.clear();
        self.leaving.clear();
        self.changed_contacts.clear();
        self.memory_use.most_pairs = self.candidates.len() + self.contacts.len();
        // A copy has no room but for what it holds. Threads are not copied.
        let pool = std::mem::take(&mut self.pool);
        *self = self.clone();
        self.pool = pool;
    }
}
