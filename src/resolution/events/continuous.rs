//! Continuous collision: bodies that are off course are swept, so that nothing passes through anything.
//!
//! A body whose velocity was changed within the step, or that spins fast, is swept along its way in the substep, against
//! everything that is near it: a question to the tree for that body only. What it meets is met at its time, with restitution
//! and friction, and goes on from there with the rest of the substep; both bodies are then swept anew. This goes on in the
//! order of time until nothing meets any more.
//!
//! Of a body of several shapes each is swept: the slots of pairs are here those of shapes.
//!
//! What has touched before is for the sweeps of the solver, which know the whole heap: a pair under load, or without
//! restitution, is met again only if it would go deeper by a good part of its width.
//!
//! Cost: nothing where nobody is off course; else a question to the tree per body and event, and a test for each pair whose
//! circles meet. Once the tests of a substep are spent, each body is stopped at the surface of what it meets next. It keeps its
//! velocity: the rest of the substep is lost for it, but nothing passes.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::body::NONE;
use crate::collision::broad_phase::Tree;
use crate::collision::{Swept, gap_between, is_flat, noise_of, time_of_impact};
use crate::compute::{BodyState, LaneVec2};
use crate::math::{Aabb, Rot, Vec2};
use crate::resolution::blows::{Collision, Impact};
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::events::EventScene;
use crate::resolution::events::impacts::Impacts;
use crate::resolution::events::meeting::Meeting;
use crate::resolution::events::traveller::{Traveller, arm_in, circles_meet};
use crate::resolution::integrate::drift;
use crate::resolution::moving::manifold_in;
use crate::store::PairSet;

/// How many pairs may be tested in a substep of the length that is asked for, for each body that is off course, and beside. A disc that
/// bounces to and fro between two walls at 10 km/s takes a hundred, a heap that is struck some ten for each body. With 16 and 256 a body
/// leaves a box with a fast paddle, which presses on what was stopped.
const TESTS_PER_TRAVELLER: usize = 128;
const TESTS_BESIDE: usize = 1024;

/// Points meet that are within this share of the width of the thinner body, no unit, and rounding: what turns
/// ends within half of that. Of a long box that touches with one end, the other end is not there yet.
const MEETS_WITHIN: f32 = 2e-3;

/// A body is wedged that is struck so often in a row, at intervals below a part [`QUICK`] of the substep, as each bounce is weaker than
/// the last: it is struck on as if there were no restitution. Without this rule heaps that are rammed take a quarter more instructions. If it were
/// stopped, five of a hundred of them would be crushed by up to 5 cm.
const QUICK_STRIKES: u32 = 16;
const QUICK: f32 = 1.0 / 256.0;

/// Two bodies without a contact that met within the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Encounter {
    /// Slots of a and b; a is the smaller.
    pub(crate) slots: [u32; 2],
    pub(crate) collision: Collision,
    /// Whether they had not met before in this step.
    pub(crate) is_first: bool,
}

/// A meeting to come: its time, s, as bits, which sort as the numbers do, the two bodies, and the versions of their ways.
type Queued = (u32, [u32; 2], [u32; 2]);

/// The stage and its buffers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Continuous {
    travellers: Vec<Traveller>,
    /// By row: its traveller, or `NONE`.
    by_row: Vec<u32>,
    /// The boxes of the ways of travellers, by slot.
    ways: Tree,
    queue: BinaryHeap<Reverse<Queued>>,
    encounters: Vec<Encounter>,
    /// The pairs of them.
    encountered: PairSet,
    /// Scratch: the rows of those that are off course as the stage begins.
    off_course: Vec<u32>,
    tests_left: usize,
    /// Scratch: what is near a way.
    near: Vec<u32>,
}

impl Continuous {
    /// Forgets the pairs of the last step.
    pub(crate) fn clear(&mut self) {
        for Encounter { slots: [a, b], .. } in self.encounters.drain(..) {
            self.encountered.remove(a, b);
        }
    }

    /// Hands over the pairs without contacts that met in this step, in the order of time.
    pub(crate) fn take_encounters(&mut self) -> Vec<Encounter> {
        std::mem::take(&mut self.encounters)
    }

    /// Takes back the memory of the pairs that were handed over.
    pub(crate) fn give_back(&mut self, encounters: Vec<Encounter>) {
        self.encounters = encounters;
        self.clear();
    }

