//! Impacts: bounces at their time, pairwise and in order, between the first kick and the warm start.
//!
//! Where restitution is a correction at the end of a step, a ball bounces from wherever the step left it and
//! a chain of touching balls is hit all at once; neither converges. Here each impact happens when the
//! surfaces meet, with the speed they meet at.
//!
//! After the half kick a body has the velocity v of the middle of the substep; with constant acceleration a
//! it has v + a d at the time t, where d = t - h/2. For the gap s and the relative velocity and acceleration
//! v, a along the normal:
//!
//! ```text
//! the gap closes at t :  s + (v - a h/2) t + a t²/2 = 0
//! speed of approach   :  u  = v + a d
//! after it            :  -e u,  so mid-substep v' = -e u - a d = v - (1 + e) u
//! ```
//!
//! The drift will move each body by h v'. It really moves by v t + v' (h - t): the terms in a cancel. So the
//! impact itself moves it by (v - v') t, and later impacts, the drift and the second kick need not know.
//!
//! A contact that carries load bounces only where the approach exceeds what the load makes up for: what rests on
//! something is pressed, not struck, and what still moves there is for the sweeps. A dense pile whose contacts
//! all bounced would never bear its weight.
//!
//! Cost: one look at every contact with restitution per substep, in lanes, and a heap of the few that may meet. Nothing where no contact has restitution.

use crate::body::{Bodies, NONE};
use crate::collision::{Contacts, Manifold};
use crate::compute::{BodyState, GROUND_ROW, Width};
use crate::math::Vec2;
use crate::resolution::approach::{MEETING_TOLERANCE, RESTING_SUBSTEPS, Substep, Watched, approach};
use crate::resolution::block::{Row, solve_pair};
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::constraint_graph::{BlockPlace, ConstraintGraph};
use crate::resolution::contact_block::Marks;
use crate::resolution::follow::manifold_in;
use crate::resolution::impact_queue::{ImpactQueue, Neighbours};
use crate::resolution::integrate::{Kicks, drift, drift_until};

/// How often one contact may bounce within a substep. More happens only where bodies are wedged; the sweeps
/// take what is left, as if there were no restitution.
const IMPACTS_PER_SUBSTEP: u8 = 16;

/// A contact that may bounce, and that was looked at closely.
#[derive(Clone, Debug)]
struct BouncyContact {
    /// Index of the contact, and its place in the constraint graph.
    contact: u32,
    graph_place: (u32, u32),
    rows: [u32; 2],
    restitution: f32,
    /// Approach speed from which the contact bounces, m/s.
    threshold: f32,
    /// Greatest speed of an impact in this step, m/s.
    greatest_speed: f32,
    /// Impacts in this substep.
    impacts: u8,
}

/// How a point approaches.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Approach {
    /// Gap, m; negative where the bodies overlap.
    separation: f32,
    /// Relative velocity along the normal in the middle of the substep, m/s, negative.
    speed: f32,
}

/// Two bodies at the time they meet.
#[derive(Clone, Copy, Debug)]
struct Meeting {
    /// Normal, anchors and masses of that time.
    constraint: ContactConstraint<f32>,
    /// Per point, its approach speed u (negative), m/s, if it takes part.
    speeds: [Option<f32>; 2],
    /// Smallest gap of a point that approaches, m.
    gap: f32,
    /// Greatest speed of approach, m/s, positive.
    speed: f32,
    /// Gaps that differ by no more than this are closed together, m.
    tolerance: f32,
}

/// The impacts stage and its buffers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Impacts {
    watched: Watched,
    /// Those that were looked at closely in this step.
    contacts: Vec<BouncyContact>,
    /// By number: where it is among them, `NONE` where it is not.
    places: Vec<u32>,
    /// Scratch: numbers of the contacts that may meet, as the substep begins.
    due: Vec<u32>,
    /// Places of contacts that bounced in this substep, each as often as it did.
    met: Vec<usize>,
    queue: ImpactQueue,
    neighbours: Neighbours,
    neighbours_are_built: bool,
    /// By row: time of the last impact in this substep, s.
    last_impact: Vec<f32>,
    /// Rows with an impact in this substep.
    hit_rows: Vec<u32>,
    count: usize,
}

