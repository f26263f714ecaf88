//! A manifold that is kept while bodies turn told of an overlap that was not there, or let a second corner through.

use rustycs::prelude::*;
use rustycs::{ContactRef, ManifoldPoint};

use crate::support::{add, earth};

/// By how much the overlap that the touching contact tells of is not what detection finds, m, over 60 steps at most; of a
/// world with one contact.
fn largest_error_of_overlap(world: &mut World) -> f32 {
    let (mut compared, mut largest) = (0, 0.0);
    for _ in 0..60 {
        world.step();
        let Some(contact) = world.contacts().find(ContactRef::is_touching) else { continue };
        let [a, b] = [contact.a(), contact.b()].map(|id| world.body(id).unwrap());
        let found = rustycs::collision::detect(a.shape(), a.pose(), b.shape(), b.pose());
        let deepest =
            |points: &[ManifoldPoint]| points.iter().map(|point| -point.separation).fold(0.0, f32::max);
        let found = found.map_or(0.0, |manifold| deepest(manifold.points()));
        largest = f32::max(largest, (deepest(contact.points()) - found).abs());
        compared += 1;
    }
    assert!(compared > 40, "they touched for {compared} steps");
    largest
}

/// A board that turns rises under what slides along it: l sin θ at a distance of l, with a normal of an angle θ ago. The
/// overlap that a contact tells of misses at most a hundredth of the width of the thinner body, the box.
#[test]
fn a_contact_on_a_turning_board_tells_of_the_overlap_that_is_there() {
    let width = 0.3;
    for spin in [-1.0, -0.5] {
        let mut world = earth();
        let board = Body::kinematic(Shape::obb(4.0, 0.4)).friction(0.0).angular_velocity(spin);
        let (c, s) = (f64::cos(0.3), f64::sin(0.3));
        add(&mut world, board.angle(0.3));
        let up = 0.2 + 0.5 * f64::from(width);
        let sliding = Body::dynamic(Shape::obb(width, width)).at([-s * up, c * up]).angle(0.3);
        add(&mut world, sliding.friction(0.0).restitution(0.0));
        let error = largest_error_of_overlap(&mut world);
        assert!(error <= 0.01 * width, "{error} m");
    }
}

/// So does a box that topples over one corner, which is followed from step to step, until another comes down: on a board
/// at rest and on one that turns with it.
#[test]
fn a_corner_that_is_followed_lets_no_other_through() {
    let width = 0.6;
    for (spin, angle) in [(0.0, 0.6), (0.4, 0.6), (-0.4, 0.6), (0.0, -0.3), (0.4, -0.3), (-0.4, -0.3)] {
        let mut world = earth();
        add(&mut world, Body::kinematic(Shape::obb(4.0, 0.4)).friction(1.0).angular_velocity(spin));
        let up = 0.2 + 0.5 * f64::from(width) * (f64::cos(angle) + f64::sin(angle.abs()));
        let toppling = Body::dynamic(Shape::obb(width, width)).at([0.0, up]).angle(angle as f32);
        add(&mut world, toppling.friction(1.0).restitution(0.0));
        let error = largest_error_of_overlap(&mut world);
        assert!(error <= 0.01 * width, "{error} m, {spin} rad/s, {angle} rad");
    }
}
