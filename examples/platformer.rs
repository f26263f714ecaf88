//! A platformer without pictures: a player runs to a lift, jumps onto it and rides, the same at any frame rate.
//!
//! `cargo run --release --example platformer`

use rustycs::prelude::*;

/// m/s, and N s for the 60 kg of the player.
const RUN: f32 = 4.0;
const JUMP: f32 = 60.0 * 4.5;

/// What happens before each tick: all that is to come to the same at any number of frames per second.
fn control(world: &mut World, player: BodyId, lift: BodyId) {
    let swing = Vec2::from_angle(2.0 * world.time() as f32).x;
    if let Some(mut lift) = world.body_mut(lift) {
        lift.move_to(Pose::at([4.0, 1.0 - 0.5 * f64::from(swing)]));
    }
    let is_ground = |contact: ContactRef<'_>| contact.is_touching() && contact.normal_on(player).y > 0.7;
    let stands = world.contacts_of(player).any(is_ground);
    let Some(mut player) = world.body_mut(player) else { return };
    let Vec2 { x, y } = player.position();
    if stands && x > 2.2 && y < 1.0 {
        player.apply_impulse([0.0, JUMP]);
    }
    let upward = player.velocity().y;
    player.set_velocity([if x > 3.8 { 0.0 } else { RUN }, upward]);
}

fn main() -> Result<(), BodyError> {
    let mut hashes = Vec::new();
    for rate in [20, 60, 144] {
        println!("{rate} frames per second");
        let mut world = World::new(Settings::default());
        world.add_force(Force::EARTH_GRAVITY);
        world.add(Body::fixed(Shape::rectangle(20.0, 1.0)).at([0.0, -0.5]))?;
        let lift = world.add(Body::kinematic(Shape::rectangle(2.0, 0.2)).at([4.0, 0.5]))?;
        let player = Body::dynamic(Shape::rectangle(0.5, 1.8)).at([0.0, 0.9]).mass(60.0);
        // Without friction it does not stick to walls, whatever these are made of.
        let player = world.add(player.fixed_rotation(true).friction(0.0).restitution(0.0))?;
        for _ in 0..rate * 10 {
            world.advance_with(1.0 / f64::from(rate), |world| control(world, player, lift));
            for hit in world.events().hits() {
                println!("  the player meets {:?} at {:.1} m/s", hit.other(player), hit.speed);
            }
        }
        // A frame shows what lies between two ticks.
        let shown = |id| world.body(id).map(|body| body.interpolated_pose(world.alpha()).center);
        if let (Some(player), Some(lift)) = (shown(player), shown(lift)) {
            println!("  after 10 s the player is drawn at {player:.2}, and the lift at {lift:.2}");
            assert!((player.y - lift.y - 1.0).abs() < 0.02, "the player stands on the lift");
        }
        hashes.push(world.state_hash());
    }
    assert!(hashes.iter().all(|&hash| hash == hashes[0]), "the same at any frame rate");
    Ok(())
}
