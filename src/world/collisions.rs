//! What a body is to what it meets, and which pairs of bodies collide. What is set here holds for all shapes of a body.

use crate::body::{BodyError, BodyId, ContactFilter, Filter};
use crate::math::Vec2;
use crate::world::{BodyMut, ColliderMut, World};

impl BodyMut<'_> {
    /// Makes the body a one-way floor in this direction, see [`Body::one_way`](crate::Body::one_way), or, by `None`, one that is
    /// passed by none. What touches it wakes, and decides anew whether it passes.
    ///
    /// # Errors
    /// [`BodyError`], if the direction is not finite or has no length.
    pub fn set_one_way(&mut self, direction: impl Into<Option<Vec2>>) -> Result<(), BodyError> {
        self.all_shapes().set_one_way(direction)
    }

    /// Sets the speed of the surface against the body, m/s, see [`Body::surface_speed`](crate::Body::surface_speed). What touches
    /// it wakes, unless it is the speed it has. Refused beyond ±10⁶ m/s.
    #[track_caller]
    pub fn set_surface_speed(&mut self, speed: f32) -> &mut Self {
        self.all_shapes().set_surface_speed(speed);
        self
    }

    /// Sets the coefficient of rolling resistance, see [`Body::rolling_resistance`](crate::Body::rolling_resistance). It wakes, and
    /// what touches it, unless it is what it has.
    ///
    /// # Errors
    /// [`BodyError`], if it is not within 0 to 10⁶.
    pub fn set_rolling_resistance(&mut self, coefficient: f32) -> Result<(), BodyError> {
        self.all_shapes().set_rolling_resistance(coefficient)
    }

    /// Sets which bodies it collides with. Contacts with others end, and new ones begin in the next step; what it touched wakes.
    pub fn set_filter(&mut self, filter: Filter) {
        self.all_shapes().set_filter(filter);
    }

    /// Makes the body a sensor, see [`Body::sensor`](crate::Body::sensor), or no longer one. Its contacts end; what it touched
    /// wakes.
    pub fn set_sensor(&mut self, is_sensor: bool) {
        self.all_shapes().set_sensor(is_sensor);
    }

    /// Sets the coefficient of friction, 0 or more.
    ///
    /// # Errors
    /// [`BodyError`], if it is negative, not finite or beyond 10⁶.
    pub fn set_friction(&mut self, friction: f32) -> Result<(), BodyError> {
        self.all_shapes().set_friction(friction)
    }

    /// Sets the coefficient of restitution, 0 to 1.
    ///
    /// # Errors
    /// [`BodyError`], if it is not from 0 to 1.
    pub fn set_restitution(&mut self, restitution: f32) -> Result<(), BodyError> {
        self.all_shapes().set_restitution(restitution)
    }

    /// Its shapes, to change all of them.
    pub(in crate::world) fn all_shapes(&mut self) -> ColliderMut<'_> {
        ColliderMut::of_all(self.world, self.id())
    }
}

impl World {
    /// Says whether two bodies may collide with each other: with `false` they pass through each other, whatever their filters;
    /// with `true`, the default, it is up to these. It holds until one of them is removed, and wakes both. Returns
    /// what held before; `None`, and does nothing, if one was removed or they are the same.
    ///
    /// While a body passes through a fixed or kinematic one, it feels where the pieces of the ground meet: one of them may be no ground
    /// to it.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// # let floor = world.add(Body::fixed(Shape::aabb(20.0, 1.0)))?;
    /// # let player = world.add(Body::dynamic(Shape::circle(0.5)).at([0.0, 1.0]))?;
    /// // The player drops through this floor only.
    /// world.set_collision(player, floor, false);
    /// assert_eq!(world.may_collide(floor, player), Some(false));
    /// # Ok::<(), BodyError>(())
    /// ```
    pub fn set_collision(&mut self, a: BodyId, b: BodyId, collide: bool) -> Option<bool> {
        let [a, b] = self.slots_of_pair([a, b])?;
        let collided = !self.bodies.roles.are_parted(a, b);
        if collide == collided {
            return Some(collided);
        }
        self.sensors.note_edit();
        self.wake_slot(a);
        self.wake_slot(b);
        if collide {
            self.bodies.roles.join(a, b);
            for collider in self.bodies.colliders(a) {
                self.broad_phase.mark_moved(collider);
            }
        } else {
            self.bodies.roles.part(a, b);
            self.end_pairs([a, b]);
        }
        Some(collided)
    }

