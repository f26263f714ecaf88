//! Where a joint is, and its coordinates: what a row measures, and by which forces it acts.
//!
//! All in `f64`: a joint is solved by itself, not in lanes, and long chains with heavy ends need the digits.

use crate::compute::BodyState;
use crate::math::{atan2_f64, sin_cos_of_small};

/// A vector, m.
pub(super) type V2 = [f64; 2];
/// Along x, along y, and turning: a velocity (m/s, rad/s), or the impulse of a row per unit.
pub(super) type V3 = [f64; 3];

pub(super) const TURN: f64 = core::f64::consts::TAU;

#[inline(always)]
pub(super) fn add(a: V2, b: V2) -> V2 {
    [a[0] + b[0], a[1] + b[1]]
}

#[inline(always)]
pub(super) fn sub(a: V2, b: V2) -> V2 {
    [a[0] - b[0], a[1] - b[1]]
}

#[inline(always)]
pub(super) fn dot(a: V2, b: V2) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[inline(always)]
pub(super) fn cross(a: V2, b: V2) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

#[inline(always)]
pub(super) fn perp(a: V2) -> V2 {
    [-a[1], a[0]]
}

#[inline(always)]
pub(super) fn length(a: V2) -> f64 {
    dot(a, a).sqrt()
}

/// The direction of `a`, of length 1; that from a place to itself is none.
#[inline(always)]
fn direction(a: V2) -> Option<V2> {
    let length = length(a);
    (length > 0.0).then(|| [a[0] / length, a[1] / length])
}

/// `v` turned by the rotation (cos, sin).
#[inline(always)]
pub(super) fn rotate(q: V2, v: V2) -> V2 {
    [q[0] * v[0] - q[1] * v[1], q[1] * v[0] + q[0] * v[1]]
}

/// (cos, sin) of an angle, rad: of a small one by its series, of a greater one by doubling that of a part.
pub(super) fn rotation(angle: f64) -> V2 {
    let (mut part, mut doublings) = (angle, 0);
    while part.abs() > core::f64::consts::FRAC_PI_4 && doublings < 40 {
        part *= 0.5;
        doublings += 1;
    }
    let (sin, cos) = sin_cos_of_small(part);
    let mut q = [cos, sin];
    for _ in 0..doublings {
        q = rotate(q, q);
    }
    q
}

/// A body of a joint: its velocity, and how far it has moved since the step began.
#[derive(Clone, Copy, Debug)]
pub(super) struct JointBody {
    /// Its row among the states.
    pub(super) row: u32,
    /// Which island it is of, if its joints move it.
    pub(super) island: u32,
    pub(super) inverse_mass: f64,
    pub(super) inverse_inertia: f64,
    /// How stiffly what its joints bear pulls it back, N/m, and turns it back, N m/rad.
    pub(super) stiffness: [f64; 2],
    pub(super) velocity: V3,
    /// What strikes within this substep have moved it by, over the length of the substep, m/s and rad/s: what its velocity, which it has
    /// only since then, misses of the mean velocity of the whole.
    pub(super) missed: V3,
    /// Scratch: a velocity to go back to, or to compare with.
    pub(super) kept: V3,
    pub(super) shift: V2,
    /// (cos, sin).
    pub(super) turn: V2,
    /// The same as an angle of any number of turns, rad.
    pub(super) angle: f64,
    /// Scratch: the velocity before gaps were closed.
    pub(super) unclosed: V3,
    /// What of the velocity only closes gaps, and ends with the move.
    pub(super) closing: V3,
    /// By how much it is faster at the end of a substep than on average over it: where that is made of several steps, or gaps close.
    pub(super) ahead: V3,
    /// By forces, and by what its contacts bear, m/s² and rad/s².
    pub(super) acceleration: V3,
    /// How many joints keep a point of it where it is, as pins do, and how far from its centre the last of them does, m.
    pub(super) held: u32,
    pub(super) arm: f64,
}

impl JointBody {
    /// Velocity from an impulse of `amount` along `j`.
    #[inline(always)]
    pub(super) fn push(&mut self, j: V3, amount: f64) {
        self.velocity[0] += self.inverse_mass * j[0] * amount;
        self.velocity[1] += self.inverse_mass * j[1] * amount;
        self.velocity[2] += self.inverse_inertia * j[2] * amount;
    }

