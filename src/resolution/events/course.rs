//! Which bodies are off course: they move otherwise than their contacts were made for.
//!
//! Contacts are found once per step, for bodies that go on with the velocity they have as it begins, along straight ways and
//! without turning far. A body that is struck within the step, or spins fast, may meet what it has no contact with. It is off
//! course if it may stray by more than half its own width from where it is expected. What strays by less is still on the same
//! side of everything when the next step finds its contacts. Once off course it stays so until the step ends, and is swept: its
//! old velocity does not take it back to its old way.
//!
//! Cost: one comparison of all velocities with those of the step's begin, in which nearly all steps find nobody.

use crate::body::Bodies;
use crate::compute::{BodyState, GROUND_ROW};

/// A body is off course if it may stray by more than this share of its width, no unit.
const STRAYS_BY: f32 = 0.5;

/// How many bodies are looked at together: hardly ever is one of them off course.
const BLOCK: usize = 8;

/// What bodies were expected to do.
#[derive(Clone, Debug, Default)]
pub(crate) struct Courses {
    /// By row: velocity, m/s, and angular velocity, rad/s, as the step began, and 0, from which the angular velocity counts as a turn.
    /// Empty where nobody is swept.
    then: Vec<[f32; 4]>,
    /// Rows of those that have left their course in this step, and by row whether it has.
    left: Vec<u32>,
    has_left: Vec<bool>,
    /// Length of the step, s.
    dt: f32,
}

impl Courses {
    /// Takes down what bodies are expected to do in a step of `dt`, s, if they are to be swept at all.
    pub(crate) fn begin(&mut self, bodies: &Bodies, dt: f32, are_swept: bool) {
        self.dt = dt;
        self.then.clear();
        for row in self.left.drain(..) {
            self.has_left[row as usize] = false;
        }
        if are_swept {
            self.has_left.resize(bodies.row_count(), false);
            self.left.reserve(bodies.row_count());
            let unturned =
                |state: &BodyState| [state.velocity.x, state.velocity.y, state.angular_velocity, 0.0];
            self.then.extend(bodies.states[..bodies.row_count()].iter().map(unturned));
        }
    }

    /// Finds the rows of those that are off course, in order.
    pub(super) fn find_off(&mut self, bodies: &Bodies, rows: &mut Vec<u32>) {
        let most = self.harmless_changes(bodies.smallest_thickness, bodies.largest_extent);
        for first in (0..self.then.len()).step_by(BLOCK) {
            let block = first..self.then.len().min(first + BLOCK);
            let mut greatest = [0.0; 4];
            for (state, then) in bodies.states[block.clone()].iter().zip(&self.then[block.clone()]) {
                let changes = changes(state, then);
                greatest = std::array::from_fn(|index| larger(greatest[index], changes[index]));
            }
            if greatest.into_iter().zip(most).any(|(of, most)| of > most) {
                for row in block {
                    self.look_at(bodies, row as u32);
                }
            }
        }
        rows.clear();
        rows.reserve(self.left.capacity());
        rows.extend(&self.left);
        rows.sort_unstable();
    }

    /// Looks at the body in a row, as it has got a new velocity; returns whether it is off course. Then it is so until the step ends.
    pub(super) fn look_at(&mut self, bodies: &Bodies, row: u32) -> bool {
        let Some(then) = self.then.get(row as usize).filter(|_| row != GROUND_ROW) else { return false };
        if self.has_left[row as usize] {
            return true;
        }
        let motion = &bodies.motions[bodies.slot_of_row(row as usize) as usize];
        let extent = if motion.is_round { 0.0 } else { motion.extent };
        // What has no finite width is not to get to the far side of the thinnest of what it may meet.
        let width = if motion.thickness.is_finite() { motion.thickness } else { bodies.smallest_thickness };
        let is_off = self.strays(changes(&bodies.states[row as usize], then), extent) > STRAYS_BY * width;
        if is_off {
            self.has_left[row as usize] = true;
            self.left.push(row);
        }
        is_off
    }

    /// Changes within which no body is off course, whatever its width and extent, m: each may take a quarter of the way.
    fn harmless_changes(&self, smallest_thickness: f32, largest_extent: f32) -> [f32; 4] {
        let way = 0.25 * STRAYS_BY * smallest_thickness;
        let speed = way / self.dt;
        [speed, speed, speed / largest_extent, (2.0 * way / largest_extent).sqrt() / self.dt]
    }

    /// How far a body may stray in the step, m, by its changes. A turn by the angle θ is expected to move its outline, of
    /// this `extent`, m, along a straight line, from which it strays by θ²/2.
    fn strays(&self, [x, y, spin, turn]: [f32; 4], extent: f32) -> f32 {
        let angle = turn * self.dt;
        (x + y) * self.dt + (spin * self.dt + 0.5 * angle * angle) * extent
    }
}

/// What has changed of a body since the step began: its velocity, m/s, its angular velocity, rad/s, and its angle, as a rate,
/// rad/s.
fn changes(state: &BodyState, then: &[f32; 4]) -> [f32; 4] {
    let now = [state.velocity.x, state.velocity.y, state.angular_velocity, state.angular_velocity];
    std::array::from_fn(|index| (now[index] - then[index]).abs())
}

/// The larger of two numbers; unlike `f32::max` one instruction in lanes.
fn larger(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}
