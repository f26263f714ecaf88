//! The overlap of a world read 0 once all of it slept.

use rustycs::prelude::*;

use crate::support::{add, unit_box};

/// Boxes that sag under their own weight, ten on each other in each of `count` stacks.
fn stacks(count: u16) -> (World, Vec<BodyId>) {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    add(&mut world, Body::fixed(Shape::aabb(200.0, 2.0)).at([0.0, -1.0]));
    let tops = (0..count).map(|stack| {
        let x = 3.0 * f64::from(stack);
        // The first stack is the highest, and sags most.
        let boxes = (0..10 - stack).map(|level| add(&mut world, unit_box(x, 0.5 + f64::from(level))));
        boxes.last().unwrap()
    });
    let tops = tops.collect();
    (world, tops)
}

fn step_until_asleep(world: &mut World) -> StepError {
    for _ in 0..600 {
        let before = world.error();
        world.step();
        if world.awake_count() == 0 {
            return before;
        }
    }
    panic!("awake after 10 s");
}

/// At rest the overlap of a step is that of the step before, to the 1 µm that rounding makes bodies tremble by.
#[test]
fn overlap_stays_what_it_was_when_bodies_fall_asleep() {
    let (mut world, _) = stacks(2);
    let before = step_until_asleep(&mut world).penetration;
    assert!(before > 1e-3, "ten boxes sag by mm: {before}");
    for _ in 0..3 {
        assert!((world.error().penetration - before).abs() < 1e-6, "{:?}, {before} before", world.error());
        assert!(world.error().velocity_residual < 1e-6);
        world.step();
    }
    let deepest = world.contacts().flat_map(|contact| contact.points().iter().map(|point| -point.separation));
    assert_eq!(world.error().penetration, deepest.fold(0.0, f32::max));
}

/// What is removed has no overlap; what is left has its own.
#[test]
fn overlap_of_sleepers_goes_with_them() {
    let (mut world, tops) = stacks(2);
    step_until_asleep(&mut world);
    let of_both = world.error().penetration;
    let of_first: Vec<BodyId> = world.islands()[0].clone();
    assert!(of_first.contains(&tops[0]));
    for id in of_first {
        world.remove(id);
    }
    world.step();
    let of_second = world.error().penetration;
    assert!(0.0 < of_second && of_second < of_both, "{of_second} of {of_both}");
    let rest: Vec<BodyId> = world.islands().concat();
    for id in rest {
        world.remove(id);
    }
    world.step();
    assert_eq!(world.error(), StepError::default());
}
