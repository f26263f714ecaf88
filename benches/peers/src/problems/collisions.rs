//! Bodies that collide in empty space.

use rustycs::report::Unit;

use crate::engine::State;
use crate::problems::{Class, Problem, Range, Run, block, disc, distance, rectangle};
use crate::scene::{BodySpec, Scene};

pub(super) fn problems() -> Vec<Problem> {
    vec![head_on(), oblique(), cradle(), boxes(), gas()]
}

/// Radius of the discs, m.
const RADIUS: f64 = 0.5;

/// The body, without friction and of restitution 1.
fn elastic(body: BodySpec) -> BodySpec {
    BodySpec { friction: 0.0, restitution: 1.0, ..body }
}

/// Such a disc.
fn elastic_disc(x: f64, y: f64) -> BodySpec {
    elastic(BodySpec { position: [x, y], ..disc(RADIUS) })
}

/// The larger of the errors of place, as part of a way (m), and of velocity, as part of a speed (m/s).
fn state_error(found: State, position: [f64; 2], velocity: [f64; 2], way: f64, speed: f64) -> f64 {
    (distance(found.position, position) / way).max(distance(found.velocity, velocity) / speed)
}

/// What [`state_error`] measures.
const STATE_ERROR: &str = "largest error of a place / way and of a velocity / v";

/// A collision of bodies in empty space, whose error is a part of something.
fn collision(
    name: &str,
    statement: &str,
    measure: &'static str,
    bodies: Vec<BodySpec>,
    duration: f64,
    error: impl Fn(&mut Run) -> f64 + 'static,
) -> Problem {
    Problem {
        name: name.into(),
        statement: statement.into(),
        measure,
        unit: Unit::Part,
        class: Class::Impact,
        scene: Scene { bodies, ..Scene::default() },
        duration,
        error: Box::new(error),
        range: Range::Full,
        goal: None,
        note: "",
    }
}

fn head_on() -> Problem {
    const SPEED: f64 = 4.0;
    let statement = "An elastic disc at v = 4 m/s hits one of three times its mass head on: they part with -v/2 and v/2. \
                     They touch after 0.25 s; 0.75 s later places and velocities are compared.";
    let light = BodySpec { velocity: [SPEED, 0.0], ..elastic_disc(-2.0, 0.0) };
    let heavy = BodySpec { density: 3.0, ..elastic_disc(0.0, 0.0) };
    collision("head-on", statement, STATE_ERROR, vec![light, heavy], 1.0, |run| {
        run.finish();
        let after = run.time() - 1.0 / SPEED;
        let [light, heavy] = [[-1.0 - 0.5 * SPEED * after, 0.0], [0.5 * SPEED * after, 0.0]];
        let error = |body, place, speed| state_error(run.state(body), place, [speed, 0.0], SPEED, SPEED);
        error(0, light, -0.5 * SPEED).max(error(1, heavy, 0.5 * SPEED))
    })
}

fn oblique() -> Problem {
    const SPEED: f64 = 5.0;
    const OFFSET: f64 = 0.5;
    let statement = "An elastic disc without friction at v = 5 m/s hits an equal one, with half its diameter between the \
                     lines of their centres. The struck one leaves along the line of centres at the impact, at v cos 30°, \
                     and the striker at a right angle to it.";
    let striker = BodySpec { velocity: [SPEED, 0.0], ..elastic_disc(-3.0, OFFSET) };
    collision("oblique", statement, STATE_ERROR, vec![striker, elastic_disc(0.0, 0.0)], 1.2, |run| {
        run.finish();
        // At the impact the centres are a diameter of 1 m apart.
        let touch = -(1.0 - OFFSET * OFFSET).sqrt();
        let after = run.time() - (touch + 3.0) / SPEED;
        let struck = [SPEED * touch * touch, SPEED * touch * OFFSET];
        let striker = [SPEED - struck[0], -struck[1]];
        let places = [
            [touch + striker[0] * after, OFFSET + striker[1] * after],
            [struck[0] * after, struck[1] * after],
        ];
        let way = SPEED * run.time();
        let error = |body, place, velocity| state_error(run.state(body), place, velocity, way, SPEED);
        error(0, places[0], striker).max(error(1, places[1], struck))
    })
}

