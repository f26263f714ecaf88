//! Scenes in which other engines let things through, lose time, or stop what should pass.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

use crate::support::{add, assert_near, assert_relative, earth, place, space, spin, velocity};

/// A box of 4 m x 10 cm and one as a thin triangle, thrown down at 100 m/s with any spin up to 50 rad/s, onto ground of a
/// centimetre with a post of 20 cm on it.
#[test]
fn a_skinny_box_thrown_at_a_thin_floor_with_a_post_stays_above() {
    let sliver = Shape::polygon([[-2.0, 0.0], [-1.0, 0.0], [2.0, 0.5]]).expect("a triangle");
    for shape in [Shape::obb(4.0, 0.1), sliver] {
        for seed in 0..100 {
            let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
            let mut world = earth();
            add(&mut world, Body::fixed(Shape::obb(200.0, 0.01)));
            add(&mut world, Body::fixed(Shape::obb(0.2, 2.0)).at([0.0, 1.005]));
            let thrown = Body::dynamic(shape).at([random.random_range(-1.0..1.0), 8.0]);
            let thrown = thrown.velocity([0.0, -100.0]).angular_velocity(random.random_range(-50.0..50.0));
            let thrown = add(&mut world, thrown.angle(random.random_range(-3.0..3.0)));
            for tick in 0..120 {
                world.step();
                let [_, y] = place(&world, thrown);
                assert!(y > 0.0, "{shape:?}, seed {seed}: {y} m at tick {tick}");
            }
        }
    }
}

/// Two bullets meet at 10 km/s. Of equal mass and with restitution 1 they swap their velocities; with 0 they stop.
#[test]
fn two_bullets_do_not_pass_through_each_other() {
    for speed in [400.0_f32, 5_000.0] {
        for restitution in [0.0, 1.0] {
            for substeps in [1, 4] {
                let mut world = World::new(Settings { substeps, ..Settings::default() });
                let bullet = |side: f32| {
                    let disc = Body::dynamic(Shape::circle(0.02)).restitution(restitution).friction(0.0);
                    disc.at([f64::from(1.37 * side * speed / 60.0), 0.0]).velocity([-side * speed, 0.0])
                };
                let bullets = [-1.0, 1.0].map(|side| add(&mut world, bullet(side)));
                for _ in 0..6 {
                    world.step();
                }
                for (bullet, side) in bullets.into_iter().zip([-1.0, 1.0]) {
                    let name = format!("{speed} m/s, restitution {restitution}, {substeps} substeps, {side}");
                    let [x, _] = place(&world, bullet);
                    assert!(x * side > 0.0, "{name}: at {x} m");
                    let expected = f64::from(restitution * speed) * side;
                    assert_near(velocity(&world, bullet)[0], expected, 1e-3 * f64::from(speed), &name);
                }
            }
        }
    }
}

/// What flies past an edge by a centimetre is not touched, however fast: it keeps every bit of its velocity.
#[test]
fn what_flies_past_an_edge_is_not_stopped() {
    for speed in [30.0_f32, 100.0, 1_000.0] {
        for phase in 0..20_u8 {
            let mut world = space();
            add(&mut world, Body::fixed(Shape::rectangle(2.0, 2.0)).at([0.0, -1.0]));
            add(&mut world, Body::fixed(Shape::rectangle(0.1, 0.1)).at([3.0, 0.0]));
            // The corner of the box passes the corner of the ground, and the edge of the small one, a centimetre off.
            let start = -2.0 - f64::from(speed) / 60.0 * f64::from(phase) / 20.0;
            let flying = Body::dynamic(Shape::rectangle(0.2, 0.2)).at([start, 0.16]).velocity([speed, 0.0]);
            let flying = add(&mut world, flying);
            for _ in 0..30 {
                world.step();
            }
            let found = (velocity(&world, flying), spin(&world, flying));
            assert_eq!(found, ([f64::from(speed), 0.0], 0.0), "{speed} m/s, phase {phase}");
        }
    }
}