    /// Pairs without contacts that met in this step, in the order of time.
    pub(crate) fn encounters(&self) -> &[Encounter] {
        &self.encounters
    }

    /// Sweeps those that are off course, before bodies move.
    pub(crate) fn run(&mut self, scene: &mut EventScene<'_>, impacts: &mut Impacts) {
        let mut off = std::mem::take(&mut self.off_course);
        scene.courses.find_off(scene.bodies, &mut off);
        if !off.is_empty() {
            self.by_row.resize(scene.bodies.row_count(), NONE);
            let most = TESTS_BESIDE + TESTS_PER_TRAVELLER * off.len();
            self.tests_left = most * scene.scheme.asked_substeps as usize / scene.scheme.substeps as usize;
            for &row in &off {
                let state = &mut scene.bodies.states[row as usize];
                let from = scene.strikes.resume(row, state, scene.scheme.limits);
                self.take_up(row, from, scene);
            }
            for index in 0..off.len() {
                self.look(index, |other| other < index, scene);
            }
            while let Some(Reverse((bits, slots, versions))) = self.queue.pop() {
                if versions == self.versions(slots, scene) {
                    self.meet(f32::from_bits(bits), slots, scene, impacts);
                }
            }
            self.finish(scene);
        }
        self.off_course = off;
    }

    /// Puts those that were stopped where the move takes them to their place, and lets all go.
    fn finish(&mut self, scene: &mut EventScene<'_>) {
        for traveller in self.travellers.drain(..) {
            let row = traveller.row;
            self.by_row[row as usize] = NONE;
            traveller.stop(scene.h(), scene.kicks, &mut scene.bodies.states[row as usize]);
        }
        self.ways.clear();
    }

    /// Takes up the body in a row, whose way is straight from a time on, s; returns its index.
    fn take_up(&mut self, row: u32, from: f32, scene: &EventScene<'_>) -> usize {
        let index = self.travellers.len();
        let slot = scene.bodies.slot_of_row(row as usize);
        self.by_row[row as usize] = index as u32;
        self.travellers.push(Traveller::new(row, slot, from));
        self.travellers[index].leaf = self.ways.insert(self.way_of(index, scene), slot);
        index
    }

    /// The traveller in a row, if there is one.
    fn traveller(&self, row: u32) -> Option<&Traveller> {
        self.travellers.get(*self.by_row.get(row as usize)? as usize)
    }

    /// The body in a slot at a time of the substep, s, with the velocity of its way from there on.
    fn state_at(&self, slot: u32, time: f32, scene: &EventScene<'_>) -> BodyState {
        let row = scene.bodies.motions[slot as usize].row;
        if let Some(Traveller { halted: Some(there), .. }) = self.traveller(row) {
            return *there;
        }
        let mut state = scene.state(row);
        drift(&mut state, time);
        state
    }

    /// From when on the way of the body in a slot is straight, s.
    fn from(&self, slot: u32, scene: &EventScene<'_>) -> f32 {
        self.traveller(scene.bodies.motions[slot as usize].row).map_or(0.0, |traveller| traveller.from)
    }

    fn versions(&self, slots: [u32; 2], scene: &EventScene<'_>) -> [u32; 2] {
        slots.map(|slot| {
            self.traveller(scene.bodies.motions[slot as usize].row).map_or(0, |traveller| traveller.version)
        })
    }

    /// The box around what is left of the way of a traveller.
    fn way_of(&self, index: usize, scene: &EventScene<'_>) -> Aabb {
        let Traveller { slot, from, .. } = self.travellers[index];
        let motion = &scene.bodies.motions[slot as usize];
        let state = self.state_at(slot, from, scene);
        let extent = Vec2::new(motion.extent, motion.extent);
        let aabb = Aabb::around(motion.pose.center + state.delta_position.to_vec2(), -extent, extent);
        aabb.swept(state.velocity.to_vec2() * (scene.h() - from))
    }

