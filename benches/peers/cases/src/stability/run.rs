//! A run of a scene, and what can be read off it.

use std::cell::Cell;
use std::rc::Rc;
use std::time::{Duration, Instant};

use crate::engine::{DEFAULT, Engine, Fineness, Simulation, State};
use crate::overlap::overlap;
use crate::scene::{Kind, Scene};

/// A scene as it stood at some time.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// The bodies as they were at first.
    pub scene: Scene,
    /// Where they are now.
    pub states: Vec<State>,
}

/// Time spent in steps, and their number.
#[derive(Debug, Default)]
struct Stopwatch {
    steps: Cell<u64>,
    spent: Cell<Duration>,
}

impl Stopwatch {
    fn time(&self, step: impl FnOnce()) {
        let begun = Instant::now();
        step();
        self.spent.set(self.spent.get() + begun.elapsed());
        self.steps.set(self.steps.get() + 1);
    }
}

/// Where a case is played: an engine, a clock, and a camera.
pub struct Lab<'a> {
    engine: &'a dyn Engine,
    is_ours: bool,
    stopwatch: Rc<Stopwatch>,
    is_refused: bool,
    picture: Option<Snapshot>,
}

impl core::fmt::Debug for Lab<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Lab").field("engine", &self.engine.name()).finish_non_exhaustive()
    }
}

impl<'a> Lab<'a> {
    /// A lab for an engine.
    #[must_use]
    pub fn new(engine: &'a dyn Engine) -> Self {
        let is_ours = engine.name() == crate::Rustycs::default().name();
        Self { engine, is_ours, stopwatch: Rc::default(), is_refused: false, picture: None }
    }

    pub(super) fn is_ours(&self) -> bool {
        self.is_ours
    }

    /// A run at default settings.
    pub(super) fn run(&mut self, scene: &Scene) -> Run {
        self.run_at(scene, DEFAULT)
    }

    /// A run at other settings.
    pub(super) fn run_at(&mut self, scene: &Scene, fineness: Fineness) -> Run {
        // Stays true if the engine panics over one of the bodies.
        self.is_refused = true;
        let simulation = self.engine.simulate(scene, fineness);
        self.is_refused = false;
        let masses = (0..scene.bodies.len()).map(|body| simulation.mass(body)).collect();
        let bodies = scene.bodies.iter().enumerate();
        let moving = bodies.filter(|(_, spec)| spec.kind == Kind::Dynamic).map(|(index, _)| index).collect();
        Run {
            simulation,
            scene: scene.clone(),
            masses,
            moving,
            ticks: 0,
            tick_rate: fineness.tick_rate,
            stopwatch: Rc::clone(&self.stopwatch),
        }
    }

    /// Takes a step of a world that is not a [`Run`].
    pub(super) fn step(&mut self, step: impl FnOnce()) {
        self.stopwatch.time(step);
    }

    /// Keeps how a run stands now, to be seen.
    pub(super) fn picture(&mut self, run: &Run) {
        self.picture = Some(Snapshot { scene: run.scene.clone(), states: run.states() });
    }

    /// What is to be seen, if anything is.
    #[must_use]
    pub fn seen(&self) -> Option<&Snapshot> {
        self.picture.as_ref()
    }

    /// Whether the engine would not take the last scene.
    #[must_use]
    pub fn is_refused(&self) -> bool {
        self.is_refused
    }

    /// Mean time of a step, s; none if no step was taken.
    #[must_use]
    pub fn step_seconds(&self) -> Option<f64> {
        let steps = self.stopwatch.steps.get();
        (steps > 0).then(|| self.stopwatch.spent.get().as_secs_f64() / steps as f64)
    }
}

/// A run of a scene, tick by tick.
pub struct Run {
    simulation: Box<dyn Simulation>,
    scene: Scene,
    /// Mass and moment of inertia of each body.
    masses: Vec<[f64; 2]>,
    /// Which bodies are dynamic.
    moving: Vec<usize>,
    ticks: u64,
    tick_rate: f64,
    stopwatch: Rc<Stopwatch>,
}

impl core::fmt::Debug for Run {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Run").field("ticks", &self.ticks).finish_non_exhaustive()
    }
}

