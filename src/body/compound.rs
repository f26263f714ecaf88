//! Bodies of several shapes.
//!
//! Such a body has a slot for its motion, and one more for each of its shapes: its colliders. Collision asks about colliders,
//! all else about bodies. Of a body of one shape both are the same slot, and a world of such bodies has nothing here. What
//! collision must know of the body of a collider, its row and its masses, stands in the `Motion` of the collider too.

use crate::body::collider::{Collider, Masses, Part};
use crate::body::{Bodies, Body, BodyId, Forcing, Motion, NONE, Record};
use crate::math::{Aabb, Point, Pose, Rot, Vec2};
use crate::shape::Shape;

/// Where colliders are on their bodies.
#[derive(Debug, Default)]
pub(crate) struct Compounds {
    /// How many bodies have several shapes.
    count: usize,
    /// How many shapes these have.
    collider_count: usize,
    /// By slot of a collider; what stands there for others has no meaning.
    places: Vec<Place>,
}

clone_into_buffers!(Compounds { count, collider_count, places });

/// Where a collider is on its body.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    /// In the frame that the body is described in: its centre, m, and its angle, rad.
    at: Vec2,
    angle: f32,
    /// Its centre from the centre of mass of the body, in the frame of the body, m.
    arm: Vec2,
    turn: Rot,
    /// The width of the body as a whole, m: its area over its length.
    width_of_body: f32,
}

impl Compounds {
    /// Whether all bodies have one shape.
    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Gives up what is not needed for slots below `end`: there are no others.
    pub(super) fn trim(&mut self, end: usize) {
        self.places.truncate(end);
    }
}

/// Reading.
impl Bodies {
    /// Whether the slot is that of a body, and not only of one of its shapes.
    pub(crate) fn is_body(&self, slot: u32) -> bool {
        self.records[slot].body == slot
    }

    /// How many bodies there are.
    pub(crate) fn count(&self) -> usize {
        self.records.len() - self.compounds.collider_count
    }

    /// Whether the body with this id is there.
    pub(crate) fn has(&self, id: BodyId) -> bool {
        self.records.get(id.0).is_some_and(|record| record.body == id.0.index())
    }

    /// The ids of all bodies, by ascending slot.
    pub(crate) fn ids(&self) -> impl Iterator<Item = BodyId> {
        self.records.iter().filter(|(key, record)| record.body == key.index()).map(|(key, _)| BodyId(key))
    }

    /// The slot of the body that the shape in `slot` is of.
    #[inline(always)]
    pub(crate) fn body_of(&self, slot: u32) -> u32 {
        if self.compounds.is_empty() { slot } else { self.records[slot].body }
    }

    /// The same of two.
    #[inline(always)]
    pub(crate) fn bodies_of(&self, colliders: [u32; 2]) -> [u32; 2] {
        colliders.map(|slot| self.body_of(slot))
    }

    /// Whether the body in `slot` has several shapes.
    #[inline(always)]
    pub(crate) fn is_compound(&self, slot: u32) -> bool {
        !self.compounds.is_empty() && self.is_body(slot) && self.records[slot].next_collider != NONE
    }

    /// Whether the body in `slot` can have an angle: not with a shape that never turns.
    pub(crate) fn can_be_turned(&self, slot: u32) -> bool {
        self.colliders(slot).all(|collider| self.shapes[collider as usize].can_rotate())
    }

    /// The smallest box with sides parallel to the axes that holds the shapes of the body in `slot`, rounded outward.
    pub(crate) fn aabb_of_all(&self, slot: u32) -> Aabb {
        let boxes = self.colliders(slot).map(|collider| self.aabb(collider));
        boxes.reduce(Aabb::union).unwrap_or_default()
    }

    /// The slots of the shapes of the body in `slot`, its own first.
    pub(crate) fn colliders(&self, slot: u32) -> impl Iterator<Item = u32> {
        let mut next = self.own_collider(slot);
        std::iter::from_fn(move || {
            let here = next;
            (here != NONE).then(|| {
                next = if here == slot { NONE } else { self.records[here].next_collider };
                here
            })
        })
    }

    /// The slot of the own shape of the body in `slot`.
    pub(crate) fn own_collider(&self, slot: u32) -> u32 {
        if self.is_compound(slot) { self.records[slot].next_collider } else { slot }
    }

