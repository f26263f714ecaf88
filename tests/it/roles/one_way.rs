//! One-way floors: what comes from the free side stands, all else passes as if there were no floor.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

use crate::support::{G, add, add_floor, assert_near, earth, place, run, space, unit_box, velocity};

/// 20 cm thick, its surface at height 0.
fn floor() -> Body {
    let floor = Body::fixed(Shape::aabb(10.0, 0.2)).at([0.0, -0.1]);
    floor.friction(0.6).restitution(0.0).one_way([0.0, 3.0])
}

fn shapes() -> [Shape; 4] {
    let kite = [[0.0, -0.5], [0.4, 0.0], [0.0, 0.5], [-0.4, 0.0]];
    [Shape::circle(0.5), Shape::aabb(1.0, 1.0), Shape::obb(0.8, 1.0), Shape::polygon(kite).unwrap()]
}

/// Bit for bit as without a floor for as long as it rises, through one floor and a second one inside of which it comes to its
/// highest point; it falls through that, and stands on the first.
#[test]
fn a_body_jumps_through_from_below_and_lands() {
    for shape in shapes() {
        let body =
            Body::dynamic(shape).at([0.0, -2.0]).fixed_rotation(true).restitution(0.0).velocity([0.0, 8.0]);
        let mut alone = earth();
        let free = add(&mut alone, body.clone());
        let mut world = earth();
        add(&mut world, floor());
        // The highest point of its centre is 8²/2g - 2 = 1.26 m.
        add(&mut world, floor().at([0.0, 1.6]));
        let id = add(&mut world, body);
        while velocity(&world, id)[1] > -2.0 {
            world.step();
            alone.step();
            assert_eq!(world.body(id).unwrap().pose(), alone.body(free).unwrap().pose(), "{shape:?}");
            assert_eq!(world.contacts_of(id).count(), 0);
        }
        run(&mut world, 2.0);
        assert_near(place(&world, id)[1], 0.5, 2e-3, "it stands on the first floor");
        assert!(world.contacts_of(id).all(|contact| contact.is_touching()));
    }
}

/// Up to 500 m/s from below, 8 m per step, and from above.
#[test]
fn no_speed_takes_a_body_through_from_above_or_stops_it_from_below() {
    for shape in shapes() {
        for speed in [1.0_f32, 5.0, 20.0, 100.0, 500.0] {
            let mut world = space();
            add(&mut world, floor());
            let body = Body::dynamic(shape).fixed_rotation(true).restitution(0.0).friction(0.0);
            let rising = add(&mut world, body.clone().at([-3.0, -3.0]).velocity([0.0, speed]));
            let falling = add(&mut world, body.at([3.0, 3.0]).velocity([0.0, -speed]));
            run(&mut world, (6.0 / f64::from(speed)).max(0.1));
            assert_eq!(velocity(&world, rising), [0.0, f64::from(speed)], "{shape:?}");
            assert_near(place(&world, falling)[1], 0.5, 5e-3, "it is stopped");
        }
    }
}

/// Each contact decides for itself: the one that stands does not feel the other jump.
#[test]
fn two_players_use_one_floor() {
    let play = |with_second: bool| {
        let mut world = earth();
        add(&mut world, floor());
        let standing = add(&mut world, unit_box(-2.0, 0.5));
        let second = with_second.then(|| add(&mut world, unit_box(2.0, -2.0).velocity([0.0, 9.0])));
        for _ in 0..180 {
            world.step();
            assert_near(place(&world, standing)[1], 0.5, 1e-3, "it stands");
        }
        (world.body(standing).unwrap().pose(), second.map(|id| place(&world, id)[1]))
    };
    let (alone, _) = play(false);
    let (beside, second) = play(true);
    assert_eq!(beside, alone);
    assert_near(second.unwrap(), 0.5, 1e-3, "so does the other, at last");
}

#[test]
fn what_began_within_the_floor_passes_until_it_has_left() {
    for (start, up, ends_above) in
        [(-0.1, 0.0, false), (0.3, 0.0, false), (0.45, 0.0, false), (-0.1, 6.0, true)]
    {
        let mut world = earth();
        add(&mut world, floor());
        let id = add(&mut world, unit_box(0.0, start).velocity([0.0, up]));
        world.step();
        // It is neither pushed out nor held.
        assert_near(velocity(&world, id)[1], f64::from(up) - G / 60.0, 1e-5, "it falls freely");
        run(&mut world, 2.0);
        let y = place(&world, id)[1];
        assert!(if ends_above { (y - 0.5).abs() < 2e-3 } else { y < -5.0 }, "from {start}: {y}");
    }
}

/// And on from the end of one floor onto another, without a kick.
#[test]
fn a_body_from_the_side_passes_and_one_on_top_slides_on() {
    let mut world = space();
    add(&mut world, floor());
    add(&mut world, floor().at([10.0, -0.1]));
    let smooth = |y: f64| unit_box(-8.0, y).friction(0.0).velocity([5.0, 0.0]);
    let level = add(&mut world, smooth(-0.1).filter(Filter { group: -1, ..Filter::DEFAULT }));
    run(&mut world, 5.0);
    assert_eq!(velocity(&world, level), [5.0, 0.0]);
    let mut world = earth();
    add(&mut world, floor().friction(0.0));
    add(&mut world, floor().friction(0.0).at([10.0, -0.1]));
    let on_top = add(&mut world, smooth(0.5).at([-4.0, 0.5]).fixed_rotation(true));
    run(&mut world, 2.0);
    assert_near(place(&world, on_top)[1], 0.5, 1e-3, "it is on the second floor");
}

