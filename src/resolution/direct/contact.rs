//! The rows of a contact: for each of its points one along the normal, which presses, and one along the tangent, whose
//! friction follows it; and one for its spin, where something rolls.

use crate::body::Bodies;
use crate::collision::Contact;
use crate::compute::BodyState;
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::constraint_graph::{ConstraintGraph, GraphIndex};
use crate::resolution::direct::newton::Newton;
use crate::resolution::direct::row::{Kind, Row, Triple};
use crate::resolution::joint::{JointSolver, Phase};
use crate::resolution::rolling::rolling_arm;
use crate::resolution::softness::{bias, gap_bias};
use crate::resolution::solve_contact::LARGEST_SPEED_CHANGE;

/// A contact between bodies that joints connect yields this share of what it bears, taken by the mass of the whole island: under its weight a
/// body sinks by some micrometres. Joints may leave such bodies no way to move against each other. Without it contacts in a ring of welded crates bear more
/// and more while it turns, more than any blow gives. Taken by the masses of the two, a light one under 100 kg is squeezed flat.
const SOFTNESS: f64 = 0.01;

/// A contact that is solved directly.
#[derive(Clone, Copy, Debug)]
pub(super) struct DirectContact {
    home: GraphIndex,
    /// Which of its bodies impulses move.
    moves: [bool; 2],
    /// Speed of the surfaces past each other, beside how the bodies move, m/s.
    surface_speed: f32,
    /// By how much it yields to what it bears, over k, no unit.
    softness: f64,
    /// Width of the thinner body, m.
    thickness: f64,
    /// The first of its rows: two of each point, then that of the spin.
    first_row: usize,
    points: usize,
    /// Where something rolls, the moment of rolling resistance in the last substep, N m s, on b.
    rolling_moment: Option<f64>,
}

