//! What a scene writes on a body: its label, and which part of a machine it is.
//!
//! It stands in the body's user data, so it is cloned, rewound and removed with the body.

use rustycs::{Body, BodyRef};

/// Name to show beside a body, and the colour to paint it in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Label {
    /// `None` for bodies that have a colour only.
    pub(crate) text: Option<&'static str>,
    /// Red, green, blue; `None` where any colour will do.
    pub(crate) colour: Option<[u8; 3]>,
}

impl Label {
    /// A name, in any colour.
    pub(crate) const fn text(text: &'static str) -> Self {
        Self { text: Some(text), colour: None }
    }

    /// A name in a colour: red, green, blue.
    pub(crate) const fn painted(text: &'static str, colour: [u8; 3]) -> Self {
        Self { text: Some(text), colour: Some(colour) }
    }
}

/// What a scene writes on a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Mark {
    /// Place in the scene's table of labels.
    pub(crate) label: Option<usize>,
    /// Which part of a steered machine it is.
    pub(crate) part: Option<usize>,
}

impl Mark {
    /// A body with this label.
    pub(crate) fn label(label: usize) -> Self {
        Self { label: Some(label), part: None }
    }

    /// A body that is this part of a machine.
    pub(crate) fn part(part: usize) -> Self {
        Self { label: None, part: Some(part) }
    }

    /// The mark of a body; nothing for bodies without one.
    pub(crate) fn of(body: BodyRef<'_>) -> Self {
        // Each half is 0 for nothing, else one more than the number.
        let half = |shift: u32| ((body.user_data() >> shift) as u32 as usize).checked_sub(1);
        Self { label: half(0), part: half(32) }
    }

    /// The body with this mark.
    pub(crate) fn on(self, body: Body) -> Body {
        let half = |number: Option<usize>| number.map_or(0, |number| number as u64 + 1);
        body.user_data(half(self.label) | half(self.part) << 32)
    }
}
