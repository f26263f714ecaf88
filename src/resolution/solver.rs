//! The substep loop.

use core::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::body::{Bodies, Effort};
use crate::collision::Contacts;
use crate::compute::{BodyState, Crew, Shared, Width};
use crate::math::Vec2;
use crate::resolution::constraint::StepResidual;
use crate::resolution::constraint_graph::{ConstraintGraph, Newcomers, place_in};
use crate::resolution::contact_block::Beginning;
use crate::resolution::damping::{Damped, is_damped};
use crate::resolution::direct::{Aim, DirectSolver};
use crate::resolution::effort::EffortClass;
use crate::resolution::follow::{Followers, act};
use crate::resolution::handover::{HandoverScene, Handovers};
use crate::resolution::impacts::{ImpactScene, Impacts};
use crate::resolution::integrate::{Advance, Kick, Kicks, Shares, SpeedLimits, drift};
use crate::resolution::kernel::{Sweep, SweepOver, WarmStart};
use crate::resolution::load::Loads;
use crate::resolution::projection::Project;

/// How a step is solved. One text covers the default and the classic scheme: the classic one has a single
/// kick, one substep, many sweeps with friction, none to relax, and projects positions afterwards.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scheme {
    /// Length of the step, s.
    pub(crate) dt: f32,
    pub(crate) substeps: u32,
    /// Length of a substep over that of the last step's, no unit: impulses are stored per substep.
    pub(crate) impulse_scale: f32,
    /// Sweeps before the bodies move, per substep.
    pub(crate) iterations: u32,
    /// Sweeps after the bodies have moved, per substep.
    pub(crate) relax_iterations: u32,
    /// Half a kick before and half after the drift, rather than a whole one before it.
    pub(crate) split_kick: bool,
    /// Whether islands under great load may be given more effort.
    pub(crate) adapts: bool,
    pub(crate) warm_starting: bool,
    pub(crate) block_solve: bool,
    /// Iterations of position projection at the end of the step, instead of a bias in the sweeps.
    pub(crate) projections: Option<u32>,
    /// Slowest approach that bounces, m/s.
    pub(crate) restitution_threshold: f32,
    pub(crate) limits: SpeedLimits,
    /// How many contacts are solved at a time.
    pub(crate) width: Width,
    /// Whether they are solved by kernels that leave out what none of them needs.
    pub(crate) fitted_kernels: bool,
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
pub(crate) trait Acceleration: Sync {
    /// The same everywhere, m/s²; bodies scale it by their gravity scale.
    fn uniform(&self) -> Vec2;
    /// Whether there is a part that depends on where a body is.
    fn varies(&self) -> bool;
    /// The part that depends on where a body is, m/s²: for the body in `slot`, moved by `delta` (m) since
    /// the step began.
    fn at(&self, bodies: &Bodies, slot: u32, delta: Vec2) -> Vec2;
}

/// What it costs to write the carry of a body back, ns.
const CARRY_COST: usize = 3;

/// Buffers of the solver for one effort, kept from step to step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Solver {
    kicks: Kicks,
    /// By row: the part of its acceleration that stays the same during the step, m/s²; empty where all of it does.
    steady: Vec<Vec2>,
    damped: Damped,
    /// By row: the velocities that one share of the warm start gives.
    shares: Vec<BodyState>,
    pub(crate) impacts: Impacts,
    followers: Followers,
    handovers: Handovers,
    newcomers: Newcomers,
    direct: DirectSolver,
}

/// The tables that a step changes.
#[derive(Debug)]
pub(crate) struct SolveTables<'a> {
    pub(crate) bodies: &'a mut Bodies,
    pub(crate) contacts: &'a mut Contacts,
    pub(crate) graph: &'a mut ConstraintGraph,
    pub(crate) loads: &'a mut Loads,
    /// Who does the work.
    pub(crate) crew: &'a Crew,
}

