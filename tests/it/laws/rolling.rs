//! Rolling resistance.

use rustycs::prelude::*;

use crate::support::{G, add, add_floor, assert_near, assert_relative, earth, place, run, spin, velocity};

const RESISTANCE: f32 = 0.05;
const RADIUS: f64 = 0.5;

/// A disc that rolls with this speed.
fn rolling(speed: f32) -> Body {
    let disc = Body::dynamic(Shape::circle(RADIUS as f32)).at([0.0, RADIUS]).velocity([speed, 0.0]);
    disc.angular_velocity(-speed / RADIUS as f32).friction(0.6).restitution(0.0)
}

/// It loses c g of its speed in each second, and stands: whichever of the two has the resistance, and at any number of ticks
/// and substeps. The way is off by that of the substep in which it begins and ends, v h, of v²/(2 c g).
#[test]
fn a_disc_that_rolls_stops_after_its_speed_squared_over_two_c_g() {
    for (of_disc, of_floor) in [(RESISTANCE, 0.0), (0.0, RESISTANCE), (RESISTANCE, 0.02)] {
        for (tick_rate, substeps) in [(60.0, 4), (60.0, 1), (240.0, 4)] {
            for speed in [3.0, -1.0] {
                let mut world = earth();
                world.set_settings(Settings { tick_rate, substeps, ..world.settings().clone() }).unwrap();
                let floor = add_floor(&mut world, 0.6);
                world.body_mut(floor).unwrap().set_rolling_resistance(of_floor).unwrap();
                let disc = add(&mut world, rolling(speed).rolling_resistance(of_disc));
                let deceleration = f64::from(RESISTANCE) * G;
                let time = f64::from(speed).abs() / deceleration;
                run(&mut world, 0.5 * time);
                assert_relative(velocity(&world, disc)[0], 0.5 * f64::from(speed), 5e-3, "half of the speed");
                // At one substep a tick it swings for a second.
                run(&mut world, 0.5 * time + 1.0);
                let way = f64::from(speed * speed.abs()) / (2.0 * deceleration);
                assert_relative(place(&world, disc)[0], way, 1e-3, "way");
                assert_near(velocity(&world, disc)[0], 0.0, 1e-6, "speed after it stopped");
                assert_near(spin(&world, disc), 0.0, 1e-6, "spin after it stopped");
            }
        }
    }
}

/// It comes as far on ground of small pieces, which bear the whole disc however small they are. The way is off by that of the
/// substep in which it begins and ends, v h. Where a piece takes over, half of the moment acts in its first substep: for each v h/2 at most.
#[test]
fn a_disc_that_rolls_on_small_pieces_stops_as_on_a_floor() {
    let speed = 2.0;
    let deceleration = f64::from(RESISTANCE) * G;
    for piece in [2.0_f32, 0.5, 0.1] {
        let count = (8.0 / piece) as usize;
        let left = |i: usize| i as f32 * piece - 2.0;
        let links = Ground::chain((0..=count).map(|i| [left(i), 0.0])).unwrap();
        let boxes =
            (0..count).map(|i| Body::fixed(Shape::aabb(piece, 1.0)).at([left(i) + 0.5 * piece, -0.5]));
        for (name, ground) in [("links", vec![links]), ("boxes", boxes.collect())] {
            let mut world = earth();
            for body in ground {
                add(&mut world, body.friction(0.6).restitution(0.0));
            }
            let disc = add(&mut world, rolling(speed).rolling_resistance(RESISTANCE));
            let speed = f64::from(speed);
            run(&mut world, speed / deceleration + 1.0);
            let way = speed * speed / (2.0 * deceleration);
            let within = speed / 240.0 * (1.0 + 0.5 * way / f64::from(piece));
            assert_near(place(&world, disc)[0], way, within, &format!("way on {name} of {piece} m"));
        }
    }
}

