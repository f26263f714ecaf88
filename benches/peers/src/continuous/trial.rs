//! What is thrown at what: one trial is one small world.

use rustycs_cases::chance::Chance;

use crate::engine::{Engine, Fineness};
use crate::scene::{BodySpec, Kind, Outline, Scene, block, disc, rectangle};

/// m/s.
pub(super) const SPEEDS: [f64; 8] = [1.0, 5.0, 20.0, 100.0, 300.0, 1e3, 3e3, 1e4];

/// Of the wall, m.
pub(super) const THICKNESSES: [f64; 3] = [0.001, 0.01, 0.2];

/// Tick rates, 1/s, and substeps.
pub(super) const FINENESSES: [Fineness; 6] = [
    Fineness { tick_rate: 30.0, substeps: 1 },
    Fineness { tick_rate: 30.0, substeps: 4 },
    Fineness { tick_rate: 60.0, substeps: 1 },
    Fineness { tick_rate: 60.0, substeps: 4 },
    Fineness { tick_rate: 240.0, substeps: 1 },
    Fineness { tick_rate: 240.0, substeps: 4 },
];

/// Random worlds of each kind at each fineness.
pub(super) const WORLDS: u32 = 20;

/// Half the height of a wall, m: nothing gets round it.
const HALF_HEIGHT: f64 = 20.0;

/// What is thrown at what.
#[derive(Clone, Copy, Debug)]
pub(super) struct Throw {
    /// As it is called in tables and in the file.
    pub(super) name: &'static str,
    pub(super) statement: &'static str,
    kind: Thrown,
}

#[derive(Clone, Copy, Debug)]
enum Thrown {
    /// One body, and its greatest spin, rad/s.
    Alone(fn() -> BodySpec, f64),
    /// A disc at rest before the wall, struck from behind by a heavy one.
    Struck,
    /// The last of ten discs strikes the others.
    Row,
    /// A disc at a wall of tiles of half a metre.
    AtTiles,
    /// A disc into the corner of two walls.
    IntoCorner,
    /// A box at rest that a wall runs into.
    MovingWall,
    /// A disc at a plate of 40 t that is free to move.
    FreePlate,
    /// Two discs as thick as the wall would be.
    TwoBullets,
}

/// All of them.
pub(super) const THROWS: &[Throw] = &[
    Throw { name: "disc", statement: "a disc of 10 cm", kind: Thrown::Alone(small_disc, 0.0) },
    Throw { name: "box", statement: "a box of 10 cm", kind: Thrown::Alone(small_box, 0.0) },
    Throw { name: "triangle", statement: "a triangle of 12 cm", kind: Thrown::Alone(triangle, 0.0) },
    Throw { name: "needle", statement: "a box of 2 m x 1 cm", kind: Thrown::Alone(needle, 0.0) },
    Throw {
        name: "spinning-box",
        statement: "the box, at up to 100 rad/s",
        kind: Thrown::Alone(small_box, 100.0),
    },
    Throw {
        name: "spinning-needle",
        statement: "the long one, at up to 300 rad/s",
        kind: Thrown::Alone(needle, 300.0),
    },
    Throw {
        name: "struck",
        statement: "a disc at rest, struck by one of ten times its mass",
        kind: Thrown::Struck,
    },
    Throw {
        name: "row-of-ten",
        statement: "ten discs, of which the last strikes the others",
        kind: Thrown::Row,
    },
    Throw { name: "tiles", statement: "a disc, at a wall of tiles of half a metre", kind: Thrown::AtTiles },
    Throw { name: "corner", statement: "a disc, into the corner of two walls", kind: Thrown::IntoCorner },
    Throw {
        name: "moving-wall",
        statement: "a box at rest, which a kinematic wall runs into",
        kind: Thrown::MovingWall,
    },
    Throw {
        name: "free-plate",
        statement: "a disc, at a plate of 40 t that may move",
        kind: Thrown::FreePlate,
    },
    Throw {
        name: "two-bullets",
        statement: "two discs as thick as the wall, at each other",
        kind: Thrown::TwoBullets,
    },
];

