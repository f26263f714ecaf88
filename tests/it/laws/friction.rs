//! Sliding, sticking, rolling.

use rustycs::prelude::*;

use crate::support::{G, add, add_floor, assert_near, assert_relative, earth, place, run, spin, velocity};

/// The deceleration is µ g, so the way is v²/(2µg). The normal force of a box whose friction acts below its
/// centre shifts to the front, but its sum is the weight.
#[test]
fn a_sliding_box_stops_after_its_speed_squared_over_two_mu_g() {
    let mut world = earth();
    add_floor(&mut world, 0.4);
    let sliding = Body::dynamic(Shape::obb(1.0, 0.5)).at([0.0, 0.25]).velocity([5.0, 0.0]);
    let sliding = add(&mut world, sliding.friction(0.4).restitution(0.0));
    run(&mut world, 4.0);
    assert_relative(place(&world, sliding)[0], 25.0 / (2.0 * 0.4 * G), 1e-3, "way");
    assert_near(velocity(&world, sliding)[0], 0.0, 1e-4, "speed after it stopped");
}

/// The same of a plank that bears 10,000 times its weight, which is solved directly, on surfaces that stick better than any of use. It stops within a
/// substep of h = 1/240 s: the way is off by v h at most.
#[test]
fn what_is_solved_directly_stops_after_its_speed_squared_over_two_mu_g() {
    for friction in [0.5_f32, 2.0, 10.0, 20.0] {
        let mut world = earth();
        add(&mut world, Body::fixed(Shape::aabb(400.0, 2.0)).at([0.0, -1.0]).friction(friction));
        // So long that none tips over as it brakes.
        let plank =
            |y: f64| Body::dynamic(Shape::obb(40.0, 0.2)).at([0.0, y]).friction(friction).restitution(0.0);
        let planks = [(0.1, 1.0), (0.3, 1e4)].map(|(y, mass)| add(&mut world, plank(y).mass(mass)));
        run(&mut world, 0.4);
        let start = place(&world, planks[0])[0];
        for id in planks {
            world.body_mut(id).unwrap().set_velocity([5.0, 0.0]);
        }
        world.step();
        assert_eq!(world.body(planks[0]).unwrap().tier(), Tier::Direct);
        run(&mut world, 3.0);
        let expected = 25.0 / (2.0 * f64::from(friction) * G);
        assert_near(place(&world, planks[0])[0] - start, expected, 5.0 / 240.0, "way");
    }
}

/// A ramp of 20 degrees, tan 20° = 0.364, and a box on it.
fn box_on_ramp(friction: f32) -> (World, BodyId, [f64; 2]) {
    let mut world = earth();
    let angle = 20.0_f64.to_radians();
    let (down, normal) = ([-angle.cos(), -angle.sin()], [-angle.sin(), angle.cos()]);
    let ramp = Body::fixed(Shape::obb(100.0, 2.0)).angle(angle as f32).at([-normal[0], -normal[1]]);
    add(&mut world, ramp.friction(friction).restitution(0.0));
    let resting = Body::dynamic(Shape::obb(1.0, 0.5)).angle(angle as f32);
    let resting = resting.at([0.25 * normal[0] + 20.0 * angle.cos(), 0.25 * normal[1] + 20.0 * angle.sin()]);
    let id = add(&mut world, resting.friction(friction).restitution(0.0));
    (world, id, down)
}

fn way_along([x0, y0]: [f64; 2], [x, y]: [f64; 2], [dx, dy]: [f64; 2]) -> f64 {
    (x - x0) * dx + (y - y0) * dy
}

/// It is set down without impulses to start from: the first substep finds friction to within the compliance of 14 %, and
/// what is missing of g sin makes a way of h²/2 of it, before and after the box has found its place across the slope:
/// 2 · 0.14 · 3.4 · (1/240)²/2 = 8 µm.
#[test]
fn a_box_sticks_when_the_slope_is_below_the_friction_angle() {
    let (mut world, id, down) = box_on_ramp(0.5);
    let start = place(&world, id);
    run(&mut world, 10.0);
    assert_near(way_along(start, place(&world, id), down), 0.0, 1e-5, "creep in 10 s");
}

#[test]
fn a_box_slides_when_the_slope_exceeds_the_friction_angle() {
    let (mut world, id, down) = box_on_ramp(0.2);
    let start = place(&world, id);
    run(&mut world, 2.0);
    let angle = 20.0_f64.to_radians();
    let acceleration = G * (angle.sin() - 0.2 * angle.cos());
    assert_relative(way_along(start, place(&world, id), down), acceleration * 2.0, 1e-3, "way in 2 s");
}

/// From rest, too, and near the friction angle, where what the first substep gets wrong would show for good:
/// v = g (sin - µ cos) t at 20 degrees, tan 20° = 0.364 and µ = 0.33. The rest is `f32` rounding of 240 kicks a
/// second of 1e-7 of a speed below 1 m/s.
#[test]
fn a_box_set_on_a_slope_starts_with_its_friction() {
    let (mut world, id, down) = box_on_ramp(0.33);
    run(&mut world, 1.0);
    let angle = 20.0_f64.to_radians();
    let acceleration = G * (angle.sin() - 0.33 * angle.cos());
    let speed = way_along([0.0, 0.0], velocity(&world, id), down);
    assert_relative(speed, acceleration, 1e-3, "speed after 1 s");
}

