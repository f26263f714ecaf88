//! One step, as a table of stages.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::body::limits::FARTHEST;
use crate::body::{Bodies, BodyId, BodyType, Motion, NONE, RestRule, RestWatch};
use crate::collision::broad_phase::BroadPhase;
use crate::collision::{AHEAD, Refresh, are_out_of_reach, refresh};
use crate::compute::{BodyState, Chosen, Executor, GROUND_ROW};
use crate::math::Rot;
use crate::resolution::{
    RefinementTables, SolveTables, StepResidual, TierRule, TierTables, begins_at_rest, force_on, solve,
};
use crate::world::World;
use crate::world::attractor::Field;
use crate::world::profile::{Counters, Stage};
use crate::world::sleep::{self, SleepRule};

/// What it costs to bring a manifold up to date that can be kept, and to move the pose and the box of a body on, ns.
const REFRESH_COST: usize = 20;
const FINALIZE_COST: usize = 25;

/// A body that moves by less than this share of its extent per step, no unit, stays in its fat box for some steps: the
/// margin is more than two of them, up to 0.1 m.
const SLOW_SHARE: f32 = 0.01;

impl World {
    /// Moves the world by one tick of `1 / tick_rate` seconds. Never fails.
    ///
    /// ```text
    /// stage     runs on               does
    /// pairs     moved boxes           finds new pairs of overlapping boxes
    /// contacts  awake pairs           brings manifolds up to date; ends pairs whose boxes parted
    /// solve     awake bodies          the substep loop: forces, impacts, contacts, motion
    /// finalize  awake bodies          adds the motion to the poses; boxes follow
    /// events    changing contacts     what began, ended, hit; what left the bounds is removed
    /// sensors   sensors               what began and ceased to overlap them
    /// sleep     bodies long at rest   islands in equilibrium leave the step
    /// ```
    ///
    /// # Panics
    /// If a step of this world has panicked before, as it does where a [`Clock`](crate::Clock) panics. The panic is passed on, and threads rest.
    /// The world is left halfway through a step: it can be looked at, but not stepped, and its profile is empty and without a clock. A clone
    /// that is made of it then is the same. A clone from before can be stepped.
    pub fn step(&mut self) {
        self.events.clear();
        self.tick();
    }

    /// Takes one tick, whose events come after those that are there.
    pub(in crate::world) fn tick(&mut self) {
        assert!(!self.is_within_step, "an earlier step of this world panicked halfway");
        self.is_within_step = true;
        let mut profile = std::mem::take(&mut self.profile);
        self.events.begin_tick();
        let size = self.bodies.awake_count() + self.candidates.len() + self.contacts.awake().len();
        let at_work = self.pool.begin_step(self.settings.threads, size);
        if self.bodies.awake_count() == 0 {
            // The solver will not run; what it found last is no longer so.
            self.residual = StepResidual::default();
            self.tiers.clear();
            self.solver.impacts.clear();
            self.solver.blows.clear();
            self.solver.joints.forget_broken();
        }
        self.find_exposures();
        profile.run_stage(Stage::Pairs, self.broad_phase.moved_count(), || self.find_pairs());
        let pairs = self.candidates.len() + self.contacts.awake().len();
        profile.run_stage(Stage::Contacts, pairs, || self.refresh_contacts());
        profile.run_stage(Stage::Solve, self.bodies.awake_count(), || self.solve());
        profile.run_stage(Stage::Finalize, self.bodies.awake_count(), || self.finalize());
        profile.run_stage(Stage::Events, self.changing_count(), || self.report_events());
        self.remove_those_that_left();
        self.break_joints();
        self.stop_those_that_arrived();
        profile.run_stage(Stage::Sensors, self.sensor_work(), || self.find_sensor_overlaps());
        self.events.sort();
        let resting = if sleep::is_due(self.ticks, self.settings.tick_rate) { self.resting } else { 0 };
        profile.run_stage(Stage::Sleep, resting, || self.put_to_sleep());
        self.pool.end_step(at_work);
        profile.counters = self.count();
        self.profile = profile;
        self.forced.clear();
        self.ticks += 1;
        self.is_within_step = false;
        self.give_back_memory();
    }

