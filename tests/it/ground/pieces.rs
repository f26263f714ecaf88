//! Bodies and ground divided into pieces with slanted faces between them: they are met as the outline that they are pieces of.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

use crate::support::{add, earth};

/// The deepest that a body overlaps something it touches, m, and the least that a normal of its contacts goes up.
fn worst_contact(world: &World, body: BodyId) -> (f32, f32) {
    let touching = world.contacts_of(body).filter(ContactRef::is_touching);
    touching.fold((0.0, 1.0), |(deepest, least), contact| {
        let depth = contact.points().iter().map(|point| -point.separation).fold(deepest, f32::max);
        (depth, contact.normal_on(body).y.min(least))
    })
}

/// The pieces of an L meet in a slanted face that ends at an outer corner, those of an arrow and a star in many. Thrown onto a floor at
/// every angle none is pushed down or aside, and none sinks in: a corner at 10 m/s goes no deeper than 4 cm in a quarter of a
/// tick.
#[test]
fn a_concave_body_is_borne_by_a_floor_at_every_angle() {
    let l = vec![[0.0_f32, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
    let arrow = vec![[0.0, 1.0], [-1.0, -1.0], [0.0, -0.4], [1.0, -1.0]];
    let star = (0..10).map(|corner| {
        let radius = if corner % 2 == 0 { 1.2 } else { 0.5 };
        let direction = Vec2::from_angle(corner as f32 * std::f32::consts::TAU / 10.0);
        [radius * direction.x, radius * direction.y]
    });
    for (name, outline) in [("L", l), ("arrow", arrow), ("star", star.collect())] {
        let pieces = Shape::concave(outline).unwrap();
        for (degrees, speed) in (0..360_u16).step_by(7).zip([0.0, 3.0, 6.0].into_iter().cycle()) {
            let mut world = earth();
            add(&mut world, Body::fixed(Shape::rectangle(200.0, 1.0)).at([0.0, -0.5]));
            let body = Body::dynamic_pieces(pieces.clone()).at([0.0, 4.0]);
            let body = add(&mut world, body.angle(f32::from(degrees).to_radians()).velocity([speed, 0.0]));
            for tick in 0..300 {
                world.step();
                let (depth, up) = worst_contact(&world, body);
                assert!(
                    depth < 0.04 && up > 0.99,
                    "{name}, {degrees}°, tick {tick}: {depth} m deep, {up} up"
                );
            }
            assert!(world.body(body).unwrap().position().y > 0.0, "{name}, {degrees}°");
        }
    }
}

/// Jagged ground of many pieces, most of which have faces that others cover: what falls onto it stays above it, and no contact is
/// deeper than two bodies go into each other in a quarter of a tick, at 10 m/s each.
#[test]
fn jagged_ground_is_met_where_it_is() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(39);
    let l = Shape::concave([[0.0, 0.0], [0.8, 0.0], [0.8, 0.3], [0.3, 0.3], [0.3, 0.8], [0.0, 0.8]]).unwrap();
    for ground in 0..20 {
        let top = (1..40).map(|place| [place as f32 * 0.5 - 10.0, random.random_range(0.0..2.0)]);
        let walls = [[10.0, 8.0], [10.5, 8.0], [10.5, -1.0], [-10.5, -1.0], [-10.5, 8.0], [-10.0, 8.0]];
        let pieces = Shape::concave(top.chain(walls)).unwrap();
        for is_round in [true, false] {
            let mut world = earth();
            add(&mut world, Body::fixed_pieces(pieces.clone()));
            let bodies: Vec<BodyId> = (0..12_u8)
                .map(|place| {
                    let body = if is_round {
                        Body::dynamic(Shape::circle(0.3))
                    } else {
                        Body::dynamic_pieces(l.clone())
                    };
                    let at = [-8.5 + 1.5 * f64::from(place), 4.5 + 2.0 * f64::from(place % 2)];
                    let velocity = [random.random_range(-2.0..2.0), 0.0];
                    add(&mut world, body.at(at).angle(random.random_range(0.0..6.0)).velocity(velocity))
                })
                .collect();
            for tick in 0..300 {
                world.step();
                for &body in &bodies {
                    let (depth, _) = worst_contact(&world, body);
                    assert!(depth < 0.1, "ground {ground}, {is_round}, tick {tick}: {depth} m deep");
                }
            }
            let lowest = bodies.iter().map(|&body| world.body(body).unwrap().position().y);
            assert!(lowest.fold(f32::INFINITY, f32::min) > 0.0, "ground {ground}, {is_round}");
        }
    }
}

/// A finely divided circle has pieces that are too thin for a shape: they are left out.
#[test]
fn a_fine_outline_has_only_pieces_that_a_body_takes() {
    for points in [3_000_u32, 7_000, 10_000] {
        let circle = (0..points).map(|point| {
            let direction = Vec2::from_angle(point as f32 * std::f32::consts::TAU / points as f32);
            direction * 20.0
        });
        let pieces = Shape::concave(circle).unwrap();
        let area: f32 = pieces.iter().map(Shape::area).sum();
        let exact = std::f32::consts::PI * 400.0;
        assert!((area / exact - 1.0).abs() < 1e-4, "{points} points: {area} m²");
        let mut world = earth();
        assert!(world.add(Body::dynamic_pieces(pieces)).is_ok(), "{points} points");
    }
}
