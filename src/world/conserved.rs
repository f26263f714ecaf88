//! Energy and momentum of the whole world, summed in `f64`.

use crate::body::{BodyType, Forcing, Motion};
use crate::compute::BodyState;
use crate::math::Vec2;
use crate::world::World;

impl World {
    /// Kinetic plus potential energy of all dynamic bodies, J.
    pub fn energy(&self) -> f64 {
        self.kinetic_energy() + self.potential_energy()
    }

    /// Σ ½ m v² + ½ I w² over all dynamic bodies, J.
    pub fn kinetic_energy(&self) -> f64 {
        self.bodies().map(|(_, body)| body.kinetic_energy()).sum()
    }

    /// Potential energy of all dynamic bodies, J: 0 at the origin for forces, at infinity for global
    /// attractors, at their range for local ones.
    pub fn potential_energy(&self) -> f64 {
        let field = self.field();
        self.dynamic_bodies()
            .map(|Moving { mass, motion, forcing, .. }| {
                mass * field.potential(motion.pose.center, forcing.gravity_scale)
            })
            .sum()
    }

    /// Σ m v over all dynamic bodies, kg m/s.
    pub fn momentum(&self) -> Vec2 {
        let [x, y] = self.dynamic_bodies().fold([0.0, 0.0], |[x, y], Moving { mass, state, .. }| {
            [x + mass * f64::from(state.velocity.x), y + mass * f64::from(state.velocity.y)]
        });
        Vec2::new(x as f32, y as f32)
    }

    /// Σ m x × v + I w over all dynamic bodies, kg m²/s, about the origin.
    pub fn angular_momentum(&self) -> f64 {
        self.dynamic_bodies()
            .map(|Moving { mass, inertia, motion, state, .. }| {
                let (vx, vy) = (f64::from(state.velocity.x), f64::from(state.velocity.y));
                let center = motion.pose.center;
                mass * (center.x * vy - center.y * vx) + inertia * f64::from(state.angular_velocity)
            })
            .sum()
    }

    fn dynamic_bodies(&self) -> impl Iterator<Item = Moving<'_>> {
        let all = self.bodies.ids().map(|id| (id.0.index(), &self.bodies.records[id.0.index()]));
        all.filter(|(_, record)| record.body_type == BodyType::Dynamic).map(|(slot, record)| Moving {
            mass: f64::from(record.mass),
            inertia: f64::from(record.inertia),
            motion: &self.bodies.motions[slot as usize],
            forcing: &self.bodies.forcings[slot as usize],
            state: self.bodies.state(slot),
        })
    }
}

/// What of a dynamic body the sums need.
struct Moving<'a> {
    mass: f64,
    inertia: f64,
    motion: &'a Motion,
    forcing: &'a Forcing,
    state: &'a BodyState,
}
