//! Very fast.

use rustycs::prelude::{Body, Settings, Shape, World};

use crate::chance::Chance;
use crate::scene::{BodySpec, Scene, block, disc, rectangle};
use crate::stability::case::{COUNT, Case, Check, Group, SHARE};
use crate::stability::on_earth;
use crate::stability::run::Run;

pub(super) fn cases() -> Vec<Case> {
    vec![free_spin(), spin_on_floor(), gas(32).long(), gas(10), refused()]
}

fn free_spin() -> Case {
    let statement = "A box of 1 m turns at 1000 rad/s, 17 rad in a tick, with nothing around it. Conservation: after 10 s it \
                     turns as fast, within 1e-4, and is where it was.";
    let scene = Scene { bodies: vec![BodySpec { spin: 1000.0, ..rectangle(1.0, 1.0) }], ..Scene::default() };
    Case::new("spin-free", Group::Speeds, statement, scene, |lab, scene| {
        let mut run = lab.run(scene);
        run.until(10.0);
        let [x, y] = run.shift(0);
        vec![
            Check::at_most("change of the spin", (run.state(0).spin / 1000.0 - 1.0).abs(), 1e-4, SHARE),
            Check::at_most("off its place by", x.hypot(y), 1e-6, "m"),
        ]
    })
}

fn spin_on_floor() -> Case {
    let statement = "The same falls onto a floor. No contact gives energy: that of height, motion and spin is never more \
                     than at the start, after 10 s the box is not below the floor, and it has not been thrown off the world \
                     (it may bounce by its corners, to E/(m g) at most).";
    let ground = BodySpec { position: [0.0, -1.0], ..block(1e5, 2.0) };
    let cube = BodySpec { spin: 1000.0, position: [0.0, 2.0], ..rectangle(1.0, 1.0) };
    Case::new("spin-on-floor", Group::Speeds, statement, on_earth([ground, cube]), |lab, scene| {
        let mut run = lab.run(scene);
        let start = run.energy_gained();
        let energy = run.largest(10.0, Run::energy_gained);
        let low = 0.5 - run.state(1).position[1];
        vec![
            Check::at_most("energy gained / at the start", energy / start - 1.0, 1e-4, SHARE),
            Check::at_most("centre below half a box by", low, 0.01, "m"),
        ]
    })
}

/// A square of so many by so many discs.
fn gas(side: u32) -> Case {
    let (count, half) = (side * side, 0.3 * f64::from(side) + 0.4);
    let statement = format!(
        "{count} elastic discs of 0.2 m without friction fly at up to 5 m/s in a box of {:.1} m, without gravity, for 60 s. \
         Conservation: the kinetic energy stays within 1 %, and none leaves the box.",
        2.0 * half
    );
    let wall = |x: f64, y: f64| {
        let long = 2.0 * half + 4.0;
        let spec = if y == 0.0 { block(2.0, long) } else { block(long, 2.0) };
        BodySpec { position: [x, y].map(|at| at * (half + 1.0)), friction: 0.0, restitution: 1.0, ..spec }
    };
    let mut chance = Chance(4);
    let disc = |index: u32| {
        let place = |index: u32| 0.6 * (f64::from(index) - 0.5 * f64::from(side - 1));
        BodySpec {
            position: [index % side, index / side].map(place),
            velocity: [0.0; 2].map(|_: f64| chance.between(-3.5, 3.5)),
            friction: 0.0,
            restitution: 1.0,
            ..disc(0.1)
        }
    };
    let walls = [wall(-1.0, 0.0), wall(1.0, 0.0), wall(0.0, -1.0), wall(0.0, 1.0)];
    let bodies = walls.into_iter().chain((0..count).map(disc)).collect();
    let scene = Scene { bodies, ..Scene::default() };
    Case::new(format!("gas-{count}"), Group::Speeds, statement, scene, move |lab, scene| {
        let mut run = lab.run(scene);
        let start = run.kinetic_energy();
        run.until(60.0);
        lab.picture(&run);
        let is_inside = |body: &&usize| run.state(**body).position.iter().all(|x| x.abs() <= half);
        let outside = run.moving().len() - run.moving().iter().filter(is_inside).count();
        vec![
            Check::at_most("change of the energy", (run.kinetic_energy() / start - 1.0).abs(), 0.01, SHARE),
            Check::at_most("discs outside", outside as f64, 0.0, COUNT),
        ]
    })
    .lasting(60.0)
}

fn refused() -> Case {
    let statement = "A body with restitution above 1 would gain energy at every bounce: it is refused, when it is made and \
                     when it is changed, and 1 is taken.";
    Case::ours("restitution-above-1", Group::Speeds, statement, "it is a question of the interface", |_| {
        let mut world = World::new(Settings::default());
        let ball = |restitution: f32| Body::dynamic(Shape::circle(0.5)).restitution(restitution);
        let above = [1.0 + f32::EPSILON, 1.5, f32::INFINITY, f32::NAN];
        let mut taken = above.iter().filter(|&&e| world.add(ball(e)).is_ok()).count();
        let elastic = world.add(ball(1.0)).ok();
        if let Some(mut body) = elastic.and_then(|id| world.body_mut(id)) {
            taken += above.iter().filter(|&&e| body.set_restitution(e).is_ok()).count();
        }
        vec![
            Check::at_most("above 1 and taken", taken as f64, 0.0, COUNT),
            Check::at_least("1 and taken", f64::from(u8::from(elastic.is_some())), 1.0, COUNT),
        ]
    })
}