/// What the stage works on.
#[derive(Debug)]
pub(crate) struct ImpactScene<'a> {
    pub(crate) bodies: &'a mut Bodies,
    pub(crate) contacts: &'a Contacts,
    pub(crate) kicks: &'a Kicks,
    pub(crate) graph: &'a mut ConstraintGraph,
    /// Length of the substep, s.
    pub(crate) h: f32,
    /// Slowest approach that bounces, m/s.
    pub(crate) restitution_threshold: f32,
    /// How many contacts are looked at together.
    pub(crate) width: Width,
}

impl Impacts {
    /// Forgets the contacts of the last step.
    pub(crate) fn clear(&mut self) {
        self.watched.clear();
        self.contacts.clear();
        self.places.clear();
        self.met.clear();
        self.neighbours_are_built = false;
        self.count = 0;
    }

    /// Takes up the contacts of a block that have restitution. Blocks come in the order in which they are solved.
    pub(crate) fn take_up_block(&mut self, place: BlockPlace, bouncy: Marks) {
        self.watched.watch(place, bouncy);
    }

    /// How many contacts may bounce.
    pub(crate) fn len(&self) -> usize {
        self.watched.len()
    }

    /// How many impacts there were in this step.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Contacts that bounced in this step, with the greatest speed of their impacts, m/s; in the order in which they are
    /// solved.
    pub(crate) fn bounced(&self) -> impl Iterator<Item = (u32, f32)> {
        let in_order = self.places.iter().filter_map(|&place| self.contacts.get(place as usize));
        in_order
            .filter(|bouncy| bouncy.greatest_speed > 0.0)
            .map(|bouncy| (bouncy.contact, bouncy.greatest_speed))
    }

    /// Lets everything bounce that meets within this substep, in the order of time. Whether that has moved any body.
    pub(crate) fn run(&mut self, scene: &mut ImpactScene<'_>) -> bool {
        self.last_impact.resize(scene.bodies.row_count(), 0.0);
        self.places.resize(self.watched.end() as usize, NONE);
        for place in self.met.drain(..) {
            self.contacts[place].impacts = 0;
        }
        self.look_at_all(scene);
        while let Some((expected, number)) = self.queue.pop() {
            // Impacts since may have hastened, delayed or cancelled it.
            let approaching = self.contacts[self.place_of(number)].approaching(scene);
            let Some(time) = self.upcoming(number, approaching, scene) else { continue };
            if time > expected {
                self.queue.push(time, number);
            } else {
                self.meet(number, expected, scene);
            }
        }
        let have_moved = !self.hit_rows.is_empty();
        for row in self.hit_rows.drain(..) {
            self.last_impact[row as usize] = 0.0;
        }
        have_moved
    }

    /// Tells the sweeps of all contacts what is to wait for an impact, and expects those that may come.
    fn look_at_all(&mut self, scene: &mut ImpactScene<'_>) {
        let mut due = std::mem::take(&mut self.due);
        let ImpactScene { kicks, h, restitution_threshold, .. } = *scene;
        let substep = Substep { states: &scene.bodies.states, kicks, h, restitution_threshold };
        self.watched.look(scene.width, substep, scene.graph, &mut due);
        for number in due.drain(..) {
            self.expect(number, scene);
        }
        self.due = due;
    }

    /// Where a contact is among those that were looked at.
    fn place_of(&self, number: u32) -> usize {
        self.places[number as usize] as usize
    }

    /// The same, from now on if it was not before.
    fn take_up(&mut self, number: u32, scene: &ImpactScene<'_>) -> usize {
        let place = &mut self.places[number as usize];
        if *place == NONE {
            *place = self.contacts.len() as u32;
            let graph_place = self.watched.graph_place(number);
            let (contact, rows) = (scene.graph.contact_at(graph_place), scene.graph.rows(graph_place));
            self.contacts.push(BouncyContact {
                contact,
                graph_place,
                rows,
                restitution: scene.contacts[contact].restitution,
                threshold: bounce_threshold(rows, graph_place, scene),
                greatest_speed: 0.0,
                impacts: 0,
            });
        }
        *place as usize
    }

    /// Queues the next impact of a contact, if it comes within this substep, and tells the sweeps to leave
    /// alone the points that approach fast but are still apart.
    fn expect(&mut self, number: u32, scene: &mut ImpactScene<'_>) {
        let place = self.take_up(number, scene);
        let approaching = self.contacts[place].approaching(scene);
        let waits = approaching.map(|point| point.is_some_and(|point| point.separation > 0.0));
        self.watched.set_waiting(number, waits, scene.graph);
        if let Some(time) = self.upcoming(number, approaching, scene) {
            self.queue.push(time, number);
        }
    }