/// 0 on one side is enough: what has no friction keeps its speed on whatever it slides on, and to whatever slides on it.
#[test]
fn what_has_no_friction_slides_on_everything() {
    for [of_floor, of_box] in [[0.9, 0.0], [0.0, 0.9]] {
        let mut world = earth();
        add_floor(&mut world, of_floor);
        let sliding = Body::dynamic(Shape::obb(1.0, 0.5)).at([0.0, 0.25]).velocity([5.0, 0.0]);
        let sliding = add(&mut world, sliding.friction(of_box).restitution(0.0));
        run(&mut world, 4.0);
        // Gravity acts across; of a speed that nothing changes no digit is lost.
        assert_eq!(velocity(&world, sliding)[0], 5.0, "speed");
        assert_near(place(&world, sliding)[0], 20.0, 1e-5, "way");
    }
}

/// A player without friction who presses against a wall falls as if it were not there: v = g t.
#[test]
fn what_has_no_friction_falls_freely_along_a_wall_that_it_is_pressed_against() {
    let mut world = earth();
    add(&mut world, Body::fixed(Shape::aabb(1.0, 400.0)).at([1.0, 0.0]));
    let player = Body::dynamic(Shape::obb(1.0, 2.0)).fixed_rotation(true).mass(60.0).friction(0.0);
    let player = add(&mut world, player.restitution(0.0));
    for _ in 0..60 {
        world.body_mut(player).unwrap().apply_force([2000.0, 0.0]);
        world.step();
    }
    let [across, along] = velocity(&world, player);
    // It closes a gap of two roundings of 1 m within a substep.
    assert_near(across, 0.0, 2.0 * 1.2e-7 * 240.0, "speed into the wall");
    assert_relative(along, -G, 1e-6, "speed along it after 1 s");
}

/// A disc that rolls down without slipping has a = g sin / (1 + I/mr²) = 2/3 g sin.
#[test]
fn a_disc_rolls_with_two_thirds_of_the_slope_and_does_not_slip() {
    let mut world = earth();
    let angle = 10.0_f64.to_radians();
    let (down, normal) = ([-angle.cos(), -angle.sin()], [-angle.sin(), angle.cos()]);
    let ramp = Body::fixed(Shape::obb(100.0, 2.0)).angle(angle as f32).at([-normal[0], -normal[1]]);
    add(&mut world, ramp.friction(0.6).restitution(0.0));
    let start = [0.5 * normal[0] + 20.0 * angle.cos(), 0.5 * normal[1] + 20.0 * angle.sin()];
    let disc =
        Body::dynamic(Shape::circle(0.5)).at(start).friction(0.6).restitution(0.0).rolling_resistance(0.0);
    let disc = add(&mut world, disc);
    run(&mut world, 2.0);
    let acceleration = 2.0 / 3.0 * G * angle.sin();
    assert_relative(way_along(start, place(&world, disc), down), acceleration * 2.0, 1e-3, "way in 2 s");
    let speed = way_along([0.0, 0.0], velocity(&world, disc), down);
    assert_relative(speed, acceleration * 2.0, 1e-3, "speed");
    assert_relative(spin(&world, disc) * 0.5, speed, 1e-3, "speed of the rim");
}

/// A disc set down sliding at v₀ rolls at 2/3 v₀, whatever the friction.
#[test]
fn a_sliding_disc_ends_up_rolling_at_two_thirds_of_its_speed() {
    let mut world = earth();
    add_floor(&mut world, 0.3);
    let disc =
        Body::dynamic(Shape::circle(0.5)).at([-50.0, 0.5]).velocity([6.0, 0.0]).rolling_resistance(0.0);
    let disc = add(&mut world, disc.friction(0.3).restitution(0.0));
    run(&mut world, 3.0);
    assert_relative(velocity(&world, disc)[0], 4.0, 1e-3, "speed");
    assert_relative(-spin(&world, disc) * 0.5, 4.0, 1e-3, "speed of the rim");
}

/// A kinematic belt under a box drags it along at µ g until both move alike.
#[test]
fn a_moving_floor_drags_what_lies_on_it() {
    let mut world = earth();
    let belt = Body::kinematic(Shape::aabb(100.0, 1.0)).at([0.0, -0.5]).velocity([2.0, 0.0]);
    add(&mut world, belt.friction(0.5).restitution(0.0));
    let load = Body::dynamic(Shape::obb(1.0, 0.5)).at([0.0, 0.25]).friction(0.5).restitution(0.0);
    let load = add(&mut world, load);
    run(&mut world, 2.0);
    let time_to_speed = 2.0 / (0.5 * G);
    assert_relative(velocity(&world, load)[0], 2.0, 1e-3, "speed");
    assert_relative(place(&world, load)[0], 2.0 * (2.0 - time_to_speed / 2.0), 1e-3, "way");
}
