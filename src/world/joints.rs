//! Adding and removing joints.

use crate::body::{BodyId, NONE};
use crate::joint::{Joint, JointError, JointId};
use crate::world::{JointMut, JointRef, World};

impl World {
    /// Adds a joint between two bodies, or a body and the world; wakes them. One of its bodies at least must be dynamic; it may be
    /// [made fixed](crate::BodyMut::set_body_type) later, and the joint acts again once it is dynamic.
    ///
    /// # Errors
    /// [`JointError`], if a body has been removed, both are one, none is dynamic, the kind has no such option, limits are crossed,
    /// or a number is NaN or out of range; the world is as it was.
    pub fn add_joint(&mut self, joint: Joint) -> Result<JointId, JointError> {
        self.validate_joint(&joint)?;
        let mut ends = std::iter::once(joint.a).chain(joint.b);
        if !ends.any(|id| self.bodies.is_dynamic(id.0.index())) {
            return Err(JointError::NoDynamicBody);
        }
        let id = self.joints.insert(joint, &self.bodies);
        self.joint_changed(id, true);
        Ok(id)
    }

    /// Checks a description against the bodies there are.
    pub(in crate::world) fn validate_joint(&self, joint: &Joint) -> Result<(), JointError> {
        let is_there = |id: BodyId| self.bodies.has(id);
        if !is_there(joint.a) {
            return Err(JointError::NoBody { which: "first" });
        }
        if joint.b.is_some_and(|b| !is_there(b)) {
            return Err(JointError::NoBody { which: "second" });
        }
        if joint.b == Some(joint.a) {
            return Err(JointError::SameBody);
        }
        joint.validate()
    }

    /// The joint with this id, or `None` if it has been removed.
    pub fn joint(&self, id: JointId) -> Option<JointRef<'_>> {
        self.joints.all.get(id.0)?;
        Some(JointRef::new(self, id))
    }

    /// The joint with this id, for changing it, or `None` if it has been removed. Changes wake its bodies.
    pub fn joint_mut(&mut self, id: JointId) -> Option<JointMut<'_>> {
        self.joints.all.get(id.0)?;
        Some(JointMut::new(self, id))
    }

    /// Every joint, by ascending place; a removed joint's place is used again.
    pub fn joints(&self) -> impl Iterator<Item = (JointId, JointRef<'_>)> {
        self.joints.all.iter().map(|(key, _)| (JointId(key), JointRef::new(self, JointId(key))))
    }

    /// How many joints there are.
    pub fn joint_count(&self) -> usize {
        self.joints.len()
    }

    /// The joints of a body, by their ids; none if it has been removed.
    pub fn joints_of(&self, body: BodyId) -> Vec<JointId> {
        if self.bodies.has(body) { self.joints.ids_of(body) } else { Vec::new() }
    }

    /// Removes a joint and returns its description, or `None` if it was removed before. Its bodies wake, and touch each other
    /// from the next step on, if they overlap.
    pub fn remove_joint(&mut self, id: JointId) -> Option<Joint> {
        let slots = self.joints.all.get(id.0)?.slots();
        self.wake_ends(slots);
        let removed = self.joints.remove(id)?;
        self.sort_pair_of(slots);
        Some(removed.description)
    }

    /// Removes all joints of a body that is to be removed, and reports them.
    pub(in crate::world) fn remove_joints_of(&mut self, body: BodyId) {
        for id in self.joints.ids_of(body) {
            self.remove_joint(id);
            self.events.joints_removed_by_edit.push(id);
        }
    }

    /// Removes the joints that bore too much in this step, and reports them.
    pub(in crate::world) fn break_joints(&mut self) {
        for place in 0..self.solver.joints.broken().len() {
            let index = self.solver.joints.broken()[place];
            // It may have gone with a body that left the bounds.
            if let Some(record) = self.joints.all.at(index)
                && record.bears_too_much()
            {
                let id = self.joints.id_at(index);
                self.remove_joint(id);
                self.events.broken.push(id);
            }
        }
    }

    /// Takes note that a joint is new or another one, and whether its bodies may touch where they did not, or the reverse.
    pub(in crate::world) fn joint_changed(&mut self, id: JointId, touching_changes: bool) {
        let slots = self.joints.all[id.0.index()].slots();
        self.wake_ends(slots);
        if touching_changes {
            self.sort_pair_of(slots);
        }
    }

    fn wake_ends(&mut self, slots: [u32; 2]) {
        for slot in slots.into_iter().filter(|&slot| slot != NONE) {
            self.wake_slot(slot);
        }
    }

    /// Ends the contact of two bodies that do not touch any more, or has their pair looked for again.
    fn sort_pair_of(&mut self, [a, b]: [u32; 2]) {
        if b == NONE {
            return;
        }
        if !self.joints.part(a, b) {
            // What moves is found by what it meets.
            for slot in [a, b].into_iter().filter(|&slot| self.bodies.is_dynamic(slot)) {
                for collider in self.bodies.colliders(slot) {
                    self.broad_phase.mark_moved(collider);
                }
            }
            return;
        }
        self.end_pairs([a, b]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prelude::{Body, Settings, Shape};
    use crate::testing::Random;

    /// Discs on ratchets in a row, which fall freely. At 0.02 rad in a substep, a step of s times the substep is off by s² 0.02²/2, less than what
    /// is taken from s = 1/2 on; half of that is allowed, as links spin each other up. It takes no shorter ones to find out which ratchets hold.
    #[test]
    fn a_row_of_ratchets_takes_few_steps() {
        let mut random = Random(1);
        for count in [16, 24, 30_u8] {
            let mut world = World::new(Settings::default());
            let mut before = None;
            for number in 0..count {
                let x = f64::from(number);
                let velocity = [(); 2].map(|()| random.between(-3.0, 3.0));
                let disc = Body::dynamic(Shape::circle(0.3)).at([x, 0.0]).velocity(velocity);
                let id = world.add(disc.angular_velocity(random.between(-4.0, 4.0))).unwrap();
                if let Some(before) = before {
                    world.add_joint(Joint::ratchet(before, id, 0.3).at([x - 0.5, 0.0])).unwrap();
                }
                before = Some(id);
            }
            for tick in 0..120 {
                world.step();
                let shortest = world.joints.all.iter().map(|(_, joint)| joint.state.pace.step * 240.0);
                let shortest = shortest.fold(f64::INFINITY, f64::min);
                assert!(shortest >= 0.25, "{count} ratchets, tick {tick}: {shortest} of a substep");
            }
        }
    }
}
