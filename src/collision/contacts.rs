//! Contacts: one per pair of shapes of two bodies whose fat boxes overlap, kept across steps.
//!
//! A contact holds the manifold with the impulses of the last substep, which warm start the next one. Each
//! body heads a doubly linked list of its contacts, threaded through the contacts themselves, so that a body
//! can be removed, put to sleep or woken without looking at any other.

mod prefetch;

pub(crate) use prefetch::AHEAD;

use crate::body::{Bodies, Mixed, NONE};
use crate::collision::{Manifold, ManifoldPoint, Offset, OneWay, is_flat};
use crate::compute::{DistinctIndices, LINE};
use crate::math::Rot;
use crate::store::{ChosenSlots, Key, Slots};

/// The relative pose for which a manifold was computed; while the bodies stay near it, the manifold's normal
/// is kept.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Frozen {
    /// Centre of b from the centre of a.
    pub(crate) offset: Offset,
    pub(crate) rotation_a: Rot,
    pub(crate) rotation_b: Rot,
}

/// A point has lifted off from this gap on, as a share of the width of the thinner body: more than a stack trembles.
const LIFTED_SHARE: f32 = 0.005;

/// Neighbours in the list of one of the two bodies.
#[derive(Clone, Copy, Debug)]
struct Link {
    previous: u32,
    next: u32,
}

/// What is known of two bodies that are close: three cache lines, of which the first is all that is read of bodies out
/// of reach of each other, as half of the contacts of a pile are.
///
/// A place of the store without a contact is told by a number that one of the fields never has: the compiler takes a field with most numbers to spare, the
/// first of these, a `bool` in the first line. An `Option` in another line, with more, would have each look ahead wait for that.
#[repr(C, align(64))]
#[derive(Clone, Debug)]
pub(crate) struct Contact {
    /// Slots of the shapes of a and b; that of a is the smaller.
    pub(crate) colliders: [u32; 2],
    /// Whether the bodies touched at the end of the last step.
    pub(crate) is_touching: bool,
    /// Whether the bodies hardly move against each other: its manifold was kept under load, or they are slow. A load that it
    /// bears may last.
    pub(crate) holds_still: bool,
    /// Whether the bodies met and parted again within the last step.
    pub(crate) has_bounced: bool,
    /// Whether it follows the surface within the step: a body topples on it, or rolls on what moves or ends there, and does so fast, or
    /// under a great load.
    pub(crate) follows: bool,
    /// Whether one of the bodies is a circle that the other does not find flat: its manifold is never kept, and nothing is
    /// frozen. It is asked before the bodies are close.
    pub(crate) has_circle: bool,
    /// For how many steps it has been followed since its manifold was found.
    pub(crate) followed_steps: u8,
    /// Of a contact with a one-way floor, what it does.
    pub(crate) one_way: Option<OneWay>,
    /// Whether `frozen` says where the bodies were.
    is_frozen: bool,
    /// How fast the bodies approached each other along the normal before the last step, or when they
    /// bounced in it, m/s.
    pub(crate) approach_speed: f32,
    /// Place in the list of awake contacts, `NONE` while neither body is awake.
    awake_place: u32,
    /// Coefficients of the two surfaces.
    pub(crate) mixed: Mixed,
    /// Width of the thinner of the two bodies, m.
    pub(crate) thickness: f32,
    /// Moment of rolling resistance in the last substep, N m s, on b.
    pub(crate) rolling_moment: f32,
    /// Points within the speculative margin; empty where the shapes are farther apart.
    pub(crate) manifold: Manifold,
    /// See [`Self::frozen`].
    frozen: Frozen,
    links: [Link; 2],
    /// Slots of the bodies a and b.
    pub(crate) slots: [u32; 2],
}

const _: () = assert!(size_of::<Option<Contact>>() == 3 * LINE);

