//! The proofs: scenes, what they should do, and by how much they do not.

use std::f64::consts::{PI, TAU};

use super::Proof;
use crate::engine::{Engine, Fineness, Simulation, State};
use crate::scene::{BodySpec, G, Kind, Outline, Pull, Scene, disc, floor, on_earth, rectangle};

pub(super) const PROOFS: &[Proof] = &[
    // A few roundings of f32.
    Proof {
        claim: "mass and inertia of disc, box, triangle, hexagon; relative",
        limit: 1e-5,
        deviation: masses,
    },
    Proof {
        claim: "state before the first step is the one given; m, rad, m/s, rad/s",
        limit: 1e-6,
        deviation: given,
    },
    // n roundings of f32 in a row are off by about √n/2 of them: 240 roundings, 5e-7.
    Proof { claim: "a step lasts 1 / tick rate; relative", limit: 1e-5, deviation: step_length },
    // The limit is one kick too many, h/T, which a scheme of first order with one substep would have.
    Proof {
        claim: "a throw ends at vT + gT²/2; of its length by gravity",
        limit: 1.0 / 240.0,
        deviation: throw,
    },
    Proof {
        claim: "error of a fall is none, or halves with the step; ratio - 2",
        limit: 0.1,
        deviation: halving,
    },
    Proof {
        claim: "error falls by 4 or more with 4 substeps; missing part",
        limit: 0.1,
        deviation: substeps,
    },
    Proof { claim: "slides v²/(2µg), µ the geometric mean; relative", limit: 0.02, deviation: slide },
    Proof {
        claim: "equal discs of restitution 1 exchange velocities; of the approach",
        limit: 0.02,
        deviation: exchange,
    },
    Proof { claim: "rebounds with the larger of 0.5 and 0; of the speed", limit: 0.05, deviation: rebound },
    Proof { claim: "bounces at 0.2 m/s too; of the speed", limit: 0.05, deviation: slow_bounce },
    Proof {
        claim: "a pull holds a body on its circle in its period; of a turn, of the radius",
        limit: 0.01,
        deviation: circle,
    },
    Proof {
        claim: "a kinematic body moves as told, whatever it meets; m, rad",
        limit: 1e-4,
        deviation: kinematic,
    },
    Proof { claim: "creeps on at 1 cm/s for 5 s: nothing sleeps; relative", limit: 1e-3, deviation: creep },
    // Soft contacts give by 0.1 mm under a body's own weight.
    Proof { claim: "disc, box and hexagon rest on a floor that stays; m", limit: 1e-3, deviation: rest },
    Proof { claim: "they have 1 + 2 + 2 contact points; difference", limit: 0.0, deviation: contact_points },
];

const FINE: Fineness = Fineness { tick_rate: 240.0, substeps: 4 };

/// Legs of 3 and 4 m.
fn triangle() -> BodySpec {
    let third = 4.0 / 3.0;
    let corners = vec![[-1.0, -third], [2.0, -third], [-1.0, 2.0 * third]];
    BodySpec::new(Kind::Dynamic, Outline::Polygon(corners))
}

/// With a corner to the right.
fn hexagon(side: f64) -> BodySpec {
    BodySpec::new(Kind::Dynamic, Outline::regular(6, side))
}

/// Bodies without gravity.
fn float(bodies: Vec<BodySpec>) -> Scene {
    Scene { bodies, ..Scene::default() }
}

