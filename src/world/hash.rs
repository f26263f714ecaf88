//! The state of a world as one number.

use crate::body::{Filter, Role};
use crate::math::Vec2;
use crate::world::World;

impl World {
    /// A hash over the id, pose and velocity of every body, and over filters, surface speeds, one-way floors, sensors, what these
    /// overlap, and pairs that do not collide, where there are some. Two worlds with the same past have the same hash, on every
    /// machine and build; it changes when any bit of these does. Joints and their motors are not in it.
    pub fn state_hash(&self) -> u64 {
        let mut hash = Fnv::new();
        for key in self.bodies.ids().map(|id| id.0) {
            let (motion, state) =
                (&self.bodies.motions[key.index() as usize], self.bodies.state(key.index()));
            let pose = motion.pose;
            hash.write(key.to_bits());
            hash.write(pose.center.x.to_bits());
            hash.write(pose.center.y.to_bits());
            for value in
                [pose.rotation.c, pose.rotation.s, state.velocity.x, state.velocity.y, state.angular_velocity]
            {
                hash.write(u64::from(value.to_bits()));
            }
            for collider in self.bodies.colliders(key.index()) {
                let role = self.bodies.roles.of(collider);
                if role != Role::default() {
                    hash.write_role(role);
                }
            }
        }
        for (a, b) in self.bodies.roles.parted() {
            hash.write(u64::from(a) << 32 | u64::from(b));
        }
        for (_, sensor, body) in self.sensors.overlaps() {
            hash.write(sensor.0.to_bits());
            hash.write(body.0.to_bits());
        }
        hash.0
    }
}

/// FNV-1a, 64 bits, a word at a time (Fowler, Noll, Vo).
struct Fnv(u64);

impl Fnv {
    fn new() -> Self {
        Self(0xCBF2_9CE4_8422_2325)
    }

    fn write_role(&mut self, role: Role) {
        let Role { filter, is_sensor, surface_speed, rolling_resistance, .. } = role;
        let Filter { category, mask, group } = filter;
        for word in [category, mask, group as u64, u64::from(is_sensor), u64::from(surface_speed.to_bits())] {
            self.write(word);
        }
        if let Some(coefficient) = rolling_resistance {
            self.write(u64::from(coefficient.to_bits()));
        }
        for (number, mix) in (1..).zip([role.friction_mix, role.restitution_mix]) {
            if let Some(mix) = mix {
                self.write(number << 8 | u64::from(mix.strength()));
            }
        }
        if let Some(Vec2 { x, y }) = role.one_way {
            self.write(u64::from(x.to_bits()) << 32 | u64::from(y.to_bits()));
        }
    }

    fn write(&mut self, word: u64) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3);
        }
    }
}
