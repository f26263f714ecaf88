//! Two bodies at the time when they meet, and the impulses of their collision: of an impact, which gives a part of the
//! approach speed back, and of a seam, which gives none.

use crate::compute::{BodyState, LaneVec2};
use crate::math::Point;
use crate::resolution::block::{Row, solve_pair};
use crate::resolution::blows::Collision;
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
    /// Greatest speed of approach of any point, m/s, positive.
    pub(super) fastest: f32,
    /// Gaps that differ by no more than this are closed together, m.
    tolerance: f32,
}

impl Meeting {
    /// Of a contact with its bodies in the states of that time. The `gaps` are those of its points, m, if these are there;
    /// their speeds have `gained`, m/s, since the middle of the substep of length `h`, s. `None` if no point approaches
    /// faster than its of the `thresholds`, m/s.
    pub(super) fn new(
        constraint: ContactConstraint<f32>,
        gaps: [Option<f32>; 2],
        [a, b]: &[BodyState; 2],
        gained: [f32; 2],
        thresholds: [f32; 2],
        h: f32,
    ) -> Option<Self> {
        let approaches = [0, 1].map(|index| {
            let (gap, velocity) = (gaps[index]?, constraint.points[index].relative_velocity(a, b));
            let speed = constraint.normal.dot(velocity) + gained[index];
            (speed < -thresholds[index]).then_some((gap, speed))
        });
        let all = || approaches.into_iter().flatten();
        let gap = all().map(|(gap, _)| gap).reduce(f32::min)?;
        let fastest = -all().fold(0.0, |least: f32, (_, speed)| least.min(speed));
        let tolerance = TOLERANCE * fastest * h;
        // All that overlap have met.
        let takes_part = |(of_point, speed)| (of_point <= gap.max(0.0) + tolerance).then_some(speed);
        Some(Self {
            constraint,
            speeds: approaches.map(|point| point.and_then(takes_part)),
            gap,
            fastest,
            tolerance,
        })
    }

    /// Whether they have met.
    pub(super) fn is_now(&self) -> bool {
        self.gap <= self.tolerance
    }

    /// Greatest speed of approach of the points that take part, m/s, positive.
    pub(super) fn speed(&self) -> f32 {
        -self.speeds.into_iter().flatten().fold(0.0, f32::min)
    }

    /// Turns the approach speed u of each point that takes part into -e u, with the restitution e; beside how the bodies move,
    /// their surfaces go past each other with `surface_speed`, m/s. Returns the impulse on b, N s.
    pub(super) fn collide(
        &self,
        restitution: f32,
        surface_speed: Option<f32>,
        pair: &mut [BodyState; 2],
    ) -> LaneVec2<f32> {
        let constraint = &self.constraint;
        // The change asked for, u - (-e u), is q of the complementarity problem K x + q ≥ 0.
        let change = self.speeds.map(|speed| speed.map(|u| (1.0 + restitution) * u));
        let mut impulses = solve_points(constraint, change);
        if constraint.coupling != 0.0 {
            let mut after = *pair;
            constraint.apply_normal_impulses(impulses, &mut after);
            let (before, now) = (constraint.normal_speeds(pair), constraint.normal_speeds(&after));
            let left = [0, 1].map(|i| change[i].unwrap_or(0.0) + (now[i] - before[i]));
            take_back(constraint, &mut impulses, left);
        }
        constraint.apply_collision_impulses(impulses, surface_speed, pair)
    }

    /// What the bodies met with, a having its centre at a place, and what came of it: this impulse on b, N s.
    pub(super) fn report(&self, center_a: Point, on_b: LaneVec2<f32>) -> Collision {
        let points = self.constraint.points.iter().zip(self.speeds);
        let taking_part = points.filter_map(|(point, speed)| speed.map(|_| point.anchor_a.to_vec2()));
        // One point, or the middle of two.
        let anchor = taking_part.reduce(|first, second| (first + second) * 0.5).unwrap_or_default();
        Collision {
            speed: self.speed(),
            point: center_a + anchor,
            normal: self.constraint.normal.to_vec2(),
            on_b: on_b.to_vec2(),
        }
    }
}

/// The impulses at two points, N s, that change the speeds of those that take part by -q, m/s.
fn solve_points(constraint: &ContactConstraint<f32>, q: [Option<f32>; 2]) -> [f32; 2] {
    let k = constraint.points.map(|point| point.normal_k);
    match q {
        [Some(q_1), Some(q_2)] => {
            let row = |own| Row { own, other: constraint.coupling, scale: 1.0 };
            solve_pair([row(k[0]), row(k[1])], [q_1, q_2])
        }
        alone => [0, 1].map(|i| alone[i].map_or(0.0, |q| (-q / k[i]).max(0.0))),
    }
}

/// Takes back what is `left` of the change of speed at the points that press, m/s. Where they respond nearly as one, rounding
/// leaves 1e-4 of it, which no later sweep takes back; the response to equal impulses has all its digits.
fn take_back(constraint: &ContactConstraint<f32>, impulses: &mut [f32; 2], left: [f32; 2]) {
    let presses = impulses.map(|impulse| impulse > 0.0);
    let pressing = || [0, 1].into_iter().filter(|&i| presses[i]);
    let coupling = if presses == [true; 2] { 2.0 * constraint.coupling } else { 0.0 };
    let response = pressing().map(|i| constraint.points[i].normal_k).sum::<f32>() + coupling;
    let rest = pressing().map(|i| left[i]).sum::<f32>() / response;
    for i in pressing() {
        impulses[i] = (impulses[i] - rest).max(0.0);
    }
}