impl Contact {
    /// Whether the bodies touched in the last step, as its end found it.
    #[inline(always)]
    pub(crate) fn has_touched(&self) -> bool {
        let touches = |point: &ManifoldPoint| point.normal_impulse > 0.0 || point.separation <= 0.0;
        self.has_bounced || self.manifold.points().iter().any(touches)
    }

    /// Takes note that the bodies do not meet within the step. Most of these have not before: what is only read need not go
    /// back to memory.
    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        let is_apart = self.manifold.points().is_empty()
            && !self.holds_still
            && !self.has_bounced
            && self.approach_speed == 0.0;
        if !is_apart {
            self.manifold = Manifold::default();
            self.holds_still = false;
            self.follows = false;
            self.has_bounced = false;
            self.approach_speed = 0.0;
            self.rolling_moment = 0.0;
        }
    }

    /// Deepest overlap of its points at the end of the last step, m; 0 where none overlap.
    pub(crate) fn penetration(&self) -> f32 {
        // Not `f32::max`, whose zeros have either sign.
        let deeper = |deepest: f32, overlap: f32| if overlap > deepest { overlap } else { deepest };
        self.manifold.points().iter().map(|point| -point.separation).fold(0.0, deeper)
    }

    /// Where the bodies were when the manifold was found; `None` where it is not kept, or a body was moved by hand since.
    #[inline(always)]
    pub(crate) fn frozen(&self) -> Option<Frozen> {
        self.is_frozen.then_some(self.frozen)
    }

    /// Takes note of where the bodies are as the manifold is found, or that it is not to be kept.
    pub(crate) fn freeze(&mut self, frozen: Option<Frozen>) {
        (self.is_frozen, self.frozen) = (frozen.is_some(), frozen.unwrap_or_default());
    }

    /// Whether the last step pressed the bodies together.
    pub(crate) fn is_loaded(&self) -> bool {
        self.manifold.points().iter().any(|point| point.normal_impulse > 0.0)
    }

    /// Whether the bodies turn about one corner: it alone was pressed, and what other point there is has lifted off.
    pub(crate) fn pivots(&self) -> bool {
        let lifted = LIFTED_SHARE * self.thickness;
        match self.manifold.points() {
            [one] => one.normal_impulse > 0.0,
            [one, other] => match (one.normal_impulse > 0.0, other.normal_impulse > 0.0) {
                (true, false) => other.separation > lifted,
                (false, true) => one.separation > lifted,
                _ => false,
            },
            _ => false,
        }
    }

    /// The other body of the contact.
    pub(crate) fn other(&self, slot: u32) -> u32 {
        if self.slots[0] == slot { self.slots[1] } else { self.slots[0] }
    }

    /// Which of the two bodies `slot` is: 0 for a, 1 for b.
    fn side(&self, slot: u32) -> usize {
        usize::from(self.slots[0] != slot)
    }
}

/// Width of the thinner of two shapes, m, and whether one is a circle that the other does not find flat.
fn sizes(bodies: &Bodies, colliders: [u32; 2]) -> (f32, bool) {
    let [a, b] = colliders.map(|slot| &bodies.motions[slot as usize]);
    let is_flat = is_flat([a, b].map(|motion| (motion.is_circle, motion.extent)));
    (a.thickness.min(b.thickness), (a.is_circle || b.is_circle) && !is_flat)
}

/// Some contacts, each of them once.
pub(crate) type ChosenContacts<'a> = ChosenSlots<'a, Contact>;

/// All contacts of a world.
#[derive(Debug, Default)]
pub(crate) struct Contacts {
    all: Slots<Contact>,
    /// Indices of the contacts with a body that the solver moves.
    awake: DistinctIndices,
    /// Indices of the contacts of which this step may change whether they touch; some of them twice.
    changing: Vec<u32>,
}

clone_into_buffers!(Contacts { all, awake, changing });

impl core::ops::Index<u32> for Contacts {
    type Output = Contact;
    #[inline(always)]
    fn index(&self, index: u32) -> &Contact {
        &self.all[index]
    }
}

