//! Too many bodies for the place they have, and what walls close on.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

use super::hold;

#[test]
fn discs_that_walls_squeeze_find_their_places() {
    hold(&["squeezed"]);
}

#[test]
fn two_boxes_in_each_other_part_gently() {
    hold(&["overlap-10", "overlap-50", "overlap-90", "overlap-99"]);
}

/// A press comes down at 1 m/s on a disc that lies on a box, and leaves too little room for both. No impulses are enough, and none may be kept:
/// the box came out at 2,400 m/s. Nothing is faster than the press and what pushes overlapping bodies apart, 3 m/s, together, and
/// what it holds comes to rest.
#[test]
fn a_press_that_leaves_too_little_room_shoots_nothing_away() {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    world.add(Body::fixed(Shape::obb(2000.0, 1.0)).at([0.0, -0.5])).unwrap();
    let press = world.add(Body::kinematic(Shape::obb(2.0, 0.2)).at([0.0, 1.2])).unwrap();
    let bodies = [
        world.add(Body::dynamic(Shape::obb(0.4, 0.4)).at([0.0, 0.2])).unwrap(),
        world.add(Body::dynamic(Shape::circle(0.25)).at([0.16, 0.65])).unwrap(),
    ];
    let fastest = |world: &World| {
        bodies.iter().map(|&id| world.body(id).unwrap().velocity().length()).fold(0.0, f32::max)
    };
    for tick in 0..400 {
        let height = (1.2 - f64::from(tick) / 60.0).max(0.4);
        world.body_mut(press).unwrap().move_to(Pose::at([0.0, height]));
        world.step();
        assert!(fastest(&world) <= 1.0 + 3.0, "{} m/s at tick {tick}", fastest(&world));
    }
    assert!(fastest(&world) < 1e-3, "{} m/s", fastest(&world));
}

/// A bar with its end under a ledge bears 50 times its mass at the end of the long arm, of 40 lengths of the short one: ledge and edge press with many
/// times all that rests on them, and hold it. Forces and moments of the contacts of the bar add up to those of its weight (Archimedes), but
/// for a swing that has nearly ended, a ten-thousandth of what presses.
#[test]
fn a_long_lever_bears_what_hangs_on_its_end() {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    world.add(Body::fixed(Shape::obb(0.1, 1.0)).at([0.05, -0.5])).unwrap();
    world.add(Body::fixed(Shape::obb(0.1, 1.0)).at([0.0, 0.6])).unwrap();
    let bar = world.add(Body::dynamic(Shape::obb(2.0, 0.1)).at([1.0, 0.05]).mass(1.0)).unwrap();
    let load = world.add(Body::dynamic(Shape::obb(0.3, 0.3)).at([1.8, 0.25]).mass(50.0)).unwrap();
    (0..600).for_each(|_| world.step());
    assert!(world.body(load).unwrap().velocity().length() < 1e-2);
    let (mut force, mut moment, mut pressed) = (Vec2::ZERO, 0.0, 0.0);
    for contact in world.contacts_of(bar) {
        let (normal, is_a) = (contact.normal_on(bar), contact.a() == bar);
        for point in contact.points() {
            let anchor = if is_a { point.anchor_a } else { point.anchor_b };
            let tangent = if is_a { -contact.normal().perp() } else { contact.normal().perp() };
            let impulse = normal * point.normal_impulse + tangent * point.tangent_impulse;
            force += impulse * 240.0;
            moment += anchor.cross(impulse) * 240.0;
            pressed += point.normal_impulse * 240.0;
        }
    }
    let weight = 1.0 * 9.81;
    assert!((force.y - weight).abs() < 1e-4 * pressed, "{force:?}");
    assert!(moment.abs() < 1e-4 * pressed, "{moment} N m");
    assert!(pressed > 10.0 * 51.0 * 9.81, "{pressed} N: no lever");
}

/// A box of 8 m x 4 m with a heap of 10 to 39 bodies of one size or another, whose right wall then moves in at 1.5 m/s, until the bodies fill
/// four fifths of what is left. Returns how many there are, and how many are outside two seconds later.
fn press_heap(seed: u64) -> [usize; 2] {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    for (x, y, width, height) in [(0.0, -0.5, 30.0, 1.0), (0.0, 4.5, 30.0, 1.0), (-0.5, 2.0, 1.0, 10.0)] {
        world.add(Body::fixed(Shape::aabb(width, height)).at([x, y])).unwrap();
    }
    let wall = world.add(Body::kinematic(Shape::aabb(1.0, 3.98)).at([8.5, 2.0])).unwrap();
    let (mut ids, mut area) = (Vec::new(), 0.0);
    for number in 0..random.random_range(10..40_u8) {
        let size: f32 = random.random_range(0.2..0.7);
        let shape = match random.random_range(0..3) {
            0 => Shape::circle(0.5 * size),
            1 => Shape::obb(size, size * random.random_range(0.4..1.0)),
            _ => Shape::obb(0.5 * size, 0.5 * size),
        };
        area += shape.area();
        let at = [0.5 + 0.95 * f32::from(number % 8), 0.5 + 0.75 * f32::from(number / 8)];
        let body = Body::dynamic(shape).at(at).angle(random.random_range(0.0..6.0));
        ids.push(world.add(body.density(random.random_range(0.5..5.0))).unwrap());
    }
    let end = f64::from(area) / 0.8 / 4.0;
    while world.body(wall).unwrap().position_f64()[0] > end + 0.5 {
        world.body_mut(wall).unwrap().set_velocity([-1.5, 0.0]);
        world.step();
    }
    world.body_mut(wall).unwrap().set_velocity([0.0, 0.0]);
    (0..120).for_each(|_| world.step());
    let is_outside = |&&id: &&BodyId| {
        let [x, y] = world.body(id).unwrap().position_f64();
        let end = world.body(wall).unwrap().position_f64()[0];
        !(0.0..=end).contains(&x) || !(0.0..=4.0).contains(&y)
    };
    [ids.len(), ids.iter().filter(is_outside).count()]
}

/// A body is outside with its centre in a wall. Where what is squeezed was taken for loads to be borne at any effort, one in a hundred was; with
/// plain sweeps one in 300 is.
#[test]
fn a_press_that_closes_on_a_heap_presses_few_bodies_into_its_walls() {
    let worlds = (0..40).map(press_heap);
    let [all, outside] = worlds.fold([0, 0], |[all, outside], world| [all + world[0], outside + world[1]]);
    assert!(200 * outside <= all, "{outside} of {all}");
}
