//! The rows of a joint, by which contacts feel the mass behind it.
//!
//! Joints are solved by themselves, and exactly: they turn within the move, and have the last word. Here each row that acts takes part with
//! the geometry that it was solved with last, and hands over to the joint what it bears. So bodies are left as their joints want them, but
//! for how they turn, and both come to an end after a few rounds.

use core::ops::Range;

use crate::resolution::direct::newton::Newton;
use crate::resolution::direct::row::{Kind, Row, Triple, dot};
use crate::resolution::joint::JointSolver;

/// A joint between bodies of which one at least is solved directly.
#[derive(Clone, Debug)]
pub(super) struct DirectJoint {
    /// Its rows among those of the joint solver.
    of_joint: Range<u32>,
    /// Of its bodies those that are solved directly.
    movers: [Option<u32>; 2],
    first_row: usize,
}

impl DirectJoint {
    /// Adds the rows of a joint, between the movers among its bodies.
    pub(super) fn new(of_joint: Range<u32>, movers: [Option<u32>; 2], newton: &mut Newton) -> Self {
        let first_row = newton.rows.len();
        newton.add_pair(movers, of_joint.clone().map(|_| Kind::Joint([0.0; 2])));
        Self { of_joint, movers, first_row }
    }

    /// Begins a phase, in which nothing has been handed over to the joint yet.
    pub(super) fn begin(&self, rows: &mut [Row]) {
        rows[self.first_row..][..self.of_joint.len()].iter_mut().for_each(|row| row.impulse = 0.0);
    }

    /// Fills its rows, which keep their impulses: coordinates are to go on changing as fast as with the velocities that the movers have
    /// `now`, which the joint has found. The impulse of a row that does not act cannot change.
    pub(super) fn fill_rows(&self, rows: &mut [Row], joints: &JointSolver, now: &[Triple]) {
        for (row, of_joint) in rows[self.first_row..].iter_mut().zip(self.of_joint.clone()) {
            let Some(acting) = joints.acting(of_joint) else {
                row.kind = Kind::Joint([row.impulse; 2]);
                continue;
            };
            (row.k, row.softness) = (acting.k, acting.softness);
            row.kind = Kind::Joint(acting.range.map(|change| row.impulse + change));
            row.bias = acting.slack - row.softness * row.impulse;
            for (side, mover) in self.movers.into_iter().enumerate() {
                if let Some(mover) = mover {
                    row.jacobian[side] = acting.j[side];
                    row.bias -= dot(acting.j[side], now[mover as usize]);
                }
            }
        }
    }

    /// Hands over to the joint what its rows bear.
    pub(super) fn hand_over(&self, rows: &[Row], joints: &mut JointSolver) {
        for (row, of_joint) in rows[self.first_row..].iter().zip(self.of_joint.clone()) {
            joints.hand_over(of_joint, row.impulse);
        }
    }

    /// Takes it back.
    pub(super) fn take_back(&self, rows: &[Row], joints: &mut JointSolver) {
        for (row, of_joint) in rows[self.first_row..].iter().zip(self.of_joint.clone()) {
            joints.take_back(of_joint, row.impulse);
        }
    }
}