    /// When a contact whose points approach so will meet, s, if within this substep.
    fn upcoming(
        &self,
        number: u32,
        approaching: [Option<Approach>; 2],
        scene: &ImpactScene<'_>,
    ) -> Option<f32> {
        if approaching == [None; 2] {
            return None;
        }
        let bouncy = &self.contacts[self.place_of(number)];
        let acceleration = bouncy.acceleration(scene);
        let time_of = |point: Option<Approach>| {
            point.and_then(|point| time_of_impact(point.separation, point.speed, acceleration, scene.h))
        };
        let first = approaching.into_iter().filter_map(time_of).fold(f32::INFINITY, f32::min);
        // Never before an earlier impact of either body: until then it moved otherwise.
        let time = bouncy.rows.iter().fold(first, |time, &row| time.max(self.last_impact[row as usize]));
        (time <= scene.h).then_some(time)
    }

    /// Looks at two bodies at the time they should meet, and lets them bounce if they do.
    fn meet(&mut self, number: u32, time: f32, scene: &mut ImpactScene<'_>) {
        let place = self.place_of(number);
        let bouncy = &mut self.contacts[place];
        bouncy.impacts += 1;
        self.met.push(place);
        let there = bouncy.states_at(time, scene);
        let contact = &scene.contacts[bouncy.contact];
        let manifold = manifold_in(contact, scene.bodies, [&there[0], &there[1]]);
        let Some(meeting) = bouncy.meeting(&manifold, time, &there, scene) else { return };
        if meeting.gap > meeting.tolerance {
            // The surfaces have turned away from each other since: they meet later.
            let later = time + meeting.gap / meeting.speed;
            if later <= scene.h {
                self.queue.push(later, number);
            }
            return;
        }
        let before = bouncy.states(scene);
        let mut after = before;
        bouncy.apply_impulses(&meeting, &mut after);
        if let Some(manifold) = manifold.restricted_to(&contact.manifold) {
            let mut constraint = scene.graph.constraint(bouncy.graph_place);
            constraint.set_manifold_in(&manifold, &there[0], &there[1]);
            scene.graph.set_geometry(bouncy.graph_place, &constraint);
        }
        self.count += 1;
        let moved = scene.graph.moved_rows(bouncy.graph_place);
        self.part(moved, before, after, time, scene);
        self.look_again(moved, scene);
    }

    /// Gives two bodies their velocities after an impact, and moves them by what they would else miss.
    fn part(
        &mut self,
        rows: [u32; 2],
        before: [BodyState; 2],
        after: [BodyState; 2],
        time: f32,
        scene: &mut ImpactScene<'_>,
    ) {
        for ((row, mut state), before) in rows.into_iter().zip(after).zip(before) {
            if row == GROUND_ROW {
                continue;
            }
            drift_until(time, &before, &mut state);
            scene.bodies.states[row as usize] = state;
            self.last_impact[row as usize] = time;
            self.hit_rows.push(row);
        }
    }

    /// Expects the impacts of all contacts of two bodies anew.
    fn look_again(&mut self, rows: [u32; 2], scene: &mut ImpactScene<'_>) {
        if !self.neighbours_are_built {
            self.neighbours_are_built = true;
            self.neighbours.clear(scene.bodies.row_count());
            let (watched, neighbours) = (&self.watched, &mut self.neighbours);
            watched.for_each(|number, place| neighbours.add(number, scene.graph.moved_rows(place)));
        }
        for row in rows {
            let mut place = self.neighbours.last(row);
            while let Some((number, before)) = self.neighbours.get(place) {
                self.expect(number, scene);
                place = before;
            }
        }
    }
}

impl BouncyContact {
    fn states(&self, scene: &ImpactScene<'_>) -> [BodyState; 2] {
        self.rows.map(|row| scene.bodies.states[row as usize])
    }

    /// Per point: how it approaches, if fast enough to bounce.
    fn approaching(&self, scene: &ImpactScene<'_>) -> [Option<Approach>; 2] {
        let constraint = scene.graph.constraint(self.graph_place);
        let pair = self.states(scene);
        [0, 1].map(|index| {
            let (speed, is_fast) = approach(&constraint, index, self.threshold, &pair);
            let [a, b] = &pair;
            (is_fast && self.impacts < IMPACTS_PER_SUBSTEP).then(|| Approach {
                separation: constraint.separation(&constraint.points[index], a, b),
                speed,
            })
        })
    }

