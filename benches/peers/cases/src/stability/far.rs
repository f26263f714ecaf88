//! Far from the origin.

use crate::chance::Chance;
use crate::engine::State;
use crate::scene::{BodySpec, Scene, block, disc, floor};
use crate::stability::case::{Case, Check, Group, SHARE};
use crate::stability::figures::any;
use crate::stability::on_earth;
use crate::stability::rest::stack;
use crate::stability::run::{Lab, Run, worse};

/// m.
const DISTANCES: [f64; 4] = [1e4, 1e5, 1e6, 1e7];

pub(super) fn cases() -> Vec<Case> {
    vec![standing(), throw(), bounce(), pile()]
}

/// A case that is played at the origin and far from it, to right and above; `figure` gives numbers that are compared,
/// as parts of a scale.
fn case(
    name: &str,
    what: &str,
    scene: Scene,
    seconds: f64,
    scale: f64,
    figure: impl Fn(&mut Run, [f64; 2]) -> Vec<f64> + 'static,
) -> Case {
    let statement = format!(
        "{what} Space is the same everywhere: 10, 100, 1,000 and 10,000 km from the origin, along x and along y, the figure is \
         that of the origin within 1 % of {scale} m."
    );
    let case = Case::new(format!("far-{name}"), Group::Far, statement, scene, move |lab, scene| {
        let near = figure(&mut lab.run(scene), [0.0; 2]);
        DISTANCES.iter().map(|&distance| compare(lab, scene, distance, &near, scale, &figure)).collect()
    });
    case.lasting(seconds)
}

fn compare(
    lab: &mut Lab<'_>,
    scene: &Scene,
    distance: f64,
    near: &[f64],
    scale: f64,
    figure: &impl Fn(&mut Run, [f64; 2]) -> Vec<f64>,
) -> Check {
    let mut scene = scene.clone();
    for spec in &mut scene.bodies {
        spec.position = spec.position.map(|x| x + distance);
    }
    let mut run = lab.run(&scene);
    let far = figure(&mut run, [distance; 2]);
    lab.picture(&run);
    let error = near.iter().zip(&far).map(|(near, far)| (near - far).abs()).fold(0.0, worse);
    Check::at_most(format!("difference at {distance:e} m"), error / scale, 0.01, SHARE)
}

/// Where the dynamic bodies are, from here, m.
fn places(run: &Run, origin: [f64; 2]) -> Vec<f64> {
    let place = |&body: &usize| {
        let State { position: [x, y], .. } = run.state(body);
        [x - origin[0], y - origin[1]]
    };
    run.moving().iter().flat_map(place).collect()
}

fn standing() -> Case {
    let what = "A stack of ten boxes of 1 m; the places of all after 10 s.";
    case("stack", what, stack(10), 10.0, 1.0, |run, origin| {
        run.until(10.0);
        places(run, origin)
    })
}

fn throw() -> Case {
    let what = "A ball is thrown at 14 m/s at 45°; its place after 2 s.";
    let ball = BodySpec { velocity: [10.0, 10.0], ..disc(0.5) };
    case("throw", what, on_earth([ball]), 2.0, 20.0, |run, origin| {
        run.until(2.0);
        places(run, origin)
    })
}

fn bounce() -> Case {
    let what = "A ball of restitution 0.8 falls from 2 m; the greatest heights after each of three bounces.";
    let ball = BodySpec { position: [0.0, 2.5], restitution: 0.8, ..disc(0.5) };
    case("bounce", what, on_earth([floor(), ball]), 5.0, 2.0, |run, origin| {
        let mut apexes: Vec<f64> = Vec::new();
        let mut was_rising = false;
        while run.time() < 5.0 && apexes.len() < 3 {
            run.tick();
            let state = run.state(1);
            let is_rising = state.velocity[1] > 0.0;
            if was_rising && !is_rising {
                apexes.push(state.position[1] - origin[1]);
            }
            was_rising = is_rising;
        }
        // A bounce that did not come is as wrong as can be.
        apexes.resize(3, f64::NAN);
        apexes
    })
}

/// Pools side by side, and from one to the next, m.
const POOLS: u32 = 64;
const PITCH: f64 = 4.0;

fn pile() -> Case {
    let what = "Discs, boxes and polygons fall into 64 pools, a dozen into each; the height of the centre of all after 10 s (single \
                bodies depend on the last bit of a number, the mean of many does not).";
    let width = f64::from(POOLS) * PITCH;
    let wall =
        |index: u32| BodySpec { position: [PITCH * f64::from(index) - 0.5 * width, 5.0], ..block(1.0, 10.0) };
    let ground = BodySpec { position: [0.0, -1.0], ..block(width + 2.0, 2.0) };
    let mut chance = Chance(5);
    let body = |index: u32| {
        let (pool, column, row) = (index / 12, f64::from(index % 2), f64::from(index % 12 / 2));
        let middle = PITCH * (f64::from(pool) + 0.5) - 0.5 * width;
        BodySpec { position: [middle + 1.2 * (column - 0.5), 0.6 + 1.1 * row], ..any(&mut chance, 0.5) }
    };
    let bodies = [ground].into_iter().chain((0..=POOLS).map(wall)).chain((0..12 * POOLS).map(body));
    case("pile", what, on_earth(bodies), 10.0, 4.0, |run, origin| {
        run.until(10.0);
        let moment: f64 = run
            .moving()
            .iter()
            .map(|&body| run.mass_of(body) * (run.state(body).position[1] - origin[1]))
            .sum();
        vec![moment / run.mass()]
    })
}
