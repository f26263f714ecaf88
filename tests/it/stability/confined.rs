//! Too many bodies for the place they have.

use super::hold;

#[test]
fn discs_that_walls_squeeze_find_their_places() {
    hold(&["squeezed"]);
}

#[test]
fn two_boxes_in_each_other_part_gently() {
    hold(&["overlap-10", "overlap-50", "overlap-90", "overlap-99"]);
}