/// A disc that flies into the corner of two walls of a centimetre meets one and then, in the same substep, the other, which
/// throws it back along the first by its spin.
#[test]
fn a_disc_thrown_into_a_corner_stays_there() {
    for (tick_rate, substeps) in [(30.0, 1), (60.0, 1), (60.0, 4)] {
        for restitution in [0.0, 0.5, 1.0] {
            for phase in 0..20_u8 {
                let mut world = World::new(Settings { tick_rate, substeps, ..Settings::default() });
                let wall = |shape: Shape, at: [f64; 2]| Body::fixed(shape).at(at).restitution(restitution);
                add(&mut world, wall(Shape::rectangle(0.01, 40.0), [0.005, 0.0]));
                add(&mut world, wall(Shape::rectangle(40.0, 0.01), [0.0, 0.005]));
                let before = 0.06 + 0.2 * f64::from(phase);
                let disc = Body::dynamic(Shape::circle(0.05)).at([-before, -1.04 * before]);
                let disc = add(&mut world, disc.velocity([70.0, 70.0]).restitution(restitution));
                for tick in 0..20 {
                    world.step();
                    let [x, y] = place(&world, disc);
                    let name =
                        format!("{tick_rate} Hz, {substeps}, restitution {restitution}, phase {phase}");
                    assert!(x < 0.0 && y < 0.0, "{name}: at {x}, {y} m at tick {tick}");
                }
            }
        }
    }
}

/// A disc at 300 m/s whose target is made fixed after it was set up.
#[test]
fn a_bullet_meets_what_was_made_fixed() {
    let mut world = space();
    let target = Body::dynamic(Shape::rectangle(0.1, 4.0)).at([2.0, 0.0]).restitution(0.0);
    let target = add(&mut world, target);
    let bullet = Body::dynamic(Shape::circle(0.05)).velocity([300.0, 0.0]).restitution(0.0);
    let bullet = add(&mut world, bullet);
    world.body_mut(target).expect("it is there").set_body_type(BodyType::Fixed).expect("it may be fixed");
    for _ in 0..10 {
        world.step();
    }
    let [x, _] = place(&world, bullet);
    assert_near(x, 1.9, 0.01, "the disc is at the wall");
}

/// A rod of 2 m x 1 cm that turns at w = 300 rad/s, 1.25 rad in each substep, meets a pin of a centimetre at d = 0.8 m from its
/// middle. Its angular momentum about the pin stays: L = I w with I = l²/12, per kilogram. Without restitution the point that
/// meets the pin stops, which leaves the energy L²/2(I + d²). From there on the rod slides along the pin, which takes nothing;
/// it is met in straight pieces of 0.4 rad or less, of which each gives away less than 0.4²/2 of what moves across.
#[test]
fn a_rod_that_spins_meets_a_thin_pin() {
    for phase in 0..20_u8 {
        let mut world = space();
        let plain = |body: Body| body.restitution(0.0).friction(0.0);
        add(&mut world, plain(Body::fixed(Shape::circle(0.005)).at([0.8, 0.0])));
        let rod = Body::dynamic(Shape::rectangle(2.0, 0.01)).angle(0.2 + 0.12 * f32::from(phase));
        let rod = add(&mut world, plain(rod.angular_velocity(300.0)));
        world.step();
        let inertia = (4.0 + 0.0001) / 12.0;
        let ([x, y], [v_x, v_y], w) = (place(&world, rod), velocity(&world, rod), spin(&world, rod));
        let momentum = inertia * w + (x - 0.8) * v_y - y * v_x;
        assert_relative(momentum, inertia * 300.0, 2e-3, &format!("phase {phase}: angular momentum"));
        let energy = 0.5 * (inertia * w * w + v_x * v_x + v_y * v_y);
        let expected = 0.5 * (inertia * 300.0_f64).powi(2) / (inertia + 0.64);
        assert!(
            energy < 1.002 * expected && energy > 0.92 * expected,
            "phase {phase}: {energy}, not {expected} J/kg"
        );
    }
}

