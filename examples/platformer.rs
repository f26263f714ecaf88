//! A platformer without pictures: a player runs and jumps onto a lift, in a wind that lets things sleep.
//!
//! What is to come to the same at any number of frames per second is done before each tick, by `advance_with`: control, and
//! the lift. The program plays the same ten seconds at three frame rates, and checks that it is the same.
//!
//! `cargo run --release --example platformer`

use rustycs::prelude::*;

/// m/s, and N s for the 60 kg of the player.
const RUN: f32 = 4.0;
const JUMP: f32 = 60.0 * 4.5;

struct Game {
    world: World,
    player: BodyId,
    lift: BodyId,
}

impl Game {
    fn new() -> Result<Self, BodyError> {
        // Of two coefficients the smaller holds: a player without friction does not stick to walls.
        let mut world = World::new(Settings { friction_mix: Mix::Min, ..Settings::default() });
        world.add_force(Force::EARTH_GRAVITY);
        world.add(Body::fixed(Shape::rectangle(20.0, 1.0)).at([0.0, -0.5]))?;
        let lift = world.add(Body::kinematic(Shape::rectangle(2.0, 0.2)).at([4.0, 0.5]))?;
        for i in 0..5 {
            let crate_ = Body::dynamic(Shape::rectangle(0.5, 0.5)).at([-8.0, 0.25 + 0.5 * f64::from(i)]);
            world.add(crate_.density(40.0).restitution(0.0))?;
        }
        let player = Body::dynamic(Shape::rectangle(0.5, 1.8)).at([0.0, 0.9]).mass(60.0);
        let player = world.add(player.fixed_rotation(true).friction(0.0).restitution(0.0))?;
        Ok(Self { world, player, lift })
    }

    fn frame(&mut self, seconds: f64) {
        // Once per frame: it acts for as long as the frame lasts, and wakes nothing.
        let pushed: Vec<BodyId> = self.world.bodies_in([-10.0, 0.0], [-6.0, 5.0]);
        for id in pushed {
            if let Some(body) = self.world.body_mut(id) {
                body.without_waking().apply_force([5.0, 0.0]);
            }
        }
        let Self { world, player, lift } = self;
        world.advance_with(seconds, |world| control(world, *player, *lift));
        for hit in world.events().hits() {
            if let Some(other) = hit.other(*player) {
                println!("  the player meets {other:?} at {:.1} m/s", hit.speed);
            }
        }
    }
}

/// What happens before each tick.
fn control(world: &mut World, player: BodyId, lift: BodyId) {
    let time = world.time();
    if let Some(mut lift) = world.body_mut(lift) {
        // Up and down between 0.5 and 1.5 m.
        lift.move_to(Pose::at([4.0, 1.0 - 0.5 * (Vec2::from_angle(2.0 * time as f32).x as f64)]));
    }
    let is_on_ground =
        world.contacts_of(player).any(|contact| contact.is_touching() && contact.normal_on(player).y > 0.7);
    let Some(mut player) = world.body_mut(player) else { return };
    if is_on_ground && player.position().x > 2.2 && player.position().y < 1.0 {
        player.apply_impulse([0.0, JUMP]);
    }
    let stays = player.position().x > 3.8;
    let upward = player.velocity().y;
    player.set_velocity([if stays { 0.0 } else { RUN }, upward]);
}

fn main() -> Result<(), BodyError> {
    let mut hashes = Vec::new();
    for rate in [20, 60, 144] {
        println!("{rate} frames per second");
        let mut game = Game::new()?;
        for _ in 0..rate * 10 {
            game.frame(1.0 / f64::from(rate));
        }
        let Game { world, player, lift } = &game;
        let shown = |id: &BodyId| world.body(*id).map(|body| body.interpolated_pose(world.alpha()).center);
        if let (Some(player), Some(lift)) = (shown(player), shown(lift)) {
            println!("  after 10 s the player is drawn at {player:.2}, and the lift at {lift:.2}");
            assert!((player.y - lift.y - 1.0).abs() < 0.02, "the player stands on the lift");
        }
        println!("  {} of 7 bodies that can move are awake", world.awake_count());
        hashes.push(world.state_hash());
    }
    assert!(hashes.iter().all(|&hash| hash == hashes[0]), "the same at any frame rate");
    Ok(())
}
