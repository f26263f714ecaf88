//! A contact point of the direct solve: its rows of the Jacobian, and how it answers velocities.

use crate::body::NONE;
use crate::compute::BodyState;
use crate::math::Vec2;
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::constraint_graph::GraphIndex;
use crate::resolution::direct::Aim;
use crate::resolution::direct::skyline::Skyline;
use crate::resolution::softness::{bias, gap_bias};

/// Velocities that a point wants are found to this much, m/s.
pub(super) const TOLERANCE: f64 = 1e-5;

/// A gap below this share of the way from the centre of what moves to the point is rounding, no unit: the point would
/// be sent to and fro to close it.
const SMALLEST_GAP: f32 = 1e-6;

/// Points that may approach by less than this are held in the first Newton step, m/s.
const HELD: f64 = 0.1;

/// A contact point with what it does to its two bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct DirectPoint {
    pub(super) home: GraphIndex,
    /// Which of the points of its contact it is.
    pub(super) index: usize,
    /// Indices of the movers, `NONE` for what contacts do not move.
    pub(super) movers: [u32; 2],
    /// Rows of the Jacobian: what vn and vt are of the velocities of a, then of b.
    normal: [[f64; 3]; 2],
    tangent: [[f64; 3]; 2],
    /// Part of vn and vt that the solve does not change: of kinematic bodies, and the bias in vn.
    bias: [f64; 2],
    /// Velocity that a unit of impulse gives the point by itself, 1/kg.
    inverse_mass: [f64; 2],
    /// Impulse per velocity that the point yields by, kg, along the normal and along the tangent.
    stiffness: [f64; 2],
    pub(super) friction: f64,
    /// What it yields to is the change from these impulses, N s, along the normal and along the tangent.
    pub(super) previous: [f64; 2],
    /// N s, along the normal and along the tangent.
    pub(super) impulse: [f64; 2],
    /// The impulses that were found last.
    found: [f64; 2],
    /// Greatest impulse of friction in this Newton step, N s.
    pub(super) limit: f64,
}

impl DirectPoint {
    pub(super) fn new(home: GraphIndex, index: usize, movers: [u32; 2]) -> Self {
        Self {
            home,
            index,
            movers,
            normal: Default::default(),
            tangent: Default::default(),
            bias: [0.0; 2],
            inverse_mass: [1.0; 2],
            stiffness: [1.0; 2],
            friction: 0.0,
            previous: [0.0; 2],
            found: [0.0; 2],
            impulse: [0.0; 2],
            limit: 0.0,
        }
    }

    /// Takes geometry and bias over from the constraint.
    pub(super) fn take_up(
        &mut self,
        constraint: &ContactConstraint<f32>,
        [a, b]: [&BodyState; 2],
        aim: Aim,
        per_substep: f32,
    ) {
        let (point, friction) = (&constraint.points[self.index], &constraint.frictions[self.index]);
        let separation = constraint.separation(point, a, b);
        let anchors = [Vec2::from(point.anchor_a), Vec2::from(point.anchor_b)];
        let moved = (0..2).filter(|&side| self.movers[side] != NONE);
        let reach = moved.map(|side| anchors[side].length()).fold(0.0, f32::max);
        let bias = match aim {
            _ if (0.0..SMALLEST_GAP * reach).contains(&separation) => 0.0,
            Aim::Push => bias(separation, per_substep),
            Aim::Relax => gap_bias(separation, per_substep),
        };
        let normal = Vec2::from(constraint.normal);
        let row = |side: usize, axis: Vec2| {
            let sign = if side == 0 { -1.0 } else { 1.0 };
            [axis.x, axis.y, anchors[side].cross(axis)].map(|entry| sign * f64::from(entry))
        };
        self.normal = [0, 1].map(|side| row(side, normal));
        self.tangent = [0, 1].map(|side| row(side, normal.perp()));
        self.bias = [f64::from(bias), 0.0];
        let inverse_inertias = [constraint.inverse_inertia_a, constraint.inverse_inertia_b];
        for (side, state) in [a, b].into_iter().enumerate() {
            if self.movers[side] == NONE {
                let velocity = [state.velocity.x, state.velocity.y, state.angular_velocity].map(f64::from);
                self.bias[0] += dot(&self.normal[side], &velocity);
                self.bias[1] += dot(&self.tangent[side], &velocity);
            } else if inverse_inertias[side] == 0.0 {
                // Nothing turns it.
                self.normal[side][2] = 0.0;
                self.tangent[side][2] = 0.0;
            }
        }
        self.inverse_mass = [f64::from(point.normal_k), f64::from(friction.mass).recip()];
        self.friction = f64::from(constraint.friction);
        self.impulse = [point.normal_impulse, friction.impulse].map(f64::from);
    }

