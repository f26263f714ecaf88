//! What happens at a time of its own within a substep: impacts, which bounce; seams of the ground, which a rolling circle
//! crosses without a bounce; and what bodies meet that are fast or were struck.
//!
//! The first two are found by the gap and the approach of a contact, met where the bodies are at that time, and answered by an
//! impulse. The points that wait for it are marked as pending, and the sweeps leave them alone. The third is found by
//! [sweeping](continuous) bodies along their ways.

mod approach;
mod continuous;
mod course;
mod impacts;
mod meeting;
mod queue;
mod seams;
mod strikes;
mod traveller;

use crate::body::{Bodies, Mixed, Mixes};
use crate::collision::broad_phase::BroadPhase;
use crate::collision::{Contacts, OneWay, is_on_free_side, noise_of, was_before_links};
use crate::compute::BodyState;
use crate::joint::Joints;
use crate::resolution::blows::{Blows, Collision};
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::constraint_graph::{ConstraintGraph, GraphIndex};
use crate::resolution::events::approach::bounce_threshold;
pub(crate) use crate::resolution::events::continuous::{Continuous, Encounter};
pub(crate) use crate::resolution::events::course::Courses;
pub(crate) use crate::resolution::events::impacts::Impacts;
use crate::resolution::events::meeting::Meeting;
pub(crate) use crate::resolution::events::seams::Seams;
pub(crate) use crate::resolution::events::strikes::Strikes;
use crate::resolution::integrate::{Kicks, drift, drift_until};
use crate::resolution::moving::manifold_in;
use crate::resolution::scheme::Scheme;

/// Bodies come much nearer if it is by more than this share of the width of the thinner in a step, no unit: less, and heaps
/// would be solved by pairs; half of the width, and one may leave the other on the far side.
const MUCH_NEARER: f32 = 0.25;

/// The same of what has met a line: its middle is to stay before it, and bodies may go so much deeper more than once. With as much as of
/// others, one needle in a hundred comes to the far side; with a tenth as few do as with this.
const MUCH_NEARER_LINE: f32 = 0.05;

/// What events happen to.
#[derive(Debug)]
pub(crate) struct EventScene<'a> {
    pub(crate) bodies: &'a mut Bodies,
    pub(crate) contacts: &'a Contacts,
    pub(crate) joints: &'a Joints,
    pub(crate) broad_phase: &'a BroadPhase,
    pub(crate) mixes: Mixes,
    pub(crate) courses: &'a mut Courses,
    pub(crate) strikes: &'a mut Strikes,
    pub(crate) blows: &'a mut Blows,
    pub(crate) kicks: &'a Kicks,
    pub(crate) graph: &'a mut ConstraintGraph,
    pub(crate) scheme: &'a Scheme,
}

