//! Handing over: a circle that rolls from one piece of the ground onto the next.
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

use crate::body::Bodies;
use crate::collision::{Contact, Contacts};
use crate::compute::{BodyState, LaneVec2};
use crate::resolution::constraint::{ContactConstraint, OUT_OF_REACH};
use crate::resolution::constraint_graph::ConstraintGraph;
use crate::resolution::follow::manifold_in;
use crate::resolution::integrate::{drift, turn};
use crate::shape::Shape;

/// How many pieces a circle may reach in a substep, looks in vain counted; the sweeps take what is left.
const MEETINGS_PER_SUBSTEP: usize = 64;

/// A piece is met when the gap is within this share of the way of the approach in a substep, no unit.
const MEETING_TOLERANCE: f32 = 1e-3;

/// A contact of a circle with the ground.
#[derive(Clone, Copy, Debug)]
struct Piece {
    /// Rows of the two bodies, and which of them is the circle.
    rows: [u32; 2],
    circle: usize,
    /// Index of the contact, and its place in the constraint graph.
    contact: u32,
    graph_place: (u32, u32),
    /// Whether the sweeps are told to leave it alone.
    is_ahead: bool,
    /// Separation at which the circle is on it, m: that of the pieces under load, which yield a little.
    level: f32,
}

/// Circles on ground of several pieces.
#[derive(Clone, Debug, Default)]
pub(crate) struct Handovers {
    /// By row of the circle.
    pieces: Vec<Piece>,
}

/// What the stage works on.
#[derive(Debug)]
pub(crate) struct HandoverScene<'a> {
    pub(crate) bodies: &'a mut Bodies,
    pub(crate) contacts: &'a Contacts,
    pub(crate) graph: &'a mut ConstraintGraph,
    /// By row: what of the warm start the bodies get after the move.
    pub(crate) shares: &'a mut [BodyState],
    /// Length of the substep, s.
    pub(crate) h: f32,
}

impl Handovers {
    pub(crate) fn clear(&mut self) {
        self.pieces.clear();
    }

    /// Whether there is nothing to do.
    pub(crate) fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// Takes up a contact of a circle with the ground.
    pub(crate) fn consider(&mut self, index: u32, contact: &Contact, bodies: &Bodies) {
        let Some(graph_place) = contact.graph_place else { return };
        let moves = contact.slots.map(|slot| bodies.is_dynamic(slot));
        if moves[0] == moves[1] {
            return;
        }
        let circle = usize::from(moves[1]);
        if let Shape::Circle(_) = bodies.shapes[contact.slots[circle] as usize] {
            let rows = contact.slots.map(|slot| bodies.motions[slot as usize].row);
            self.pieces.push(Piece {
                rows,
                circle,
                contact: index,
                graph_place,
                is_ahead: false,
                level: 0.0,
            });
        }
    }

