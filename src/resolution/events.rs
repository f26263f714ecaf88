//! What happens at a time of its own within a substep: impacts, which bounce, and seams of the ground, which a rolling circle
//! crosses without a bounce.
//!
//! Either is found by the gap and the approach of a contact, met where the bodies are at that time, and answered by an
//! impulse. The points that wait for it are marked as pending, and the sweeps leave them alone.

mod approach;
mod impacts;
mod queue;
mod seams;

use crate::body::Bodies;
use crate::collision::Contacts;
use crate::compute::{BodyState, GROUND_ROW};
use crate::math::Vec2;
use crate::resolution::constraint_graph::ConstraintGraph;
pub(crate) use crate::resolution::events::impacts::Impacts;
pub(crate) use crate::resolution::events::seams::Seams;
use crate::resolution::integrate::{Kicks, drift, drift_until};
use crate::resolution::scheme::Scheme;

/// Two bodies have met, and two points meet together, within this share of the way that the approach makes in a
/// substep, no unit: a box that lands flat is not to be tipped over by a rounding error.
const MEETING_TOLERANCE: f32 = 1e-3;

/// What events happen to.
#[derive(Debug)]
pub(crate) struct EventScene<'a> {
    pub(crate) bodies: &'a mut Bodies,
    pub(crate) contacts: &'a Contacts,
    pub(crate) kicks: &'a Kicks,
    pub(crate) graph: &'a mut ConstraintGraph,
    pub(crate) scheme: &'a Scheme,
}

impl EventScene<'_> {
    /// Length of the substep, s.
    fn h(&self) -> f32 {
        self.scheme.substep_time()
    }

    /// The bodies in two rows as they are now.
    fn states(&self, rows: [u32; 2]) -> [BodyState; 2] {
        rows.map(|row| self.bodies.states[row as usize])
    }

    /// Acceleration of the second of two bodies against the first, m/s².
    fn acceleration(&self, [a, b]: [u32; 2]) -> Vec2 {
        self.kicks.acceleration(b) - self.kicks.acceleration(a)
    }

    /// The bodies where straight paths take them until a time within the substep, s.
    fn states_at(&self, rows: [u32; 2], time: f32) -> [BodyState; 2] {
        self.states(rows).map(|mut state| {
            drift(&mut state, time);
            state
        })
    }

    /// Gives the bodies in two rows the velocities of `after` at a time within the substep, s, and moves them by what their
    /// drift will miss. The ground, whose row stands for all that contacts do not move, stays as it is.
    fn change_velocities(&mut self, rows: [u32; 2], after: [BodyState; 2], time: f32) {
        for (row, mut after) in rows.into_iter().zip(after).filter(|&(row, _)| row != GROUND_ROW) {
            let state = &mut self.bodies.states[row as usize];
            drift_until(time, state, &mut after);
            *state = after;
        }
    }
}
