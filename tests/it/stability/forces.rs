//! Forces, rates and materials at their limits.

use super::hold;

#[test]
fn a_stack_stands_under_any_gravity() {
    hold(&["gravity-0", "gravity-1e-3", "gravity-1e3"]);
}

#[test]
fn attractors_keep_the_energy_of_what_passes_them() {
    hold(&["attractor-grazed-100cm", "attractor-grazed-10cm", "attractors-100"]);
}

#[test]
fn a_stack_stands_at_any_rate() {
    hold(&["rate-10", "rate-30", "rate-240", "rate-1000", "rate-10000"]);
}

#[test]
fn the_rate_may_change_at_any_time() {
    hold(&["rate-changed-in-flight"]);
}

#[test]
fn friction_of_0_and_1_and_10_is_coulombs() {
    hold(&["friction-0", "friction-1", "friction-10"]);
}

#[test]
fn a_stack_stands_whatever_its_density() {
    hold(&["density-1e-3", "density-1", "density-1e6"]);
}
