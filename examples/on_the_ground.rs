//! "Am I on the ground?", asked for 100 characters on a heap of 3,000 boxes: what it costs, beside a step of that world.
//!
//! `World::contacts_of` looks at the contacts of one body, and not at those of all others.
//!
//! `cargo run --release --example on_the_ground`

use std::time::Instant;

use rustycs::prelude::*;

const CHARACTERS: usize = 100;
const ROUNDS: u32 = 200;

fn is_on_ground(world: &World, character: BodyId) -> bool {
    let mut contacts = world.contacts_of(character);
    contacts.any(|contact| contact.is_touching() && contact.normal_on(character).y > 0.7)
}

fn main() -> Result<(), BodyError> {
    let mut world = World::new(Settings { sleep: false, ..Settings::default() });
    world.add_force(Force::EARTH_GRAVITY);
    world.add(Body::fixed(Shape::rectangle(200.0, 1.0)).at([0.0, -0.5]))?;
    for number in 0..3000 {
        let [column, row] = [number % 150, number / 150].map(f64::from);
        world.add(Body::dynamic(Shape::rectangle(0.9, 0.9)).at([column - 75.0, 0.45 + 0.91 * row]))?;
    }
    let mut characters = Vec::new();
    for number in 0..CHARACTERS {
        // Every other one hangs in the air.
        let height = if number % 2 == 0 { 19.0 } else { 40.0 };
        let character = Body::dynamic(Shape::rectangle(0.5, 1.4)).at([number as f64 - 50.0, height]);
        characters.push(world.add(character.fixed_rotation(true).friction(0.0).restitution(0.0))?);
    }
    for _ in 0..60 {
        world.step();
    }

    let begin = Instant::now();
    world.step();
    let step = begin.elapsed();
    let begin = Instant::now();
    let mut standing = 0;
    for _ in 0..ROUNDS {
        standing = characters.iter().filter(|&&character| is_on_ground(&world, character)).count();
    }
    let asked = begin.elapsed() / ROUNDS;
    println!("{} contacts; {standing} of {CHARACTERS} characters stand", world.contacts().count());
    println!("a step takes {step:?}, and to ask for all characters {asked:?}");
    assert_eq!(standing, CHARACTERS / 2);
    Ok(())
}
