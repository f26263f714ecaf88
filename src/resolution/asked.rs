//! Which contacts somebody asks about: what their impulses add up to over a step.

use crate::collision::Contact;

/// Whose impulses are added up over a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Asked {
    /// Those of all contacts.
    All,
    /// Those of bodies that may meet, at this speed or faster, m/s.
    MeetingFrom(f32),
}

impl Asked {
    /// Whether a contact is asked about, as a step begins.
    #[inline(always)]
    pub(crate) fn about(self, contact: &Contact) -> bool {
        match self {
            Self::All => true,
            Self::MeetingFrom(speed) => contact.approach_speed >= speed && !contact.is_touching,
        }
    }
}
