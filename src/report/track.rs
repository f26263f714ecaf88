//! One run of a scene, and what is kept of it: where the bodies were at the sample times.

use crate::body::{BodyId, BodyType};
use crate::report::measure::{Invariants, Measure, larger};
use crate::report::watch::Watch;
use crate::world::World;

/// Where a closed form says that a body is. See [`Study::exact`](crate::report::Study::exact).
///
/// ```
/// use rustycs::report::Exact;
///
/// // A wheel of 0.5 m that rolls at 2 m/s, after t seconds.
/// let wheel = |t: f64| Exact::at([2.0 * t, 0.5]).angle(-2.0 * t / 0.5);
/// assert_ne!(wheel(1.0), wheel(2.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exact {
    position: [f64; 2],
    angle: Option<f64>,
}

impl Exact {
    /// A body with its centre of mass here, m, at any angle.
    pub fn at(position: [f64; 2]) -> Self {
        Self { position, angle: None }
    }

    /// The same, at this angle, rad.
    #[must_use]
    pub fn angle(self, angle: f64) -> Self {
        Self { angle: Some(angle), ..self }
    }
}

impl From<[f64; 2]> for Exact {
    fn from(position: [f64; 2]) -> Self {
        Self::at(position)
    }
}

/// A moving body at one moment.
#[derive(Clone, Copy, Debug)]
struct Moment {
    id: BodyId,
    position: [f64; 2],
    velocity: [f64; 2],
    angle: f64,
    spin: f64,
    /// Farthest that a point of it is from its centre, m.
    extent: f64,
}

/// What is kept of a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Track {
    /// Per sample time, every body that is not fixed.
    moments: Vec<Vec<Moment>>,
    /// Per sample time, what the caller's gauge showed.
    quantities: Vec<f64>,
    /// Largest size of what the caller's error gauge showed.
    pub(super) worst: f64,
    pub(super) invariants: Invariants,
    /// Farthest that a body was from where it began, m.
    pub(super) reach: f64,
    /// Substeps that were taken, per simulated second.
    pub(super) substeps: f64,
}

/// How a run goes.
pub(super) struct PredictedMotion<'a, 'm> {
    /// Sample times, s, ascending; the run ends with the last.
    pub(super) times: &'a [f64],
    pub(super) measure: &'a Measure<'m>,
    /// Called before each tick.
    pub(super) drive: Option<&'a dyn Fn(&mut World)>,
}

/// How many ticks a world takes to reach a time, s. A millionth of a tick more or less is rounding.
pub(super) fn ticks_to(time: f64, tick: f64) -> u64 {
    (time / tick - 1e-6).ceil().max(0.0) as u64
}

impl PredictedMotion<'_, '_> {
    /// Ticks of a whole run.
    pub(super) fn ticks(&self, world: &World) -> u64 {
        self.times.last().map_or(0, |&end| ticks_to(end, world.settings().tick_seconds()))
    }

    /// One tick.
    pub(super) fn step(&self, world: &mut World) {
        if let Some(drive) = self.drive {
            drive(world);
        }
        world.step();
    }

    /// Runs the world to the end, and calls `after_tick` with the number of ticks done; stops early, with
    /// nothing, if that says so.
    pub(super) fn run(&self, mut world: World, mut after_tick: impl FnMut(u64) -> bool) -> Option<Track> {
        let tick = world.settings().tick_seconds();
        let (mut track, mut watch) = (Track::default(), Watch::begin(&world));
        let start = moments(&world);
        let mut times = self.times.iter().copied().peekable();
        for done in 1..=self.ticks(&world) {
            let before = moments(&world);
            self.step(&mut world);
            watch.after_tick(&world);
            track.substeps += f64::from(world.profile().counters().substeps);
            if let Some(gauge) = self.measure.error_gauge() {
                track.worst = larger(track.worst, gauge(&world).abs());
            }
            while let Some(time) = times.next_if(|&time| ticks_to(time, tick) <= done) {
                // Part of the tick that had passed at the sample time.
                let part = (time / tick - (done - 1) as f64).clamp(0.0, 1.0);
                let after = moments(&world);
                let between = before.iter().zip(&after).map(|(one, next)| one.toward(next, part, tick));
                track.moments.push(between.collect());
                track.quantities.extend(self.measure.quantity_gauge().map(|gauge| gauge(&world)));
                for (body, first) in after.iter().zip(&start) {
                    track.reach = larger(track.reach, distance(body.position, first.position));
                }
            }
            if !after_tick(done) {
                return None;
            }
        }
        track.invariants = watch.end();
        track.substeps /= self.ticks(&world) as f64 * tick;
        Some(track)
    }
}

