//! Filters: what is left out is as if it were not there.

use rustycs::prelude::*;

use crate::support::{add, add_floor, assert_near, earth, place, run, space, unit_box, velocity};

/// Collides with nothing.
const NOTHING: Filter = Filter { mask: 0, ..Filter::DEFAULT };

/// The rule of the field, in its own words.
fn should_collide(a: Filter, b: Filter) -> bool {
    match (a.group, b.group) {
        (a, b) if a == b && a > 0 => true,
        (a, b) if a == b && a < 0 => false,
        _ => a.mask & b.category != 0 && b.mask & a.category != 0,
    }
}

/// Every pair of 64 filters, each as two boxes that overlap and are pushed apart if they collide, and nothing is known of if
/// they do not.
#[test]
fn bodies_collide_as_their_filters_say() {
    let mut filters = Vec::new();
    for category in [0x1, 0x2, 0x4, 1 << 63] {
        for mask in [0, 0x1, 0x6, u64::MAX] {
            filters.extend([0, 1, 2, -1].map(|group| Filter { category, mask, group }));
        }
    }
    let mut world = space();
    let (mut pairs, mut number) = (Vec::new(), 0.0);
    for &a in &filters {
        for &b in &filters {
            let ids = [(a, 0.0), (b, 0.9)].map(|(filter, x)| {
                let at = [number % 64.0 * 4.0 + x, (number / 64.0_f64).floor() * 4.0];
                add(&mut world, unit_box(0.0, 0.0).at(at).filter(filter))
            });
            number += 1.0;
            pairs.push((ids, should_collide(a, b)));
        }
    }
    world.step();
    let colliding = pairs.iter().filter(|(_, collide)| *collide).count();
    assert!((500..3500).contains(&colliding), "{colliding} of {}", pairs.len());
    assert_eq!(world.profile().counters().pairs, colliding);
    for ([a, b], collide) in pairs {
        assert_eq!(world.may_collide(a, b), Some(collide));
        assert_eq!(world.contact_between(a, b).is_some(), collide);
        assert_eq!(world.body(b).unwrap().pose() != world.body(b).unwrap().previous_pose(), collide);
    }
    world.validate().unwrap();
}

/// Bit for bit, beside a heap that does collide.
#[test]
fn what_collides_with_nothing_falls_as_if_alone() {
    let mut alone = earth();
    let free = add(&mut alone, unit_box(0.0, 4.0).angular_velocity(1.0));
    let mut world = earth();
    let ghost = add(&mut world, unit_box(0.0, 4.0).angular_velocity(1.0).filter(NOTHING));
    add_floor(&mut world, 0.6);
    for number in 0..12_u8 {
        add(&mut world, unit_box(f64::from(number % 3) - 1.0, 0.5 + f64::from(number / 3)));
    }
    for _ in 0..120 {
        alone.step();
        world.step();
        assert_eq!(world.body(ghost).unwrap().pose(), alone.body(free).unwrap().pose());
        assert_eq!(world.contacts_of(ghost).count(), 0);
    }
}

/// A gun shoots from within the player, who does not feel it: 100 bullets of 300 m/s that hit a wall, come back within a step
/// and pass through him again; and one of another group, which hits him.
#[test]
fn a_bullet_ignores_its_shooter() {
    let mut world = space();
    let own = |filter| Filter { group: -1, ..filter };
    let player = add(&mut world, unit_box(0.0, 0.0).filter(own(Filter::DEFAULT)));
    let wall = add(&mut world, Body::fixed(Shape::aabb(1.0, 50.0)).at([4.0, 0.0]).restitution(1.0));
    let bullet = Body::dynamic(Shape::circle(0.05)).restitution(1.0).velocity([300.0, 0.0]);
    let mut bullets = Vec::new();
    let mut hits = 0;
    for _ in 0..100 {
        bullets.push(add(&mut world, bullet.clone().filter(own(Filter { category: 4, mask: !4, group: 0 }))));
        world.step();
        hits += world.events().hits().iter().filter(|hit| hit.other(wall).is_some()).count();
        assert_eq!((velocity(&world, player), place(&world, player)), ([0.0; 2], [0.0; 2]));
    }
    assert_eq!(hits, 100);
    for id in bullets {
        assert_near(velocity(&world, id)[0], -300.0, 0.3, "a bullet that bounced");
        world.remove(id);
    }
    add(&mut world, bullet.at([-4.0, 0.0]));
    run(&mut world, 0.1);
    // (1 + e) v m/(m + M): e is 0, as the player has none.
    let m = f64::from(Material::DEFAULT.density) * std::f64::consts::PI * 0.05 * 0.05;
    let expected = 300.0 * m / (m + 1.0);
    assert_near(velocity(&world, player)[0], expected, 1e-3 * expected, "the bullet of another hits him");
}

