//! A contact, as the caller sees it.

use core::fmt;

use crate::body::{BodyId, ColliderId};
use crate::collision::{Contact, Manifold, ManifoldPoint};
use crate::math::{Point, Vec2};
use crate::world::World;
use crate::world::events::{other_of, side_of};

/// Two bodies that touch or are about to, as of the end of the last step.
#[derive(Clone, Copy)]
pub struct ContactRef<'a> {
    world: &'a World,
    index: u32,
    contact: &'a Contact,
}

impl World {
    /// Every contact with points: bodies that touch, or are about to.
    pub fn contacts(&self) -> impl Iterator<Item = ContactRef<'_>> {
        self.contacts.iter().filter_map(|(index, contact)| ContactRef::new(self, index, contact))
    }

    /// The contacts with points of one body, the latest first; none for one that was removed. It takes time for the bodies
    /// that are close to this one, and not for the others.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// # world.add_force(Force::EARTH_GRAVITY);
    /// # world.add(Body::fixed(Shape::aabb(20.0, 1.0)))?;
    /// # let player = world.add(Body::dynamic(Shape::circle(0.5)).at([0.0, 1.0]))?;
    /// # world.step();
    /// // Is there something below that bears the player?
    /// let is_on_ground = world
    ///     .contacts_of(player)
    ///     .any(|contact| contact.is_touching() && contact.normal_on(player).y > 0.7);
    /// assert!(is_on_ground);
    /// # Ok::<(), BodyError>(())
    /// ```
    pub fn contacts_of(&self, body: BodyId) -> impl Iterator<Item = ContactRef<'_>> {
        let slot = self.bodies.has(body).then(|| body.0.index());
        let indices = slot.into_iter().flat_map(|slot| self.contacts.of_body(&self.bodies, slot));
        indices.filter_map(|index| ContactRef::new(self, index, &self.contacts[index]))
    }

    /// The contact with points of two bodies, whichever is named first; `None` where they are not about to touch, or one was
    /// removed. It takes time for the bodies that are close to the one that fewer are close to.
    pub fn contact_between(&self, one: BodyId, other: BodyId) -> Option<ContactRef<'_>> {
        if !self.bodies.has(one) || !self.bodies.has(other) {
            return None;
        }
        let [one, other] = [one, other].map(|id| id.0.index());
        // Their contact is in the lists of both: it is found when the shorter one is through, or there is none.
        let of_both =
            self.contacts.of_body(&self.bodies, one).zip(self.contacts.of_body(&self.bodies, other));
        let found = of_both.into_iter().find_map(|(of_one, of_other)| {
            if self.contacts[of_one].other(one) == other {
                Some(of_one)
            } else {
                (self.contacts[of_other].other(other) == one).then_some(of_other)
            }
        })?;
        ContactRef::new(self, found, &self.contacts[found])
    }
}

impl<'a> ContactRef<'a> {
    /// The view of a contact, if it has points.
    fn new(world: &'a World, index: u32, contact: &'a Contact) -> Option<Self> {
        (!contact.manifold.points().is_empty()).then_some(Self { world, index, contact })
    }

    /// The body that the normal points away from.
    pub fn a(&self) -> BodyId {
        BodyId(self.world.bodies.records.key_at(self.contact.slots[0]))
    }

    /// The body that the normal points to.
    pub fn b(&self) -> BodyId {
        BodyId(self.world.bodies.records.key_at(self.contact.slots[1]))
    }

    /// The shapes of a and b that touch.
    pub fn colliders(&self) -> [ColliderId; 2] {
        self.contact.colliders.map(|slot| ColliderId(self.world.bodies.records.key_at(slot)))
    }

    /// The body that `body` is in contact with; `None` if `body` is neither of the two.
    pub fn other(&self, body: BodyId) -> Option<BodyId> {
        other_of([self.a(), self.b()], body)
    }

    /// Direction in which the contact pushes `body`, away from the other: the normal as it is seen from this body, of
    /// length 1. A body that is neither of the two is not pushed, and has the vector of length 0.
    pub fn normal_on(&self, body: BodyId) -> Vec2 {
        self.normal() * side_of([self.a(), self.b()], body)
    }

