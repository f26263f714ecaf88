//! Sliding and sticking.

use rustycs::report::Unit;

use crate::engine::State;
use crate::problems::{Class, G, Problem, Range, block, on_earth, rectangle};
use crate::scene::{BodySpec, Scene};

pub(super) fn problems() -> Vec<Problem> {
    vec![slide(), stick(), slip()]
}

fn slide() -> Problem {
    /// m/s. Several, so that no engine is right by luck, in that its last step ends where the box does.
    const SPEEDS: [f64; 5] = [4.0, 4.5, 5.0, 5.5, 6.0];
    const FRICTION: f64 = 0.4;
    let way = |speed: f64| speed * speed / (2.0 * FRICTION * G);
    let mut bodies = Vec::new();
    // Each on a floor of its own, as places far along a floor have fewer digits.
    let lane = |index: usize| 4.0 * (index as f64 - 2.0);
    for index in 0..SPEEDS.len() {
        bodies.push(BodySpec { position: [0.0, lane(index) - 0.5], friction: FRICTION, ..block(12.0, 1.0) });
    }
    for (index, speed) in SPEEDS.into_iter().enumerate() {
        bodies.push(BodySpec {
            position: [-2.0, lane(index) + 0.25],
            velocity: [speed, 0.0],
            friction: FRICTION,
            ..rectangle(1.0, 0.5)
        });
    }
    Problem {
        name: "slide".into(),
        statement: "Five boxes slide on a floor with µ = 0.4, from 4 to 6 m/s to a stop: s = v²/(2µg)."
            .into(),
        measure: "largest error of a way until the stop / that way",
        unit: Unit::Part,
        class: Class::Smooth,
        scene: on_earth(bodies),
        duration: 2.0,
        error: Box::new(move |run| {
            run.finish();
            let error = |(index, speed)| (run.state(index).position[0] + 2.0) / way(speed) - 1.0;
            SPEEDS.into_iter().enumerate().map(error).map(f64::abs).fold(0.0, f64::max)
        }),
        range: Range::Full,
        goal: None,
        note: "",
    }
}

/// A slope through the origin, which falls to the right, and how far along it a place is.
pub(super) struct Slope {
    /// rad.
    angle: f64,
}

impl Slope {
    pub(super) fn new(degrees: f64) -> Self {
        Self { angle: degrees.to_radians() }
    }

    /// Unit vector down the slope.
    fn down(&self) -> [f64; 2] {
        [self.angle.cos(), -self.angle.sin()]
    }

    /// At this distance along the slope and from its surface, m.
    fn place(&self, along: f64, above: f64) -> [f64; 2] {
        let [x, y] = self.down();
        [along * x - above * y, along * y + above * x]
    }

    /// The body, set upon it at the origin, with its centre this far above the surface, and the slope.
    pub(super) fn scene(&self, body: BodySpec, above: f64) -> Scene {
        let friction = body.friction;
        let body = BodySpec { position: self.place(0.0, above), angle: -self.angle, ..body };
        let ground =
            BodySpec { position: self.place(0.0, -1.0), angle: -self.angle, friction, ..block(40.0, 2.0) };
        on_earth([ground, body])
    }

    /// How far the body has come, m.
    pub(super) fn way(&self, state: State) -> f64 {
        let [x, y] = self.down();
        state.position[0] * x + state.position[1] * y
    }

    /// Acceleration of what slides down with this friction, m/s².
    fn acceleration(&self, friction: f64) -> f64 {
        G * (self.angle.sin() - friction * self.angle.cos())
    }
}

fn stick() -> Problem {
    let slope = Slope::new(20.0);
    Problem {
        name: "incline-stick".into(),
        statement: "A box of 1 m lies on a slope of 20° (tan 20° = 0.36) with µ = 0.5 for 10 s, and stays."
            .into(),
        measure: "creep in 10 s",
        unit: Unit::Of("m".into()),
        class: Class::Smooth,
        scene: slope.scene(BodySpec { friction: 0.5, ..rectangle(1.0, 0.5) }, 0.25),
        duration: 10.0,
        error: Box::new(move |run| run.largest(|run| slope.way(run.state(0)).abs())),
        range: Range::Full,
        goal: None,
        note: "",
    }
}

fn slip() -> Problem {
    const FRICTION: f64 = 0.2;
    const DURATION: f64 = 2.0;
    let slope = Slope::new(20.0);
    let acceleration = slope.acceleration(FRICTION);
    let way = 0.5 * acceleration * DURATION * DURATION;
    Problem {
        name: "incline-slide".into(),
        statement: "The box slides from rest with µ = 0.2: s = g (sin 20° - µ cos 20°) t²/2, for 2 s.".into(),
        measure: "largest error of the way / way at the end",
        unit: Unit::Part,
        class: Class::Smooth,
        scene: slope.scene(BodySpec { friction: FRICTION, ..rectangle(1.0, 0.5) }, 0.25),
        duration: DURATION,
        error: Box::new(move |run| {
            run.largest(|run| (slope.way(run.state(0)) - 0.5 * acceleration * run.time() * run.time()).abs())
                / way
        }),
        range: Range::Full,
        goal: None,
        note: "",
    }
}
