//! A box that fell flat, and met the floor in one corner, kept its second point as one to push on, at the place of the first.

use rustycs::prelude::*;

use crate::support::{add, add_floor, earth};

/// Boxes that fall with a spin so slow that both corners are expected, and one meets: none of them gains energy, and none
/// is told to touch where it does not.
#[test]
fn a_box_that_meets_in_one_corner_is_pushed_there_alone() {
    for i in 0..40_u16 {
        let mut world = earth();
        add_floor(&mut world, 0.5);
        let body = Body::dynamic(Shape::obb(1.0, 0.4)).at([0.0, 1.0]).angle(0.002 * f32::from(i) - 0.04);
        let id = add(&mut world, body.angular_velocity(0.2).restitution(0.8).friction(0.3));
        let start = world.energy();
        for _ in 0..120 {
            world.step();
            assert!(world.energy() <= start * (1.0 + 1e-5), "box {i} has {} J of {start}", world.energy());
            let touches = world.contacts().any(|contact| contact.is_touching());
            let gap = world.body(id).unwrap().aabb().min.y;
            assert!(!touches || gap < 0.1, "box {i} touches from {gap} m above the floor");
        }
    }
}
