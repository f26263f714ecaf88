//! A body that left the bounds in the step in which its neighbour fell asleep kept a contact with it.

use rustycs::prelude::*;

use crate::support::add;

/// A disc leaves the bounds beside one that falls asleep, sooner or later or in the same step; their boxes overlap, but they
/// are out of reach of each other.
#[test]
fn what_leaves_the_bounds_has_no_contact_with_what_falls_asleep_beside_it() {
    let edge = 0.8;
    let bounds = Some(Aabb::new(Vec2::splat(-5.0), Vec2::new(edge as f32, 5.0)));
    for steps in 25..45 {
        let mut world = World::new(Settings { bounds, ..Settings::default() });
        let disc = Body::dynamic(Shape::circle(0.5));
        let sleeper = add(&mut world, disc.at([0.0, 0.0]));
        let speed = 0.06;
        let start = edge - (f64::from(steps) - 0.5) / 60.0 * speed;
        let passing = Body::dynamic(Shape::circle(0.5)).at([start, 0.75]).velocity([speed as f32, 0.0]);
        let passing = add(&mut world, passing);
        for _ in 0..60 {
            world.step();
            world.validate().unwrap();
        }
        assert!(world.body(passing).is_none() && world.body(sleeper).unwrap().is_sleeping());
        assert_eq!(world.profile().counters().pairs, 0, "{steps} steps");
    }
}
