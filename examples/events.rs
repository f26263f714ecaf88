//! What happened in a step: contacts that began and ended, and hits with their speed.
//!
//! A game plays a sound for a hit and counts who stands on a plate. Events are slices that are there after each
//! step: nothing is called back in the middle of it.
//!
//! `cargo run --example events`

use rustycs::prelude::*;

/// Names of bodies, in the number that a body carries for its owner.
const NAMES: [&str; 4] = ["floor", "plate", "ball", "crate"];

fn main() -> Result<(), BodyError> {
    let mut world = World::new(Settings { hit_threshold: 2.0, ..Settings::default() });
    world.add_force(Force::EARTH_GRAVITY);
    let floor = Body::fixed(Shape::aabb(20.0, 1.0)).at([0.0, -0.5]).user_data(0);
    let plate = Body::fixed(Shape::aabb(2.0, 0.2)).at([4.0, 0.1]).restitution(0.0).user_data(1);
    let ball = Body::dynamic(Shape::circle(0.4)).at([-3.0, 3.0]).velocity([2.0, 0.0]).user_data(2);
    let crate_ = Body::dynamic(Shape::obb(0.8, 0.8)).at([4.0, 2.0]).restitution(0.0).user_data(3);
    world.add(floor)?;
    let plate = world.add(plate)?;
    world.add(ball.material(Material::RUBBER))?;
    let crate_ = world.add(crate_)?;

    let (mut began, mut ended, mut hits) = (0, 0, 0);
    for tick in 1..=180 {
        // What stands on something does so until it is taken away; the removal is an event too.
        if tick == 150 {
            println!("{:4.2} s  the crate is taken away", tick as f32 / 60.0);
            world.remove(crate_);
        }
        world.step();
        // A body that has been removed has no name any more.
        let name = |id| world.body(id).map_or("(gone)", |body| NAMES[body.user_data() as usize]);
        let time = tick as f32 / 60.0;
        for hit in world.events().hits() {
            println!("{time:4.2} s  {} hits {} at {:.1} m/s", name(hit.b), name(hit.a), hit.speed);
            hits += 1;
        }
        for event in world.events().began() {
            println!("{time:4.2} s    {} touches {}", name(event.b), name(event.a));
            began += 1;
        }
        for event in world.events().ended() {
            println!("{time:4.2} s    {} leaves {}", name(event.b), name(event.a));
            ended += 1;
            assert!(event.a == plate || tick < 150 || name(event.b) == "ball");
        }
    }
    println!("{began} contacts began, {ended} ended, {hits} were hits");
    assert!(hits >= 2 && began >= ended, "both bodies fall from above 1 m: 4 m/s and more");
    Ok(())
}
