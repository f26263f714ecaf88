//! What neighbours leave of the outlines of fixed shapes, and of those of one body: see [`Exposure`].

use crate::shape::Exposure;

/// The exposures of all shapes.
#[derive(Debug, Default)]
pub(crate) struct Exposures {
    /// By slot of a shape; `None`, and what is beyond the end, is exposed all round.
    by_slot: Vec<Option<Box<Exposure>>>,
    /// How many shapes are covered somewhere.
    count: usize,
    /// Slots whose neighbours have changed; some of them more than once, some removed since.
    stale: Vec<u32>,
}

clone_into_buffers!(Exposures { by_slot, count, stale });

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
    pub(crate) fn set(&mut self, slot: u32, exposure: Option<Box<Exposure>>) {
        let place = slot as usize;
        if place >= self.by_slot.len() {
            if exposure.is_none() {
                return;
            }
            self.by_slot.resize(place + 1, None);
        }
        self.count += usize::from(exposure.is_some());
        self.count -= usize::from(self.by_slot[place].is_some());
        self.by_slot[place] = exposure;
    }

    /// Takes note that the neighbours of the shape in `slot` have changed.
    pub(crate) fn note_stale(&mut self, slot: u32) {
        self.stale.push(slot);
    }

    /// The slots whose neighbours have changed, ascending, each once; from now on none have.
    pub(crate) fn take_stale(&mut self) -> Vec<u32> {
        let mut stale = std::mem::take(&mut self.stale);
        stale.sort_unstable();
        stale.dedup();
        stale
    }

    /// Gives up what is not needed for slots below `end`: there are no others.
    pub(crate) fn trim(&mut self, end: usize) {
        self.by_slot.truncate(end);
    }
}
