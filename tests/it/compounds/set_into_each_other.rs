//! Bodies of several shapes that are set into each other part, and hardly any faster than they are pushed.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

/// Overlapping bodies are pushed apart no faster than this, m/s.
const PUSH_SPEED: f32 = 3.0;

/// A disc on a stick through it.
fn lollipop() -> Body {
    Body::dynamic(Shape::circle(0.3)).with(Collider::new(Shape::obb(0.1, 0.9)).at([0.0, -0.3]))
}

/// A cross of two bars.
fn cross() -> Body {
    Body::dynamic(Shape::obb(0.8, 0.2)).with(Collider::new(Shape::obb(0.2, 0.8)))
}

/// Nothing else acts on them, and nothing bounces. Where no point of a body of mass m moves about its centre, nor the centre, faster than
/// with the speed v of a push, its energy is at most m v², as its moment of inertia is at most m r². They came to a hundred times as
/// much.
#[test]
fn two_of_them_part_without_a_bang() {
    for seed in 0..60 {
        for (tick_rate, substeps) in [(60.0, 4), (60.0, 16), (240.0, 4)] {
            let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
            let mut world = World::new(Settings { tick_rate, substeps, ..Settings::default() });
            let make = [lollipop, cross][seed as usize % 2];
            let mut mass = 0.0;
            for _ in 0..2 {
                let at = [random.random_range(-0.3_f32..0.3), random.random_range(-0.1..0.1)];
                let angle = random.random_range(0.0_f32..6.0);
                let id = world.add(make().at(at).angle(angle).restitution(0.0)).unwrap();
                mass = f64::from(world.body(id).unwrap().mass());
            }
            let most = 2.0 * mass * f64::from(PUSH_SPEED).powi(2);
            for tick in 0..(2.0 * tick_rate) as u32 {
                world.step();
                let energy = world.energy();
                assert!(energy <= most, "seed {seed}, {tick_rate} Hz x {substeps}, tick {tick}: {energy} J");
            }
        }
    }
}

/// However small they are: what is 3 cm across parts as well.
#[test]
fn small_ones_part_too() {
    let cross = || Body::dynamic(Shape::obb(0.03, 0.006)).with(Collider::new(Shape::obb(0.006, 0.03)));
    for [x, y] in [[0.004_f32, 0.003], [0.012, 0.0], [0.002, -0.007]] {
        let mut world = World::default();
        for place in [[0.0, 0.0], [x, y]] {
            world.add(cross().at(place).angle(10.0 * y).restitution(0.0)).unwrap();
        }
        for _ in 0..300 {
            world.step();
        }
        let deepest = world.contacts().flat_map(|contact| contact.points().to_vec());
        let deepest = deepest.map(|point| -point.separation).fold(0.0, f32::max);
        // No deeper than what is not deep, a tenth of their width: the area of the two bars over the length.
        let width = 2.0 * 0.03 * 0.006 / 0.0306;
        assert!(deepest <= 0.1 * width, "{deepest} m of {width} m at {x}, {y}");
    }
}

/// Ten in one place above the floor: of ten in a row, each pushed away from the next, the outer ones have 9/2 of the speed of a push; and
/// they fall from the top of the heap. They came to 44 m/s.
#[test]
fn ten_of_them_part_without_a_bang() {
    for (name, make) in [("lollipop", lollipop as fn() -> Body), ("cross", cross)] {
        for seed in 0..4 {
            let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
            let mut world = World::default();
            world.add_force(Force::EARTH_GRAVITY);
            world.add(Body::fixed(Shape::aabb(60.0, 1.0)).at([0.0, -0.5])).unwrap();
            for _ in 0..10 {
                let at = [random.random_range(-0.7_f32..0.7), random.random_range(0.8..1.2)];
                let angle = random.random_range(0.0_f32..6.0);
                world.add(make().at(at).angle(angle).restitution(0.0)).unwrap();
            }
            let highest =
                |world: &World| world.bodies().map(|(_, body)| body.aabb().max.y).fold(0.0, f32::max);
            let mut top = highest(&world);
            for tick in 0..300 {
                world.step();
                top = top.max(highest(&world));
                let most = (2.0 * 9.81 * top).sqrt() + 4.5 * PUSH_SPEED;
                for (_, body) in world.bodies() {
                    let speed = body.velocity().length();
                    assert!(speed <= most, "{name}, seed {seed}, tick {tick}: {speed} m/s");
                }
            }
        }
    }
}

/// A disc with eight teeth.
fn gear() -> Body {
    (0..8_u8).fold(Body::dynamic(Shape::circle(0.4)), |gear, tooth| {
        let angle = f32::from(tooth) * core::f32::consts::FRAC_PI_4;
        let Rot { c, s } = Rot::from_angle(angle);
        gear.with(Collider::new(Shape::obb(0.2, 0.12)).at([0.48 * c, 0.48 * s]).angle(angle))
    })
}

/// A square with a square hole.
fn frame() -> Body {
    let square = |half: f32| [[-half, -half], [half, -half], [half, half], [-half, half]];
    Body::dynamic_pieces(Shape::with_holes(square(0.5), [square(0.35)]).unwrap())
}

/// Five of them are squeezed between each other, and some snap out of a knot. All but one in twenty crowds stay below the energy that
/// they have if each goes at the speed of a push; one in ten did not, and the worst of 60 had 28 times as much.
#[test]
fn five_of_them_part_without_a_bang_but_for_few() {
    let mut fast = 0;
    for seed in 0..60 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut world = World::default();
        let mut mass = 0.0;
        for _ in 0..5 {
            let make = [lollipop, cross, gear, frame][random.random_range(0..4_usize)];
            let at = [random.random_range(-0.56_f32..0.56), random.random_range(-0.56..0.56)];
            let id =
                world.add(make().at(at).angle(random.random_range(0.0_f32..6.0)).restitution(0.0)).unwrap();
            mass += f64::from(world.body(id).unwrap().mass());
        }
        let mut most = 0.0_f64;
        for _ in 0..240 {
            world.step();
            most = most.max(world.energy());
        }
        fast += u32::from(most > mass * f64::from(PUSH_SPEED).powi(2));
    }
    assert!(fast <= 3, "{fast} of 60");
}
