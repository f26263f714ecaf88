//! The substep loop.

use crate::body::Bodies;
use crate::collision::Contacts;
use crate::compute::{BodyState, Width};
use crate::math::Vec2;
use crate::resolution::constraint::StepResidual;
use crate::resolution::constraint_graph::ConstraintGraph;
use crate::resolution::follow::Followers;
use crate::resolution::handover::{HandoverScene, Handovers};
use crate::resolution::impacts::{ImpactScene, Impacts, bounce_threshold};
use crate::resolution::integrate::{Damping, Kick, SpeedLimits, damping_loss, drift, kick};
use crate::resolution::kernel::{Sweep, SweepOver, WarmStart};
use crate::resolution::projection::Project;

/// How a step is solved. One text covers the default and the classic scheme: the classic one has a single
/// kick, one substep, many sweeps with friction, none to relax, and projects positions afterwards.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scheme {
    /// Length of the step, s.
    pub(crate) dt: f32,
    pub(crate) substeps: u32,
    /// Sweeps before the bodies move, per substep.
    pub(crate) iterations: u32,
    /// Sweeps after the bodies have moved, per substep.
    pub(crate) relax_iterations: u32,
    /// Half a kick before and half after the drift, rather than a whole one before it.
    pub(crate) split_kick: bool,
    pub(crate) warm_starting: bool,
    pub(crate) block_solve: bool,
    /// Iterations of position projection at the end of the step, instead of a bias in the sweeps.
    pub(crate) projections: Option<u32>,
    /// Slowest approach that bounces, m/s.
    pub(crate) restitution_threshold: f32,
    pub(crate) limits: SpeedLimits,
    /// How many contacts are solved at a time.
    pub(crate) width: Width,
}

impl Scheme {
    /// Length of a substep, s.
    fn substep_time(&self) -> f32 {
        self.dt / self.substeps as f32
    }

    /// How long the forces of one kick act, s.
    fn kick_time(&self) -> f32 {
        if self.split_kick { 0.5 * self.substep_time() } else { self.substep_time() }
    }
}

/// What accelerates bodies, beside contacts.
pub(crate) trait Acceleration {
    /// The same everywhere, m/s²; bodies scale it by their gravity scale.
    fn uniform(&self) -> Vec2;
    /// Whether there is a part that depends on where a body is.
    fn varies(&self) -> bool;
    /// The part that depends on where a body is, m/s²: for the body in `slot`, moved by `delta` (m) since
    /// the step began.
    fn at(&self, bodies: &Bodies, slot: u32, delta: Vec2) -> Vec2;
}

/// A contact of two points that begins to bear load is relaxed so many times more: without impulses to start from,
/// one sweep lets friction turn the body instead of stopping it, and a box set on a slope keeps 7 mm/s too much for
/// as long as it slides. Two leave a tenth of that, four nothing.
const NEWCOMER_SWEEPS: u32 = 4;

/// Buffers of the solver, kept from step to step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Solver {
    /// By row.
    kicks: Vec<Kick>,
    /// Rows with damping.
    damped: Vec<Damping>,
    /// By row: the velocities that one share of the warm start gives.
    shares: Vec<BodyState>,
    pub(crate) impacts: Impacts,
    followers: Followers,
    handovers: Handovers,
    /// Places in the constraint graph of contacts of two points that begin to bear load in this step.
    newcomers: Vec<(u32, u32)>,
    /// Those of them that bear load in this substep.
    loaded_newcomers: Vec<(u32, u32)>,
    /// Length of the last substep, s; impulses are stored per substep.
    last_h: f32,
}

