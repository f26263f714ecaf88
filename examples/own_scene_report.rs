//! Which settings are worth their time? Three bodies fly round an attractor; the report says how far each
//! choice of tick rate and substeps is from the truth, what it costs, and which is the cheapest that is good enough.
//! Where bodies hit each other again and again no settings come near the truth: energies or overlaps are compared then.
//!
//! `cargo run --release --example own_scene_report --features report`
//!
//! For the scenes of the demo there is a command: `cargo run --release --example error_report -- --scene tower`.

use std::time::Instant;

use rustycs::prelude::*;
use rustycs::report::{Study, StudyError};

fn scene(settings: Settings) -> World {
    let mut world = World::new(settings);
    world.add_attractor(Attractor::global([0.0, 0.0], 40.0));
    let bodies = [
        Body::dynamic(Shape::circle(0.1)).at([2.0, 0.0]).velocity([0.0, 5.5]),
        Body::dynamic(Shape::obb(0.2, 0.1)).at([-3.5, 0.0]).velocity([0.5, -3.0]),
        Body::dynamic(Shape::circle(0.1)).at([0.0, 8.0]).velocity([-2.0, 0.0]),
    ];
    for body in bodies {
        world.add(body).expect("the numbers are good");
    }
    world
}

fn main() -> Result<(), StudyError> {
    let start = Instant::now();
    let report = Study::new(scene)
        .name("three orbits")
        .duration(4.0)
        .tick_rates([30.0, 60.0, 120.0, 240.0])
        .substeps([1, 2, 4, 8])
        .clock(|| start.elapsed().as_secs_f64())
        .run()?;
    println!("{}", report.to_markdown());

    let path = std::env::temp_dir().join("own_scene_report.svg");
    match std::fs::write(&path, report.to_svg()) {
        Ok(()) => println!("picture: {}", path.display()),
        Err(error) => println!("no picture: {error}"),
    }
    match report.recommend(5e-3) {
        Some(row) => println!("within 5 mm: {}, off by {:.1} mm at most", row.label, row.bound() * 1e3),
        None => println!("none of these settings is within 5 mm"),
    }
    Ok(())
}