/// All bodies that are not fixed.
fn moments(world: &World) -> Vec<Moment> {
    let moves = world.bodies().filter(|(_, body)| body.body_type() != BodyType::Fixed);
    moves
        .map(|(id, body)| Moment {
            id,
            position: body.position_f64(),
            velocity: [body.velocity().x, body.velocity().y].map(f64::from),
            angle: f64::from(body.angle()),
            spin: f64::from(body.angular_velocity()),
            extent: f64::from(body.shape().extent()),
        })
        .collect()
}

/// How many bodies are not fixed.
pub(super) fn moving_count(world: &World) -> usize {
    world.bodies().filter(|(_, body)| body.body_type() != BodyType::Fixed).count()
}

impl Moment {
    /// Between two ticks, by the cubic through both places and velocities (Hermite): exact for constant
    /// forces, of fourth order otherwise. `part` is the part of the tick that has passed, `tick` its length, s.
    fn toward(&self, next: &Self, part: f64, tick: f64) -> Self {
        if part > 1.0 - 1e-6 {
            return *next;
        }
        let cubic = |x_a: f64, v_a: f64, x_b: f64, v_b: f64| {
            let (u, way) = (part, x_b - x_a);
            x_a + u * tick * v_a
                + u * u * (3.0 * way - tick * (2.0 * v_a + v_b))
                + u * u * u * (tick * (v_a + v_b) - 2.0 * way)
        };
        let position = [0, 1].map(|axis| {
            cubic(self.position[axis], self.velocity[axis], next.position[axis], next.velocity[axis])
        });
        // Angles are known up to whole turns: take the turn that the spin suggests.
        let turn = 0.5 * (self.spin + next.spin) * tick;
        let turns = ((self.angle + turn - next.angle) / core::f64::consts::TAU).round();
        let next_angle = next.angle + turns * core::f64::consts::TAU;
        Self { position, angle: cubic(self.angle, self.spin, next_angle, next.spin), ..*self }
    }

    /// How far a point of the body is at most from where it would be at another place and angle, m.
    fn off_by(&self, position: [f64; 2], angle: f64) -> f64 {
        let turned = 2.0 * (0.5 * (self.angle - angle)).sin().abs();
        distance(self.position, position) + self.extent * turned
    }
}

impl Track {
    /// Whether both ran the same bodies.
    pub(super) fn has_bodies_of(&self, other: &Self) -> bool {
        let ids = |track: &Self| -> Vec<BodyId> {
            track.moments.first().map_or(Vec::new(), |bodies| bodies.iter().map(|body| body.id).collect())
        };
        ids(self) == ids(other)
    }

    /// How far a point of a body is at most from where it is in the other track, m, at any sample time.
    fn distance_from(&self, other: &Self) -> f64 {
        let samples = self.moments.iter().zip(&other.moments);
        samples
            .flat_map(|(one, other)| one.iter().zip(other))
            .map(|(one, other)| one.off_by(other.position, other.angle))
            .fold(0.0, larger)
    }

    /// The body that is farthest from where it is in the other track at the end: its extent and that distance, m.
    pub(super) fn worst_end_from(&self, other: &Self) -> (f64, f64) {
        let end = |track: &Self| track.moments.last().cloned().unwrap_or_default();
        let pairs = end(self).into_iter().zip(end(other));
        pairs
            .map(|(one, other)| (one.extent, one.off_by(other.position, other.angle)))
            .fold((0.0, 0.0), |worst, next| if next.1 >= worst.1 { next } else { worst })
    }

    /// How far the measure is from that of another run.
    pub(super) fn error_against(&self, other: &Self, measure: &Measure<'_>) -> f64 {
        if matches!(measure, Measure::Trajectory) {
            return self.distance_from(other);
        }
        let pairs = self.quantities.iter().zip(&other.quantities);
        pairs.map(|(one, other)| (one - other).abs()).fold(0.0, larger)
    }

    /// How far a point of a body is at most from where the closed form puts it, m. If the closed form gives
    /// another number of bodies than move, that number and theirs.
    pub(super) fn error_against_exact(
        &self,
        times: &[f64],
        exact: &dyn Fn(f64) -> Vec<Exact>,
    ) -> Result<f64, (usize, usize)> {
        let mut worst = 0.0;
        for (bodies, &time) in self.moments.iter().zip(times) {
            let exact = exact(time);
            if exact.len() != bodies.len() {
                return Err((exact.len(), bodies.len()));
            }
            for (body, exact) in bodies.iter().zip(exact) {
                worst = larger(worst, body.off_by(exact.position, exact.angle.unwrap_or(body.angle)));
            }
        }
        Ok(worst)
    }

    /// How far the quantity is from the closed form.
    pub(super) fn error_against_exact_value(&self, times: &[f64], exact: &dyn Fn(f64) -> f64) -> f64 {
        let pairs = self.quantities.iter().zip(times);
        pairs.map(|(value, &time)| (value - exact(time)).abs()).fold(0.0, larger)
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
