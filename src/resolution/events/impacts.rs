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
//! all bounced would never bear its weight. What an impact drives into a contact under load, the sweeps pass on: they
//! solve all contacts of a heap together, where impacts in pairs would run to and fro within the substep without end. A
//! cradle passes its blow on in pairs, as its balls touch without load.
//!
//! Cost: one look at every contact with restitution per substep, in lanes, and a heap of the few that may meet; after an
//! impact, a look at the contacts of its two bodies. Many bodies on one would make that the square of their number, so
//! the looks of a substep are bounded too, and the sweeps take what is left. Nothing where no contact has restitution.

use crate::collision::Manifold;
use crate::compute::{self, BodyState, GROUND_ROW};
use crate::math::Vec2;
use crate::resolution::block::{Row, solve_pair};
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::constraint_graph::{BlockIndex, GraphIndex};
use crate::resolution::contact_block::Marks;
use crate::resolution::events::approach::{Look, RESTING_SUBSTEPS, Substep, approach};
use crate::resolution::events::queue::{Expected, ImpactQueue, Neighbours};
use crate::resolution::events::{EventScene, MEETING_TOLERANCE};
use crate::resolution::moving::manifold_in;

/// How often one contact may be met within a substep. More happens only where bodies are wedged, and the sweeps take what
/// is left, as if there were no restitution; or where they turn away from each other for as long as they approach. As
/// often each contact may be looked at again, on average: what happens in a drum takes less than one look, and many bodies
/// that all meet each other would take thousands.
const IMPACTS_PER_SUBSTEP: u8 = 16;

/// A contact that may bounce, and that was looked at closely.
#[derive(Clone, Debug)]
struct BouncyContact {
    /// Index of the contact, and its place in the constraint graph.
    contact: u32,
    home: GraphIndex,
    rows: [u32; 2],
    restitution: f32,
    /// Approach speed from which the contact bounces, m/s.
    threshold: f32,
    /// Greatest speed of an impact in this step, m/s.
    greatest_speed: f32,
    /// Impacts in a substep, and in which: before it there were none.
    impacts: u8,
    substep: u32,
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

/// What a body has been through in this substep.
#[derive(Clone, Copy, Debug, Default)]
struct RowImpacts {
    /// How many impacts.
    count: u32,
    /// Time of the last, s.
    last: f32,
}

/// The impacts stage and its buffers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Impacts {
    /// The blocks of the constraint graph with contacts that may bounce, and how many these are.
    blocks: Vec<BlockIndex>,
    len: usize,
    /// Those that were looked at closely in this step.
    contacts: Vec<BouncyContact>,
    /// By index of a contact: which of them it is; shorter where no later contact was ever looked at.
    places: Vec<Option<u32>>,
    /// Scratch: the contacts that may meet, as the substep begins.
    due: Vec<GraphIndex>,
    queue: ImpactQueue,
    /// Of those that may bounce; empty before the first impact of a step.
    neighbours: Neighbours,
    by_row: Vec<RowImpacts>,
    /// Rows with an impact in this substep.
    hit_rows: Vec<u32>,
    /// Which substep of the step this is.
    substep: u32,
    /// How many contacts of struck bodies may still be looked at in it.
    looks_left: usize,
    count: usize,
}

impl Impacts {
    /// Forgets the contacts of the last step.
    pub(crate) fn clear(&mut self) {
        self.blocks.clear();
        self.neighbours.reset(0);
        (self.len, self.count, self.substep) = (0, 0, 0);
        for bouncy in self.contacts.drain(..) {
            self.places[bouncy.contact as usize] = None;
        }
    }

    /// Takes up the contacts of a block that have restitution.
    pub(crate) fn take_up_block(&mut self, at: BlockIndex, bouncy: Marks) {
        self.blocks.push(at);
        self.len += bouncy.count();
    }

