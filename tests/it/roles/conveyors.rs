//! Surfaces that move: friction draws along what touches them, as if the body moved.

use rustycs::prelude::*;

use crate::support::{
    G, add, add_floor, assert_near, assert_relative, earth, place, run, spin, unit_box, velocity,
};

const FRICTION: f32 = 0.5;

fn belt(speed: f32) -> Body {
    let belt = Body::fixed(Shape::aabb(200.0, 2.0)).at([0.0, -1.0]);
    belt.friction(FRICTION).restitution(0.0).surface_speed(speed)
}

fn crate_at(x: f64, y: f64) -> Body {
    unit_box(x, y).friction(FRICTION)
}

/// v = µ g t until v is the belt's, after v/(µ g), within a substep; on a belt that stays, and on one that moves itself.
#[test]
fn a_crate_gains_speed_by_friction_until_it_goes_with_the_belt() {
    let gain = f64::from(FRICTION) * G;
    for (surface, own) in [(2.0, 0.0), (-3.0, 0.0), (2.0, 1.0), (1.0, -2.0)] {
        let mut world = earth();
        let belt = add(&mut world, belt(surface));
        if own != 0.0 {
            world.body_mut(belt).unwrap().set_body_type(BodyType::Kinematic).unwrap();
            world.body_mut(belt).unwrap().set_velocity([own, 0.0]);
        }
        let id = add(&mut world, crate_at(0.0, 0.5));
        let aim = f64::from(surface + own);
        for tick in 1..90 {
            world.step();
            let expected = (gain * f64::from(tick) / 60.0).min(aim.abs()) * aim.signum();
            let [vx, vy] = velocity(&world, id);
            assert_near(vx, expected, gain / 240.0, "its speed, to that of a substep");
            assert_near(vy, 0.0, 1e-3, "it stays on the belt");
        }
        assert_near(velocity(&world, id)[0], aim, 1e-4, "it goes with the belt");
        assert_near(spin(&world, id), 0.0, 1e-4, "it does not turn");
    }
}

/// Clockwise round the body: what hangs below is taken to the left.
#[test]
fn what_is_pressed_to_the_underside_goes_the_other_way() {
    let mut world = earth();
    add(&mut world, belt(2.0));
    let id = add(&mut world, crate_at(0.0, -2.5).gravity_scale(-1.0));
    run(&mut world, 1.0);
    assert_near(velocity(&world, id)[0], -2.0, 1e-4, "below");
}

/// A disc slips until v + ω r is the belt's speed: v gains µ g t and ω r twice as much, so that v is a third of it.
#[test]
fn a_disc_rolls_on_the_belt_with_a_third_of_its_speed() {
    let mut world = earth();
    add(&mut world, belt(3.0));
    let id = add(
        &mut world,
        Body::dynamic(Shape::circle(0.4))
            .at([0.0, 0.4])
            .friction(FRICTION)
            .restitution(0.0)
            .rolling_resistance(0.0),
    );
    run(&mut world, 2.0);
    assert_relative(velocity(&world, id)[0], 1.0, 1e-3, "its speed");
    assert_relative(spin(&world, id) * 0.4, 2.0, 1e-3, "the speed of its rim");
}

/// A disc that falls on the belt with u bounces, and slips as it does: it gains µ (1 + e) u.
#[test]
fn a_bounce_draws_along_as_far_as_friction_goes() {
    let mut world = earth();
    add(&mut world, belt(50.0).friction(0.1).restitution(0.5));
    let disc = Body::dynamic(Shape::circle(0.2)).friction(0.1).restitution(0.5);
    let id = add(&mut world, disc.at([0.0, 1.2]));
    while velocity(&world, id)[1] <= 0.0 {
        world.step();
    }
    // From 1 m above.
    let fallen = (2.0 * G).sqrt();
    assert_relative(velocity(&world, id)[0], 0.1 * 1.5 * fallen, 2e-3, "what the first bounce gave");
}

/// On a smooth floor, with nothing to hold on to, a cart goes back as the crate on it goes forth.
#[test]
fn a_belt_that_is_free_is_pushed_back() {
    let mut world = earth();
    add_floor(&mut world, 0.0);
    let cart = Body::dynamic(Shape::obb(10.0, 0.5)).at([0.0, 0.25]).mass(3.0).restitution(0.0);
    let cart = add(&mut world, cart.friction(FRICTION).surface_speed(2.0));
    let id = add(&mut world, crate_at(0.0, 1.0).mass(1.0));
    run(&mut world, 1.5);
    // v - V = 2 and v + 3 V = 0.
    assert_near(velocity(&world, id)[0], 1.5, 2e-3, "the crate");
    assert_near(velocity(&world, cart)[0], -0.5, 2e-3, "the cart");
}

