//! Bad input: each number that the engine cannot compute with is refused, with a text that names it and says
//! what to change, and the world is bit for bit as it was.

mod bodies;
mod rest;

use rustycs::prelude::*;

use crate::support::add;

/// What no quantity may be.
const NOT_NUMBERS: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

/// A world with a stack, a force and an attractor, that has taken some steps.
fn lived_in() -> (World, BodyId) {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    world.add_attractor(Attractor::local([50.0, 0.0], 1.0, 5.0));
    add(&mut world, Body::fixed(Shape::aabb(20.0, 1.0)).at([0.0, -0.5]));
    add(&mut world, Body::dynamic(Shape::circle(0.5)).at([0.0, 0.5]));
    let id = add(&mut world, Body::dynamic(Shape::obb(1.0, 1.0)).at([0.0, 1.5]));
    for _ in 0..20 {
        world.step();
    }
    (world, id)
}

/// Fails unless `refuse` gives an error that names `quantity` and says what to do, and leaves the world as it
/// was, to the bit, now and in the steps that follow.
#[track_caller]
fn assert_refused<E: ToString>(
    what: &str,
    quantity: &str,
    refuse: impl FnOnce(&mut World, BodyId) -> Option<E>,
) {
    let (mut world, id) = lived_in();
    let mut untouched = world.clone();
    let error = refuse(&mut world, id).unwrap_or_else(|| panic!("{what} is accepted"));
    let text = error.to_string();
    assert!(text.contains(quantity), "{what}: \"{text}\" does not name the {quantity}");
    let advice = ["give", "choose", "move", "list", "use", "cut", "set"];
    assert!(advice.iter().any(|word| text.contains(word)), "{what}: \"{text}\" does not say what to change");
    assert_eq!(world.state_hash(), untouched.state_hash(), "{what} changed the world");
    world.validate().unwrap();
    for _ in 0..5 {
        world.step();
        untouched.step();
    }
    assert_eq!(world.state_hash(), untouched.state_hash(), "{what} changed what comes");
}

/// What a game does every frame is refused by a panic in debug builds, and reported by others; the text of it.
fn refusal(world: &mut World, id: BodyId, push: impl FnOnce(&mut BodyMut<'_>)) -> Option<String> {
    if cfg!(debug_assertions) {
        let push = std::panic::AssertUnwindSafe(|| push(&mut world.body_mut(id).unwrap()));
        return Some(*std::panic::catch_unwind(push).err()?.downcast().unwrap());
    }
    push(&mut world.body_mut(id).unwrap());
    let mut next = world.clone();
    next.step();
    let refused = next.events().refused().first()?;
    assert_eq!(refused.body, id);
    Some(refused.error.to_string())
}

/// The checker itself: what is accepted, says nothing or changes the world is found out.
#[test]
fn the_check_of_refusals_finds_what_is_not_refused() {
    type Attempt = fn(&mut World, BodyId) -> Option<String>;
    let attempts: [(&str, &str, Attempt); 3] = [
        ("a good velocity", "velocity", |world, id| {
            refusal(world, id, |body| _ = body.set_velocity([1.0, 0.0]))
        }),
        ("the wrong name", "colour", |world, id| {
            refusal(world, id, |body| _ = body.set_velocity([f32::NAN, 0.0]))
        }),
        ("a change before the refusal", "velocity", |world, id| {
            refusal(world, id, |body| _ = body.set_velocity([1.0, 0.0]).set_velocity([f32::NAN, 0.0]))
        }),
    ];
    for (what, quantity, attempt) in attempts {
        let result = std::panic::catch_unwind(|| assert_refused(what, quantity, attempt));
        assert!(result.is_err(), "{what}");
    }
}
