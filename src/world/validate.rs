//! Checks that all tables of a world agree with each other: for tests.

use crate::body::{BodyType, Forcing, Motion, NONE};
use crate::compute::{BodyState, GROUND_ROW};
use crate::math::Vec2;
use crate::world::World;

impl World {
    /// Checks that all tables agree and every number is finite. Slow; for tests.
    ///
    /// # Errors
    /// A sentence that names the first disagreement found.
    pub fn validate(&self) -> Result<(), String> {
        self.validate_bodies()?;
        self.validate_forces()?;
        self.validate_contacts()?;
        self.graph.validate(&self.contacts, &self.bodies)?;
        self.broad_phase.validate()
    }

    fn validate_bodies(&self) -> Result<(), String> {
        let bodies = &self.bodies;
        let ground = &bodies.states[GROUND_ROW as usize];
        if ground.is_moving() {
            return Err("the ground moves".into());
        }
        let mut rows = 1;
        for id in bodies.ids() {
            let slot = id.0.index();
            let record = &bodies.records[slot];
            let motion = &bodies.motions[slot as usize];
            let state = bodies.state(slot);
            let is_finite = motion.pose.center.is_finite()
                && motion.pose.rotation.c.is_finite()
                && motion.pose.rotation.s.is_finite()
                && state.velocity.to_vec2().is_finite()
                && state.angular_velocity.is_finite();
            if !is_finite {
                return Err(format!("body {slot} has a number that is not finite: {motion:?} {state:?}"));
            }
            let should_have_row = record.body_type != BodyType::Fixed && record.sleep_group == NONE;
            if should_have_row != (motion.row != GROUND_ROW) {
                return Err(format!("body {slot} is {:?} but has row {}", record.body_type, motion.row));
            }
            if should_have_row {
                rows += 1;
                if bodies.slot_of_row(motion.row as usize) != slot {
                    return Err(format!("row {} is not of body {slot}", motion.row));
                }
            }
            let at_rest = BodyState::REST.delta_position;
            if state.delta_position.to_vec2() != at_rest.to_vec2() {
                return Err(format!("body {slot} has motion that was not added to its pose"));
            }
            for collider in bodies.colliders(slot) {
                self.validate_shape(collider, slot)?;
            }
        }
        if rows != bodies.row_count() || rows != bodies.previous.len() {
            return Err(format!(
                "{} rows and {} poses for {rows}",
                bodies.row_count(),
                bodies.previous.len()
            ));
        }
        if bodies.states[rows..].iter().any(BodyState::is_moving) {
            return Err("a row that is no body's moves".to_owned());
        }
        Ok(())
    }

    /// What the shape in a slot knows of the body in another must be so.
    fn validate_shape(&self, collider: u32, slot: u32) -> Result<(), String> {
        let bodies = &self.bodies;
        let [of_shape, of_body] = [collider, slot].map(|slot| &bodies.motions[slot as usize]);
        let known = |motion: &Motion| (motion.row, motion.inverse_mass, motion.inverse_inertia);
        if bodies.body_of(collider) != slot || known(of_shape) != known(of_body) {
            return Err(format!("shape {collider} does not know its body {slot}"));
        }
        if of_shape.pose != bodies.pose_in(collider, of_body.pose) {
            return Err(format!("shape {collider} is not where its body {slot} is"));
        }
        if !self.broad_phase.fat_aabb(collider).contains(bodies.aabb(collider)) {
            return Err(format!("the box of shape {collider} does not hold it"));
        }
        Ok(())
    }

    /// A force that no list knows of would not be that of a frame, and one on what does not move would wait for ever.
    fn validate_forces(&self) -> Result<(), String> {
        for id in self.bodies.ids() {
            let key = id.0;
            let Forcing { force, torque, .. } = self.bodies.forcings[key.index() as usize];
            let is_none = force == Vec2::ZERO && torque == 0.0;
            let is_known = || self.forced.iter().any(|forced| forced.body.0 == key);
            let can_act = self.bodies.is_dynamic(key.index()) && self.bodies.is_awake(key.index());
            if !(is_none || can_act && is_known() && force.is_finite() && torque.is_finite()) {
                return Err(format!("{force:?} and {torque} N m wait for body {}", key.index()));
            }
        }
        Ok(())
    }

    fn validate_contacts(&self) -> Result<(), String> {
        let mut links = 0;
        for id in self.bodies.ids() {
            links += self.contacts.of_body(&self.bodies, id.0.index()).count();
        }
        if links != 2 * self.contacts.len() {
            return Err(format!("{} contacts are in {links} lists of bodies", self.contacts.len()));
        }
        for (a, b) in self.candidates.iter() {
            if !self.bodies.is_awake(a) && !self.bodies.is_awake(b) {
                return Err(format!("neither {a} nor {b} is awake, but they are watched"));
            }
            if !self.bodies.may_collide(a, b) {
                return Err(format!("{a} and {b} do not collide, but are watched"));
            }
            if self.contacts.between(&self.bodies, [a, b]).is_some() {
                return Err(format!("{a} and {b} are out of reach and have a contact"));
            }
        }
        for (index, contact) in self.contacts.iter() {
            let [a, b] = contact.slots;
            if self.bodies.bodies_of(contact.colliders) != contact.slots {
                return Err(format!("contact {index} does not know whose shapes touch"));
            }
            if !self.bodies.may_collide(contact.colliders[0], contact.colliders[1]) {
                return Err(format!("{a} and {b} do not collide, but have a contact"));
            }
            let is_awake = self.bodies.is_awake(a) || self.bodies.is_awake(b);
            if is_awake != self.contacts.awake().contains(&index) {
                return Err(format!(
                    "contact {index} of {a} and {b}: awake is {is_awake}, its list disagrees"
                ));
            }
            let sleeps = [a, b].iter().any(|&slot| self.bodies.records[slot].sleep_group != NONE);
            if self.graph.home(index).is_some() && sleeps {
                return Err(format!("contact {index} is solved although {a} or {b} sleeps"));
            }
            let is_finite = contact.manifold.normal.is_finite()
                && contact.manifold.points().iter().all(|point| {
                    point.separation.is_finite()
                        && point.normal_impulse.is_finite()
                        && point.tangent_impulse.is_finite()
                        && point.lasting_impulse.is_finite()
                });
            if !is_finite {
                return Err(format!("contact {index} has a number that is not finite: {contact:?}"));
            }
        }
        Ok(())
    }
}
