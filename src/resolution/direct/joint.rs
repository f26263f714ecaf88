//! The rows of a joint, by which contacts feel the mass behind it.
//!
//! Joints are solved by themselves, and exactly: they turn within the move, and have the last word. Here each row that acts takes part with
//! the geometry that it has now, and what it bears more is handed over to it, so that bodies are left as their joints want them, but for
//! how they turn. Where joints go through the move in several steps they are left out: contacts and joints are solved in turn there.

use crate::resolution::direct::newton::Newton;
use crate::resolution::direct::row::{Bound, Row, Triple};
use crate::resolution::joint::{JointSolver, Phase};

/// A joint between bodies of which one is solved directly.
#[derive(Clone, Copy, Debug)]
pub(super) struct DirectJoint {
    /// Its rows among those of the joint solver, from the first to the end.
    of_joint: [u32; 2],
    /// Of its bodies those that are solved directly.
    movers: [Option<u32>; 2],
    first_row: usize,
}

impl DirectJoint {
    /// Adds the rows of a joint between two movers.
    pub(super) fn new(of_joint: [u32; 2], movers: [Option<u32>; 2], newton: &mut Newton) -> Self {
        let first_row = newton.rows.len();
        newton.add_pair(movers, (of_joint[0]..of_joint[1]).map(|_| Bound::NONE));
        Self { of_joint, movers, first_row }
    }

    /// Fills its rows: their coordinates are to change as fast as with the velocities that the movers have `before`.
    pub(super) fn fill_rows(&self, rows: &mut [Row], joints: &JointSolver, phase: Phase, before: &[Triple]) {
        for (row, of_joint) in rows[self.first_row..].iter_mut().zip(self.of_joint[0]..self.of_joint[1]) {
            (row.jacobian, row.bias, row.impulse) = ([[0.0; 3]; 2], 0.0, 0.0);
            let Some(acting) = joints.acting(of_joint, phase) else { continue };
            (row.k, row.softness, row.bound) = (acting.k, acting.softness, Bound::Range(acting.range));
            for (side, mover) in self.movers.into_iter().enumerate() {
                if let Some(mover) = mover {
                    row.jacobian[side] = acting.j[side];
                    let before = before[mover as usize];
                    row.bias -= (0..3).map(|axis| acting.j[side][axis] * before[axis]).sum::<f64>();
                }
            }
        }
    }

    /// Hands over what the rows bear more to those of the joint, and adds it to what they have been `handed`, by row.
    pub(super) fn hand_over(&self, rows: &[Row], joints: &mut JointSolver, handed: &mut [f64]) {
        for (number, of_joint) in (self.of_joint[0]..self.of_joint[1]).enumerate() {
            let impulse = rows[self.first_row + number].impulse;
            joints.bear(of_joint, impulse);
            handed[self.first_row + number] += impulse;
        }
    }

    /// Takes it back.
    pub(super) fn take_back(&self, joints: &mut JointSolver, handed: &[f64]) {
        for (number, of_joint) in (self.of_joint[0]..self.of_joint[1]).enumerate() {
            joints.bear(of_joint, -handed[self.first_row + number]);
        }
    }
}
