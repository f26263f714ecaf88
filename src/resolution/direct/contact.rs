//! The rows of a contact: for each of its points one along the normal, which presses, and one along the tangent, whose
//! friction follows it.

use crate::compute::BodyState;
use crate::math::Vec2;
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::constraint_graph::{ConstraintGraph, GraphIndex};
use crate::resolution::direct::newton::Newton;
use crate::resolution::direct::row::{Bound, Row};
use crate::resolution::joint::Phase;
use crate::resolution::softness::{bias, gap_bias};
use crate::resolution::solve_contact::LARGEST_SPEED_CHANGE;

/// A gap below this share of the way from the centre of what moves to the point is rounding, no unit: the point would
/// be sent to and fro to close it.
const SMALLEST_GAP: f32 = 1e-6;

/// Share of its own impulse that a contact between bodies gives back that joints connect. They may be as one, so that nothing that it bears
/// moves them: while such a ring of welded crates turns, contacts of its crates would bear more and more, ten times what a blow gives.
const SOFTNESS: f64 = 0.01;

/// A contact that is solved directly.
#[derive(Clone, Copy, Debug)]
pub(super) struct DirectContact {
    home: GraphIndex,
    /// Which of its bodies impulses move.
    moves: [bool; 2],
    /// Speed of the surfaces past each other, beside how the bodies move, m/s.
    surface_speed: f32,
    /// Whether joints connect its bodies.
    are_joined: bool,
    /// The first of its rows, of which each point has two.
    first_row: usize,
    points: usize,
}

impl DirectContact {
    /// Adds the rows of a contact of so many points between two movers, whose surfaces go past each other with a speed, m/s.
    pub(super) fn new(
        home: GraphIndex,
        points: usize,
        movers: [Option<u32>; 2],
        surface_speed: f32,
        are_joined: bool,
        newton: &mut Newton,
    ) -> Self {
        let first_row = newton.rows.len();
        let of_point = |point: usize| {
            let friction = Bound::FrictionOf { row: first_row + 2 * point, friction: 0.0 };
            [Bound::AT_LEAST_ZERO, friction]
        };
        newton.add_pair(movers, (0..points).flat_map(of_point));
        Self {
            home,
            moves: movers.map(|mover| mover.is_some()),
            surface_speed,
            are_joined,
            first_row,
            points,
        }
    }

    /// Fills its rows, from the constraint of the contact and the states of the bodies. `substep_rate` is one over the
    /// length of a substep, 1/s.
    pub(super) fn fill_rows(
        &self,
        rows: &mut [Row],
        graph: &ConstraintGraph,
        states: &[BodyState],
        phase: Phase,
        substep_rate: f32,
    ) {
        let constraint = graph.constraint(self.home);
        let sides = graph.rows(self.home).map(|row| &states[row as usize]);
        let (is_tangled, is_pending) = (graph.is_tangled(self.home), graph.is_pending(self.home));
        let (of_points, _) = rows[self.first_row..].as_chunks_mut::<2>();
        for (index, rows) in of_points.iter_mut().enumerate().take(self.points) {
            let point = &constraint.points[index];
            let separation = constraint.separation(point, sides[0], sides[1]);
            let anchors = [Vec2::from(point.anchor_a), Vec2::from(point.anchor_b)];
            let moved = (0..2).filter(|&side| self.moves[side]);
            let reach = moved.map(|side| anchors[side].length()).fold(0.0, f32::max);
            let bias = match phase {
                _ if (0.0..SMALLEST_GAP * reach).contains(&separation) => 0.0,
                _ if separation < 0.0 && is_tangled => 0.0,
                Phase::Push => bias(separation, substep_rate),
                Phase::Relax => gap_bias(separation, substep_rate),
            };
            self.fill_point(rows, &constraint, index, sides, phase);
            rows[0].carried = rows[0].bias;
            rows[1].carried = rows[1].bias;
            rows[0].bias += f64::from(bias);
            if is_pending[index] {
                // It parts, whatever the velocities.
                (rows[0].jacobian, rows[0].bias) = ([[0.0; 3]; 2], 1.0);
            }
        }
    }

    /// Fills the two rows of a point, but for its gap.
    fn fill_point(
        &self,
        rows: &mut [Row; 2],
        constraint: &ContactConstraint<f32>,
        index: usize,
        sides: [&BodyState; 2],
        phase: Phase,
    ) {
        let (point, friction) = (&constraint.points[index], &constraint.frictions[index]);
        let anchors = [Vec2::from(point.anchor_a), Vec2::from(point.anchor_b)];
        let inverse_inertias = [constraint.inverse_inertia_a, constraint.inverse_inertia_b];
        let normal = Vec2::from(constraint.normal);
        let impulses = [point.normal_impulse, friction.impulse];
        // Half the forces have acted before the move, all of them after it.
        let share = if phase == Phase::Push { 0.5 } else { 1.0 };
        rows[0].bound = Bound::Range([0.0, f64::from(LARGEST_SPEED_CHANGE / point.normal_k)]);
        if let Bound::FrictionOf { friction, .. } = &mut rows[1].bound {
            *friction = f64::from(constraint.friction);
        }
        [rows[0].k, rows[1].k] = [f64::from(point.normal_k), f64::from(friction.mass).recip()];
        for row in &mut *rows {
            row.softness = if self.are_joined { SOFTNESS * row.k } else { 0.0 };
        }
        [rows[0].bias, rows[1].bias] = [0.0, f64::from(self.surface_speed)];
        for ((row, axis), impulse) in rows.iter_mut().zip([normal, normal.perp()]).zip(impulses) {
            row.impulse = share * f64::from(impulse);
            for side in 0..2 {
                let sign = if side == 0 { -1.0 } else { 1.0 };
                let entries = [axis.x, axis.y, anchors[side].cross(axis)];
                row.jacobian[side] = entries.map(|entry| sign * f64::from(entry));
                if !self.moves[side] {
                    // A kinematic body moves as it does.
                    let BodyState { velocity, angular_velocity, .. } = sides[side];
                    let moves = [velocity.x, velocity.y, *angular_velocity].map(f64::from);
                    row.bias +=
                        row.jacobian[side].iter().zip(&moves).map(|(entry, v)| entry * v).sum::<f64>();
                    row.jacobian[side] = [0.0; 3];
                } else if inverse_inertias[side] == 0.0 {
                    // Nothing turns it.
                    row.jacobian[side][2] = 0.0;
                }
            }
        }
    }

    /// Gives the contact the impulses that were found.
    pub(super) fn write_back(&self, rows: &[Row], graph: &mut ConstraintGraph) {
        let (of_points, _) = rows[self.first_row..].as_chunks::<2>();
        for (point, rows) in of_points.iter().enumerate().take(self.points) {
            graph.set_impulses(self.home, point, [rows[0].impulse as f32, rows[1].impulse as f32]);
        }
    }
}
