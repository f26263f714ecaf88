//! Forces, rates and materials at their limits.

use rustycs::prelude::{Attractor, Body, BodyId, Force, Settings, Shape, World};

use crate::chance::Chance;
use crate::engine::{DEFAULT, Fineness};
use crate::scene::{BodySpec, Scene, block, floor, rectangle};
use crate::stability::case::{Case, Check, Group, SHARE};
use crate::stability::rest::{STANDS, Scale, stack, stands, tower};
use crate::stability::run::{Lab, worse};
use crate::stability::{G, on_earth};

pub(super) fn cases() -> Vec<Case> {
    let mut cases: Vec<Case> =
        [("0", 0.0), ("1e-3", 1e-3), ("1e3", 1e3)].map(|(name, g)| gravity(name, g)).into();
    cases.extend([1.0, 0.1].map(grazed));
    cases.push(attractors());
    cases.extend([10, 30, 240, 1000, 10_000].map(rate));
    cases.push(changed_rate());
    cases.extend(
        [("0", 0.0, 20.0), ("1", 1.0, 40.0), ("10", 10.0, 70.0)]
            .map(|(name, mu, angle)| friction(name, mu, angle)),
    );
    cases.extend([("1e-3", 1e-3), ("1", 1.0), ("1e6", 1e6)].map(|(name, density)| dense(name, density)));
    cases
}

fn gravity(name: &str, g: f64) -> Case {
    let statement = format!(
        "Five boxes of 1 m on each other under {g} m/s². Statics does not ask for the gravity. Each {STANDS}."
    );
    let scene = Scene { gravity: [0.0, -g], ..stack(5) };
    Case::new(format!("gravity-{name}"), Group::Forces, statement, scene, move |lab, scene| {
        let mut run = lab.run(scene);
        // Without gravity, what f32 rounds in a centre at 5 m, ten times a second, is allowed.
        let scale = Scale { gravity: g.max(1e-6), ..Scale::of_height(5.0) };
        let checks = stands(&mut run, 10.0, scale);
        lab.picture(&run);
        checks
    })
}

const PULLS: &str = "their pulls are written by their users";

/// A body on a parabola about an attractor: the fastest way past it that a fall alone gives.
fn grazed(distance: f64) -> Case {
    let statement = format!(
        "A body falls past an attractor, on a parabola, with 14 m/s at its nearest, which is the attractor's minimum \
         distance, {distance} m. Conservation: when it is as far away again as it began, its kinetic energy is that of the \
         start within 1 % of the greatest it had."
    );
    let name = format!("attractor-grazed-{}cm", (100.0 * distance) as u32);
    let strength = 100.0 * distance;
    Case::ours(name, Group::Forces, statement, PULLS, move |lab| {
        let mut world = World::new(Settings { sleep: false, ..Settings::default() });
        let attractor = Attractor::global([0.0, 0.0], strength as f32).with_min_distance(distance as f32);
        world.add_attractor(attractor.expect("the distance is one that attractors take"));
        // Parabola: r = 2 q / (1 + cos φ), v² = 2 k / r, angular momentum √(2 k q).
        let start = 20.0 * distance;
        let momentum = (2.0 * strength * distance).sqrt();
        let speed = (2.0 * strength / start).sqrt();
        let across = momentum / start;
        let along = (speed * speed - across * across).sqrt();
        let body = Body::dynamic(Shape::circle(0.01 * distance as f32))
            .at([start, 0.0])
            .velocity([-along as f32, across as f32]);
        let id = world.add(body).expect("the description is good");
        let before = world.energy();
        let mass = f64::from(world.body(id).map_or(f32::NAN, |body| body.mass()));
        // The way in and out again, by Barker's equation: t = √(2 q³ / k) (D + D³/3), D = tan(φ/2) = √(r/q - 1).
        let half_turn = (start / distance - 1.0).sqrt();
        let way = (2.0 * distance.powi(3) / strength).sqrt() * (half_turn + half_turn.powi(3) / 3.0);
        for _ in 0..(2.0 * way * 60.0) as u64 {
            lab.step(|| world.step());
        }
        let change = (world.energy() - before).abs() / (mass * strength / distance);
        vec![Check::at_most("change of the energy / greatest", change, 0.01, SHARE)]
    })
}

fn attractors() -> Case {
    let statement = "A hundred attractors with minimum distances of 1 m stand about at random in a square of 100 m, and ten \
                     small discs fall among them for 10 s, without meeting. Conservation: the energy of all is that of the \
                     start within 1 % of the potential energy of the start.";
    Case::ours("attractors-100", Group::Forces, statement, PULLS, |lab| {
        let mut world = World::new(Settings { sleep: false, ..Settings::default() });
        let mut chance = Chance(7);
        for _ in 0..100 {
            let place = [chance.between(-50.0, 50.0), chance.between(-50.0, 50.0)];
            let attractor = Attractor::global(place, 20.0).with_min_distance(1.0);
            world.add_attractor(attractor.expect("the distance is one that attractors take"));
        }
        for index in 0..10_u16 {
            let body = Body::dynamic(Shape::circle(0.01)).at([9.0 * f64::from(index) - 40.0, 1.0]);
            world.add(body).expect("the description is good");
        }
        let before = world.energy();
        let mut change = 0.0;
        for _ in 0..600 {
            lab.step(|| world.step());
            change = worse(change, (world.energy() / before - 1.0).abs());
        }
        vec![Check::at_most("change of the energy", change, 0.01, SHARE)]
    })
}

