//! Impulses along one direction, at all points of a contact at once.
//!
//! A contact presses along its normal n and rubs along its tangent. With the lever arm l = r × n of a point about the
//! centre of a body, n·(w × r) = w l, and what the points have in common is found once:
//!
//! ```text
//! velocity     vn = n·(v_b - v_a) + w_b l_b - w_a l_a
//! impulses λ   v_b += Σλ n/m_b,  w_b += Σ(λ l_b)/I_b,  and the opposite for a
//! ```

use crate::compute::{BodyState, Lane, LaneVec2};
use crate::resolution::constraint::ContactConstraint;

/// A direction along which impulses act at the first `POINTS` points of a contact, with their lever arms about the centres
/// of the two bodies. `STILL` says that the bodies do not turn and cannot be turned: the terms of turning, all of them 0,
/// are left out.
pub(crate) struct Axis<L, const POINTS: usize, const STILL: bool> {
    direction: LaneVec2<L>,
    arms: [[L; 2]; POINTS],
}

impl<L: Lane, const POINTS: usize, const STILL: bool> Axis<L, POINTS, STILL> {
    #[inline(always)]
    pub(crate) fn new(constraint: &ContactConstraint<L>, direction: LaneVec2<L>) -> Self {
        let mut arms = [[L::splat(0.0); 2]; POINTS];
        for (arms, point) in arms.iter_mut().zip(&constraint.points) {
            *arms = point.moments(direction);
        }
        Self { direction, arms }
    }

    /// Velocity of b against a at each point, along the direction, m/s.
    #[inline(always)]
    pub(crate) fn speeds(&self, a: &BodyState<L>, b: &BodyState<L>) -> [L; POINTS] {
        let mut speeds = [self.direction.dot(b.velocity - a.velocity); POINTS];
        if !STILL {
            for (speed, &[arm_a, arm_b]) in speeds.iter_mut().zip(&self.arms) {
                *speed = *speed + (arm_b * b.angular_velocity - arm_a * a.angular_velocity);
            }
        }
        speeds
    }

    /// One of these `speeds`, m/s, after `changes` of the impulses of the points before it, N s, which are still to be
    /// applied.
    #[inline(always)]
    pub(crate) fn speed_after(
        &self,
        index: usize,
        speeds: [L; POINTS],
        constraint: &ContactConstraint<L>,
        changes: [L; POINTS],
    ) -> L {
        if index == 0 {
            return speeds[0];
        }
        speeds[index] + constraint.response(self.arms[0], self.arms[index]) * changes[0]
    }

    /// Turns the bodies as impulses along the direction do, N s, that act on b and opposite on a.
    #[inline(always)]
    pub(crate) fn turn(
        &self,
        constraint: &ContactConstraint<L>,
        impulses: [L; POINTS],
        a: &mut BodyState<L>,
        b: &mut BodyState<L>,
    ) {
        if STILL {
            return;
        }
        let [arm_a, arm_b] = self.arms[0];
        let mut moments = [arm_a * impulses[0], arm_b * impulses[0]];
        // Not by `skip`: where much else is compiled with it that is a call, around which all lanes are saved.
        for (&[arm_a, arm_b], &impulse) in self.arms[1..].iter().zip(&impulses[1..]) {
            moments = [moments[0] + arm_a * impulse, moments[1] + arm_b * impulse];
        }
        constraint.turn(moments, a, b);
    }

    /// What these impulses are together, N s.
    #[inline(always)]
    pub(crate) fn sum(&self, impulses: [L; POINTS]) -> LaneVec2<L> {
        let mut sum = impulses[0];
        for &impulse in &impulses[1..] {
            sum = sum + impulse;
        }
        self.direction * sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::resolution::constraint::Action;

    fn contact() -> ContactConstraint<f32> {
        let mut contact = ContactConstraint {
            inverse_mass_a: 0.5,
            inverse_mass_b: 0.8,
            inverse_inertia_a: 2.0,
            inverse_inertia_b: 3.0,
            normal: LaneVec2 { x: 0.6, y: 0.8 },
            ..ContactConstraint::default()
        };
        let anchors = [[0.3, -0.4, -0.7, 0.2], [-0.5, 0.1, 0.6, 0.9]];
        for (point, [ax, ay, bx, by]) in contact.points.iter_mut().zip(anchors) {
            point.anchor_a = LaneVec2 { x: ax, y: ay };
            point.anchor_b = LaneVec2 { x: bx, y: by };
        }
        contact
    }

    fn states() -> [BodyState; 2] {
        [[1.5, -0.7, 0.9], [-0.3, 0.4, -1.1]].map(|[x, y, w]| BodyState {
            velocity: LaneVec2 { x, y },
            angular_velocity: w,
            ..BodyState::REST
        })
    }

    /// Numbers of order 1, a dozen roundings.
    fn assert_near(found: f32, expected: f32) {
        assert!((found - expected).abs() < 2e-6, "{found} instead of {expected}");
    }

    #[test]
    fn speeds_are_those_of_the_points() {
        let (contact, [a, b]) = (contact(), states());
        let axis = Axis::<_, 2, false>::new(&contact, contact.normal);
        for (speed, point) in axis.speeds(&a, &b).into_iter().zip(&contact.points) {
            assert_near(speed, contact.normal.dot(point.relative_velocity(&a, &b)));
        }
    }

    #[test]
    fn impulses_together_do_what_they_do_one_after_the_other() {
        let (contact, before, impulses) = (contact(), states(), [0.7, 0.4]);
        let axis = Axis::<_, 2, false>::new(&contact, contact.normal);
        let [mut a, mut b] = before;
        axis.turn(&contact, impulses, &mut a, &mut b);
        contact.push(axis.sum(impulses), &mut a, &mut b);

        let [mut slow_a, mut slow_b] = before;
        for (point, impulse) in contact.points.iter().zip(impulses) {
            contact.apply(Action::at(point, contact.normal * impulse), &mut slow_a, &mut slow_b);
        }
        for (fast, slow) in [(a, slow_a), (b, slow_b)] {
            assert_near(fast.velocity.x, slow.velocity.x);
            assert_near(fast.velocity.y, slow.velocity.y);
            assert_near(fast.angular_velocity, slow.angular_velocity);
        }
    }

    #[test]
    fn the_second_point_feels_the_impulse_of_the_first() {
        let (contact, [a, b], impulses) = (contact(), states(), [0.7, 0.0]);
        let axis = Axis::<_, 2, false>::new(&contact, contact.normal);
        let speeds = axis.speeds(&a, &b);
        let [mut after_a, mut after_b] = [a, b];
        axis.turn(&contact, impulses, &mut after_a, &mut after_b);
        contact.push(axis.sum(impulses), &mut after_a, &mut after_b);
        let after = axis.speeds(&after_a, &after_b);
        assert_near(axis.speed_after(1, speeds, &contact, impulses), after[1]);
        assert_near(axis.speed_after(0, speeds, &contact, impulses), speeds[0]);
    }
}
