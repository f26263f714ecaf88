//! Seams of the ground: a circle that rolls from one piece onto the next, across their internal edge.
//!
//! Ground is made of pieces. Where two of them meet at an angle δ, a rolling circle meets the next one with the
//! speed v δ and loses δ² of its energy, as a wheel does on a polygonal track. The sweeps know only the end of
//! the substep: they turn the velocity by all the angles at once, which costs (Σ δ)² in the place of Σ δ², and on
//! a finely divided curve that is a loss by v² h/R² per second that no division of the curve takes away.
//!
//! So pieces that a rolling circle is about to reach are held back from the sweeps, and met one by one, each at
//! its time, between the sweep and the move. What the circle leaves behind no longer pushes: its share of the load
//! goes over to the piece that the circle is on now.
//!
//! Runs once per substep, on circles with two contacts with the ground or more.

use crate::compute::{BodyState, GROUND_ROW, LaneVec2};
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::constraint_graph::{ConstraintGraph, GraphIndex};
use crate::resolution::events::EventScene;
use crate::resolution::events::meeting::Meeting;
use crate::resolution::integrate::drift_until;
use crate::resolution::moving::constraint_in;

/// How many pieces a circle may reach in a substep, looks in vain counted; the sweeps take what is left.
const MEETINGS_PER_SUBSTEP: usize = 64;

/// A contact of a circle with the ground.
#[derive(Clone, Copy, Debug)]
struct Piece {
    /// Rows of the two bodies, and which of them is the circle.
    rows: [u32; 2],
    circle: usize,
    /// Index of the contact, and its place in the constraint graph.
    contact: u32,
    home: GraphIndex,
    /// Whether it is marked as pending: the circle is still to reach it.
    is_ahead: bool,
    /// Separation at which the circle is on it, m: that of the pieces under load, which yield a little.
    level: f32,
    /// What the warm start after the move is to apply for the load that the piece bears, N s, if it bears it all along.
    warm_start: f32,
}

/// Circles on ground of several pieces.
#[derive(Clone, Debug, Default)]
pub(crate) struct Seams {
    /// By row of the circle.
    pieces: Vec<Piece>,
    /// By row: how many pieces the circle there has in reach.
    counts: Vec<u32>,
}

impl Seams {
    pub(crate) fn clear(&mut self) {
        self.pieces.clear();
    }

    /// Takes up the contact of a circle with the ground at a place of the graph.
    pub(crate) fn take_up(&mut self, home: GraphIndex, graph: &ConstraintGraph) {
        self.pieces.push(Piece {
            rows: graph.rows(home),
            circle: usize::from(graph.moved_rows(home)[0] == GROUND_ROW),
            contact: graph.contact_at(home),
            home,
            is_ahead: false,
            level: 0.0,
            warm_start: 0.0,
        });
    }

    /// Keeps the circles that have two pieces of ground in reach.
    pub(crate) fn group(&mut self) {
        let Self { pieces, counts } = self;
        let end = pieces.iter().map(|piece| piece.row() as usize + 1).max().unwrap_or(0);
        counts.clear();
        counts.resize(end, 0);
        for piece in &*pieces {
            counts[piece.row() as usize] += 1;
        }
        pieces.retain(|piece| counts[piece.row() as usize] > 1);
        pieces.sort_unstable_by_key(|piece| (piece.row(), piece.contact));
    }

    /// The pieces of each circle.
    fn by_circle(&mut self) -> impl Iterator<Item = &mut [Piece]> {
        self.pieces.chunk_by_mut(|one, next| one.row() == next.row())
    }

    /// Before impacts: nothing is held back.
    pub(crate) fn release(&mut self, graph: &mut ConstraintGraph) {
        for piece in &mut self.pieces {
            piece.be_ahead(false, graph);
        }
    }

    /// Before the sweeps: holds back the pieces that rolling circles have not reached yet, or only just now. A piece
    /// that was to be met at the very end of a substep may lie a rounding error behind it, and the sweeps would take
    /// the impulse of the meeting for load.
    pub(crate) fn hold_back(&mut self, graph: &mut ConstraintGraph, states: &[BodyState], h: f32) {
        for pieces in self.by_circle() {
            let level = pieces.iter().fold(0.0, |level: f32, piece| {
                let constraint = graph.constraint(piece.home);
                let is_loaded = constraint.points[0].normal_impulse > 0.0;
                if is_loaded { level.min(piece.separation(&constraint, states)) } else { level }
            });
            for piece in pieces {
                let constraint = graph.constraint(piece.home);
                let point = &constraint.points[0];
                let is_free = point.normal_impulse == 0.0 && !graph.is_pending(piece.home)[0];
                piece.level = level;
                let [a, b] = piece.states(states);
                let reach = (-constraint.normal.dot(point.relative_velocity(&a, &b))).max(0.0) * h;
                piece.be_ahead(is_free && piece.separation(&constraint, states) + reach > level, graph);
            }
        }
    }