fn small_disc() -> BodySpec {
    disc(0.05)
}

fn small_box() -> BodySpec {
    rectangle(0.1, 0.1)
}

fn triangle() -> BodySpec {
    BodySpec::new(Kind::Dynamic, Outline::regular(3, 0.07))
}

fn needle() -> BodySpec {
    rectangle(2.0, 0.01)
}

/// What bodies and wall are made of, by the number of the trial.
fn made(spec: BodySpec, trial: u32) -> BodySpec {
    let restitution = [0.0, 0.2, 0.5, 1.0][(trial % 4) as usize];
    BodySpec { restitution, friction: 0.3, ..spec }
}

/// Bodies, and which must stay where in respect of which others.
struct World {
    bodies: Vec<BodySpec>,
    /// Indices of bodies, and of what they must not get behind: in the direction of x, or of y too.
    watched: Vec<usize>,
    wall: usize,
    has_corner: bool,
}

/// Whether something gets behind what it is thrown at, with a speed, m/s.
pub(super) fn passes(
    engine: &dyn Engine,
    throw: &Throw,
    thickness: f64,
    speed: f64,
    fineness: Fineness,
    trial: u32,
) -> bool {
    let seed = u64::from(trial) << 32
        | (speed as u64) << 8
        | (fineness.tick_rate as u64 + u64::from(fineness.substeps));
    let mut chance = Chance(seed);
    let before = chance.between(0.001, (speed / fineness.tick_rate).max(0.1));
    let World { bodies, mut watched, wall, has_corner } =
        world(throw.kind, thickness, speed, before, trial, &mut chance);
    let scene = Scene { bodies, ..Scene::default() };
    let mut simulation = engine.simulate(&scene, fineness);
    // Twice the way to the wall, with two metres to spare.
    let steps = (2.0 * (before + 2.0) / speed * fineness.tick_rate).ceil().clamp(10.0, 2_000.0) as u32;
    for _ in 0..steps {
        simulation.step();
        let [wall_x, _] = simulation.state(wall).position;
        // What gets to the end of a wall may go round it.
        let is_before =
            |[x, y]: [f64; 2]| y.abs() < 0.9 * HALF_HEIGHT && (!has_corner || x > -0.9 * HALF_HEIGHT);
        watched.retain(|&body| is_before(simulation.state(body).position));
        let is_behind = |[x, y]: [f64; 2]| x > wall_x || (has_corner && y > 0.0);
        if watched.iter().any(|&body| is_behind(simulation.state(body).position)) {
            return true;
        }
    }
    false
}

/// Makes bodies of what the trial is made of.
#[derive(Clone, Copy)]
struct Maker {
    trial: u32,
    /// Of the wall, m.
    thickness: f64,
}

impl Maker {
    fn wall(self) -> BodySpec {
        made(block(self.thickness, 2.0 * HALF_HEIGHT), self.trial)
    }

    fn at(self, spec: BodySpec, position: [f64; 2], velocity: [f64; 2]) -> BodySpec {
        BodySpec { position, velocity, ..made(spec, self.trial) }
    }

    /// Discs at rest in a row before the wall, and one that comes from behind with a speed, m/s.
    fn row(self, count: usize, speed: f64, before: f64, chance: &mut Chance) -> Vec<BodySpec> {
        let mut bodies = vec![self.wall()];
        let mut x = -0.5 * self.thickness - 0.051 - chance.between(0.0, 0.05);
        for index in 1..=count {
            let is_last = index == count;
            let density = if is_last && count == 2 { 10.0 } else { 1.0 };
            x -= if is_last { before } else { chance.between(0.0, 0.05) };
            let velocity = [if is_last { speed } else { 0.0 }, 0.0];
            let y = chance.between(-0.001, 0.001);
            bodies.push(BodySpec { density, ..self.at(small_disc(), [x, y], velocity) });
            x -= 0.1001;
        }
        bodies
    }

