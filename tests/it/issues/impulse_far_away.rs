//! An impulse or a force on a body that had flown as far as a body can be put, or farther, was refused, though no place was
//! given.

use rustycs::prelude::*;

use crate::support::{add, run, velocity};

/// Farthest place that can be given, m, and that a body can get to.
const FARTHEST: f64 = 1e12;

#[test]
fn what_flew_as_far_as_it_can_is_pushed_as_anything_else() {
    let mut world = World::new(Settings { max_speed: 1e6, ..Settings::default() });
    let body = Body::dynamic(Shape::circle(0.5)).at([FARTHEST, 0.0]).velocity([1e6, 0.0]).mass(2.0);
    let id = add(&mut world, body);
    run(&mut world, 0.2);
    let mut body = world.body_mut(id).unwrap();
    let place = Point::from(body.view().position_f64());
    assert_eq!(place.x, FARTHEST);
    body.apply_impulse([0.0, 4.0]);
    body.apply_force([0.0, 240.0]);
    // A place that is given is looked at as ever.
    let beyond = Point::new(1.1 * FARTHEST, 0.0);
    if !cfg!(debug_assertions) {
        body.apply_impulse_at([0.0, 4.0], beyond).apply_force_at([0.0, 4.0], beyond);
    }
    world.step();
    assert_eq!(world.events().refused().len(), if cfg!(debug_assertions) { 0 } else { 2 });
    // 4 N s and 240 N for 1/60 s on 2 kg: numbers that f32 adds without rounding by more than a digit.
    let [_, up] = velocity(&world, id);
    assert!((up - 4.0).abs() < 4.0 * f64::from(f32::EPSILON), "{up} m/s");
}