/// The world of a scene after so many seconds.
fn after(seconds: f64, engine: &dyn Engine, scene: &Scene, fineness: Fineness) -> Box<dyn Simulation> {
    let mut world = engine.simulate(scene, fineness);
    for _ in 0..(seconds * fineness.tick_rate).round() as u64 {
        world.step();
    }
    world
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

fn relative(found: f64, expected: f64) -> f64 {
    (found / expected - 1.0).abs()
}

/// The largest; NaN if one is.
fn worst(deviations: impl IntoIterator<Item = f64>) -> f64 {
    deviations.into_iter().fold(0.0, |worst, x| if x <= worst { worst } else { x })
}

fn masses(engine: &dyn Engine) -> f64 {
    // Outline, area, and inertia over mass: r²/2, (w² + h²)/12, (a² + b²)/18 of legs, 5 s²/12 of a side.
    let known = [
        (disc(0.7), PI * 0.49, 0.245),
        (rectangle(2.0, 0.5), 1.0, 4.25 / 12.0),
        (triangle(), 6.0, 25.0 / 18.0),
        (hexagon(0.5), 1.5 * 3.0_f64.sqrt() * 0.25, 1.25 / 12.0),
    ];
    let place = |(i, (body, ..)): (usize, &(BodySpec, f64, f64))| BodySpec {
        position: [10.0 * i as f64, 0.0],
        angle: 0.4,
        density: 3.0,
        ..body.clone()
    };
    let world = engine.simulate(&float(known.iter().enumerate().map(place).collect()), FINE);
    worst(known.iter().enumerate().flat_map(|(i, (_, area, inertia_per_mass))| {
        let [mass, inertia] = world.mass(i);
        [relative(mass, 3.0 * area), relative(inertia, 3.0 * area * inertia_per_mass)]
    }))
}

fn given(engine: &dyn Engine) -> f64 {
    let bodies: Vec<_> = [disc(0.7), rectangle(2.0, 0.5), triangle()]
        .into_iter()
        .enumerate()
        .map(|(i, body)| BodySpec {
            position: [5.0 * i as f64 - 5.0, 3.25],
            angle: 1.25 - i as f64,
            velocity: [2.0, -1.5 * i as f64],
            spin: 0.75 * i as f64,
            ..body
        })
        .collect();
    let world = engine.simulate(&float(bodies.clone()), FINE);
    worst(bodies.iter().enumerate().flat_map(|(i, body)| {
        let State { position, angle, velocity, spin } = world.state(i);
        [
            distance(position, body.position),
            (angle - body.angle).abs(),
            distance(velocity, body.velocity),
            (spin - body.spin).abs(),
        ]
    }))
}

fn step_length(engine: &dyn Engine) -> f64 {
    worst([30.0, 60.0, 240.0].map(|tick_rate| {
        let ball = BodySpec { velocity: [2.0, 0.0], spin: 0.5, ..disc(0.5) };
        let mut world = engine.simulate(&float(vec![ball]), Fineness { tick_rate, substeps: 4 });
        for _ in 0..60 {
            world.step();
        }
        let State { position, angle, .. } = world.state(0);
        let seconds = 60.0 / tick_rate;
        worst([relative(position[0], 2.0 * seconds), relative(angle, 0.5 * seconds)])
    }))
}

fn throw(engine: &dyn Engine) -> f64 {
    let ball = BodySpec { velocity: [3.0, 4.0], ..disc(0.5) };
    let scene = Scene { bodies: vec![ball], gravity: [0.5, -G], ..Scene::default() };
    let end = after(1.0, engine, &scene, FINE).state(0).position;
    distance(end, [3.0 + 0.25, 4.0 - 0.5 * G]) / (0.5 * G)
}

/// How far a ball is, m, from where it should be after a second.
fn fall_error(engine: &dyn Engine, tick_rate: f64, substeps: u32) -> f64 {
    let world = after(1.0, engine, &on_earth([disc(0.5)]), Fineness { tick_rate, substeps });
    (world.state(0).position[1] + 0.5 * G).abs()
}

/// Below this, m, the error of a fall of 5 m is that of `f32`.
const ROUNDING: f64 = 1e-4;

fn halving(engine: &dyn Engine) -> f64 {
    let [coarse, fine] = [60.0, 120.0].map(|tick_rate| fall_error(engine, tick_rate, 4));
    if coarse <= ROUNDING { 0.0 } else { (coarse / fine - 2.0).abs() }
}

/// The error of a fall, and where there is none, that of an orbit.
fn substeps(engine: &dyn Engine) -> f64 {
    let [mut coarse, mut fine] = [1, 4].map(|substeps| fall_error(engine, 60.0, substeps));
    if coarse <= ROUNDING {
        [coarse, fine] = [1, 4].map(|substeps| {
            let world = after(PERIOD, engine, &circular_orbit(), Fineness { tick_rate: 30.0, substeps });
            distance(world.state(0).position, [5.0, 0.0])
        });
    }
    (1.0 - coarse / fine / 4.0).max(0.0)
}

fn slide(engine: &dyn Engine) -> f64 {
    let speed = 4.0;
    let sled =
        BodySpec { position: [0.0, 0.25], velocity: [speed, 0.0], friction: 0.8, ..rectangle(1.0, 0.5) };
    let scene = on_earth([sled, BodySpec { friction: 0.2, ..floor() }]);
    let end = after(2.0, engine, &scene, FINE).state(0).position;
    relative(end[0], speed * speed / (2.0 * 0.4 * G))
}

fn exchange(engine: &dyn Engine) -> f64 {
    let ball = |x, v| BodySpec { position: [x, 0.0], velocity: [v, 0.0], restitution: 1.0, ..disc(0.5) };
    let world = after(2.0, engine, &float(vec![ball(-1.5, 1.5), ball(0.5, -0.5)]), FINE);
    worst([(0, -0.5), (1, 1.5)].map(|(i, v)| distance(world.state(i).velocity, [v, 0.0]) / 2.0))
}

fn rebound(engine: &dyn Engine) -> f64 {
    let ball = BodySpec { position: [0.0, 1.5], restitution: 0.5, ..disc(0.5) };
    let mut world = engine.simulate(&on_earth([ball, floor()]), Fineness { tick_rate: 960.0, substeps: 4 });
    let (mut fastest_fall, mut fastest_rise) = (0.0_f64, 0.0_f64);
    // It falls for √(2·1/g) = 0.45 s and rises for half of that.
    for _ in 0..576 {
        world.step();
        let speed = world.state(0).velocity[1];
        fastest_fall = fastest_fall.max(-speed);
        fastest_rise = fastest_rise.max(speed);
    }
    (fastest_rise / fastest_fall - 0.5).abs()
}

fn slow_bounce(engine: &dyn Engine) -> f64 {
    let ball = BodySpec { position: [0.0, 0.6], velocity: [0.0, -0.2], restitution: 1.0, ..disc(0.5) };
    let world = after(1.0, engine, &float(vec![ball, floor()]), FINE);
    distance(world.state(0).velocity, [0.0, 0.2]) / 0.2
}

/// A body on a circle of 4 m about (1, 0) m.
fn circular_orbit() -> Scene {
    let speed = TAU * 4.0 / PERIOD;
    let planet = BodySpec { position: [5.0, 0.0], velocity: [0.0, speed], density: 2.0, ..disc(0.1) };
    // v²/r = GM/r².
    let pull = Pull { center: [1.0, 0.0], strength: speed * speed * 4.0 };
    Scene { pull: Some(pull), ..float(vec![planet]) }
}

/// Of the orbit, s: a whole number of ticks.
const PERIOD: f64 = 8.0;

fn circle(engine: &dyn Engine) -> f64 {
    // Where the pull is held through a step of 4 substeps, the orbit widens by 3/2 π ωh in a turn: 0.4 %.
    let finer = Fineness { tick_rate: 960.0, ..FINE };
    let [x, y] = after(PERIOD, engine, &circular_orbit(), finer).state(0).position;
    let (turned, radius) = (y.atan2(x - 1.0) / TAU, (x - 1.0).hypot(y));
    worst([turned.abs(), relative(radius, 4.0)])
}

fn kinematic(engine: &dyn Engine) -> f64 {
    let body = rectangle(1.0, 1.0);
    let lift = BodySpec { kind: Kind::Kinematic, velocity: [1.0, -0.5], spin: 0.7, ..body };
    let in_its_way = BodySpec { position: [1.5, -0.5], density: 100.0, ..disc(0.5) };
    let State { position, angle, .. } = after(1.0, engine, &float(vec![lift, in_its_way]), FINE).state(0);
    worst([distance(position, [1.0, -0.5]), (angle - 0.7).abs()])
}

fn creep(engine: &dyn Engine) -> f64 {
    let ball = BodySpec { velocity: [0.01, 0.0], ..disc(0.5) };
    relative(after(5.0, engine, &float(vec![ball]), FINE).state(0).position[0], 0.05)
}

/// Three bodies of height 1 on the floor; the hexagon, with its sides up and down, is √3 of its side high.
fn resting() -> Scene {
    let hexagon = hexagon(1.0 / 3.0_f64.sqrt());
    let place = |x, body| BodySpec { position: [x, 0.5], ..body };
    on_earth([place(-3.0, disc(0.5)), place(0.0, rectangle(2.0, 1.0)), place(3.0, hexagon), floor()])
}

fn rest(engine: &dyn Engine) -> f64 {
    let scene = resting();
    let world = after(2.0, engine, &scene, FINE);
    worst(scene.bodies.iter().enumerate().map(|(i, body)| distance(world.state(i).position, body.position)))
}

fn contact_points(engine: &dyn Engine) -> f64 {
    (after(2.0, engine, &resting(), FINE).contact_points() as f64 - 5.0).abs()
}
