//! Queries against brute force over all bodies.

mod filtered;

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::collision::detect;
use rustycs::prelude::*;

use crate::support::{add, assert_near};

type Random = Xoshiro256PlusPlus;

fn random_shape(random: &mut Random) -> Shape {
    let (width, height) = (random.random_range(0.1..2.0_f32), random.random_range(0.1..2.0_f32));
    match random.random_range(0..7_u32) {
        0 => Shape::circle(0.5 * width),
        1 => Shape::aabb(width, height),
        2 => Shape::obb(width, height),
        3 => Shape::capsule([0.3, 0.0], [0.3 - 0.5 * width, 0.5 * height], 0.4 * width),
        4 => Shape::segment([0.0, 0.0], [width, height]),
        5 => Shape::rounded([[0.0, 0.0], [width, 0.0], [0.5 * width, height]], 0.2 * height).unwrap(),
        _ => Shape::polygon([[0.0, 0.0], [width, 0.0], [1.2 * width, height], [0.3 * width, 1.4 * height]])
            .unwrap(),
    }
}

/// Bodies of every shape and type within 10 m of a middle, some overlapping, and their ids.
fn crowd(random: &mut Random, middle: [f64; 2]) -> (World, Vec<BodyId>) {
    let mut world = World::new(Settings::default());
    let ids = (0..120)
        .map(|number| {
            let shape = random_shape(random);
            let body = match number % 5 {
                0 => Body::fixed(shape),
                1 => Body::kinematic(shape),
                _ if shape.thickness() == 0.0 => Body::kinematic(shape),
                _ => Body::dynamic(shape),
            };
            let at = somewhere(random, middle, 10.0);
            let velocity = [random.random_range(-5.0..5.0_f32), random.random_range(-5.0..5.0_f32)];
            let angle = random.random_range(-3.0..3.0_f32);
            add(&mut world, body.at(at).angle(angle).velocity(velocity).angular_velocity(angle))
        })
        .collect();
    (world, ids)
}

fn somewhere(random: &mut Random, [x, y]: [f64; 2], reach: f64) -> [f64; 2] {
    [x + random.random_range(-reach..reach), y + random.random_range(-reach..reach)]
}

fn bodies_at_by_looking_at_all(world: &World, at: [f64; 2]) -> Vec<BodyId> {
    let mut found: Vec<BodyId> =
        world.bodies().filter(|(_, body)| body.contains(at)).map(|(id, _)| id).collect();
    found.sort_unstable();
    found
}

fn bodies_in_by_looking_at_all(world: &World, min: [f64; 2], max: [f64; 2]) -> Vec<BodyId> {
    let region = Shape::aabb((max[0] - min[0]) as f32, (max[1] - min[1]) as f32);
    let pose = Pose::at([0.5 * (min[0] + max[0]), 0.5 * (min[1] + max[1])]);
    let mut found: Vec<BodyId> = world
        .bodies()
        .filter(|(_, body)| detect(&region, pose, body.shape(), body.pose()).is_some())
        .map(|(id, _)| id)
        .collect();
    found.sort_unstable();
    found
}

/// Fraction and body of every hit, nearest first.
fn ray_hits_by_looking_at_all(world: &World, from: [f64; 2], along: [f32; 2]) -> Vec<(f32, BodyId)> {
    let mut hits: Vec<(f32, BodyId)> = world
        .bodies()
        .filter_map(|(id, body)| {
            body.shape().ray_cast(body.pose(), from, along, 1.0).map(|hit| (hit.fraction, id))
        })
        .collect();
    hits.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    hits
}

/// Asks 100 random questions of each kind and compares; returns how many bodies were found.
fn compare_all(world: &World, random: &mut Random, middle: [f64; 2]) -> usize {
    let mut found = 0;
    for _ in 0..100 {
        let at = somewhere(random, middle, 10.0);
        let here = world.bodies_at(at);
        assert_eq!(here, bodies_at_by_looking_at_all(world, at));

        let max = [at[0] + random.random_range(0.1..8.0), at[1] + random.random_range(0.1..8.0)];
        let inside = world.bodies_in(at, max);
        assert_eq!(inside, bodies_in_by_looking_at_all(world, at, max));

        let to = somewhere(random, [0.0, 0.0], 15.0);
        let along = [to[0] as f32, to[1] as f32];
        let expected = ray_hits_by_looking_at_all(world, at, along);
        let all = world.ray_cast_all(at, along);
        let ours: Vec<(f32, BodyId)> = all.iter().map(|hit| (hit.fraction, hit.body)).collect();
        assert_eq!(ours, expected);
        assert_eq!(world.ray_cast(at, along), all.first().copied());
        found += here.len() + inside.len() + all.len();
    }
    found
}