    /// Sweeps a traveller against everything near its way, but for the travellers that have done so with it.
    fn look(&mut self, index: usize, has_done_so: impl Fn(usize) -> bool, scene: &EventScene<'_>) {
        let Traveller { slot, row, .. } = self.travellers[index];
        let way = self.ways.aabb(self.travellers[index].leaf);
        let mut near = std::mem::take(&mut self.near);
        let index_of = |slot: u32| self.by_row[scene.bodies.motions[slot as usize].row as usize];
        scene.broad_phase.query(way, |other| {
            if index_of(other) == NONE {
                near.push(other);
            }
            true
        });
        self.ways.query(way, |other| {
            if other != slot && !has_done_so(index_of(other) as usize) {
                near.extend(scene.bodies.colliders(other));
            }
            true
        });
        let bodies = &*scene.bodies;
        let is_moved = bodies.states[row as usize].is_moving();
        for own in bodies.colliders(slot) {
            for &other in &near {
                let may_meet =
                    bodies.may_collide(own, other) && !scene.joints.part(slot, bodies.body_of(other));
                if may_meet && (is_moved || bodies.is_awake(other)) {
                    self.expect([own.min(other), own.max(other)], None, scene);
                }
            }
        }
        near.clear();
        self.near = near;
    }

    /// Two bodies as the test sees them, the centre of b from that of a, m, and its velocity against it, m/s.
    fn swept<'s>(
        scene: &'s EventScene<'_>,
        slots: [u32; 2],
        [a, b]: &[BodyState; 2],
    ) -> ([Swept<'s>; 2], Vec2, Vec2) {
        let bodies = &*scene.bodies;
        let of = |slot: u32, state: &BodyState| Swept {
            shape: &bodies.shapes[slot as usize],
            rotation: Rot { c: state.delta_rotation.c, s: state.delta_rotation.s }
                * bodies.motions[slot as usize].pose.rotation,
            spin: state.angular_velocity,
            arm: arm_in(bodies.arm(slot), state),
        };
        let moved = (b.delta_position - a.delta_position).to_vec2();
        let mut offset = (bodies.center(slots[1]) - bodies.center(slots[0])) + moved;
        if let Some(arms) = bodies.arms(slots) {
            offset += (arm_in(arms[1], b) - arms[1]) - (arm_in(arms[0], a) - arms[0]);
        }
        ([of(slots[0], a), of(slots[1], b)], offset, (b.velocity - a.velocity).to_vec2())
    }

    /// Queues the next meeting of two bodies, if it comes within this substep, and later than a time, s, if there is one.
    fn expect(&mut self, slots: [u32; 2], after: Option<f32>, scene: &EventScene<'_>) {
        let h = scene.h();
        let from = slots.map(|slot| self.from(slot, scene)).into_iter().fold(after.unwrap_or(0.0), f32::max);
        let pair = slots.map(|slot| self.state_at(slot, from, scene));
        let motions = slots.map(|slot| &scene.bodies.motions[slot as usize]);
        let ([a, b], offset, velocity) = Self::swept(scene, slots, &pair);
        // What finds a circle flat has its contact, as the box of that is all around.
        if is_flat(motions.map(|motion| (motion.is_circle, motion.extent))) {
            return;
        }
        // What goes round its body leaves the straight way by no more than its arm twice.
        let reach = |side: usize| motions[side].extent + 2.0 * [a, b][side].arm.length();
        if !circles_meet(offset, velocity * (h - from), reach(0) + reach(1)) {
            return;
        }
        if !scene.may_come_much_nearer(slots, &pair, h - from) && scene.contact_of(slots).is_some() {
            return;
        }
        self.tests_left = self.tests_left.saturating_sub(1);
        let Some(mut time) = time_of_impact(a, b, offset, velocity, h - from, 0.0) else { return };
        if scene.is_passing(slots, &slots.map(|slot| self.state_at(slot, from + time, scene))) {
            return;
        }
        if time == 0.0 && !self.bounce_now(slots, from, scene) {
            let thickness = motions[0].thickness.min(motions[1].thickness);
            let deeper = scene.much_nearer(slots) * thickness;
            let deepest = Self::gap_before(slots, scene).min(-deeper);
            let rounding = scene.rounding(slots, &pair) * (h - from);
            let goes_on =
                |meeting: Meeting| meeting.speed() * (h - from) > MEETS_WITHIN * thickness + rounding;
            let Some(mut later) = time_of_impact(a, b, offset, velocity, h - from, deepest) else { return };
            if later == 0.0 && !self.meeting(slots, from, scene).is_some_and(|met| goes_on(met.meeting)) {
                // They turn, and another corner may come.
                let deepest = gap_between(a, b, offset).unwrap_or(0.0) - deeper;
                later = match time_of_impact(a, b, offset, velocity, h - from, deepest) {
                    Some(later) => later,
                    None => return,
                };
            }
            time = later;
        }
        // Where the rounding of places is a good part of their width, they would be found to meet there without end.
        if after.is_some_and(|after| from + time <= after) {
            return;
        }
        // Positive zero, whose bits are the smallest.
        let bits = (from + time + 0.0).to_bits();
        self.queue.push(Reverse((bits, slots, self.versions(slots, scene))));
    }

    /// The distance of two bodies as the step began, m, negative where they overlapped.
    pub(super) fn gap_before(slots: [u32; 2], scene: &EventScene<'_>) -> f32 {
        let ([a, b], offset, _) = Self::swept(scene, slots, &[BodyState::REST; 2]);
        gap_between(a, b, offset).unwrap_or(0.0)
    }

    /// The restitution with which two bodies bounce if they approach fast: 0 under load, and of the wedged.
    fn restitution(&self, slots: [u32; 2], scene: &EventScene<'_>) -> f32 {
        let restitution = scene.mixed(slots).restitution;
        let bounces = restitution > 0.0 && !scene.is_loaded(slots) && !self.are_wedged(slots, scene);
        if bounces { restitution } else { 0.0 }
    }

    /// Whether two bodies that touch at a time, s, bounce.
    fn bounce_now(&self, slots: [u32; 2], time: f32, scene: &EventScene<'_>) -> bool {
        self.restitution(slots, scene) > 0.0
            && self.meeting(slots, time, scene).is_some_and(|met| met.is_fast)
    }

    /// How two bodies meet at a time, s; `None` if they do not approach each other there.
    fn meeting(&self, slots: [u32; 2], time: f32, scene: &EventScene<'_>) -> Option<Met> {
        let there = slots.map(|slot| self.state_at(slot, time, scene));
        let motions = slots.map(|slot| &scene.bodies.motions[slot as usize]);
        let rows = motions.map(|motion| motion.row);
        let manifold = manifold_in(slots, scene.bodies, [&there[0], &there[1]]);
        let mut constraint = ContactConstraint::new(&manifold, scene.mixed(slots).friction, motions);
        constraint.find_masses::<2>();
        let accelerations = scene.accelerations(&constraint, rows);
        let gained = accelerations.map(|acceleration| acceleration * (time - 0.5 * scene.h()));
        let (_, offset, _) = Self::swept(scene, slots, &there);
        // Where a body is at a time is rounded as its way in the substep is.
        let near = MEETS_WITHIN * motions[0].thickness.min(motions[1].thickness)
            + noise_of(offset)
            + scene.rounding(slots, &there) * scene.h();
        let gaps = [0, 1].map(|index| {
            manifold.points().get(index).map(|point| point.separation).filter(|&gap| gap <= near)
        });
        let meeting = Meeting::new(constraint, gaps, &there, gained, [0.0; 2], scene.h())?;
        let [first, second] = scene.bounce_thresholds(accelerations);
        let is_fast = meeting.speed() > first.max(second);
        Some(Met { meeting, is_fast })
    }

    /// Whether two shapes touch at a time, s, where their neighbours cover them.
    fn is_ghost(&self, slots: [u32; 2], time: f32, scene: &EventScene<'_>) -> bool {
        if scene.bodies.exposures_of(slots).is_none() {
            return false;
        }
        let [a, b] = slots.map(|slot| self.state_at(slot, time, scene));
        manifold_in(slots, scene.bodies, [&a, &b]).points().is_empty()
    }

    /// Lets two bodies collide at a time, s.
    fn meet(&mut self, time: f32, slots: [u32; 2], scene: &mut EventScene<'_>, impacts: &mut Impacts) {
        if self.tests_left == 0 {
            return self.halt(slots, time, scene);
        }
        if self.is_ghost(slots, time, scene) {
            // What covers it there is met for itself; elsewhere they may still meet.
            return self.expect(slots, Some(time), scene);
        }
        let Some(Met { meeting, is_fast }) = self.meeting(slots, time, scene) else {
            // The surfaces turn away from each other where they touch; elsewhere they may still meet.
            return self.expect(slots, Some(time), scene);
        };
        if slots.into_iter().any(|slot| scene.bodies.is_dynamic(slot) && !scene.bodies.is_awake(slot)) {
            // It wakes in the next step, as its contact begins.
            let there = self.state_at(slots[0], time, scene).delta_position;
            let center = scene.bodies.center(scene.bodies.body_of(slots[0])) + there.to_vec2();
            self.note(slots, meeting.report(center, LaneVec2::default()), scene);
            return self.halt(slots, time, scene);
        }
        let restitution = if is_fast { self.restitution(slots, scene) } else { 0.0 };
        let rows = slots.map(|slot| scene.bodies.motions[slot as usize].row);
        let moved = slots.map(|slot| scene.bodies.is_dynamic(slot) && !self.is_halted(slot, scene));
        let collision = scene.collide(slots, moved, &meeting, restitution, time);
        self.note(slots, collision, scene);
        if let Some(home) = scene.home(slots) {
            scene.graph.set_pending(home, [false; 2]);
        }
        for (row, _) in rows.into_iter().zip(moved).filter(|&(_, is_moved)| is_moved) {
            impacts.mark_again(row, scene);
        }
        self.go_on(slots, moved, time, scene);
    }

    /// Whether one of two bodies is wedged.
    fn are_wedged(&self, slots: [u32; 2], scene: &EventScene<'_>) -> bool {
        let quick_strikes = |row| self.traveller(row).map_or(0, |traveller| traveller.quick_strikes);
        scene.rows(slots).into_iter().any(|row| quick_strikes(row) >= QUICK_STRIKES)
    }

    /// Whether the body of a shape is stopped.
    fn is_halted(&self, slot: u32, scene: &EventScene<'_>) -> bool {
        let row = scene.bodies.motions[slot as usize].row;
        self.traveller(row).is_some_and(|traveller| traveller.halted.is_some())
    }

    /// Takes note that two bodies have met.
    fn note(&mut self, slots: [u32; 2], collision: Collision, scene: &mut EventScene<'_>) {
        if let Some(contact) = scene.contact_of(slots) {
            let home = scene.graph.home(contact).filter(|_| !scene.contacts[contact].is_touching);
            scene.blows.note(Impact { contact, collision }, home, scene.graph);
        } else {
            let is_first = self.encountered.insert(slots[0], slots[1]);
            self.encounters.push(Encounter { slots, collision, is_first });
        }
    }

    /// Stops two bodies where they are at a time, s, until the substep ends, but for what sleeps or was stopped before.
    fn halt(&mut self, slots: [u32; 2], time: f32, scene: &mut EventScene<'_>) {
        let halts = slots.map(|slot| {
            scene.bodies.is_dynamic(slot) && scene.bodies.is_awake(slot) && !self.is_halted(slot, scene)
        });
        for (slot, _) in slots.into_iter().zip(halts).filter(|&(_, halts)| halts) {
            let state = self.state_at(slot, time, scene);
            let there = BodyState { velocity: BodyState::REST.velocity, angular_velocity: 0.0, ..state };
            let index = self.index_of(slot, time, scene);
            self.travellers[index].halted = Some(there);
        }
        self.go_on(slots, halts, time, scene);
    }

    /// The index of the traveller that the body of a shape is from a time on, s, if not before.
    fn index_of(&mut self, slot: u32, time: f32, scene: &EventScene<'_>) -> usize {
        let row = scene.bodies.motions[slot as usize].row;
        match self.by_row[row as usize] {
            NONE => self.take_up(row, time, scene),
            index => index as usize,
        }
    }

    /// Sweeps those of two bodies whose ways have changed at a time, s, anew from there.
    fn go_on(&mut self, slots: [u32; 2], have_changed: [bool; 2], time: f32, scene: &EventScene<'_>) {
        let indices = [0, 1].map(|side| have_changed[side].then(|| self.index_of(slots[side], time, scene)));
        for index in indices.into_iter().flatten() {
            let traveller = &mut self.travellers[index];
            let is_quick = time - traveller.from < QUICK * scene.h();
            traveller.quick_strikes = if is_quick { traveller.quick_strikes + 1 } else { 0 };
            traveller.from = time;
            traveller.version += 1;
            let leaf = traveller.leaf;
            self.ways.move_leaf(leaf, self.way_of(index, scene));
        }
        let [first, second] = indices;
        if let Some(index) = first {
            self.look(index, |_| false, scene);
        }
        if let Some(index) = second {
            self.look(index, |other| Some(other) == first, scene);
        }
    }
}

/// Two bodies that meet.
struct Met {
    meeting: Meeting,
    /// Whether they approach fast enough to bounce.
    is_fast: bool,
}
