//! Hits, and what contacts give their bodies over a tick: the sum is what momentum changes by.

use rustycs::prelude::*;

use crate::support::{G, add, add_floor, assert_near, assert_relative, earth_with, run, unit_box, velocity};

/// Impulses may differ from the change of momentum by this share of m |v| before and after: a dozen roundings of `f32`, 6e-8
/// each, and those of the velocities that they are compared with.
const SHARE: f64 = 1e-5;

const RESTITUTIONS: [f32; 3] = [0.0, 0.5, 1.0];

/// A world in which nothing sleeps, with gravity or without.
fn world_with(sum_impulses: bool, gravity: bool) -> World {
    let mut world = World::new(Settings { sum_impulses, sleep: false, ..Settings::default() });
    if gravity {
        world.add_force(Force::EARTH_GRAVITY);
    }
    world
}

fn moment(world: &World, id: BodyId) -> [f64; 2] {
    velocity(world, id).map(|v| v * f64::from(world.body(id).unwrap().mass()))
}

/// What gravity gives a body in so many ticks, N s.
fn by_weight(world: &World, id: BodyId, ticks: u32) -> f64 {
    let weight: f64 = world.forces().map(|(_, force)| f64::from(force.acceleration().y)).sum();
    weight / 60.0 * f64::from(ticks) * f64::from(world.body(id).unwrap().mass())
}

/// Steps until the body is hit; fails unless the blow is what its momentum has changed by, but for gravity.
fn blow_on(world: &mut World, id: BodyId) -> HitEvent {
    let (before, mut ticks, mut fastest) = (moment(world, id), 0, 0.0_f64);
    while world.events().hits().is_empty() {
        assert!(ticks < 240, "no hit");
        let [x, y] = moment(world, id);
        fastest = fastest.max(x.hypot(y));
        world.step();
        ticks += 1;
    }
    let hit = world.events().hits()[0];
    let (after, blow) = (moment(world, id), hit.impulse_on(id));
    // Gravity is rounded in each of the ticks.
    let tolerance = SHARE * (fastest + after[0].hypot(after[1]));
    assert_near(blow.x.into(), after[0] - before[0], tolerance, "impulse to the right");
    let upward = after[1] - before[1] - by_weight(world, id, ticks);
    assert_near(blow.y.into(), upward, tolerance, "impulse upward");
    hit
}

/// Takes a tick; fails unless the contacts of the body have given it what its momentum has changed by, but for gravity.
fn step_and_compare(world: &mut World, id: BodyId) -> Vec2 {
    let before = moment(world, id);
    world.step();
    let after = moment(world, id);
    let (mut given, mut size) = (Vec2::ZERO, before[0].hypot(before[1]) + after[0].hypot(after[1]));
    for contact in world.contacts_of(id) {
        let on_body = contact.impulse_on(id).expect("they are added up");
        given += on_body;
        size += f64::from(on_body.length());
    }
    assert_near(f64::from(given.x), after[0] - before[0], SHARE * size, "impulse to the right");
    let upward = after[1] - before[1] - by_weight(world, id, 1);
    assert_near(f64::from(given.y), upward, SHARE * size, "impulse upward");
    given
}

/// Two bodies that spin and slide past each other as they meet, in empty space.
#[test]
fn a_blow_between_free_bodies_is_what_their_momenta_change_by() {
    for restitution in RESTITUTIONS {
        for shape in [Shape::circle(0.5), Shape::obb(1.2, 0.8)] {
            let mut world = world_with(false, false);
            let moving = Body::dynamic(shape).at([-2.0, 0.2]).velocity([9.0, -0.5]).angular_velocity(3.0);
            let moving = add(&mut world, moving.mass(2.0).restitution(restitution));
            let resting = Body::dynamic(shape).at([0.0, -0.1]).angle(0.3).mass(5.0).restitution(restitution);
            let resting = add(&mut world, resting);
            let hit = blow_on(&mut world, moving);
            assert_eq!(hit.other(moving), Some(resting));
            assert_eq!(hit.impulse_on(moving), -hit.impulse_on(resting), "it is given and taken");
        }
    }
}