/// One step of the islands of one effort: moves the velocities and deltas of their rows, and the impulses of their
/// contacts.
///
/// ```text
/// repeat substeps:
///     v += h/2 a(x);  impacts
///     solve contacts (a bias pushes overlaps apart)
///     x += h v;  v += h/2 a(x)
///     contacts of circles and loaded corners follow the surface
///     solve contacts (without bias), friction
/// ```
///
/// Contacts are solved by sweeps: half of the last impulses, a sweep, the move, the other half, a sweep. Or directly.
pub(crate) fn solve(
    solver: &mut Solver,
    scheme: &Scheme,
    class: &EffortClass<'_>,
    tables: &mut SolveTables<'_>,
    acceleration: &impl Acceleration,
) -> StepResidual {
    let h = scheme.substep_time();
    solver.prepare(scheme, class, tables, acceleration);
    for substep in 0..scheme.substeps {
        if substep > 0 {
            solver.handovers.release(tables.graph);
        }
        // Where nothing looks at velocities before the warm start, it gives the kick too, which saves a pass.
        let late_kick = solver.sweeps_only(class.effort).then(|| scheme.kick_time());
        if late_kick.is_none() {
            let kick = Some(scheme.kick_time());
            solver.integrate(scheme, class, tables, Advance { kick, ..Advance::NONE });
        }
        // What a sweep after the move has found of where bodies are holds until they move again.
        let mut have_moved = substep > 0 && scheme.relax_iterations == 0;
        if solver.impacts.len() > 0 {
            let (kicks, SolveTables { bodies, contacts, graph, .. }) = (&solver.kicks, &mut *tables);
            let Scheme { restitution_threshold, width, .. } = *scheme;
            let mut scene = ImpactScene { bodies, contacts, kicks, graph, h, restitution_threshold, width };
            have_moved |= solver.impacts.run(&mut scene);
        }
        match class.effort {
            Effort::Direct => solver.direct.solve(tables.graph, &mut tables.bodies.states, Aim::Push, h),
            _ => solver.sweep_before_move(scheme, class, tables, (late_kick, have_moved)),
        }
        solver.move_on(scheme, class, tables, acceleration);
        match class.effort {
            Effort::Direct => solver.direct.solve(tables.graph, &mut tables.bodies.states, Aim::Relax, h),
            _ => solver.sweep_after_move(scheme, class, tables),
        }
    }
    for _ in 0..scheme.projections.unwrap_or(0) {
        let project = Project { states: Shared::new(&mut tables.bodies.states) };
        tables.graph.for_each(tables.crew, (class.effort, Width::ONE), &project);
    }
    solver.finish(scheme, class, tables)
}

impl Scheme {
    /// The sweeps before the bodies move.
    fn main_sweep(&self) -> Sweep {
        Sweep {
            biased: self.projections.is_none(),
            friction: self.relax_iterations == 0,
            block: self.block_solve,
            counts_share: false,
        }
    }

    /// The sweeps after it.
    fn relax_sweep(&self) -> Sweep {
        Sweep { biased: false, friction: true, ..self.main_sweep() }
    }

    /// A sweep of this kind; `have_moved` says whether bodies have since the last.
    fn sweep_over<'a>(&self, states: &'a mut [BodyState], kind: Sweep, have_moved: bool) -> SweepOver<'a> {
        let per_substep = 1.0 / self.substep_time();
        SweepOver {
            states: Shared::new(states),
            kind,
            have_moved,
            per_substep,
            is_fitted: self.fitted_kernels,
        }
    }

    /// What of the last impulses is applied before the move, and again after it where the kick is split.
    fn warm_part(&self) -> f32 {
        match (self.warm_starting, self.split_kick) {
            (false, _) => 0.0,
            (true, false) => 1.0,
            (true, true) => 0.5,
        }
    }
}

impl Solver {
    /// The move, the second kick, and the second share of the warm start. After the move, contacts of circles and
    /// loaded corners are where the surface is now, and their share acts along the normal there: a circle that rolls
    /// along a curve is turned by half before and by half after it, and keeps its speed (H. Andersen, "Rattle", 1983).
    fn move_on(
        &mut self,
        scheme: &Scheme,
        class: &EffortClass<'_>,
        tables: &mut SolveTables<'_>,
        acceleration: &impl Acceleration,
    ) {
        let is_direct = class.effort == Effort::Direct;
        let has_shares = scheme.split_kick && !is_direct;
        let last_shares = if has_shares { Shares::UsedUp } else { Shares::Left };
        let kick = scheme.split_kick.then_some(scheme.kick_time());
        let h = scheme.substep_time();
        for &(_, row) in class.kinematic {
            drift(&mut tables.bodies.states[row as usize], h);
        }
        if acceleration.varies() || is_direct {
            self.integrate(scheme, class, tables, Advance { drift: Some(h), ..Advance::NONE });
            if acceleration.varies() {
                self.accelerate(tables, &class.rows, acceleration);
            }
            if is_direct {
                self.direct.restore_free(&mut tables.bodies.states);
            }
            self.integrate(scheme, class, tables, Advance { drift: None, kick, shares: last_shares });
        } else {
            self.integrate(scheme, class, tables, Advance { drift: Some(h), kick, shares: last_shares });
        }
        let means = (tables.crew, class.effort, scheme.width);
        self.followers.follow(means, (tables.contacts, tables.bodies, tables.graph), has_shares);
    }

    /// Whether contacts are solved by sweeps and nothing else.
    fn sweeps_only(&self, effort: Effort) -> bool {
        effort != Effort::Direct && self.impacts.len() == 0 && self.handovers.is_empty()
    }

