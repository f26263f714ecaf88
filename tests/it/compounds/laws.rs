//! A body of several shapes moves as one body with the same mass, centre of mass and moment of inertia does.

use core::f64::consts::PI;

use rustycs::prelude::*;

use crate::support::{
    G, add, add_floor, assert_near, assert_relative, earth, place, run, space, spin, unit_box, velocity,
};

/// A box of 2 m x 1 m and density 1 in two halves.
fn halves() -> Body {
    let half = || Shape::rectangle(1.0, 1.0);
    Body::dynamic(half()).with(Collider::new(half()).at([1.0, 0.0])).density(1.0)
}

/// Two discs of radius r at ±a, each of mass m: I = 2 (m r²/2 + m a²).
#[test]
fn a_dumbbell_weighs_by_the_parallel_axis_theorem() {
    let mut world = space();
    let (radius, arm) = (0.5_f32, 2.0_f32);
    let ball = Collider::new(Shape::circle(radius)).at([2.0 * arm, 0.0]);
    let id = add(
        &mut world,
        Body::dynamic(Shape::circle(radius)).at([-f64::from(arm), 3.0]).with(ball).density(3.0),
    );
    let body = world.body(id).unwrap();
    let mass = 3.0 * PI * 0.25;
    assert_relative(f64::from(body.mass()), 2.0 * mass, 1e-6, "mass");
    assert_relative(
        f64::from(body.inertia()),
        2.0 * (0.5 * mass * 0.25 + mass * 4.0),
        1e-6,
        "moment of inertia",
    );
    assert_eq!(place(&world, id), [0.0, 3.0]);
    assert_eq!(body.origin(), [-2.0, 3.0].into());
}

/// A mass that is given scales the moment of inertia; a sensor weighs nothing.
#[test]
fn a_given_mass_scales_the_moment_of_inertia_and_sensors_weigh_nothing() {
    let mut world = space();
    let sensor = Collider::new(Shape::circle(5.0)).at([9.0, 0.0]).density(100.0).sensor(true);
    let id = add(&mut world, halves().with(sensor).mass(6.0));
    let body = world.body(id).unwrap();
    assert_eq!(body.mass(), 6.0);
    assert_relative(f64::from(body.inertia()), 6.0 * (4.0 + 1.0) / 12.0, 1e-6, "moment of inertia of a box");
    assert_eq!(place(&world, id), [0.5, 0.0]);
}

/// The centre of mass flies along x = v t, y = -g t²/2, the shapes go round it evenly.
#[test]
fn a_thrown_hammer_flies_as_its_centre_of_mass_does_and_its_shapes_go_round_it() {
    let mut world = earth();
    let head = Collider::new(Shape::rectangle(0.2, 0.5)).at([0.6, 0.0]).density(7.8);
    let hammer = Body::dynamic(Shape::rectangle(1.0, 0.1)).density(0.6).with(head);
    let id = add(&mut world, hammer.velocity([3.0, 10.0]).angular_velocity(8.0));
    let (start, arm) = (place(&world, id), world.body(id).unwrap().origin().x - place(&world, id)[0]);
    let spinning = 8.0;
    run(&mut world, 2.0);
    let body = world.body(id).unwrap();
    let expected = [start[0] + 6.0, start[1] + 20.0 - 0.5 * G * 4.0];
    for (found, expected) in body.position_f64().into_iter().zip(expected) {
        assert_near(found, expected, 1e-5, "the centre of mass");
    }
    // 2 s at 8 rad/s, in steps whose rotation has seven digits each.
    let (s, c) = f64::sin_cos(2.0 * spinning);
    let handle = body.colliders().next().unwrap().pose();
    assert_near(handle.center.x - body.position_f64()[0], arm * c, 1e-4, "the handle goes round, x");
    assert_near(handle.center.y - body.position_f64()[1], arm * s, 1e-4, "the handle goes round, y");
}

/// From rest on a slope beyond its angle of friction a block slides with g (sin θ - µ cos θ), however it is put together.
#[test]
fn a_block_in_two_halves_slides_down_a_slope_as_a_whole_one_does() {
    let (tilt, friction) = (0.5_f32, 0.2_f32);
    let Rot { c, s } = Rot::from_angle(tilt);
    let mut world = earth();
    add(
        &mut world,
        Body::fixed(Shape::rectangle(200.0, 2.0)).angle(-tilt).friction(friction).restitution(0.0),
    );
    // On the surface, 1 m above the middle of the slope along its normal.
    let up = Vec2::new(s, c);
    let along = Vec2::new(c, -s);
    let own = up * 1.5 - along * 0.5;
    let block = halves().at(own).angle(-tilt).friction(friction).restitution(0.0);
    let id = add(&mut world, block);
    let start = world.body(id).unwrap().position();
    run(&mut world, 2.0);
    let slid = f64::from((world.body(id).unwrap().position() - start).dot(along));
    let expected = 0.5 * G * (f64::from(s) - f64::from(friction) * f64::from(c)) * 4.0;
    assert_relative(slid, expected, 1e-3, "way down the slope");
}

