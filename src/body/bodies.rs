//! All bodies of a world, in tables indexed by slot.

use crate::body::collider::Masses;
use crate::body::compound::Compounds;
use crate::body::exposures::Exposures;
use crate::body::{Body, BodyId, BodyType, ContactFilter, Material, RestRule, RestWatch, Roles};
use crate::compute::{BodyState, COLUMN, DistinctIndices, GROUND_ROW, prefetch};
use crate::math::{Aabb, Point, Pose, Rot, Vec2};
use crate::shape::{Exposure, Shape};
use crate::store::{Key, Slots};

/// No slot, group or contact: the end of a list.
pub(crate) const NONE: u32 = u32::MAX;

/// Cold: what is touched when somebody asks, or a contact begins.
#[derive(Clone, Debug)]
pub(crate) struct Record {
    pub(crate) body_type: BodyType,
    pub(crate) material: Material,
    /// Mass, kg, as if the body were dynamic.
    pub(crate) mass: f32,
    /// Moment of inertia about the centre of mass, kg m², as if the body were dynamic and free to turn.
    pub(crate) inertia: f32,
    /// The caller's override of the mass, kept so that the description can be given back.
    pub(crate) mass_override: Option<f32>,
    pub(crate) fixed_rotation: bool,
    /// Whether it was told to get to a pose in the next tick, and to stop there.
    pub(crate) stops_after_tick: bool,
    pub(crate) user_data: u64,
    /// First contact of the body, or `NONE`.
    pub(crate) first_contact: u32,
    /// The sleeping group the body belongs to, or `NONE` while it is awake or fixed.
    pub(crate) sleep_group: u32,
    /// The slot of the body: its own, or, of one of several shapes of a body, that of the body.
    pub(crate) body: u32,
    /// Of a body of several shapes the slot of the first; of one of them that of the next; `NONE` where there is none.
    pub(crate) next_collider: u32,
}

/// Warm: pose, mass and size; touched a few times per step, by contacts in the order of their pairs. One cache line.
#[repr(align(64))]
#[derive(Clone, Debug, Default)]
pub(crate) struct Motion {
    pub(crate) pose: Pose,
    /// 1/mass, 1/kg; 0 for fixed and kinematic bodies.
    pub(crate) inverse_mass: f32,
    /// 1/(moment of inertia), 1/(kg m²); 0 where the body cannot be turned.
    pub(crate) inverse_inertia: f32,
    /// Greatest distance of the outline from the centre, m.
    pub(crate) extent: f32,
    /// Smallest width of the shape, m, by which overlaps are judged; infinite for segments, which leave it to what they meet.
    pub(crate) thickness: f32,
    /// Whether the shape is a circle around the centre of mass, whose outline does not turn with it.
    pub(crate) is_round: bool,
    /// Whether the shape is a circle.
    pub(crate) is_circle: bool,
    /// Whether it may be put to sleep.
    pub(crate) may_sleep: bool,
    /// Whether it is slow enough to be watched for rest, as its `RestWatch` tells.
    pub(crate) is_watched: bool,
    /// The body's row of `Bodies::states`, `GROUND_ROW` while it is fixed or asleep.
    pub(crate) row: u32,
    /// What rounding has kept out of the velocity so far, m/s.
    pub(crate) velocity_compensation: Vec2,
    /// How far the outline may still move before its box must be looked at, m; any distance for a body of several shapes, which
    /// have the boxes.
    pub(crate) room: f32,
}

const _: () = assert!(size_of::<Motion>() == 64);

impl Motion {
    /// Takes mass and size from a description, as if its own shape were all it has.
    fn fit(&mut self, body: &Body) {
        let Masses { mass, inertia, .. } = body.masses();
        let is_dynamic = body.body_type == BodyType::Dynamic;
        self.inverse_mass = if is_dynamic { 1.0 / mass } else { 0.0 };
        self.inverse_inertia = if is_dynamic && body.can_turn() { 1.0 / inertia } else { 0.0 };
        self.extent = body.shape.extent();
        self.thickness = body.shape.width_of_overlaps();
        self.is_circle = matches!(body.shape, Shape::Circle(_));
        self.is_round = self.is_circle;
    }

