//! Contacts, events, and the error of a step.

use rustycs::prelude::*;

use crate::support::{G, add, add_floor, assert_near, assert_relative, earth, earth_with, run, unit_box};

/// The bodies of an event.
fn pair(event: &ContactEvent) -> (BodyId, BodyId) {
    (event.a, event.b)
}

fn sum_of_normal_impulses(world: &World) -> f64 {
    world.contacts().flat_map(|contact| contact.points()).map(|point| f64::from(point.normal_impulse)).sum()
}

/// At rest the ground returns the weight: over a substep of h the impulses add up to m g h.
#[test]
fn the_impulses_under_a_resting_body_add_up_to_its_weight() {
    for substeps in [2, 4, 8] {
        let mut world = earth_with(Settings { substeps, ..Settings::default() });
        let floor = add_floor(&mut world, 0.6);
        let resting = add(&mut world, unit_box(0.0, 0.5));
        run(&mut world, 3.0);
        let h = 1.0 / 60.0 / f64::from(substeps);
        assert_relative(sum_of_normal_impulses(&world), G * h, 1e-3, "m g h");
        let contact = world.contacts().next().unwrap();
        assert_eq!((contact.a(), contact.b(), contact.points().len()), (floor, resting, 2));
        assert!(contact.is_touching());
        assert_near(f64::from(contact.normal().x), 0.0, 1e-6, "the normal points from the floor");
        assert_near(f64::from(contact.normal().y), 1.0, 1e-6, "to the box");
        for (position, x) in contact.positions().zip([-0.5, 0.5]) {
            assert_near(position.x.abs(), f64::abs(x), 1e-3, "at the corners");
            assert_near(position.y, 0.0, 5e-3, "at the surface");
        }
        for point in contact.points() {
            assert!((-0.005..=0.0).contains(&point.separation), "{}", point.separation);
        }
    }
}

/// Where a ball that is not slow touches the ground is below its centre, seen from either of the two.
#[test]
fn the_contact_point_goes_with_a_ball_that_rolls() {
    for (speed, is_ground_first) in [1.0, 3.0, 10.0].into_iter().flat_map(|v| [(v, true), (v, false)]) {
        let mut world = earth();
        let ball = Body::dynamic(Shape::circle(0.5))
            .at([0.0, 0.5])
            .velocity([speed, 0.0])
            .angular_velocity(-2.0 * speed);
        let ball = if is_ground_first {
            add_floor(&mut world, 0.6);
            add(&mut world, ball)
        } else {
            let ball = add(&mut world, ball);
            add_floor(&mut world, 0.6);
            ball
        };
        // Of both bodies the place, the anchor and the way of the step are rounded, by half a digit each of how far the
        // ball gets.
        let rounding = f64::from(6.0 * 0.5 * f32::EPSILON * (0.5 + 0.5 * speed));
        for _ in 0..30 {
            world.step();
            let contact = world.contacts().next().unwrap();
            let from = |id, anchor: Vec2| world.body(id).unwrap().position() + anchor;
            let center = world.body(ball).unwrap().position();
            let point = contact.points()[0];
            for found in [from(contact.a(), point.anchor_a), from(contact.b(), point.anchor_b)] {
                assert_near(f64::from(found.x - center.x), 0.0, rounding, "below the centre");
                assert_near(f64::from(found.y - center.y), -0.5, rounding, "on the circle");
            }
        }
    }
}

/// Two bodies, whichever was added first: the normal points from a to b.
#[test]
fn the_normal_of_a_contact_points_from_a_to_b() {
    let (low, high) = ([0.0, 0.0], [0.0, 0.95]);
    for [first, second] in [[low, high], [high, low]] {
        let mut world = World::new(Settings::default());
        for at in [first, second] {
            add(&mut world, Body::dynamic(Shape::circle(0.5)).at(at));
        }
        world.step();
        let contact = world.contacts().next().unwrap();
        let [a, b] = [contact.a(), contact.b()].map(|id| world.body(id).unwrap().position());
        assert!((b - a).dot(contact.normal()) > 0.9, "{:?}", contact.normal());
    }
}

