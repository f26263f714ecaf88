//! What an engine must be able to do here.

use crate::scene::Scene;

/// How fine a run is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// 1/s.
    pub tick_rate: f64,
    /// Substeps, or what the engine has in their place.
    pub substeps: u32,
}

/// Default settings: 60 Hz and 4 substeps, which all engines have.
pub const DEFAULT: Fineness = Fineness { tick_rate: 60.0, substeps: 4 };

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// Of the centre of mass, m.
    pub position: [f64; 2],
    /// rad, counter-clockwise; whole turns may be missing.
    pub angle: f64,
    /// m/s.
    pub velocity: [f64; 2],
    /// rad/s.
    pub spin: f64,
}

impl State {
    /// m v²/2 + I w²/2 of a body of this mass, kg, and moment of inertia, kg m², in J.
    #[must_use]
    pub fn kinetic_energy(&self, [mass, inertia]: [f64; 2]) -> f64 {
        let [u, v] = self.velocity;
        0.5 * mass * (u * u + v * v) + 0.5 * inertia * self.spin * self.spin
    }
}

/// A world of some engine.
pub trait Simulation {
    /// One tick, on one thread.
    fn step(&mut self);

    /// The state of the body with this index in [`Scene::bodies`].
    fn state(&self, body: usize) -> State;

    /// Gives the body with this index another velocity, m/s.
    fn set_velocity(&mut self, body: usize, velocity: [f64; 2]);

    /// Mass, kg, and moment of inertia about the centre of mass, kg m²; infinite for bodies that are not dynamic.
    fn mass(&self, body: usize) -> [f64; 2];

    /// How many contact points the engine's solver had in the last step, those of bodies that are about to touch
    /// included. Takes a look at every contact.
    fn contact_points(&self) -> usize;

    /// Seconds that the stages of the last step took, by name; empty where the engine does not tell.
    fn stages(&self) -> Vec<(&'static str, f64)> {
        Vec::new()
    }
}

/// A physics engine.
pub trait Engine {
    /// As it is called in tables.
    fn name(&self) -> &'static str;

    /// Its version and how it was built.
    fn version(&self) -> String;

    /// A world of the scene.
    ///
    /// # Panics
    /// If the engine does not take one of the bodies.
    fn simulate(&self, scene: &Scene, fineness: Fineness) -> Box<dyn Simulation>;
}