    /// Watches the body for rest over a step that has moved it `by` and turned it by `turn`. Returns whether it may sleep.
    #[inline(always)]
    pub(crate) fn watch(&mut self, watch: &mut RestWatch, by: Vec2, turn: Rot, rule: RestRule) -> bool {
        // What turns by more than a right angle is far from rest, by whichever angle.
        let angle = if turn.c > 0.0 { turn.s } else { core::f32::consts::PI };
        let is_slow = by.norm_1() + angle.abs() * self.extent <= rule.reach;
        if is_slow && !self.is_watched {
            *watch = RestWatch::begin(rule);
        }
        self.is_watched = is_slow && watch.follow(by, angle, self.extent, rule);
        self.is_watched && self.may_sleep && watch.is_at_rest(rule)
    }
}

/// Warm: what acts on the body; touched once per step, in the order of rows.
#[derive(Clone, Debug, Default)]
pub(crate) struct Forcing {
    /// Force during the next step, N.
    pub(crate) force: Vec2,
    /// Torque during the next step, N m.
    pub(crate) torque: f32,
    /// Factor on the world's forces.
    pub(crate) gravity_scale: f32,
    /// Damping, 1/s.
    pub(crate) linear_damping: f32,
    /// Damping, 1/s.
    pub(crate) angular_damping: f32,
}

impl Forcing {
    /// What acts on the body acts for one step.
    #[inline(always)]
    pub(crate) fn end_step(&mut self) {
        self.force = Vec2::ZERO;
        self.torque = 0.0;
    }
}

/// All bodies of a world. A body keeps its slot for life; only the rows of the awake move.
#[derive(Debug)]
pub(crate) struct Bodies {
    pub(crate) records: Slots<Record>,
    /// By slot; what stands in a free slot is left over.
    pub(crate) motions: Vec<Motion>,
    /// By slot.
    pub(crate) forcings: Vec<Forcing>,
    /// By slot; what stands there for a body that is not watched is left over.
    pub(crate) watches: Vec<RestWatch>,
    /// By slot.
    pub(crate) shapes: Vec<Shape>,
    pub(crate) roles: Roles,
    pub(crate) compounds: Compounds,
    pub(crate) exposures: Exposures,
    /// What says beside the roles whether two shapes collide.
    pub(crate) contact_filter: Option<ContactFilter>,
    /// By row: the ground, then every awake body that can move; and rows at rest that are no body's, to whole columns.
    pub(crate) states: Vec<BodyState>,
    /// By row: the pose before the last tick, or since when the body is there; that of the ground has no meaning.
    pub(crate) previous: Vec<Pose>,
    /// The slots of the bodies with rows, in their order, from the row after the ground's on.
    pub(crate) awake: DistinctIndices,
    /// No body that moves is, or was, thinner or longer, m: smallest width, and greatest distance of an outline from its
    /// centre.
    pub(crate) smallest_thickness: f32,
    pub(crate) largest_extent: f32,
}

clone_into_buffers!(Bodies {
    records,
    motions,
    forcings,
    watches,
    shapes,
    roles,
    compounds,
    exposures,
    contact_filter,
    states,
    previous,
    awake,
    smallest_thickness,
    largest_extent
});

impl Default for Bodies {
    fn default() -> Self {
        Self {
            records: Slots::default(),
            motions: Vec::new(),
            forcings: Vec::new(),
            watches: Vec::new(),
            shapes: Vec::new(),
            roles: Roles::default(),
            compounds: Compounds::default(),
            exposures: Exposures::default(),
            contact_filter: None,
            states: vec![BodyState::REST; COLUMN],
            previous: vec![Pose::default()],
            awake: DistinctIndices::default(),
            smallest_thickness: f32::INFINITY,
            largest_extent: 0.0,
        }
    }
}

