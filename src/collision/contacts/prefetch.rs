//! Asks memory for contacts, and for their bodies, some contacts before they are worked on: where they are in memory has nothing to do with the order
//! in which that is done.
//!
//! Which bodies a contact has, and what else of it is needed, stands in its first cache line, which is asked for twice or three times as early. No other
//! line may be read here: to read it is to wait for it.

use core::mem::offset_of;
use core::ops::Range;

use crate::body::Bodies;
use crate::collision::Manifold;
use crate::collision::contacts::{ChosenContacts, Contact, Contacts, Link};
use crate::compute::{FIRST_LINE, LINE, prefetch, prefetch_lines};

/// How many contacts ahead memory is asked for: so many take about as long as memory does.
pub(crate) const AHEAD: usize = 6;

/// The same where little is done to each, as in their way to and from the solver. One at a time while others are worked on:
/// asked for all at once they would wait for each other, and the work for them.
const AHEAD_SOLVED: usize = 16;

const _: () = assert!(offset_of!(Contact, manifold) + size_of::<Manifold>() <= Contact::SOLVED.end * LINE);

impl Contact {
    /// The cache line of the points.
    const POINTS: Range<usize> = 1..2;
    /// Those that the solver reads and writes.
    const SOLVED: Range<usize> = 0..2;
    /// That of what a manifold is kept by. What only begins and ends of contacts read is there too.
    const FROZEN: Range<usize> = 2..3;
}

impl ChosenContacts<'_> {
    /// Asks for what the contacts further on than `place` are read for.
    #[inline(always)]
    pub(crate) fn prefetch_ahead(&self, bodies: &Bodies, place: usize) {
        if let Some(contact) = self.get(place + AHEAD) {
            for slot in contact.colliders {
                prefetch(&bodies.motions, slot as usize);
            }
            if !contact.manifold.points().is_empty() {
                self.prefetch(place + AHEAD, Contact::POINTS);
                if !contact.has_circle {
                    self.prefetch(place + AHEAD, Contact::FROZEN);
                }
                // What was kept, and likely will be, needs no shapes; of circles and boxes the first line is all that is read.
                if contact.has_circle || !contact.holds_still {
                    for slot in contact.colliders {
                        prefetch_lines(&bodies.shapes, slot as usize, FIRST_LINE);
                    }
                }
            }
        }
        self.prefetch(place + 3 * AHEAD, FIRST_LINE);
    }

    /// Asks for what the solver writes of the contacts further on than `place`.
    #[inline(always)]
    pub(crate) fn prefetch_written(&self, place: usize) {
        self.prefetch(place + AHEAD_SOLVED, Contact::SOLVED);
    }
}

impl Contacts {
    /// Asks for what it takes to begin contacts further on in a list of `pairs` than `place`.
    #[inline(always)]
    pub(crate) fn prefetch_beginning(&self, bodies: &Bodies, pairs: &[(u32, u32)], place: usize) {
        if let Some(&(a, b)) = pairs.get(place + AHEAD) {
            self.all.prefetch_free(AHEAD);
            for slot in bodies.bodies_of([a, b]) {
                // None has the greatest index.
                self.all.prefetch(bodies.records[slot].first_contact);
            }
        }
        if let Some(&(a, b)) = pairs.get(place + 2 * AHEAD) {
            bodies.records.prefetch(a);
            bodies.records.prefetch(b);
        }
    }

    /// Asks for what it takes to end this contact, which is close: its neighbours.
    #[inline(always)]
    pub(crate) fn prefetch_neighbours(&self, index: u32) {
        for Link { previous, next } in self[index].links {
            self.all.prefetch(previous);
            self.all.prefetch(next);
        }
    }

    /// Asks for the contact to be brought close: its place in memory has nothing to do with that of the one before
    /// it.
    #[inline(always)]
    pub(crate) fn prefetch(&self, index: u32) {
        self.all.prefetch(index);
    }

    /// Asks for what the solver reads of the contacts further on in a `list` than `place`, and of their bodies.
    #[inline(always)]
    pub(crate) fn prefetch_solved(&self, bodies: &Bodies, list: &[u32], place: usize) {
        if let Some(&index) = list.get(place + AHEAD_SOLVED) {
            let contact = &self[index];
            for slot in contact.colliders {
                prefetch(&bodies.motions, slot as usize);
                if contact.follows {
                    prefetch_lines(&bodies.shapes, slot as usize, FIRST_LINE);
                }
            }
        }
        if let Some(&index) = list.get(place + 2 * AHEAD_SOLVED) {
            self.all.prefetch_lines(index, Contact::SOLVED);
        }
    }
}