/// A tower whose lowest box bears 10,000 times its weight is solved directly, and rides on.
#[test]
fn a_load_that_is_solved_directly_rides_on_the_belt() {
    let mut world = earth();
    let belt = Body::fixed(Shape::aabb(200.0, 2.0)).at([0.0, -1.0]).friction(0.1).restitution(0.0);
    add(&mut world, belt.surface_speed(2.0));
    let low = add(&mut world, unit_box(0.0, 0.5).mass(1.0).friction(0.3));
    let high = add(&mut world, unit_box(0.0, 1.5).mass(10_000.0).friction(0.3));
    // 0.2 g for what is on the belt, of the average of 0.1 and 0.3; the boxes hold on to each other with 0.3 g.
    let gain = 0.2 * G;
    for tick in 1..150 {
        world.step();
        let expected = (gain * f64::from(tick) / 60.0).min(2.0);
        for id in [low, high] {
            // To 2 % of the belt's, as the tower sways when it ceases to gain speed.
            assert_near(velocity(&world, id)[0], expected, gain / 240.0 + 0.04, "its speed");
        }
    }
    run(&mut world, 1.0);
    assert_near(velocity(&world, high)[0], 2.0, 1e-3, "it goes with the belt");
    assert_eq!(world.body(low).unwrap().tier(), Tier::Direct);
    assert_near(place(&world, high)[1], 1.5, 1e-3, "the tower stands");
}

/// A belt drags nothing faster than it goes itself, whatever jams on it: light and heavy crates, in turn, before a wall, where friction between
/// them bears on friction with the belt. To the speed that friction gives in a substep, µ g h.
#[test]
fn crates_that_jam_before_a_wall_are_never_faster_than_the_belt() {
    for (heavy, gap) in [5.0, 50.0].into_iter().flat_map(|heavy| [0.6, 0.8, 1.0, 1.2].map(|gap| (heavy, gap)))
    {
        let mut world = earth();
        add(&mut world, belt(2.0).friction(0.6));
        add(&mut world, Body::fixed(Shape::aabb(1.0, 4.0)).at([6.5, 2.0]).restitution(0.0));
        let crates: Vec<_> = (0..6)
            .map(|place| {
                let mass = if place % 2 == 0 { heavy } else { 5.0 };
                let shape = Shape::obb(0.5, 0.5);
                let body = Body::dynamic(shape).at([5.0 - gap * f64::from(place), 0.25]).mass(mass);
                add(&mut world, body.restitution(0.0).friction(0.6))
            })
            .collect();
        for tick in 0..600 {
            world.step();
            for &id in &crates {
                let [vx, vy] = velocity(&world, id);
                let speed = vx.hypot(vy);
                assert!(
                    speed < 2.0 + 0.6 * G / 240.0,
                    "{speed} m/s at tick {tick}, {heavy} kg, {gap} m apart"
                );
            }
        }
    }
}

/// Pressed against a wall by the belt it comes to rest, sleeps, and wakes as the belt goes the other way.
#[test]
fn a_belt_that_turns_round_wakes_what_lies_on_it() {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    let id = add(&mut world, belt(1.0));
    add(&mut world, Body::fixed(Shape::aabb(1.0, 4.0)).at([1.0, 2.0]).restitution(0.0).friction(0.0));
    let crate_ = add(&mut world, crate_at(-0.2, 0.5));
    run(&mut world, 4.0);
    assert!(world.body(crate_).unwrap().is_sleeping());
    let before = world.state_hash();
    world.body_mut(id).unwrap().set_surface_speed(1.0);
    assert!(world.body(crate_).unwrap().is_sleeping(), "it is the speed it has");
    world.body_mut(id).unwrap().set_surface_speed(-1.0);
    assert_ne!(world.state_hash(), before);
    run(&mut world, 1.0);
    assert_near(velocity(&world, crate_)[0], -1.0, 1e-4, "it goes with the belt");
}

/// Crates and discs on belts of several speeds and on a floor, some bouncing: the same bits in lanes of any width.
#[test]
fn belts_come_to_the_same_at_every_width_of_lanes() {
    let step = |lanes: Lanes| {
        let mut world = World::new(Settings { lanes, ..Settings::default() });
        world.add_force(Force::EARTH_GRAVITY);
        for number in 0..40_u8 {
            let x = 2.0 * f64::from(number);
            let floor = Body::fixed(Shape::aabb(2.0, 1.0)).at([x, -0.5]);
            add(&mut world, floor.surface_speed(f32::from(number % 4) - 1.0));
            let shape = if number % 3 == 0 { Shape::circle(0.4) } else { Shape::obb(0.8, 0.8) };
            add(&mut world, Body::dynamic(shape).at([x, 0.6]));
            add(&mut world, Body::dynamic(shape).at([x, 1.6]).restitution(0.0));
        }
        run(&mut world, 2.0);
        world.state_hash()
    };
    let one = step(Lanes::One);
    for lanes in [Lanes::Four, Lanes::Eight, Lanes::Sixteen] {
        assert_eq!(step(lanes), one, "{lanes:?}");
    }
}

#[test]
fn a_speed_that_is_none_is_refused() {
    let mut world = earth();
    for speed in [f32::NAN, f32::INFINITY, -2e6] {
        let refused = world.add(belt(speed)).unwrap_err();
        assert!(refused.to_string().contains("the surface speed"), "{refused}");
    }
    assert_eq!(world.body_count(), 0);
    let id = add(&mut world, belt(7.0));
    assert_eq!(world.body(id).unwrap().describe().get_surface_speed(), 7.0);
}