impl EventScene<'_> {
    /// Length of the substep, s.
    fn h(&self) -> f32 {
        self.scheme.substep_time()
    }

    /// The body in a row as it is now, no faster than it is let drift.
    fn state(&self, row: u32) -> BodyState {
        let mut state = self.bodies.states[row as usize];
        self.scheme.limits.cut(&mut state);
        state
    }

    /// The bodies in two rows.
    fn states(&self, rows: [u32; 2]) -> [BodyState; 2] {
        rows.map(|row| self.state(row))
    }

    /// Accelerations of the points of a contact along its normal, of b against a, m/s²: by what acts on the bodies, and turns them.
    fn accelerations(&self, constraint: &ContactConstraint<f32>, [a, b]: [u32; 2]) -> [f32; 2] {
        let of_centers = self.kicks.acceleration(b) - self.kicks.acceleration(a);
        let turns = [a, b].map(|row| self.kicks.angular_acceleration(row));
        [0, 1].map(|index| constraint.acceleration_along_normal(index, of_centers.into(), turns))
    }

    /// The bodies where straight paths take them until a time within the substep, s.
    fn states_at(&self, rows: [u32; 2], time: f32) -> [BodyState; 2] {
        self.states(rows).map(|mut state| {
            drift(&mut state, time);
            state
        })
    }

    /// The bodies where they will be at a time within the substep, s: x + v t + a t (t - h)/2 for the velocity v of the middle
    /// of the substep, and turned likewise.
    fn bent_states_at(&self, rows: [u32; 2], time: f32) -> [BodyState; 2] {
        let bend = 0.5 * (time - self.h());
        let mut states = self.states(rows);
        for (row, state) in rows.into_iter().zip(&mut states) {
            let angular_velocity = state.angular_velocity;
            state.angular_velocity += self.kicks.angular_acceleration(row) * bend;
            drift(state, time);
            state.angular_velocity = angular_velocity;
            state.delta_position =
                state.delta_position + (self.kicks.acceleration(row) * (time * bend)).into();
        }
        states
    }

    /// Slowest approaches that bounce of points with these accelerations along the normal, m/s².
    fn bounce_thresholds(&self, accelerations: [f32; 2]) -> [f32; 2] {
        let setting = self.scheme.restitution_threshold;
        accelerations.map(|acceleration| bounce_threshold(setting, acceleration.abs(), self.h()))
    }

    /// Coefficients of friction and restitution between two shapes.
    fn mixed(&self, colliders: [u32; 2]) -> Mixed {
        self.mixes.of(self.bodies, colliders)
    }

    /// Index of the contact between two shapes, if they have one.
    fn contact_of(&self, colliders: [u32; 2]) -> Option<u32> {
        self.contacts.between(self.bodies, colliders)
    }

    /// The place of the contact between two shapes in the graph, if it is there.
    fn home(&self, colliders: [u32; 2]) -> Option<GraphIndex> {
        self.graph.home(self.contact_of(colliders)?)
    }

    /// Whether a contact between two shapes bears load.
    fn is_loaded(&self, colliders: [u32; 2]) -> bool {
        self.home(colliders).is_some_and(|home| self.graph.is_loaded(home))
    }

    /// Whether two shapes that touch in these states of their bodies pass through each other, as one is a one-way floor.
    fn is_passing(&self, colliders: [u32; 2], [a, b]: &[BodyState; 2]) -> bool {
        if !self.bodies.roles.are_one_way(colliders) {
            return false;
        }
        match self.contact_of(colliders).and_then(|index| self.contacts[index].one_way) {
            Some(OneWay::Bears) => false,
            Some(OneWay::Passes) if Continuous::gap_before(colliders, self) <= 0.0 => true,
            // What is still apart may come from another side than it seemed to as the step began.
            _ => {
                let manifold = manifold_in(colliders, self.bodies, [a, b]);
                let velocity = (b.velocity - a.velocity).to_vec2();
                let as_step_began = colliders.map(|slot| self.bodies.motions[slot as usize].pose);
                !is_on_free_side(self.bodies, colliders, &manifold, velocity)
                    && !was_before_links(self.bodies, colliders, &manifold, velocity, as_step_began)
            }
        }
    }

    /// Rows of the bodies of two shapes.
    fn rows(&self, colliders: [u32; 2]) -> [u32; 2] {
        colliders.map(|slot| self.bodies.motions[slot as usize].row)
    }

    /// Whether what happens between two shapes at a time, s, is left to [`Continuous`]: one of their bodies is off course, and may
    /// meet others before. If it does not meet the pair, the points stay pending until the next substep.
    fn is_for_continuous(&mut self, colliders: [u32; 2], time: f32) -> bool {
        let rows = self.rows(colliders);
        rows.map(|row| self.strikes.last(row) < time && self.courses.look_at(self.bodies, row)) != [false; 2]
    }

    /// By which share of the width of the thinner shape two that have met may go deeper before they meet again, no unit.
    fn much_nearer(&self, colliders: [u32; 2]) -> f32 {
        let has_line = colliders.into_iter().any(|slot| self.bodies.shapes[slot as usize].is_segment());
        if has_line { MUCH_NEARER_LINE } else { MUCH_NEARER }
    }

    /// By how much the speed of a point of one shape against the other is rounded in these states of their bodies, m/s.
    fn rounding(&self, colliders: [u32; 2], states: &[BodyState; 2]) -> f32 {
        let of = |side: usize| {
            noise_of(states[side].velocity.to_vec2())
                + 4.0
                    * f32::EPSILON
                    * states[side].angular_velocity.abs()
                    * self.bodies.swing(colliders[side])
        };
        of(0) + of(1)
    }

    /// Whether two shapes, with their bodies in these states, may come much nearer within a step, if so in each of its
    /// substeps within a time, s.
    fn may_come_much_nearer(&self, colliders: [u32; 2], states: &[BodyState; 2], time: f32) -> bool {
        let motions = colliders.map(|slot| &self.bodies.motions[slot as usize]);
        let rim_speeds =
            [0, 1].map(|side| states[side].angular_velocity.abs() * self.bodies.swing(colliders[side]));
        let speed =
            (states[1].velocity - states[0].velocity).to_vec2().norm_1() + rim_speeds[0] + rim_speeds[1];
        speed * time * self.scheme.substeps as f32
            > self.much_nearer(colliders) * motions[0].thickness.min(motions[1].thickness)
    }

    /// Lets the bodies of two shapes collide that meet at a time within the substep, s, and moves those of them that contacts
    /// move by what their drift will miss.
    fn collide(
        &mut self,
        colliders: [u32; 2],
        moved: [bool; 2],
        meeting: &Meeting,
        restitution: f32,
        time: f32,
    ) -> Collision {
        let rows = self.rows(colliders);
        let mut after = self.states(rows);
        let there = after[0].delta_position + after[0].velocity * time;
        let on_b = meeting.collide(restitution, self.bodies.roles.surface_speed(colliders), &mut after);
        let center = self.bodies.center(self.bodies.body_of(colliders[0]));
        let collision = meeting.report(center + there.to_vec2(), on_b);
        let moved = rows.into_iter().zip(after).zip(moved);
        for ((row, mut after), _) in moved.filter(|&(_, is_moved)| is_moved) {
            let state = &mut self.bodies.states[row as usize];
            drift_until(time, state, &mut after, self.scheme.limits);
            *state = after;
            self.strikes.note(row, time, after);
            self.courses.look_at(self.bodies, row);
        }
        collision
    }
}
