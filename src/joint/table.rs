//! All joints of a world.

use crate::body::{Bodies, BodyId, NONE};
use crate::joint::check::SHORTEST;
use crate::joint::description::Anchors;
use crate::joint::{Joint, JointId, JointKind};
use crate::math::{Point, Rot, Vec2, atan2_f64};
use crate::store::Slots;

/// The most rows that a joint has.
pub(crate) const MOST_ROWS: usize = 5;

/// Where a joint holds `b`.
#[derive(Clone, Copy, Debug)]
pub(crate) enum End {
    /// On a body, from its centre, in its own frame, m.
    Body(u32, Vec2),
    /// A place of the world.
    World(Point),
}

/// What the steps have made of a joint.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct JointState {
    /// What each row bore in the last substep, N or N m.
    pub(crate) loads: [f32; MOST_ROWS],
    /// Angles of `a` and `b`, rad; each of any number of turns.
    pub(crate) angles: [f64; 2],
    /// Force on `b` in the last step, N, and torque, N m, on average.
    pub(crate) force: Vec2,
    pub(crate) torque: f32,
    /// How far the rigid rows and limits were off at the end of the last step, m and rad.
    pub(crate) gap: f32,
    pub(crate) angle_gap: f32,
    /// Ratchet: the tooth it has passed, rad.
    pub(crate) tooth: f64,
    pub(crate) pace: Pace,
}

impl JointState {
    /// Takes note of how far the bodies have turned in a step, rad.
    pub(crate) fn turned(&mut self, by: [f64; 2]) {
        self.angles = [self.angles[0] + by[0], self.angles[1] + by[1]];
    }
}

/// A joint of a world.
#[derive(Clone, Debug)]
pub(crate) struct JointRecord {
    pub(crate) description: Joint,
    pub(crate) slot_a: u32,
    /// From the centre of `a`, in its frame, m.
    pub(crate) anchor_a: Vec2,
    pub(crate) end: End,
    /// In the frame of `a`; of length 1.
    pub(crate) axis: Vec2,
    /// Angle of `b` from `a` when the joint was added, rad.
    pub(crate) reference: f64,
    /// Length of a distance joint, or of the rope of a pulley, m; where a gear began, rad.
    pub(crate) length: f64,
    pub(crate) state: JointState,
    /// The next joint of `a` and of `b`.
    next: [u32; 2],
}

impl JointRecord {
    /// The slots of its bodies; `NONE` for the world.
    pub(crate) fn slots(&self) -> [u32; 2] {
        match self.end {
            End::Body(slot_b, _) => [self.slot_a, slot_b],
            End::World(_) => [self.slot_a, NONE],
        }
    }

    /// Whether it acts, and on a body that is awake.
    pub(crate) fn moves_one_that_is_awake(&self, bodies: &Bodies) -> bool {
        let is_moved = |slot: u32| slot != NONE && bodies.is_dynamic(slot) && bodies.is_awake(slot);
        self.description.enabled && self.slots().into_iter().any(is_moved)
    }

    /// The other body of the joint; `NONE` for the world.
    pub(crate) fn other(&self, slot: u32) -> u32 {
        let [a, b] = self.slots();
        if slot == a { b } else { a }
    }

    /// The angle of `b` from `a` since the joint was added, rad; of any number of turns.
    pub(crate) fn angle(&self) -> f64 {
        self.state.angles[1] - self.state.angles[0] - self.reference
    }

    /// Whether it bore more in the last step, on average, than it can.
    pub(crate) fn bears_too_much(&self) -> bool {
        let is_too_much =
            |[force, torque]: [f32; 2]| self.state.force.length() > force || self.state.torque.abs() > torque;
        self.description.breaks_at.is_some_and(is_too_much)
    }

    /// Lets a ratchet fall into the last tooth that it has passed.
    pub(crate) fn pass_teeth(&mut self) {
        if self.description.kind == JointKind::Ratchet {
            let tooth = self.description.ratio;
            // A millionth of a tooth less than none is none: rounding must not lose one.
            self.state.tooth = self.state.tooth.max(((self.angle() / tooth + 1e-6).floor()) * tooth);
        }
    }

    /// Whether it keeps the two bodies from touching.
    fn parts(&self, [a, b]: [u32; 2]) -> bool {
        !self.description.collide_connected && (self.slots() == [a, b] || self.slots() == [b, a])
    }