    /// Keeps the circles that have two pieces of ground in reach.
    pub(crate) fn group(&mut self) {
        self.pieces.sort_unstable_by_key(|piece| (piece.row(), piece.contact));
        let mut kept = 0;
        let mut start = 0;
        while start < self.pieces.len() {
            let row = self.pieces[start].row();
            let len = self.pieces[start..].iter().take_while(|piece| piece.row() == row).count();
            if len > 1 {
                self.pieces.copy_within(start..start + len, kept);
                kept += len;
            }
            start += len;
        }
        self.pieces.truncate(kept);
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

    /// Before the sweeps: holds back the pieces that rolling circles have not reached yet.
    pub(crate) fn hold_back(&mut self, graph: &mut ConstraintGraph, states: &[BodyState]) {
        for pieces in self.by_circle() {
            let level = pieces.iter().fold(0.0, |level: f32, piece| {
                let constraint = graph.constraint(piece.graph_place);
                let is_loaded = constraint.points[0].normal_impulse > 0.0;
                if is_loaded { level.min(piece.separation(&constraint, states)) } else { level }
            });
            for piece in pieces {
                let constraint = graph.constraint(piece.graph_place);
                let point = &constraint.points[0];
                let is_free = point.normal_impulse == 0.0 && constraint.special.awaits_impact[0] == 0.0;
                piece.level = level;
                piece.be_ahead(is_free && piece.separation(&constraint, states) > level, graph);
            }
        }
    }

    /// Before the move: circles meet what they reach during it.
    pub(crate) fn run(&mut self, scene: &mut HandoverScene<'_>) {
        for pieces in self.by_circle() {
            let mut now = 0.0;
            for _ in 0..MEETINGS_PER_SUBSTEP {
                let ahead = pieces.iter().enumerate().filter(|(_, piece)| piece.is_ahead);
                let times =
                    ahead.filter_map(|(number, piece)| Some((piece.time_of_meeting(now, scene)?, number)));
                let Some((time, next)) = times.min_by(|one, other| one.0.total_cmp(&other.0)) else { break };
                now = time;
                if pieces[next].meet(now, scene) {
                    hand_over(pieces, next, scene);
                }
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
            graph.set_awaits_impact(self.graph_place, [if is_ahead { OUT_OF_REACH } else { 0.0 }, 0.0]);
        }
    }

    /// When the circle reaches the piece, s, if within this substep; not before `now`.
    fn time_of_meeting(&self, now: f32, scene: &HandoverScene<'_>) -> Option<f32> {
        let constraint = scene.graph.constraint(self.graph_place);
        let [a, b] = self.states(&scene.bodies.states);
        let gap = constraint.separation(&constraint.points[0], &a, &b) - self.level;
        let speed = -constraint.normal.dot(constraint.points[0].relative_velocity(&a, &b));
        let time = (gap / speed).max(now);
        (speed > 0.0 && time <= scene.h).then_some(time)
    }

    /// Stops the approach of the circle to the piece at `time`, s; false if they do not meet yet.
    fn meet(&mut self, time: f32, scene: &mut HandoverScene<'_>) -> bool {
        let before = self.states(&scene.bodies.states);
        let mut there = before;
        for state in &mut there {
            drift(state, time);
        }
        let contact = &scene.contacts[self.contact];
        let manifold = manifold_in(contact, scene.bodies, [&there[0], &there[1]]);
        let Some(manifold) = manifold.restricted_to(&contact.manifold) else {
            self.be_ahead(false, scene.graph);
            return false;
        };
        let mut constraint = scene.graph.constraint(self.graph_place);
        constraint.set_geometry_in(&manifold, &there[0], &there[1]);
        scene.graph.set_geometry(self.graph_place, &constraint);
        let speed = -constraint.normal.dot(constraint.points[0].relative_velocity(&before[0], &before[1]));
        if manifold.points()[0].separation - self.level > MEETING_TOLERANCE * speed.abs() * scene.h {
            return false;
        }
        self.be_ahead(false, scene.graph);
        let mut after = before;
        strike(&constraint, speed, &mut after);
        let (before, mut after) = (before[self.circle], after[self.circle]);
        // The move will take the circle on with its new velocity from the start of the substep.
        after.delta_position = after.delta_position + (before.velocity - after.velocity) * time;
        let missed_turn = (before.angular_velocity - after.angular_velocity) * time;
        turn(&mut after, missed_turn);
        scene.bodies.states[self.row() as usize] = after;
        true
    }
}

/// The blow that stops an approach with `speed`, m/s, and its friction.
fn strike(constraint: &ContactConstraint<f32>, speed: f32, [a, b]: &mut [BodyState; 2]) {
    let point = &constraint.points[0];
    let blow = (speed / point.normal_k).max(0.0);
    constraint.apply(point, constraint.normal * blow, a, b);
    let tangent: LaneVec2<f32> = constraint.normal.perp();
    let limit = constraint.friction * blow;
    let friction =
        (-constraint.frictions[0].mass * tangent.dot(point.relative_velocity(a, b))).clamp(-limit, limit);
    constraint.apply(point, tangent * friction, a, b);
}

/// The load of the pieces that the circle leaves goes over to the one that it has just met.
fn hand_over(pieces: &[Piece], met: usize, scene: &mut HandoverScene<'_>) {
    for (number, left) in pieces.iter().enumerate() {
        let constraint = scene.graph.constraint(left.graph_place);
        let [a, b] = left.states(&scene.bodies.states);
        let point = &constraint.points[0];
        let parting = constraint.normal.dot(point.relative_velocity(&a, &b));
        if number == met || point.normal_impulse == 0.0 || parting <= 0.0 {
            continue;
        }
        let friction = &constraint.frictions[0];
        let load = [point.normal_impulse, friction.impulse, friction.normal_share];
        add_load(left, load.map(|part| -part), scene);
        add_load(&pieces[met], load, scene);
    }
}

/// Adds to what a piece bears, N s: its impulses along normal and tangent, and the share of the warm start along the
/// normal. Along the tangent that share is all there has been so far. The circle will get both shares after the move.
fn add_load(piece: &Piece, [normal, tangent, normal_share]: [f32; 3], scene: &mut HandoverScene<'_>) {
    let constraint = scene.graph.constraint(piece.graph_place);
    let point = &constraint.points[0];
    let friction = &constraint.frictions[0];
    let sums =
        [point.normal_impulse + normal, friction.impulse + tangent, friction.normal_share + normal_share];
    scene.graph.set_load(piece.graph_place, sums);
    let impulse = constraint.normal * normal_share + constraint.normal.perp() * tangent;
    let mut shares = piece.states(scene.shares);
    let [a, b] = &mut shares;
    constraint.apply(point, impulse, a, b);
    scene.shares[piece.row() as usize] = shares[piece.circle];
}