/// A kinematic door that moves or turns fast takes bodies at rest along, and none is behind it after.
#[test]
fn a_fast_door_does_not_leave_anybody_behind() {
    for speed in [10.0_f32, 50.0, 200.0] {
        for shape in [Shape::circle(0.1), Shape::rectangle(0.2, 0.2), Shape::rectangle(0.02, 0.6)] {
            let mut world = space();
            let door = Body::kinematic(Shape::rectangle(0.05, 4.0)).velocity([speed, 0.0]);
            let door = add(&mut world, door.at([-0.37, 0.0]));
            let bodies: Vec<_> = (0..5)
                .map(|index| {
                    let at = [0.3 * f64::from(index), -1.2 + 0.6 * f64::from(index)];
                    add(&mut world, Body::dynamic(shape).at(at))
                })
                .collect();
            for _ in 0..20 {
                world.step();
            }
            let [at, _] = place(&world, door);
            for (index, &body) in bodies.iter().enumerate() {
                let [x, _] = place(&world, body);
                assert!(x > at, "{speed} m/s, {shape:?}: body {index} is at {x} m, the door at {at} m");
            }
        }
    }
}

/// Restitution 1 between two walls a metre apart: after 10,000 bounces the disc has its speed, and is where the unfolded way
/// ends. Each bounce may round its place by half a digit of the way within a substep, 6e-8 of it, all in the same sense.
#[test]
fn ten_thousand_bounces_lose_neither_speed_nor_time() {
    for speed in [100.0_f32, 10_000.0] {
        let mut world = space();
        for side in [-1.0, 1.0] {
            add(
                &mut world,
                Body::fixed(Shape::rectangle(1.0, 100.0)).at([side, 0.0]).restitution(1.0).friction(0.0),
            );
        }
        let ball = Body::dynamic(Shape::circle(0.1)).velocity([speed, 0.0]).restitution(1.0).friction(0.0);
        let ball = add(&mut world, ball);
        // The way of the centre between the walls, m.
        let width = 0.8;
        let ticks = (10_000.0 * width / f64::from(speed) * 60.0) as u32;
        for _ in 0..ticks {
            world.step();
        }
        assert_relative(velocity(&world, ball)[0].abs(), speed.into(), 5e-7, &format!("{speed} m/s: speed"));
        let way = f64::from(speed) * f64::from(ticks) / 60.0;
        // Unfolded, from the left wall on.
        let unfolded = (0.5 * width + way).rem_euclid(2.0 * width);
        let expected = if unfolded > width { 1.5 * width - unfolded } else { unfolded - 0.5 * width };
        let [x, _] = place(&world, ball);
        assert_near(x, expected, 1e-6 * way, &format!("{speed} m/s: place"));
    }
}

/// A break at 30 m/s: fifteen balls of 57 mm in a triangle and one that strikes them, with restitution 1 and without friction,
/// and nothing around. Energy and momentum are what they were.
#[test]
fn a_break_of_billiards_keeps_energy_and_momentum() {
    for phase in 0..10_u8 {
        let mut world = space();
        let ball = |x: f64, y: f64| {
            Body::dynamic(Shape::circle(0.0286)).at([x, y]).density(66.0).restitution(1.0).friction(0.0)
        };
        for row in 0..5_u8 {
            for place in 0..=row {
                let (row, place) = (f64::from(row), f64::from(place));
                add(&mut world, ball(0.0573 * 0.8661 * row, 0.0573 * (place - 0.5 * row)));
            }
        }
        let start = -0.5 - 0.05 * f64::from(phase);
        add(&mut world, ball(start, 0.002 * f64::from(phase)).velocity([30.0, 0.0]));
        let (energy, momentum) = (world.energy(), f64::from(world.momentum().x));
        for _ in 0..60 {
            world.step();
        }
        assert_relative(world.energy(), energy, 1e-4, &format!("phase {phase}: energy"));
        assert_relative(f64::from(world.momentum().x), momentum, 1e-6, &format!("phase {phase}: momentum"));
    }
}
