//! Hard landings, fast bodies, slow ticks.

use rustycs::prelude::*;

use crate::support::{add, add_floor, earth, earth_with, place, run, space, unit_box, velocity};

/// Drops a box from 3 m, turned and spinning differently for each `i`; returns the greatest energy of ten
/// seconds and the last, as fractions of the first.
fn energies_of_a_tumbling_box(i: u16, friction: f32, e: f32) -> (f64, f64) {
    let mut world = earth();
    let floor = Body::fixed(Shape::aabb(200.0, 2.0)).at([0.0, -1.0]);
    add(&mut world, floor.friction(friction).restitution(e));
    let body = Body::dynamic(Shape::obb(1.0, 0.6)).at([0.0, 3.0]).angle(0.16 * f32::from(i));
    add(&mut world, body.angular_velocity(f32::from(i % 5)).friction(friction).restitution(e));
    let start = world.energy();
    let mut greatest = 0.0_f64;
    for _ in 0..600 {
        world.step();
        greatest = greatest.max(world.energy() / start);
    }
    (greatest, world.energy() / start)
}

/// Impacts at corners, rolling over edges, sliding: none of it makes energy. What `f32` rounds is below 1e-6 per
/// impact, with fewer than 50 impacts.
#[test]
fn a_box_that_tumbles_never_gains_energy() {
    for e in [0.0, 0.5, 1.0] {
        for i in 0..20 {
            let (greatest, _) = energies_of_a_tumbling_box(i, 0.5, e);
            assert!(greatest < 1.0 + 5e-5, "box {i}, restitution {e}: {greatest} of its energy");
        }
    }
}

/// Without friction and with restitution 1 nothing takes energy either.
#[test]
fn an_elastic_box_that_tumbles_without_friction_keeps_its_energy() {
    for i in 0..20 {
        let (_, last) = energies_of_a_tumbling_box(i, 0.0, 1.0);
        assert!((last - 1.0).abs() < 1e-3, "box {i} has {last} of its energy");
    }
}

/// A wall of 0.2 m against discs that move up to 800 times that in a tick. The fat boxes hold where a body will
/// be, and manifolds are found where the bodies will meet: a body that flies straight is stopped at any speed.
#[test]
fn no_disc_flies_through_a_thin_wall() {
    for speed in [30.0_f32, 100.0, 1000.0, 10_000.0] {
        for i in 0..50_u16 {
            let mut world = space();
            add(&mut world, Body::fixed(Shape::aabb(0.2, 20.0)).restitution(0.5));
            let start = -5.0 - 0.013 * speed / 60.0 * f32::from(i);
            let aim = 0.05 * speed * (f32::from(i % 7) - 3.0) / 3.0;
            let disc = Body::dynamic(Shape::circle(0.1)).at([start, 0.3]).velocity([speed, aim]);
            let disc = add(&mut world, disc);
            run(&mut world, 20.0 / f64::from(speed) + 0.5);
            assert!(place(&world, disc)[0] < 0.0, "disc {i} at {speed} m/s is at {:?}", place(&world, disc));
        }
    }
}

/// The push out of an overlap is a share of it per substep, at most 0.3, so that it cannot overshoot at any rate.
#[test]
fn a_stack_comes_to_rest_at_any_tick_rate() {
    for tick_rate in [5.0, 10.0, 30.0, 240.0, 1000.0] {
        let mut world = earth_with(Settings { tick_rate, ..Settings::default() });
        add_floor(&mut world, 0.6);
        let ids: Vec<BodyId> = (0..5)
            .map(|i| add(&mut world, unit_box(0.0, 0.5 + 1.1 * f64::from(i)).restitution(0.3)))
            .collect();
        run(&mut world, 20.0);
        for (i, &id) in ids.iter().enumerate() {
            let ([x, y], [vx, vy]) = (place(&world, id), velocity(&world, id));
            assert!(x.abs() < 1e-3 && vx.hypot(vy) < 1e-3, "{tick_rate} Hz: {x} m aside at {vx}, {vy} m/s");
            // At 5 Hz a substep adds 0.5 m/s; the sag grows with the square of its length.
            let sag = 0.5 + i as f64 - y;
            assert!((-1e-4..0.25).contains(&sag), "{tick_rate} Hz: box {i} sags by {sag} m");
        }
    }
}
