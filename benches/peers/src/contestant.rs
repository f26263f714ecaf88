//! An engine in a comparison whose rows hold as long as it moves alike.

use crate::engine::Engine;
use crate::{engines, fingerprint};

/// An engine, and how it behaves.
pub(crate) struct Contestant {
    pub(crate) engine: Box<dyn Engine>,
    /// See [`fingerprint`].
    pub(crate) behaviour: String,
}

impl Contestant {
    pub(crate) fn new(engine: Box<dyn Engine>) -> Self {
        Self { behaviour: fingerprint::of(engine.as_ref()), engine }
    }

    /// All engines, in the order of tables.
    pub(crate) fn all() -> Vec<Self> {
        engines::all().into_iter().map(Self::new).collect()
    }

    /// Whether a row of an engine with this name, version and behaviour is its own.
    pub(crate) fn is_of(&self, name: &str, version: &str, behaviour: &str) -> bool {
        self.engine.name() == name && self.engine.version() == version && self.behaviour == behaviour
    }
}
