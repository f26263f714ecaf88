//! Pieces of every kind that lie flush are one ground, whatever is below their tops, and whether they move alike or not at all.

use rustycs::prelude::*;

use super::chains::{height_of, shapes};
use crate::support::{add, earth, earth_with, place, velocity};

/// Greatest speed upwards that a seam may give, m/s.
const KICK: f64 = 1e-3;

/// Largest change of speed, as a share of it.
const LOSS: f64 = 1e-4;

fn polygon(corners: &[[f32; 2]]) -> Body {
    let shape = Shape::polygon(corners.iter().copied()).unwrap();
    let Shape::Polygon(polygon) = shape else { unreachable!("a polygon") };
    Body::fixed(Shape::Polygon(polygon)).at(polygon.centroid_of_input())
}

/// Pieces of ground whose top goes from one x to another at a height of 0, m.
type Piece = fn([f32; 2]) -> Body;

/// One of each kind, by name.
fn pieces() -> Vec<(&'static str, Piece)> {
    vec![
        ("box", |[from, to]| Body::fixed(Shape::rectangle(to - from, 1.0)).at([0.5 * (from + to), -0.5])),
        ("plank", |[from, to]| Body::fixed(Shape::rectangle(to - from, 0.02)).at([0.5 * (from + to), -0.01])),
        ("kinematic box", |[from, to]| {
            Body::kinematic(Shape::rectangle(to - from, 0.7)).at([0.5 * (from + to), -0.35])
        }),
        ("undercut polygon", |[from, to]| {
            polygon(&[[from, 0.0], [from + 0.3, -1.0], [to - 0.8, -1.0], [to, 0.0]])
        }),
        ("chain", |[from, to]| {
            Ground::chain([[from, 0.0], [0.4 * from + 0.6 * to, 0.0], [to, 0.0]]).unwrap()
        }),
        ("ring", |[from, to]| Ground::ring([[from, 0.0], [to, 0.0], [to, -1.0], [from, -1.0]]).unwrap()),
        ("arch", |[from, to]| {
            let at = |share: f32| from + share * (to - from);
            let legs = [[from, -1.0], [at(0.3), -1.0], [at(0.5), -0.3], [at(0.7), -1.0], [to, -1.0]];
            Body::fixed_pieces(
                Shape::concave([[from, 0.0]].into_iter().chain(legs).chain([[to, 0.0]])).unwrap(),
            )
        }),
        ("tiles with holes", |[from, to]| {
            let size = (to - from) / 20.0;
            let solid: Vec<bool> = (0..60).map(|tile| tile >= 40 || tile % 4 != 1 && tile % 3 != 2).collect();
            Ground::from_tiles(&solid, 20, size).at([from, -3.0 * size])
        }),
    ]
}

/// What slides, by name, and its place above the ground, m. The last is an L that lies on its long side: both its pieces meet the ground.
fn movers() -> Vec<(&'static str, Body, f64)> {
    let corners = [[0.0, 0.0], [0.6, 0.0], [0.6, 0.18], [0.18, 0.18], [0.18, 0.5], [0.0, 0.5]];
    let l = Body::dynamic_pieces(Shape::concave(corners).unwrap());
    let simple = shapes().map(|(name, shape)| (name, Body::dynamic(shape), height_of(&shape)));
    simple.into_iter().chain([("L", l, 0.0)]).collect()
}

/// Lets a body slide from a place along x without friction; returns its greatest upward speed and its velocity along x at the end, m/s.
fn slide(world: &mut World, (mover, height): (Body, f64), x: f64, speed: f32) -> [f64; 2] {
    let id = add(world, mover.at([x, height]).velocity([speed, 0.0]).friction(0.0).restitution(0.0));
    let mut kick = 0.0_f64;
    for _ in 0..(7.0 / speed.abs() * 60.0) as u32 {
        world.step();
        kick = kick.max(velocity(world, id)[1]);
    }
    [kick, velocity(world, id)[0]]
}

#[test]
fn pieces_of_every_kind_are_one_ground() {
    let kinds = pieces();
    for (first, left) in &kinds {
        for (second, right) in &kinds {
            for (name, mover, height) in movers() {
                for (x, speed) in [(-3.0, 4.0), (2.5, -4.0)] {
                    let mut world = earth_with(Settings::default());
                    for ground in [left([-5.0, 0.0]), right([0.0, 5.0])] {
                        add(&mut world, ground.friction(0.0).restitution(0.0));
                    }
                    let [kick, vx] = slide(&mut world, (mover.clone(), height), x, speed);
                    let what = format!("{name} at {speed} m/s from {first} to {second}");
                    assert!(kick <= KICK, "{what}: kicked up at {kick:e} m/s");
                    assert!((1.0 - vx / f64::from(speed)).abs() <= LOSS, "{what}: {vx} m/s at the end");
                }
            }
        }
    }
}

/// Waggons of a train that goes on at 2 m/s, and a lift that comes up beside a floor.
#[test]
fn kinematic_bodies_that_move_alike_are_one_ground() {
    for (name, mover, height) in movers() {
        let mut world = earth();
        for number in 0..12_i8 {
            let waggon = Body::kinematic(Shape::rectangle(1.0, 0.5)).at([f64::from(number) - 6.0, -0.25]);
            add(&mut world, waggon.velocity([2.0, 0.0]).friction(0.0).restitution(0.0));
        }
        let [kick, vx] = slide(&mut world, (mover.clone(), height), -5.0, 3.0);
        assert!(kick <= KICK && (vx - 3.0).abs() <= 3.0 * LOSS, "{name}: {kick:e} m/s up, {vx} m/s");
    }
}