    /// A pending point parts, whatever the velocities.
    pub(super) fn leave_alone(&mut self) {
        self.normal = Default::default();
        self.bias[0] = 1.0;
    }

    /// Begins to look for impulses, from those of now.
    pub(super) fn begin(&mut self) {
        self.found = self.impulse;
        self.limit = self.friction * self.impulse[0];
    }

    /// Whether it has no impulses.
    pub(super) fn is_unloaded(&self) -> bool {
        self.impulse == [0.0; 2]
    }

    /// Lets the point give back this share of a change of its impulses from those of now.
    pub(super) fn yield_by(&mut self, compliance: f64) {
        self.stiffness = self.inverse_mass.map(|k| 1.0 / (compliance * k));
        self.previous = self.impulse;
    }

    /// Keeps the impulses of now, or goes back to those found before.
    pub(super) fn settle(&mut self, is_solved: bool) {
        if is_solved {
            self.found = self.impulse;
        } else {
            self.impulse = self.found;
        }
    }

    /// Gives the point by itself the velocities that it wants, as a sweep does.
    pub(super) fn sweep(&mut self, velocities: &mut [f64], masses: impl Fn(usize) -> [f64; 3]) {
        let before = self.impulse;
        let [approach, slip] = self.approach_and_slip(velocities);
        self.impulse[0] = (before[0] - approach / self.inverse_mass[0]).max(0.0);
        self.limit = self.friction * self.impulse[0];
        self.impulse[1] = (before[1] - slip / self.inverse_mass[1]).clamp(-self.limit, self.limit);
        self.apply([0, 1].map(|axis| self.impulse[axis] - before[axis]), velocities, masses);
    }

    /// Sum over both sides of the row times the velocities.
    fn along(&self, row: &[[f64; 3]; 2], velocities: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (row, &mover) in row.iter().zip(&self.movers) {
            if mover != NONE {
                sum += dot(row, &velocities[3 * mover as usize..][..3]);
            }
        }
        sum
    }

    /// vn + bias and vt, m/s: the first is negative where the point approaches.
    fn approach_and_slip(&self, velocities: &[f64]) -> [f64; 2] {
        [
            self.along(&self.normal, velocities) + self.bias[0],
            self.along(&self.tangent, velocities) + self.bias[1],
        ]
    }

    /// The impulses that the point answers an approach and a slip with.
    fn answer(&self, approach: f64, slip: f64) -> [f64; 2] {
        [
            (self.previous[0] - approach * self.stiffness[0]).max(0.0),
            (self.previous[1] - slip * self.stiffness[1]).clamp(-self.limit, self.limit),
        ]
    }

    /// Whether these velocities, which its impulses have brought about, are what the point wants, to the tolerance.
    pub(super) fn is_complementary(&self, velocities: &[f64]) -> bool {
        let [approach, slip] = self.approach_and_slip(velocities);
        let [k, tangent_k] = self.inverse_mass;
        let [normal, tangent] = self.impulse;
        let wanted = (normal - approach / k).max(0.0);
        let wanted_tangent = (tangent - slip / tangent_k).clamp(-self.limit, self.limit);
        k * (wanted - normal).abs() <= TOLERANCE && tangent_k * (wanted_tangent - tangent).abs() <= TOLERANCE
    }

