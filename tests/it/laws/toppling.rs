//! A body that turns over its corner.

use rustycs::prelude::*;

use crate::support::{G, add, assert_relative, earth_with};

/// Width and height of the plank, m.
const PLANK: [f64; 2] = [0.4, 2.0];

/// Seconds in which a plank turns over its lower corner, from the lean `start` to `end` (rad, of its centre from
/// above the corner): φ'' = g d sin φ / (k² + d²), a pendulum upside down, by small steps of the midpoint rule.
fn exact_time(start: f64, end: f64) -> f64 {
    let square = PLANK[0] * PLANK[0] + PLANK[1] * PLANK[1];
    let (arm, inertia) = (0.5 * square.sqrt(), square / 12.0 + square / 4.0);
    let acceleration = |angle: f64| G * arm * angle.sin() / inertia;
    let (mut angle, mut rate, mut time, step) = (start, 0.0, 0.0, 1e-5);
    while angle < end {
        let middle = angle + 0.5 * step * rate;
        let middle_rate = rate + 0.5 * step * acceleration(angle);
        rate += step * acceleration(middle);
        angle += step * middle_rate;
        time += step;
    }
    time
}

/// The corner sinks in by leak·g·h/(2·bias rate) = 1e-4 m, a two-hundredth of the lean of 0.02 m at the start,
/// which time makes e^(λt): 1/200 of 1/λ = 0.4 s is 2e-3 s of 1.8. The tick in which the plank passes is
/// interpolated.
#[test]
fn a_plank_topples_in_the_time_of_a_pendulum_upside_down() {
    for (tick_rate, substeps) in [(60.0, 4), (240.0, 8)] {
        let mut world = earth_with(Settings { tick_rate, substeps, ..Settings::default() });
        let floor = Body::fixed(Shape::aabb(20.0, 2.0)).at([0.0, -1.0]);
        add(&mut world, floor.friction(5.0).restitution(0.0));
        let (start, end) = (0.02_f64, 1.2_f64);
        let diagonal = (PLANK[0] / PLANK[1]).atan();
        let arm = 0.5 * PLANK[0].hypot(PLANK[1]);
        let plank = Body::dynamic(Shape::obb(PLANK[0] as f32, PLANK[1] as f32));
        let plank = plank.at([arm * start.sin(), arm * start.cos()]).angle(-(start + diagonal) as f32);
        let plank = add(&mut world, plank.friction(5.0).restitution(0.0));
        let lean = |world: &World| -f64::from(world.body(plank).unwrap().angle()) - diagonal;
        let mut before = lean(&world);
        let time = loop {
            world.step();
            let now = lean(&world);
            if now >= end {
                break world.time() - (now - end) / (now - before) / f64::from(tick_rate);
            }
            before = now;
            assert!(world.time() < 5.0, "still leaning by {now} rad");
        };
        assert_relative(time, exact_time(start, end), 5e-3, "time to topple");
    }
}
