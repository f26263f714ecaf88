//! Very large, very small, very thin.

use crate::chance::Chance;
use crate::scene::{BodySpec, Kind, Outline, Scene, block, disc, floor, rectangle};
use crate::stability::case::{Case, Check, Group, SHARE, Seen};
use crate::stability::figures::{any, polygon};
use crate::stability::rest::{STANDS, Scale, apart, calm, stack, stands, tower};
use crate::stability::run::Run;
use crate::stability::{G, on_earth};

pub(super) fn cases() -> Vec<Case> {
    let mut cases: Vec<Case> =
        [("1mm", 1e-3), ("1cm", 1e-2), ("1km", 1e3)].map(|(name, size)| small_tower(name, size)).into();
    cases.extend([("middle", 0.0), ("edge", 4000.0)].map(|(name, x)| gravel(name, x)));
    cases.extend([needles(), tiny_edges(), near_parallel(), on_a_vertex(), planet()]);
    cases
}

fn small_tower(name: &str, size: f64) -> Case {
    let statement = format!(
        "A tower of ten boxes of {size} m. Statics does not ask for the size. Each {STANDS}; no two overlap by more than a \
         hundredth of a box."
    );
    let ground = BodySpec { position: [0.0, -size], ..block(40.0 * size, 2.0 * size) };
    let scene = on_earth([ground].into_iter().chain(tower([(size, 1.0); 10])));
    Case::new(format!("tower-{name}"), Group::Sizes, statement, scene, move |lab, scene| {
        let scale = Scale { size, height: 10.0 * size, gravity: G };
        let mut run = lab.run(scene);
        let mut checks = stands(&mut run, 10.0, scale);
        checks.push(apart(&run, scale));
        lab.picture(&run);
        checks
    })
    .seen()
}

/// Radius of gravel, m.
const GRAIN: f64 = 0.005;

fn gravel(name: &str, x: f64) -> Case {
    let statement = format!(
        "A heap of 60 stones of 1 cm, discs, boxes and polygons, falls onto a flat ground 10 km wide, {x} m from its middle. \
         What is rigid lies on the ground: in the last second nothing moves, nothing is more than a hundredth of a stone \
         deep in anything else; and no stone has been thrown higher than it began."
    );
    let ground = BodySpec { position: [0.0, -50.0], ..block(10_000.0, 100.0) };
    let mut chance = Chance(2);
    let mut stone = |index: u32| {
        let (column, row) = (f64::from(index % 6), f64::from(index / 6));
        let place = [x + 2.4 * GRAIN * (column - 2.5 + 0.1 * (row % 2.0)), GRAIN * (1.5 + 2.4 * row)];
        let mut spec = any(&mut chance, GRAIN);
        if let Outline::Circle { .. } = spec.outline {
            // On a flat ground a disc would roll for ever.
            spec.outline = Outline::Box { width: 1.4 * GRAIN, height: 1.4 * GRAIN };
        }
        BodySpec { position: place, ..spec }
    };
    let bodies: Vec<BodySpec> = [ground].into_iter().chain((0..60).map(&mut stone)).collect();
    let top = 30.0 * GRAIN;
    Case::new(format!("gravel-{name}"), Group::Sizes, statement, on_earth(bodies), move |lab, scene| {
        let scale = Scale { size: 2.0 * GRAIN, height: top, gravity: G };
        let mut run = lab.run(scene);
        let highest = run.largest(9.0, |run| run.most(|_, state| state.position[1]));
        let calm = calm(&mut run, 10.0, scale);
        lab.picture(&run);
        vec![calm, apart(&run, scale), Check::at_most("highest stone", highest, top, "m")]
    })
    .seen()
}

fn needles() -> Case {
    let statement = "Twenty needles, 1 m long and 1 mm thick, fall crosswise into a box. They hit without bounce and \
                     friction takes the rest: the energy is never more than at the start, none leaves the box, and after \
                     20 s they are at rest.";
    let mut chance = Chance(3);
    let wall = |side: f64| BodySpec { position: [side * 1.5, 1.5], ..block(1.0, 5.0) };
    let needle = |index: u32| BodySpec {
        position: [0.02 * (f64::from(index % 5) - 2.0), 1.0 + 0.6 * f64::from(index)],
        angle: chance.between(-0.7, 0.7),
        ..rectangle(1.0, 1e-3)
    };
    let tall = [wall(-1.0), wall(1.0)]
        .map(|wall| BodySpec { outline: Outline::Box { width: 1.0, height: 40.0 }, ..wall });
    let bodies = [floor()].into_iter().chain(tall).chain((0..20).map(needle));
    let case = Case::new("needles", Group::Sizes, statement, on_earth(bodies), |lab, scene| {
        // At rest by what a body of 1 m is allowed.
        let scale = Scale::of_height(1.0);
        let mut run = lab.run(scene);
        let energy = run.largest(19.0, Run::energy_gained);
        let calm = calm(&mut run, 20.0, scale);
        lab.picture(&run);
        let left = run.most(|_, state| super::run::worse(state.position[0].abs() - 1.0, -state.position[1]));
        let whole = run.mass() * G * 6.0;
        vec![
            Check::at_most("energy gained / m g h", energy / whole, 1e-5, SHARE),
            Check::at_most("out of the box by", left, 0.0, "m"),
            calm,
        ]
    })
    .lasting(20.0);
    Case { seen: Seen::Part([[-1.4, -0.3], [1.4, 0.9]]), ..case }
}

