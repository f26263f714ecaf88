//! What happens at a time of its own within a substep: impacts, which bounce, and seams of the ground, which a rolling circle
//! crosses without a bounce.
//!
//! Either is found by the gap and the approach of a contact, met where the bodies are at that time, and answered by an
//! impulse. The points that wait for it are marked as pending, and the sweeps leave them alone.

mod approach;
mod impacts;
mod meeting;
mod queue;
mod seams;

use crate::body::Bodies;
use crate::collision::Contacts;
use crate::compute::{BodyState, GROUND_ROW};
use crate::math::Vec2;
use crate::resolution::constraint_graph::{ConstraintGraph, GraphIndex};
use crate::resolution::events::approach::bounce_threshold;
pub(crate) use crate::resolution::events::impacts::{Impact, Impacts};
use crate::resolution::events::meeting::Meeting;
pub(crate) use crate::resolution::events::seams::Seams;
use crate::resolution::integrate::{Kicks, drift, drift_until};
use crate::resolution::scheme::Scheme;

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

    /// The bodies where they will be at a time within the substep, s: x + v t + a t (t - h)/2 for the velocity v of the middle
    /// of the substep.
    fn bent_states_at(&self, rows: [u32; 2], time: f32) -> [BodyState; 2] {
        let mut states = self.states_at(rows, time);
        for (row, state) in rows.into_iter().zip(&mut states) {
            let bend = self.kicks.acceleration(row) * (0.5 * time * (time - self.h()));
            state.delta_position = state.delta_position + bend.into();
        }
        states
    }

    /// Slowest approach along a normal that bounces, m/s.
    fn bounce_threshold(&self, normal: Vec2, rows: [u32; 2]) -> f32 {
        let acceleration = normal.dot(self.acceleration(rows)).abs();
        bounce_threshold(self.scheme.restitution_threshold, acceleration, self.h())
    }

    /// Lets two bodies collide that meet at a time within the substep, s, and moves them by what their drift will miss. The
    /// ground, whose row stands for all that contacts do not move, stays as it is.
    fn collide(&mut self, home: GraphIndex, meeting: &Meeting, restitution: f32, time: f32) {
        let mut after = self.states(self.graph.rows(home));
        meeting.collide(restitution, &mut after);
        let moved = self.graph.moved_rows(home).into_iter().zip(after);
        for (row, mut after) in moved.filter(|&(row, _)| row != GROUND_ROW) {
            let state = &mut self.bodies.states[row as usize];
            self.scheme.limits.cut(&mut after);
            drift_until(time, state, &mut after);
            *state = after;
        }
    }
}
