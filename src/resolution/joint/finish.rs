//! What is kept of a step: what the joints bore, how far they are off, and which broke.

use crate::compute::BodyState;
use crate::joint::{JointRecord, Joints};
use crate::math::Vec2;
use crate::resolution::joint::JointSolver;
use crate::resolution::joint::geometry::{Base, JointBody};
use crate::resolution::joint::row::{Phase, Role, Row};
use crate::resolution::scheme::Scheme;

impl JointSolver {
    /// Writes back what the joints bore, and how far they are off; finds those that broke.
    pub(in crate::resolution) fn finish(
        &mut self,
        scheme: &Scheme,
        joints: &mut Joints,
        states: &[BodyState],
    ) {
        if self.is_empty() {
            return;
        }
        for island in &self.islands {
            for &joint in &island.joints {
                joints.all[self.places[joint as usize].joint].state.pace = island.pace;
            }
        }
        self.read(states, if scheme.split_kick { Phase::Push } else { Phase::Relax });
        for (place, base) in self.places.iter().zip(&self.bases) {
            let record = &mut joints.all[place.joint];
            let rows = &self.rows[place.rows[0] as usize..place.rows[1] as usize];
            if finish_joint(record, base, rows, &self.bodies, f64::from(scheme.dt)) {
                self.broken.push(place.joint);
            }
        }
    }
}

/// Writes back what a joint bore in a step of `dt`, s; whether it was too much.
fn finish_joint(record: &mut JointRecord, base: &Base, rows: &[Row], bodies: &[JointBody], dt: f64) -> bool {
    let state = &mut record.state;
    let (mut force, mut torque) = ([0.0; 2], 0.0);
    (state.gap, state.angle_gap, state.force, state.torque) = (0.0, 0.0, Vec2::ZERO, 0.0);
    let Some(first) = rows.first() else { return false };
    let [a, b] = first.bodies.map(|body| &bodies[body as usize]);
    let at = base.at(a, b);
    for (row, load) in rows.iter().zip(&mut state.loads) {
        *load = row.load as f32;
        if !load.is_finite() {
            *load = 0.0;
        }
        // On average, as a blow may come in any of the substeps.
        let [x, y, moment] = row.in_step.map(|impulse| impulse / dt);
        if row.coordinate.is_angle() {
            torque += moment;
        } else {
            force = [force[0] + x, force[1] + y];
        }
        let x = row.value(&at);
        let gap = match row.role {
            Role::Rigid => x.abs(),
            Role::Limits([lower, upper]) => (lower - x).max(x - upper).max(0.0),
            _ => 0.0,
        };
        let worst = if row.coordinate.is_angle() { &mut state.angle_gap } else { &mut state.gap };
        *worst = worst.max(gap as f32);
    }
    let finite = |x: f64| if x.is_nan() { 0.0 } else { (x as f32).clamp(f32::MIN, f32::MAX) };
    state.force = Vec2::new(finite(force[0]), finite(force[1]));
    state.torque = finite(torque);
    state.turned([a.angle, b.angle]);
    record.pass_teeth();
    record.bears_too_much()
}
