//! The hot row of a body: what the substep loop reads and writes.

use crate::compute::{Lane, LaneRot, LaneVec2};

/// Velocity of a body and how far it has moved since the step began.
///
/// 32 bytes, so that a row is half a cache line, and rows transpose into as many registers as a row has numbers. Poses are
/// not here: the solver works on the small deltas, in `f32`, and the step adds them to the `f64` centre once.
#[repr(C, align(32))]
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyState<L = f32> {
    /// Velocity of the centre of mass, m/s.
    pub(crate) velocity: LaneVec2<L>,
    /// Angular velocity, rad/s, counter-clockwise.
    pub(crate) angular_velocity: L,
    /// Keeps the row at 32 bytes.
    pub(crate) padding: L,
    /// Translation since the step began, m.
    pub(crate) delta_position: LaneVec2<L>,
    /// Rotation since the step began.
    pub(crate) delta_rotation: LaneRot<L>,
}

const _: () = assert!(size_of::<BodyState>() == 32);

/// The row that stands for every body the solver cannot move: fixed or asleep. Its velocity is 0 and, since
/// contacts give it no inverse mass, stays so; kernels need no branch for it.
pub(crate) const GROUND_ROW: u32 = 0;

impl BodyState {
    /// A body at rest.
    pub(crate) const REST: Self = Self {
        velocity: LaneVec2 { x: 0.0, y: 0.0 },
        angular_velocity: 0.0,
        padding: 0.0,
        delta_position: LaneVec2 { x: 0.0, y: 0.0 },
        delta_rotation: LaneRot { c: 1.0, s: 0.0 },
    };

    /// Whether it has any velocity.
    pub(crate) fn is_moving(&self) -> bool {
        let LaneVec2 { x, y } = self.velocity;
        x != 0.0 || y != 0.0 || self.angular_velocity != 0.0
    }

    /// Begins a step: the body has not moved.
    pub(crate) fn stand_still(&mut self) {
        self.delta_position = Self::REST.delta_position;
        self.delta_rotation = Self::REST.delta_rotation;
    }
}

impl<L: Lane> BodyState<L> {
    /// Velocity of the body at a place, m/s, that is `arm` from its centre of mass, m.
    #[inline(always)]
    pub(crate) fn velocity_at(&self, arm: LaneVec2<L>) -> LaneVec2<L> {
        self.velocity + arm.perp() * self.angular_velocity
    }

    /// As many bodies, from the first four numbers of their rows and the second four.
    #[inline(always)]
    pub(super) fn of_numbers([x, y, angular_velocity, padding]: [L; 4], [dx, dy, c, s]: [L; 4]) -> Self {
        Self {
            velocity: LaneVec2 { x, y },
            angular_velocity,
            padding,
            delta_position: LaneVec2 { x: dx, y: dy },
            delta_rotation: LaneRot { c, s },
        }
    }

    // Portable lanes read and write row by row.
    /// The first four numbers of their rows.
    #[cfg_attr(not(any(target_arch = "x86_64", target_arch = "aarch64")), allow(dead_code))]
    #[inline(always)]
    pub(super) fn first_numbers(&self) -> [L; 4] {
        [self.velocity.x, self.velocity.y, self.angular_velocity, self.padding]
    }

    /// The second four.
    #[cfg_attr(not(any(target_arch = "x86_64", target_arch = "aarch64")), allow(dead_code))]
    #[inline(always)]
    pub(super) fn second_numbers(&self) -> [L; 4] {
        [self.delta_position.x, self.delta_position.y, self.delta_rotation.c, self.delta_rotation.s]
    }

    /// As many bodies with these velocities, the first four numbers of their rows, that have not moved.
    #[inline(always)]
    pub(super) fn of_velocities([x, y, angular_velocity, padding]: [L; 4]) -> Self {
        Self { velocity: LaneVec2 { x, y }, angular_velocity, padding, ..Self::at_rest() }
    }

    /// `yes` where the mask holds, `no` elsewhere.
    #[inline(always)]
    pub(crate) fn select(mask: L::Mask, yes: &Self, no: &Self) -> Self {
        Self {
            velocity: LaneVec2::select(mask, yes.velocity, no.velocity),
            angular_velocity: L::select(mask, yes.angular_velocity, no.angular_velocity),
            padding: no.padding,
            delta_position: LaneVec2::select(mask, yes.delta_position, no.delta_position),
            delta_rotation: LaneRot::select(mask, yes.delta_rotation, no.delta_rotation),
        }
    }

    /// As many bodies at rest.
    #[inline(always)]
    pub(crate) fn at_rest() -> Self {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        Self {
            velocity: LaneVec2 { x: zero, y: zero },
            angular_velocity: zero,
            padding: zero,
            delta_position: LaneVec2 { x: zero, y: zero },
            delta_rotation: LaneRot { c: one, s: zero },
        }
    }
}