    /// Whether two bodies collide where they meet: by their types, of which one is to be dynamic, their filters,
    /// [`set_collision`](Self::set_collision), the [contact filter](Self::set_contact_filter), and the joints between them. A sensor
    /// collides with nothing. `None` if one was removed, or they are the same.
    pub fn may_collide(&self, a: BodyId, b: BodyId) -> Option<bool> {
        let [a, b] = self.slots_of_pair([a, b])?;
        let bodies = &self.bodies;
        let collide = |of_a: u32| bodies.colliders(b).any(|of_b| bodies.may_collide(of_a, of_b));
        Some(!self.joints.part(a, b) && bodies.colliders(a).any(collide))
    }

    /// Has a function say beside filters and [`set_collision`](Self::set_collision) whether two shapes collide, or, by `None`, no
    /// longer; at first there is none. Pairs that have met are looked at anew, and all bodies wake. Sensors, queries and characters
    /// do not ask it. It belongs to the world as its settings do: clones have it too, and [`state_hash`](Self::state_hash) does not
    /// see it.
    ///
    /// Where it refuses some pieces of a ground and not others, filters by category are the better choice: a piece that only this
    /// function refuses still counts as ground beside the others.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// // A key fits one door: the caller's numbers are those of a key and a door, or 0.
    /// let opens = |a: u64, b: u64| a != 0 && a == b;
    /// world.set_contact_filter(ContactFilter::new(move |a, b| !opens(a.user_data(), b.user_data())));
    /// world.set_contact_filter(None);
    /// ```
    pub fn set_contact_filter(&mut self, filter: impl Into<Option<ContactFilter>>) {
        self.bodies.contact_filter = filter.into();
        let slots: Vec<u32> = self.bodies.ids().map(|id| id.0.index()).collect();
        for slot in slots {
            self.collisions_changed(slot);
        }
    }

    /// The slots of two bodies that are there, and not the same.
    fn slots_of_pair(&self, ids: [BodyId; 2]) -> Option<[u32; 2]> {
        let [a, b] = ids.map(|id| id.0.index());
        let are_there = ids.into_iter().all(|id| self.bodies.has(id));
        (are_there && a != b).then_some([a, b])
    }

    /// Ends whatever there is between two bodies that do not collide any more.
    pub(in crate::world) fn end_pairs(&mut self, [a, b]: [u32; 2]) {
        let is_between = |&index: &u32| self.contacts[index].other(a) == b;
        let contacts: Vec<u32> = self.contacts.of_body(&self.bodies, a).filter(is_between).collect();
        for index in contacts {
            self.end_contact(index);
        }
        let bodies = &self.bodies;
        let pairs =
            || bodies.colliders(a).flat_map(|a| bodies.colliders(b).map(move |b| (a.min(b), a.max(b))));
        self.candidates.remove(pairs());
        for (a, b) in pairs() {
            self.broad_phase.forget_pair(a, b);
        }
    }

    /// Has contacts and pairs of a body looked at anew: others may collide with it than before.
    pub(in crate::world) fn collisions_changed(&mut self, slot: u32) {
        self.note_ground(slot);
        self.wake_slot(slot);
        self.wake_neighbours(slot);
        let bodies = &self.bodies;
        let ends = |&index: &u32| {
            let [a, b] = self.contacts[index].colliders;
            !bodies.may_collide(a, b)
        };
        let ending: Vec<u32> = self.contacts.of_body(bodies, slot).filter(ends).collect();
        for index in ending {
            self.end_contact(index);
        }
        self.sensors.note_edit();
        for collider in self.bodies.colliders(slot) {
            self.candidates.note_removed(collider);
            self.broad_phase.mark_moved(collider);
        }
    }
}