/// What falls on the floor loses m v and gets e m v; and its weight is borne for what is left of the tick.
#[test]
fn a_blow_from_the_floor_is_what_stops_and_throws_back() {
    for restitution in RESTITUTIONS {
        for shape in [Shape::circle(0.5), Shape::aabb(1.0, 1.0), Shape::obb(1.0, 1.0)] {
            let mut world = world_with(false, true);
            add(&mut world, Body::fixed(Shape::aabb(20.0, 2.0)).at([0.0, -1.0]).restitution(restitution));
            let falling = Body::dynamic(shape).at([0.0, 4.0]).velocity([2.0, 0.0]).mass(3.0);
            let falling = add(&mut world, falling.friction(0.3).restitution(restitution));
            let hit = blow_on(&mut world, falling);
            let speed = (2.0 * G * 3.5).sqrt();
            // The speed of a blow without restitution is that as the tick begins in which it does.
            assert_near(hit.speed.into(), speed, 2.0 * G / 60.0, "speed");
            if !matches!(shape, Shape::Obb(_)) {
                // A box is also turned by the friction.
                let blow = 3.0 * speed * f64::from(1.0 + restitution);
                assert_near(hit.normal_impulse.into(), blow, 3.0 * G / 60.0, "impulse along the normal");
            }
            // It slides: friction is the average of 0.3 and 0.6, times the impulse of the blow.
            assert!(hit.impulse_on(falling).x < 0.0, "friction slows it down");
            assert!(hit.tangent_impulse.abs() <= 0.45001 * hit.normal_impulse, "{hit:?}");
            // A box without restitution that friction turns rises again in the same tick.
            let risen = velocity(&world, falling)[1].max(0.0) / 60.0;
            assert_near(hit.point.y, 0.0, 1e-3 + risen, "it met the surface of the floor");
            assert_eq!(hit.normal_on(falling), Vec2::new(0.0, 1.0));
        }
    }
}

/// What is struck cannot give way, as the floor bears it: the blow may go to and fro between the three within the tick.
#[test]
fn a_blow_on_what_rests_on_the_floor_is_what_the_striking_body_loses() {
    for restitution in RESTITUTIONS {
        for (x, shape) in [(0.0, Shape::circle(0.5)), (0.2, Shape::circle(0.5)), (0.1, Shape::obb(0.8, 0.6))]
        {
            let mut world = world_with(false, true);
            add_floor(&mut world, 0.6);
            let resting = add(&mut world, unit_box(0.0, 0.5).mass(2.0).restitution(restitution));
            run(&mut world, 1.0);
            let striking = Body::dynamic(shape).at([x, 2.5]).velocity([0.0, -6.0]).mass(3.0);
            let striking = add(&mut world, striking.restitution(restitution));
            let hit = blow_on(&mut world, striking);
            assert_eq!(hit.other(striking), Some(resting));
            // It goes on to fall until they meet, and no longer than to the end of the tick that they meet in.
            let fastest = f64::sqrt(36.0 + 2.0 * G * 1.5);
            assert!((6.0..=fastest).contains(&f64::from(hit.speed)), "{hit:?}");
            let blow = f64::from(hit.normal_impulse);
            assert!(
                blow > 3.0 * 6.0 / 3.0,
                "it is as if the box were as heavy as the floor, or gave way: {hit:?}"
            );
        }
    }
}

/// It begins in the last substep of a tick, which slows the fall down for what is still to go, and is over in the next.
#[test]
fn a_blow_that_falls_between_two_ticks_is_told_whole() {
    for number in 0..50_u8 {
        let mut world = world_with(false, true);
        add_floor(&mut world, 0.6);
        let id = add(&mut world, unit_box(0.0, 1.3 + 0.01 * f64::from(number)).mass(2.0));
        let hit = blow_on(&mut world, id);
        world.step();
        assert!(world.events().hits().is_empty(), "it is told once");
        let fall = f64::sqrt(2.0 * G * (0.8 + 0.01 * f64::from(number)));
        assert_near(hit.normal_impulse.into(), 2.0 * fall, 2.0 * G / 60.0, "m v");
    }
}

/// A bullet and a wall: it meets and leaves within one tick.
#[test]
fn a_blow_at_300_metres_per_second_is_exact_too() {
    for restitution in RESTITUTIONS {
        let mut world = world_with(false, false);
        let wall = Body::fixed(Shape::aabb(0.1, 9.0)).at([20.0, 0.0]).restitution(restitution);
        let wall = add(&mut world, wall);
        let bullet = Body::dynamic(Shape::circle(0.05)).velocity([300.0, 0.0]).mass(0.01);
        let bullet = add(&mut world, bullet.restitution(restitution));
        let hit = blow_on(&mut world, bullet);
        assert_eq!((hit.other(wall), hit.speed), (Some(bullet), 300.0));
        assert_near(hit.point.x, 19.95, 1e-3, "it met the face of the wall");
        assert_relative(hit.normal_impulse.into(), 3.0 * f64::from(1.0 + restitution), SHARE, "(1 + e) m v");
    }
}