#[test]
fn a_lift_that_has_come_up_beside_a_floor_is_flush_with_it() {
    for (name, mover, height) in movers() {
        let mut world = earth();
        let floor = Body::fixed(Shape::rectangle(6.0, 1.0)).at([3.0, -0.5]);
        add(&mut world, floor.friction(0.0).restitution(0.0));
        let lift = Body::kinematic(Shape::rectangle(6.0, 0.5)).at([-3.0, -1.25]);
        let lift = add(&mut world, lift.friction(0.0).restitution(0.0));
        for _ in 0..60 {
            let next = place(&world, lift)[1] + 1.0 / 60.0;
            world.body_mut(lift).unwrap().move_to(Pose::at([-3.0, next]));
            world.step();
        }
        let [kick, vx] = slide(&mut world, (mover.clone(), height), -3.0, 3.0);
        assert!(kick <= KICK && (vx - 3.0).abs() <= 3.0 * LOSS, "{name}: {kick:e} m/s up, {vx} m/s");
    }
}

/// A plate that goes on within a floor, its top level with that of the floor: its end is inside all the time, and pushes nothing.
#[test]
fn a_plate_that_slides_within_a_floor_moves_nothing_on_it() {
    for (floor, depth) in [("a deep floor", 1.0), ("a shallow floor", 0.5)] {
        for speed in [0.5, 3.0, 10.0] {
            for (name, mover, height) in movers() {
                let mut world = earth();
                let slab = Body::fixed(Shape::rectangle(40.0, depth)).at([0.0, -0.5 * f64::from(depth)]);
                add(&mut world, slab.friction(0.0).restitution(0.0));
                let plate = Body::kinematic(Shape::rectangle(2.8, 0.4)).at([-2.5, -0.2]);
                add(&mut world, plate.velocity([speed, 0.0]).friction(0.0).restitution(0.0));
                let [kick, vx] = slide(&mut world, (mover.clone(), height), 0.0, 2.0);
                let what = format!("{name} on {floor}, plate at {speed} m/s");
                assert!(kick <= KICK && (vx - 2.0).abs() <= 2.0 * LOSS, "{what}: {kick:e} m/s up, {vx} m/s");
            }
        }
    }
}

/// Two pieces that meet at an angle δ, and a chain of the same two lines: what slides from one to the other comes out alike. The blow of a
/// bend takes v (1 - cos δ), 0.02 m/s at the largest; both ends of a body may take it in one tick or in two.
#[test]
fn bends_between_pieces_are_as_those_of_a_chain() {
    for bend in [-0.1_f32, -0.03, -0.001, 0.001, 0.03, 0.1] {
        let turned = |body: Body| body.angle(bend);
        let slab = |x: f64| Body::fixed(Shape::rectangle(6.0, 1.0)).at([x, -0.5]);
        let Rot { c, s } = Rot::from_angle(bend);
        let center = [f64::from(3.0 * c + 0.5 * s), f64::from(3.0 * s - 0.5 * c)];
        let line = Shape::segment([-3.0, 0.0], [3.0, 0.0]);
        let slope = turned(Body::fixed(line)).at([f64::from(3.0 * c), f64::from(3.0 * s)]);
        let chain = Ground::chain([[-6.0, 0.0], [0.0, 0.0], [6.0 * c, 6.0 * s]]).unwrap();
        let grounds = [
            ("a chain", vec![chain]),
            ("two boxes", vec![slab(-3.0), turned(slab(0.0)).at(center)]),
            ("a box and a segment", vec![slab(-3.0), slope]),
        ];
        for (name, mover, height) in movers() {
            let mut expected = f64::NAN;
            for (ground, bodies) in &grounds {
                let mut world = earth_with(Settings::default());
                for body in bodies {
                    add(&mut world, body.clone().friction(0.0).restitution(0.0));
                }
                let [_, vx] = slide(&mut world, (mover.clone(), height), -3.0, 4.0);
                if expected.is_nan() {
                    expected = vx;
                }
                assert!(
                    (vx - expected).abs() <= 0.04,
                    "{name}, {bend} rad, {ground}: {vx} m/s of {expected}"
                );
            }
        }
    }
}

/// Put into a line by less than a quarter of the width of its pieces, and moving out of it, at rest or into it: it is borne, as by a box.
#[test]
fn what_is_put_a_little_too_low_is_borne_by_a_chain() {
    for (name, mover, height) in movers() {
        for depth in [0.001, 0.01, 0.02, 0.04] {
            for speed in [-0.3, 0.0, 0.05, 0.3, 1.0] {
                let mut world = earth();
                add(&mut world, Ground::chain([[-5.0, 0.0], [5.0, 0.0]]).unwrap());
                let id = add(&mut world, mover.clone().at([0.3, height - depth]).velocity([0.0, speed]));
                for _ in 0..120 {
                    world.step();
                }
                let [_, y] = place(&world, id);
                assert!(y > 0.0, "{name}, {depth} m too low, at {speed} m/s: came to {y} m");
            }
        }
    }
}
