//! A planet goes round a sun: an attractor, which pulls with G·mass/r².
//!
//! By Kepler, a body on an ellipse with half the long axis a takes T = 2π √(a³ / GM) for a turn, whatever the
//! eccentricity. This one begins at the near end of an ellipse of eccentricity 0.5. Its turn takes a whole number of
//! ticks, so that what it is off by is the engine's error.
//!
//! `cargo run --example attractor_orbit`

use rustycs::prelude::*;

const TURN: f32 = 8.0; // s
const SEMI_MAJOR_AXIS: f32 = 4.0;
const ECCENTRICITY: f32 = 0.5;
const TICK_RATE: f32 = 240.0;

fn main() -> Result<(), BodyError> {
    let gm = SEMI_MAJOR_AXIS.powi(3) * (core::f32::consts::TAU / TURN).powi(2);
    let mut world = World::new(Settings { tick_rate: TICK_RATE, ..Settings::default() });
    world.add_attractor(Attractor::global([0.0, 0.0], gm));
    let nearest = SEMI_MAJOR_AXIS * (1.0 - ECCENTRICITY);
    let speed = (gm * (1.0 + ECCENTRICITY) / nearest).sqrt();
    let planet = Body::dynamic(Shape::circle(0.1)).at([nearest, 0.0]).velocity([0.0, speed]);
    let planet = world.add(planet)?;

    let ticks = (TURN * TICK_RATE) as u32;
    let energy = world.energy();
    let mut map = vec![vec![' '; 64]; 24];
    let mut largest_error = 0.0_f64;
    for turn in 1..=10 {
        for _ in 0..ticks {
            world.step();
            let place = world.body(planet).expect("nobody removes the planet").position();
            // A column is 1/6 m, a row 1/3 m, from the corner at (-7, 4).
            map[((4.0 - place.y) * 3.0) as usize][((place.x + 7.0) * 6.0) as usize] = '.';
            largest_error = largest_error.max((world.energy() / energy - 1.0).abs());
        }
        let body = world.body(planet).expect("nobody removes the planet");
        let miss = (body.position() - Vec2::new(nearest, 0.0)).length();
        println!("after {turn:2} turns of {TURN} s: {:6.2} mm from where it began", miss * 1e3);
    }
    map[12][42] = '*';
    for row in map {
        println!("{}", row.into_iter().collect::<String>().trim_end());
    }
    println!("the energy was off by {:.4} % at most", largest_error * 100.0);
    assert!(largest_error < 0.01, "an orbit keeps its energy");
    Ok(())
}
