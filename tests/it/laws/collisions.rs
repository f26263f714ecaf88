//! Two bodies collide in empty space: what is conserved, and what comes out.

use rustycs::prelude::*;

use crate::support::{
    add, add_floor, assert_near, assert_relative, earth_with, place, run, space, spin, unit_box, velocity,
};

/// v_a' = (m_a - m_b)/(m_a + m_b) v = -v/2,  v_b' = 2 m_a/(m_a + m_b) v = v/2 for masses 1 : 3.
#[test]
fn a_head_on_elastic_collision_of_one_to_three() {
    let mut world = space();
    let disc = |x: f64, mass: f32| Body::dynamic(Shape::circle(0.5)).at([x, 0.0]).mass(mass).restitution(1.0);
    let light = add(&mut world, disc(-2.0, 1.0).velocity([4.0, 0.0]));
    let heavy = add(&mut world, disc(0.0, 3.0));
    let energy = world.energy();
    run(&mut world, 1.0);
    assert_relative(f64::from(world.momentum().x), 4.0, 1e-6, "momentum");
    assert_relative(world.energy(), energy, 1e-3, "energy");
    assert_near(velocity(&world, light)[0], -2.0, 1e-5, "light");
    assert_near(velocity(&world, heavy)[0], 2.0, 1e-5, "heavy");
    // The light disc touches at x = -1 after 0.25 s; 0.75 s later:
    assert_near(place(&world, light)[0], -1.0 - 2.0 * 0.75, 1e-5, "place of the light");
    assert_near(place(&world, heavy)[0], 2.0 * 0.75, 1e-5, "place of the heavy");
}

/// Equal frictionless discs with the offset b between their ways: the struck one leaves along the line of
/// centres at impact, at sin φ = b / 2r, and the striker at a right angle to it.
#[test]
fn an_oblique_elastic_collision_leaves_at_a_right_angle() {
    for speed in [1.0, 5.0, 20.0] {
        for offset in [0.3, 0.5, 0.8] {
            let mut world = space();
            let disc = || Body::dynamic(Shape::circle(0.5)).restitution(1.0).friction(0.0);
            let striker = add(&mut world, disc().at([-3.0, offset]).velocity([speed, 0.0]));
            let struck = add(&mut world, disc().at([0.0, 0.0]));
            let energy = world.energy();
            let momentum = world.momentum();
            run(&mut world, f64::from(6.0 / speed));
            let change = world.momentum() - momentum;
            assert_near(f64::from(change.length() / momentum.length()), 0.0, 1e-6, "momentum");
            assert_relative(world.energy(), energy, 1e-3, "energy");
            let ([ax, ay], [bx, by]) = (velocity(&world, striker), velocity(&world, struck));
            let (speed_a, speed_b) = (ax.hypot(ay), bx.hypot(by));
            assert_near((ax * bx + ay * by) / (speed_a * speed_b), 0.0, 1e-3, "cosine between the ways");
            assert_near(-by / speed_b, offset, 1e-3, "sine of the struck disc's way");
        }
    }
}