    /// How many contacts may bounce.
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// How many impacts there were in this step.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Contacts that bounced in this step, with the greatest speed of their impacts, m/s.
    pub(crate) fn bounced(&self) -> impl Iterator<Item = (u32, f32)> {
        let bounced = self.contacts.iter().filter(|bouncy| bouncy.greatest_speed > 0.0);
        bounced.map(|bouncy| (bouncy.contact, bouncy.greatest_speed))
    }

    /// Lets everything bounce that meets within this substep, in the order of time. Whether that has moved any body.
    pub(crate) fn run(&mut self, scene: &mut EventScene<'_>) -> bool {
        self.by_row.resize(scene.bodies.row_count(), RowImpacts::default());
        self.substep += 1;
        self.look_at_all(scene);
        self.looks_left = usize::from(IMPACTS_PER_SUBSTEP) * self.len;
        while let Some(expected) = self.queue.pop() {
            if self.looks_left == 0 {
                scene.graph.set_pending(expected.contact, [false; 2]);
                continue;
            }
            // An impact of one of the bodies since then had it expected anew.
            if expected.impacts_before == self.impacts_of(scene.graph.rows(expected.contact)) {
                self.meet(expected, scene);
            }
        }
        let have_moved = !self.hit_rows.is_empty();
        for row in self.hit_rows.drain(..) {
            self.by_row[row as usize] = RowImpacts::default();
        }
        have_moved
    }

    /// Finds the points that are pending, and expects the impacts that may come.
    fn look_at_all(&mut self, scene: &mut EventScene<'_>) {
        let mut due = std::mem::take(&mut self.due);
        let EventScene { kicks, scheme, .. } = *scene;
        let substep = Substep {
            states: &scene.bodies.states,
            kicks,
            h: scheme.substep_time(),
            restitution_threshold: scheme.restitution_threshold,
        };
        let look = Look { blocks: &self.blocks, substep, graph: scene.graph, due: &mut due };
        compute::run(scheme.width, look);
        for contact in due.drain(..) {
            self.expect(contact, scene);
        }
        self.due = due;
    }

    /// How many impacts two bodies have been through in this substep.
    fn impacts_of(&self, rows: [u32; 2]) -> u32 {
        rows.iter().map(|&row| self.by_row[row as usize].count).sum()
    }

    /// The contact at a place of the graph as one that was looked at closely, from now on if it was not before.
    fn look_closely(
        &mut self,
        home: GraphIndex,
        constraint: &ContactConstraint<f32>,
        scene: &EventScene<'_>,
    ) -> &mut BouncyContact {
        let contact = scene.graph.contact_at(home);
        if self.places.len() <= contact as usize {
            self.places.resize(scene.contacts.greatest_index() as usize + 1, None);
        }
        let place = *self.places[contact as usize].get_or_insert_with(|| {
            let rows = scene.graph.rows(home);
            // The setting, or what support makes up for anyway.
            let acceleration = Vec2::from(constraint.normal).dot(scene.acceleration(rows)).abs();
            self.contacts.push(BouncyContact {
                contact,
                home,
                rows,
                restitution: scene.contacts[contact].restitution,
                threshold: scene
                    .scheme
                    .restitution_threshold
                    .max(RESTING_SUBSTEPS * scene.h() * acceleration),
                greatest_speed: 0.0,
                impacts: 0,
                substep: 0,
            });
            self.contacts.len() as u32 - 1
        });
        let (bouncy, substep) = (&mut self.contacts[place as usize], self.substep);
        if bouncy.substep != substep {
            (bouncy.substep, bouncy.impacts) = (substep, 0);
        }
        bouncy
    }

