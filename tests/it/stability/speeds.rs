//! Very fast.

use super::hold;

#[test]
fn a_box_that_spins_at_1000_rad_per_second_keeps_it_and_gains_nothing_from_a_floor() {
    hold(&["spin-free", "spin-on-floor"]);
}

#[test]
fn an_elastic_gas_keeps_its_energy() {
    hold(&["gas-100"]);
}

#[test]
#[ignore = "a minute of 1,024 discs; gas-100 is like it"]
fn an_elastic_gas_of_a_thousand_discs_keeps_its_energy() {
    hold(&["gas-1024"]);
}

#[test]
fn restitution_above_1_is_refused() {
    hold(&["restitution-above-1"]);
}

#[test]
fn nothing_passes_through_walls_at_any_speed() {
    hold(&["speeds-against-walls"]);
}
