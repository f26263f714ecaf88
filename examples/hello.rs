//! A falling ball.
use rustycs::prelude::*;

fn main() -> Result<(), BodyError> {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    world.add(Body::fixed(Shape::aabb(20.0, 1.0)).at([0.0, -0.5]))?;
    let ball = world.add(Body::dynamic(Shape::circle(0.5)).at([0.0, 5.0]).material(Material::RUBBER))?;
    for tick in 0..180 {
        world.step();
        let body = world.body(ball).unwrap();
        if tick % 10 == 9 {
            println!(
                "{:4.2} s: y = {:5.3} m, v = {:6.3} m/s",
                (tick + 1) as f32 / 60.0,
                body.position().y,
                body.velocity().y
            );
        }
    }
    Ok(())
}