fn rate(rate: u32) -> Case {
    let statement = format!(
        "Five boxes of 1 m on each other at {rate} ticks per second. Statics does not ask for the rate. Each {STANDS}."
    );
    Case::new(format!("rate-{rate}"), Group::Forces, statement, stack(5), move |lab, scene| {
        let fineness = Fineness { tick_rate: f64::from(rate), ..DEFAULT };
        let mut run = lab.run_at(scene, fineness);
        stands(&mut run, 10.0, Scale::of_height(5.0))
    })
}

fn changed_rate() -> Case {
    let statement = "A ball is thrown at 14 m/s at 45° while the rate goes from 60 to 10, 1000 and 30 ticks per second, at each \
                     fourth of 2 s: it is on its parabola within 1e-4 of the fall. A stack of five boxes through the same \
                     changes, for 2 s each, sinks by less than 1 % of its height and drifts by less than 1 mm.";
    let why = "their rates are not in the neutral interface";
    Case::ours("rate-changed-in-flight", Group::Forces, statement, why, |lab| {
        let mut world = World::new(Settings { sleep: false, ..Settings::default() });
        world.add_force(Force::EARTH_GRAVITY);
        let ball = Body::dynamic(Shape::circle(0.5)).at([100.0, 50.0]).velocity([10.0, 10.0]);
        let ball = world.add(ball).expect("the description is good");
        changing_rates(lab, &mut world, 0.5);
        let g = f64::from(-world.acceleration().y);
        let [x, y] = place(&world, ball);
        let off = (x - 120.0).hypot(y - (50.0 + 20.0 - 0.5 * g * 4.0)) / (0.5 * g * 4.0);

        let mut world = World::new(Settings { sleep: false, ..Settings::default() });
        world.add_force(Force::EARTH_GRAVITY);
        let ground = Body::fixed(Shape::obb(40.0, 2.0)).at([0.0, -1.0]);
        world.add(ground).expect("the description is good");
        let boxes: Vec<BodyId> = (0..5)
            .map(|index| Body::dynamic(Shape::obb(1.0, 1.0)).at([0.0, 0.5 + f64::from(index)]))
            .map(|body| world.add(body).expect("the description is good"))
            .collect();
        changing_rates(lab, &mut world, 2.0);
        let (mut sinking, mut drifting) = (0.0, 0.0);
        for (&id, index) in boxes.iter().zip(0..5_i32) {
            let [x, y] = place(&world, id);
            sinking = worse(sinking, (y - 0.5 - f64::from(index)).abs());
            drifting = worse(drifting, x.abs());
        }
        vec![
            Check::at_most("off the parabola / fall", off, 1e-4, SHARE),
            Check::at_most("sinking / height", sinking / 5.0, 0.01, SHARE),
            Check::at_most("drifting", drifting, 1e-3, "m"),
        ]
    })
}

fn changing_rates(lab: &mut Lab<'_>, world: &mut World, seconds: f64) {
    for tick_rate in [60.0_f32, 10.0, 1000.0, 30.0] {
        let settings = Settings { tick_rate, ..world.settings().clone() };
        world.set_settings(settings).expect("the rate is one that settings take");
        for _ in 0..(seconds * f64::from(tick_rate)).round() as u64 {
            lab.step(|| world.step());
        }
    }
}

fn place(world: &World, id: BodyId) -> [f64; 2] {
    world.body(id).expect("nobody removes a body").position_f64()
}

fn friction(name: &str, mu: f64, degrees: f64) -> Case {
    let angle = degrees.to_radians();
    let (sin, cos) = angle.sin_cos();
    let way = if mu < angle.tan() { 0.5 * G * (sin - mu * cos) } else { 0.0 };
    let statement = format!(
        "A plank of 4 m × 0.5 m on a slope of {degrees}° with friction {mu}. Coulomb: in 1 s it slides by {way:.3} m, within \
         1 mm; its centre is so low that it does not tip."
    );
    let on_ramp = |along: f64, above: f64| [along * cos - above * sin, along * sin + above * cos];
    let slope = BodySpec { position: on_ramp(0.0, -1.0), angle, friction: mu, ..block(40.0, 2.0) };
    let plank = BodySpec { position: on_ramp(5.0, 0.25), angle, friction: mu, ..rectangle(4.0, 0.5) };
    Case::new(
        format!("friction-{name}"),
        Group::Forces,
        statement,
        on_earth([slope, plank]),
        move |lab, scene| {
            let mut run = lab.run(scene);
            run.until(1.0);
            let [x, y] = run.state(1).position;
            let (down, above) = (5.0 - (x * cos + y * sin), y * cos - x * sin - 0.25);
            vec![
                Check::at_most("error of the way", (down - way).abs(), 1e-3, "m"),
                Check::at_most("above or within the slope by", above.abs(), 1e-3, "m"),
            ]
        },
    )
}

fn dense(name: &str, density: f64) -> Case {
    let statement = format!(
        "Five boxes of 1 m and {density} kg/m² on each other. Statics does not ask for the density. Each {STANDS}."
    );
    let scene = on_earth([floor()].into_iter().chain(tower([(1.0, density); 5])));
    Case::new(format!("density-{name}"), Group::Forces, statement, scene, |lab, scene| {
        let mut run = lab.run(scene);
        stands(&mut run, 10.0, Scale::of_height(5.0))
    })
}