    /// Contacts by sweeps, before the bodies move; first their `kick`, s, if they have not had it. `have_moved` says that
    /// they have since the last sweep.
    fn sweep_before_move(
        &mut self,
        scheme: &Scheme,
        class: &EffortClass<'_>,
        tables: &mut SolveTables<'_>,
        (kick, have_moved): (Option<f32>, bool),
    ) {
        let h = scheme.substep_time();
        self.handovers.hold_back(tables.graph, &tables.bodies.states, h);
        self.warm_start(scheme, class, tables, kick);
        let SolveTables { bodies, contacts, graph, crew, .. } = tables;
        let states = &mut bodies.states;
        let sweep = scheme.sweep_over(states, scheme.main_sweep(), have_moved);
        for _ in 0..scheme.iterations {
            graph.for_each(crew, (class.effort, scheme.width), &sweep);
        }
        if scheme.split_kick && scheme.warm_starting {
            self.grip_newcomers(scheme, graph, states);
        }
        if !self.handovers.is_empty() {
            let shares = if scheme.split_kick { &mut self.shares[..] } else { &mut [] };
            self.handovers.run(&mut HandoverScene { bodies, contacts, graph, shares, h });
        }
    }

    /// Contacts by sweeps, after the bodies have moved.
    fn sweep_after_move(&mut self, scheme: &Scheme, class: &EffortClass<'_>, tables: &mut SolveTables<'_>) {
        let (graph, states) = (&mut *tables.graph, &mut tables.bodies.states);
        let relax = scheme.relax_sweep();
        for iteration in 0..scheme.relax_iterations {
            let kind = Sweep { counts_share: scheme.split_kick && iteration == 0, ..relax };
            let sweep = scheme.sweep_over(states, kind, iteration == 0);
            graph.for_each(tables.crew, (class.effort, scheme.width), &sweep);
        }
        if scheme.relax_iterations > 0 {
            self.newcomers.sweep(graph, scheme.width, &scheme.sweep_over(states, relax, false));
        }
    }

    /// Fills the rows of kicks, the constraints, and the contacts that may bounce.
    fn prepare(
        &mut self,
        scheme: &Scheme,
        class: &EffortClass<'_>,
        tables: &mut SolveTables<'_>,
        acceleration: &impl Acceleration,
    ) {
        self.prepare_kicks(scheme, class, tables, acceleration);
        let which = (class.effort, scheme.width);
        let SolveTables { bodies, contacts, graph, crew, .. } = &mut *tables;
        let from = Beginning { contacts, bodies, impulse_scale: scheme.impulse_scale, dt: scheme.dt };
        graph.prepare(crew, which, from, &mut self.followers);
        self.gather_special(class.effort, graph);
        self.direct.clear();
        let mut start = 0;
        for &end in class.direct_ends {
            let island = &class.direct[start..end];
            self.direct.add_island(island, tables.bodies, tables.contacts, tables.graph);
            start = end;
        }
    }

    fn prepare_kicks(
        &mut self,
        scheme: &Scheme,
        class: &EffortClass<'_>,
        tables: &SolveTables<'_>,
        acceleration: &impl Acceleration,
    ) {
        let (bodies, varies) = (&*tables.bodies, acceleration.varies());
        let forcing_of = |row: usize| &bodies.forcings[bodies.slot_of_row[row] as usize];
        let has_damping = AtomicBool::new(false);
        self.kicks.reset(bodies.row_count());
        self.steady.clear();
        self.steady.resize(if varies { bodies.row_count() } else { 0 }, Vec2::ZERO);
        let steady_of_row = Shared::new(&mut self.steady);
        self.kicks.fill(tables.crew, class.rows.clone(), |row| {
            let motion = &bodies.motions[bodies.slot_of_row[row] as usize];
            if motion.inverse_mass == 0.0 {
                return Kick::default();
            }
            let forcing = forcing_of(row);
            let steady = acceleration.uniform() * forcing.gravity_scale + forcing.force * motion.inverse_mass;
            if varies {
                steady_of_row.change(row, |to| *to = steady);
            }
            if is_damped(forcing) {
                has_damping.store(true, Ordering::Relaxed);
            }
            Kick {
                acceleration: steady.into(),
                carry: motion.velocity_carry.into(),
                angular_acceleration: forcing.torque * motion.inverse_inertia,
            }
        });
        self.damped.clear();
        if has_damping.into_inner() {
            let rows = class.rows.clone().map(|row| (row, forcing_of(row)));
            let is_moved = |row: usize| bodies.is_dynamic(bodies.slot_of_row[row]);
            let damped = rows.filter(|&(row, forcing)| is_damped(forcing) && is_moved(row));
            self.damped.add(damped, scheme.kick_time());
        }
        if varies {
            self.accelerate(tables, &class.rows, acceleration);
        }
    }