impl Bodies {
    /// Adds a body whose description has been validated, awake unless it is fixed; returns its id.
    pub(crate) fn insert(&mut self, body: &Body) -> BodyId {
        let Masses { mass, inertia, .. } = body.masses();
        let record = Record {
            body_type: body.body_type,
            material: body.material,
            mass,
            inertia,
            mass_override: body.mass,
            fixed_rotation: body.fixed_rotation,
            stops_after_tick: false,
            user_data: body.user_data,
            first_contact: NONE,
            sleep_group: NONE,
            body: NONE,
            next_collider: NONE,
        };
        let pose = body.pose();
        let mut motion = Motion { pose, row: GROUND_ROW, may_sleep: body.may_sleep, ..Motion::default() };
        motion.fit(body);
        let forcing = Forcing {
            gravity_scale: body.gravity_scale,
            linear_damping: body.linear_damping,
            angular_damping: body.angular_damping,
            ..Forcing::default()
        };
        let key = self.take_slot(record, motion, forcing, body.shape);
        let slot = key.index();
        self.records[slot].body = slot;
        if body.further.is_empty() {
            self.roles.set(slot, body.role);
        } else {
            self.insert_colliders(slot, body);
        }
        self.measure(slot);
        if body.body_type != BodyType::Fixed {
            let row = self.give_row(slot);
            let state = &mut self.states[row as usize];
            state.velocity = body.velocity.into();
            state.angular_velocity = if body.can_turn() { body.angular_velocity } else { 0.0 };
        }
        BodyId(key)
    }

    /// Fills a free slot of all tables.
    pub(super) fn take_slot(
        &mut self,
        record: Record,
        motion: Motion,
        forcing: Forcing,
        shape: Shape,
    ) -> Key {
        let key = self.records.insert(record);
        let slot = key.index() as usize;
        if slot == self.motions.len() {
            self.motions.push(motion);
            self.forcings.push(forcing);
            self.watches.push(RestWatch::default());
            self.shapes.push(shape);
        } else {
            (self.motions[slot], self.forcings[slot], self.shapes[slot]) = (motion, forcing, shape);
        }
        key
    }

    /// Takes note of how small and how long a body is.
    fn measure(&mut self, slot: u32) {
        if self.records[slot].body_type != BodyType::Fixed {
            let motion = &self.motions[slot as usize];
            self.smallest_thickness = self.smallest_thickness.min(motion.thickness);
            self.largest_extent = self.largest_extent.max(motion.extent);
        }
    }

    /// Takes the body out of every table and gives back its description.
    pub(crate) fn remove(&mut self, key: Key) -> Option<Body> {
        self.records.get(key)?;
        let description = self.describe(key.index());
        self.take_row(key.index());
        self.remove_colliders(key.index());
        self.exposures.set(key.index(), None);
        self.roles.forget(key.index());
        self.records.remove(key);
        Some(description)
    }

    /// Gives up the free slots after the last body, and rows beyond those of the awake.
    pub(crate) fn trim(&mut self) {
        self.records.trim();
        let slots = self.slot_count();
        self.motions.truncate(slots);
        self.forcings.truncate(slots);
        self.watches.truncate(slots);
        self.shapes.truncate(slots);
        self.roles.trim(slots);
        self.compounds.trim(slots);
        self.exposures.trim(slots);
        self.awake.trim();
        self.states.truncate(self.row_count().next_multiple_of(COLUMN));
    }

    /// How many slots there are, the free ones with them.
    pub(crate) fn slot_count(&self) -> usize {
        self.records.place_count()
    }

