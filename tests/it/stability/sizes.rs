//! Very large, very small, very thin.

use super::hold;

#[test]
fn towers_stand_at_any_size() {
    hold(&["tower-1cm", "tower-1km"]);
}

#[test]
#[ignore = "trembles by rounding: a box of 1 mm falls by 8 % of its size in a substep"]
fn a_tower_of_millimetres_stands() {
    hold(&["tower-1mm"]);
}

#[test]
#[ignore = "a heap of stones of 1 cm is solved directly while it moves, and too large for that once it lies"]
fn gravel_comes_to_rest_on_a_ground_of_kilometres() {
    hold(&["gravel-middle", "gravel-edge"]);
}

#[test]
fn needles_come_to_rest_in_a_box() {
    hold(&["needles"]);
}

#[test]
fn tiny_edges_and_faces_that_are_hardly_not_parallel_carry() {
    hold(&["tiny-edges", "near-parallel"]);
}

#[test]
fn a_disc_on_a_vertex_stays_or_rolls_but_does_not_sink() {
    hold(&["disc-on-vertex"]);
}

#[test]
#[ignore = "the gap to a circle of 6,400 km is a difference of two f32"]
fn boxes_stand_on_a_planet() {
    hold(&["planet-as-ground"]);
}
