//! A game loop: frames of any length, ticks of one length, and motion that looks smooth all the same.
//!
//! `advance` takes as many ticks as fit and keeps the rest of the time; `alpha` tells how far that rest is into
//! the next tick. Drawing a body that far between its last two poses shows it one tick late, and without
//! stutter: here a body at 6 m/s is to move in proportion to the length of each frame.
//!
//! `cargo run --example fixed_step_loop`

use rustycs::prelude::*;

/// Lengths of frames, s: a screen of 144 Hz, one of 30 Hz, and some that are late.
const FRAMES: [f64; 12] =
    [0.007, 0.007, 0.007, 0.033, 0.033, 0.012, 0.041, 0.007, 0.007, 0.007, 0.021, 0.016];
const SPEED: f32 = 6.0;

fn main() -> Result<(), BodyError> {
    let mut world = World::new(Settings::default());
    let ship = world.add(Body::dynamic(Shape::circle(0.5)).velocity([SPEED, 0.0]))?;

    let (mut shown_before, mut time) = (None::<f64>, 0.0);
    println!("  frame  ticks  alpha   at the tick   shown");
    for seconds in FRAMES {
        let ticks = world.advance(seconds);
        let ship = world.body(ship).expect("nobody removes the ship");
        let now = ship.position().x;
        let shown = ship.interpolated_pose(world.alpha()).center.x;
        time += seconds;
        println!("{:4.0} ms  {ticks:5}  {:5.2}  {now:10.3} m  {shown:.3} m", seconds * 1e3, world.alpha());

        // From the first tick on, what is shown moves by speed × length of the frame, to rounding.
        if let Some(shown_before) = shown_before {
            let expected = f64::from(SPEED) * seconds;
            assert!((shown - shown_before - expected).abs() < 1e-5);
        }
        shown_before = (time > world.settings().tick_seconds()).then_some(shown);
    }
    Ok(())
}