    /// The description of the body in `slot` as it is now.
    pub(crate) fn describe(&self, slot: u32) -> Body {
        let record = &self.records[slot];
        let (motion, state) = (&self.motions[slot as usize], self.state(slot));
        let forcing = &self.forcings[slot as usize];
        let own = self.own_collider(slot);
        Body {
            body_type: record.body_type,
            shape: self.shapes[own as usize],
            center: self.place_of_frame(slot),
            angle: motion.pose.rotation.angle(),
            velocity: state.velocity.to_vec2(),
            angular_velocity: state.angular_velocity,
            material: self.records[own].material,
            mass: record.mass_override,
            fixed_rotation: record.fixed_rotation,
            gravity_scale: forcing.gravity_scale,
            linear_damping: forcing.linear_damping,
            angular_damping: forcing.angular_damping,
            may_sleep: motion.may_sleep,
            user_data: record.user_data,
            role: self.roles.of(own),
            own_at: self.place_on_frame(own),
            further: self.further_colliders(slot),
            flaw: None,
        }
    }

    /// Makes the body in `slot` what a validated description says, but for its pose and velocity, with as many shapes as it
    /// has.
    pub(crate) fn redescribe(&mut self, slot: u32, body: &Body) {
        let frame = self.place_of_frame(slot);
        let record = &mut self.records[slot];
        let old_type = core::mem::replace(&mut record.body_type, body.body_type);
        let masses = body.masses();
        (record.mass, record.inertia) = (masses.mass, masses.inertia);
        (record.material, record.mass_override) = (body.material, body.mass);
        record.fixed_rotation = body.fixed_rotation;
        let motion = &mut self.motions[slot as usize];
        motion.fit(body);
        motion.velocity_compensation = Vec2::ZERO;
        if !body.can_be_turned() {
            motion.pose.rotation = Rot::IDENTITY;
        }
        self.shapes[slot as usize] = body.shape;
        if body.further.is_empty() {
            self.roles.set(slot, body.role);
        } else {
            self.fit_colliders(slot, body, frame);
        }
        self.measure(slot);
        if body.body_type != BodyType::Dynamic {
            self.forcings[slot as usize].end_step();
        }
        match (old_type, body.body_type) {
            (BodyType::Fixed, BodyType::Fixed) => {}
            (BodyType::Fixed, _) => _ = self.give_row(slot),
            (_, BodyType::Fixed) => self.take_row(slot),
            _ => {}
        }
        if !body.can_turn() && body.body_type != BodyType::Fixed {
            let row = self.motions[slot as usize].row;
            self.states[row as usize].angular_velocity = 0.0;
            self.previous[row as usize].rotation = self.motions[slot as usize].pose.rotation;
        }
    }

    /// Gives the body at rest in `slot` a row of its own, so that the solver moves it; returns the row.
    pub(crate) fn give_row(&mut self, slot: u32) -> u32 {
        debug_assert_eq!(self.motions[slot as usize].row, GROUND_ROW);
        let row = self.row_count() as u32;
        if self.row_count() == self.states.len() {
            self.states.resize(self.row_count() + COLUMN, BodyState::REST);
        }
        self.awake.push(slot);
        self.set_row(slot, row);
        self.previous.push(self.motions[slot as usize].pose);
        row
    }

    /// Has the body in `slot`, and its shapes, know its row.
    fn set_row(&mut self, slot: u32, row: u32) {
        self.motions[slot as usize].row = row;
        if !self.compounds.is_empty() {
            self.tell_colliders(slot);
        }
    }

    /// Takes the row of the body in `slot` away, which leaves it at rest; the last row moves into the gap.
    pub(crate) fn take_row(&mut self, slot: u32) {
        let row = self.motions[slot as usize].row;
        if row == GROUND_ROW {
            return;
        }
        self.set_row(slot, GROUND_ROW);
        let last = self.row_count() - 1;
        self.states.swap(row as usize, last);
        self.states[last] = BodyState::REST;
        self.previous.swap_remove(row as usize);
        self.awake.swap_remove(row as usize - 1);
        if let Some(&moved) = self.awake.get(row as usize - 1) {
            self.set_row(moved, row);
        }
    }