    /// Impulse that the contact gave `body` over the last tick, N s: along the normal and of friction, of all substeps and
    /// bounces; 0 for a body that is neither of the two. `None` where impulses are not added up, see
    /// [`Settings::sum_impulses`](crate::Settings::sum_impulses), and while both bodies sleep.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings { sum_impulses: true, ..Settings::default() });
    /// # world.add_force(Force::EARTH_GRAVITY);
    /// # world.add(Body::fixed(Shape::aabb(20.0, 1.0)))?;
    /// # let crate_ = world.add(Body::dynamic(Shape::rectangle(1.0, 1.0)).at([0.0, 1.0]).mass(3.0))?;
    /// # for _ in 0..20 { world.step(); }
    /// // What the crate is pressed with, N: its weight, while it rests.
    /// let rate = world.settings().tick_rate;
    /// let force: f32 =
    ///     world.contacts_of(crate_).filter_map(|contact| contact.impulse_on(crate_)).map(|on| on.y * rate).sum();
    /// assert!((force - 3.0 * 9.81).abs() < 0.01);
    /// # Ok::<(), BodyError>(())
    /// ```
    pub fn impulse_on(&self, body: BodyId) -> Option<Vec2> {
        let on_b = self.world.solver.blows.of_contact(self.index)?.on_b;
        Some(on_b * side_of([self.a(), self.b()], body))
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
        self.contact.mixed.friction
    }

    /// Coefficient of restitution of the contact.
    pub fn restitution(&self) -> f32 {
        self.contact.mixed.restitution
    }

    /// Coefficient of [rolling resistance](crate::Body::rolling_resistance), no unit: the greater of those that the two were told, or 0.002 if
    /// neither was. It only acts where a circle rolls about the centre of mass of its body.
    pub fn rolling_resistance(&self) -> f32 {
        self.contact.mixed.rolling_resistance
    }
}

impl fmt::Debug for ContactRef<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (a, b, is_touching) = (self.a(), self.b(), self.is_touching());
        let mut shown = f.debug_struct("ContactRef");
        shown.field("a", &a).field("b", &b).field("is_touching", &is_touching);
        shown.field("manifold", self.manifold()).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use crate::body::{Body, BodyId};
    use crate::shape::Shape;
    use crate::world::{Force, Settings, World};

    /// 100 characters on and over 1,500 boxes: what is looked at for all of them are the few contacts that each has, and not the
    /// thousands that there are. A test of work, not of time.
    #[test]
    fn to_ask_for_the_contacts_of_bodies_is_no_walk_over_those_of_all_others() {
        let mut world = World::new(Settings::default());
        world.add_force(Force::EARTH_GRAVITY);
        world.add(Body::fixed(Shape::rectangle(200.0, 1.0)).at([0.0, -0.5])).unwrap();
        for number in 0..1500 {
            let at = [f64::from(number % 150) - 75.0, 0.45 + 0.9 * f64::from(number / 150)];
            world.add(Body::dynamic(Shape::rectangle(0.9, 0.9)).at(at)).unwrap();
        }
        let mut characters = Vec::new();
        for number in 0..100 {
            let at = [f64::from(number) - 50.0, if number % 2 == 0 { 9.7 } else { 40.0 }];
            let character = Body::dynamic(Shape::rectangle(0.5, 1.4)).at(at).fixed_rotation(true);
            characters.push(world.add(character).unwrap());
        }
        for _ in 0..10 {
            world.step();
        }
        let looked_at = |&BodyId(key): &BodyId| world.contacts.of_body(&world.bodies, key.index()).count();
        let all: usize = characters.iter().map(looked_at).sum();
        assert!(world.contacts.len() >= 3000, "{} contacts", world.contacts.len());
        // One or two boxes under each that stands, and its two neighbours.
        assert!((50..=400).contains(&all), "{all} contacts are looked at");
        let standing = characters.iter().filter(|&&id| {
            world.contacts_of(id).any(|contact| contact.is_touching() && contact.normal_on(id).y > 0.7)
        });
        assert_eq!(standing.count(), 50);
    }
}
