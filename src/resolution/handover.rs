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

/// How many pieces a circle may reach in a substep, looks in vain counted; the sweeps take what is left.
const MEETINGS_PER_SUBSTEP: usize = 64;

/// A piece is met when the gap is within this share of the way of the approach in a substep, no unit.
const MEETING_TOLERANCE: f32 = 1e-3;

/// A contact of a circle with the ground.
#[derive(Clone, Copy, Debug)]
struct Piece {
    /// Row of the circle.
    row: u32,
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
    pub(crate) fn consider(&mut self, index: u32, contact: &Contact, constraint: &ContactConstraint<f32>) {
        let Some(graph_place) = contact.graph_place else { return };
        let row = match (constraint.inverse_mass_a > 0.0, constraint.inverse_mass_b > 0.0) {
            (true, false) if constraint.turns_a == 0.0 => constraint.row_a,
            (false, true) if constraint.turns_b == 0.0 => constraint.row_b,
            _ => return,
        };
        self.pieces.push(Piece { row, contact: index, graph_place, is_ahead: false, level: 0.0 });
    }

    /// Keeps the circles that have two pieces of ground in reach.
    pub(crate) fn group(&mut self) {
        self.pieces.sort_unstable_by_key(|piece| (piece.row, piece.contact));
        let mut kept = 0;
        let mut start = 0;
        while start < self.pieces.len() {
            let row = self.pieces[start].row;
            let len = self.pieces[start..].iter().take_while(|piece| piece.row == row).count();
            if len > 1 {
                self.pieces.copy_within(start..start + len, kept);
                kept += len;
            }
            start += len;
        }
        self.pieces.truncate(kept);
    }

    /// Before impacts: nothing is held back.
    pub(crate) fn release(&mut self, graph: &mut ConstraintGraph) {
        for piece in &mut self.pieces {
            if piece.is_ahead {
                piece.is_ahead = false;
                graph.constraint_mut(piece.graph_place).points[0].awaits_impact = 0.0;
            }
        }
    }

    /// Before the sweeps: holds back the pieces that rolling circles have not reached yet.
    pub(crate) fn hold_back(&mut self, graph: &mut ConstraintGraph, states: &[BodyState]) {
        for pieces in self.pieces.chunk_by_mut(|one, next| one.row == next.row) {
            let separation_and_load = |graph: &ConstraintGraph, piece: &Piece| {
                let constraint = graph.constraint(piece.graph_place);
                let (a, b) = (states[constraint.row_a as usize], states[constraint.row_b as usize]);
                let point = &constraint.points[0];
                (constraint.separation(point, &a, &b), point.normal_impulse)
            };
            let loaded =
                pieces.iter().map(|piece| separation_and_load(graph, piece)).filter(|&(_, load)| load > 0.0);
            let level = loaded.fold(0.0, |level: f32, (separation, _)| level.min(separation));
            for piece in pieces {
                let (separation, load) = separation_and_load(graph, piece);
                let point = &mut graph.constraint_mut(piece.graph_place).points[0];
                piece.level = level;
                piece.is_ahead = load == 0.0 && separation > level && point.awaits_impact == 0.0;
                if piece.is_ahead {
                    point.awaits_impact = OUT_OF_REACH;
                }
            }
        }
    }

