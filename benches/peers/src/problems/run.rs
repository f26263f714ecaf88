//! A run of a problem, tick by tick, with its states at hand.

use std::f64::consts::{PI, TAU};

use crate::engine::{Engine, Fineness, Simulation, State};
use crate::problems::Problem;
use crate::scene::Kind;

/// Trajectories are compared this many times per second, 1/s: at the ticks that all rates have in common.
const SAMPLES: f64 = 30.0;

/// Turns are counted of so many dynamic bodies at most.
const WATCHED: usize = 8;

/// A run of a problem. Ends after its duration, or when its error is known.
pub(crate) struct Run {
    simulation: Box<dyn Simulation>,
    /// 1/s.
    tick_rate: f64,
    /// Which bodies of the scene are dynamic.
    moving: Vec<usize>,
    ticks: u64,
    duration: u64,
    /// By how much the first of them have turned since the start, whole turns included, and their angles after the last
    /// tick, rad.
    turns: Vec<[f64; 2]>,
}

impl Run {
    pub(crate) fn new(problem: &Problem, engine: &dyn Engine, fineness: Fineness) -> Self {
        let simulation = engine.simulate(&problem.scene, fineness);
        let bodies = problem.scene.bodies.iter().enumerate();
        let moving: Vec<usize> =
            bodies.filter(|(_, spec)| spec.kind == Kind::Dynamic).map(|(index, _)| index).collect();
        let turns = moving.iter().take(WATCHED).map(|&body| [0.0, simulation.state(body).angle]).collect();
        Self {
            simulation,
            tick_rate: fineness.tick_rate,
            moving,
            ticks: 0,
            duration: ticks(problem, fineness),
            turns,
        }
    }

    /// One tick.
    pub(super) fn tick(&mut self) {
        self.simulation.step();
        self.ticks += 1;
        for ([turned, last], &body) in self.turns.iter_mut().zip(&self.moving) {
            let angle = self.simulation.state(body).angle;
            // The nearest way round: a tick turns by less than half a turn.
            *turned += (angle - *last + PI).rem_euclid(TAU) - PI;
            *last = angle;
        }
    }

    /// Whether the duration of the problem is over.
    pub(super) fn is_over(&self) -> bool {
        self.ticks >= self.duration
    }

    /// Runs to the end of the problem.
    pub(super) fn finish(&mut self) {
        while !self.is_over() {
            self.tick();
        }
    }

    /// Runs to the end of the problem, and returns the largest of a number at the times k/30 s, the end included.
    pub(super) fn largest(&mut self, of: impl Fn(&Self) -> f64) -> f64 {
        let every = (self.tick_rate / SAMPLES).round() as u64;
        let mut largest = 0.0_f64;
        while !self.is_over() {
            self.tick();
            if self.ticks.is_multiple_of(every) {
                let value = of(self);
                // What is no number is as wrong as can be.
                largest = largest.max(if value.is_nan() { f64::INFINITY } else { value });
            }
        }
        largest
    }

    /// Simulated time, s.
    pub(super) fn time(&self) -> f64 {
        self.ticks as f64 / self.tick_rate
    }

    /// How long the problem lasts, s.
    pub(super) fn duration(&self) -> f64 {
        self.duration as f64 / self.tick_rate
    }

    /// Length of a tick, s.
    pub(super) fn tick_seconds(&self) -> f64 {
        1.0 / self.tick_rate
    }

    /// The state of one of the dynamic bodies, counted in the order of the scene.
    pub(super) fn state(&self, moving: usize) -> State {
        self.simulation.state(self.moving[moving])
    }

    /// By how much one of the first dynamic bodies has turned since the start, whole turns included, rad.
    pub(super) fn turned(&self, moving: usize) -> f64 {
        self.turns[moving][0]
    }

    /// Sums over all dynamic bodies.
    pub(super) fn totals(&self) -> Totals {
        let mut totals = Totals::default();
        for &body in &self.moving {
            totals.add(self.simulation.mass(body), self.simulation.state(body));
        }
        totals
    }
}

/// How many ticks a problem lasts.
pub(crate) fn ticks(problem: &Problem, fineness: Fineness) -> u64 {
    (problem.duration * fineness.tick_rate).round() as u64
}

/// What a system keeps when nothing acts on it, and what its changes are measured against.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Totals {
    /// Σ m v, kg m/s.
    pub(super) momentum: [f64; 2],
    /// Σ m |v|, kg m/s.
    pub(super) momentum_size: f64,
    /// Σ m x × v + I w, about the origin, kg m²/s.
    pub(super) angular_momentum: f64,
    /// Σ m |x| |v| + I |w|, kg m²/s.
    pub(super) angular_size: f64,
    /// J.
    pub(super) kinetic_energy: f64,
}

impl Totals {
    fn add(&mut self, [mass, inertia]: [f64; 2], state: State) {
        let State { position: [x, y], velocity: [u, v], spin, .. } = state;
        self.momentum = [self.momentum[0] + mass * u, self.momentum[1] + mass * v];
        self.momentum_size += mass * u.hypot(v);
        self.angular_momentum += mass * (x * v - y * u) + inertia * spin;
        self.angular_size += mass * x.hypot(y) * u.hypot(v) + inertia * spin.abs();
        self.kinetic_energy += state.kinetic_energy([mass, inertia]);
    }
}
