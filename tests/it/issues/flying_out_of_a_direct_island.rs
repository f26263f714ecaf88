//! A body that left an island that was solved directly, without contacts, was taken for one that is solved so for good.

use rustycs::Tier::{Direct, Swept};
use rustycs::prelude::*;

use crate::support::{add, add_floor, earth_with, run, unit_box};

/// What was solved directly and then flies alone bears nothing: it is not solved directly any more, nor does it bring that
/// back when it lands.
#[test]
fn a_box_that_flies_out_of_its_island_is_swept_again() {
    let mut world = earth_with(Settings { sleep: false, ..Settings::default() });
    add_floor(&mut world, 0.6);
    let light = add(&mut world, unit_box(0.0, 0.5));
    let heavy = add(&mut world, unit_box(0.0, 1.5).density(10_000.0));
    run(&mut world, 1.0);
    assert_eq!(world.body(light).unwrap().tier(), Direct);
    world.remove(heavy);
    world.body_mut(light).unwrap().set_velocity([0.0, 20.0]);
    run(&mut world, 2.0);
    let light = world.body(light).unwrap();
    assert!(light.position().y > 10.0, "it flies");
    assert_eq!(light.tier(), Swept);
}