/// The sums of all contacts of each body of a stack on which something falls, tick by tick: through what touched before too.
#[test]
fn impulses_of_contacts_add_up_to_the_change_of_momentum_in_a_stack_that_is_struck() {
    for restitution in RESTITUTIONS {
        let mut world = world_with(true, true);
        let floor = add_floor(&mut world, 0.6);
        let boxes: Vec<_> = (0..4_u8)
            .map(|i| add(&mut world, unit_box(0.0, f64::from(i) + 0.5).restitution(restitution)))
            .collect();
        run(&mut world, 1.0);
        assert!(
            world.events().hits().is_empty(),
            "a stack that stands is no hit: {:?}",
            world.events().hits()
        );
        let rock = Body::dynamic(Shape::circle(0.5)).at([0.1, 4.6]).velocity([0.0, -8.0]).mass(3.0);
        add(&mut world, rock.restitution(restitution));
        let mut slams = 0;
        for tick in 0..60_usize {
            let id = boxes[tick % 4];
            step_and_compare(&mut world, id);
            for hit in world.events().hits() {
                let contact = world.contact_between(hit.a, hit.b).expect("it is still there");
                let in_tick = contact.impulse_on(hit.b).map(|on| on.dot(hit.normal));
                // And what the tick before has begun.
                assert!(
                    in_tick.is_some_and(|in_tick| in_tick <= hit.normal_impulse),
                    "{in_tick:?} of {hit:?}"
                );
                slams += usize::from(hit.other(floor) == Some(boxes[0]));
            }
        }
        assert!(slams >= 1, "the blow comes through to the floor");
    }
}

/// A lift that stood starts at 20 m/s under a box at rest.
#[test]
fn a_plate_that_kicks_what_rests_on_it_hits_it() {
    for restitution in RESTITUTIONS {
        let mut world = world_with(true, true);
        let plate = Body::kinematic(Shape::aabb(4.0, 1.0)).at([0.0, -0.5]).restitution(restitution);
        let plate = add(&mut world, plate);
        let id = add(&mut world, unit_box(0.0, 0.5).mass(2.0).restitution(restitution));
        run(&mut world, 1.0);
        world.body_mut(plate).unwrap().set_velocity([0.0, 20.0]);
        let given = step_and_compare(&mut world, id);
        let hits = world.events().hits();
        assert_eq!(hits.len(), 1, "{hits:?}");
        assert_eq!((hits[0].other(plate), hits[0].impulse_on(id)), (Some(id), given));
        assert!(given.y >= 2.0 * 20.0, "it goes at least as fast as the plate: {given}");
    }
}

/// A press that comes down at 3 m/s on a box that stands on the floor: the floor hits it too.
#[test]
fn what_is_crushed_is_hit_from_both_sides() {
    let mut world = world_with(true, true);
    let floor = add_floor(&mut world, 0.6);
    let id = add(&mut world, unit_box(0.0, 0.5));
    run(&mut world, 1.0);
    let press = Body::kinematic(Shape::aabb(4.0, 1.0)).at([0.0, 1.7]).velocity([0.0, -3.0]);
    let press = add(&mut world, press.restitution(0.0));
    let mut from = Vec::new();
    for _ in 0..10 {
        step_and_compare(&mut world, id);
        from.extend(world.events().hits().iter().filter_map(|hit| hit.other(id)));
    }
    assert!(from.contains(&press) && from.contains(&floor), "{from:?}");
}

/// A disc that rolls from tile to tile, and a box that slides over them.
#[test]
fn impulses_add_up_on_the_seams_of_a_floor_of_tiles() {
    let mut world = world_with(true, true);
    for i in 0..40_u8 {
        // A valley, so that each tile is met at an angle.
        let x = 0.5 * (f64::from(i) - 20.0);
        let tile = Body::fixed(Shape::obb(0.5, 0.2)).at([x, 0.01 * x * x - 0.1]).angle(0.02 * x as f32);
        add(&mut world, tile.restitution(0.0));
    }
    let disc = Body::dynamic(Shape::circle(0.4)).at([-6.0, 0.8]).friction(0.6).restitution(0.0);
    let disc = add(&mut world, disc);
    let sliding = unit_box(5.0, 0.85).friction(0.1).velocity([-2.0, 0.0]);
    let sliding = add(&mut world, sliding);
    for tick in 0..240 {
        let id = if tick % 2 == 0 { disc } else { sliding };
        step_and_compare(&mut world, id);
    }
}