    /// A wall of tiles; the first in the middle.
    fn tiles(self) -> impl Iterator<Item = BodySpec> {
        let tile = block(self.thickness, 0.5);
        let heights = [0].into_iter().chain((-40..=40).filter(|&index| index != 0));
        heights.map(move |index| self.at(tile.clone(), [0.0, 0.5 * f64::from(index)], [0.0; 2]))
    }
}

fn world(kind: Thrown, thickness: f64, speed: f64, before: f64, trial: u32, chance: &mut Chance) -> World {
    let maker = Maker { trial, thickness };
    let (wall, half) = (maker.wall(), 0.5 * thickness);
    let mut side = |most: f64| chance.between(-most, most);
    let one = |bodies: Vec<BodySpec>| World { bodies, watched: vec![1], wall: 0, has_corner: false };
    match kind {
        Thrown::Alone(spec, spin) => {
            let (spec, angle, spin) = (spec(), side(3.0), side(spin));
            let x = -half - spec.outline.reach() - before;
            let thrown = maker.at(spec, [x, side(1.0)], [speed, 0.1 * speed * side(1.0)]);
            one(vec![wall, BodySpec { angle, spin, ..thrown }])
        }
        Thrown::Struck | Thrown::Row => {
            let count = if matches!(kind, Thrown::Row) { 10 } else { 2 };
            let bodies = maker.row(count, speed, before, chance);
            World { bodies, watched: (1..=count).collect(), wall: 0, has_corner: false }
        }
        Thrown::AtTiles => {
            let disc = maker.at(small_disc(), [-half - 0.05 - before, side(2.0)], [speed, 0.0]);
            let mut bodies: Vec<_> = maker.tiles().collect();
            bodies.insert(1, disc);
            one(bodies)
        }
        Thrown::IntoCorner => {
            let ceiling = maker.at(block(2.0 * HALF_HEIGHT, thickness), [0.0, half], [0.0; 2]);
            let (x, y) = (-half - 0.05 - before, -0.05 - before * (1.0 + 0.05 * side(1.0)));
            let disc = maker.at(small_disc(), [x, y], [speed * std::f64::consts::FRAC_1_SQRT_2; 2]);
            World { has_corner: true, ..one(vec![wall, disc, ceiling]) }
        }
        Thrown::MovingWall => {
            let wall = BodySpec { kind: Kind::Kinematic, velocity: [-speed, 0.0], ..wall };
            one(vec![wall, maker.at(small_box(), [-half - 0.08 - before, side(1.0)], [0.0; 2])])
        }
        Thrown::FreePlate => {
            let density = 4e4 / (thickness * 2.0 * HALF_HEIGHT);
            let plate = BodySpec { kind: Kind::Dynamic, density, ..wall };
            one(vec![plate, maker.at(small_disc(), [-half - 0.05 - before, side(0.5)], [speed, 0.0])])
        }
        Thrown::TwoBullets => {
            let bullet =
                |side: f64| maker.at(disc(half), [side * (half + before), 0.0], [-side * speed, 0.0]);
            one(vec![bullet(1.0), bullet(-1.0)])
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engines;

    #[test]
    fn a_slow_disc_does_not_pass_and_a_fast_one_does_where_nothing_is_swept() {
        const STRUCK: Throw = Throw { name: "struck", statement: "a disc", kind: Thrown::Struck };
        let (swept, discrete) = (engines::all().remove(0), engines::without_continuous());
        let count = |engine: &dyn Engine, speed: f64| {
            (0..WORLDS).filter(|&trial| passes(engine, &STRUCK, 0.01, speed, FINENESSES[2], trial)).count()
        };
        assert_eq!(count(swept.as_ref(), 1.0), 0);
        assert_eq!(count(swept.as_ref(), 300.0), 0);
        assert!(count(discrete.as_ref(), 300.0) > 0, "the trials are none");
    }
}