    /// How fast it swings by what its joints bear, rad/s: a link under tension at ω = √(Σ r · f / I), as fast as it is light.
    /// (M. Tournier et al., "Stable Constrained Dynamics", 2015, on geometric stiffness.)
    ///
    /// What hangs by one joint swings about it, with the inertia I + m r².
    pub(super) fn swing(&self) -> f64 {
        let arm = if self.held == 1 { self.arm } else { 0.0 };
        // 1/(I + m r²)
        let about = self.inverse_mass + self.inverse_inertia * arm * arm;
        let inverse = if about > 0.0 { self.inverse_inertia * self.inverse_mass / about } else { 0.0 };
        // Where two neighbours go to opposite sides, each has twice the stiffness.
        let [pull, turn] = self.stiffness;
        (turn * inverse).max(2.0 * pull * self.inverse_mass).max(0.0).sqrt()
    }

    /// Lets forces act for a time, s.
    #[inline(always)]
    pub(super) fn accelerate(&mut self, time: f64) {
        for (velocity, acceleration) in self.velocity.iter_mut().zip(self.acceleration) {
            *velocity += time * acceleration;
        }
    }

    /// What an impulse along `k` does to the speed along `j`.
    #[inline(always)]
    pub(super) fn coupling(&self, j: V3, k: V3) -> f64 {
        self.inverse_mass * (j[0] * k[0] + j[1] * k[1]) + self.inverse_inertia * j[2] * k[2]
    }

    /// By how much its velocity has changed from that which was kept, m/s and rad/s.
    pub(super) fn change(&self) -> V3 {
        [0, 1, 2].map(|index| self.velocity[index] - self.kept[index])
    }

    /// How fast it goes on average in this substep, m/s and rad/s.
    pub(super) fn mean_velocity(&self) -> V3 {
        [0, 1, 2].map(|index| self.velocity[index] + self.missed[index])
    }

    /// Where it will be after a drift of `h`, s.
    pub(super) fn after(&self, h: f64) -> Self {
        let [x, y, w] = self.mean_velocity();
        Self {
            shift: add(self.shift, [h * x, h * y]),
            turn: rotate(rotation(h * w), self.turn),
            angle: self.angle + h * w,
            ..*self
        }
    }

    /// Reads how fast it is.
    pub(super) fn read_velocity(&mut self, state: &BodyState) {
        self.velocity = [state.velocity.x, state.velocity.y, state.angular_velocity].map(f64::from);
    }

    /// Reads where it is. Of all that its angle may be by its rotation, it is the one nearest to `near`.
    pub(super) fn read_place(&mut self, state: &BodyState, near: f64) {
        self.shift = [state.delta_position.x, state.delta_position.y].map(f64::from);
        self.turn = [state.delta_rotation.c, state.delta_rotation.s].map(f64::from);
        self.angle = nearest(atan2_f64(self.turn[1], self.turn[0]), near);
    }

    /// Whether it is where it was read last.
    pub(super) fn is_where(&self, state: &BodyState) -> bool {
        let (moved, turned) = (state.delta_position, state.delta_rotation);
        [moved.x, moved.y].map(f64::from) == self.shift && [turned.c, turned.s].map(f64::from) == self.turn
    }

    /// Reads by how much strikes have moved it since its place was read, in a substep of length `h`, s.
    pub(super) fn read_missed(&mut self, state: &BodyState, h: f64) {
        self.missed = [0.0; 3];
        if !self.is_where(state) {
            let mut there = *self;
            there.read_place(state, self.angle);
            let [x, y] = [0, 1].map(|axis| there.shift[axis] - self.shift[axis]);
            self.missed = [x, y, there.angle - self.angle].map(|moved| moved / h);
        }
    }

    /// Its energy with this velocity, J.
    pub(super) fn energy_of(&self, [x, y, w]: V3) -> f64 {
        let half_of = |inverse: f64| if inverse > 0.0 { 0.5 / inverse } else { 0.0 };
        half_of(self.inverse_mass) * (x * x + y * y) + half_of(self.inverse_inertia) * w * w
    }

    /// How fast its points are with this velocity, m/s: of those at the radius of gyration the fastest, more or less.
    pub(super) fn pace_of(&self, [x, y, w]: V3) -> f64 {
        let gyration =
            if self.inverse_inertia > 0.0 { self.inverse_mass / self.inverse_inertia } else { 0.0 };
        (x * x + y * y + w * w * gyration).sqrt()
    }
}

