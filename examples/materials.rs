//! A ball of each material falls from 4 m: how high does it bounce?
//!
//! A ball that meets the floor with speed v leaves it with e v, and reaches e² of the height it fell from. The
//! coefficient e of a contact is the average of the two materials', unless one of them is 0 or the settings say otherwise.
//!
//! `cargo run --example materials`

use rustycs::prelude::*;

const RADIUS: f32 = 0.25;
const DROP: f32 = 4.0;

fn main() -> Result<(), BodyError> {
    let materials = [
        ("default", Material::DEFAULT),
        ("rubber", Material::RUBBER),
        ("plastic", Material::PLASTIC),
        ("stone", Material::STONE),
        ("metal", Material::METAL),
    ];
    let mut world = World::new(Settings { tick_rate: 240.0, ..Settings::default() });
    world.add_force(Force::EARTH_GRAVITY);
    world.add(Body::fixed(Shape::aabb(20.0, 1.0)).at([0.0, -0.5]).material(Material::STONE))?;
    let mut balls = Vec::new();
    for (place, (_, material)) in materials.into_iter().enumerate() {
        let ball = Body::dynamic(Shape::circle(RADIUS)).at([place as f32, DROP + RADIUS]);
        balls.push(world.add(ball.material(material))?);
    }

    // The floor is reached after √(2 h / g) = 0.9 s; after 1.6 s every ball has been at the top of its bounce.
    let mut highest = [0.0_f32; 5];
    for tick in 0..384 {
        world.step();
        for (highest, ball) in highest.iter_mut().zip(&balls) {
            let body = world.body(*ball).expect("nobody removes a ball");
            let has_bounced = tick > 216 + 4;
            *highest = highest.max(if has_bounced { body.position().y - RADIUS } else { 0.0 });
        }
    }

    println!("material  mass       e   bounce   e² · 4 m");
    for (((name, material), ball), height) in materials.into_iter().zip(balls).zip(highest) {
        let e = Mix::Average.mix(material.restitution, Material::STONE.restitution);
        let (mass, expected) = (world.body(ball).map_or(0.0, |body| body.mass()), e * e * DROP);
        let bar = "#".repeat((height * 40.0) as usize);
        println!("{name:8} {mass:5.3} kg  {e:.2}  {height:.3} m  {expected:.3} m  {bar}");
        assert!((height - expected).abs() < 0.01 * DROP);
    }
    Ok(())
}
