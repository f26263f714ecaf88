//! Letters, each one body of several bars.

use rustycs::{Body, Collider, Material, Rot, Settings, Shape, Vec2, World};

use crate::parts::{put, put_pool, world_with_gravity};
use crate::random::Random;
use crate::{Scene, View};

/// Letters, each one body of several bars.
pub const SCENE: Scene = Scene {
    name: "letters",
    group: "classic",
    summary: "Each letter is one body of several bars: they hook into each other as no convex shapes do.",
    view: View::above(0.0, 0.0, 22.0, 15.0),
    build,
    is_random: true,
    ..Scene::PLAIN
};

/// The strokes of a letter, each from one place to another, in a box of 2 by 3.
type Strokes = &'static [[[f32; 2]; 2]];

const WORD: [Strokes; 7] = [
    // R
    &[
        [[0.0, 0.0], [0.0, 3.0]],
        [[0.0, 3.0], [2.0, 3.0]],
        [[2.0, 3.0], [2.0, 1.5]],
        [[0.0, 1.5], [2.0, 1.5]],
        [[0.5, 1.5], [2.0, 0.0]],
    ],
    // U
    &[[[0.0, 0.0], [2.0, 0.0]], [[0.0, 0.0], [0.0, 3.0]], [[2.0, 0.0], [2.0, 3.0]]],
    S,
    // T
    &[[[1.0, 0.0], [1.0, 3.0]], [[0.0, 3.0], [2.0, 3.0]]],
    // Y
    &[[[1.0, 0.0], [1.0, 1.5]], [[1.0, 1.5], [0.0, 3.0]], [[1.0, 1.5], [2.0, 3.0]]],
    // C
    &[[[0.0, 0.0], [0.0, 3.0]], [[0.0, 0.0], [2.0, 0.0]], [[0.0, 3.0], [2.0, 3.0]]],
    S,
];

const S: Strokes = &[
    [[0.0, 3.0], [2.0, 3.0]],
    [[0.0, 3.0], [0.0, 1.5]],
    [[0.0, 1.5], [2.0, 1.5]],
    [[2.0, 1.5], [2.0, 0.0]],
    [[0.0, 0.0], [2.0, 0.0]],
];

/// How often the word falls.
const WORDS: u8 = 3;
/// Size of a letter against its strokes, no unit.
const SCALE: f32 = 0.6;
/// Width of a bar, m.
const BAR: f32 = 0.3;

fn build(seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    put_pool(&mut world, 19.0, 9.0);
    let mut random = Random::new(seed);
    for row in 0..WORDS {
        for (column, strokes) in WORD.into_iter().enumerate() {
            let x = (column as f32 - 3.0) * 2.4 + random.between(-0.2, 0.2);
            let y = 3.0 + 3.2 * f32::from(row);
            let angle = random.between(-0.2, 0.2);
            let body = letter(strokes, Vec2::new(x, y), Rot::from_angle(angle));
            put(&mut world, body.material(Material::PLASTIC).restitution(0.2));
        }
    }
    world
}

/// A letter of bars with the middle of its box at a place. Its frame is that of its first bar.
fn letter(strokes: Strokes, place: Vec2, rotation: Rot) -> Body {
    let bars: Vec<(Shape, Vec2, Rot)> =
        strokes.iter().map(|&[from, to]| bar(from.into(), to.into())).collect();
    let (first, middle, turn) = bars[0];
    let box_middle = Vec2::new(1.0, 1.5) * SCALE;
    let at = place + rotation.rotate(middle - box_middle);
    let body = Body::dynamic(first).at([at.x, at.y]).angle((rotation * turn).angle());
    bars[1..].iter().fold(body, |body, &(shape, at, rotation)| {
        let angle = (rotation * turn.inverse()).angle();
        body.with(Collider::new(shape).at(turn.unrotate(at - middle)).angle(angle))
    })
}

/// A bar, where its middle is, and its direction.
fn bar(from: Vec2, to: Vec2) -> (Shape, Vec2, Rot) {
    let along = (to - from) * SCALE;
    let length = along.length();
    let shape = Shape::rectangle(length + BAR, BAR);
    (shape, (from + to) * (0.5 * SCALE), Rot { c: along.x / length, s: along.y / length })
}
