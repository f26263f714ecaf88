//! Which settings are worth their time? Three boxes fall on each other; the report says how far each choice of
//! tick rate and substeps is from the truth, what it costs, and which is the cheapest that is good enough.
//!
//! `cargo run --release --example own_scene_report --features report`
//!
//! For the scenes of the demo there is a command: `cargo run --release --example error_report -- --scene tower`.

use std::sync::OnceLock;
use std::time::Instant;

use rustycs::prelude::*;
use rustycs::report::{Study, StudyError};

fn scene(settings: Settings) -> World {
    let mut world = World::new(settings);
    world.add_force(Force::EARTH_GRAVITY);
    let bodies = [
        Body::fixed(Shape::aabb(20.0, 1.0)).at([0.0, -0.5]),
        Body::dynamic(Shape::obb(1.0, 1.0)).at([0.0, 0.6]),
        Body::dynamic(Shape::obb(1.0, 1.0)).at([0.1, 1.7]),
        Body::dynamic(Shape::obb(1.0, 1.0)).at([0.2, 2.8]),
    ];
    for body in bodies {
        world.add(body).expect("the numbers are good");
    }
    world
}

/// Seconds since the first call.
fn clock() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_secs_f64()
}

fn main() -> Result<(), StudyError> {
    let report = Study::new(scene)
        .name("three boxes")
        .duration(2.0)
        .tick_rates([30.0, 60.0, 120.0, 240.0])
        .substeps([1, 2, 4, 8])
        .clock(clock)
        .run()?;
    println!("{}", report.to_markdown());

    let path = std::env::temp_dir().join("own_scene_report.svg");
    match std::fs::write(&path, report.to_svg()) {
        Ok(()) => println!("picture: {}", path.display()),
        Err(error) => println!("no picture: {error}"),
    }
    match report.recommend(20e-3) {
        Some(row) => println!("within 2 cm: {}, off by {:.1} mm", row.label, row.error * 1e3),
        None => println!("none of these settings is within 2 cm"),
    }
    Ok(())
}
