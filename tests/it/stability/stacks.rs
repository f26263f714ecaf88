//! Boxes on boxes, and heavy on light.

use rustycs::prelude::*;

use super::hold;
use crate::support::{add, add_floor, place, unit_box};

#[test]
fn stacks_of_10_and_20_boxes_stand_and_better_with_more_substeps() {
    hold(&["stack-10", "stack-20"]);
}

#[test]
fn stacks_of_50_and_100_boxes_stand_and_better_with_more_substeps() {
    hold(&["stack-50", "stack-100"]);
}

#[test]
#[ignore = "many seconds; stack-100 is like it"]
fn a_stack_of_200_boxes_stands_and_better_with_more_substeps() {
    hold(&["stack-200"]);
}

#[test]
fn a_heavy_box_stands_on_a_light_one() {
    hold(&["mass-10", "mass-100", "mass-1000", "mass-10000"]);
}

#[test]
fn a_heavy_box_stands_on_ten_light_ones_and_on_ever_lighter_ones() {
    hold(&["heavy-100-on-ten", "heavy-1000-on-ten", "densities-upward"]);
}

#[test]
fn light_balls_in_a_row_carry_a_heavy_plate() {
    hold(&["plate-on-balls"]);
}

#[test]
fn a_bridge_of_light_boxes_catches_a_heavy_ball() {
    hold(&["ball-on-bridge"]);
}

/// The heavy one lies 5 cm off the axis, which is within the base: nothing moves, and nothing is lifted by more than a hundredth of a millimetre.
#[test]
fn towers_under_a_heavy_box_off_their_axis_stand_and_sleep() {
    for (count, mass) in [(4, 30.0), (4, 100.0), (6, 100.0), (8, 300.0)] {
        let mut world = World::new(Settings::default());
        world.add_force(Force::EARTH_GRAVITY);
        add_floor(&mut world, 0.6);
        for row in 0..count {
            let is_top = row == count - 1;
            let at = [if is_top { 0.05 } else { 0.0 }, 0.5 + f64::from(row)];
            let mass = if is_top { mass } else { 1.0 };
            add(&mut world, Body::dynamic(Shape::rectangle(1.0, 1.0)).at(at).mass(mass));
        }
        let most = world.energy() + 1e-5 * f64::from(mass) * 9.81;
        for _ in 0..1200 {
            world.step();
            assert!(world.energy() < most, "{count}, {mass} kg: {} of {most} J", world.energy());
        }
        assert_eq!(world.awake_count(), 0, "{count}, {mass} kg");
    }
}

/// A load slides onto a table on two slender legs, which sways, loses energy each time that a foot comes down, and comes to rest.
#[test]
fn a_table_on_slender_legs_stops_swaying() {
    for mass in [100.0, 1000.0] {
        let mut world = World::new(Settings::default());
        world.add_force(Force::EARTH_GRAVITY);
        add_floor(&mut world, 0.6);
        for x in [-1.2, 1.2] {
            add(&mut world, Body::dynamic(Shape::rectangle(0.24, 1.35)).at([x, 0.675]).mass(1.0));
        }
        add(&mut world, Body::dynamic(Shape::rectangle(3.4, 0.2)).at([0.0, 1.45]).mass(2.0));
        let load = Body::dynamic(Shape::rectangle(0.6, 0.6)).at([0.2, 1.85]).mass(mass);
        add(&mut world, load.velocity([0.2, 0.0]));
        for _ in 0..1200 {
            world.step();
        }
        assert_eq!(world.awake_count(), 0, "{mass} kg");
    }
}

/// No box of a stack that begins at rest may sink by more than 1 % of the height, as in the table, and not later either:
/// while sweeps pass the weight on by a box at a time, the top falls freely, by 4.9 m in a second.
#[test]
fn a_stack_of_200_boxes_stands_from_its_first_step_on() {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    add_floor(&mut world, 0.6);
    let boxes: Vec<BodyId> =
        (0..200).map(|row: u32| add(&mut world, unit_box(0.0, 0.5 + f64::from(row)))).collect();
    for tick in 0..60 {
        world.step();
        let height = place(&world, boxes[199])[1];
        assert!(height > 199.5 - 0.01 * 200.0, "{height} m after step {tick}");
    }
}
