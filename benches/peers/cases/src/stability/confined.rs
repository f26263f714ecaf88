//! Too many bodies for the place they have.

use std::f64::consts::PI;

use crate::chance::Chance;
use crate::scene::{BodySpec, Kind, Outline, Scene, disc, rectangle};
use crate::stability::G;
use crate::stability::case::{COUNT, Case, Check, Group, SHARE, Seen};
use crate::stability::rest::{Scale, apart};
use crate::stability::run::{Lab, Run};

pub(super) fn cases() -> Vec<Case> {
    let mut cases = vec![squeezed(), crowd()];
    cases.extend([10, 50, 90, 99].map(overlapped));
    cases
}

/// Radius of the squeezed discs, m, and how many there are.
const RADIUS: f64 = 0.25;
const DISCS: u32 = 600;
/// Half of the inner width between the walls at the start, m.
const WIDE: f64 = 10.0;
/// Share of the area that the discs take in the end.
const FILLED: f64 = 0.8;
/// When the walls stop, s.
const STOP: f64 = 5.0;

fn squeezed() -> Case {
    let statement = "600 discs of 0.5 m between four walls that close in for 5 s and stop where the discs fill 80 % of the \
                     area: as close as they can be heaped without order is 84 %, in order 91 %, so there is room for all. \
                     5 s later none is outside, no two overlap by more than a hundredth of a disc, and from the stop on \
                     the kinetic energy never grows by more than 1 % of what the walls gave.";
    let narrow = 0.5 * (f64::from(DISCS) * PI * RADIUS * RADIUS / FILLED).sqrt();
    let speed = (WIDE - narrow) / STOP;
    let wall = |x: f64, y: f64| {
        let outline = if y == 0.0 { [2.0, 44.0] } else { [44.0, 2.0] };
        let outline = Outline::Box { width: outline[0], height: outline[1] };
        BodySpec {
            position: [x * (WIDE + 1.0), y * (WIDE + 1.0)],
            velocity: [-x * speed, -y * speed],
            friction: 0.2,
            ..BodySpec::new(Kind::Kinematic, outline)
        }
    };
    let mut chance = Chance(1);
    let disc = |index: u32| {
        let place = |index: u32| 0.78 * (f64::from(index) - 12.0);
        let [x, y] = [index % 25, index / 25].map(place);
        let [u, v] = [0.0; 2].map(|_: f64| chance.between(-0.1, 0.1));
        BodySpec { position: [x + u, y + v], friction: 0.2, ..disc(RADIUS) }
    };
    let walls = [wall(-1.0, 0.0), wall(1.0, 0.0), wall(0.0, -1.0), wall(0.0, 1.0)];
    let bodies = walls.into_iter().chain((0..DISCS).map(disc)).collect();
    let scene = Scene { bodies, ..Scene::default() };
    Case::new("squeezed", Group::Confined, statement, scene, move |lab, scene| squeeze(lab, scene, narrow))
        .seen()
}

fn squeeze(lab: &mut Lab<'_>, scene: &Scene, narrow: f64) -> Vec<Check> {
    let mut run = lab.run(scene);
    let given = run.largest(STOP, Run::kinetic_energy);
    for wall in 0..4 {
        run.set_velocity(wall, [0.0; 2]);
    }
    let stopped = run.kinetic_energy();
    let later = run.largest(10.0, Run::kinetic_energy);
    lab.picture(&run);
    // None whose centre is beyond a wall's face, NaN neither.
    let is_inside = |body: &&usize| run.state(**body).position.iter().all(|x| x.abs() <= narrow);
    let outside = run.moving().len() - run.moving().iter().filter(is_inside).count();
    let scale = Scale { size: 2.0 * RADIUS, ..Scale::of_height(1.0) };
    vec![
        Check::at_most("discs outside", outside as f64, 0.0, COUNT),
        apart(&run, scale),
        Check::at_most("energy gained after the stop / given", (later - stopped) / given, 0.01, SHARE),
    ]
}

/// Energy that a parting may add, as a share of m g s.
const ADDED: f64 = 0.01;

const PARTING: &str = "Nothing gives them energy but the parting itself, which is no physics: at most 1 % of what it takes \
                       to lift them by their size, m g s, no body ever faster than a fall from its own size makes it, \
                       √(2 g s) = 4.4 m/s, and after 10 s no overlap of more than 1 cm.";

fn parting(lab: &mut Lab<'_>, scene: &Scene) -> Vec<Check> {
    let mut run = lab.run(scene);
    let (mut energy, mut speed) = (0.0, 0.0);
    for tick in 1..=600 {
        run.until(f64::from(tick) / 60.0);
        energy = super::run::worse(energy, run.kinetic_energy());
        speed = super::run::worse(speed, run.most(|_, state| state.velocity[0].hypot(state.velocity[1])));
    }
    lab.picture(&run);
    vec![
        Check::at_most("energy / m g s", energy / (run.mass() * G), ADDED, SHARE),
        Check::at_most("greatest speed", speed, (2.0 * G).sqrt(), "m/s"),
        apart(&run, Scale::of_height(1.0)),
    ]
}

fn crowd() -> Case {
    let statement = format!("50 boxes of 1 m in one place, without gravity. {PARTING}");
    let scene = Scene { bodies: vec![rectangle(1.0, 1.0); 50], ..Scene::default() };
    let case = Case::new("crowd-of-50", Group::Confined, statement, scene, parting);
    Case { seen: Seen::Part([[-12.0, -12.0], [12.0, 12.0]]), ..case }
}

fn overlapped(percent: u32) -> Case {
    let statement = format!("Two boxes of 1 m that overlap by {percent} % of it, without gravity. {PARTING}");
    let gap = 0.5 * (1.0 - f64::from(percent) / 100.0);
    let cube = |x| BodySpec { position: [x, 0.0], ..rectangle(1.0, 1.0) };
    let scene = Scene { bodies: vec![cube(-gap), cube(gap)], ..Scene::default() };
    let case = Case::new(format!("overlap-{percent}"), Group::Confined, statement, scene, parting);
    if percent == 99 { case.seen() } else { case }
}