    /// Queues the next impact of a contact, if it comes within this substep, and marks the points that approach fast but
    /// are still apart as pending.
    fn expect(&mut self, contact: GraphIndex, scene: &mut EventScene<'_>) {
        let (rows, block, place) = scene.graph.block(contact);
        let (rows, constraint) = (rows.get(place), block.load(place));
        let pair = scene.states(rows);
        let least = scene.scheme.restitution_threshold;
        let mut speeds = [0, 1].map(|index| approaching(&constraint, index, least, &pair));
        if speeds != [None; 2] {
            let bouncy = self.look_closely(contact, &constraint, scene);
            let (threshold, may_bounce) = (bouncy.threshold, bouncy.impacts < IMPACTS_PER_SUBSTEP);
            speeds = speeds.map(|speed| speed.filter(|&speed| may_bounce && speed < -threshold));
        }
        if speeds == [None; 2] {
            return scene.graph.set_pending(contact, [false; 2]);
        }
        let (h, [a, b]) = (scene.h(), &pair);
        let separations = [0, 1].map(|index| constraint.separation(&constraint.points[index], a, b));
        let is_pending = [0, 1].map(|index| speeds[index].is_some() && separations[index] > 0.0);
        scene.graph.set_pending(contact, is_pending);
        let acceleration = Vec2::from(constraint.normal).dot(scene.acceleration(rows));
        let time_of = |index: usize| time_of_impact(separations[index], speeds[index]?, acceleration, h);
        let first = [0, 1].into_iter().filter_map(time_of).fold(f32::INFINITY, f32::min);
        // Never before an earlier impact of either body: until then it moved otherwise.
        let time = rows.iter().fold(first, |time, &row| time.max(self.by_row[row as usize].last));
        if time <= h {
            self.queue.push(Expected { time, contact, impacts_before: self.impacts_of(rows) });
        }
    }

    /// Looks at two bodies at the time they should meet, and lets them bounce if they do.
    fn meet(&mut self, expected: Expected, scene: &mut EventScene<'_>) {
        let Expected { time, contact: home, .. } = expected;
        let contact = scene.graph.contact_at(home);
        let Some(place) = self.places[contact as usize] else { return };
        let bouncy = &mut self.contacts[place as usize];
        if bouncy.impacts == IMPACTS_PER_SUBSTEP {
            return;
        }
        bouncy.impacts += 1;
        let there = bouncy.states_at(time, scene);
        let contact = &scene.contacts[contact];
        let manifold = manifold_in(contact, scene.bodies, [&there[0], &there[1]]);
        let Some(meeting) = bouncy.meeting(&manifold, time, &there, scene) else { return };
        if meeting.gap > meeting.tolerance {
            // The surfaces have turned away from each other since: they meet later.
            let later = time + meeting.gap / meeting.speed;
            if later <= scene.h() {
                self.queue.push(Expected { time: later, ..expected });
            }
            return;
        }
        let mut after = scene.states(bouncy.rows);
        bouncy.apply_impulses(&meeting, &mut after);
        if manifold.has_features_of(&contact.manifold) {
            scene.graph.set_geometry(home, &meeting.constraint);
        } else if let Some(manifold) = manifold.restricted_to(&contact.manifold) {
            let mut constraint = meeting.constraint;
            constraint.set_manifold_in(&manifold, &there[0], &there[1]);
            scene.graph.set_geometry(home, &constraint);
        }
        self.count += 1;
        let moved = scene.graph.moved_rows(home);
        scene.change_velocities(moved, after, time);
        for row in moved.into_iter().filter(|&row| row != GROUND_ROW) {
            let of_row = &mut self.by_row[row as usize];
            *of_row = RowImpacts { count: of_row.count + 1, last: time };
            self.hit_rows.push(row);
        }
        self.expect(home, scene);
        self.look_again(moved, home, scene);
    }

    /// Expects the impacts of the other contacts of two bodies anew, but for those under load.
    fn look_again(&mut self, rows: [u32; 2], own: GraphIndex, scene: &mut EventScene<'_>) {
        let mut neighbours = std::mem::take(&mut self.neighbours);
        if neighbours.is_empty() {
            neighbours.reset(scene.bodies.row_count());
            for &at in &self.blocks {
                let (_, block) = scene.graph.block_at(at);
                block.marks.bouncy.for_each(|place| {
                    let contact = at.contact(place);
                    neighbours.add(contact, scene.graph.moved_rows(contact));
                });
            }
        }
        for contact in rows.into_iter().flat_map(|row| neighbours.of(row)) {
            self.looks_left = self.looks_left.saturating_sub(1);
            if contact != own && !scene.graph.is_loaded(contact) {
                self.expect(contact, scene);
            }
        }
        self.neighbours = neighbours;
    }
}