impl DirectContact {
    /// Adds the rows of a contact between two movers of an island with a [`mass_ratio`](Newton::mass_ratio).
    pub(super) fn new(
        contact: &Contact,
        home: GraphIndex,
        movers: [Option<u32>; 2],
        bodies: &Bodies,
        joints: &JointSolver,
        mass_ratio: f64,
        newton: &mut Newton,
    ) -> Self {
        let (first_row, points) = (newton.rows.len(), contact.manifold.points().len());
        let of_point = |point: usize| {
            [Kind::Normal { most: 0.0 }, Kind::Friction { normal: first_row + 2 * point, friction: 0.0 }]
        };
        let arm = rolling_arm(contact, contact.colliders.map(|slot| &bodies.motions[slot as usize]));
        let of_spin = arm.map(|arm| Kind::Friction { normal: first_row, friction: arm.into() });
        newton.add_pair(movers, (0..points).flat_map(of_point).chain(of_spin));
        Self {
            home,
            moves: movers.map(|mover| mover.is_some()),
            surface_speed: bodies.roles.surface_speed(contact.colliders).unwrap_or(0.0),
            softness: if joints.connects(contact.slots) { SOFTNESS / mass_ratio } else { 0.0 },
            thickness: contact.thickness.into(),
            first_row,
            points,
            rolling_moment: arm.map(|_| contact.rolling_moment.into()),
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
        let (of_points, of_spin) = rows[self.first_row..][..self.row_count()].as_chunks_mut::<2>();
        if let (Some(row), Some(moment)) = (of_spin.first_mut(), self.rolling_moment) {
            let inverse_inertias = [constraint.inverse_inertia_a, constraint.inverse_inertia_b];
            self.fill_spin(row, moment, inverse_inertias, sides, phase);
        }
        for (index, rows) in of_points.iter_mut().enumerate() {
            let point = &constraint.points[index];
            let separation = constraint.separation(point, sides[0], sides[1]);
            let bias = match phase {
                _ if separation < 0.0 && is_tangled => 0.0,
                Phase::Push => bias(separation, substep_rate),
                // It bore in the last substep, and its bodies have parted a little since: the push closes that.
                Phase::Relax if point.normal_impulse > 0.0 => 0.0,
                Phase::Relax => gap_bias(separation, substep_rate),
            };
            self.fill_point(rows, &constraint, index, sides, phase);
            rows[0].carried = rows[0].bias;
            rows[1].carried = rows[1].bias;
            rows[0].bias += f64::from(bias);
            if is_pending[index] {
                // It is not to touch yet. With no Jacobian any positive speed says that it parts.
                (rows[0].jacobian, rows[0].bias, rows[0].carried) = ([[0.0; 3]; 2], 1.0, 0.0);
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
        let anchors = [point.anchor_a.to_vec2(), point.anchor_b.to_vec2()];
        let inverse_inertias = [constraint.inverse_inertia_a, constraint.inverse_inertia_b];
        let normal = constraint.normal.to_vec2();
        let impulses = [point.normal_impulse, friction.impulse];
        let share = share_of(phase);
        rows[0].kind = Kind::Normal { most: f64::from(LARGEST_SPEED_CHANGE / point.normal_k) };
        if let Kind::Friction { friction, .. } = &mut rows[1].kind {
            *friction = f64::from(constraint.friction);
        }
        [rows[0].k, rows[1].k] = [f64::from(point.normal_k), f64::from(friction.mass).recip()];
        for row in &mut *rows {
            row.softness = self.softness(row.k);
        }
        [rows[0].bias, rows[1].bias] = [0.0, f64::from(self.surface_speed)];
        for ((row, axis), impulse) in rows.iter_mut().zip([normal, normal.perp()]).zip(impulses) {
            row.impulse = share * f64::from(impulse);
            let along = [axis.x, axis.y].map(f64::from);
            let turns = anchors.map(|anchor| f64::from(anchor.cross(axis)));
            self.aim(row, turns.map(|turn| [along[0], along[1], turn]), inverse_inertias, sides);
        }
    }

    /// Fills the row of the spin of b against a.
    fn fill_spin(
        &self,
        row: &mut Row,
        moment: f64,
        inverse_inertias: [f32; 2],
        sides: [&BodyState; 2],
        phase: Phase,
    ) {
        row.impulse = share_of(phase) * moment;
        row.k = f64::from(inverse_inertias[0] + inverse_inertias[1]);
        row.softness = self.softness(row.k);
        row.bias = 0.0;
        self.aim(row, [[0.0, 0.0, 1.0]; 2], inverse_inertias, sides);
        row.carried = row.bias;
    }

    /// Has the velocity of a row grow with how b moves against a, by these shares of the velocities of each.
    fn aim(&self, row: &mut Row, shares: [Triple; 2], inverse_inertias: [f32; 2], sides: [&BodyState; 2]) {
        for side in 0..2 {
            let sign = if side == 0 { -1.0 } else { 1.0 };
            row.jacobian[side] = shares[side].map(|share| sign * share);
            if !self.moves[side] {
                // A kinematic body moves as it does.
                let BodyState { velocity, angular_velocity, .. } = sides[side];
                let moves = [velocity.x, velocity.y, *angular_velocity].map(f64::from);
                row.bias += row.jacobian[side].iter().zip(&moves).map(|(entry, v)| entry * v).sum::<f64>();
                row.jacobian[side] = [0.0; 3];
            } else if inverse_inertias[side] == 0.0 {
                // Nothing turns it.
                row.jacobian[side][2] = 0.0;
            }
        }
    }

    /// The greatest k λ of its points under the whole load, by the impulses of the push, over the width of the thinner body, 1/s.
    pub(super) fn speed_over_width(&self, rows: &[Row]) -> f64 {
        let normals = (0..self.points).map(|point| &rows[self.first_row + 2 * point]);
        let greatest = normals.map(|row| row.k * row.impulse).fold(0.0, f64::max);
        greatest / share_of(Phase::Push) / self.thickness
    }

    /// By how much a row yields to what it bears, whose speed grows by `k` with a unit of impulse, 1/kg.
    fn softness(&self, k: f64) -> f64 {
        self.softness * k
    }

    /// Gives the contact the impulses that were found.
    pub(super) fn write_back(&mut self, rows: &[Row], graph: &mut ConstraintGraph) {
        let (of_points, of_spin) = rows[self.first_row..][..self.row_count()].as_chunks::<2>();
        for (point, rows) in of_points.iter().enumerate() {
            graph.set_impulses(self.home, point, [rows[0].impulse as f32, rows[1].impulse as f32]);
        }
        self.rolling_moment = of_spin.first().map(|row| row.impulse);
        if let Some(moment) = self.rolling_moment {
            graph.set_rolling_moment(self.home, moment as f32);
        }
    }

    fn row_count(&self) -> usize {
        2 * self.points + usize::from(self.rolling_moment.is_some())
    }
}

/// Half the forces have acted before the move, all of them after it.
fn share_of(phase: Phase) -> f64 {
    if phase == Phase::Push { 0.5 } else { 1.0 }
}