/// One step: moves the velocities and deltas of all rows, and the impulses of all contacts.
///
/// ```text
/// repeat substeps:
///     contacts of circles and loaded corners follow the surface
///     v += h/2 a(x);  impacts
///     warm start with half of λ;  sweep (bias pushes overlaps apart)
///     circles meet the next piece of the ground they roll on;  x += h v
///     v += h/2 a(x);  the other half of λ;  sweep (relax: no bias), friction
/// ```
pub(crate) fn solve(
    solver: &mut Solver,
    scheme: &Scheme,
    bodies: &mut Bodies,
    contacts: &mut Contacts,
    graph: &mut ConstraintGraph,
    acceleration: &impl Acceleration,
) -> StepResidual {
    let h = scheme.substep_time();
    solver.prepare(scheme, h, bodies, contacts, graph, acceleration);
    let part = match (scheme.warm_starting, scheme.split_kick) {
        (false, _) => 0.0,
        (true, false) => 1.0,
        (true, true) => 0.5,
    };
    let kick_time = scheme.kick_time();
    let main_sweep = Sweep {
        biased: scheme.projections.is_none(),
        friction: scheme.relax_iterations == 0,
        block: scheme.block_solve,
        counts_share: false,
    };
    let relax_sweep = Sweep { biased: false, friction: true, ..main_sweep };
    for substep in 0..scheme.substeps {
        if substep > 0 {
            solver.followers.follow(graph, contacts, bodies);
            solver.handovers.release(graph);
        }
        solver.kick(&mut bodies.states, kick_time, scheme.limits);
        if solver.impacts.len() > 0 {
            let kicks = &solver.kicks;
            solver.impacts.run(&mut ImpactScene { bodies, contacts, kicks, graph, h });
        }
        let states = &mut bodies.states;
        solver.handovers.hold_back(graph, states);
        solver.warm_start(scheme.width, graph, states, part);
        for _ in 0..scheme.iterations {
            graph.for_each(scheme.width, SweepOver { states, kind: main_sweep, per_substep: 1.0 / h });
        }
        if !solver.handovers.is_empty() {
            let shares = &mut solver.shares;
            solver.handovers.run(&mut HandoverScene { bodies, contacts, graph, shares, h });
        }
        for state in &mut bodies.states[1..] {
            drift(state, h);
        }
        if acceleration.varies() {
            solver.accelerate(bodies, acceleration);
        }
        let states = &mut bodies.states;
        if scheme.split_kick {
            solver.kick(states, kick_time, scheme.limits);
            solver.add_shares(states);
        }
        for iteration in 0..scheme.relax_iterations {
            let kind = Sweep { counts_share: scheme.split_kick && iteration == 0, ..relax_sweep };
            graph.for_each(scheme.width, SweepOver { states, kind, per_substep: 1.0 / h });
        }
        if scheme.relax_iterations > 0 {
            solver.relax_newcomers(graph, states, relax_sweep, 1.0 / h);
        }
    }
    for _ in 0..scheme.projections.unwrap_or(0) {
        graph.for_each(Width::ONE, Project { states: &mut bodies.states });
    }
    solver.finish(scheme.width, bodies, contacts, graph)
}

impl Solver {
    /// Fills the rows of kicks, the constraints, and the contacts that may bounce.
    fn prepare(
        &mut self,
        scheme: &Scheme,
        h: f32,
        bodies: &Bodies,
        contacts: &Contacts,
        graph: &mut ConstraintGraph,
        acceleration: &impl Acceleration,
    ) {
        let kick_time = scheme.kick_time();
        self.kicks.clear();
        self.damped.clear();
        self.kicks.push(Kick::NONE);
        for (row, &slot) in (0_u32..).zip(&bodies.slot_of_row).skip(1) {
            let motion = &bodies.motions[slot as usize];
            if motion.inverse_mass == 0.0 {
                self.kicks.push(Kick::NONE);
                continue;
            }
            let steady = acceleration.uniform() * motion.gravity_scale + motion.force * motion.inverse_mass;
            self.kicks.push(Kick {
                acceleration: steady,
                steady,
                carry: motion.velocity_carry,
                angular_acceleration: motion.torque * motion.inverse_inertia,
            });
            if motion.linear_damping > 0.0 || motion.angular_damping > 0.0 {
                let linear = damping_loss(motion.linear_damping, kick_time);
                let angular = damping_loss(motion.angular_damping, kick_time);
                self.damped.push(Damping { row, linear, angular });
            }
        }
        if acceleration.varies() {
            self.accelerate(bodies, acceleration);
        }
        let scale = if self.last_h > 0.0 { h / self.last_h } else { 1.0 };
        self.last_h = h;
        graph.prepare(scheme.width, contacts, bodies, scale);
        self.gather_special(scheme, h, bodies, contacts, graph);
    }