    /// Takes up each new pair of shapes of two bodies whose fat boxes overlap.
    pub(in crate::world) fn find_pairs(&mut self) {
        // A new body may have the place of one that was removed.
        self.candidates.forget_removed(&mut self.broad_phase);
        let (bodies, joints, mut pairs) = (&self.bodies, &self.joints, std::mem::take(&mut self.new_pairs));
        let dt = self.settings.tick_seconds() as f32;
        let accept = |slots: [u32; 2], is_fast: [bool; 2]| {
            // Pairs of a fast body that is awake are looked for again in the next step.
            let comes_again = (0..2).any(|index| is_fast[index] && bodies.is_awake(slots[index]));
            let [a, b] = bodies.bodies_of(slots);
            let may_meet = bodies.may_collide(slots[0], slots[1]) && !joints.part(a, b);
            may_meet && !(comes_again && are_out_of_reach(bodies, slots, dt))
        };
        self.broad_phase.find_pairs(&self.pool, accept, &mut pairs);
        for &(a, b) in &pairs {
            for (sleeper, other) in [(a, b), (b, a)] {
                // A sleeper does not move: something fixed was put beside it.
                if !self.bodies.is_awake(sleeper) && self.is_fixed(other) {
                    self.wake_slot(self.bodies.body_of(sleeper));
                }
            }
            self.candidates.add((a, b));
        }
        pairs.clear();
        self.new_pairs = pairs;
    }

    /// Begins a contact for each pair of shapes that come within reach of each other, or whose bodies sleep.
    pub(in crate::world) fn begin_contacts(&mut self) {
        // Some leave the bounds in the step in which others fall asleep.
        self.candidates.forget_removed(&mut self.broad_phase);
        let mut pairs = std::mem::take(&mut self.new_pairs);
        let dt = self.settings.tick_seconds() as f32;
        self.candidates.sort_out(&self.pool, &self.bodies, &mut self.broad_phase, dt, &mut pairs);
        for place in 0..pairs.len() {
            self.contacts.prefetch_beginning(&self.bodies, &pairs, place);
            let (a, b) = pairs[place];
            self.begin_contact([a, b]);
        }
        pairs.clear();
        self.new_pairs = pairs;
    }

    /// Begins the contact of two shapes; returns its index.
    pub(in crate::world) fn begin_contact(&mut self, colliders: [u32; 2]) -> u32 {
        let mixed = self.mixed(colliders);
        let index = self.contacts.begin(&mut self.bodies, colliders, mixed);
        self.loads.forget_contact(index);
        if colliders.into_iter().any(|slot| self.bodies.is_awake(slot)) {
            self.contacts.set_awake(index);
        }
        index
    }

    fn is_fixed(&self, slot: u32) -> bool {
        self.bodies.records[slot].body_type == BodyType::Fixed
    }

    /// Brings the manifolds of all awake contacts up to date, and the constraint graph with them.
    fn refresh_contacts(&mut self) {
        self.begin_contacts();
        let how = Refresh {
            dt: self.settings.tick_seconds() as f32,
            impulses_of: self.impulses_of.unwrap_or(f32::INFINITY),
            recycling: self.settings.recycling,
        };
        let Self { bodies, broad_phase, graph, pool, is_close_now, .. } = self;
        is_close_now.clear();
        is_close_now.resize(self.contacts.awake().len(), None);
        let awake = (self.contacts.awake_mut(), &mut is_close_now[..]);
        pool.run(awake, REFRESH_COST, |(mut contacts, is_close_now)| {
            for (place, is_close_now) in is_close_now.iter_mut().enumerate() {
                contacts.prefetch_ahead(bodies, place);
                let index = contacts.index(place);
                let contact = contacts.get_mut(place);
                let [a, b] = contact.colliders;
                refresh(contact, bodies, how);
                let has_points = !contact.manifold.points().is_empty();
                // Bodies with points are, whatever their boxes say, which may part meanwhile. Pairs of fast ones come again.
                let is_kept = |[a, b]: [u32; 2]| !(broad_phase.is_fast(a) || broad_phase.is_fast(b));
                let is_close = has_points || (broad_phase.overlap(a, b) && is_kept([a, b]));
                // What touched, and has no points, is in no graph either if its body was given another shape.
                let is_misplaced = graph.is_misplaced(index, contact) || (contact.is_touching && !has_points);
                *is_close_now = (!is_close || is_misplaced).then_some(is_close);
            }
        });
        let mut changed = std::mem::take(&mut self.changed_contacts);
        let all = self.contacts.awake().iter().zip(&self.is_close_now);
        changed.extend(all.filter_map(|(&index, is_close)| is_close.map(|is_close| (index, is_close))));
        for place in 0..changed.len() {
            self.prefetch_ending(&changed, place);
            let (index, is_close) = changed[place];
            if !is_close {
                self.end_contact(index);
                continue;
            }
            if self.contacts[index].manifold.points().is_empty() {
                self.graph.leave(&self.contacts, index);
                self.loads.forget_contact(index);
            } else if self.graph.home(index).is_some() {
                self.graph.sort_in(&self.contacts, index);
            } else {
                self.enter_graph(index);
            }
            // The solver finds what touches, among what it solves.
            if self.graph.home(index).is_none() {
                self.contacts.note_change(index);
            }
        }
        // Of bodies that were taken apart while they touched.
        self.events.ended.append(&mut self.events.ended_by_edit);
        changed.clear();
        self.changed_contacts = changed;
    }