impl core::ops::IndexMut<u32> for Contacts {
    #[inline(always)]
    fn index_mut(&mut self, index: u32) -> &mut Contact {
        &mut self.all[index]
    }
}

impl Contacts {
    /// Begins a contact between shapes of two bodies, without points yet and asleep; returns its index.
    pub(crate) fn begin(&mut self, bodies: &mut Bodies, colliders: [u32; 2], mixed: Mixed) -> u32 {
        let slots = bodies.bodies_of(colliders);
        let first = slots.map(|slot| bodies.records[slot].first_contact);
        let (thickness, has_circle) = sizes(bodies, colliders);
        let key = self.all.insert(Contact {
            colliders,
            slots,
            manifold: Manifold::default(),
            is_frozen: false,
            frozen: Frozen::default(),
            mixed,
            thickness,
            rolling_moment: 0.0,
            is_touching: false,
            holds_still: false,
            has_bounced: false,
            approach_speed: 0.0,
            follows: false,
            has_circle,
            followed_steps: 0,
            one_way: bodies.roles.are_one_way(colliders).then_some(OneWay::Apart),
            awake_place: NONE,
            links: first.map(|next| Link { previous: NONE, next }),
        });
        for (slot, next) in slots.into_iter().zip(first) {
            bodies.records[slot].first_contact = key.index();
            if next != NONE {
                let side = self[next].side(slot);
                self[next].links[side].previous = key.index();
            }
        }
        key.index()
    }

    /// Ends the contact: takes it out of both bodies' lists and out of the awake list.
    pub(crate) fn end(&mut self, bodies: &mut Bodies, index: u32) -> Contact {
        self.set_asleep(index);
        let contact = self[index].clone();
        for (slot, Link { previous, next }) in contact.slots.into_iter().zip(contact.links) {
            if previous == NONE {
                bodies.records[slot].first_contact = next;
            } else {
                let side = self[previous].side(slot);
                self[previous].links[side].next = next;
            }
            if next != NONE {
                let side = self[next].side(slot);
                self[next].links[side].previous = previous;
            }
        }
        self.all.remove(self.all.key_at(index));
        contact
    }

    /// The key of the contact with this index, which no later one has.
    pub(crate) fn key_of(&self, index: u32) -> Key {
        self.all.key_at(index)
    }

    /// Whether the contact with this key is still there.
    pub(crate) fn has(&self, key: Key) -> bool {
        self.all.get(key).is_some()
    }

    /// The contact with this index, if there is one.
    pub(crate) fn get(&self, index: u32) -> Option<&Contact> {
        self.all.at(index)
    }

    /// Gives up room beyond the last contact.
    pub(crate) fn trim(&mut self) {
        self.all.trim();
        self.awake.trim();
    }

    /// How many indices there are, those of contacts that ended with them.
    pub(crate) fn place_count(&self) -> usize {
        self.all.place_count()
    }

    /// No contact has a greater index.
    pub(crate) fn greatest_index(&self) -> u32 {
        self.all.place_count().saturating_sub(1) as u32
    }

    /// Indices of the awake contacts. The order depends only on what happened so far.
    pub(crate) fn awake(&self) -> &[u32] {
        &self.awake
    }

    /// Notes that this step may change whether the bodies of the contact touch.
    #[inline(always)]
    pub(crate) fn note_change(&mut self, index: u32) {
        self.changing.push(index);
    }

    /// How many contacts were noted.
    pub(crate) fn changing_count(&self) -> usize {
        self.changing.len()
    }

    /// The contacts that were noted, to be given back.
    pub(crate) fn take_changing(&mut self) -> Vec<u32> {
        std::mem::take(&mut self.changing)
    }

    /// Takes the list back, for its buffer.
    pub(crate) fn clear_changing(&mut self, mut list: Vec<u32>) {
        list.clear();
        self.changing = list;
    }

