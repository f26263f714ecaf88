//! A blow that sweeps did not bring to an end pressed a box into the ground, which then threw back what had struck it: at an eighth of its
//! speed where both were as heavy, at half where the upper one was ten times as heavy.

use rustycs::prelude::*;

use crate::support::{add, add_floor, earth};

/// A box falls 3 m on a box that rests. The law is that nothing comes back. In the first step the blow is not known yet, and what it presses
/// in is pushed out again: that is still let pass, up to a tenth of the speed of the fall.
#[test]
fn what_falls_on_a_box_without_restitution_hardly_comes_back() {
    for ratio in [0.5, 1.0, 2.0, 4.0, 10.0] {
        let mut world = earth();
        add_floor(&mut world, 0.6);
        let square = || Body::dynamic(Shape::rectangle(0.5, 0.5)).restitution(0.0);
        add(&mut world, square().at([0.0, 0.25]).mass(1.0));
        let upper = add(&mut world, square().at([0.0, 3.75]).mass(ratio));
        let (mut fastest, mut back) = (0.0_f32, 0.0_f32);
        for _ in 0..240 {
            world.step();
            let speed = world.body(upper).unwrap().velocity().y;
            (fastest, back) = (fastest.max(-speed), back.max(speed));
        }
        assert!(fastest > 7.0, "{ratio} : 1, it falls at {fastest} m/s");
        assert!(back < 0.11 * fastest, "{ratio} : 1, it comes back at {back} of {fastest} m/s");
    }
}