/// Parted for a moment, and then within the floor.
#[test]
fn a_player_drops_through_a_floor_that_bears_others() {
    let mut world = earth();
    let id = add(&mut world, floor());
    let below = add_floor(&mut world, 0.6);
    world.body_mut(below).unwrap().set_position([0.0, -4.0]).unwrap();
    let [player, other] = [0.0, 3.0].map(|x| add(&mut world, unit_box(x, 0.5)));
    run(&mut world, 0.5);
    world.set_collision(player, id, false);
    run(&mut world, 0.1);
    world.set_collision(player, id, true);
    run(&mut world, 2.0);
    assert_near(place(&world, player)[1], -2.5, 2e-3, "it is one floor lower");
    assert_near(place(&world, other)[1], 0.5, 1e-3, "the other is not");
    world.validate().unwrap();
}

/// A lift takes along what stands on it and passes what it meets from above; one that is turned bears on its left.
#[test]
fn the_direction_goes_with_the_floor() {
    let mut world = earth();
    let lift = Body::kinematic(Shape::obb(4.0, 0.2)).restitution(0.0).one_way([0.0, 1.0]);
    add(&mut world, lift.clone().at([0.0, -0.1]).velocity([0.0, 1.0]));
    let rider = add(&mut world, unit_box(0.0, 0.5));
    let bottom = add_floor(&mut world, 0.6);
    world.body_mut(bottom).unwrap().set_position([0.0, -5.0]).unwrap();
    add(&mut world, lift.at([8.0, 0.0]).velocity([0.0, -1.0]));
    let below = add(&mut world, unit_box(8.0, -3.5));
    run(&mut world, 3.0);
    assert_near(place(&world, rider)[1], 3.5, 2e-3, "it rides");
    assert_near(place(&world, below)[1], -3.5, 2e-3, "it is not pressed down");

    let mut world = space();
    let wall = Body::fixed(Shape::obb(10.0, 0.2)).restitution(0.0).one_way([0.0, 1.0]);
    add(&mut world, wall.angle(std::f32::consts::FRAC_PI_2));
    let [from_left, from_right] = [(-3.0, 4.0), (3.0, -4.0)].map(|(x, v): (f64, f32)| {
        add(&mut world, unit_box(x, x).fixed_rotation(true).restitution(0.0).velocity([v, 0.0]))
    });
    run(&mut world, 2.0);
    // Turned by 90° the direction points to the left.
    assert_near(place(&world, from_left)[0], -0.6, 2e-3, "it is stopped");
    assert_eq!(velocity(&world, from_right), [-4.0, 0.0]);
}

#[test]
fn a_ball_bounces_on_the_free_side() {
    let mut world = earth();
    add(&mut world, floor().restitution(1.0));
    let ball = add(&mut world, Body::dynamic(Shape::circle(0.2)).at([0.0, 1.2]).restitution(1.0));
    let start = world.energy();
    run(&mut world, 10.0);
    assert_near(world.energy(), start, 1e-3 * start.abs(), "its energy");
    assert!(place(&world, ball)[1] > 0.19);
}

/// A smooth body thrown among floors at all angles, in some of which it begins. It gains no more than the height by which it is
/// lifted out where it lay less than 1/80 of a floor's 50 cm deep in the surface.
#[test]
fn nothing_gains_energy_by_one_way_floors() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(31);
    let mut stood = 0;
    for number in 0..200_usize {
        let mut world = earth();
        let mut any = |low: f32, high: f32| random.random_range(low..high);
        for _ in 0..8 {
            let floor =
                Body::fixed(Shape::obb(any(2.0, 6.0), any(0.1, 0.5))).at([any(-4.0, 4.0), any(-4.0, 4.0)]);
            let floor = floor.angle(any(-0.5, 0.5)).one_way([any(-0.3, 0.3), 1.0]);
            add(&mut world, floor.restitution(0.0).friction(0.0));
        }
        let body =
            Body::dynamic(shapes()[number % 4]).mass(1.0).fixed_rotation(true).restitution(0.0).friction(0.0);
        let id = add(
            &mut world,
            body.at([any(-3.0, 3.0), any(-4.0, 4.0)]).velocity([any(-4.0, 4.0), any(-3.0, 9.0)]),
        );
        let mut before = world.energy();
        for tick in 0..120 {
            world.step();
            world.validate().unwrap();
            stood += usize::from(world.contacts_of(id).any(|contact| contact.is_touching()));
            let lifted = G * 0.5 / 80.0;
            assert!(
                world.energy() <= before + lifted,
                "{number}, {tick}: {} J after {before} J",
                world.energy()
            );
            before = world.energy();
        }
    }
    assert!(stood > 2000, "{stood} ticks on a floor: a test of nothing");
}

#[test]
fn a_floor_may_become_one_way_and_cease_to_be() {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    let id = add(&mut world, floor());
    assert_eq!(world.body(id).unwrap().describe().get_one_way(), Some(Vec2::Y), "a length of 1");
    let crate_ = add(&mut world, unit_box(0.0, 0.5));
    run(&mut world, 3.0);
    assert!(world.body(crate_).unwrap().is_sleeping());
    for direction in [Vec2::ZERO, Vec2::new(f32::NAN, 0.0)] {
        let refused = world.body_mut(id).unwrap().set_one_way(direction).unwrap_err();
        assert!(refused.to_string().contains("one-way"), "{refused}");
        assert!(world.add(floor().one_way(direction)).is_err());
    }
    world.body_mut(id).unwrap().set_one_way(None).unwrap();
    run(&mut world, 1.0);
    assert_near(place(&world, crate_)[1], 0.5, 1e-3, "it stands on a floor of any kind");
    // The other way round it passes.
    world.body_mut(id).unwrap().set_one_way(-Vec2::Y).unwrap();
    run(&mut world, 1.0);
    assert!(place(&world, crate_)[1] < -2.0);
    world.validate().unwrap();
}
