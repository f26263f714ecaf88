//! What neighbours leave of the outlines of ground, and of those of one body: see [`Exposure`].

use crate::shape::{Exposure, Neighbour};

/// The exposures of all shapes.
#[derive(Debug, Default)]
pub(crate) struct Exposures {
    /// By slot of a shape; `None`, and what is beyond the end, is exposed all round.
    by_slot: Vec<Option<Box<Exposure>>>,
    /// How many shapes are covered somewhere.
    count: usize,
    /// Slots whose neighbours have changed; some of them more than once, some removed since.
    stale: Vec<u32>,
    /// Slots of all kinematic bodies, and of some that were, ascending.
    kinematic: Vec<u32>,
    /// Room for those of one shape.
    neighbours: Vec<Neighbour>,
}

clone_into_buffers!(Exposures { by_slot, count, stale, kinematic } scratch { neighbours });

impl Exposures {
    /// Those of two shapes; `None` where neither is covered anywhere.
    #[inline(always)]
    pub(super) fn of(&self, colliders: [u32; 2]) -> Option<[Option<&Exposure>; 2]> {
        if self.count == 0 {
            return None;
        }
        let both = colliders.map(|slot| self.by_slot.get(slot as usize).and_then(Option::as_deref));
        both.iter().any(Option::is_some).then_some(both)
    }

    /// Sets that of the shape in `slot`.
    pub(crate) fn set(&mut self, slot: u32, exposure: Option<&Exposure>) {
        let place = slot as usize;
        if place >= self.by_slot.len() {
            if exposure.is_none() {
                return;
            }
            self.by_slot.resize(place + 1, None);
        }
        let old = &mut self.by_slot[place];
        self.count += usize::from(exposure.is_some());
        self.count -= usize::from(old.is_some());
        match (old, exposure) {
            (Some(old), Some(exposure)) => **old = *exposure,
            (old, exposure) => *old = exposure.copied().map(Box::new),
        }
    }

    /// Takes note that the neighbours of the shape in `slot` have changed.
    pub(crate) fn note_stale(&mut self, slot: u32) {
        self.stale.push(slot);
    }

    /// Finds those of the slots whose neighbours have changed, in ascending order.
    pub(crate) fn find_stale(&mut self, find: impl Fn(u32, &mut Vec<Neighbour>) -> Option<Exposure>) {
        let (mut stale, mut neighbours) =
            (std::mem::take(&mut self.stale), std::mem::take(&mut self.neighbours));
        stale.sort_unstable();
        stale.dedup();
        for slot in stale.drain(..) {
            neighbours.clear();
            let exposure = find(slot, &mut neighbours);
            self.set(slot, exposure.as_ref());
        }
        (self.stale, self.neighbours) = (stale, neighbours);
    }

    /// Takes note that the body in `slot` is kinematic.
    pub(crate) fn note_kinematic(&mut self, slot: u32) {
        if let Err(place) = self.kinematic.binary_search(&slot) {
            self.kinematic.insert(place, slot);
        }
    }

    /// The slots of all kinematic bodies, and of some that were, ascending.
    pub(crate) fn kinematic(&self) -> &[u32] {
        &self.kinematic
    }

    /// Gives up what is not needed for slots below `end`: there are no others.
    pub(crate) fn trim(&mut self, end: usize) {
        self.by_slot.truncate(end);
        self.kinematic.retain(|&slot| (slot as usize) < end);
    }
}
