//! Far from the origin.

use super::hold;

#[test]
fn single_bodies_move_as_at_the_origin() {
    hold(&["far-throw", "far-bounce"]);
}

#[test]
fn stacks_and_piles_stand_as_at_the_origin() {
    hold(&["far-stack", "far-pile"]);
}
