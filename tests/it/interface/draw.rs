//! A world as lines.

use rustycs::prelude::*;

use crate::support::{add, add_floor, assert_near, earth, run, unit_box};

#[test]
fn a_world_is_drawn_as_outlines_contacts_and_joints() {
    let mut world = earth();
    add_floor(&mut world, 0.6);
    let box_ = add(&mut world, unit_box(3.0, 0.5));
    let disc = add(&mut world, Body::dynamic(Shape::circle(0.5)).at([-3.0, 5.0]).angle(0.5));
    add(&mut world, Body::fixed(Shape::rectangle(1.0, 1.0)).at([0.0, 9.0]).sensor(true));
    world.add_joint(Joint::rope(disc, None).at([-3.0, 8.0]).max_length(9.0)).unwrap();
    run(&mut world, 0.5);
    let mut lines: Vec<(DrawnPart, Point, Point)> = Vec::new();
    world.draw_lines(1.0, |part, from, to| lines.push((part, from, to)));
    let of = |wanted: DrawnPart| lines.iter().filter(move |line| line.0 == wanted);

    assert_eq!((of(DrawnPart::Body(BodyType::Fixed)).count(), of(DrawnPart::Sensor).count()), (4, 4));
    // The outline is closed, on the body, and as long as it is: of the box 4 m, of 24 chords of the disc 24 · 2 r sin(π/24).
    for (id, length, first) in [(box_, 4.0, 0), (disc, 24.0 * (std::f64::consts::PI / 24.0).sin(), 1)] {
        let center: Point = world.body(id).unwrap().pose().center;
        let near = of(DrawnPart::Body(BodyType::Dynamic)).filter(|line| line.1.distance(center) < 1.0);
        let outline: Vec<_> = near.skip(first).collect();
        let way: f64 = outline.iter().map(|line| line.1.distance(line.2)).sum();
        assert_near(way, length, 1e-5, "length of the outline");
        for (number, line) in outline.iter().enumerate() {
            assert_eq!(line.2, outline[(number + 1) % outline.len()].1, "it is closed");
        }
    }
    // The box stands on two points, with normals that show up.
    let contacts: Vec<_> = of(DrawnPart::Contact).collect();
    assert_eq!(contacts.len(), 2);
    assert!(contacts.iter().all(|line| line.1.y.abs() < 1e-3 && (line.2.y - line.1.y).abs() > 0.1));
    assert_eq!(of(DrawnPart::Joint).count(), 1);
}

/// A rope over two wheels is drawn by way of them.
#[test]
fn the_rope_of_a_pulley_is_drawn_over_its_wheels() {
    let mut world = World::new(Settings::default());
    let [a, b] = [-2.0, 2.0].map(|x| add(&mut world, unit_box(x, 0.0)));
    world.add_joint(Joint::pulley(a, b, [-1.0, 5.0], [1.0, 5.0])).unwrap();
    let mut way = Vec::new();
    world.draw_lines(1.0, |part, from, to| {
        if part == DrawnPart::Joint {
            way.push([from.x, from.y, to.x, to.y]);
        }
    });
    assert_eq!(way, [[-2.0, 0.0, -1.0, 5.0], [-1.0, 5.0, 1.0, 5.0], [1.0, 5.0, 2.0, 0.0]]);
}

/// Between two ticks things are drawn in between.
#[test]
fn what_moves_is_drawn_between_two_ticks() {
    let mut world = World::new(Settings::default());
    add(&mut world, Body::dynamic(Shape::aabb(1.0, 1.0)).velocity([6.0, 0.0]));
    world.step();
    for (alpha, x) in [(0.0, 0.0), (0.5, 0.05), (1.0, 0.1)] {
        let (mut sum, mut count) = (0.0, 0.0);
        world.draw_lines(alpha, |_, from, _| (sum, count) = (sum + from.x, count + 1.0));
        assert_near(sum / count, x, 1e-7, "the middle of its corners");
    }
}