    /// Takes up the contacts that may bounce, and those that follow the surface within the step.
    fn gather_special(
        &mut self,
        scheme: &Scheme,
        h: f32,
        bodies: &Bodies,
        contacts: &Contacts,
        graph: &mut ConstraintGraph,
    ) {
        self.impacts.clear();
        self.followers.clear();
        self.handovers.clear();
        self.newcomers.clear();
        for colour in graph.in_order() {
            for &index in &colour.contacts {
                let contact = &contacts[index];
                if contact.restitution > 0.0 {
                    let kicks =
                        contact.slots.map(|slot| &self.kicks[bodies.motions[slot as usize].row as usize]);
                    let threshold = bounce_threshold(scheme.restitution_threshold, contact, kicks, h);
                    let rows = contact.slots.map(|slot| bodies.motions[slot as usize].row);
                    self.impacts.add(index, contact, rows, threshold);
                }
                if !contact.is_loaded() && contact.manifold.points().len() == 2 {
                    self.newcomers.extend(contact.graph_place);
                }
                self.followers.consider(index, contact, bodies);
                self.handovers.consider(index, contact, bodies);
            }
        }
        self.handovers.group();
    }

    /// Gives the bodies the part of the last impulses that they get before they move.
    ///
    /// The contacts hold still in between, so the share after the move is the same: it is kept by row, which saves
    /// a pass over the contacts.
    fn warm_start(&mut self, width: Width, graph: &mut ConstraintGraph, states: &mut [BodyState], part: f32) {
        self.shares.clear();
        self.shares.resize(states.len(), BodyState::REST);
        graph.for_each(width, WarmStart { shares: &mut self.shares, part });
        self.add_shares(states);
    }

    fn add_shares(&self, states: &mut [BodyState]) {
        for (state, share) in states.iter_mut().zip(&self.shares) {
            state.velocity = state.velocity + share.velocity;
            state.angular_velocity += share.angular_velocity;
        }
    }

    /// Sweeps over the contacts that begin to bear load a few more times.
    fn relax_newcomers(
        &mut self,
        graph: &mut ConstraintGraph,
        states: &mut [BodyState],
        relax_sweep: Sweep,
        per_substep: f32,
    ) {
        // What carries no load is left alone, and so gets none.
        self.loaded_newcomers.clear();
        self.loaded_newcomers.extend(self.newcomers.iter().filter(|&&place| graph.is_loaded(place)));
        for _ in 0..NEWCOMER_SWEEPS {
            for &place in &self.loaded_newcomers {
                if graph.is_loaded(place) {
                    graph.for_one(place, SweepOver { states, kind: relax_sweep, per_substep });
                }
            }
        }
    }

    /// Finds the accelerations that depend on the place anew.
    fn accelerate(&mut self, bodies: &Bodies, acceleration: &impl Acceleration) {
        for ((kick, state), &slot) in
            self.kicks.iter_mut().zip(&bodies.states).zip(&bodies.slot_of_row).skip(1)
        {
            if bodies.is_dynamic(slot) {
                kick.acceleration = kick.steady + acceleration.at(bodies, slot, state.delta_position.into());
            }
        }
    }

    fn kick(&mut self, states: &mut [BodyState], time: f32, limits: SpeedLimits) {
        for (state, this) in states.iter_mut().zip(&mut self.kicks).skip(1) {
            kick(state, this, time, limits);
        }
        for &Damping { row, linear, angular } in &self.damped {
            let state = &mut states[row as usize];
            state.velocity = state.velocity - state.velocity * linear;
            state.angular_velocity -= state.angular_velocity * angular;
        }
    }

    /// Writes impulses back into the contacts and carries back into the bodies.
    fn finish(
        &self,
        width: Width,
        bodies: &mut Bodies,
        contacts: &mut Contacts,
        graph: &mut ConstraintGraph,
    ) -> StepResidual {
        let residual = graph.finish(width, &bodies.states, contacts);
        for (kick, &slot) in self.kicks.iter().zip(&bodies.slot_of_row).skip(1) {
            bodies.motions[slot as usize].velocity_carry = kick.carry;
        }
        residual
    }
}