    /// Asks for what it takes to end contacts further on in a list than `place`: those whose bodies are not close.
    fn prefetch_ending(&self, changed: &[(u32, bool)], place: usize) {
        if let Some(&(index, false)) = changed.get(place + AHEAD) {
            self.broad_phase.prefetch_pair(self.contacts[index].colliders);
            self.contacts.prefetch_neighbours(index);
        }
        if let Some(&(index, false)) = changed.get(place + 2 * AHEAD) {
            self.contacts.prefetch(index);
        }
    }

    /// Lets the solver solve a contact that has got points; wakes a sleeping body that something moving has
    /// come close to.
    fn enter_graph(&mut self, index: u32) {
        let [a, b] = self.contacts[index].slots;
        for (sleeper, other) in [(a, b), (b, a)] {
            let is_asleep = self.bodies.records[sleeper].sleep_group != NONE;
            // What is told how to move may not have been told to.
            if is_asleep && (self.bodies.is_dynamic(other) || self.bodies.state(other).is_moving()) {
                self.wake_slot(sleeper);
            }
        }
        let is_asleep = |slot: u32| self.bodies.records[slot].sleep_group != NONE;
        if !is_asleep(a) && !is_asleep(b) {
            self.graph.enter(&self.contacts, &self.bodies, index);
            if begins_at_rest(&self.contacts[index], &self.bodies) {
                self.loads.begun_at_rest.push(index);
            }
        }
    }

    /// The number of the tick under way, or between two of the one to come: what [`ticks`](Self::ticks) will be at its end.
    pub(in crate::world) fn next_tick(&self) -> u64 {
        self.ticks + 1
    }

    /// The substep loop.
    fn solve(&mut self) {
        let settings = &self.settings;
        let mixes = settings.mixes();
        let Self { bodies, contacts, joints, graph, loads, pool, broad_phase, .. } = self;
        let field = Field {
            uniform: self.acceleration,
            attractors: &self.attractors,
            gravitational_constant: settings.gravitational_constant,
        };
        let rule = TierRule {
            adapts: settings.adapts(),
            substep_rate: 1.0 / settings.substep_seconds(),
            impulses_of: self.impulses_of.unwrap_or_default(),
            force_on: &|slot| force_on(bodies, slot, &field),
        };
        let tables = TierTables { bodies, contacts, graph, joints };
        self.tiers.decide(self.ticks, rule, loads, tables);
        let tables = RefinementTables { loads, contacts, graph, joints, bodies };
        self.refinement.decide(rule, tables);
        let substeps = self.refinement.substeps(settings.substeps);
        let sizes = graph.sizes().chain([bodies.awake_count()]);
        let scheme = settings.scheme(substeps, self.fits_kernels, sizes);
        let (last, now) = (self.impulses_of.replace(scheme.substep_time()), scheme.substep_time());
        if let Some(last) = last.filter(|&last| last != now) {
            self.rescaling.rescale(contacts, bodies, &field, [last, now]);
        }
        let executor = Executor { pool, width: scheme.width };
        let mut tables = SolveTables { bodies, contacts, graph, loads, joints, broad_phase, mixes, executor };
        self.residual = solve(&mut self.solver, &scheme, &self.tiers.direct, &mut tables, &field);
    }