/// A disc hits the end of a rod at rest, without friction, e = 1: the impulse along the normal is J = 2 v/(1/m₁ + 1/m₂ + d²/I),
/// with the centre of the rod at the distance d.
#[test]
fn a_rod_of_three_pieces_is_struck_at_its_end_as_one_rod_is() {
    let mut world = space();
    let piece = || Shape::rectangle(1.0, 0.2);
    let rod = Body::dynamic(piece())
        .with(Collider::new(piece()).at([-1.0, 0.0]))
        .with(Collider::new(piece()).at([1.0, 0.0]));
    let rod = add(&mut world, rod.density(1.0).friction(0.0).restitution(1.0));
    let disc = Body::dynamic(Shape::circle(0.2)).at([1.2, 1.0]).velocity([0.0, -4.0]).density(1.0);
    let disc = add(&mut world, disc.friction(0.0).restitution(1.0));
    run(&mut world, 0.5);
    let (m_1, m_2, inertia, d) = (PI * 0.04, 0.6, 0.6 * (9.0 + 0.04) / 12.0, 1.2);
    let impulse = 2.0 * 4.0 / (1.0 / m_1 + 1.0 / m_2 + d * d / inertia);
    assert_relative(velocity(&world, disc)[1], -4.0 + impulse / m_1, 1e-4, "the disc");
    assert_relative(velocity(&world, rod)[1], -impulse / m_2, 1e-4, "the rod");
    assert_relative(spin(&world, rod), -impulse * d / inertia, 1e-4, "its spin");
}

/// A wheel that is heavier on one side rolls on a level floor without a loss: what it gains going down it gives back.
#[test]
fn an_unbalanced_wheel_keeps_its_energy_as_it_rolls() {
    let mut world = earth();
    add_floor(&mut world, 1.0);
    // The weight touches nothing.
    let none = Filter { mask: 0, ..Filter::DEFAULT };
    let weight = Collider::new(Shape::circle(0.2)).at([0.5, 0.0]).density(5.0).filter(none);
    let wheel = Body::dynamic(Shape::circle(1.0)).with(weight).density(1.0).friction(1.0).restitution(0.0);
    let id = add(&mut world, wheel.at([0.0, 1.0]).angular_velocity(-4.0));
    // Rolling: the point that touches the floor is at rest.
    let below = world.body(id).unwrap().position_f64();
    let rolling = Vec2::new(below[1] as f32, -below[0] as f32) * 4.0;
    world.body_mut(id).unwrap().set_velocity(rolling);
    let before = world.energy();
    let (mut least, mut most) = (before, before);
    for _ in 0..600 {
        world.step();
        (least, most) = (least.min(world.energy()), most.max(world.energy()));
    }
    assert!(place(&world, id)[0] > 20.0, "it rolls");
    assert_relative(least, before, 5e-3, "least energy");
    assert_relative(most, before, 5e-3, "greatest energy");
}

/// A table stands on its legs; loaded beyond them it tips. With the outside of the legs at ±1.05 m and a weight m at 1.5 m on
/// a table of mass M it tips if m (1.5 - 1.05) > M 1.05.
#[test]
fn a_table_stands_on_its_legs_and_tips_over_them() {
    for (density, tips) in [(3.0, false), (4.5, true)] {
        let mut world = earth();
        add_floor(&mut world, 0.8);
        let leg = |x: f32| Collider::new(Shape::rectangle(0.1, 1.0)).at([x, -0.55]).density(0.01);
        let table = Body::dynamic(Shape::rectangle(4.0, 0.1)).with(leg(-1.0)).with(leg(1.0)).density(4.0);
        let table = add(&mut world, table.at([0.0, 1.05]).friction(0.8).restitution(0.0));
        // The table weighs 1.6 kg.
        add(&mut world, unit_box(1.5, 1.6).density(density));
        let mut tilt = 0.0_f32;
        for _ in 0..180 {
            world.step();
            tilt = tilt.max(world.body(table).unwrap().angle().abs());
        }
        // From there on it would not come back by itself.
        assert_eq!(tilt > 0.7, tips, "{density} kg: tilt {tilt}");
        assert!(tips || tilt < 1e-3, "it stands: tilt {tilt}");
    }
}

/// What holds for piles of boxes holds for piles of crosses, hooks and dumbbells: they come to rest and sleep.
#[test]
fn a_pile_of_many_kinds_of_compounds_comes_to_rest_and_sleeps() {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    add_floor(&mut world, 0.6);
    for side in [-1.0, 1.0] {
        add(&mut world, Body::fixed(Shape::aabb(1.0, 20.0)).at([side * 5.5, 9.0]));
    }
    let bar = || Shape::rectangle(1.0, 0.25);
    let cross = || Body::dynamic(bar()).with(Collider::new(bar()).angle(core::f32::consts::FRAC_PI_2));
    let hook = || Body::dynamic(bar()).with(Collider::new(Shape::rectangle(0.25, 0.8)).at([0.4, -0.4]));
    let dumbbell = || {
        let ball = |x: f32| Collider::new(Shape::circle(0.25)).at([x, 0.0]);
        Body::dynamic(Shape::rectangle(0.8, 0.1)).with(ball(-0.4)).with(ball(0.4))
    };
    for number in 0..30_u32 {
        let body = vec![cross(), hook(), dumbbell()].swap_remove(number as usize % 3);
        let (column, row) = (number % 5, number / 5);
        let at = [1.8 * f64::from(column) - 3.6, 1.0 + 1.5 * f64::from(row)];
        add(&mut world, body.at(at).angle(0.7 * number as f32).density(1.0).restitution(0.1));
    }
    for tick in 0..1800 {
        world.step();
        if tick % 100 == 0 {
            world.validate().unwrap();
        }
    }
    assert_eq!(world.awake_count(), 0, "all sleep within 30 s");
    let deepest = f64::from(world.error().penetration);
    assert!(deepest < 5e-3, "overlap of {deepest} m");
}