    /// Where its anchors are, m.
    pub(crate) fn anchors(&self, bodies: &Bodies) -> [Point; 2] {
        let place = |slot: u32, anchor| bodies.motions[slot as usize].pose.to_world(anchor);
        let b = match self.end {
            End::Body(slot, anchor) => place(slot, anchor),
            End::World(point) => point,
        };
        [place(self.slot_a, self.anchor_a), b]
    }

    /// How much of the rope of a pulley is in use, m: from a to its wheel, and the ratio times that from b to its own.
    pub(crate) fn rope(&self, bodies: &Bodies) -> Option<f64> {
        let ([a, b], [wheel_a, wheel_b]) = (self.anchors(bodies), self.description.wheels?);
        Some(wheel_a.distance(a) + self.description.ratio * wheel_b.distance(b))
    }
}

/// All joints of a world, each in the lists of its bodies.
#[derive(Debug, Default)]
pub(crate) struct Joints {
    pub(crate) all: Slots<JointRecord>,
    /// By slot of a body, its first joint; shorter where no later slot ever had one.
    heads: Vec<u32>,
}

clone_into_buffers!(Joints { all, heads });

/// How finely the bodies of a joint are moved within a substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pace {
    /// Longest step, s; infinite where whole substeps do.
    pub(crate) step: f64,
    /// For how long twice that would have done, s.
    pub(crate) calm: f64,
}

impl Default for Pace {
    fn default() -> Self {
        Self { step: f64::INFINITY, calm: 0.0 }
    }
}

