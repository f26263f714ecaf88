//! Restitution.

use rustycs::prelude::*;

use crate::support::{
    G, add, add_floor, assert_near, assert_relative, earth, earth_with, place, run, space, unit_box, velocity,
};

/// Drops a body with its lowest point `drop` above a floor; both have restitution `e`.
fn drop_onto_floor(body: Body, half_height: f64, drop: f64, e: f32) -> (World, BodyId) {
    let mut world = earth();
    let floor = Body::fixed(Shape::aabb(20.0, 2.0)).at([0.0, -1.0]);
    add(&mut world, floor.friction(0.5).restitution(e));
    let id = add(&mut world, body.at([0.0, half_height + drop]).friction(0.5).restitution(e));
    (world, id)
}

/// Greatest height of the lowest point after each bounce. Between ticks the height is that of the parabola
/// through the state: y + v²/(2g).
fn apex_heights(world: &mut World, id: BodyId, half_height: f64, count: usize) -> Vec<f64> {
    let mut apexes = Vec::new();
    let mut previous = velocity(world, id)[1];
    while apexes.len() < count {
        world.step();
        let v = velocity(world, id)[1];
        if previous > 0.0 && v <= 0.0 {
            apexes.push(place(world, id)[1] - half_height + v * v / (2.0 * G));
        }
        previous = v;
        assert!(world.ticks() < 100_000, "no more bounces after {apexes:?}");
    }
    apexes
}

/// The speed falls by e per bounce, the height by e².
#[test]
fn a_ball_of_restitution_one_half_reaches_a_quarter_of_its_height() {
    let (mut world, ball) = drop_onto_floor(Body::dynamic(Shape::circle(0.25)), 0.25, 2.0, 0.5);
    for (bounce, height) in (1..).zip(apex_heights(&mut world, ball, 0.25, 4)) {
        assert_relative(height, 2.0 * 0.25_f64.powi(bounce), 5e-3, "height");
    }
}

#[test]
fn a_perfectly_elastic_ball_keeps_its_energy_for_a_hundred_bounces() {
    let (mut world, ball) = drop_onto_floor(Body::dynamic(Shape::circle(0.25)), 0.25, 1.0, 1.0);
    let heights = apex_heights(&mut world, ball, 0.25, 100);
    for height in heights {
        assert_relative(height, 1.0, 1e-3, "height");
    }
}

#[test]
fn an_elastic_box_that_lands_flat_keeps_its_energy_and_stays_level() {
    let (mut world, id) = drop_onto_floor(Body::dynamic(Shape::obb(0.6, 0.4)), 0.2, 1.0, 1.0);
    for height in apex_heights(&mut world, id, 0.2, 100) {
        assert_relative(height, 1.0, 1e-3, "height");
    }
    assert_near(f64::from(world.body(id).unwrap().angle()), 0.0, 1e-3, "angle");
}

/// e = 0: the ball stays where it lands.
#[test]
fn an_inelastic_ball_stops_where_it_lands() {
    let (mut world, ball) = drop_onto_floor(Body::dynamic(Shape::circle(0.25)), 0.25, 2.0, 0.0);
    run(&mut world, 2.0);
    // It sinks in by compliance·g·h/(2·bias rate) = 1e-4 m.
    assert_near(place(&world, ball)[1], 0.25, 2e-4, "height");
    assert_near(velocity(&world, ball)[1], 0.0, 1e-4, "speed");
}

/// 0 on one side is enough: neither does clay bounce from what is lively, nor a lively ball from clay.
#[test]
fn nothing_bounces_where_one_of_the_two_has_no_restitution() {
    for [of_floor, of_ball] in [[0.0, 1.0], [1.0, 0.0]] {
        let mut world = earth();
        add(&mut world, Body::fixed(Shape::aabb(20.0, 2.0)).at([0.0, -1.0]).restitution(of_floor));
        let ball = Body::dynamic(Shape::circle(0.25)).at([0.0, 2.25]).restitution(of_ball);
        let ball = add(&mut world, ball);
        for _ in 0..120 {
            world.step();
            assert!(velocity(&world, ball)[1] < 1e-4, "it goes up");
        }
        assert_near(place(&world, ball)[1], 0.25, 2e-4, "height");
    }
}

/// The threshold decides: below it nothing bounces.
#[test]
fn an_approach_below_the_threshold_does_not_bounce() {
    let (mut world, ball) = drop_onto_floor(Body::dynamic(Shape::circle(0.25)), 0.25, 0.1, 0.9);
    let settings = Settings { restitution_threshold: 3.0, ..world.settings().clone() };
    world.set_settings(settings).unwrap();
    let mut highest_after_landing = 0.0_f64;
    for tick in 0..120 {
        world.step();
        if tick > 20 {
            highest_after_landing = highest_after_landing.max(place(&world, ball)[1] - 0.25);
        }
    }
    assert!(highest_after_landing < 1e-3, "bounced to {highest_after_landing} m");
}

