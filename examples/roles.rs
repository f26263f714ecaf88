//! Filters, a sensor, a one-way floor, a conveyor belt, and queries with a filter: `cargo run --release --example roles`.

use rustycs::prelude::*;

const PLAYERS: u64 = 0x2;
const BULLETS: u64 = 0x4;

fn main() -> Result<(), BodyError> {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    world.add(Body::fixed(Shape::aabb(40.0, 1.0)).at([0.0, -0.5]))?;
    // A floor that the player jumps through, and a belt that takes a crate through a zone.
    world.add(Body::fixed(Shape::aabb(3.0, 0.2)).at([0.0, 1.5]).one_way([0.0, 1.0]).restitution(0.0))?;
    world.add(Body::fixed(Shape::aabb(8.0, 0.4)).at([10.0, 0.2]).surface_speed(2.0))?;
    let zone = world.add(Body::fixed(Shape::aabb(1.0, 2.0)).at([12.0, 1.5]).sensor(true))?;
    let crate_ = world.add(Body::dynamic(Shape::obb(0.6, 0.6)).at([8.0, 0.7]).restitution(0.0))?;

    // What the player shoots is of his group, and passes through him.
    let own = |filter| Filter { group: -1, ..filter };
    let player = Body::dynamic(Shape::obb(0.6, 1.2)).at([0.0, 0.6]).velocity([0.0, 8.0]).fixed_rotation(true);
    let player =
        world.add(player.restitution(0.0).filter(own(Filter { category: PLAYERS, ..Filter::DEFAULT })))?;
    let bullet = Body::dynamic(Shape::circle(0.05)).at([0.0, 0.6]).velocity([60.0, 0.0]).gravity_scale(0.0);
    world.add(bullet.filter(own(Filter { category: BULLETS, mask: !BULLETS, ..Filter::DEFAULT })))?;

    for _ in 0..240 {
        world.step();
        for event in world.events().sensor_began().iter().filter(|event| event.sensor == zone) {
            let name = if event.body == crate_ { "the crate" } else { "the bullet" };
            println!("{:.2} s: {name} comes into the zone", world.time());
        }
        for event in world.events().sensor_ended().iter().filter(|event| event.body == crate_) {
            println!("{:.2} s: the crate has left {:?}", world.time(), event.sensor);
        }
    }
    let feet = world.body(player).unwrap().position().y - 0.6;
    println!("the player jumped through the floor and stands {feet:.2} m high");

    // What is below, but for the player himself; and what a ball would meet that is thrown from there.
    let others = QueryFilter::new().ignore(player);
    let eye = world.body(player).unwrap().pose().center;
    if let Some(hit) = world.ray_cast_with(eye, [0.0, -5.0], &others) {
        println!("{:?} is {:.2} m below his middle", hit.body, 5.0 * hit.fraction);
    }
    if let Some(hit) = world.shape_cast(&Shape::circle(0.3), Pose::at(eye), [20.0, -4.0], &others) {
        println!("a ball thrown from there meets {:?} at {:?}", hit.body, hit.point);
    }
    Ok(())
}