impl Joints {
    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.all.len()
    }

    /// Those that act on a body that is awake.
    pub(crate) fn awake(&self, bodies: &Bodies) -> impl Iterator<Item = &JointRecord> {
        self.all.iter().map(|(_, record)| record).filter(|record| record.moves_one_that_is_awake(bodies))
    }

    /// Gives up room that is not needed for so many slots.
    pub(crate) fn trim(&mut self, slots: usize) {
        self.all.trim();
        self.heads.truncate(slots);
    }

    /// Adds a joint whose description was validated, between bodies that are there.
    pub(crate) fn insert(&mut self, description: Joint, bodies: &Bodies) -> JointId {
        let (slot_a, slot_b) = (description.a.0.index(), description.b.map(|b| b.0.index()));
        let pose_a = bodies.motions[slot_a as usize].pose;
        let pose_b = slot_b.map(|slot| bodies.motions[slot as usize].pose);
        let end_at = |place: Point| match (slot_b, pose_b) {
            (Some(slot), Some(pose)) => End::Body(slot, pose.to_local(place)),
            _ => End::World(place),
        };
        let (anchor_a, end) = match description.anchors {
            Anchors::Centers => {
                let end = pose_b.map_or(pose_a.center, |pose| pose.center);
                let is_common =
                    !matches!(description.kind, JointKind::Distance | JointKind::Gear | JointKind::Pulley);
                (if is_common { pose_a.to_local(end) } else { Vec2::ZERO }, end_at(end))
            }
            Anchors::At(place) => (pose_a.to_local(place), end_at(place)),
            Anchors::Local(a, b) => (a, slot_b.map_or(End::World(b), |slot| End::Body(slot, b.to_vec2()))),
            Anchors::Between(a, b) => (pose_a.to_local(a), end_at(b)),
        };
        let usual =
            if description.kind == JointKind::Wheel { Vec2::new(0.0, 1.0) } else { Vec2::new(1.0, 0.0) };
        let axis = description.axis.unwrap_or(usual).direction().unwrap_or(usual);
        let angles = [pose_a.rotation, pose_b.map_or(Rot::IDENTITY, |pose| pose.rotation)]
            .map(|rotation| atan2_f64(f64::from(rotation.s), f64::from(rotation.c)));
        let mut record = JointRecord {
            slot_a,
            anchor_a,
            end,
            axis: pose_a.rotation.unrotate(axis),
            reference: angles[1] - angles[0],
            length: 0.0,
            state: JointState { angles, ..JointState::default() },
            next: [NONE; 2],
            description,
        };
        let [place_a, place_b] = record.anchors(bodies);
        record.length = record.description.length.map_or(place_a.distance(place_b), f64::from);
        if std::mem::take(&mut record.description.is_as_long_as_now) && record.description.limits.is_none() {
            // Between anchors in one place it is as short as a rope can be.
            record.description.limits = Some([0.0, record.length.max(SHORTEST)]);
        }
        if record.description.kind == JointKind::Gear {
            // Base angles are those of a, and of b but for the reference.
            record.length = angles[0] + record.description.ratio * angles[0];
        }
        if record.description.length.is_none()
            && let Some(rope) = record.rope(bodies)
        {
            record.length = rope.max(SHORTEST);
        }
        if record.description.kind == JointKind::Drag {
            record.end = End::World(record.description.target.unwrap_or(place_b));
        }
        self.link(record)
    }

    /// Puts a joint into the lists of its bodies.
    fn link(&mut self, record: JointRecord) -> JointId {
        let slots = record.slots();
        let key = self.all.insert(record);
        for (side, slot) in slots.into_iter().enumerate().filter(|&(_, slot)| slot != NONE) {
            if self.heads.len() <= slot as usize {
                self.heads.resize(slot as usize + 1, NONE);
            }
            let head = std::mem::replace(&mut self.heads[slot as usize], key.index());
            self.all[key.index()].next[side] = head;
        }
        JointId(key)
    }

    /// Takes a joint out.
    pub(crate) fn remove(&mut self, id: JointId) -> Option<JointRecord> {
        let index = id.0.index();
        let slots = self.all.get(id.0)?.slots();
        for slot in slots.into_iter().filter(|&slot| slot != NONE) {
            let after = self.next_of(index, slot);
            let mut at = self.heads[slot as usize];
            if at == index {
                self.heads[slot as usize] = after;
                continue;
            }
            while self.next_of(at, slot) != index {
                at = self.next_of(at, slot);
            }
            let side = usize::from(self.all[at].slot_a != slot);
            self.all[at].next[side] = after;
        }
        self.all.remove(id.0)
    }

    fn next_of(&self, index: u32, slot: u32) -> u32 {
        let record = &self.all[index];
        record.next[usize::from(record.slot_a != slot)]
    }

    /// Indices of the joints of the body in `slot`, latest first.
    pub(crate) fn of_body(&self, slot: u32) -> impl Iterator<Item = u32> {
        let mut index = self.heads.get(slot as usize).copied().unwrap_or(NONE);
        std::iter::from_fn(move || {
            (index != NONE).then(|| {
                let next = self.next_of(index, slot);
                std::mem::replace(&mut index, next)
            })
        })
    }

    /// Whether a joint keeps two bodies from touching.
    #[inline(always)]
    pub(crate) fn part(&self, a: u32, b: u32) -> bool {
        self.len() > 0 && self.of_body(a).any(|index| self.all[index].parts([a, b]))
    }

    /// Whether a joint acts on the body in `slot`.
    pub(crate) fn hold(&self, slot: u32) -> bool {
        self.of_body(slot).any(|index| self.all[index].description.enabled)
    }

    /// Whether a joint holds the body in `slot` to something that nothing moves: a fixed body, the world, or a wheel in it.
    pub(crate) fn holds_to_ground(&self, slot: u32, bodies: &Bodies) -> bool {
        self.of_body(slot).any(|index| {
            let other = self.all[index].other(slot);
            let Joint { enabled, wheels, .. } = &self.all[index].description;
            *enabled && (other == NONE || !bodies.is_dynamic(other) || wheels.is_some())
        })
    }

    /// The bodies that joints which act join to the one in `slot`.
    fn joined_to(&self, slot: u32) -> impl Iterator<Item = u32> {
        let acting = self.of_body(slot).filter(|&index| self.all[index].description.enabled);
        acting.map(move |index| self.all[index].other(slot)).filter(|&other| other != NONE)
    }

    /// Whether a joint leads the body in `slot` by a kinematic body that moves.
    pub(crate) fn is_led(&self, slot: u32, bodies: &Bodies) -> bool {
        self.joined_to(slot).any(|other| !bodies.is_dynamic(other) && bodies.state(other).is_moving())
    }

    /// A body that sleeps, and is joined to the one in `slot`.
    pub(crate) fn sleeping_beside(&self, slot: u32, bodies: &Bodies) -> Option<u32> {
        self.joined_to(slot).find(|&other| bodies.is_dynamic(other) && !bodies.is_awake(other))
    }

    /// The id of the joint with an index.
    pub(crate) fn id_at(&self, index: u32) -> JointId {
        JointId(self.all.key_at(index))
    }

    /// The joints of a body, by their ids.
    pub(crate) fn ids_of(&self, body: BodyId) -> Vec<JointId> {
        let mut ids: Vec<_> = self.of_body(body.0.index()).map(|index| self.id_at(index)).collect();
        ids.sort_unstable();
        ids
    }
}
