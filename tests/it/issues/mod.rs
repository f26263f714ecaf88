//! What was wrong once, one file for each bug, named by what was seen of it.

mod asleep_in_motion;
mod damping_by_count;
mod energy_of_many_iterations;
mod fixed_rotation_that_spins;
mod flying_out_of_a_direct_island;
mod gained_while_stopped;
mod growing_bounces;
mod hit_of_a_second_impact;
mod hit_of_great_masses;
mod impulse_far_away;
mod joined_in_a_direct_island;
mod joints_of_a_restored_world;
mod left_by_its_crane;
mod memory_of_an_emptied_world;
mod met_in_one_corner;
mod no_error_of_sleepers;
mod pair_with_a_body_that_left;
mod pair_with_a_removed_body;
mod shot_from_a_row_of_crates;
mod spun_by_stale_friction;
mod stale_manifold;
mod standing_still_on_large_ground;
mod struck_in_a_direct_island;
#[cfg(all(target_os = "linux", feature = "parallel"))]
mod threads_of_many_worlds;
mod thrown_back_without_restitution;
mod thrown_by_a_friction_joint;
mod thrown_by_an_unsolved_island;
mod thrown_by_slow_motion;
mod towers_that_fell_at_once;
mod wedged_by_friction;
