//! What each kind of joint asks: its rows.

use core::f64::consts::TAU;

use crate::joint::{JointKind, JointRecord, Spring};
use crate::resolution::joint::geometry::Coordinate;
use crate::resolution::joint::geometry::Coordinate::{
    Across, Along, Angle, Distance, Gear, PinX, PinY, Pulley, X, Y,
};
use crate::resolution::joint::row::{Role, Row};

/// Inverse masses and moments of inertia that a joint moves: of both bodies together.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inverse {
    pub(super) mass: f64,
    pub(super) inertia: f64,
}

impl Inverse {
    /// A spring of a coordinate: its stiffness by the two masses on it, or moments of inertia.
    fn spring(self, coordinate: Coordinate, spring: Spring, rest: f64, max: Option<f32>) -> Option<Role> {
        let inverse = if coordinate.is_angle() { self.inertia } else { self.mass };
        let omega = TAU * f64::from(spring.hertz);
        let max = max.map_or(f64::INFINITY, f64::from);
        // What cannot move has no spring.
        (inverse > 0.0).then(|| Role::Spring {
            k: omega * omega / inverse,
            c: 2.0 * f64::from(spring.damping_ratio) * omega / inverse,
            rest,
            max,
        })
    }
}

/// Appends the rows of a joint, at most [`MOST_ROWS`](crate::joint::MOST_ROWS).
pub(super) fn rows_of(joint: &JointRecord, inverse: Inverse, rows: &mut Vec<Row>) {
    let kind = joint.description.kind;
    let rigid = |coordinate| held_at(coordinate, 0.0);
    match kind {
        JointKind::Revolute => {
            rows.extend([rigid(PinX), rigid(PinY)]);
            push_options(joint, Angle, inverse, rows);
        }
        JointKind::Prismatic => {
            rows.extend([rigid(Across), rigid(Angle)]);
            push_options(joint, Along, inverse, rows);
        }
        JointKind::Wheel => {
            rows.push(rigid(Across));
            push_spring(joint, Along, inverse, rows);
            push_limits(joint, Along, rows);
            push_motor(joint, Angle, rows);
        }
        JointKind::Distance => push_distance(joint, inverse, rows),
        JointKind::Weld => {
            for (soft, stiff) in [(X, PinX), (Y, PinY), (Angle, Angle)] {
                let spring = joint.description.spring;
                match spring.and_then(|spring| inverse.spring(soft, spring, 0.0, None)) {
                    Some(role) => rows.push(Row::new(soft, role)),
                    None => rows.push(rigid(stiff)),
                }
            }
        }
        JointKind::Motor | JointKind::Drag => push_drive(joint, inverse, rows),
        JointKind::Friction => {
            push_brakes(joint, rows);
        }
        JointKind::Gear => rows.push(held_at(Gear(joint.description.ratio), joint.length)),
        JointKind::Pulley => {
            let rope = Role::Limits([f64::NEG_INFINITY, joint.length]);
            rows.push(Row::new(Pulley(joint.description.ratio), rope));
        }
        JointKind::Ratchet => {
            rows.extend([rigid(PinX), rigid(PinY)]);
            push_spring(joint, Angle, inverse, rows);
            push_motor(joint, Angle, rows);
            rows.push(Row::new(Angle, Role::Limits([joint.state.tooth, f64::INFINITY])));
        }
    }
}

/// A row that holds a coordinate at a place, m or rad.
fn held_at(coordinate: Coordinate, place: f64) -> Row {
    Row { zero: place, ..Row::new(coordinate, Role::Rigid) }
}

fn push_options(joint: &JointRecord, coordinate: Coordinate, inverse: Inverse, rows: &mut Vec<Row>) {
    push_spring(joint, coordinate, inverse, rows);
    push_motor(joint, coordinate, rows);
    push_limits(joint, coordinate, rows);
}

fn push_spring(joint: &JointRecord, coordinate: Coordinate, inverse: Inverse, rows: &mut Vec<Row>) {
    let description = &joint.description;
    let spring =
        description.spring.and_then(|spring| inverse.spring(coordinate, spring, description.rest, None));
    rows.extend(spring.map(|role| Row::new(coordinate, role)));
}

fn push_motor(joint: &JointRecord, coordinate: Coordinate, rows: &mut Vec<Row>) {
    rows.extend(joint.description.motor.map(|motor| {
        let (speed, max) = (f64::from(motor.speed), f64::from(motor.max));
        Row::new(coordinate, Role::Speed { speed, max })
    }));
}

fn push_limits(joint: &JointRecord, coordinate: Coordinate, rows: &mut Vec<Row>) {
    rows.extend(joint.description.limits.map(|limits| match limits {
        [lower, upper] if lower == upper => held_at(coordinate, lower),
        _ => Row::new(coordinate, Role::Limits(limits)),
    }));
}

/// A rod, a spring at its length, or a rope.
fn push_distance(joint: &JointRecord, inverse: Inverse, rows: &mut Vec<Row>) {
    let description = &joint.description;
    if let Some(spring) = description.spring {
        let role = inverse.spring(Distance, spring, joint.length, None);
        rows.extend(role.map(|role| Row::new(Distance, role)));
    }
    push_motor(joint, Distance, rows);
    push_limits(joint, Distance, rows);
    if description.spring.is_none() && description.limits.is_none() && description.motor.is_none() {
        rows.push(held_at(Distance, joint.length));
    }
}

/// Springs of limited strength to a pose.
fn push_drive(joint: &JointRecord, inverse: Inverse, rows: &mut Vec<Row>) {
    let description = &joint.description;
    let Some(spring) = description.spring else { return };
    for coordinate in [X, Y] {
        if let Some(role) = inverse.spring(coordinate, spring, 0.0, description.max_force) {
            rows.push(Row { heads_pair: coordinate == X, ..Row::new(coordinate, role) });
        }
    }
    if description.kind == JointKind::Motor {
        let role = inverse.spring(Angle, spring, description.rest, description.max_torque);
        rows.extend(role.map(|role| Row::new(Angle, role)));
    }
}

/// Brakes of limited strength.
fn push_brakes(joint: &JointRecord, rows: &mut Vec<Row>) {
    let [max_force, max_torque] =
        [joint.description.max_force, joint.description.max_torque].map(|max| max.map_or(0.0, f64::from));
    let still = |max| Role::Speed { speed: 0.0, max };
    rows.push(Row { heads_pair: true, ..Row::new(X, still(max_force)) });
    rows.extend([Row::new(Y, still(max_force)), Row::new(Angle, still(max_torque))]);
}
