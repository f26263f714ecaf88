//! A body that turns over its corner.

use std::f64::consts::PI;

use rustycs::collision::{ManifoldPoint, detect};
use rustycs::prelude::*;
use rustycs::world::ContactRef;

use crate::support::{G, add, add_floor, assert_near, assert_relative, earth, earth_with, place, run, spin};

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

/// The corner sinks in by compliance·g·h/(2·bias rate) = 1e-4 m, a two-hundredth of the lean of 0.02 m at the start,
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

/// The same from 2e-5 rad, for the time in which that becomes fifty times as much: φ = φ₀ cosh λt with λ² = g d/(k² + d²). At
/// first, for λt up to 1.3, the plank is slower than what is taken for standing still, which must not hold it up: then its
/// arm holds still within a step and is late by half of it, which is λ dt/2 tanh λt = 2 % of its growth at most and makes
/// 0.8 % of the lean. The start is rounded by half a digit, 6e-8 rad or 0.3 % of it.
#[test]
fn a_plank_that_all_but_stands_on_its_corner_is_not_held_up() {
    let mut world = earth();
    add_floor(&mut world, 5.0);
    let start = 2e-5_f64;
    let diagonal = (PLANK[0] / PLANK[1]).atan();
    let arm = 0.5 * PLANK[0].hypot(PLANK[1]);
    let plank = Body::dynamic(Shape::obb(PLANK[0] as f32, PLANK[1] as f32));
    let plank = plank.at([arm * start.sin(), arm * start.cos()]).angle(-(start + diagonal) as f32);
    let plank = add(&mut world, plank.friction(5.0).restitution(0.0));
    let square = PLANK[0] * PLANK[0] + PLANK[1] * PLANK[1];
    let rate = (G * arm / (square / 3.0)).sqrt();
    let time = 50_f64.acosh() / rate;
    run(&mut world, time);
    let lean = -f64::from(world.body(plank).unwrap().angle()) - diagonal;
    assert_relative(lean, start * (rate * world.time()).cosh(), 1.1e-2, "how far it leans");
}

/// A domino that is tipped with 1.2 times the energy that lifts its centre over its edge goes over it, and slowly: what
/// decides is the arm of the weight, half its width and less with every degree. About the edge φ'' = -g c sin(φ₀ -
/// φ)/k² with the distance c of the centre, k² = (w² + h²)/3 and φ₀ = atan(w/h). At the top it still has the square
/// root of 0.2/1.2 of its speed. In the first step both corners touch, and the arm of the weight holds still while the
/// centre goes over it: h/2 · 1.16 rad/s · 1/120 s = 2.4 mm of 50 mm or 5 %, so that 5 % of 5.7 rad/s² · 1/60 s are
/// lost, 0.4 % of the speed, which are 0.8 % of the energy, 5 % of the sixth of it that is left at the top, and 2.4 %
/// of the speed.
#[test]
fn a_domino_goes_over_its_edge_with_the_energy_it_was_given() {
    let (width, height) = (0.1, 0.5);
    let (c, square) = (0.5 * f64::hypot(width, height), (width * width + height * height) / 3.0);
    let speed = (2.0 * 1.2 * G * (c - 0.5 * height) / square).sqrt();
    let mut world = earth();
    add_floor(&mut world, 0.4);
    let domino = Body::dynamic(Shape::obb(width as f32, height as f32)).at([0.0, 0.5 * height]).friction(0.4);
    let domino = domino.velocity([(0.5 * height * speed) as f32, (0.5 * width * speed) as f32]);
    let domino = add(&mut world, domino.angular_velocity(-speed as f32).restitution(0.0));
    let mut slowest = f64::INFINITY;
    // The top is after 0.33 s.
    for _ in 0..30 {
        world.step();
        slowest = slowest.min(-spin(&world, domino));
    }
    assert_relative(slowest, speed * (0.2_f64 / 1.2).sqrt(), 0.03, "speed at the top");
}