/// A coefficient that is changed counts from the next step on, of each of the two: a second of c g later.
#[test]
fn a_disc_in_contact_feels_a_change_of_its_resistance() {
    for of_floor in [false, true] {
        let mut world = earth();
        let floor = add_floor(&mut world, 0.6);
        world.body_mut(floor).unwrap().set_rolling_resistance(0.0).unwrap();
        let disc = add(&mut world, rolling(3.0).rolling_resistance(0.0));
        run(&mut world, 1.0);
        assert_near(velocity(&world, disc)[0], 3.0, 1e-5, "speed before");
        let changed = if of_floor { floor } else { disc };
        world.body_mut(changed).unwrap().set_rolling_resistance(RESISTANCE).unwrap();
        run(&mut world, 1.0);
        let resistance = world.contacts_of(disc).next().unwrap().rolling_resistance();
        assert_eq!(resistance, RESISTANCE);
        let slower = f64::from(RESISTANCE) * G;
        // It begins by half.
        assert_near(velocity(&world, disc)[0], 3.0 - slower, slower / 240.0, "speed a second later");
    }
}

/// However great the resistance is, the disc does not go back.
#[test]
fn rolling_resistance_never_turns_the_spin_round() {
    for resistance in [0.01, 0.3, 5.0, 1e6] {
        let mut world = earth();
        add_floor(&mut world, 0.6);
        let disc = add(&mut world, rolling(2.0).rolling_resistance(resistance));
        for _ in 0..300 {
            world.step();
            // To the rounding of what stops it.
            assert!(spin(&world, disc) <= 1e-6, "spin {} at {resistance}", spin(&world, disc));
            // Friction, which has slowed it down till then, goes on for a substep.
            let at_most = f64::from(resistance).min(0.6) * G / 240.0;
            assert!(velocity(&world, disc)[0] >= -at_most, "it goes back at {resistance}");
        }
    }
}

/// A ramp of 10 degrees, tan 10° = 0.176, and how far a disc at rest on it comes in 2 s, with its speed.
fn way_down(resistance: f32) -> [f64; 2] {
    let mut world = earth();
    let angle = 10.0_f64.to_radians();
    let (down, normal) = ([-angle.cos(), -angle.sin()], [-angle.sin(), angle.cos()]);
    let ramp = Body::fixed(Shape::obb(100.0, 2.0)).angle(angle as f32).at([-normal[0], -normal[1]]);
    add(&mut world, ramp.friction(0.6).restitution(0.0));
    let disc = rolling(0.0).at([RADIUS * normal[0], RADIUS * normal[1]]).rolling_resistance(resistance);
    let disc = add(&mut world, disc);
    run(&mut world, 2.0);
    let along = |[x, y]: [f64; 2]| x * down[0] + (y - RADIUS * normal[1]) * down[1];
    let [vx, vy] = velocity(&world, disc);
    [
        along([place(&world, disc)[0] - RADIUS * normal[0], place(&world, disc)[1]]),
        vx * down[0] + vy * down[1],
    ]
}

/// Under load N = m g cos it takes 3/2 c r N to turn it; below that it stands, as tan 10° < 3/2 c. Of what friction and the moment
/// have not found of each other, 2/3 is left after each substep, and so it gives way by g sin h² Σ (n + 1) (2/3)ⁿ.
#[test]
fn a_disc_stands_on_a_slope_below_three_halves_of_its_resistance() {
    let [way, speed] = way_down(0.13);
    let given_way = G * 10.0_f64.to_radians().sin() / (240.0 * 240.0) * 9.0;
    assert_near(way, 0.0, given_way, "way in 2 s");
    assert_near(speed, 0.0, 1e-5, "speed");
}

/// What stands stays: the moment Λ that holds the disc acts before each move as after it, whatever share it is of the greatest. If at
/// most half of the greatest acted before the move, at a share of 0.9 the disc would turn at 0.2 · 3 c g h/r, 2.5 mrad/s, and heaps of discs
/// never come to rest. Angles are exact to 1e-7.
#[test]
fn a_disc_that_stands_on_a_slope_does_not_creep() {
    for share in [0.3, 0.6, 0.9, 0.99] {
        let mut world = World::new(Settings { sleep: false, ..Settings::default() });
        let angle = (share * 1.5 * f64::from(RESISTANCE)).atan();
        world.add_force(Force::new("weight", [(G * angle.sin()) as f32, -(G * angle.cos()) as f32]));
        add_floor(&mut world, 0.6);
        let disc = add(&mut world, rolling(0.0).rolling_resistance(RESISTANCE));
        run(&mut world, 2.0);
        let before = (place(&world, disc)[0], world.body(disc).unwrap().angle());
        run(&mut world, 10.0);
        assert_near(place(&world, disc)[0], before.0, 1e-6, &format!("place at {share}"));
        let turned = f64::from(world.body(disc).unwrap().angle() - before.1);
        assert_near(turned, 0.0, 1e-6, &format!("turn at {share}"));
    }
}