    /// Before the move: circles meet what they reach during it.
    pub(crate) fn run(&mut self, scene: &mut HandoverScene<'_>) {
        for pieces in self.pieces.chunk_by_mut(|one, next| one.row == next.row) {
            let mut now = 0.0;
            for _ in 0..MEETINGS_PER_SUBSTEP {
                let times = pieces.iter().enumerate().filter(|(_, piece)| piece.is_ahead);
                let times =
                    times.filter_map(|(number, piece)| Some((piece.time_of_meeting(now, scene)?, number)));
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
    fn states(&self, scene: &HandoverScene<'_>) -> [BodyState; 2] {
        let constraint = scene.graph.constraint(self.graph_place);
        [constraint.row_a, constraint.row_b].map(|row| scene.bodies.states[row as usize])
    }

    /// When the circle reaches the piece, s, if within this substep; not before `now`.
    fn time_of_meeting(&self, now: f32, scene: &HandoverScene<'_>) -> Option<f32> {
        let constraint = scene.graph.constraint(self.graph_place);
        let [a, b] = self.states(scene);
        let gap = constraint.separation(&constraint.points[0], &a, &b) - self.level;
        let speed = -constraint.normal.dot(constraint.points[0].relative_velocity(&a, &b));
        let time = (gap / speed).max(now);
        (speed > 0.0 && time <= scene.h).then_some(time)
    }

    /// Stops the approach of the circle to the piece at `time`, s; false if they do not meet yet.
    fn meet(&mut self, time: f32, scene: &mut HandoverScene<'_>) -> bool {
        let before = self.states(scene);
        let mut there = before;
        for state in &mut there {
            drift(state, time);
        }
        let contact = &scene.contacts[self.contact];
        let manifold = manifold_in(contact, scene.bodies, [&there[0], &there[1]]);
        let constraint = scene.graph.constraint_mut(self.graph_place);
        let Some(manifold) = manifold.restricted_to(&contact.manifold) else {
            constraint.points[0].awaits_impact = 0.0;
            self.is_ahead = false;
            return false;
        };
        constraint.set_geometry_in(0, &manifold, &there[0], &there[1]);
        let point = constraint.points[0];
        let speed = -constraint.normal.dot(point.relative_velocity(&before[0], &before[1]));
        if manifold.points()[0].separation - self.level > MEETING_TOLERANCE * speed.abs() * scene.h {
            return false;
        }
        constraint.points[0].awaits_impact = 0.0;
        self.is_ahead = false;
        let [mut a, mut b] = before;
        strike(constraint, speed, &mut a, &mut b);
        let (mut after, before) = if constraint.row_a == self.row { (a, before[0]) } else { (b, before[1]) };
        // The move will take the circle on with its new velocity from the start of the substep.
        after.delta_position = after.delta_position + (before.velocity - after.velocity) * time;
        let missed_turn = (before.angular_velocity - after.angular_velocity) * time;
        turn(&mut after, missed_turn);
        scene.bodies.states[self.row as usize] = after;
        true
    }
}

/// The blow that stops an approach with `speed`, m/s, and its friction.
fn strike(constraint: &ContactConstraint<f32>, speed: f32, a: &mut BodyState, b: &mut BodyState) {
    let point = &constraint.points[0];
    let blow = (speed / point.normal_k).max(0.0);
    constraint.apply(point, constraint.normal * blow, a, b);
    let tangent: LaneVec2<f32> = constraint.normal.perp();
    let limit = constraint.friction * blow;
    let friction = (-point.tangent_mass * tangent.dot(point.relative_velocity(a, b))).clamp(-limit, limit);
    constraint.apply(point, tangent * friction, a, b);
}

/// The load of the pieces that the circle leaves goes over to the one that it has just met.
fn hand_over(pieces: &[Piece], met: usize, scene: &mut HandoverScene<'_>) {
    for (number, left) in pieces.iter().enumerate() {
        let constraint = scene.graph.constraint(left.graph_place);
        let [a, b] = left.states(scene);
        let point = constraint.points[0];
        let parting = constraint.normal.dot(point.relative_velocity(&a, &b));
        if number == met || point.normal_impulse == 0.0 || parting <= 0.0 {
            continue;
        }
        let (normal, tangent) = (point.normal_share, point.tangent_share);
        add_share(left, [-normal, -tangent], scene);
        add_share(&pieces[met], [normal, tangent], scene);
        scene.graph.constraint_mut(left.graph_place).points[0].normal_impulse = 0.0;
        scene.graph.constraint_mut(left.graph_place).points[0].tangent_impulse = 0.0;
        let met = &mut scene.graph.constraint_mut(pieces[met].graph_place).points[0];
        met.normal_impulse += point.normal_impulse;
        met.tangent_impulse += point.tangent_impulse;
    }
}

/// Adds to the share of the warm start, along normal and tangent, N s, that the circle gets from a piece after the
/// move.
fn add_share(piece: &Piece, [along_normal, along_tangent]: [f32; 2], scene: &mut HandoverScene<'_>) {
    let constraint = scene.graph.constraint_mut(piece.graph_place);
    constraint.points[0].normal_share += along_normal;
    constraint.points[0].tangent_share += along_tangent;
    let impulse = constraint.normal * along_normal + constraint.normal.perp() * along_tangent;
    let [mut a, mut b] = [constraint.row_a, constraint.row_b].map(|row| scene.shares[row as usize]);
    constraint.apply(&constraint.points[0], impulse, &mut a, &mut b);
    scene.shares[piece.row as usize] = if constraint.row_a == piece.row { a } else { b };
}
