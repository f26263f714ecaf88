//! The place of a hit was no number where the square of its impulse is beyond f32, as of a disc of 10¹⁵ kg that a triangle and a wall stop.

use rustycs::prelude::*;

use crate::support::add;

#[test]
fn what_great_masses_hit_is_told_with_a_place() {
    for mass in [1e12_f32, 1e14, 3e14, 1e15] {
        for speed in [1e3_f32, 1e4, 1e5] {
            let mut world = World::default();
            let disc = Body::dynamic(Shape::circle(31.6)).at([-31.91, 79.7]).mass(mass).restitution(0.0);
            add(&mut world, disc.velocity([speed, -speed]).friction(0.5));
            let corners = [[0.0, 0.0], [31.6, 0.0], [9.5, 25.3]];
            let triangle = Body::kinematic(Shape::polygon(corners).unwrap()).at([28.81, 73.66]);
            add(&mut world, triangle.angle(0.641).friction(1.0));
            let wall = Body::fixed(Shape::rectangle(31.6, 316_000.0)).at([85.3, 61.3]);
            add(&mut world, wall.angle(-0.868_773).friction(1.0));
            let mut hits = 0;
            for _ in 0..3 {
                world.step();
                for hit in world.events().hits() {
                    let told =
                        [hit.point.x, hit.point.y, f64::from(hit.speed), f64::from(hit.normal_impulse)];
                    assert!(told.into_iter().all(f64::is_finite), "{hit:?}");
                    hits += 1;
                }
            }
            assert!(hits > 0, "{mass} kg at {speed} m/s");
        }
    }
}
