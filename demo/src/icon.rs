//! Small pictures on buttons, made of triangles.

use rustycs::Vec2;

use crate::batch::{Batch, Rgba};

/// A small picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Icon {
    Previous,
    Restart,
    Rewind,
    Pause,
    Play,
    Tick,
    Next,
    Plus,
    Minus,
    Left,
    Right,
    Up,
    Down,
}

/// Half of its height, px.
const HALF: f32 = 6.0;

impl Icon {
    /// Draws it around a place, px.
    pub(crate) fn draw(self, batch: &mut Batch, at: Vec2, color: Rgba) {
        let at = Vec2::new(at.x.round(), at.y.round());
        match self {
            Self::Previous => {
                upright(batch, at - Vec2::new(HALF, 0.0), color);
                triangle(batch, at + Vec2::new(1.0, 0.0), -HALF, color);
            }
            Self::Next => {
                upright(batch, at + Vec2::new(HALF, 0.0), color);
                triangle(batch, at - Vec2::new(1.0, 0.0), HALF, color);
            }
            Self::Rewind => {
                triangle(batch, at - Vec2::new(4.0, 0.0), -HALF, color);
                triangle(batch, at + Vec2::new(4.0, 0.0), -HALF, color);
            }
            Self::Play => triangle(batch, at, 7.0, color),
            Self::Pause => {
                upright(batch, at - Vec2::new(3.0, 0.0), color);
                upright(batch, at + Vec2::new(3.0, 0.0), color);
            }
            Self::Tick => {
                upright(batch, at - Vec2::new(HALF, 0.0), color);
                triangle(batch, at + Vec2::new(1.0, 0.0), HALF, color);
            }
            Self::Restart => restart(batch, at, color),
            Self::Plus => {
                bar(batch, at, Vec2::new(4.5, 1.0), color);
                bar(batch, at, Vec2::new(1.0, 4.5), color);
            }
            Self::Left => triangle(batch, at, -4.0, color),
            Self::Right => triangle(batch, at, 4.0, color),
            Self::Up => upward(batch, at, 4.0, color),
            Self::Down => upward(batch, at, -4.0, color),
            Self::Minus => bar(batch, at, Vec2::new(4.5, 1.0), color),
        }
    }
}

/// A triangle that points right, or left where its width is negative.
fn triangle(batch: &mut Batch, at: Vec2, half_width: f32, color: Rgba) {
    let tip = at + Vec2::new(half_width, 0.0);
    let base = at - Vec2::new(half_width, 0.0);
    batch.polygon(&[tip, base + Vec2::new(0.0, HALF), base - Vec2::new(0.0, HALF)], color);
}

/// A triangle that points up, or down where its height is negative.
fn upward(batch: &mut Batch, at: Vec2, half_height: f32, color: Rgba) {
    let base = at + Vec2::new(0.0, half_height);
    let tip = at - Vec2::new(0.0, half_height);
    batch.polygon(&[tip, base + Vec2::new(HALF, 0.0), base - Vec2::new(HALF, 0.0)], color);
}

fn upright(batch: &mut Batch, at: Vec2, color: Rgba) {
    bar(batch, at, Vec2::new(1.5, HALF), color);
}

fn bar(batch: &mut Batch, at: Vec2, half: Vec2, color: Rgba) {
    batch.rectangle(at - half, at + half, color);
}

/// Most of a circle, with a head at its end.
fn restart(batch: &mut Batch, at: Vec2, color: Rgba) {
    const PIECES: usize = 18;
    let turn = rustycs::Rot::from_angle(-4.9 / PIECES as f32);
    let mut arm = Vec2::new(0.0, -HALF);
    for _ in 0..PIECES {
        let next = turn.rotate(arm);
        batch.line(at + arm, at + next, 2.0, color);
        arm = next;
    }
    let head = at + Vec2::new(0.0, -HALF);
    let corners = [[4.5, 0.0], [-1.5, -4.0], [-1.5, 4.0]].map(|corner| head + Vec2::from(corner));
    batch.polygon(&corners, color);
}