/// Of the angles that are `angle` but for whole turns, the one nearest to `near`, rad; `angle` itself where that is not finite, as of a world
/// beyond all bounds.
pub(super) fn nearest(angle: f64, near: f64) -> f64 {
    let turns = ((near - angle) / TURN).round();
    if turns.is_finite() { angle + TURN * turns } else { angle }
}

/// What a joint is like when the step begins.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Base {
    /// From the anchor on a to the one on b, m.
    pub(super) gap: V2,
    /// From the centres to the anchors, m.
    pub(super) r_a: V2,
    pub(super) r_b: V2,
    pub(super) axis: V2,
    /// From the wheels of a pulley to the anchors on a and b, m; 0 of other kinds.
    pub(super) ropes: [V2; 2],
    /// Angles of a and b since the joint was added, rad, each of any number of turns.
    pub(super) angles: V2,
}

/// What it is like now, or will be.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Geometry {
    gap: V2,
    r_a: V2,
    r_b: V2,
    axis: V2,
    ropes: [V2; 2],
    angles: V2,
}

impl Base {
    /// The geometry where its bodies are.
    pub(super) fn at(&self, a: &JointBody, b: &JointBody) -> Geometry {
        let (r_a, r_b) = (rotate(a.turn, self.r_a), rotate(b.turn, self.r_b));
        let (moved_a, moved_b) = (add(a.shift, sub(r_a, self.r_a)), add(b.shift, sub(r_b, self.r_b)));
        Geometry {
            gap: add(self.gap, sub(moved_b, moved_a)),
            r_a,
            r_b,
            axis: rotate(a.turn, self.axis),
            ropes: [add(self.ropes[0], moved_a), add(self.ropes[1], moved_b)],
            angles: [self.angles[0] + a.angle, self.angles[1] + b.angle],
        }
    }
}

/// An anchor that passes the wheel of its rope at the distance d, with the speed v, turns about it at v/d. Steps are as short as for a body that swings
/// so many times as fast, no unit: it goes a quarter of d in a step at most. With 1 it may gain a sixth of its energy.
const FLY_BY: f64 = 4.0;

/// What a row measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Coordinate {
    /// The gap along x, or y, of the world, of two anchors that may be apart.
    X,
    Y,
    /// The same of two anchors that are to be in one place.
    PinX,
    PinY,
    /// The gap along the axis, or across it.
    Along,
    Across,
    /// The distance of the anchors.
    Distance,
    /// The angle of b from a.
    Angle,
    /// The angle of a and a ratio times that of b.
    Gear(f64),
    /// The distance of the anchor on a from its wheel, and a ratio times that of the one on b from its own.
    Pulley(f64),
}

impl Coordinate {
    /// Whether it is an angle, and not a length.
    pub(super) fn is_angle(self) -> bool {
        matches!(self, Self::Angle | Self::Gear(_))
    }

    /// What it is, m or rad.
    pub(super) fn value(self, at: &Geometry) -> f64 {
        match self {
            Self::X | Self::PinX => at.gap[0],
            Self::Y | Self::PinY => at.gap[1],
            Self::Along => dot(at.axis, at.gap),
            Self::Across => cross(at.axis, at.gap),
            Self::Distance => length(at.gap),
            Self::Angle => at.angles[1] - at.angles[0],
            Self::Gear(ratio) => at.angles[0] + ratio * at.angles[1],
            Self::Pulley(ratio) => length(at.ropes[0]) + ratio * length(at.ropes[1]),
        }
    }

    /// The size of the joint as it measures that, m: what its lengths are rounded by goes with it. 1 for angles.
    pub(super) fn size(self, base: &Base) -> f64 {
        let Base { gap, r_a, r_b, ropes, .. } = base;
        match self {
            Self::Angle | Self::Gear(_) => 1.0,
            Self::Pulley(ratio) => {
                length(*r_a) + length(ropes[0]) + ratio * (length(*r_b) + length(ropes[1]))
            }
            _ => length(*r_a) + length(*r_b) + length(*gap),
        }
    }

    /// How many times as fast as this changes one of its bodies may be, no unit.
    pub(super) fn leverage(self) -> f64 {
        match self {
            Self::Gear(ratio) | Self::Pulley(ratio) => ratio.abs().recip().max(1.0),
            _ => 1.0,
        }
    }

    /// How far its anchors are from the centres of a and b, m, if it is not an angle: by these they swing.
    pub(super) fn arms(self, at: &Geometry) -> Option<[f64; 2]> {
        (!self.is_angle()).then(|| [length(at.r_a), length(at.r_b)])
    }