    /// Before the move: circles meet what they reach during it.
    pub(crate) fn run(&mut self, scene: &mut EventScene<'_>) {
        for pieces in self.by_circle() {
            let (mut now, mut rest) = (0.0, BodyState::REST.velocity);
            for piece in &mut *pieces {
                let friction = &scene.graph.constraint(piece.home).frictions[0];
                piece.warm_start = if scene.scheme.split_kick { friction.warm_start } else { 0.0 };
            }
            for _ in 0..MEETINGS_PER_SUBSTEP {
                let ahead = pieces.iter().enumerate().filter(|(_, piece)| piece.is_ahead);
                let times =
                    ahead.filter_map(|(number, piece)| Some((piece.time_of_meeting(now, scene)?, number)));
                let Some((time, next)) = times.min_by(|one, other| one.0.total_cmp(&other.0)) else { break };
                now = time;
                if pieces[next].meet(now, scene) {
                    rest = rest + pass_load_on(pieces, next, now, scene);
                }
            }
            let (h, row) = (scene.h(), pieces[0].row());
            let state = &mut scene.bodies.states[row as usize];
            let before = *state;
            state.velocity = state.velocity + rest;
            drift_until(h, &before, state, scene.scheme.limits);
            if now > 0.0 {
                // The rest acts after the move: what is swept from here on goes where it goes.
                scene.strikes.note(row, now, *state);
            }
        }
    }
}

impl Piece {
    /// Row of the circle.
    fn row(&self) -> u32 {
        self.rows[self.circle]
    }

    fn states(&self, states: &[BodyState]) -> [BodyState; 2] {
        self.rows.map(|row| states[row as usize])
    }

    fn separation(&self, constraint: &ContactConstraint<f32>, states: &[BodyState]) -> f32 {
        let [a, b] = self.states(states);
        constraint.separation(&constraint.points[0], &a, &b)
    }

    /// Holds the piece back from the sweeps, or no longer does.
    fn be_ahead(&mut self, is_ahead: bool, graph: &mut ConstraintGraph) {
        if is_ahead != self.is_ahead {
            self.is_ahead = is_ahead;
            graph.set_pending(self.home, [is_ahead, false]);
        }
    }

    /// When the circle reaches the piece, s, if within this substep; not before `now`.
    fn time_of_meeting(&self, now: f32, scene: &EventScene<'_>) -> Option<f32> {
        let constraint = scene.graph.constraint(self.home);
        let [a, b] = self.states(&scene.bodies.states);
        let gap = constraint.separation(&constraint.points[0], &a, &b) - self.level;
        let speed = -constraint.normal.dot(constraint.points[0].relative_velocity(&a, &b));
        let time = (gap / speed).max(now);
        (speed > 0.0 && time <= scene.h()).then_some(time)
    }

    /// Stops the approach of the circle to the piece at `time`, s; false if they do not meet yet.
    fn meet(&mut self, time: f32, scene: &mut EventScene<'_>) -> bool {
        let there = scene.states_at(self.rows, time);
        let contact = &scene.contacts[self.contact];
        let home = self.home;
        let Some((constraint, gap)) = constraint_in(contact, home, scene.bodies, scene.graph, &there) else {
            self.be_ahead(false, scene.graph);
            return false;
        };
        scene.graph.set_geometry(home, &constraint);
        let gaps = [Some(gap - self.level), None];
        let meeting = Meeting::new(constraint, gaps, &there, [0.0; 2], [0.0; 2], scene.h());
        let Some(meeting) = meeting.filter(Meeting::is_now) else { return false };
        self.be_ahead(false, scene.graph);
        let are_moved = scene.graph.moved_rows(home).map(|row| row != GROUND_ROW);
        let colliders = contact.colliders;
        let met = scene.collide(colliders, are_moved, &meeting, 0.0, time);
        scene.blows.note_other(home, met.on_b, scene.graph);
        true
    }
}

/// The load of the pieces that the circle leaves goes over to the `next`, which it meets at `time`, s, into the substep.
///
/// The first half of their support has acted, along the old normal. Over the substep the old piece should act for
/// `time` and the new one for the rest, so that of the second half, the warm start after the move, 2 (1 - time/h) goes
/// over: more than all of it, if the new piece is met in the first half. Returns the velocity that the rest is to give
/// the circle after the move, m/s, along the old normals.
fn pass_load_on(pieces: &mut [Piece], next: usize, time: f32, scene: &mut EventScene<'_>) -> LaneVec2<f32> {
    let share = 2.0 * (1.0 - time / scene.h());
    let mut rest = BodyState::REST.velocity;
    for left in (0..pieces.len()).filter(|&left| left != next) {
        let old = scene.graph.constraint(pieces[left].home);
        let [a, b] = pieces[left].states(&scene.bodies.states);
        let parting = old.normal.dot(old.points[0].relative_velocity(&a, &b));
        if old.points[0].normal_impulse == 0.0 || parting <= 0.0 {
            continue;
        }
        let passed_on = std::mem::take(&mut pieces[left].warm_start);
        pieces[next].warm_start += passed_on;
        let goes = share * passed_on;
        let [normal, tangent, warm_start] = load(&old, scene.scheme.split_kick);
        let borne = load(&scene.graph.constraint(pieces[next].home), scene.scheme.split_kick);
        let met = [borne[0] + normal + warm_start - goes, borne[1] + tangent, borne[2] + goes];
        scene.graph.set_load(pieces[left].home, [0.0; 3]);
        scene.graph.set_load(pieces[next].home, met);
        let inverse_mass = [-old.inverse_mass_a, old.inverse_mass_b][pieces[left].circle];
        rest = rest + old.normal * (inverse_mass * (warm_start - goes));
        scene.blows.note_other(pieces[left].home, (old.normal * (warm_start - goes)).to_vec2(), scene.graph);
    }
    rest
}

/// What the point of a piece bears, N s: its impulses along normal and tangent, and what the warm start after the move
/// will add along the normal.
fn load(constraint: &ContactConstraint<f32>, starts_again: bool) -> [f32; 3] {
    let friction = &constraint.frictions[0];
    let warm_start = if starts_again { friction.warm_start } else { 0.0 };
    [constraint.points[0].normal_impulse, friction.impulse, warm_start]
}
