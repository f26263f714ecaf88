//! The rules of surfaces for how they mix, read and changed.

use crate::body::Mix;
use crate::world::{BodyMut, BodyRef, ColliderMut, ColliderRef};

impl BodyRef<'_> {
    /// [Rule of its own](crate::Body::friction_mix) by which its friction mixes, if it has one; of its own shape.
    pub fn friction_mix(&self) -> Option<Mix> {
        self.role().friction_mix
    }

    /// The same of its restitution.
    pub fn restitution_mix(&self) -> Option<Mix> {
        self.role().restitution_mix
    }
}

impl BodyMut<'_> {
    /// Gives the body, with all its shapes, a [rule](crate::Body::friction_mix) by which its friction mixes, or, by `None`, that of the
    /// settings. The body and what it touches wake.
    pub fn set_friction_mix(&mut self, mix: impl Into<Option<Mix>>) -> &mut Self {
        self.all_shapes().set_friction_mix(mix);
        self
    }

    /// The same of its restitution.
    pub fn set_restitution_mix(&mut self, mix: impl Into<Option<Mix>>) -> &mut Self {
        self.all_shapes().set_restitution_mix(mix);
        self
    }
}

impl ColliderRef<'_> {
    /// [Rule of its own](crate::Body::friction_mix) by which its friction mixes, or that of its body, if they have one.
    pub fn friction_mix(&self) -> Option<Mix> {
        self.role().friction_mix
    }

    /// The same of its restitution.
    pub fn restitution_mix(&self) -> Option<Mix> {
        self.role().restitution_mix
    }
}

impl ColliderMut<'_> {
    /// Gives it a [rule](crate::Body::friction_mix) by which its friction mixes, or, by `None`, that of the settings. Its body and what
    /// that touches wake.
    pub fn set_friction_mix(&mut self, mix: impl Into<Option<Mix>>) -> &mut Self {
        let mix = mix.into();
        if self.change_role(|role| role.friction_mix = mix) {
            self.surface_changed();
        }
        self
    }

    /// The same of its restitution.
    pub fn set_restitution_mix(&mut self, mix: impl Into<Option<Mix>>) -> &mut Self {
        let mix = mix.into();
        if self.change_role(|role| role.restitution_mix = mix) {
            self.surface_changed();
        }
        self
    }
}