    /// How stiffly the bodies a and b are pulled back, N/m, and turned back, N m/rad, by a `load` on it, N.
    ///
    /// A force f at an arm r turns a body back with r · f. A rod under the tension T, of the length l, pulls what goes to the side
    /// back with T/l; and so do the two ends of the rope of a pulley, each with its own.
    pub(super) fn geometric_stiffness(self, at: &Geometry, load: f64) -> [[f64; 2]; 2] {
        if self.is_angle() {
            return [[0.0; 2]; 2];
        }
        // On each side how many times it pulls, and how long it is, m.
        let [rope_a, rope_b] = match self {
            Self::Distance => [[1.0, length(at.gap)]; 2],
            Self::Pulley(ratio) => [[1.0, length(at.ropes[0])], [ratio, length(at.ropes[1])]],
            _ => [[0.0; 2]; 2],
        };
        let side = |[x, y, _]: V3, r: V2, [times, length]: [f64; 2]| {
            let pull = if length > 0.0 { -load * times / length } else { 0.0 };
            [pull, dot(r, [load * x, load * y]) + pull * dot(r, r)]
        };
        let [j_a, j_b] = self.jacobian(at);
        [side(j_a, at.r_a, rope_a), side(j_b, at.r_b, rope_b)]
    }

    /// How fast bodies are to be taken to swing as their anchors fly by the wheels of a pulley, or up to them, rad/s; 0 of other kinds.
    pub(super) fn fly_by_rate(self, at: &Geometry, a: &JointBody, b: &JointBody) -> f64 {
        let Self::Pulley(_) = self else { return 0.0 };
        let rate = |[x, y, w]: V3, r: V2, rope: V2| {
            let [speed, length] = [length(add([x, y], [-w * r[1], w * r[0]])), length(rope)];
            if length > 0.0 { FLY_BY * speed / length } else { 0.0 }
        };
        rate(a.velocity, at.r_a, at.ropes[0]).max(rate(b.velocity, at.r_b, at.ropes[1]))
    }

    /// Its Jacobian: how fast it grows with the velocities of a and of b.
    pub(super) fn jacobian(self, at: &Geometry) -> [V3; 2] {
        // d/dt (u · gap) = u · (v_b + w_b × r_b - v_a - w_a × r_a)
        let between = |u: V2, r_a: V2, r_b: V2| [[-u[0], -u[1], -cross(r_a, u)], [u[0], u[1], cross(r_b, u)]];
        // Where u turns with a, r_a ends at the anchor of b.
        let of_a = |u: V2| between(u, add(at.r_a, at.gap), at.r_b);
        // Where u turns with both, both end in the middle. With a u that stays, bodies that turn as one would open a gap that is there:
        // a joint that others hold already would have a say by its gap of a micrometre, and bear a thousand times the load.
        let of_both = |u: V2| {
            let half = [0.5 * at.gap[0], 0.5 * at.gap[1]];
            between(u, add(at.r_a, half), sub(at.r_b, half))
        };
        match self {
            Self::X => between([1.0, 0.0], at.r_a, at.r_b),
            Self::Y => between([0.0, 1.0], at.r_a, at.r_b),
            Self::PinX => of_both([1.0, 0.0]),
            Self::PinY => of_both([0.0, 1.0]),
            Self::Along => of_a(at.axis),
            Self::Across => of_a(perp(at.axis)),
            // Two anchors in one place: any direction serves.
            Self::Distance => between(direction(at.gap).unwrap_or([0.0, 1.0]), at.r_a, at.r_b),
            Self::Angle => [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]],
            Self::Gear(ratio) => [[0.0, 0.0, 1.0], [0.0, 0.0, ratio]],
            // d/dt |d| = d/|d| · (v + w × r), where d is from a wheel that does not move to the anchor at r.
            Self::Pulley(ratio) => {
                let away = |times: f64, rope: V2, r: V2| {
                    // An anchor that is on its wheel is pulled no way.
                    let u = direction(rope).unwrap_or_default();
                    [times * u[0], times * u[1], times * cross(r, u)]
                };
                [away(1.0, at.ropes[0], at.r_a), away(ratio, at.ropes[1], at.r_b)]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Turns are counted as far as they are known.
    #[test]
    fn angles_stay_numbers() {
        assert_eq!(nearest(0.5, 100.0 * TURN + 0.25), 0.5 + TURN * 100.0);
        for near in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(nearest(0.5, near), 0.5);
        }
    }
}
