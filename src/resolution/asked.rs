//! Which contacts somebody asks about: what their impulses add up to over a step.

use crate::collision::Contact;

/// Whose impulses are added up over a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Asked {
    /// Slowest approach, m/s.
    from: f32,
    /// Whether contacts that touch already are asked about.
    touching: bool,
}

impl Asked {
    /// All contacts.
    pub(crate) const ALL: Self = Self { from: f32::NEG_INFINITY, touching: true };

    /// Those of bodies that may meet, at this speed or faster, m/s.
    pub(crate) fn meeting_from(speed: f32) -> Self {
        Self { from: speed, touching: false }
    }

    /// Whether a contact is asked about, as a step begins. Most are told by their speed.
    #[inline(always)]
    pub(crate) fn about(self, contact: &Contact) -> bool {
        contact.approach_speed >= self.from && (self.touching || !contact.is_touching)
    }
}