    /// Adds the motion of the step to the poses, lets boxes follow, and watches for rest.
    fn finalize(&mut self) {
        let dt = self.settings.tick_seconds() as f32;
        let rest_rule = self.settings.sleep.then(|| self.settings.rest_rule());
        let limits = self.settings.speed_limits();
        let Self { bodies, broad_phase, pool, leaves_box, leaving, .. } = self;
        leaves_box.resize(bodies.awake_count(), false);
        let row_count = bodies.row_count();
        let Bodies { states, previous, awake, motions, forcings, watches, shapes, .. } = bodies;
        let (motions, forcings) = (Chosen::new(motions, awake), Chosen::new(forcings, awake));
        let watches = Chosen::new(watches, awake);
        let resting = AtomicUsize::new(0);
        let of_rows = (&mut states[1..row_count], &mut previous[1..row_count]);
        let rows = ((motions, (forcings, watches)), (of_rows, &mut leaves_box[..]));
        pool.run(
            rows,
            FINALIZE_COST,
            |((mut motions, (mut forcings, mut watches)), ((states, previous), leaves_box))| {
                let of_rows = states.iter_mut().zip(previous).zip(leaves_box);
                for (place, ((state, previous), leaves_box)) in of_rows.enumerate() {
                    forcings.get_mut(place).end_step();
                    limits.cut(state);
                    let (slot, motion) = (motions.indices()[place], motions.get_mut(place));
                    let ahead = state.velocity.to_vec2() * dt;
                    if let Some(rule) = rest_rule
                        && watch_for_rest(motion, watches.get_mut(place), state, rule)
                    {
                        resting.fetch_add(1, Ordering::Relaxed);
                    }
                    *previous = motion.pose;
                    move_on(motion, state);
                    let aabb = |motion: &Motion| shapes[slot as usize].bounding_box(motion.pose);
                    if motion.room > ahead.norm_1() {
                        debug_assert!(
                            motion.room == f32::INFINITY
                                || !broad_phase.leaves_box(slot, aabb(motion), ahead),
                            "{slot} had room"
                        );
                        *leaves_box = false;
                        continue;
                    }
                    let aabb = aabb(motion);
                    *leaves_box = broad_phase.leaves_box(slot, aabb, ahead);
                    let stays_long = !*leaves_box && ahead.norm_1() < SLOW_SHARE * motion.extent;
                    motion.room = if stays_long { broad_phase.room(slot, aabb) } else { 0.0 };
                }
            },
        );
        self.resting = resting.into_inner();
        let slots = bodies.awake.iter().zip(leaves_box);
        leaving.clear();
        leaving.extend(slots.filter(|(_, leaves_box)| **leaves_box).map(|(&slot, _)| slot));
        if !bodies.compounds.is_empty() {
            Self::move_colliders(bodies, broad_phase, dt, leaving);
        }
        Self::give_boxes(bodies, broad_phase, dt, leaving);
    }

    /// Gives the shapes that have left their box another.
    fn give_boxes(bodies: &Bodies, broad_phase: &mut BroadPhase, dt: f32, leaving: &[u32]) {
        for (place, &slot) in leaving.iter().enumerate() {
            broad_phase.prefetch_leaf(leaving, place);
            if let Some(&next) = leaving.get(place + AHEAD) {
                bodies.prefetch_box(next);
            }
            let ahead = bodies.velocity_of_shape(slot) * dt;
            let is_alone = bodies.records[bodies.body_of(slot)].first_contact == NONE;
            broad_phase.give_box(slot, bodies.aabb(slot), ahead, is_alone);
        }
    }

    /// Lets the shapes of bodies with several follow their bodies, and finds those that have left their box.
    fn move_colliders(bodies: &mut Bodies, broad_phase: &BroadPhase, dt: f32, leaving: &mut Vec<u32>) {
        for row in GROUND_ROW as usize + 1..bodies.row_count() {
            let slot = bodies.slot_of_row(row);
            if bodies.is_compound(slot) {
                bodies.place_colliders(slot);
                let leaves_box = |&collider: &u32| {
                    let ahead = bodies.velocity_of_shape(collider) * dt;
                    broad_phase.leaves_box(collider, bodies.aabb(collider), ahead)
                };
                leaving.extend(bodies.colliders(slot).filter(leaves_box));
            }
        }
    }

