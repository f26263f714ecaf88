//! Forces that depend on where a body is, given by the caller before each tick.
//!
//! Place x and velocity v of a body on a spring go through a linear map M from tick to tick, with a = (ω dt)². For such a map
//! q = -M₂₁ x² + (M₁₁ - M₂₂) x v + M₁₂ v², which is the energy up to a constant and terms of dt, grows by det M per tick.

use rustycs::prelude::*;

use crate::support::{add, assert_relative, space};

/// 2 Hz, rad/s.
const OMEGA: f64 = 4.0 * core::f64::consts::PI;
const TICK: f64 = 1.0 / 60.0;
const A: f64 = (OMEGA * TICK) * (OMEGA * TICK);

/// By what q has grown after so many seconds, of a body of 1 kg that begins at 1 m at rest; `mixed` is M₁₁ - M₂₂.
fn growth(seconds: f64, mixed: f64, pull: fn(&mut BodyMut<'_>, Vec2)) -> f64 {
    let mut world = space();
    let ball = Body::dynamic(Shape::circle(0.1)).at([1.0, 0.0]).mass(1.0);
    let ball = add(&mut world, ball);
    for _ in 0..(seconds / TICK).round() as u32 {
        world.advance_with(TICK, |world| {
            let mut ball = world.body_mut(ball).unwrap();
            let force = ball.position() * (-OMEGA * OMEGA) as f32;
            pull(&mut ball, force);
        });
    }
    let ball = world.body(ball).unwrap();
    let [x, v] = [ball.position_f64()[0], f64::from(ball.velocity().x)];
    let q = |x: f64, v: f64| A / TICK * x * x + mixed * x * v + TICK * v * v;
    q(x, v) / q(1.0, 0.0)
}

/// v -= ω² dt x, then x += v dt: M = ((1 - a, dt), (-a/dt, 1)), det M = 1, for ever. In 3600 ticks roundings of half a digit
/// of x and v add up to no more than 3600 ε.
#[test]
fn a_spring_by_impulses_before_each_tick_keeps_its_energy() {
    let growth = growth(60.0, -A, |ball, force| _ = ball.apply_impulse(force * TICK as f32));
    assert_relative(growth, 1.0, 3600.0 * f64::from(f32::EPSILON), "growth in a minute");
}

/// Held over the tick a force is late by half of one, as the documentation warns: x += v dt - a x/2, v -= ω² dt x, so that
/// M = ((1 - a/2, dt), (-a/dt, 1)) and det M = 1 + a/2. The swing grows by its root, like exp(ω² dt t/4).
#[test]
fn a_spring_by_forces_held_over_the_tick_grows() {
    let growth = growth(5.0, -0.5 * A, |ball, force| _ = ball.apply_force(force));
    assert_relative(growth, (1.0 + 0.5 * A).powi(300), 300.0 * f64::from(f32::EPSILON), "growth in 5 s");
}
