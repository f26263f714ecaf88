//! The impulses of a collision were multiplied by the length of the new substep over that of the old one, as if they were those
//! of forces: where slow motion ended, bodies that were in a collision were thrown apart, at 42 km/s from 1 MHz.

use rustycs::prelude::*;

use crate::support::{G, add, add_floor, earth_with, run, unit_box, velocity};

/// Ten boxes that do not bounce reach the floor at 5 m/s, and another rate or number of substeps is set for a tick.
fn fastest_after(slow: &Settings) -> f64 {
    let mut world = earth_with(Settings::default());
    add_floor(&mut world, 0.6);
    let boxes: Vec<BodyId> =
        (0..10).map(|i| add(&mut world, unit_box(0.0, 0.5 + f64::from(i)).velocity([0.0, -5.0]))).collect();
    let usual = world.settings().clone();
    world.set_settings(Settings { sleep: false, ..slow.clone() }).unwrap();
    world.step();
    world.set_settings(usual).unwrap();
    let mut fastest = 0.0_f64;
    for _ in 0..10 {
        world.step();
        fastest = boxes.iter().map(|&id| velocity(&world, id)[1].abs()).fold(fastest, f64::max);
    }
    fastest
}

/// No impulse between them is more than what stops them all: none is faster than it was before, but for gravity.
#[test]
fn boxes_that_land_in_slow_motion_are_not_thrown_when_it_ends() {
    for tick_rate in [120.0, 600.0, 6000.0, 1e6] {
        let fastest = fastest_after(&Settings { tick_rate, ..Settings::default() });
        assert!(fastest < 5.0 + G / 6.0, "{fastest} m/s after a tick at {tick_rate} Hz");
    }
    for substeps in [1, 16, 256] {
        let fastest = fastest_after(&Settings { substeps, ..Settings::default() });
        assert!(fastest < 5.0 + G / 6.0, "{fastest} m/s after a tick of {substeps} substeps");
    }
}

/// A load that lasts is a force, and goes with the length of the substep: where it did not, what stands would fall freely at
/// first, and reach g dt within a tick. What it does is to sink into the overlaps of longer substeps, not half as fast.
#[test]
fn a_stack_at_rest_does_not_begin_to_fall_when_slow_motion_ends() {
    let mut world = earth_with(Settings { adaptive: false, ..Settings::default() });
    add_floor(&mut world, 0.6);
    let boxes: Vec<BodyId> = (0..10).map(|i| add(&mut world, unit_box(0.0, 0.5 + f64::from(i)))).collect();
    run(&mut world, 5.0);
    let usual = world.settings().clone();
    world.set_settings(Settings { tick_rate: 600.0, ..usual.clone() }).unwrap();
    run(&mut world, 2.0);
    world.set_settings(usual).unwrap();
    world.step();
    for (i, &id) in boxes.iter().enumerate() {
        let speed = velocity(&world, id)[1];
        assert!(speed.abs() < 0.5 * G / 60.0, "box {i} goes at {speed} m/s");
    }
}
