//! The friction of a blow began the next substep where the box had turned on by a radian, and was taken back after the move, along a surface
//! that lay another way: small boxes left a wall with up to 800 times the energy that they came with.

use rustycs::prelude::*;

use crate::support::add;

/// The largest energy of a box after it was thrown at a wall, as a share of that with which it was.
fn energy_at_a_wall(settings: Settings, box_: Body) -> f64 {
    let mut world = World::new(settings);
    add(&mut world, Body::fixed(Shape::aabb(0.2, 400.0)));
    add(&mut world, box_);
    let start = world.kinetic_energy();
    let energies = (0..30).map(|_| {
        world.step();
        world.kinetic_energy()
    });
    energies.fold(0.0, f64::max) / start
}

#[test]
fn small_boxes_that_hit_a_wall_gain_no_energy() {
    for (substeps, tick_rate) in [(2, 20.0), (2, 60.0), (4, 60.0)] {
        for (size, friction) in [(0.01_f32, 0.6), (0.05, 0.6), (0.01, 1.5), (0.05, 1.5)] {
            for number in 0..750_u16 {
                let (throw, number) = (f32::from(number % 150), f32::from(number / 150));
                let speed = [5.0, 10.0, 20.0, 50.0, 100.0][number as usize];
                let velocity = [speed * (0.1 + 0.006 * throw), speed * (1.0 - 0.006 * throw)];
                let box_ = Body::dynamic(Shape::obb(size, size))
                    .at([-0.3 - f64::from(size) - 0.0071 * f64::from(throw), 0.0])
                    .angle(0.021 * throw)
                    .velocity(velocity)
                    .friction(friction);
                let settings = Settings { substeps, tick_rate, ..Settings::default() };
                let energy = energy_at_a_wall(settings, box_);
                // A thousand roundings of `f32`.
                assert!(energy < 1.0001, "{size} m, µ {friction}, {velocity:?}: {energy} times the energy");
            }
        }
    }
}