    /// Index and contact of every contact, by ascending index.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (u32, &Contact)> {
        self.all.iter().map(|(key, contact)| (key.index(), contact))
    }

    /// Every contact, to change it.
    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = &mut Contact> {
        self.all.values_mut()
    }

    /// Takes note that the body in `slot` was moved by hand: where the last step left its contacts is no longer where they
    /// are.
    pub(crate) fn forget_moving(&mut self, bodies: &Bodies, slot: u32) {
        let mut index = bodies.records[slot].first_contact;
        while index != NONE {
            let contact = &mut self[index];
            contact.freeze(None);
            // Nor is it known where it came from.
            contact.one_way = contact.one_way.map(|_| OneWay::Apart);
            index = contact.links[contact.side(slot)].next;
        }
    }

    /// Takes note that the body in `slot` is a one-way floor now, is none any more, or of another direction.
    pub(crate) fn decide_anew(&mut self, bodies: &Bodies, slot: u32) {
        let mut index = bodies.records[slot].first_contact;
        while index != NONE {
            let contact = &mut self[index];
            contact.one_way = bodies.roles.are_one_way(contact.colliders).then_some(OneWay::Apart);
            index = contact.links[contact.side(slot)].next;
        }
    }

    /// Takes note that a body of the contact, which is in no graph, has another shape or mass: its manifold is to be found
    /// anew, and only a share of what it bears is left.
    pub(crate) fn fit_to_bodies(&mut self, bodies: &Bodies, index: u32, share: f32) {
        let (thickness, has_circle) = sizes(bodies, self[index].colliders);
        let contact = &mut self[index];
        if contact.has_circle != has_circle {
            contact.manifold = Manifold::default();
            contact.rolling_moment = 0.0;
        }
        contact.rolling_moment *= share;
        (contact.thickness, contact.has_circle) = (thickness, has_circle);
        let are_one_way = bodies.roles.are_one_way(contact.colliders);
        contact.one_way = are_one_way.then(|| contact.one_way.unwrap_or(OneWay::Apart));
        contact.freeze(None);
        (contact.follows, contact.holds_still, contact.followed_steps) = (false, false, 0);
        for point in contact.manifold.points_mut() {
            point.scale_impulses(share);
        }
    }

    /// The contacts with some indices, which may be divided among threads.
    pub(crate) fn chosen<'a>(&'a mut self, indices: &'a DistinctIndices) -> ChosenContacts<'a> {
        self.all.chosen(indices)
    }

    /// The awake ones.
    pub(crate) fn awake_mut(&mut self) -> ChosenContacts<'_> {
        self.all.chosen(&self.awake)
    }

    /// How many contacts there are.
    pub(crate) fn len(&self) -> usize {
        self.all.len()
    }

    /// Puts the contact into the awake list, if it is not there.
    pub(crate) fn set_awake(&mut self, index: u32) {
        if self[index].awake_place == NONE {
            self[index].awake_place = self.awake.len() as u32;
            self.awake.push(index);
        }
    }

    /// Takes the contact out of the awake list, if it is there.
    pub(crate) fn set_asleep(&mut self, index: u32) {
        let place = std::mem::replace(&mut self[index].awake_place, NONE);
        if place == NONE {
            return;
        }
        self.awake.swap_remove(place as usize);
        if let Some(&moved) = self.awake.get(place as usize) {
            self[moved].awake_place = place;
        }
    }

    /// The contact of two shapes, if they have one.
    pub(crate) fn between(&self, bodies: &Bodies, colliders: [u32; 2]) -> Option<u32> {
        self.of_body(bodies, bodies.body_of(colliders[0])).find(|&index| self[index].colliders == colliders)
    }

    /// Indices of the contacts of the body in `slot`, latest first.
    pub(crate) fn of_body<'a>(&'a self, bodies: &Bodies, slot: u32) -> impl Iterator<Item = u32> + 'a {
        let mut index = bodies.records[slot].first_contact;
        std::iter::from_fn(move || {
            (index != NONE).then(|| {
                let contact = &self[index];
                std::mem::replace(&mut index, contact.links[contact.side(slot)].next)
            })
        })
    }
}