    /// Takes up the contacts of which something special is to be expected within the step.
    fn gather_special(&mut self, effort: Effort, graph: &ConstraintGraph) {
        self.impacts.clear();
        self.handovers.clear();
        self.newcomers.clear();
        let Self { impacts, followers, handovers, newcomers, .. } = self;
        for (block, start) in graph.starts(effort) {
            if start.newcomers.any() {
                newcomers.take_up(block);
            }
            if start.bouncy.any() {
                impacts.take_up_block(block, start.bouncy);
            }
            start.found_anew.for_each(|place| followers.find_anew(place_in(block, place), graph));
            if effort != Effort::Direct {
                start.on_ground.for_each(|place| handovers.take_up(place_in(block, place), graph));
            }
        }
        self.handovers.group();
    }

    /// Gives the bodies their `kick`, s, and the part of the last impulses that they get before they move.
    ///
    /// The contacts hold still in between, so the share after the move is the same: it is kept by row, which saves
    /// a pass over the contacts.
    fn warm_start(
        &mut self,
        scheme: &Scheme,
        class: &EffortClass<'_>,
        tables: &mut SolveTables<'_>,
        kick: Option<f32>,
    ) {
        self.shares.resize(tables.bodies.states.len(), BodyState::REST);
        debug_assert!(!self.shares.iter().any(BodyState::is_moving), "all were used up");
        let (part, is_fitted) = (scheme.warm_part(), scheme.fitted_kernels);
        let start = WarmStart { shares: Shared::new(&mut self.shares), part, is_fitted };
        tables.graph.for_each(tables.crew, (class.effort, scheme.width), &start);
        let shares = if scheme.split_kick { Shares::Added } else { Shares::UsedUp };
        self.integrate(scheme, class, tables, Advance { kick, shares, ..Advance::NONE });
    }

    /// Gives the contacts that begin to bear load friction before the move: there is none to start from, and a box set
    /// on a slope would go down freely for half a substep. It counts as a share of a warm start.
    fn grip_newcomers(&mut self, scheme: &Scheme, graph: &mut ConstraintGraph, states: &mut [BodyState]) {
        let kind = Sweep { friction: true, ..scheme.main_sweep() };
        let sweep = scheme.sweep_over(states, kind, false);
        for &place in self.newcomers.sweep(graph, scheme.width, &sweep) {
            let constraint = graph.constraint(place);
            act(&constraint, constraint.share::<2>(false), graph.moved_rows(place), &mut self.shares);
        }
    }

    /// Finds the accelerations that depend on the place anew.
    fn accelerate(
        &mut self,
        tables: &SolveTables<'_>,
        rows: &Range<usize>,
        acceleration: &impl Acceleration,
    ) {
        let bodies = &*tables.bodies;
        self.kicks.accelerate(tables.crew, rows.clone(), |row| {
            let (slot, state) = (bodies.slot_of_row[row], &bodies.states[row]);
            let varying = || acceleration.at(bodies, slot, state.delta_position.into());
            bodies.is_dynamic(slot).then(|| self.steady[row] + varying())
        });
    }

    /// Moves the bodies of a class on.
    fn integrate(
        &mut self,
        scheme: &Scheme,
        class: &EffortClass<'_>,
        tables: &mut SolveTables<'_>,
        advance: Advance,
    ) {
        let SolveTables { bodies: Bodies { states, .. }, crew, .. } = tables;
        let (kicks, shares, means) = (&mut self.kicks, &mut self.shares[..], (*crew, scheme.width));
        let tables = (&mut states[..], kicks, shares);
        self.damped.integrate(means, class.rows.clone(), tables, advance, scheme.limits);
    }

    /// Writes impulses back into the contacts and carries back into the bodies.
    fn finish(&self, scheme: &Scheme, class: &EffortClass<'_>, tables: &mut SolveTables<'_>) -> StepResidual {
        let SolveTables { bodies, contacts, graph, loads, crew } = tables;
        loads.begin(scheme.adapts, class.effort, 1.0 / scheme.substep_time());
        loads.unsolved.extend(self.direct.unsolved_rows().map(|row| bodies.slot_of_row[row as usize]));
        let residual = graph.finish(crew, (class.effort, scheme.width), &bodies.states, contacts, loads);
        let (motions, slots) = (Shared::new(&mut bodies.motions), &bodies.slot_of_row);
        crew.run(class.rows.clone(), CARRY_COST, |rows| {
            for row in rows {
                motions.change(slots[row] as usize, |motion| motion.velocity_carry = self.kicks.carry(row));
            }
        });
        residual
    }
}
