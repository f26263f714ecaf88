//! A rubber ball falls on a floor and bounces.
//!
//! `cargo run --example hello`

use rustycs::prelude::*;

fn main() -> Result<(), BodyError> {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    world.add(Body::fixed(Shape::aabb(20.0, 1.0)).at([0.0, -0.5]))?;
    let ball = world.add(Body::dynamic(Shape::circle(0.5)).at([0.0, 5.0]).material(Material::RUBBER))?;

    println!("  time   height    speed");
    for tick in 0..208 {
        world.step();
        if tick % 8 == 7 {
            let body = world.body(ball).expect("nobody removes the ball");
            // Rounded here, as -0.04 would be written as -0.0; adding 0 makes 0 of -0.
            let speed = (body.velocity().y * 10.0).round() / 10.0 + 0.0;
            let height = (body.position().y - 0.5).max(0.0);
            let trail = " ".repeat((height * 10.0) as usize);
            println!("{:4.2} s  {height:5.2} m  {speed:5.1} m/s |{trail}o", (tick + 1) as f32 / 60.0);
        }
        for hit in world.events().hits() {
            println!("        the floor is hit at {:.1} m/s", hit.speed);
        }
    }
    let height = world.body(ball).expect("nobody removes the ball").position().y;
    assert!((0.49..5.0).contains(&height), "the ball lies on the floor or bounces above it");
    Ok(())
}