/// A rod that spins on its spot hits with its tip, which goes at ω r.
#[test]
fn the_speed_of_a_hit_is_that_of_the_points_that_meet() {
    for restitution in RESTITUTIONS {
        let mut world = world_with(false, false);
        let rod =
            Body::dynamic(Shape::obb(2.0, 0.1)).angular_velocity(6.0).friction(0.0).restitution(restitution);
        let rod = add(&mut world, rod);
        let post = Body::fixed(Shape::circle(0.1)).at([0.7, 0.5]).restitution(restitution);
        add(&mut world, post);
        while world.events().hits().is_empty() {
            world.step();
        }
        let hit = world.events().hits()[0];
        // The face of the rod meets the post where it is 0.15 m from its middle line. By its middle it goes 0.05 m less far out.
        let arm = f64::sqrt(0.7 * 0.7 + 0.5 * 0.5 - 0.15 * 0.15);
        assert_relative(hit.speed.into(), 6.0 * arm, 2e-2, "ω r");
        let body = world.body(rod).unwrap();
        let (mass, inertia) = (f64::from(body.mass()), f64::from(body.inertia()));
        let blow = f64::from(1.0 + restitution) * 6.0 * arm / (mass.recip() + arm * arm / inertia);
        assert_relative(hit.normal_impulse.into(), blow, 2e-2, "(1 + e) ω r / (1/m + r²/I)");
    }
}

/// To add impulses up changes nothing else, and tells of no hit less.
#[test]
fn adding_impulses_up_changes_no_bit() {
    for name in ["pile", "pinball", "tumbler", "tower"] {
        let scene = rustycs_scenes::all().iter().find(|scene| scene.name == name).expect("it is there");
        let mut worlds = [false, true]
            .map(|sum_impulses| scene.build(1, Settings { sum_impulses, ..Settings::default() }));
        let mut counts = [0; 2];
        for _ in 0..120 {
            for (world, count) in worlds.iter_mut().zip(&mut counts) {
                scene.before_tick(world);
                world.step();
                *count += world.events().hits().len();
            }
            let [without, with] = worlds.each_ref().map(|world| world.events().hits());
            assert!(without.iter().all(|hit| with.iter().any(|other| [hit.a, hit.b] == [other.a, other.b])));
        }
        assert_eq!(worlds[0].state_hash(), worlds[1].state_hash(), "{name}");
        assert!(counts[1] >= counts[0]);
    }
}

/// While nobody asks there are no sums; and none of what sleeps.
#[test]
fn what_is_not_added_up_is_not_told() {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    add_floor(&mut world, 0.6);
    let id = add(&mut world, unit_box(0.0, 0.5));
    run(&mut world, 0.2);
    let impulse = |world: &World| world.contacts_of(id).next().expect("it rests").impulse_on(id);
    assert_eq!(impulse(&world), None);
    world.set_settings(Settings { sum_impulses: true, ..Settings::default() }).unwrap();
    world.step();
    let weight = f64::from(world.body(id).unwrap().mass()) * G / 60.0;
    assert_relative(impulse(&world).expect("it is added up").y.into(), weight, 1e-3, "m g dt");
    run(&mut world, 3.0);
    assert!(world.body(id).unwrap().is_sleeping());
    assert_eq!(impulse(&world), None);
}

/// A game that rolls back keeps its states in worlds that were others before. A blow that began in the last substep of a tick is told in the
/// next, of the clone too, and what the last tick has borne is told at once.
#[test]
fn a_clone_into_a_world_that_was_another_tells_the_same_hits() {
    let settings = Settings { sum_impulses: true, ..Settings::default() };
    let mut spare = World::new(Settings::default());
    for number in 0..60 {
        let mut world = earth_with(settings.clone());
        add_floor(&mut world, 0.6);
        let body = add(&mut world, unit_box(0.0, 0.8 + 0.01 * f64::from(number)));
        let mut fork = world.clone();
        for tick in 0..60 {
            spare.clone_from(&fork);
            std::mem::swap(&mut spare, &mut fork);
            let borne = |world: &World| {
                world.contacts_of(body).map(|contact| contact.impulse_on(body)).collect::<Vec<_>>()
            };
            assert_eq!(borne(&fork), borne(&world), "from height {number} in tick {tick}");
            world.step();
            fork.step();
            assert_eq!(fork.events().hits(), world.events().hits(), "from height {number} in tick {tick}");
        }
    }
}

