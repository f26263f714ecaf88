//! A body that does not turn gained up to 0.08 % of its speed in each bounce on its flat side: both points respond as one, and
//! the matrix of their responses, cut to be one that can be inverted, asked for too much of both.

use rustycs::prelude::*;

use crate::support::{G, add, assert_relative, earth, place, space, velocity};

/// Bodies with their half heights, m.
fn bodies() -> [(&'static str, Body, f64); 7] {
    let upright = Shape::obb(0.02, 2.0);
    let hexagon = Shape::polygon([
        [0.5, 0.0],
        [0.25, 0.433],
        [-0.25, 0.433],
        [-0.5, 0.0],
        [-0.25, -0.433],
        [0.25, -0.433],
    ]);
    [
        ("disc", Body::dynamic(Shape::circle(0.5)), 0.5),
        ("box", Body::dynamic(Shape::obb(1.0, 1.0)), 0.5),
        ("aabb", Body::dynamic(Shape::aabb(1.0, 1.0)), 0.5),
        ("fixed rotation", Body::dynamic(Shape::obb(1.0, 1.0)).fixed_rotation(true), 0.5),
        ("heavy aabb", Body::dynamic(Shape::aabb(3.0, 0.4)).density(10.0), 0.2),
        ("hexagon", Body::dynamic(hexagon.unwrap()).fixed_rotation(true), 0.433),
        ("needle on end", Body::dynamic(upright), 1.0),
    ]
}

/// e = 1: the height over a hundred bounces, v²/(2 g) above where it is, to 0.1 %: 1e-5 of the speed in each of them.
#[test]
fn an_elastic_body_keeps_its_height_for_a_hundred_bounces_whether_it_turns_or_not() {
    for (name, body, half_height) in bodies() {
        for drop in [0.1, 1.0, 10.0] {
            let mut world = earth();
            add(
                &mut world,
                Body::fixed(Shape::aabb(20.0, 2.0)).at([0.0, -1.0]).friction(0.0).restitution(1.0),
            );
            let id =
                add(&mut world, body.clone().at([0.3, half_height + drop]).friction(0.0).restitution(1.0));
            let (mut bounces, mut last) = (0, 0.0);
            while bounces < 100 {
                world.step();
                let speed = velocity(&world, id)[1];
                bounces += u32::from(last < 0.0 && speed > 0.0);
                last = speed;
                assert!(world.ticks() < 200_000, "{name}: {bounces} bounces");
            }
            let height = place(&world, id)[1] - half_height + last * last / (2.0 * G);
            assert_relative(height, drop, 1e-3, &format!("{name} from {drop} m: height"));
        }
    }
}

/// The same between two plates, without gravity, at a speed that nothing but the bounces changes; and between two bodies that
/// both do not turn.
#[test]
fn an_elastic_body_keeps_its_speed_between_two_plates() {
    for (name, body, half_height) in bodies() {
        let mut world = space();
        for y in [-4.5, 4.5] {
            add(&mut world, Body::fixed(Shape::aabb(10.0, 1.0)).at([0.0, y]).restitution(1.0).friction(0.0));
        }
        let id = add(&mut world, body.at([-0.9, 0.9]).velocity([0.0, 25.0]).restitution(1.0).friction(0.0));
        // A way of 2 (4 - half height) each.
        let seconds = 100.0 * (8.0 - 2.0 * half_height) / 25.0;
        for _ in 0..(60.0 * seconds) as u32 {
            world.step();
        }
        assert_relative(velocity(&world, id)[1].abs(), 25.0, 5e-4, &format!("{name}: speed"));
    }
}
