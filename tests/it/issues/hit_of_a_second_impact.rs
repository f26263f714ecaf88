//! A rock of 1 t that fell at 8.2 m/s on a resting body of 1 kg was reported as a hit of 16.4 m/s: between rock and floor the
//! body bounced to and fro within the tick, and the fastest of these impacts was told.

use rustycs::prelude::*;

use crate::support::{add, run};

#[test]
fn a_hit_has_the_speed_of_the_first_approach() {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    add(&mut world, Body::fixed(Shape::rectangle(20.0, 1.0)).at([0.0, -0.5]));
    let pig = add(&mut world, Body::dynamic(Shape::circle(0.5)).at([0.0, 0.5]).mass(1.0));
    run(&mut world, 1.0);
    let (speed, gap) = (8.2, 0.5);
    let rock =
        Body::dynamic(Shape::circle(1.0)).at([0.0, 2.0 + gap]).velocity([0.0, -speed as f32]).mass(1e3);
    let rock = add(&mut world, rock);
    let mut speeds = Vec::new();
    for _ in 0..6 {
        world.step();
        let hits = world.events().hits().iter().filter(|hit| hit.other(rock) == Some(pig));
        speeds.extend(hits.map(|hit| f64::from(hit.speed)));
    }
    // Gravity goes on until they meet. The pig is supported at the end of a substep, and falls freely until then: that is worth
    // g h at most.
    let expected = f64::sqrt(speed * speed + 2.0 * 9.81 * gap);
    let freely = 9.81 / 240.0;
    assert_eq!(speeds.len(), 1, "{speeds:?} m/s");
    assert!((speeds[0] - expected).abs() < freely, "{speeds:?} m/s, expected {expected}");
}