fn tiny_edges() -> Case {
    let statement = format!(
        "Five boxes of 1 m whose corners are cut by edges of 1 mm, on each other. Statics: they stand as boxes do. Each \
         {STANDS}."
    );
    let (out, cut) = (0.5, 0.5 - 1e-3 / 2.0_f64.sqrt());
    let corners = [
        [cut, -out],
        [out, -cut],
        [out, cut],
        [cut, out],
        [-cut, out],
        [-out, cut],
        [-out, -cut],
        [-cut, -out],
    ];
    let boxes = (0..5).map(|index| BodySpec {
        position: [0.0, 0.5 + f64::from(index)],
        ..polygon(Kind::Dynamic, &corners)
    });
    let scene = on_earth([floor()].into_iter().chain(boxes));
    Case::new("tiny-edges", Group::Sizes, statement, scene, |lab, scene| {
        let mut run = lab.run(scene);
        let checks = stands(&mut run, 10.0, Scale::of_height(5.0));
        lab.picture(&run);
        checks
    })
}

fn near_parallel() -> Case {
    let slant = 1e-4;
    let statement = format!(
        "Ten wedges of 1 m whose faces are off by {slant} rad, one up, one down, so that they fit; their sides have a \
         corner that stands out by 0.05 mm. Statics: the slope is far below friction, so they stand. Each {STANDS}."
    );
    let mut bodies = vec![floor()];
    for index in 0..10_u32 {
        let base = f64::from(index);
        let (low, high) = if index % 2 == 0 { (0.0, slant) } else { (slant, 0.0) };
        let (low, high) = (0.5 * low, 0.5 * high);
        let corners = [
            [-0.5, base - low],
            [0.5, base + low],
            [0.500_05, base + 0.5],
            [0.5, base + 1.0 + high],
            [-0.5, base + 1.0 - high],
            [-0.500_05, base + 0.5],
        ];
        bodies.push(polygon(Kind::Dynamic, &corners));
    }
    Case::new("near-parallel", Group::Sizes, statement, on_earth(bodies), |lab, scene| {
        let mut run = lab.run(scene);
        let checks = stands(&mut run, 10.0, Scale::of_height(10.0));
        lab.picture(&run);
        checks
    })
}

fn on_a_vertex() -> Case {
    let statement = "A disc of 1 m right above the corner of a fixed triangle. Statics: the balance is unstable, so it may \
                     stay or roll off, but it cannot sink: its centre is never nearer to the triangle than 0.495 m, and the \
                     energy is never more than at the start.";
    let triangle = polygon(Kind::Fixed, &[[-1.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    let ball = BodySpec { position: [0.0, 1.5], ..disc(0.5) };
    let scene = on_earth([floor(), triangle, ball]);
    Case::new("disc-on-vertex", Group::Sizes, statement, scene, |lab, scene| {
        let mut run = lab.run(scene);
        let (mut deepest, mut energy) = (0.0, f64::NEG_INFINITY);
        for tick in 1..=600 {
            run.until(f64::from(tick) / 60.0);
            deepest = super::run::worse(deepest, run.deepest_overlap());
            energy = super::run::worse(energy, run.energy_gained());
        }
        lab.picture(&run);
        vec![
            Check::at_most("deepest overlap", deepest, 0.005, "m"),
            Check::at_most("energy gained / m g h", energy / (run.mass() * G), 1e-5, SHARE),
        ]
    })
}

/// Mean radius of the Earth, m.
const EARTH: f64 = 6.371e6;

fn planet() -> Case {
    let statement = format!(
        "Five boxes of 1 m on a disc as large as the Earth, {EARTH} m. Over a metre it falls off by 20 nm, so statics is that \
         of a flat floor. Each {STANDS}."
    );
    let earth =
        BodySpec { position: [0.0, -EARTH], ..BodySpec::new(Kind::Fixed, Outline::Circle { radius: EARTH }) };
    let scene = Scene {
        bodies: [earth].into_iter().chain(stack(5).bodies.into_iter().skip(1)).collect(),
        ..stack(0)
    };
    Case::new("planet-as-ground", Group::Sizes, statement, scene, |lab, scene| {
        let mut run = lab.run(scene);
        let checks = stands(&mut run, 10.0, Scale::of_height(5.0));
        lab.picture(&run);
        checks
    })
}