/// Length and thickness of a ladder, m, and its angle from the floor, rad.
const LADDER: [f64; 3] = [2.0, 0.05, PI / 3.0];

/// A ladder on one corner that leans on a smooth wall with another, and the wall.
fn ladder() -> (World, BodyId, BodyId) {
    let [length, thickness, angle] = LADDER;
    let (sin, cos) = angle.sin_cos();
    let mut world = earth();
    add_floor(&mut world, 0.5);
    let wall = add(&mut world, Body::fixed(Shape::aabb(1.0, 10.0)).at([0.5, 5.0]).friction(0.0));
    let center = [-0.5 * (length * cos + thickness * sin), 0.5 * (length * sin + thickness * cos)];
    let ladder = Body::dynamic(Shape::obb(length as f32, thickness as f32)).at(center).angle(angle as f32);
    let ladder = add(&mut world, ladder.friction(0.5).restitution(0.0));
    (world, ladder, wall)
}

/// The contact of the wall.
fn contact_of(world: &World, wall: BodyId) -> ContactRef<'_> {
    let is_its = |contact: &ContactRef<'_>| [contact.a(), contact.b()].contains(&wall);
    world.contacts().find(is_its).expect("the ladder touches the wall")
}

/// About the foot of a ladder of length L and thickness t the weight has the arm (L cos θ - t sin θ)/2 and the wall's
/// force N the arm L sin θ. What gives way at both ends, 0.14 · 4 g h/(28/s) = 0.8 mm each as k is at most four over
/// the mass, turns it by 0.8 mm/(L sin θ) = 5e-4 and changes cot θ = 0.58 by 0.1 % of it for each. Nothing creeps while
/// it stands: rounding of 1e-7 of a kick of 0.02 m/s, always to the same side, would make 0.04 µm of 20 s.
#[test]
fn a_ladder_leans_on_the_wall_with_the_force_that_balances_its_weight() {
    let (mut world, ladder, wall) = ladder();
    let [length, thickness, angle] = LADDER;
    let (sin, cos) = angle.sin_cos();
    let weight = f64::from(world.body(ladder).unwrap().mass()) * G;
    let expected = 0.5 * weight * (length * cos - thickness * sin) / (length * sin);
    run(&mut world, 5.0);
    let early = place(&world, ladder);
    for _ in 0..20 {
        run(&mut world, 1.0);
        let points = contact_of(&world, wall).points();
        let impulse = points.iter().map(|point| f64::from(point.normal_impulse)).sum::<f64>();
        assert_relative(impulse * 240.0, expected, 2e-3, "force on the wall");
    }
    for (late, early) in place(&world, ladder).into_iter().zip(early) {
        assert_near(late, early, 1e-6, "place after 20 s more");
    }
}

/// The contacts of a ladder at rest are followed from step to step. A wall that is pushed into it by 0.1 mm, less than
/// what rests may move, is felt at once: where the step ends they say what detection finds, to rounding of 1 m.
#[test]
fn a_contact_that_is_followed_feels_that_a_body_is_moved_by_hand() {
    let (mut world, _, wall) = ladder();
    run(&mut world, 5.0);
    let [x, y] = place(&world, wall);
    world.body_mut(wall).unwrap().set_position([x - 1e-4, y]).unwrap();
    world.step();
    let deepest =
        |points: &[ManifoldPoint]| points.iter().map(|p| p.separation).fold(f32::INFINITY, f32::min);
    let contact = contact_of(&world, wall);
    let [a, b] = [contact.a(), contact.b()].map(|id| world.body(id).unwrap());
    let found = detect(a.shape(), a.pose(), b.shape(), b.pose()).expect("they overlap");
    assert_near(
        deepest(contact.points()).into(),
        deepest(found.points()).into(),
        1e-6,
        "overlap with the wall",
    );
}
