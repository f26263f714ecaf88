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
//! cradle passes its blow on in pairs, as its balls touch without load. What stands on the ground and touches nothing else bounces off it, whatever
//! load it is.
//!
//! Cost: one look at every contact with restitution per substep, in lanes, and a heap of the few that may meet; after an
//! impact, a look at the contacts of its two bodies. Many bodies on one would make that the square of their number, so
//! the looks of a substep are bounded too, and the sweeps take what is left. Nothing where no contact has restitution.

use crate::compute::{self, BodyState, GROUND_ROW};
use crate::resolution::blows::Impact;
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::constraint_graph::{BlockIndex, GraphIndex};
use crate::resolution::contact_block::Marks;
use crate::resolution::events::EventScene;
use crate::resolution::events::approach::{Look, Substep, approach};
use crate::resolution::events::meeting::Meeting;
use crate::resolution::events::queue::{Expected, ImpactQueue, Neighbours};
use crate::resolution::moving::manifold_in;

/// How often two bodies may be struck within a substep before their contact is left to the sweeps, as if there were no
/// restitution: it is the one that was struck less that counts. More happens only where bodies are wedged.
const STRIKES_PER_SUBSTEP: u32 = 16;

/// How often each contact may be looked at in a substep, on average, before the sweeps take what is left: what happens in
/// a drum takes less than one look, a blow that runs through a cradle takes three, and many bodies that all meet each other
/// would take thousands.
const LOOKS_PER_CONTACT: usize = 16;

/// How many looks may find that two bodies do not meet yet, as their surfaces turn away from each other; then they meet in
/// the next substep. Each closes the gap but for what they turn meanwhile, so that more than a few find bodies that spin as
/// fast as they approach.
const LOOKS_IN_VAIN: u8 = 16;

/// The impacts stage and its buffers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Impacts {
    /// The blocks of the constraint graph with contacts that may bounce, and how many these are.
    blocks: Vec<BlockIndex>,
    len: usize,
    /// Scratch: the contacts that may meet, as the substep begins.
    due: Vec<GraphIndex>,
    queue: ImpactQueue,
    /// Of those that may bounce; empty before the first impact of a step.
    neighbours: Neighbours,
    /// How many looks at contacts are left in this substep.
    looks_left: usize,
}

