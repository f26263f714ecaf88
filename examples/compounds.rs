//! Bodies of several shapes: a hammer that turns about its centre of mass, and a player with a foot that feels the ground.
//!
//! `cargo run --example compounds`

use rustycs::prelude::*;

fn main() -> Result<(), BodyError> {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    world.add(Body::fixed(Shape::aabb(40.0, 1.0)).at([0.0, -0.5]))?;

    // Density, friction and filter of the body hold for its shapes, unless they are given their own.
    let head = Collider::new(Shape::rectangle(0.2, 0.5)).at([0.6, 0.0]).material(Material::METAL);
    let hammer = Body::dynamic(Shape::rectangle(1.0, 0.1)).density(0.6).with(head);
    let hammer = world.add(hammer.at([-5.0, 2.0]).velocity([3.0, 6.0]).angular_velocity(10.0))?;
    let body = world.body(hammer).unwrap();
    println!(
        "hammer: {:.2} kg, its centre of mass {:.2} m from the handle's",
        body.mass(),
        body.position().x + 5.0
    );

    // A sensor weighs nothing, and touches nothing.
    let foot = Collider::new(Shape::rectangle(0.4, 0.1)).at([0.0, -1.0]).sensor(true);
    let player = Body::dynamic(Shape::rectangle(0.6, 1.8)).fixed_rotation(true).with(foot);
    let player = world.add(player.at([5.0, 2.0]).friction(0.0).restitution(0.0))?;

    for tick in 0..120 {
        world.step();
        for event in world.events().sensor_began().iter().filter(|event| event.sensor == player) {
            println!("after {:.2} s the foot feels {:?}", f64::from(tick) / 60.0, event.body);
        }
        for event in world.events().hits().iter().filter(|event| event.other(hammer).is_some()) {
            println!("after {:.2} s the hammer strikes at {:.1} m/s", f64::from(tick) / 60.0, event.speed);
        }
    }
    for contact in world.contacts_of(hammer) {
        let [_, of_hammer] = contact.colliders();
        println!("it lies on its {:?}", world.collider(of_hammer).map(|collider| collider.aabb()));
    }
    Ok(())
}
