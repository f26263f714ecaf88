//! A disc and a box overlapped two plates that left them no room. No impulses part them all, and friction let those of many
//! sweeps grow by a factor each, to infinity: the places were not numbers after one step, and a debug build panicked.

use rustycs::prelude::*;

use crate::support::add;

#[test]
fn impulses_stay_finite_where_friction_wedges_bodies_between_plates() {
    for block_solve in [true, false] {
        for [iterations, relax_iterations] in [[1000, 1], [1000, 1000]] {
            let mut world =
                World::new(Settings { iterations, relax_iterations, block_solve, ..Settings::default() });
            add(&mut world, Body::fixed(Shape::aabb(20.0, 1.0)).at([0.0, -0.5]));
            add(&mut world, Body::fixed(Shape::obb(4.0, 1.0)).at([0.0, 0.6]).angle(-0.3));
            add(&mut world, Body::dynamic(Shape::circle(0.3)).at([0.4, 0.2]).mass(1.0));
            add(&mut world, Body::dynamic(Shape::obb(0.6, 0.4)).at([1.0, 0.0]).angle(0.5).mass(1.0));
            for _ in 0..60 {
                world.step();
                world.validate().unwrap();
            }
        }
    }
}