/// A ball of no restitution falls on the floor: it begins to touch once, hits once, and is reported as ended
/// once, when it is taken away.
#[test]
fn a_fall_is_one_beginning_one_hit_and_one_end() {
    for drop in [0.5_f64, 2.0, 10.0] {
        let mut world = earth();
        let floor = add_floor(&mut world, 0.6);
        let ball = add(&mut world, Body::dynamic(Shape::circle(0.5)).at([0.0, 0.5 + drop]).restitution(0.0));
        let (mut began, mut ended, mut hits) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..180 {
            world.step();
            began.extend(world.events().began().iter().map(pair));
            ended.extend(world.events().ended().iter().map(pair));
            hits.extend_from_slice(world.events().hits());
        }
        assert_eq!((began, ended), (vec![(floor, ball)], vec![]));
        assert_eq!(hits.len(), 1);
        assert_eq!((hits[0].a, hits[0].b), (floor, ball));
        // The speed is that at the beginning of the step in which the solver first stopped the approach: at
        // most a tick and a substep before they met.
        let speed = (2.0 * G * drop).sqrt();
        let found = f64::from(hits[0].speed);
        assert!(
            found <= speed * 1.0001 && found >= speed - G * (1.0 / 60.0 + 1.0 / 240.0),
            "{found} for {speed}"
        );
        assert!(world.remove(ball).is_some());
        assert!(world.events().ended().is_empty(), "the events are those of the last step");
        world.step();
        assert_eq!(world.events().ended().iter().map(pair).collect::<Vec<_>>(), [(floor, ball)]);
        world.step();
        assert!(world.events().ended().is_empty());
    }
}

/// The impact stage knows the very moment: the speed of a bounce is exact.
#[test]
fn the_hit_of_a_bounce_has_the_speed_of_the_fall() {
    let mut world = earth();
    add(&mut world, Body::fixed(Shape::aabb(20.0, 1.0)).at([0.0, -0.5]).restitution(0.8));
    add(&mut world, Body::dynamic(Shape::circle(0.5)).at([0.0, 2.5]).restitution(0.8));
    let mut speeds = Vec::new();
    for _ in 0..120 {
        world.step();
        speeds.extend(world.events().hits().iter().map(|hit| f64::from(hit.speed)));
        assert_eq!(world.events().began().len(), world.events().hits().len());
    }
    let first = (2.0 * G * 2.0_f64).sqrt();
    assert_relative(speeds[0], first, 2e-3, "√(2 g 2 m)");
    assert_relative(speeds[1], 0.8 * first, 2e-3, "after one bounce");
}

#[test]
fn a_slow_touch_is_no_hit() {
    let mut world = earth_with(Settings { hit_threshold: 3.0, ..Settings::default() });
    add_floor(&mut world, 0.6);
    // √(2 g 0.3 m) = 2.4 m/s, √(2 g 0.8 m) = 4 m/s.
    add(&mut world, unit_box(0.0, 0.8));
    let fast = add(&mut world, unit_box(5.0, 1.3));
    let (mut began, mut hits) = (0, Vec::new());
    for _ in 0..60 {
        world.step();
        began += world.events().began().len();
        hits.extend(world.events().hits().iter().map(|hit| hit.b));
    }
    assert_eq!((began, hits), (2, vec![fast]));
}

#[test]
fn bodies_that_part_end_their_contact_once() {
    for speed in [1.0_f32, 10.0, 1000.0] {
        let mut world = earth();
        let floor = add_floor(&mut world, 0.6);
        let id = add(&mut world, unit_box(0.0, 0.5));
        run(&mut world, 0.5);
        world.body_mut(id).unwrap().set_velocity([0.0, speed]);
        let mut ended = Vec::new();
        for tick in 0..5 {
            world.step();
            ended.extend(world.events().ended().iter().map(|event| (tick, pair(event))));
        }
        assert_eq!(ended, [(0, (floor, id))], "at {speed} m/s");
    }
}

/// Taken away by hand, a body ceases to touch in the next step, not in the one after.
#[test]
fn bodies_that_are_taken_apart_end_their_contact_in_the_next_step() {
    for to in [[0.0, 0.7], [0.0, 50.0], [1e9, 1e9]] {
        let mut world = earth();
        let floor = add_floor(&mut world, 0.6);
        let id = add(&mut world, unit_box(0.0, 0.5));
        run(&mut world, 0.5);
        world.body_mut(id).unwrap().set_position(to).unwrap();
        world.step();
        let ended: Vec<_> = world.events().ended().iter().map(pair).collect();
        assert_eq!(ended, [(floor, id)], "to {to:?}");
        world.step();
        assert!(world.events().ended().is_empty(), "to {to:?}");
    }
}

/// A ball that begins 1 cm deep: the error names it, and then it is driven out.
#[test]
fn the_error_of_a_step_names_the_deepest_overlap() {
    let mut world = crate::support::space();
    assert_eq!(world.error(), world.clone().error());
    assert_eq!(world.error().penetration, 0.0);
    add(&mut world, Body::fixed(Shape::circle(1.0)).restitution(0.0));
    add(&mut world, Body::dynamic(Shape::circle(1.0)).at([0.0, 1.99]).restitution(0.0));
    world.step();
    let first = world.error().penetration;
    // Driven out at 28 1/s for a tick: e^(-28/60) = 0.63 is left.
    assert!((0.004..0.01).contains(&first), "{first}");
    run(&mut world, 1.0);
    assert!(world.error().penetration < 1e-4, "{}", world.error().penetration);
    assert!(world.error().velocity_residual < 1e-3, "{}", world.error().velocity_residual);
}