#[test]
fn a_filter_that_is_set_ends_and_begins_contacts() {
    let mut world = earth();
    let floor = add_floor(&mut world, 0.6);
    let [low, high] = [0.5, 1.5].map(|y| add(&mut world, unit_box(0.0, y)));
    run(&mut world, 1.0);
    let before = world.state_hash();
    world.body_mut(low).unwrap().set_filter(NOTHING);
    assert_ne!(world.state_hash(), before);
    assert_eq!(world.body(low).unwrap().filter(), NOTHING);
    world.validate().unwrap();
    world.step();
    assert_eq!(world.events().ended().len(), 2, "with the floor and with the other box");
    // Both fall through what is left of the step by g dt.
    for id in [low, high] {
        assert_near(velocity(&world, id)[1], -9.81 / 60.0, 1e-3, "a box that nothing bears");
    }
    run(&mut world, 0.5);
    // It is within the floor, which pushes it out now, and falls on it; the other has come to the floor meanwhile.
    world.body_mut(low).unwrap().set_filter(Filter::DEFAULT);
    world.body_mut(low).unwrap().set_position([3.0, 0.5]).unwrap();
    run(&mut world, 2.0);
    for id in [low, high] {
        assert_near(place(&world, id)[1], 0.5, 5e-3, "on the floor");
        assert!(world.contact_between(id, floor).is_some());
    }
    world.validate().unwrap();
}

/// A sleeping box, of which the floor, the box itself, or the pair changes.
#[test]
fn what_sleeps_wakes_when_it_may_collide_with_others() {
    let changes: [fn(&mut World, BodyId, BodyId); 3] = [
        |world, floor, _| world.body_mut(floor).unwrap().set_filter(NOTHING),
        |world, _, id| world.body_mut(id).unwrap().set_filter(NOTHING),
        |world, floor, id| _ = world.set_collision(floor, id, false),
    ];
    for change in changes {
        let mut world = World::new(Settings::default());
        world.add_force(Force::EARTH_GRAVITY);
        let floor = add_floor(&mut world, 0.6);
        let id = add(&mut world, unit_box(0.0, 0.5));
        run(&mut world, 3.0);
        assert!(world.body(id).unwrap().is_sleeping());
        change(&mut world, floor, id);
        assert!(!world.body(id).unwrap().is_sleeping());
        world.step();
        world.validate().unwrap();
        assert_eq!(world.events().ended().len(), 1);
        run(&mut world, 1.0);
        assert!(place(&world, id)[1] < -4.0, "it falls through the floor");
    }
}

#[test]
fn a_pair_that_is_parted_passes_through_each_other_only() {
    let mut world = earth();
    let floor = add_floor(&mut world, 0.6);
    let [one, other] = [0.0, 3.0].map(|x| add(&mut world, unit_box(x, 0.5)));
    assert_eq!(world.set_collision(floor, one, false), Some(true));
    assert_eq!(world.set_collision(one, floor, false), Some(false), "it is told what held before");
    assert_eq!((world.may_collide(one, floor), world.may_collide(other, floor)), (Some(false), Some(true)));
    let mut fork = World::default();
    fork.clone_from(&world);
    assert_eq!(fork.state_hash(), world.state_hash());
    run(&mut world, 0.5);
    run(&mut fork, 0.5);
    assert_eq!(fork.state_hash(), world.state_hash());
    assert!(place(&world, one)[1] < -0.5);
    assert_near(place(&world, other)[1], 0.5, 1e-3, "the other stands");
    // Put back above the floor, it falls onto it.
    assert_eq!(world.set_collision(floor, one, true), Some(false));
    world.body_mut(one).unwrap().set_position([0.0, 0.6]).unwrap();
    world.body_mut(one).unwrap().set_velocity([0.0, 0.0]);
    run(&mut world, 1.0);
    assert_near(place(&world, one)[1], 0.5, 1e-3, "it stands too");
    world.validate().unwrap();
}

/// Its place is given to another, which collides with all.
#[test]
fn a_pair_that_is_parted_is_forgotten_with_the_body() {
    let mut world = earth();
    let floor = add_floor(&mut world, 0.6);
    let first = add(&mut world, unit_box(0.0, 0.5).filter(NOTHING));
    assert_eq!(world.set_collision(floor, first, false), Some(true));
    world.remove(first);
    assert_eq!(world.set_collision(floor, first, false), None);
    assert_eq!(world.set_collision(floor, floor, false), None);
    assert_eq!(world.may_collide(floor, first), None);
    let second = add(&mut world, unit_box(0.0, 0.5));
    assert_eq!(second.index(), first.index(), "it has the place of the first");
    assert_eq!(
        (world.may_collide(floor, second), world.body(second).unwrap().filter()),
        (Some(true), Filter::DEFAULT)
    );
    run(&mut world, 1.0);
    assert_near(place(&world, second)[1], 0.5, 1e-3, "it stands");
}

#[test]
fn a_filter_comes_back_with_the_description() {
    let mut world = space();
    let filter = Filter { category: 0x2, mask: 0xF, group: 3 };
    let id = add(&mut world, unit_box(0.0, 0.0).filter(filter));
    assert_eq!(world.body(id).unwrap().describe().get_filter(), filter);
    world.body_mut(id).unwrap().set_shape(Shape::circle(0.3)).unwrap();
    world.shrink_to_fit();
    assert_eq!(world.body_mut(id).unwrap().filter(), filter);
    assert_eq!(world.remove(id).unwrap().get_filter(), filter);
}