impl Impacts {
    /// Forgets the contacts of the last step.
    pub(crate) fn clear(&mut self) {
        self.blocks.clear();
        self.neighbours.reset(0);
        self.len = 0;
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

    /// Lets everything bounce that meets within this substep, in the order of time. Whether that has moved any body.
    pub(crate) fn run(&mut self, scene: &mut EventScene<'_>) -> bool {
        self.look_at_all(scene);
        self.looks_left = LOOKS_PER_CONTACT * self.len;
        while let Some(expected) = self.queue.pop() {
            if self.looks_left == 0 {
                scene.graph.set_pending(expected.contact, [false; 2]);
                continue;
            }
            // An impact of one of the bodies since then had it expected anew.
            if expected.impacts_before == impacts_of(scene.graph.rows(expected.contact), scene) {
                self.meet(expected, scene);
            }
        }
        !scene.strikes.are_none()
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

    /// Queues the next impact of a contact, if it comes within this substep.
    fn expect(&mut self, contact: GraphIndex, scene: &mut EventScene<'_>) {
        let Some(Approach { rows, gaps, speeds, accelerations }) = Self::mark(contact, scene) else { return };
        let h = scene.h();
        let time_of = |index: usize| closing_time(gaps[index], speeds[index]?, accelerations[index], h);
        let first = [0, 1].into_iter().filter_map(time_of).fold(f32::INFINITY, f32::min);
        // Never before an earlier impact of either body: until then it moved otherwise.
        let earliest = rows.iter().fold(0.0, |last: f32, &row| last.max(scene.strikes.last(row)));
        let time = first.max(earliest);
        let colliders = scene.contacts[scene.graph.contact_at(contact)].colliders;
        if time <= h && !scene.is_for_continuous(colliders, time) {
            let impacts_before = impacts_of(rows, scene);
            self.queue.push(Expected { time, contact, impacts_before, looks_in_vain: 0 });
        }
    }

    /// Marks the points of a contact as pending that approach fast enough to bounce but are still apart. How they approach,
    /// if they do so that fast.
    #[inline(always)]
    fn mark(contact: GraphIndex, scene: &mut EventScene<'_>) -> Option<Approach> {
        let approach = Approach::of(contact, scene);
        let is_pending = |index: usize| {
            approach.as_ref().is_some_and(|found| found.speeds[index].is_some() && found.gaps[index] > 0.0)
        };
        scene.graph.set_pending(contact, [0, 1].map(is_pending));
        approach
    }

    /// Looks at two bodies at the time they should meet, and lets them bounce if they do.
    fn meet(&mut self, expected: Expected, scene: &mut EventScene<'_>) {
        let Expected { time, contact: home, looks_in_vain, .. } = expected;
        let (index, rows) = (scene.graph.contact_at(home), scene.graph.rows(home));
        let contact = &scene.contacts[index];
        let there = scene.bent_states_at(rows, time);
        let manifold = manifold_in(contact.colliders, scene.bodies, [&there[0], &there[1]]);
        let mut constraint = scene.graph.constraint(home);
        constraint.set_manifold_in(&manifold, &there[0], &there[1]);
        let accelerations = scene.accelerations(&constraint, rows);
        let gained = accelerations.map(|acceleration| acceleration * (time - 0.5 * scene.h()));
        let thresholds = scene.bounce_thresholds(accelerations);
        let gaps = [0, 1].map(|index| manifold.points().get(index).map(|point| point.separation));
        let meeting = Meeting::new(constraint, gaps, &there, gained, thresholds, scene.h());
        let Some(meeting) = meeting else { return };
        if !meeting.is_now() {
            // The surfaces have turned away from each other since: they meet later.
            let later = time + meeting.gap / meeting.fastest;
            let may_look_again = looks_in_vain < LOOKS_IN_VAIN && later <= scene.h();
            if may_look_again && !scene.is_for_continuous(contact.colliders, later) {
                self.queue.push(Expected { time: later, looks_in_vain: looks_in_vain + 1, ..expected });
            }
            return;
        }
        let are_moved = scene.graph.moved_rows(home).map(|row| row != GROUND_ROW);
        let collision =
            scene.collide(contact.colliders, are_moved, &meeting, contact.mixed.restitution, time);
        let asked = (!contact.is_touching).then_some(home);
        scene.blows.note(Impact { contact: index, collision }, asked, scene.graph);
        if manifold.has_features_of(&contact.manifold) {
            scene.graph.set_geometry(home, &constraint);
        } else if let Some(manifold) = manifold.restricted_to(&contact.manifold) {
            constraint.set_manifold_in(&manifold, &there[0], &there[1]);
            scene.graph.set_geometry(home, &constraint);
        }
        let moved = scene.graph.moved_rows(home);
        for row in moved.into_iter().filter(|&row| row != GROUND_ROW) {
            scene.strikes.count_impact(row);
        }
        self.expect(home, scene);
        self.look_again(moved, home, scene);
    }

    /// Expects the impacts of the other contacts of two bodies anew, but for those under load. A body that is alone on the ground bounces off that
    /// nevertheless, as no heap has to share the blow. Whether it is alone only those of its contacts tell that have restitution.
    fn look_again(&mut self, rows: [u32; 2], own: GraphIndex, scene: &mut EventScene<'_>) {
        let neighbours = self.take_neighbours(scene);
        for row in rows {
            let is_in_heap = |contact| {
                scene.graph.is_loaded(contact) && !scene.graph.moved_rows(contact).contains(&GROUND_ROW)
            };
            let is_alone = !neighbours.of(row).any(is_in_heap);
            for contact in neighbours.of(row) {
                self.looks_left = self.looks_left.saturating_sub(1);
                if contact != own && (is_alone || !scene.graph.is_loaded(contact)) {
                    self.expect(contact, scene);
                }
            }
        }
        self.neighbours = neighbours;
    }

    /// Marks the points of all contacts of a body anew, but for those under load, as its velocity has changed. A body that is
    /// alone on the ground is no exception: it is swept, and meets the ground so.
    pub(super) fn mark_again(&mut self, row: u32, scene: &mut EventScene<'_>) {
        if self.len == 0 {
            return;
        }
        let neighbours = self.take_neighbours(scene);
        for contact in neighbours.of(row) {
            if !scene.graph.is_loaded(contact) {
                Self::mark(contact, scene);
            }
        }
        self.neighbours = neighbours;
    }

    /// The contacts that may bounce by the rows that they move, found as they are first asked for.
    fn take_neighbours(&mut self, scene: &EventScene<'_>) -> Neighbours {
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
        neighbours
    }
}

/// How many impacts two bodies have been through in this substep.
fn impacts_of(rows: [u32; 2], scene: &EventScene<'_>) -> u32 {
    rows.into_iter().map(|row| scene.strikes.impacts(row)).sum()
}

/// Whether two bodies were struck so often that the sweeps take what is left between them.
fn are_wedged(rows: [u32; 2], scene: &EventScene<'_>) -> bool {
    let moved = rows.into_iter().filter(|&row| row != GROUND_ROW);
    moved.map(|row| scene.strikes.impacts(row)).min().is_some_and(|least| least >= STRIKES_PER_SUBSTEP)
}

/// How a contact approaches that may bounce.
struct Approach {
    rows: [u32; 2],
    /// Per point, m.
    gaps: [f32; 2],
    /// Of the points that approach fast enough, m/s, negative.
    speeds: [Option<f32>; 2],
    /// Per point, of b against a along the normal, m/s².
    accelerations: [f32; 2],
}

impl Approach {
    /// How the points of a contact approach, if any does so fast enough to bounce.
    #[inline(always)]
    fn of(contact: GraphIndex, scene: &EventScene<'_>) -> Option<Self> {
        let (rows, block, place) = scene.graph.block(contact);
        let rows = rows.get(place);
        let pair = scene.states(rows);
        let least = scene.scheme.restitution_threshold;
        // Most do not approach. Of the constraint, whose columns are a cache line each, only what tells that is read before the rest.
        let speeds = [0, 1].map(|index| approaching(&block.load(place), index, least, &pair));
        if speeds == [None; 2] {
            return None;
        }
        let constraint = scene.graph.constraint(contact);
        let accelerations = scene.accelerations(&constraint, rows);
        let thresholds = scene.bounce_thresholds(accelerations);
        let is_wedged = are_wedged(scene.graph.moved_rows(contact), scene);
        let speeds =
            [0, 1].map(|index| speeds[index].filter(|&speed| speed < -thresholds[index] && !is_wedged));
        if speeds == [None; 2] {
            return None;
        }
        let gaps = constraint.points.map(|point| constraint.separation(&point, &pair[0], &pair[1]));
        Some(Self { rows, gaps, speeds, accelerations })
    }
}

/// Speed of a point along the normal in the middle of the substep, m/s, negative, if it approaches fast enough to bounce.
#[inline(always)]
fn approaching(
    constraint: &ContactConstraint<f32>,
    index: usize,
    threshold: f32,
    pair: &[BodyState; 2],
) -> Option<f32> {
    let (speed, is_fast) = approach(constraint, index, threshold, pair);
    is_fast.then_some(speed)
}

/// When the gap `s` closes, within [0, h], for mid-substep speed `v` < 0 and acceleration `a`: the first
/// root of s + (v - a h/2) t + a t²/2. At once where there is no gap.
fn closing_time(s: f32, v: f32, a: f32, h: f32) -> Option<f32> {
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
    use super::closing_time;

    /// A gap that closes with the speed u at its start and the acceleration a is s + u t + a t²/2; v is the speed of the
    /// middle of the substep. A dozen roundings of numbers as large as the gap.
    #[test]
    fn bodies_meet_when_the_gap_is_closed() {
        let h = 0.01;
        for (gap, v, a) in [(0.004, -1.0, 0.0), (0.004, -1.0, 9.81), (0.004, -1.0, -9.81), (1e-5, -0.2, 20.0)]
        {
            let time = closing_time(gap, v, a, h).expect("they meet within the substep");
            let left = gap + (v - 0.5 * a * h) * time + 0.5 * a * time * time;
            assert!(left.abs() < 1e-6 * gap + 1e-9, "gap {gap}, {v} m/s, {a} m/s²: {left} m left");
        }
    }

    #[test]
    fn what_overlaps_meets_at_once_and_what_is_too_far_or_turns_back_does_not() {
        assert_eq!(closing_time(-0.001, -1.0, 0.0, 0.01), Some(0.0));
        assert_eq!(closing_time(0.02, -1.0, 0.0, 0.01), None);
        // It comes nearer by 0.1²/(2 · 400) m = 12.5 µm, of 1 mm.
        assert_eq!(closing_time(0.001, -0.1 + 0.5 * 400.0 * 0.01, 400.0, 0.01), None);
    }
}
