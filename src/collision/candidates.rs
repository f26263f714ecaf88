//! Pairs of shapes whose boxes overlap, but which have not been in reach of each other: nothing needs to be known of them
//! but who they are. In a drum, whose bodies all move and have long boxes, they are half of all pairs or more.
//!
//! A pair that comes within reach gets a contact, and keeps it until the boxes part.

use crate::body::Bodies;
use crate::collision::broad_phase::BroadPhase;
use crate::collision::{AHEAD, are_out_of_reach};
use crate::compute::{ThreadPool, prefetch};
use crate::store::BitSet;

/// What it costs to find out whether two bodies are in reach of each other, ns.
const REACH_COST: usize = 5;

/// What becomes of a pair.
#[derive(Clone, Copy, Debug, Default)]
enum PairState {
    #[default]
    StaysApart,
    /// It gets a contact.
    Meets,
    /// Its boxes do not overlap any more.
    Parts,
}

/// All such pairs of a world.
#[derive(Debug, Default)]
pub(crate) struct CandidatePairs {
    pairs: Vec<(u32, u32)>,
    /// Scratch, by place.
    states: Vec<PairState>,
    /// Slots of bodies that have been removed, or are of another type now, whose pairs are still here.
    removed: BitSet,
    has_removed: bool,
}

clone_into_buffers!(CandidatePairs { pairs, removed, has_removed } scratch { states });

impl CandidatePairs {
    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.pairs.len()
    }

    /// All of them, but those of bodies that have been removed.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (u32, u32)> {
        let is_left = |&(a, b): &(u32, u32)| !self.removed.contains(a) && !self.removed.contains(b);
        self.pairs.iter().copied().filter(is_left)
    }

    /// Takes up a pair of bodies whose boxes overlap.
    pub(crate) fn add(&mut self, pair: (u32, u32)) {
        self.pairs.push(pair);
    }

    /// Takes out those of some pairs that are here.
    pub(crate) fn remove(&mut self, pairs: impl Iterator<Item = (u32, u32)>) {
        let mut pairs: Vec<_> = pairs.collect();
        pairs.sort_unstable();
        self.pairs.retain(|pair| pairs.binary_search(pair).is_err());
    }

    /// Takes note that the body in `slot` is no more, or is found by others than before. Its pairs are to be forgotten before
    /// pairs are looked for again or sorted out.
    pub(crate) fn note_removed(&mut self, slot: u32) {
        self.removed.insert(slot);
        self.has_removed = true;
    }

    /// Gives up scratch. There are no pairs of bodies that have been removed.
    pub(crate) fn trim(&mut self) {
        debug_assert!(!self.has_removed);
        self.states.clear();
        self.removed.trim();
    }

    /// Forgets the pairs of bodies that have been removed.
    pub(crate) fn forget_removed(&mut self, broad_phase: &mut BroadPhase) {
        if !std::mem::take(&mut self.has_removed) {
            return;
        }
        self.pairs.retain(|&(a, b)| {
            let is_gone = self.removed.contains(a) || self.removed.contains(b);
            if is_gone {
                broad_phase.forget_pair(a, b);
            }
            !is_gone
        });
        self.removed.clear();
    }

    /// Moves the pairs that come within reach within a step of `dt` seconds to `meeting`, and those of which neither body
    /// is awake; forgets those whose boxes have parted.
    pub(crate) fn sort_out(
        &mut self,
        pool: &ThreadPool,
        bodies: &Bodies,
        broad_phase: &mut BroadPhase,
        dt: f32,
        meeting: &mut Vec<(u32, u32)>,
    ) {
        self.states.clear();
        self.states.resize(self.pairs.len(), PairState::StaysApart);
        let boxes = &*broad_phase;
        pool.run((&self.pairs[..], &mut self.states[..]), REACH_COST, |(pairs, states)| {
            for (place, (&(a, b), state)) in pairs.iter().zip(states).enumerate() {
                if let Some(&(a, b)) = pairs.get(place + AHEAD) {
                    prefetch(&bodies.motions, a as usize);
                    prefetch(&bodies.motions, b as usize);
                }
                *state = if !boxes.overlap(a, b) {
                    boxes.prefetch_pair([a, b]);
                    PairState::Parts
                } else if (bodies.is_awake(a) || bodies.is_awake(b)) && are_out_of_reach(bodies, [a, b], dt) {
                    PairState::StaysApart
                } else {
                    PairState::Meets
                };
            }
        });
        let mut states = self.states.iter();
        self.pairs.retain(|&(a, b)| match states.next() {
            Some(PairState::Meets) => {
                meeting.push((a, b));
                false
            }
            Some(PairState::Parts) => {
                broad_phase.forget_pair(a, b);
                false
            }
            _ => true,
        });
    }
}
