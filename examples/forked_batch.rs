//! One world, many futures: clone a settled world, push each clone another way, step them side by side.
//!
//! A world owns all it needs, so a clone can go to another thread; and a step gives the same bits wherever it
//! runs, so the threads find exactly what one thread finds. Planning, rollback and search are made of this.
//!
//! `cargo run --release --example forked_batch`

use std::thread;
use std::time::Instant;

use rustycs::prelude::*;

/// Boxes in the tower; as many futures, in each of which another one is pushed.
const LEVELS: usize = 12;
/// How fast the box is made to go, m/s.
const PUSH: f32 = 12.0;

fn main() -> Result<(), BodyError> {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    world.add(Body::fixed(Shape::aabb(40.0, 1.0)).at([0.0, -0.5]))?;
    let mut boxes = Vec::new();
    for level in 0..LEVELS {
        let brick = Body::dynamic(Shape::obb(1.0, 0.5)).at([0.0, 0.25 + 0.5 * level as f32]);
        boxes.push(world.add(brick.material(Material::PLASTIC))?);
    }
    (0..60).for_each(|_| world.step());

    // The future in which the box on this level is pushed: the state after 4 s, and how many still stand.
    let future = |mut world: World, level: usize| {
        if let Some(mut brick) = world.body_mut(boxes[level]) {
            brick.set_velocity([PUSH, 0.0]);
        }
        (0..240).for_each(|_| world.step());
        let stands = |id: &&BodyId| world.body(**id).is_some_and(|body| body.position().x.abs() < 0.5);
        (world.state_hash(), boxes.iter().filter(stands).count())
    };

    let start = Instant::now();
    let one_by_one: Vec<_> = (0..LEVELS).map(|level| future(world.clone(), level)).collect();
    let sequential = start.elapsed();

    let start = Instant::now();
    let side_by_side: Vec<_> = thread::scope(|scope| {
        let (world, future) = (&world, &future);
        let threads: Vec<_> =
            (0..LEVELS).map(|level| scope.spawn(move || future(world.clone(), level))).collect();
        threads.into_iter().map(|thread| thread.join().expect("a world steps without panic")).collect()
    });
    let parallel = start.elapsed();

    for (level, (hash, standing)) in side_by_side.iter().enumerate() {
        println!("box {level:2} pushed: {standing:2} of {LEVELS} stay, state {hash:016x}");
    }
    println!("{LEVELS} futures of 4 s: one by one {sequential:.1?}, side by side {parallel:.1?}, same bits");
    assert_eq!(one_by_one, side_by_side);
    Ok(())
}
