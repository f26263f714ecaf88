//! Times of a scene in several engines, and the state they leave it in.

use std::time::Instant;

use rustycs_cases::overlap::{Overlap, overlap};

use super::scenes::Course;
use crate::engine::{DEFAULT, Engine, Simulation, State};
use crate::engines;
use crate::scene::Kind;

/// Parts that a run is timed in: the least of a part over all runs is less disturbed than the least of whole runs.
const PARTS: u32 = 50;

/// How a run ended.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct End {
    pub(super) overlap: Overlap,
    /// Of all dynamic bodies, J.
    pub(super) kinetic_energy: f64,
    /// Kinetic and potential, counted from height 0, as a part of what it was at the start.
    pub(super) energy: f64,
    /// Contact points in the solver.
    pub(super) points: usize,
}

/// What was measured of an engine.
#[derive(Clone, Debug, Default)]
pub(super) struct Measured {
    pub(super) end: End,
    /// Of each run, the seconds that each part took.
    runs: Vec<Vec<f64>>,
}

impl Measured {
    /// Seconds per step: the least of each part over all runs, summed, and the middle one of whole runs.
    pub(super) fn step_time(&self, course: &Course) -> [f64; 2] {
        let least = |part: usize| self.runs.iter().map(|run| run[part]).fold(f64::INFINITY, f64::min);
        let least: f64 = (0..self.runs[0].len()).map(least).sum();
        let mut whole: Vec<f64> = self.runs.iter().map(|run| run.iter().sum()).collect();
        whole.sort_by(f64::total_cmp);
        [least, whole[whole.len() / 2]].map(|seconds| seconds / f64::from(course.ticks))
    }
}

/// A world that is run along a course.
struct Run<'a> {
    course: &'a Course,
    simulation: Box<dyn Simulation>,
    ticks: u32,
    /// Kinematic bodies.
    parts: Vec<usize>,
}

impl<'a> Run<'a> {
    fn new(course: &'a Course, engine: &dyn Engine) -> Self {
        let bodies = course.scene.bodies.iter().enumerate();
        let parts = bodies.filter(|(_, body)| body.kind == Kind::Kinematic).map(|(index, _)| index).collect();
        Self { course, simulation: engine.simulate(&course.scene, DEFAULT), ticks: 0, parts }
    }

    fn tick(&mut self) {
        self.ticks += 1;
        if let Some(drum) = &self.course.drum {
            let seconds = f64::from(self.ticks) / DEFAULT.tick_rate;
            for &part in &self.parts {
                let next = drum.place(self.course.scene.bodies[part].position, seconds);
                let now = self.simulation.state(part).position;
                let velocity = [0, 1].map(|axis| (next[axis] - now[axis]) * DEFAULT.tick_rate);
                self.simulation.set_velocity(part, velocity);
            }
        }
        self.simulation.step();
    }

    /// Kinetic energy, and potential energy from height 0, J.
    fn energy(&self) -> [f64; 2] {
        let mut energy = [0.0; 2];
        for (index, body) in self.course.scene.bodies.iter().enumerate() {
            if body.kind != Kind::Dynamic {
                continue;
            }
            let (mass, state) = (self.simulation.mass(index), self.simulation.state(index));
            energy[0] += state.kinetic_energy(mass);
            energy[1] -= mass[0] * self.course.scene.gravity[1] * state.position[1];
        }
        energy
    }

    fn end(&self, start: [f64; 2]) -> End {
        let [kinetic, potential] = self.energy();
        let bodies = &self.course.scene.bodies;
        let states: Vec<State> = (0..bodies.len()).map(|body| self.simulation.state(body)).collect();
        End {
            overlap: overlap(bodies, &states),
            kinetic_energy: kinetic,
            energy: (kinetic + potential) / (start[0] + start[1]),
            points: self.simulation.contact_points(),
        }
    }
}

/// Seconds that each stage of rustycs takes in a run, by name.
pub(super) fn stages(course: &Course) -> Vec<(&'static str, f64)> {
    let mut run = Run::new(course, engines::with_clock().as_ref());
    (0..course.warm_up).for_each(|_| run.tick());
    let mut all: Vec<(&'static str, f64)> = Vec::new();
    for _ in 0..course.ticks {
        run.tick();
        let stages = run.simulation.stages();
        all.resize(stages.len(), ("", 0.0));
        for (sum, (name, seconds)) in all.iter_mut().zip(stages) {
            *sum = (name, sum.1 + seconds);
        }
    }
    all
}

/// Runs the scene in all engines in turn, so often. `None` if it was stopped.
pub(super) fn measure(
    course: &Course,
    engines: &[&dyn Engine],
    repeats: u32,
    is_stopped: &dyn Fn() -> bool,
) -> Option<Vec<Measured>> {
    let mut all = vec![Measured::default(); engines.len()];
    for _ in 0..repeats {
        for (measured, &engine) in all.iter_mut().zip(engines) {
            let mut run = Run::new(course, engine);
            let start = run.energy();
            (0..course.warm_up).for_each(|_| run.tick());
            let mut parts = Vec::new();
            for part in 0..PARTS {
                let ticks = course.ticks * (part + 1) / PARTS - course.ticks * part / PARTS;
                let clock = Instant::now();
                (0..ticks).for_each(|_| run.tick());
                parts.push(clock.elapsed().as_secs_f64());
                if is_stopped() {
                    return None;
                }
            }
            if measured.runs.is_empty() {
                measured.end = run.end(start);
            }
            measured.runs.push(parts);
        }
    }
    Some(all)
}
