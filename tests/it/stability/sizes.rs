//! Very large, very small, very thin.

use super::hold;

#[test]
fn towers_stand_at_any_size() {
    hold(&["tower-1cm", "tower-1km"]);
}

#[test]
fn a_tower_of_millimetres_stands() {
    hold(&["tower-1mm"]);
}

#[test]
fn gravel_comes_to_rest_on_a_ground_of_kilometres() {
    hold(&["gravel-middle"]);
}

#[test]
fn gravel_comes_to_rest_at_the_edge_of_a_ground_of_kilometres() {
    hold(&["gravel-edge"]);
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
fn boxes_stand_on_a_planet() {
    hold(&["planet-as-ground"]);
}