    /// Velocity of the body in `slot`: its row, or rest.
    #[inline(always)]
    pub(crate) fn state(&self, slot: u32) -> &BodyState {
        &self.states[self.motions[slot as usize].row as usize]
    }

    /// Where the body in `slot` was before the last tick.
    pub(crate) fn previous_pose(&self, slot: u32) -> Pose {
        let motion = &self.motions[slot as usize];
        // What has no row has not moved.
        if motion.row == GROUND_ROW {
            return motion.pose;
        }
        let of_body = self.previous[motion.row as usize];
        if self.compounds.is_empty() { of_body } else { self.pose_in(slot, of_body) }
    }

    /// The same, to change it; `None` where the body has no row.
    pub(crate) fn previous_pose_mut(&mut self, slot: u32) -> Option<&mut Pose> {
        let row = self.motions[slot as usize].row;
        (row != GROUND_ROW).then(|| &mut self.previous[row as usize])
    }

    /// The slot of the dynamic body in a row; `None` where that of something else is, or the ground's.
    pub(crate) fn dynamic_in(&self, row: usize) -> Option<u32> {
        let slot = *self.awake.get(row.checked_sub(1)?)?;
        (self.motions[slot as usize].inverse_mass > 0.0).then_some(slot)
    }

    /// How many bodies the solver moves.
    pub(crate) fn awake_count(&self) -> usize {
        self.awake.len()
    }

    /// The slot of the body in a row, which is not the ground's.
    #[inline(always)]
    pub(crate) fn slot_of_row(&self, row: usize) -> u32 {
        self.awake[row - 1]
    }

    /// How many rows there are, the ground's with them.
    pub(crate) fn row_count(&self) -> usize {
        1 + self.awake.len()
    }

    /// Whether forces and contacts move the body in `slot`.
    #[inline(always)]
    pub(crate) fn is_dynamic(&self, slot: u32) -> bool {
        self.motions[slot as usize].inverse_mass > 0.0
    }

    /// Whether the body in `slot` is ground: contacts do not move it.
    pub(crate) fn is_ground(&self, slot: u32) -> bool {
        self.records[slot].body_type != BodyType::Dynamic
    }

    /// What neighbours leave of two shapes; `None` where that is all. A body that was parted from some of the ground passes through what
    /// may cover the rest: to it all is exposed.
    #[inline(always)]
    pub(crate) fn exposures_of(&self, colliders: [u32; 2]) -> Option<[Option<&Exposure>; 2]> {
        let [of_a, of_b] = self.exposures.of(colliders)?;
        let [a, b] = self.bodies_of(colliders);
        let is_ground = |slot: u32| self.is_ground(slot);
        let is_met =
            |owner: u32, other: u32| !(is_ground(owner) && self.roles.parted_from(other).any(is_ground));
        let both = [of_a.filter(|_| is_met(a, b)), of_b.filter(|_| is_met(b, a))];
        both.iter().any(Option::is_some).then_some(both)
    }

    /// Whether the solver moves the body in `slot` in this step.
    #[inline(always)]
    pub(crate) fn is_awake(&self, slot: u32) -> bool {
        self.motions[slot as usize].row != GROUND_ROW
    }

    /// The bounding box of the shape in `slot`, rounded outward.
    pub(crate) fn aabb(&self, slot: u32) -> Aabb {
        self.shapes[slot as usize].bounding_box(self.motions[slot as usize].pose)
    }

    /// Asks for what it takes to give the body in `slot` another fat box.
    #[inline(always)]
    pub(crate) fn prefetch_box(&self, slot: u32) {
        prefetch(&self.motions, slot as usize);
        prefetch(&self.shapes, slot as usize);
        self.records.prefetch(slot);
    }

    /// Centre of mass of the body in `slot`.
    pub(crate) fn center(&self, slot: u32) -> Point {
        self.motions[slot as usize].pose.center
    }
}