    /// Takes up the impulses that the point answers these velocities with.
    pub(super) fn respond(&mut self, velocities: &[f64]) {
        let [approach, slip] = self.approach_and_slip(velocities);
        self.impulse = self.answer(approach, slip);
    }

    /// The normal impulse after a step in which the point is held.
    pub(super) fn held_impulse(&self, velocities: &[f64], step: &[f64]) -> f64 {
        let [approach, gain, ..] = self.way(velocities, step);
        (self.previous[0] - (approach + gain) * self.stiffness[0]).max(0.0)
    }

    /// Approach and slip, each with what the step adds.
    pub(super) fn way(&self, velocities: &[f64], step: &[f64]) -> [f64; 4] {
        let [approach, slip] = self.approach_and_slip(velocities);
        [approach, self.along(&self.normal, step), slip, self.along(&self.tangent, step)]
    }

    /// The slope of p + f along a way, at a part of it, and how fast that grows.
    pub(super) fn slope(&self, &[approach, gain, slip, slip_gain]: &[f64; 4], part: f64) -> [f64; 2] {
        let [normal, tangent] = self.answer(approach + part * gain, slip + part * slip_gain);
        let yields = normal > 0.0;
        let sticks = tangent.abs() < self.limit;
        let growth = |responds: bool, gain: f64, stiffness: f64| {
            if responds { gain * gain * stiffness } else { 0.0 }
        };
        [
            -(normal * gain + tangent * slip_gain),
            growth(yields, gain, self.stiffness[0]) + growth(sticks, slip_gain, self.stiffness[1]),
        ]
    }

    /// Adds Jᵀ λ to three numbers for each mover.
    pub(super) fn push(&self, to: &mut [f64]) {
        self.apply(self.impulse, to, |_| [1.0; 3]);
    }

    /// Adds M⁻¹ Jᵀ λ to the velocities, for the impulses λ.
    pub(super) fn apply(
        &self,
        [normal, tangent]: [f64; 2],
        velocities: &mut [f64],
        masses: impl Fn(usize) -> [f64; 3],
    ) {
        for (side, &mover) in self.movers.iter().enumerate() {
            if mover == NONE {
                continue;
            }
            let masses = masses(mover as usize);
            for axis in 0..3 {
                let impulse = self.normal[side][axis] * normal + self.tangent[side][axis] * tangent;
                velocities[3 * mover as usize + axis] += impulse / masses[axis];
            }
        }
    }

    /// Adds Jᵀ J/c of what responds to a change of velocity.
    pub(super) fn stiffen(&self, matrix: &mut Skyline, first: u32, holds: bool) {
        let is_held = holds && self.bias[0] < HELD;
        let presses = is_held || self.impulse[0] > 0.0;
        let sticks = is_held || self.impulse[1].abs() < self.limit;
        for (responds, row, stiffness) in
            [(presses, &self.normal, self.stiffness[0]), (sticks, &self.tangent, self.stiffness[1])]
        {
            if !responds {
                continue;
            }
            for (side, &mover) in self.movers.iter().enumerate() {
                for (other_side, &other) in self.movers.iter().enumerate() {
                    if mover == NONE || other == NONE || other > mover {
                        continue;
                    }
                    let (place, other_place) = (3 * (mover - first) as usize, 3 * (other - first) as usize);
                    for (axis, value) in row[side].iter().enumerate() {
                        for (other_axis, other_value) in row[other_side].iter().enumerate() {
                            if other_place + other_axis <= place + axis {
                                let entry = value * other_value * stiffness;
                                matrix.add(place + axis, other_place + other_axis, entry);
                            }
                        }
                    }
                }
            }
        }
    }
}

fn dot(row: &[f64; 3], velocity: &[f64]) -> f64 {
    row.iter().zip(velocity).map(|(entry, velocity)| entry * velocity).sum()
}