fn cradle() -> Problem {
    const SPEED: f64 = 2.0;
    let statement = "Newton's cradle: an elastic disc at v = 2 m/s hits four that touch. The last leaves at v, and the \
                     others rest.";
    let mut bodies = vec![BodySpec { velocity: [SPEED, 0.0], ..elastic_disc(-2.0, 0.0) }];
    bodies.extend((0..4).map(|i| elastic_disc(f64::from(i), 0.0)));
    collision("cradle", statement, "largest error of a velocity / v", bodies, 2.0, |run| {
        run.finish();
        let error = |body| {
            let exact = if body == 4 { SPEED } else { 0.0 };
            distance(run.state(body).velocity, [exact, 0.0]) / SPEED
        };
        (0..5).map(error).fold(0.0, f64::max)
    })
}

fn boxes() -> Problem {
    let statement = "Two elastic boxes without friction collide spinning: momentum, angular momentum and energy stay. The \
                     largest change counts, as a part of Σ m |v|, of Σ m |x| |v| + I |w| or of the energy at the start.";
    let one = BodySpec { position: [-2.0, 0.2], velocity: [3.0, 0.0], spin: 4.0, ..rectangle(1.0, 0.5) };
    let other = BodySpec {
        position: [1.0, 0.0],
        velocity: [-1.0, 0.1],
        spin: -6.0,
        density: 2.0,
        ..rectangle(0.8, 0.8)
    };
    let measure = "largest change of momentum, angular momentum or energy";
    collision("boxes", statement, measure, [one, other].map(elastic).into(), 2.0, |run| {
        let before = run.totals();
        let spins = [run.state(0).spin, run.state(1).spin];
        run.finish();
        let after = run.totals();
        let has_hit = (0..2).all(|body| run.state(body).spin != spins[body]);
        let changes = [
            distance(after.momentum, before.momentum) / before.momentum_size,
            (after.angular_momentum - before.angular_momentum).abs() / before.angular_size,
            (after.kinetic_energy - before.kinetic_energy).abs() / before.kinetic_energy,
        ];
        if has_hit { changes.into_iter().fold(0.0, f64::max) } else { f64::INFINITY }
    })
}

/// Discs of the gas, in a square.
const GAS_SIDE: usize = 45;
const GAS_DISCS: usize = 2000;
/// m.
const GAS_RADIUS: f64 = 0.2;
/// From disc to disc at the start, m.
const GAS_PITCH: f64 = 0.9;

fn gas() -> Problem {
    let mut bodies = Vec::new();
    let half = 0.5 * GAS_PITCH * GAS_SIDE as f64;
    for (x, y) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
        let wall = half + 1.0;
        let [width, height] = if x == 0.0 { [2.0 * half + 4.0, 2.0] } else { [2.0, 2.0 * half + 4.0] };
        bodies.push(elastic(BodySpec { position: [wall * x, wall * y], ..block(width, height) }));
    }
    // The golden angle sends neighbours in directions that look like chance and are the same everywhere.
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    for index in 0..GAS_DISCS {
        let place = |cell: usize| GAS_PITCH * (cell as f64 + 0.5) - half;
        let (sin, cos) = (golden * index as f64).sin_cos();
        let speed = 1.0 + 2.0 * (index * 7 % 16) as f64 / 15.0;
        bodies.push(elastic(BodySpec {
            position: [place(index % GAS_SIDE), place(index / GAS_SIDE)],
            velocity: [speed * cos, speed * sin],
            ..disc(GAS_RADIUS)
        }));
    }
    let statement = "A gas of 2,000 elastic discs of r = 0.2 m at 1 to 3 m/s in a square of 40.5 m, for 60 s: its energy \
                     stays.";
    let gas = collision("gas", statement, "change of the energy / energy", bodies, 60.0, |run| {
        let before = run.totals().kinetic_energy;
        run.finish();
        (run.totals().kinetic_energy / before - 1.0).abs()
    });
    Problem { range: Range::Few, goal: Some(1e-3), ..gas }
}