/// What the last step did not solve is neither its error nor in its counts.
#[test]
fn error_and_counts_are_those_of_the_last_step_and_no_other() {
    let mut world = earth();
    add(&mut world, Body::fixed(Shape::aabb(20.0, 1.0)).at([0.0, -0.5]).restitution(1.0));
    let ball = Body::dynamic(Shape::circle(0.5)).at([0.0, 0.51]).velocity([0.0, -5.0]).restitution(1.0);
    let ball = add(&mut world, ball);
    let sunk = add(&mut world, unit_box(5.0, 0.4));
    world.step();
    assert!(world.error().penetration > 0.0);
    assert_eq!(world.profile().counters().impacts, 1);
    assert!(world.remove(ball).is_some() && world.remove(sunk).is_some());
    world.step();
    assert_eq!((world.error().penetration, world.error().velocity_residual), (0.0, 0.0));
    let counters = world.profile().counters();
    assert_eq!((counters.impacts, counters.bouncy_contacts, counters.contacts), (0, 0, 0));
    assert!(!world.profile().stage(Stage::Solve).ran);
}

/// The contacts of each body and of each pair are those that a look at all of them finds.
#[test]
fn contacts_of_a_body_and_of_a_pair_are_those_among_all() {
    let mut world = rustycs_scenes::find("pile").unwrap().build(1, Settings::default());
    run(&mut world, 3.0);
    let key = |contact: ContactRef<'_>| (contact.a(), contact.b());
    let all: Vec<(BodyId, BodyId)> = world.contacts().map(key).collect();
    assert!(all.len() > 100, "{} contacts", all.len());
    let ids: Vec<BodyId> = world.bodies().map(|(id, _)| id).collect();
    for &id in &ids {
        let mut of_body: Vec<_> = world.contacts_of(id).map(key).collect();
        of_body.sort_unstable();
        let mut among_all: Vec<_> = all.iter().copied().filter(|&(a, b)| a == id || b == id).collect();
        among_all.sort_unstable();
        assert_eq!(of_body, among_all);
    }
    for (&one, &other) in ids.iter().zip(&ids[1..]).chain(all.iter().map(|(a, b)| (a, b))) {
        let among_all = all.iter().copied().find(|&pair| pair == (one, other) || pair == (other, one));
        for found in [world.contact_between(one, other), world.contact_between(other, one)] {
            assert_eq!(found.map(key), among_all);
        }
    }
    assert!(world.contact_between(ids[0], ids[0]).is_none());
}

/// Each of the two is pushed away from the other, and who is neither is not.
#[test]
fn a_contact_is_seen_from_either_body() {
    let mut world = earth();
    let ball = add(&mut world, Body::dynamic(Shape::circle(0.5)).at([0.0, 0.5]));
    let floor = add_floor(&mut world, 0.6);
    let other = add(&mut world, unit_box(9.0, 9.0));
    world.step();
    for (id, from, up) in [(ball, floor, 1.0), (floor, ball, -1.0)] {
        let contact = world.contacts_of(id).next().unwrap();
        assert_eq!((contact.other(id), contact.other(other)), (Some(from), None));
        assert_eq!(contact.normal_on(id), Vec2::new(0.0, up));
        assert_eq!(contact.normal_on(other), Vec2::ZERO);
    }
    world.remove(ball);
    assert_eq!((world.contacts_of(ball).count(), world.contact_between(ball, floor).is_none()), (0, true));
}

/// The world may be changed while its events are looked through; what is reported later is not lost by that.
#[test]
fn events_can_be_taken_out_of_a_world() {
    let mut world = earth();
    let floor = add_floor(&mut world, 0.6);
    let glass = [0.0, 3.0].map(|x| add(&mut world, unit_box(x, 0.51).velocity([0.0, -5.0])));
    world.step();
    let events = world.take_events();
    assert!(world.events().hits().is_empty());
    for hit in events.hits() {
        let broken = hit.other(floor).unwrap();
        assert_eq!(
            (hit.other(broken), hit.other(glass[0]) == Some(floor)),
            (Some(floor), broken == glass[0])
        );
        assert!(world.remove(broken).is_some());
    }
    assert_eq!(
        (events.hits().len(), events.began()[0].other(floor), world.body_count()),
        (2, Some(glass[0]), 1)
    );
    assert!(world.take_events().ended().is_empty());
    world.step();
    assert_eq!(world.events().ended().len(), 2);
}