/// Discs without restitution that meet a crate off its middle, and glance off it or stop: each is told to have begun, and hit, however far into
/// the tick that is. What was slowed down in one tick and has gone in the next is told in that, with all that its momentum has changed by. And a
/// crate that is removed in between was hit all the same.
#[test]
fn no_blow_without_restitution_is_lost() {
    let mut cut_off = 0;
    for (mass, speed) in
        [1.0, 10.0, 1e4].into_iter().flat_map(|mass| [3.0, 8.0, 20.0].map(|speed| (mass, speed)))
    {
        for number in 0..35_u8 {
            let (height, tilt) = (0.1 * (f64::from(number % 7) - 3.0), 0.1 * f32::from(number / 7));
            let mut world = world_with(false, false);
            let body = Body::dynamic(Shape::obb(1.0, 1.0)).mass(mass).at([4.0, 0.0]).angle(tilt);
            let target = add(&mut world, body.restitution(0.0));
            let disc = Body::dynamic(Shape::circle(0.25)).mass(1.0).at([0.0, height]);
            let disc = add(&mut world, disc.velocity([speed, 0.0]).restitution(0.0));
            let mut began = 0;
            let hit = (0..120).find_map(|_| {
                let before = world.body(disc).unwrap().velocity();
                world.step();
                let change = world.body(disc).unwrap().velocity() - before;
                began += world.events().began().len();
                let hit = world.events().hits().first().copied();
                if change.length() > 1.0 && hit.is_none() && number % 2 == 0 {
                    world.remove(target).unwrap();
                    cut_off += 1;
                }
                hit
            });
            let case = format!("{mass} kg at {speed} m/s, {height} m off, tilted by {tilt}");
            assert_eq!((began, hit.is_some()), (1, true), "{case}");
            let change = world.body(disc).unwrap().velocity() - Vec2::new(speed, 0.0);
            let missing = hit.unwrap().impulse_on(disc) - change;
            assert_near(missing.length().into(), 0.0, 1e-5 * f64::from(speed), &case);
        }
    }
    assert!(cut_off > 5, "{cut_off} crates were removed in between");
}

/// Where two links of a chain meet on a hill, the disc meets one of them at a time of its own: it is told to be hit as by level ground, with m v up
/// to the square of the slope, from every height.
#[test]
fn a_disc_that_stops_at_a_convex_corner_hits_it() {
    for number in 0..50_u8 {
        let mut world = world_with(false, false);
        add(&mut world, Ground::chain([[-3.0, -0.1], [0.0, 0.0], [3.0, -0.1]]).unwrap());
        let disc = Body::dynamic(Shape::circle(0.3)).at([0.002, 2.0 + 0.02 * f64::from(number)]).mass(1.0);
        add(&mut world, disc.velocity([0.0, -10.0]).restitution(0.0));
        let (mut began, mut hits) = (0, Vec::new());
        for _ in 0..30 {
            world.step();
            began += world.events().began().len();
            hits.extend_from_slice(world.events().hits());
        }
        let given: f32 = hits.iter().map(|hit| hit.normal_impulse).sum();
        assert!(began >= 1 && !hits.is_empty(), "{began} began, {hits:?}");
        assert_relative(given.into(), 10.0, 0.1 * 0.1 / 9.0, "m v");
    }
}

/// Boxes without restitution that tumble against a wall: what hits them is told no later than its contact has ended.
#[test]
fn no_hit_is_told_after_its_contact_has_ended() {
    for number in 0..60_u8 {
        let mut world = world_with(false, false);
        add(&mut world, Body::fixed(Shape::rectangle(1.0, 6.0)).at([0.5, 0.0]));
        let body = Body::dynamic(Shape::rectangle(1.0, 0.5)).at([-2.0 - 0.013 * f64::from(number % 20), 0.0]);
        let body = body.angle(0.05 * f32::from(number)).velocity([10.0, 0.0]);
        add(&mut world, body.mass(1.0).restitution(0.0));
        let mut touching = 0_usize;
        for tick in 0..60 {
            world.step();
            let events = world.events();
            assert!(
                events.hits().is_empty() || touching + events.began().len() > 0,
                "throw {number}, tick {tick}: {:?}",
                events.hits()
            );
            touching = touching + events.began().len() - events.ended().len();
        }
    }
}