    /// How many contacts may have begun or ceased to touch.
    fn changing_count(&self) -> usize {
        self.contacts.changing_count() + self.solver.blows.parts() + self.solver.continuous.encounters().len()
    }

    /// Stops the kinematic bodies that were to get somewhere in this tick.
    fn stop_those_that_arrived(&mut self) {
        for id in self.arriving.drain(..) {
            let Some(record) = self.bodies.records.get_mut(id.0) else { continue };
            if std::mem::take(&mut record.stops_after_tick) && record.body_type == BodyType::Kinematic {
                let row = self.bodies.motions[id.0.index() as usize].row;
                self.bodies.states[row as usize] = BodyState::REST;
            }
        }
    }

    /// Removes the bodies that left the bounds, oldest place first.
    fn remove_those_that_left(&mut self) {
        let Some(bounds) = self.settings.bounds else { return };
        let bodies = &self.bodies;
        let outside = bodies.awake.iter().filter(|&&slot| !bounds.contains_point(bodies.center(slot)));
        let first = self.events.left.len();
        self.events.left.extend(outside.map(|&slot| BodyId(bodies.records.key_at(slot))));
        self.events.left[first..].sort_unstable();
        for place in first..self.events.left.len() {
            self.remove(self.events.left[place]);
        }
        self.events.ended.append(&mut self.events.ended_by_edit);
    }

    fn put_to_sleep(&mut self) {
        let rule = SleepRule { rest: self.settings.rest_rule(), tick: self.ticks };
        let (sleepers, mut tables) = self.sleep_tables();
        let count = sleepers.len();
        sleepers.put_to_sleep(&mut tables, rule);
        if self.sleepers.len() > count {
            // Pairs that are both asleep get contacts, to sleep with them.
            self.begin_contacts();
        }
        // Finalize counts anew; where nothing is awake any more it does not run.
        self.resting = 0;
    }

    /// How many substeps the last step had.
    fn substeps(&self) -> u32 {
        self.refinement.substeps(self.settings.substeps)
    }

    /// Length of the substeps of the last step, s.
    pub(crate) fn substep_seconds(&self) -> f32 {
        self.settings.tick_seconds() as f32 / self.substeps() as f32
    }

    fn count(&self) -> Counters {
        let (colours, overflow) = self.graph.occupancy();
        Counters {
            awake_bodies: self.bodies.awake_count(),
            contacts: self.graph.len(),
            pairs: self.candidates.len() + self.contacts.len(),
            bouncy_contacts: self.solver.impacts.len(),
            impacts: self.solver.blows.impacts().len(),
            colours,
            overflow,
            substeps: if self.bodies.awake_count() > 0 { self.substeps() } else { 0 },
            direct_bodies: self.tiers.direct.body_count(),
            direct_islands: self.tiers.direct.len(),
        }
    }
}

/// Watches a body for rest over the motion of a step. Returns whether it may sleep by that.
#[inline(always)]
fn watch_for_rest(motion: &mut Motion, watch: &mut RestWatch, state: &BodyState, rule: RestRule) -> bool {
    let is_dynamic = motion.inverse_mass > 0.0;
    if !is_dynamic && state.is_moving() {
        // However slowly a kinematic body moves, it keeps what it touches awake.
        motion.is_watched = false;
        return false;
    }
    let turn = Rot { c: state.delta_rotation.c, s: state.delta_rotation.s };
    motion.watch(watch, state.delta_position.to_vec2(), turn, rule) && is_dynamic
}

/// Adds the motion of a step to the pose of a body.
#[inline(always)]
fn move_on(motion: &mut Motion, state: &mut BodyState) {
    let turn = Rot { c: state.delta_rotation.c, s: state.delta_rotation.s };
    // The world ends there: a place that is farther would be refused when it is given back.
    motion.pose.center = (motion.pose.center + state.delta_position.to_vec2()).within(FARTHEST);
    motion.pose.rotation = (turn * motion.pose.rotation).normalized();
    // Rotations round in their last digit.
    let swing = if motion.is_round { 0.0 } else { (1.0 - turn.c).abs() + turn.s.abs() + 2.0 * f32::EPSILON };
    motion.room -= state.delta_position.to_vec2().norm_1() + swing * motion.extent;
    state.stand_still();
}
