//! Boxes on boxes, and heavy on light.

use super::hold;

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
#[ignore = "more contacts than the direct solve takes on, and too stiff for sweeps"]
fn light_balls_carry_a_heavy_plate() {
    hold(&["plate-on-balls", "plate-on-heap"]);
}

#[test]
fn a_bridge_of_light_boxes_catches_a_heavy_ball() {
    hold(&["ball-on-bridge"]);
}