    /// The centre of the shape in `slot` from the centre of mass of its body, as the body is turned, m.
    #[inline(always)]
    pub(crate) fn arm(&self, slot: u32) -> Vec2 {
        if self.compounds.is_empty() || self.is_body(slot) {
            return Vec2::ZERO;
        }
        let turn = self.motions[self.records[slot].body as usize].pose.rotation;
        turn.rotate(self.compounds.places[slot as usize].arm)
    }

    /// The same of two; `None` where both are at the centres of mass of their bodies.
    #[inline(always)]
    pub(crate) fn arms(&self, colliders: [u32; 2]) -> Option<[Vec2; 2]> {
        if self.compounds.is_empty() {
            return None;
        }
        let arms = colliders.map(|slot| self.arm(slot));
        (arms != [Vec2::ZERO; 2]).then_some(arms)
    }

    /// Whether the shape in `slot` is one of several of a body.
    #[inline(always)]
    pub(crate) fn is_one_of_several(&self, slot: u32) -> bool {
        !self.compounds.is_empty() && !self.is_body(slot)
    }

    /// The width of the body that the shape in `slot` is of, m: of several shapes their area over the length of the body, as each
    /// may be a sliver.
    pub(crate) fn width_of_body(&self, slot: u32) -> f32 {
        if self.is_one_of_several(slot) {
            self.compounds.places[slot as usize].width_of_body
        } else {
            self.motions[slot as usize].thickness
        }
    }

    /// Velocity of the centre of the shape in `slot`, m/s.
    pub(crate) fn velocity_of_shape(&self, slot: u32) -> Vec2 {
        let state = self.state(slot);
        state.velocity_at(self.arm(slot).into()).to_vec2()
    }

    /// Farthest that the outline of the shape in `slot` is from what its body turns about, m, if it moves as the body turns.
    pub(crate) fn swing(&self, slot: u32) -> f32 {
        let motion = &self.motions[slot as usize];
        if motion.is_round { 0.0 } else { motion.extent + self.arm(slot).length() }
    }

    /// Where the shape in `slot` is while its body is in a pose.
    pub(crate) fn pose_in(&self, slot: u32, of_body: Pose) -> Pose {
        if self.is_body(slot) {
            return of_body;
        }
        let Place { arm, turn, .. } = self.compounds.places[slot as usize];
        Pose { center: of_body.to_world(arm), rotation: of_body.rotation * turn }
    }

    /// Where the middle of the frame is that the body in `slot` is described in: the centre of its own shape, if it is not made of
    /// pieces.
    pub(crate) fn place_of_frame(&self, slot: u32) -> Point {
        let own = self.own_collider(slot);
        let at = self.place_on_frame(own);
        let center = self.center(own);
        if at == Vec2::ZERO {
            return center;
        }
        center - self.motions[slot as usize].pose.rotation.rotate(at)
    }

    /// Where the shape in `slot` is in the frame that its body is described in, m.
    pub(super) fn place_on_frame(&self, slot: u32) -> Vec2 {
        if self.is_body(slot) {
            return Vec2::ZERO;
        }
        self.compounds.places[slot as usize].at
    }

    /// The shapes of the body in `slot` beside its own.
    pub(super) fn further_colliders(&self, slot: u32) -> Vec<Collider> {
        self.colliders(slot).skip(1).map(|collider| self.describe_collider(collider)).collect()
    }

    /// The description of one of several shapes of a body.
    pub(crate) fn describe_collider(&self, slot: u32) -> Collider {
        let (record, role) = (&self.records[slot], self.roles.of(slot));
        let Place { at, angle, .. } = self.compounds.places.get(slot as usize).copied().unwrap_or_default();
        let (shape, material) = (self.shapes[slot as usize], record.material);
        Part { shape, at, angle, material, role, user_data: record.user_data }.describe()
    }
}

/// The width, m, of a body of some shapes with its centre of mass at a place of its frame: their area over its length, sensors left out.
fn width_of(parts: &[Part], center: Vec2) -> f32 {
    let solid = || parts.iter().filter(|part| !part.role.is_sensor);
    let area: f32 = solid().map(|part| part.shape.area()).sum();
    let extent = solid().map(|part| part.shape.extent() + (part.at - center).length()).fold(0.0, f32::max);
    if extent > 0.0 { area / (2.0 * extent) } else { 0.0 }
}

