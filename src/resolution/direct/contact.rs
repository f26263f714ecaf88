//! The rows of a contact: for each of its points one along the normal, which presses, and one along the tangent, whose
//! friction follows it.

use crate::compute::BodyState;
use crate::math::Vec2;
use crate::resolution::constraint_graph::{ConstraintGraph, GraphIndex};
use crate::resolution::direct::row::{Bound, Row};
use crate::resolution::softness::{bias, gap_bias};
use crate::resolution::solve_contact::LARGEST_SPEED_CHANGE;

/// A gap below this share of the way from the centre of what moves to the point is rounding, no unit: the point would
/// be sent to and fro to close it.
const SMALLEST_GAP: f32 = 1e-6;

/// What the solve aims at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Aim {
    /// Before the move: overlaps are pushed apart.
    Push,
    /// After it: nothing approaches.
    Relax,
}

/// A point of a contact that is solved directly.
#[derive(Clone, Copy, Debug)]
pub(super) struct ContactPoint {
    home: GraphIndex,
    /// Which of the points of its contact it is.
    index: usize,
    /// Speed of the surfaces past each other, beside how the bodies move, m/s.
    surface_speed: f32,
    /// The first of its two rows.
    first_row: usize,
}

impl ContactPoint {
    /// Adds the rows of a point between two movers, whose surfaces go past each other with a speed, m/s.
    pub(super) fn new(
        home: GraphIndex,
        index: usize,
        movers: [Option<u32>; 2],
        surface_speed: f32,
        rows: &mut Vec<Row>,
    ) -> Self {
        let first_row = rows.len();
        let friction = Bound::FrictionOf { row: first_row, friction: 0.0 };
        rows.extend([Bound::AT_LEAST_ZERO, friction].map(|bound| Row::new(movers, bound)));
        Self { home, index, surface_speed, first_row }
    }

    /// Fills its rows, from the constraint of the contact and the states of the bodies. `substep_rate` is one over the
    /// length of a substep, 1/s.
    pub(super) fn fill_rows(
        &self,
        rows: &mut [Row],
        graph: &ConstraintGraph,
        states: &[BodyState],
        aim: Aim,
        substep_rate: f32,
    ) {
        let constraint = graph.constraint(self.home);
        let sides = graph.rows(self.home).map(|row| &states[row as usize]);
        let (point, friction) = (&constraint.points[self.index], &constraint.frictions[self.index]);
        let [normal_row, tangent_row] = &mut rows[self.first_row..][..2] else { return };
        let separation = constraint.separation(point, sides[0], sides[1]);
        let anchors = [Vec2::from(point.anchor_a), Vec2::from(point.anchor_b)];
        let moved = (0..2).filter(|&side| normal_row.movers[side].is_some());
        let reach = moved.map(|side| anchors[side].length()).fold(0.0, f32::max);
        let bias = match aim {
            _ if (0.0..SMALLEST_GAP * reach).contains(&separation) => 0.0,
            _ if separation < 0.0 && graph.is_tangled(self.home) => 0.0,
            Aim::Push => bias(separation, substep_rate),
            Aim::Relax => gap_bias(separation, substep_rate),
        };
        // Half the forces have acted before the move, all of them after it.
        let share = if aim == Aim::Push { 0.5 } else { 1.0 };
        normal_row.bound = Bound::Range([0.0, f64::from(LARGEST_SPEED_CHANGE / point.normal_k)]);
        tangent_row.bound =
            Bound::FrictionOf { row: self.first_row, friction: f64::from(constraint.friction) };
        [normal_row.k, tangent_row.k] = [f64::from(point.normal_k), f64::from(friction.mass).recip()];
        [normal_row.bias, tangent_row.bias] = [bias, self.surface_speed].map(f64::from);
        let inverse_inertias = [constraint.inverse_inertia_a, constraint.inverse_inertia_b];
        let normal = Vec2::from(constraint.normal);
        let impulses = [point.normal_impulse, friction.impulse];
        for ((row, axis), impulse) in
            [normal_row, tangent_row].into_iter().zip([normal, normal.perp()]).zip(impulses)
        {
            row.impulse = share * f64::from(impulse);
            for side in 0..2 {
                let sign = if side == 0 { -1.0 } else { 1.0 };
                let entries = [axis.x, axis.y, anchors[side].cross(axis)];
                row.jacobian[side] = entries.map(|entry| sign * f64::from(entry));
                if row.movers[side].is_none() {
                    // A kinematic body moves as it does.
                    let BodyState { velocity, angular_velocity, .. } = sides[side];
                    let moves = [velocity.x, velocity.y, *angular_velocity].map(f64::from);
                    row.bias +=
                        row.jacobian[side].iter().zip(&moves).map(|(entry, v)| entry * v).sum::<f64>();
                } else if inverse_inertias[side] == 0.0 {
                    // Nothing turns it.
                    row.jacobian[side][2] = 0.0;
                }
            }
        }
        if graph.is_pending(self.home)[self.index] {
            // It parts, whatever the velocities.
            let normal_row = &mut rows[self.first_row];
            (normal_row.jacobian, normal_row.bias) = ([[0.0; 3]; 2], 1.0);
        }
    }

    /// Gives the contact the impulses that were found.
    pub(super) fn write_back(&self, rows: &[Row], graph: &mut ConstraintGraph) {
        let impulses = [0, 1].map(|row| rows[self.first_row + row].impulse as f32);
        graph.set_impulses(self.home, self.index, impulses);
    }
}
