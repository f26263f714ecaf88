//! Two bodies at the time when they meet, and the impulses of their collision: of an impact, which gives a part of the
//! approach speed back, and of a seam, which gives none.

use crate::compute::BodyState;
use crate::resolution::block::{Row, solve_pair};
use crate::resolution::constraint::ContactConstraint;

/// Two bodies have met, and two points meet together, within this share of the way that the approach makes in a
/// substep, no unit: a box that lands flat is not to be tipped over by a rounding error.
const TOLERANCE: f32 = 1e-3;

/// Two bodies that approach each other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting {
    /// Normal, anchors and masses of that time.
    constraint: ContactConstraint<f32>,
    /// Per point, its approach speed u (negative), m/s, if it takes part.
    speeds: [Option<f32>; 2],
    /// Smallest gap of a point that approaches, m.
    pub(super) gap: f32,
    /// Greatest speed of approach, m/s, positive.
    pub(super) speed: f32,
    /// Gaps that differ by no more than this are closed together, m.
    tolerance: f32,
}

impl Meeting {
    /// Of a contact with its bodies in the states of that time. The `gaps` are those of its points, m, infinite for one that
    /// is not there; their speeds have `gained`, m/s, since the middle of the substep of length `h`, s. `None` if no point
    /// approaches faster than the `threshold`, m/s.
    pub(super) fn new(
        constraint: ContactConstraint<f32>,
        gaps: [f32; 2],
        [a, b]: &[BodyState; 2],
        gained: f32,
        threshold: f32,
        h: f32,
    ) -> Option<Self> {
        let speeds = [0, 1].map(|index| {
            let velocity = constraint.points[index].relative_velocity(a, b);
            let speed = constraint.normal.dot(velocity) + gained;
            (gaps[index].is_finite() && speed < -threshold).then_some(speed)
        });
        let closed = |index: usize| speeds[index].map_or(f32::INFINITY, |_| gaps[index]);
        let gap = closed(0).min(closed(1));
        let speed = -speeds.into_iter().flatten().fold(0.0, f32::min);
        let tolerance = TOLERANCE * speed * h;
        let speeds = [0, 1].map(|index| speeds[index].filter(|_| gaps[index] <= gap + tolerance));
        (speed > 0.0).then_some(Self { constraint, speeds, gap, speed, tolerance })
    }

    /// Whether they have met.
    pub(super) fn is_now(&self) -> bool {
        self.gap <= self.tolerance
    }

    /// Turns the approach speed u of each point that takes part into -e u, with the restitution e.
    pub(super) fn collide(&self, restitution: f32, pair: &mut [BodyState; 2]) {
        let constraint = &self.constraint;
        let [point_1, point_2] = &constraint.points;
        // The change asked for, u - (-e u), is q of the complementarity problem K x + q ≥ 0.
        let change = self.speeds.map(|speed| speed.map(|u| (1.0 + restitution) * u));
        let impulses = match change {
            [Some(q_1), Some(q_2)] => {
                let row = |own| Row { own, other: constraint.coupling, scale: 1.0 };
                solve_pair([row(point_1.normal_k), row(point_2.normal_k)], [q_1, q_2])
            }
            _ => [
                change[0].map_or(0.0, |q| (-q / point_1.normal_k).max(0.0)),
                change[1].map_or(0.0, |q| (-q / point_2.normal_k).max(0.0)),
            ],
        };
        constraint.apply_collision_impulses(impulses, pair);
    }
}