    /// Acceleration of b against a along the normal, m/s².
    fn acceleration(&self, scene: &ImpactScene<'_>) -> f32 {
        let [a, b] = self.rows.map(|row| scene.kicks.acceleration(row));
        Vec2::from(scene.graph.constraint(self.graph_place).normal).dot(b - a)
    }

    /// The two bodies where they will be at a time within the substep: x + v t + a t (t - h)/2 for the velocity v
    /// of the middle of the substep.
    fn states_at(&self, time: f32, scene: &ImpactScene<'_>) -> [BodyState; 2] {
        self.rows.map(|row| {
            let mut state = scene.bodies.states[row as usize];
            drift(&mut state, time);
            let bend = scene.kicks.acceleration(row) * (0.5 * time * (time - scene.h));
            state.delta_position = state.delta_position + bend.into();
            state
        })
    }

    /// What of a manifold at a time meets there; `None` if nothing approaches fast enough to bounce.
    fn meeting(
        &self,
        manifold: &Manifold,
        time: f32,
        [a, b]: &[BodyState; 2],
        scene: &ImpactScene<'_>,
    ) -> Option<Meeting> {
        let mut constraint = scene.graph.constraint(self.graph_place);
        constraint.points = Default::default();
        constraint.set_geometry(manifold);
        let [k_a, k_b] = self.rows.map(|row| scene.kicks.acceleration(row));
        let gained = manifold.normal.dot(k_b - k_a) * (time - 0.5 * scene.h);
        let speeds = [0, 1].map(|index| {
            let point = &constraint.points[index];
            let speed = constraint.normal.dot(point.relative_velocity(a, b)) + gained;
            (point.normal_k > 0.0 && speed < -self.threshold).then_some(speed)
        });
        let gap_of = |index: usize| speeds[index].map(|_| constraint.points[index].separation);
        let gap = [0, 1].into_iter().filter_map(gap_of).fold(f32::INFINITY, f32::min);
        let speed = -speeds.into_iter().flatten().fold(0.0, f32::min);
        let tolerance = MEETING_TOLERANCE * speed * scene.h;
        let speeds = [0, 1]
            .map(|index| speeds[index].filter(|_| constraint.points[index].separation <= gap + tolerance));
        (speed > 0.0).then_some(Meeting { constraint, speeds, gap, speed, tolerance })
    }

    /// Turns the approach speed u of each point that takes part into -e u.
    fn apply_impulses(&mut self, meeting: &Meeting, pair: &mut [BodyState; 2]) {
        let constraint = &meeting.constraint;
        let [point_1, point_2] = &constraint.points;
        // The change asked for, u - (-e u), is q of the complementarity problem K x + q ≥ 0.
        let change = meeting.speeds.map(|speed| speed.map(|u| (1.0 + self.restitution) * u));
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
        self.greatest_speed = self.greatest_speed.max(meeting.speed);
    }
}

/// When the gap `s` closes, within [0, h], for mid-substep speed `v` < 0 and acceleration `a`: the first
/// root of s + (v - a h/2) t + a t²/2. At once where there is no gap.
fn time_of_impact(s: f32, v: f32, a: f32, h: f32) -> Option<f32> {
    if s <= 0.0 {
        return Some(0.0);
    }
    let start = v - 0.5 * a * h;
    let discriminant = start * start - 2.0 * a * s;
    if discriminant < 0.0 {
        return None;
    }
    // The form of the root that does not cancel for start < 0, which the threshold on v sees to.
    let time = 2.0 * s / (discriminant.sqrt() - start);
    (time >= 0.0 && time <= h).then_some(time)
}

/// Approach speed, m/s, from which the contact of two rows bounces: the setting, or what support makes up for anyway.
fn bounce_threshold(rows: [u32; 2], graph_place: (u32, u32), scene: &ImpactScene<'_>) -> f32 {
    let normal = Vec2::from(scene.graph.constraint(graph_place).normal);
    let [a, b] = rows.map(|row| scene.kicks.acceleration(row));
    scene.restitution_threshold.max(RESTING_SUBSTEPS * scene.h * normal.dot(b - a).abs())
}