/// The larger of two numbers; no number if one of them is none.
pub(super) fn worse(one: f64, other: f64) -> f64 {
    if one.is_nan() || other.is_nan() { f64::NAN } else { one.max(other) }
}

impl Run {
    pub(super) fn tick(&mut self) {
        self.stopwatch.time(|| self.simulation.step());
        self.ticks += 1;
    }

    /// Runs until this time since the start, s.
    pub(super) fn until(&mut self, seconds: f64) {
        while self.time() < seconds - 0.5 / self.tick_rate {
            self.tick();
        }
    }

    /// Runs until this time since the start, s, and returns the largest of a number after each tick.
    pub(super) fn largest(&mut self, seconds: f64, of: impl Fn(&Self) -> f64) -> f64 {
        let mut largest = f64::NEG_INFINITY;
        while self.time() < seconds - 0.5 / self.tick_rate {
            self.tick();
            largest = worse(largest, of(self));
        }
        largest
    }

    /// Simulated time, s.
    pub(super) fn time(&self) -> f64 {
        self.ticks as f64 / self.tick_rate
    }

    /// Indices of the dynamic bodies.
    pub(super) fn moving(&self) -> &[usize] {
        &self.moving
    }

    /// The state of a body by its index in the scene.
    pub(super) fn state(&self, body: usize) -> State {
        self.simulation.state(body)
    }

    pub(super) fn states(&self) -> Vec<State> {
        (0..self.scene.bodies.len()).map(|body| self.state(body)).collect()
    }

    pub(super) fn set_velocity(&mut self, body: usize, velocity: [f64; 2]) {
        self.simulation.set_velocity(body, velocity);
    }

    /// The largest of a number over all dynamic bodies.
    pub(super) fn most(&self, of: impl Fn(usize, State) -> f64) -> f64 {
        self.moving.iter().map(|&body| of(body, self.state(body))).fold(f64::NEG_INFINITY, worse)
    }

    /// From where a body was set to where it is, m.
    pub(super) fn shift(&self, body: usize) -> [f64; 2] {
        let (now, then) = (self.state(body).position, self.scene.bodies[body].position);
        [now[0] - then[0], now[1] - then[1]]
    }

    /// Speed of the fastest point of all dynamic bodies at most, m/s: that of the centre, and of the rim about it.
    pub(super) fn fastest(&self) -> f64 {
        self.most(|body, State { velocity: [u, v], spin, .. }| {
            u.hypot(v) + spin.abs() * self.scene.bodies[body].outline.reach()
        })
    }

    /// Mass of all dynamic bodies, kg.
    pub(super) fn mass(&self) -> f64 {
        self.moving.iter().map(|&body| self.masses[body][0]).sum()
    }

    /// Mass of a body, kg.
    pub(super) fn mass_of(&self, body: usize) -> f64 {
        self.masses[body][0]
    }

    /// Of all dynamic bodies, J.
    pub(super) fn kinetic_energy(&self) -> f64 {
        self.moving.iter().map(|&body| self.state(body).kinetic_energy(self.masses[body])).sum()
    }

    /// The kinetic energy, and that of height above where the bodies were set: -Σ m g · Δx, J.
    pub(super) fn energy_gained(&self) -> f64 {
        let [gx, gy] = self.scene.gravity;
        let potential = |&body: &usize| {
            let [x, y] = self.shift(body);
            -self.masses[body][0] * (gx * x + gy * y)
        };
        self.kinetic_energy() + self.moving.iter().map(potential).sum::<f64>()
    }

    /// Depth of the deepest overlap of two bodies, one of them dynamic at least, m.
    pub(super) fn deepest_overlap(&self) -> f64 {
        overlap(&self.scene.bodies, &self.states()).deepest
    }

    /// How many dynamic bodies have a number that is none in their state.
    pub(super) fn lost(&self) -> usize {
        let is_finite = |state: State| {
            let State { position: [x, y], angle, velocity: [u, v], spin } = state;
            [x, y, angle, u, v, spin].iter().all(|number| number.is_finite())
        };
        self.moving.iter().filter(|&&body| !is_finite(self.state(body))).count()
    }
}
