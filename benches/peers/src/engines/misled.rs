//! An engine that does something else than it is asked for, to see whether anybody notices.

use crate::engine::{Engine, Fineness, Simulation};
use crate::scene::Scene;

/// An engine that is handed another scene, or another fineness, than it was asked for.
pub(crate) struct Misled<F> {
    pub(crate) engine: Box<dyn Engine>,
    pub(crate) mislead: F,
}

impl<F: Fn(&mut Scene, &mut Fineness)> Engine for Misled<F> {
    fn name(&self) -> &'static str {
        self.engine.name()
    }

    fn version(&self) -> String {
        self.engine.version()
    }

    fn simulate(&self, scene: &Scene, fineness: Fineness) -> Box<dyn Simulation> {
        let (mut scene, mut fineness) = (scene.clone(), fineness);
        (self.mislead)(&mut scene, &mut fineness);
        self.engine.simulate(&scene, fineness)
    }
}
