//! What began, ended and hit in a step, as its contacts tell.

use crate::collision::{Contact, ManifoldPoint};
use crate::resolution::{Begun, Blow, Collision, Encounter, Ids, Impact};
use crate::world::World;
use crate::world::events::{ContactEvent, HitEvent};

/// A blow that runs through bodies at rest is no less than this share of the load that they bear, no unit: under great
/// loads, the trembling of a tall stack comes to more than a blow from a light body does.
const LOAD_SHARE: f32 = 0.25;

/// A blow of which no more than this share is still to come is over, no unit: bodies that are so much of the way apart that they
/// make in a substep, or approach each other with so much of their speed.
const TO_COME: f32 = 1e-5;

/// Whether bodies that did not touch before met at least as fast as the `threshold`, m/s.
fn has_met_fast(contact: &Contact, threshold: f32) -> bool {
    !contact.is_touching && contact.approach_speed >= threshold
}

impl World {
    /// Begins a contact for each pair of bodies that met within the step and had none. Where they have parted again, the
    /// next step ends it.
    fn begin_encountered(&mut self) {
        let encounters = self.solver.continuous.take_encounters();
        if !encounters.is_empty() {
            self.candidates.remove(encounters.iter().map(|encounter| encounter.slots.into()));
        }
        for &Encounter { slots: [a, b], collision, is_first } in &encounters {
            let index = if is_first {
                self.broad_phase.take_up_pair([a, b]);
                self.begin_contact([a, b])
            } else {
                self.contacts.between(&self.bodies, [a, b]).expect("it began when they met first")
            };
            self.solver.blows.note_late(Impact { contact: index, collision });
        }
        self.solver.continuous.give_back(encounters);
    }

    /// Reports which contacts began, ended or hit.
    pub(in crate::world) fn report_events(&mut self) {
        self.begin_encountered();
        self.solver.blows.end_step(&self.contacts, self.settings.sum_impulses);
        for &Impact { contact: index, collision } in self.solver.blows.impacts() {
            let contact = &mut self.contacts[index];
            // Of several impacts, the first is what the bodies met with. What does not bounce was slowed down before.
            if !std::mem::replace(&mut contact.has_bounced, true) {
                let before = if contact.mixed.restitution > 0.0 { 0.0 } else { contact.approach_speed };
                contact.approach_speed = collision.speed.max(before);
            }
            self.contacts.note_change(index);
        }
        let tick = self.next_tick();
        let cut_off = self.solver.blows.cut_off().iter();
        self.events.hits.extend(cut_off.map(|&Begun { ids, so_far, .. }| hit_of(ids, so_far, tick)));
        for place in 0..self.solver.blows.of_step().len() {
            let blow = self.solver.blows.of_step()[place];
            let contact = &mut self.contacts[blow.contact];
            // They met and parted within the step. Of those that met slowly it is only known if the settings ask for all impulses, and these
            // change no event.
            if has_met_fast(contact, self.settings.hit_threshold)
                && blow.has_pressed()
                && !contact.has_touched()
            {
                contact.has_bounced = true;
                self.contacts.note_change(blow.contact);
            }
            let contact = &self.contacts[blow.contact];
            if !self.is_hit(&blow, contact) {
                continue;
            }
            let ids = self.ids_of(blow.contact);
            let so_far = blow.whole(contact, self.bodies.center(contact.slots[0]));
            if self.is_over(&blow, contact) {
                self.events.hits.push(hit_of(ids, so_far, tick));
            } else {
                let contact = self.contacts.key_of(blow.contact);
                self.solver.blows.leave(Begun { contact, ids, so_far });
            }
        }
        let changing = self.contacts.take_changing();
        for &index in &changing {
            let contact = &mut self.contacts[index];
            let is_touching = contact.has_touched();
            if is_touching == contact.is_touching {
                continue;
            }
            contact.is_touching = is_touching;
            let ([a, b], colliders) = self.ids_of(index);
            let changed = if is_touching { &mut self.events.began } else { &mut self.events.ended };
            changed.push(ContactEvent { a, b, colliders, tick });
        }
        self.contacts.clear_changing(changing);
    }

    /// The bodies of a contact, and their shapes that touch.
    fn ids_of(&self, contact: u32) -> Ids {
        let Contact { slots, colliders, .. } = &self.contacts[contact];
        (slots.map(|slot| self.id_of(slot)), colliders.map(|slot| self.collider_id(slot)))
    }

    /// Whether a blow is a hit: bodies met fast; or what touched before, and bore a load, bears a blow beside it, and was asked
    /// about.
    fn is_hit(&self, blow: &Blow, contact: &Contact) -> bool {
        let threshold = self.settings.hit_threshold;
        if blow.begun.is_some() {
            return true;
        }
        if !contact.is_touching {
            return contact.has_touched() && has_met_fast(contact, threshold);
        }
        let beyond = blow.on_b.dot(blow.normal(contact)) - blow.load_before;
        let least = (threshold * self.reduced_mass(contact)).max(LOAD_SHARE * blow.load_before);
        self.settings.sum_impulses && contact.has_touched() && beyond >= least
    }

    /// Whether a blow is over: what met has bounced, reached the surface, parted again, or approaches no more. Else it has only been
    /// slowed down to reach it.
    fn is_over(&self, blow: &Blow, contact: &Contact) -> bool {
        let touched_before = contact.is_touching && blow.begun.is_none();
        if contact.has_bounced || touched_before || !contact.has_touched() {
            return true;
        }
        let speed = blow.begun.map_or(contact.approach_speed, |begun| begun.so_far.speed);
        let way = speed * self.substep_seconds();
        let [a, b] = contact.slots.map(|slot| self.bodies.state(slot));
        let comes = |point: &ManifoldPoint| {
            -contact.manifold.normal.dot(point.relative_velocity(a, b)) > TO_COME * speed
        };
        let points = contact.manifold.points();
        points.iter().any(|point| point.separation <= TO_COME * way) || !points.iter().any(comes)
    }

    /// The mass that resists where two bodies hit each other along the line of their centres, kg.
    fn reduced_mass(&self, contact: &Contact) -> f32 {
        let [a, b] = contact.slots.map(|slot| self.bodies.motions[slot as usize].inverse_mass);
        1.0 / (a + b)
    }
}

/// What is told of a blow that is over.
fn hit_of(
    ([a, b], colliders): Ids,
    Collision { speed, point, normal, on_b }: Collision,
    tick: u64,
) -> HitEvent {
    HitEvent {
        a,
        b,
        colliders,
        speed: speed.max(0.0),
        point,
        normal,
        normal_impulse: on_b.dot(normal),
        tangent_impulse: on_b.dot(normal.perp()),
        tick,
    }
}
