//! Rules of its own for how a surface mixes with those it touches.

use crate::body::role::{Own, rolling_resistance_between};
use crate::body::{Bodies, Body, Collider, Mix, Mixed, Mixes};

impl Mixes {
    /// The coefficients between the shapes in two slots.
    pub(crate) fn of(self, bodies: &Bodies, slots: [u32; 2]) -> Mixed {
        let [a, b] = slots.map(|slot| bodies.records[slot].material);
        let roles = slots.map(|slot| bodies.roles.of(slot));
        let friction = self.friction.of_two(roles.map(|role| role.friction_mix));
        let restitution = self.restitution.of_two(roles.map(|role| role.restitution_mix));
        Mixed {
            friction: friction.mix(a.friction, b.friction),
            restitution: restitution.mix(a.restitution, b.restitution),
            rolling_resistance: rolling_resistance_between(roles),
        }
    }
}

impl Body {
    /// Rule by which its friction mixes with that of others, instead of
    /// [`Settings::friction_mix`](crate::Settings::friction_mix), which is that of all that have none of their own. Of the rules of
    /// two surfaces the [stronger](Mix::stronger) one counts.
    ///
    /// It holds for all its shapes that are not given their own.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// // On ice everything slides, whatever it is made of.
    /// world.add(Body::fixed(Shape::aabb(20.0, 1.0)).friction(0.02).friction_mix(Mix::Min))?;
    /// # Ok::<(), BodyError>(())
    /// ```
    #[must_use]
    pub fn friction_mix(mut self, mix: Mix) -> Self {
        self.role.friction_mix = Some(mix);
        self
    }

    /// The same of its restitution, instead of [`Settings::restitution_mix`](crate::Settings::restitution_mix).
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// // From a trampoline everything bounces.
    /// world.add(Body::fixed(Shape::aabb(4.0, 0.2)).restitution(0.9).restitution_mix(Mix::Max))?;
    /// # Ok::<(), BodyError>(())
    /// ```
    #[must_use]
    pub fn restitution_mix(mut self, mix: Mix) -> Self {
        self.role.restitution_mix = Some(mix);
        self
    }

    /// Rule of its own for friction, if it has one.
    pub fn get_friction_mix(&self) -> Option<Mix> {
        self.role.friction_mix
    }

    /// Rule of its own for restitution, if it has one.
    pub fn get_restitution_mix(&self) -> Option<Mix> {
        self.role.restitution_mix
    }
}

impl Collider {
    /// Rule by which its friction mixes with that of others, as [`Body::friction_mix`] says, instead of that of the body.
    #[must_use]
    pub fn friction_mix(mut self, mix: Mix) -> Self {
        self.role.friction_mix = Own::Set(Some(mix));
        self
    }

    /// The same of its restitution, as [`Body::restitution_mix`] says.
    #[must_use]
    pub fn restitution_mix(mut self, mix: Mix) -> Self {
        self.role.restitution_mix = Own::Set(Some(mix));
        self
    }
}
