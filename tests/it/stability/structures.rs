//! Pyramids, houses, arches, what is about to tip or to slide.

use super::hold;

#[test]
fn card_houses_stand() {
    hold(&["card-house-5", "card-house-8"]);
}

#[test]
fn arches_and_vaults_stand_by_thrust() {
    hold(&["arch", "arch-loaded", "catenary-vault"]);
}

#[test]
fn a_stack_that_leans_just_outside_its_tipping_angle_falls() {
    hold(&["leaning-outside"]);
}

#[test]
fn a_domino_with_enough_energy_tips() {
    hold(&["domino-tips"]);
}

#[test]
fn a_plank_on_a_drum_rocks_no_further_than_it_began() {
    hold(&["plank-on-drum"]);
}

#[test]
fn a_hundred_dominoes_fall() {
    hold(&["dominoes"]);
}

#[test]
fn a_box_sticks_just_below_the_friction_angle_and_slides_just_above() {
    hold(&["ramp-sticks", "ramp-slides"]);
}
