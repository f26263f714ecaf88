//! Belts that sort crates by their material.

use rustycs::{Body, BodyId, Filter, Material, Settings, Shape, World};

use crate::mark::{Label, Mark};
use crate::parts::{put, put_floor, regular_polygon, world_with_gravity};
use crate::{Scene, View};

/// Belts that sort crates by their material.
pub const SCENE: Scene = Scene {
    name: "conveyor",
    group: "machines",
    summary: "The second belt lets metal through, the third stone, and rubber goes on to the end: each in its own bin.",
    view: View::above(-1.0, -2.0, 20.0, 9.5),
    build,
    before_tick: Some(feed),
    readout: Some(readout),
    is_about_names: true,
    labels: &LABELS,
    ..Scene::PLAIN
};

/// What is sorted, in the order of the bins.
const KINDS: [Material; 3] = [Material::METAL, Material::STONE, Material::RUBBER];
const LABELS: [Label; 3] = [
    Label::painted("metal", [150, 170, 190]),
    Label::painted("stone", [190, 160, 110]),
    Label::painted("rubber", [210, 90, 90]),
];
/// The category of each kind.
const CATEGORIES: [u64; 3] = [1 << 1, 1 << 2, 1 << 3];

/// Left ends of the bins and the right end of the last, m, and the height of their walls.
const BINS: [f32; 4] = [-6.0, -2.0, 2.0, 6.0];
const WALL: f32 = 3.0;
/// Height of the first belt, m. Each lies a little lower than the one before: flush pieces are one ground only where they bear the
/// same, so that what comes over would meet the side of the next.
const BELT: f32 = 5.0;
const DROP: f32 = 0.05;
/// m/s.
const SPEED: f32 = 1.5;
/// Crates in all, and ticks from one to the next.
const CRATES: u64 = 36;
const INTERVAL: u64 = 80;
/// Where crates come from, m.
const SPOUT: [f64; 2] = [-10.4, 5.5];

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    put_floor(&mut world, 24.0, 1.0);
    for x in BINS {
        put(&mut world, Body::fixed(Shape::aabb(0.3, WALL)).at([x, 0.5 * WALL]).material(Material::STONE));
    }
    let ends = [-11.0, BINS[0], BINS[1], BINS[2]];
    for (number, pair) in ends.windows(2).enumerate() {
        let (length, middle) = (pair[1] - pair[0], 0.5 * (pair[0] + pair[1]));
        // The first bears all; after it, each lets one kind through.
        let mask = number.checked_sub(1).map_or(u64::MAX, |passing| !CATEGORIES[passing]);
        let belt = Body::fixed(Shape::aabb(length, 0.3)).at([middle, BELT - 0.15 - DROP * number as f32]);
        let belt = belt.material(Material::PLASTIC).surface_speed(SPEED);
        put(&mut world, belt.filter(Filter { mask, ..Filter::DEFAULT }));
    }
    world
}

/// Brings one crate after the other, and the first again when all are there.
fn feed(world: &mut World) {
    let ticks = world.ticks();
    if !ticks.is_multiple_of(INTERVAL) {
        return;
    }
    let (number, round) = (ticks / INTERVAL % CRATES, ticks / INTERVAL / CRATES);
    let part = number as usize;
    let crate_ = world.bodies().find(|&(_, body)| Mark::of(body).part == Some(part)).map(|(id, _)| id);
    match crate_ {
        None if round == 0 => _ = put(world, new_crate(part)),
        None => (),
        Some(id) => bring_back(world, id),
    }
}

/// The crate of this number: the three kinds in a mixed order, and every third crate with six sides.
fn new_crate(number: usize) -> Body {
    let kind = number * 7 / 5 % KINDS.len();
    let shape = if number.is_multiple_of(3) { regular_polygon(6, 0.4) } else { Shape::rectangle(0.6, 0.6) };
    let body = Body::dynamic(shape).at(SPOUT).material(KINDS[kind]).restitution(0.1);
    let body = body.filter(Filter { category: CATEGORIES[kind], ..Filter::DEFAULT });
    Mark { label: Some(kind), part: Some(number) }.on(body)
}

fn bring_back(world: &mut World, id: BodyId) {
    if let Some(mut body) = world.body_mut(id) {
        // Numbers of a scene are within what a body can be given.
        _ = body.set_position(SPOUT);
        _ = body.set_angle(0.0);
        body.set_velocity([0.0, 0.0]).set_angular_velocity(0.0);
    }
}

/// How many crates are in the bin of their kind, and how many in another.
fn readout(world: &World) -> String {
    let (mut sorted, mut astray) = ([0; 3], 0);
    for (_, body) in world.bodies() {
        let (Mark { label: Some(kind), part: Some(_) }, place) = (Mark::of(body), body.position()) else {
            continue;
        };
        if place.y < WALL {
            if (BINS[kind]..BINS[kind + 1]).contains(&place.x) { sorted[kind] += 1 } else { astray += 1 }
        }
    }
    let [metal, stone, rubber] = sorted;
    format!("{metal} of metal, {stone} of stone, {rubber} of rubber in their bins; {astray} astray")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;

    #[test]
    fn every_crate_comes_into_the_bin_of_its_kind() {
        let mut world = SCENE.build(1, Settings::default());
        run(&SCENE, &mut world, 45 * 60);
        let text = readout(&world);
        assert!(text.ends_with("; 0 astray"), "{text}");
        let counts: Vec<u32> = text.split(' ').filter_map(|word| word.parse().ok()).collect();
        assert!(counts[..3].iter().all(|&count| count >= 6), "{text}");
    }
}