/// Above that it rolls: 3/2 m a = m g sin - 3/2 c m g cos. Set down, it rolls freely for a substep or two.
#[test]
fn a_disc_rolls_down_with_what_its_resistance_leaves_of_the_slope() {
    let angle = 10.0_f64.to_radians();
    for resistance in [0.02, 0.1] {
        let acceleration = G * (2.0 / 3.0 * angle.sin() - f64::from(resistance) * angle.cos());
        let [way, speed] = way_down(resistance);
        let freely = f64::from(resistance) * G * angle.cos() * 2.0 / 240.0;
        assert_near(speed, acceleration * 2.0, freely, "speed after 2 s");
        assert_near(way, acceleration * 2.0, freely * 2.0, "way in 2 s");
    }
}

/// Two discs that spin against each other in empty space, pressed together by forces, slow each other down: 3/2 c r N on each.
#[test]
fn two_discs_that_roll_on_each_other_slow_each_other_down() {
    let mut world = earth();
    world.clear();
    let disc = Body::dynamic(Shape::circle(0.5)).mass(1.0).friction(0.6).restitution(0.0);
    let a = add(&mut world, disc.clone().at([-0.5, 0.0]).angular_velocity(2.0).rolling_resistance(0.1));
    let b = add(&mut world, disc.at([0.5, 0.0]).angular_velocity(-2.0));
    for _ in 0..60 {
        world.body_mut(a).unwrap().apply_force([2.0, 0.0]);
        world.body_mut(b).unwrap().apply_force([-2.0, 0.0]);
        world.step();
    }
    // Their rims go the same way. I = m r²/2.
    let slowed = 1.5 * 0.1 * 0.5 * 2.0 / (0.5 * 0.5 * 0.5);
    assert_relative(spin(&world, a), 2.0 - slowed, 2e-3, "spin of a");
    assert_near(spin(&world, b), -spin(&world, a), 1e-6, "spin of b");
}

/// Where it comes to rest it sleeps, as it does not without.
#[test]
fn a_disc_with_rolling_resistance_comes_to_rest_and_sleeps() {
    for (resistance, sleeps) in [(0.0, false), (RESISTANCE, true)] {
        let mut world = World::new(Settings::default());
        world.add_force(Force::EARTH_GRAVITY);
        add_floor(&mut world, 0.6);
        let disc = add(&mut world, rolling(1.0).rolling_resistance(resistance));
        run(&mut world, 5.0);
        assert_eq!(world.body(disc).unwrap().is_sleeping(), sleeps, "with {resistance}");
    }
}

/// The moment that holds a disc on a slope is in proportion to the length of a substep, as its load is. Were it kept where that is
/// made four times as short, half of three times too much of it would turn the disc before the move: by 3/2 g sin φ h²/(r/2), of
/// which a tenth is allowed.
#[test]
fn a_disc_on_a_slope_does_not_feel_a_change_of_substeps() {
    let angle = 0.02_f64;
    let mut world = World::new(Settings { sleep: false, ..Settings::default() });
    world.add_force(Force::new("weight", [(G * angle.sin()) as f32, -(G * angle.cos()) as f32]));
    add_floor(&mut world, 0.6);
    let disc = add(&mut world, rolling(0.0).rolling_resistance(RESISTANCE));
    run(&mut world, 2.0);
    let turned = |world: &World| f64::from(world.body(disc).unwrap().angle());
    for substeps in [16, 4] {
        let before = turned(&world);
        world.set_settings(Settings { substeps, ..world.settings().clone() }).unwrap();
        world.step();
        let h = 1.0 / (60.0 * 16.0);
        assert_near(turned(&world), before, 0.1 * 1.5 * G * angle.sin() * h * h / (0.5 * RADIUS), "turn");
    }
}
