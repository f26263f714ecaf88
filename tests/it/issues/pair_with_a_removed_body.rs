//! A pair without a contact outlived one of its bodies, and was taken for that of the body that got its slot.

use rustycs::prelude::*;

use crate::support::add;

/// Discs at the corners of a square: their boxes overlap, but they are out of reach of each other, and have no contact.
/// When one is removed the pair is gone; one that is put in its place, and into the first, has a contact at once.
#[test]
fn a_pair_out_of_reach_goes_with_its_body_and_another_body_gets_its_place() {
    for steps_between in [0, 1] {
        let mut world = World::new(Settings::default());
        let disc = |x, y| Body::dynamic(Shape::circle(0.5)).at([x, y]);
        let pairs = |world: &World| world.profile().counters().pairs;
        let first = add(&mut world, disc(0.0, 0.0));
        let removed = add(&mut world, disc(0.75, 0.75));
        world.step();
        assert_eq!((pairs(&world), world.contacts().count()), (1, 0));
        assert!(world.remove(removed).is_some());
        world.validate().unwrap();
        for _ in 0..steps_between {
            world.step();
            assert_eq!(pairs(&world), 0);
        }
        let placed = add(&mut world, disc(0.9, 0.0));
        world.step();
        world.validate().unwrap();
        assert_eq!(pairs(&world), 1);
        let contact = world.contacts().next().expect("they overlap");
        assert_eq!((contact.a(), contact.b()), (first, placed));
    }
}