/// Contact impulses are equal and opposite and act at one point: momentum and angular momentum stay.
#[test]
fn spinning_polygons_that_collide_keep_momentum_and_angular_momentum() {
    let mut world = space();
    let triangle = Shape::polygon([[0.0, 0.0], [1.0, 0.0], [0.3, 0.9]]).unwrap();
    let pentagon = Shape::polygon([[0.5, 0.0], [0.2, 0.5], [-0.4, 0.3], [-0.4, -0.3], [0.2, -0.5]]).unwrap();
    let body = |shape| Body::dynamic(shape).density(1.0).restitution(0.5).friction(0.5);
    let a = add(&mut world, body(triangle).at([-2.0, 0.2]).velocity([3.0, 0.0]).angular_velocity(4.0));
    let b = add(&mut world, body(pentagon).at([1.0, 0.0]).velocity([-1.0, 0.1]).angular_velocity(-6.0));
    let (momentum, angular, energy) = (world.momentum(), world.angular_momentum(), world.energy());
    let spins = [spin(&world, a), spin(&world, b)];
    run(&mut world, 3.0);
    assert!(spin(&world, a) != spins[0] && spin(&world, b) != spins[1], "they did not meet");
    let change = world.momentum() - momentum;
    let scale = f64::from(world.body(a).unwrap().mass()) * 3.0;
    assert_near(f64::from(change.length()) / scale, 0.0, 1e-6, "momentum");
    // An impact acts at one place, found at its own time. What follows it too slowly to bounce is for the sweeps,
    // whose arms hold still during a tick: at 0.1 m/s they miss by 0.1 m/s / 60 = 2e-3 m of an arm of 0.5 m, for an
    // impulse of a tenth of the blow.
    assert_near(world.angular_momentum() / angular.abs(), angular / angular.abs(), 1e-3, "angular momentum");
    assert!(world.energy() <= energy, "energy {} from {energy}", world.energy());
}

/// What hits a wall straight with e = 1 comes back with its speed, without loss of energy, in a corner too.
#[test]
fn elastic_discs_in_a_box_keep_their_energy() {
    let mut world = space();
    for (x, y, w, h) in
        [(0.0, -5.5, 12.0, 1.0), (0.0, 5.5, 12.0, 1.0), (-5.5, 0.0, 1.0, 12.0), (5.5, 0.0, 1.0, 12.0)]
    {
        let wall = Body::fixed(Shape::aabb(w, h)).at([x, y]);
        add(&mut world, wall.friction(0.0).restitution(1.0));
    }
    for i in 0..16 {
        let (column, row) = (f64::from(i % 4), f64::from(i / 4));
        let velocity = [3.0 * (i as f32 * 1.7 - 11.0).abs().sqrt() - 4.0, (i as f32 - 7.5) * 0.6];
        let disc = Body::dynamic(Shape::circle(0.3)).at([column * 2.2 - 3.3, row * 2.2 - 3.3]);
        add(&mut world, disc.velocity(velocity).friction(0.0).restitution(1.0));
    }
    let energy = world.energy();
    run(&mut world, 30.0);
    // Each impact keeps the energy to rounding (1e-7), a few thousand of them to 1e-4. An approach below 0.1 m/s is
    // plastic and costs 0.1² of the 3² that a disc has on average, seldom.
    assert_relative(world.energy(), energy, 1e-3, "energy");
}

/// A sweep that knew only where bodies were when the step began would let a box go on by the whole gap in each substep. One
/// that knows where they are stops it at the floor, but for what yields to the blow: of 14 % of 8 m/s what is up to 0.5 m/s
/// and 15 % of the rest, 0.59 m/s for a substep. Where there is but one, that is 7.4 % of the way of a step; and 1 % is the
/// overlap that holds the weight, g h 14 % / (0.3/h).
#[test]
fn a_falling_box_stops_at_the_floor_whatever_sweeps_there_are() {
    const SPEED: f32 = 8.0;
    for (substeps, relax_iterations) in [(1, 0), (4, 0), (8, 0), (1, 1), (4, 1), (4, 3)] {
        for iterations in [1, 4] {
            let sweeps = Settings { substeps, iterations, relax_iterations, ..Settings::default() };
            let mut world = earth_with(Settings { split_kick: false, ..sweeps });
            add_floor(&mut world, 0.5);
            let falling = add(&mut world, unit_box(0.0, 1.0).velocity([0.0, -SPEED]));
            let way = f64::from(SPEED) * world.settings().tick_seconds();
            for _ in 0..60 {
                world.step();
                let depth = 0.5 - place(&world, falling)[1];
                assert!(depth < 0.1 * way, "{depth} m with {sweeps:?}");
            }
        }
    }
}