/// Equal discs of restitution 1 exchange their speeds, one after the other.
#[test]
fn a_cradle_passes_the_impulse_to_its_last_ball() {
    for gap in [0.0, 1e-3] {
        let mut world = space();
        let pitch = 1.0 + gap;
        let disc = |x: f64| Body::dynamic(Shape::circle(0.5)).at([x, 0.0]).restitution(1.0).friction(0.0);
        let first = add(&mut world, disc(-2.0).velocity([2.0, 0.0]));
        let others: Vec<BodyId> = (0..4).map(|i| add(&mut world, disc(pitch * f64::from(i)))).collect();
        run(&mut world, 2.0);
        let last = velocity(&world, others[3])[0];
        assert_relative(last, 2.0, 1e-2, "speed of the last");
        for id in [first, others[0], others[1], others[2]] {
            assert_near(velocity(&world, id)[0], 0.0, 0.01 * 2.0, "speed of the others");
        }
    }
}

/// On a floor, under gravity, touching: the balls rest on it while they pass the impulse.
#[test]
fn a_cradle_on_a_floor_passes_the_impulse_too() {
    let mut world = earth();
    add_floor(&mut world, 0.0);
    let disc = |x: f64| Body::dynamic(Shape::circle(0.5)).at([x, 0.5]).restitution(1.0).friction(0.0);
    let first = add(&mut world, disc(-2.0).velocity([2.0, 0.0]));
    let others: Vec<BodyId> = (0..4).map(|i| add(&mut world, disc(f64::from(i)))).collect();
    run(&mut world, 2.0);
    assert_relative(velocity(&world, others[3])[0], 2.0, 1e-2, "speed of the last");
    for id in [first, others[0], others[1], others[2]] {
        assert_near(velocity(&world, id)[0], 0.0, 0.01 * 2.0, "speed of the others");
    }
}

/// Two in, two out.
#[test]
fn a_cradle_sends_out_as_many_balls_as_come_in() {
    let mut world = space();
    let disc = |x: f64| Body::dynamic(Shape::circle(0.5)).at([x, 0.0]).restitution(1.0).friction(0.0);
    let ids = [-3.0, -2.0, 0.0, 1.0, 2.0].map(|x| {
        let speed = if x < 0.0 { 2.0 } else { 0.0 };
        add(&mut world, disc(x).velocity([speed, 0.0]))
    });
    run(&mut world, 2.0);
    for (id, expected) in ids.into_iter().zip([0.0, 0.0, 0.0, 2.0, 2.0]) {
        assert_near(velocity(&world, id)[0], expected, 0.02, "speed");
    }
}

/// A body falls on one that lies on the ground, and has so many times its mass; how fast it comes back, by the speed that it came with. One
/// collision after the other, each with restitution `e`: with what lies there, of that with the ground, and so on.
fn rebound_of_a_row_of_collisions(ratio: f64, e: f64) -> f64 {
    let (mut falls, mut lies) = (-1.0, 0.0);
    for _ in 0..1000 {
        if falls < lies {
            let (of_both, apart) = ((ratio * falls + lies) / (ratio + 1.0), e * (lies - falls));
            (falls, lies) = (of_both + apart / (ratio + 1.0), of_both - ratio * apart / (ratio + 1.0));
        }
        if lies < 0.0 {
            lies *= -e;
        }
    }
    falls
}

/// From 10 m a body comes at 14 m/s. What gravity gives it in the tick in which its speed is looked at, before and after, is 0.16 m/s each; an
/// approach of less than 2 g h, 0.08 m/s, does not bounce: together 2.9 % of its speed, at most.
#[test]
fn a_body_bounces_on_one_that_lies_on_the_ground() {
    for e in [0.5, 0.8, 1.0_f32] {
        for ratio in [0.1, 0.3, 0.5, 0.7, 1.0, 3.0_f32] {
            let mut world = earth_with(Settings { restitution_threshold: 0.0, ..Settings::default() });
            add(&mut world, Body::fixed(Shape::aabb(20.0, 2.0)).at([0.0, -1.0]).restitution(e));
            add(&mut world, unit_box(0.0, 0.5).mass(1.0).restitution(e));
            let id = add(&mut world, unit_box(0.0, 11.5).mass(ratio).restitution(e));
            let (mut fastest, mut back) = (0.0_f64, 0.0_f64);
            for _ in 0..120 {
                world.step();
                let speed = velocity(&world, id)[1];
                (fastest, back) = (fastest.max(-speed), back.max(speed));
            }
            let due = rebound_of_a_row_of_collisions(f64::from(ratio), f64::from(e));
            assert_near(back / fastest, due, 0.029, &format!("{ratio} : 1, e = {e}"));
        }
    }
}