fn compare_through_a_life(middle: [f64; 2]) {
    let mut random = Random::seed_from_u64(5);
    let (mut world, ids) = crowd(&mut random, middle);
    let found = compare_all(&world, &mut random, middle);
    assert!(found > 500, "only {found} found: a test of nothing");
    for _ in 0..3 {
        for _ in 0..20 {
            world.step();
        }
        compare_all(&world, &mut random, middle);
    }
    for &id in ids.iter().step_by(3) {
        world.body_mut(id).unwrap().set_position(somewhere(&mut random, middle, 10.0)).unwrap();
        world.body_mut(id).unwrap().set_angle(random.random_range(-3.0..3.0_f32)).unwrap();
    }
    compare_all(&world, &mut random, middle);
    for &id in ids.iter().step_by(2) {
        assert!(world.remove(id).is_some());
    }
    compare_all(&world, &mut random, middle);
    world.step();
    compare_all(&world, &mut random, middle);
}

#[test]
fn queries_agree_with_looking_at_all_bodies() {
    compare_through_a_life([0.0, 0.0]);
}

/// There the boxes of the broad phase are rounded to 6 cm; the answers are not.
#[test]
fn queries_agree_a_thousand_kilometres_from_the_origin() {
    compare_through_a_life([1e6, -1e6]);
}

/// At 10⁹ m a box is rounded to 64 m: everything is everything's neighbour, and the answers are the same.
#[test]
fn queries_agree_a_million_kilometres_from_the_origin() {
    compare_through_a_life([-1e9, 1e9]);
}

#[test]
fn a_ray_meets_the_outline_where_geometry_says() {
    let mut world = World::new(Settings::default());
    let far = 1e6;
    let ball = add(&mut world, Body::fixed(Shape::circle(0.5)).at([far + 5.0, 0.0]));
    let crate_ = add(&mut world, Body::dynamic(Shape::obb(2.0, 2.0)).at([far + 10.0, 0.0]));
    let hits = world.ray_cast_all([far, 0.0], [20.0, 0.0]);
    let [first, second] = [hits[0], hits[1]];
    assert_eq!((hits.len(), first.body, second.body), (2, ball, crate_));
    // 4.5 and 9 of 20 m; the fraction is an f32.
    assert_near(first.point.x - far, 4.5, 20.0 * f64::from(f32::EPSILON), "where it meets the ball");
    assert_near(second.point.x - far, 9.0, 20.0 * f64::from(f32::EPSILON), "where it meets the box");
    assert_eq!([first.normal, second.normal], [Vec2::new(-1.0, 0.0); 2]);
    // Too short by a centimetre; from inside; from behind.
    assert_eq!(world.ray_cast([far, 0.0], [4.49, 0.0]), None);
    let inside = world.ray_cast([far + 5.2, 0.1], [1.0, 0.0]).unwrap();
    assert_eq!((inside.body, inside.fraction, inside.normal), (ball, 0.0, Vec2::ZERO));
    assert_eq!(world.ray_cast([far, 0.0], [-20.0, 0.0]), None);
}

/// Equal shapes in one place are hit at one fraction, and the first is the one that was there first, wherever
/// the ray comes from.
#[test]
fn of_bodies_hit_at_once_the_one_with_the_smallest_id_is_the_first() {
    let mut world = World::new(Settings::default());
    let shape = Shape::aabb(2.095_361_2, 1.376_537);
    let first = add(&mut world, Body::fixed(shape));
    for _ in 0..4 {
        add(&mut world, Body::fixed(shape));
    }
    for i in 0..1000 {
        let Rot { c, s } = Rot::from_angle(0.006_283 * i as f32);
        let distance = 1.3 + 0.0037 * f64::from(i);
        let from = [distance * f64::from(c), distance * f64::from(s)];
        let hit = world.ray_cast(from, [-10.0 * c, -10.0 * s]).unwrap();
        assert_eq!(hit.body, first, "from {from:?}");
        assert_eq!(world.ray_cast_all(from, [-10.0 * c, -10.0 * s]).len(), 5);
    }
}

/// A box that only shares the bounding box of a disc does not find it, however thin or large it is.
#[test]
fn a_box_finds_shapes_and_not_their_bounding_boxes() {
    let mut world = World::new(Settings::default());
    let disc = add(&mut world, Body::fixed(Shape::circle(1.0)));
    // (0.8, 0.8) is 1.13 from the centre.
    for size in [0.0, 1e-7, 0.01, 1.0, 1e7, 1e9, 1e300] {
        let max = 0.8 + size;
        assert_eq!(world.bodies_in([0.8, 0.8], [max, max]), [], "beside, {size} m");
        assert_eq!(world.bodies_in([0.6, 0.6], [0.6 + size, 0.6 + size]), [disc], "inside, {size} m");
    }
    assert_eq!(world.bodies_in([0.8, 0.8], [0.8, 9.0]), [], "a line beside");
    assert_eq!(world.bodies_in([-5.0, 0.0], [5.0, 0.0]), [disc], "a line through");
    assert_eq!(world.bodies_in([-1e300, -1e300], [1e300, 1e300]), [disc], "everything");
}