/// Changing.
impl Bodies {
    /// Gives the new body in `slot` its several shapes.
    pub(super) fn insert_colliders(&mut self, slot: u32, body: &Body) {
        let parts = body.parts();
        self.compounds.count += 1;
        self.compounds.collider_count += parts.len();
        // The last first, as each knows the next.
        for &Part { shape, at, angle, user_data, .. } in parts.iter().rev() {
            let record = Record { user_data, first_contact: NONE, ..self.records[slot].clone() };
            let key = self.take_slot(record, Motion::default(), Forcing::default(), shape);
            self.records[slot].next_collider = key.index();
            let index = key.index() as usize;
            if self.compounds.places.len() <= index {
                self.compounds.places.resize(index + 1, Place::default());
            }
            self.compounds.places[index] = Place { at, angle, ..Place::default() };
        }
        self.fit_colliders(slot, body, body.center);
    }

    /// Makes the shapes of the body in `slot`, as many as it has, what a description says; its frame is at a place, m.
    pub(super) fn fit_colliders(&mut self, slot: u32, body: &Body, frame: Point) {
        let Masses { center, .. } = body.masses();
        let (mut extent, mut thickness) = (0.0_f32, f32::INFINITY);
        let slots: Vec<u32> = self.colliders(slot).collect();
        for (&collider, part) in slots.iter().zip(body.parts()) {
            let index = collider as usize;
            let arm = part.at - center;
            let place = &mut self.compounds.places[index];
            (place.arm, place.turn) = (arm, part.rotation());
            self.shapes[index] = part.shape;
            self.records[collider].material = part.material;
            self.records[collider].body_type = body.body_type;
            self.roles.set(collider, part.role);
            let motion = &mut self.motions[index];
            (motion.extent, motion.thickness) = (part.shape.extent(), part.shape.width_of_overlaps());
            motion.is_circle = matches!(part.shape, Shape::Circle(_));
            motion.is_round = motion.is_circle && arm == Vec2::ZERO;
            extent = extent.max(motion.extent + arm.length());
            thickness = thickness.min(motion.thickness);
        }
        let width_of_body = width_of(&body.parts(), center);
        for collider in slots {
            self.compounds.places[collider as usize].width_of_body = width_of_body;
        }
        let motion = &mut self.motions[slot as usize];
        (motion.extent, motion.thickness) = (extent, thickness);
        (motion.is_circle, motion.is_round) = (false, false);
        motion.pose.center = Pose { center: frame, ..motion.pose }.to_world(center);
        let pose = motion.pose;
        if let Some(previous) = self.previous_pose_mut(slot) {
            *previous = pose;
        }
        self.tell_colliders(slot);
        self.place_colliders(slot);
    }

    /// Has the shapes of the body in `slot` know its row and masses.
    pub(super) fn tell_colliders(&mut self, slot: u32) {
        let Motion { row, inverse_mass, inverse_inertia, .. } = self.motions[slot as usize];
        self.for_each_collider(slot, |bodies, collider| {
            let motion = &mut bodies.motions[collider as usize];
            (motion.row, motion.inverse_mass, motion.inverse_inertia) = (row, inverse_mass, inverse_inertia);
        });
    }

    /// Puts the shapes of the body in `slot` to where it is.
    pub(crate) fn place_colliders(&mut self, slot: u32) {
        let of_body = self.motions[slot as usize].pose;
        self.for_each_collider(slot, |bodies, collider| {
            bodies.motions[collider as usize].pose = bodies.pose_in(collider, of_body);
        });
    }

    /// Calls `change` with each shape of the body in `slot`, or with the shape there, if it is one of several.
    pub(crate) fn for_each_shape(&mut self, slot: u32, mut change: impl FnMut(&mut Self, u32)) {
        if self.is_compound(slot) {
            self.for_each_collider(slot, change);
        } else {
            change(self, slot);
        }
    }

    /// Calls `change` with each of several shapes of the body in `slot`.
    fn for_each_collider(&mut self, slot: u32, mut change: impl FnMut(&mut Self, u32)) {
        if self.is_compound(slot) {
            let mut next = self.records[slot].next_collider;
            while next != NONE {
                let here = next;
                next = self.records[here].next_collider;
                change(self, here);
            }
        }
    }

    /// Takes the several shapes of the body in `slot` out, which is removed.
    pub(super) fn remove_colliders(&mut self, slot: u32) {
        if self.is_compound(slot) {
            self.for_each_collider(slot, |bodies, collider| {
                bodies.compounds.collider_count -= 1;
                bodies.exposures.set(collider, None);
                bodies.roles.forget(collider);
                bodies.records.remove(bodies.records.key_at(collider));
            });
            self.records[slot].next_collider = NONE;
            self.compounds.count -= 1;
        }
    }
}
