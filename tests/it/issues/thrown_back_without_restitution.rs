//! A blow that sweeps did not bring to an end pressed a box into the ground, which then threw back what had struck it: at an eighth of its
//! speed where both were as heavy, at half where the upper one was ten times as heavy. Later the impulse of a blow was taken for load: a box that
//! fell faster came back at a third of its speed where it was three times as heavy, and at a quarter where it was solved directly.

use rustycs::prelude::*;

use crate::support::{add, add_floor, earth_with};

/// Something falls from a height, m, on so many boxes that stand on each other, and has so many times the mass of each: its greatest speed upwards over
/// that of the fall.
fn rebound(tick_rate: f32, height: f32, ratio: f32, boxes: u8) -> f32 {
    let mut world = earth_with(Settings { tick_rate, ..Settings::default() });
    add_floor(&mut world, 0.6);
    for number in 0..boxes {
        let standing = Body::dynamic(Shape::rectangle(0.6, 0.4)).at([0.0, 0.2 + 0.4 * f64::from(number)]);
        add(&mut world, standing.mass(1.0 / ratio).restitution(0.0));
    }
    let at = [0.0, 0.4 * f64::from(boxes) + 0.3 + f64::from(height)];
    let upper = add(&mut world, Body::dynamic(Shape::rectangle(1.0, 0.6)).at(at).mass(1.0).restitution(0.0));
    let (mut fastest, mut back) = (0.0_f32, 0.0_f32);
    for _ in 0..(3.0 * tick_rate) as u32 {
        world.step();
        let speed = world.body(upper).unwrap().velocity().y;
        (fastest, back) = (fastest.max(-speed), back.max(speed));
    }
    let due = (2.0 * 9.81 * height).sqrt();
    assert!(fastest > 0.95 * due, "it falls at {fastest} m/s for {due}");
    back / due
}

/// The law is that nothing comes back. What is pressed in is pushed out again, and after the blow a load is guessed of up to 120 m/s², 0.5 m/s in a
/// substep of 1/240 s: a tenth of the speed of the fall is let pass for both.
#[test]
fn what_falls_on_a_box_without_restitution_hardly_comes_back() {
    for height in [1.0, 3.0, 5.0, 10.0] {
        for ratio in [0.1, 0.3, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 10.0, 20.0, 30.0, 60.0, 100.0, 1000.0] {
            for rate in [60.0, 240.0] {
                let back = rebound(rate, height, ratio, 1);
                assert!(
                    back < 0.1,
                    "{height} m, {ratio} : 1, {rate} Hz: it comes back at {back} of its speed"
                );
            }
        }
    }
}

/// The same of light boxes on each other. Five or ten passed the blow on by sweeps, which wound up as a spring does: a heavy box came back faster than
/// it fell. As it presses the ground by far more than all weigh, the stack was taken for squeezed, and not solved directly.
#[test]
fn what_falls_on_a_stack_of_light_boxes_hardly_comes_back() {
    for boxes in [2, 3, 5, 10] {
        for height in [1.0, 3.0, 5.0, 10.0] {
            for ratio in [20.0, 50.0, 100.0, 1000.0] {
                let back = rebound(60.0, height, ratio, boxes);
                assert!(
                    back < 0.1,
                    "{boxes} boxes, {height} m, {ratio} : 1: it comes back at {back} of its speed"
                );
            }
        }
    }
}
