//! A character that is moved by hand: it does not hang, hop, creep, sink or slip, wherever it walks.

mod around;
mod ground;
mod riding;
mod walls;

use rustycs::prelude::*;

/// A tick, s.
const DT: f32 = 1.0 / 60.0;

/// A character that walks at a speed and falls, as a game would have it.
struct Walker {
    mover: Mover,
    /// Along x, m/s.
    speed: f32,
    /// Along y, m/s.
    fall: f32,
}

impl Walker {
    fn new(character: Character, speed: f32) -> Self {
        Self { mover: Mover::new(character).unwrap(), speed, fall: 0.0 }
    }

    /// Steps the world and moves.
    fn tick(&mut self, world: &mut World) -> Moved {
        world.step();
        self.fall -= 9.81 * DT;
        let moved = self.mover.move_by(world, [self.speed * DT, self.fall * DT]);
        if moved.is_grounded() {
            self.fall = 0.0;
        }
        moved
    }

    fn run(&mut self, world: &mut World, seconds: f32) {
        for _ in 0..(seconds / DT).round() as u32 {
            self.tick(world);
        }
    }

    fn place(&self) -> [f64; 2] {
        self.mover.position().into()
    }

    fn jump(&mut self, speed: f32) {
        self.fall = speed;
    }
}

/// Of each kind: a box, a disc, a polygon and a capsule, 1 m high.
fn shapes() -> [Shape; 4] {
    let bevelled = [
        [-0.2, -0.5],
        [0.2, -0.5],
        [0.3, -0.4],
        [0.3, 0.4],
        [0.2, 0.5],
        [-0.2, 0.5],
        [-0.3, 0.4],
        [-0.3, -0.4],
    ];
    let capsule = Shape::capsule([0.0, -0.2], [0.0, 0.2], 0.3);
    [Shape::rectangle(0.6, 1.0), Shape::circle(0.5), Shape::polygon(bevelled).unwrap(), capsule]
}

fn skin(shape: Shape) -> f64 {
    f64::from(Character::new(shape).get_skin())
}
