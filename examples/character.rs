//! A character moved by hand: it runs over tiles, up a step, onto a lift, and jumps through a one-way floor.
//!
//! `cargo run --release --example character`

use rustycs::prelude::*;

/// A tick, s, and speeds, m/s.
const DT: f32 = 1.0 / 60.0;
const RUN: f32 = 3.0;
const JUMP: f32 = 6.5;

fn main() -> Result<(), BodyError> {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    // As it is drawn, the highest row first: a step of one tile at the right.
    let rows = ["........##", "##########"];
    let solid: Vec<bool> = rows.iter().rev().flat_map(|row| row.chars().map(|tile| tile == '#')).collect();
    world.add(Ground::from_tiles(&solid, 10, 0.4).at([0.0, -0.4]))?;
    let lift = world.add(Body::kinematic(Shape::rectangle(2.0, 0.4)).at([5.2, 0.2]))?;
    let balcony = world.add(Body::fixed(Shape::rectangle(2.0, 0.2)).at([5.2, 3.5]).one_way([0.0, 1.0]))?;

    let hero = Character::new(Shape::rectangle(0.4, 0.9)).at([0.5, 0.6]).step_height(0.45).push_force(200.0);
    let mut hero = Mover::new(hero)?;
    let mut velocity = Vec2::ZERO;
    let mut stands_on = None;
    for tick in 0..360 {
        if tick == 120 {
            // It is on the lift by now, which goes up by 1.5 m.
            world.body_mut(lift).unwrap().set_velocity([0.0, 1.0]);
        } else if tick == 210 {
            world.body_mut(lift).unwrap().set_velocity([0.0, 0.0]);
        }
        world.step();
        velocity.x = if hero.position().x < 5.0 { RUN } else { 0.0 };
        velocity.y -= 9.81 * DT;
        if tick == 240 && hero.is_grounded() {
            velocity.y = JUMP + hero.ground_velocity(&world).y;
        }
        let moved = hero.move_by(&mut world, velocity * DT);
        if moved.is_grounded() || moved.ceiling.is_some() {
            velocity.y = 0.0;
        }
        let now = moved.ground.map(|ground| ground.body);
        if now != stands_on {
            println!("after {:.2} s at {:.2} it stands on {now:?}", world.time(), hero.position());
            stands_on = now;
        }
    }
    assert_eq!(stands_on, Some(balcony), "it jumped from the lift through the balcony");
    assert!((hero.position().y - 4.05).abs() < 0.01);
    Ok(())
}