/// Speed of a point along the normal in the middle of the substep, m/s, negative, if it approaches fast enough to bounce.
fn approaching(
    constraint: &ContactConstraint<f32>,
    index: usize,
    threshold: f32,
    pair: &[BodyState; 2],
) -> Option<f32> {
    let (speed, is_fast) = approach(constraint, index, threshold, pair);
    is_fast.then_some(speed)
}

impl BouncyContact {
    /// The two bodies where they will be at a time within the substep: x + v t + a t (t - h)/2 for the velocity v
    /// of the middle of the substep.
    fn states_at(&self, time: f32, scene: &EventScene<'_>) -> [BodyState; 2] {
        let mut states = scene.states_at(self.rows, time);
        for (row, state) in self.rows.into_iter().zip(&mut states) {
            let bend = scene.kicks.acceleration(row) * (0.5 * time * (time - scene.h()));
            state.delta_position = state.delta_position + bend.into();
        }
        states
    }

    /// What of a manifold at a time meets there; `None` if nothing approaches fast enough to bounce.
    fn meeting(
        &self,
        manifold: &Manifold,
        time: f32,
        [a, b]: &[BodyState; 2],
        scene: &EventScene<'_>,
    ) -> Option<Meeting> {
        let mut constraint = scene.graph.constraint(self.home);
        constraint.set_manifold_in(manifold, a, b);
        let gained = manifold.normal.dot(scene.acceleration(self.rows)) * (time - 0.5 * scene.h());
        let mut speeds = [None; 2];
        let mut gaps = [f32::INFINITY; 2];
        for (index, there) in manifold.points().iter().enumerate() {
            let point = &constraint.points[index];
            let speed = constraint.normal.dot(point.relative_velocity(a, b)) + gained;
            if speed < -self.threshold {
                (speeds[index], gaps[index]) = (Some(speed), there.separation);
            }
        }
        let gap = gaps[0].min(gaps[1]);
        let speed = -speeds.into_iter().flatten().fold(0.0, f32::min);
        let tolerance = MEETING_TOLERANCE * speed * scene.h();
        let speeds = [0, 1].map(|index| speeds[index].filter(|_| gaps[index] <= gap + tolerance));
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

#[cfg(test)]
mod tests {
    use super::time_of_impact;

    /// A gap that closes with the speed u at its start and the acceleration a is s + u t + a t²/2; v is the speed of the
    /// middle of the substep. Numbers of order 1, a dozen roundings.
    #[test]
    fn bodies_meet_when_the_gap_is_closed() {
        let h = 0.01;
        for (gap, v, a) in [(0.004, -1.0, 0.0), (0.004, -1.0, 9.81), (0.004, -1.0, -9.81), (1e-5, -0.2, 20.0)]
        {
            let time = time_of_impact(gap, v, a, h).expect("they meet within the substep");
            let left = gap + (v - 0.5 * a * h) * time + 0.5 * a * time * time;
            assert!(left.abs() < 1e-6 * gap + 1e-9, "gap {gap}, {v} m/s, {a} m/s²: {left} m left");
        }
    }

    #[test]
    fn what_overlaps_meets_at_once_and_what_is_too_far_or_turns_back_does_not() {
        assert_eq!(time_of_impact(-0.001, -1.0, 0.0, 0.01), Some(0.0));
        assert_eq!(time_of_impact(0.02, -1.0, 0.0, 0.01), None);
        // It comes nearer by 0.1²/(2 · 400) m = 12.5 µm, of 1 mm.
        assert_eq!(time_of_impact(0.001, -0.1 + 0.5 * 400.0 * 0.01, 400.0, 0.01), None);
    }
}
