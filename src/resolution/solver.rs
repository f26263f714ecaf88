//! The substep loop.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::body::{Bodies, Mixes};
use crate::collision::Contacts;
use crate::collision::broad_phase::BroadPhase;
use crate::compute::{Chosen, Executor};
use crate::joint::Joints;
use crate::math::Vec2;
use crate::resolution::blows::Blows;
use crate::resolution::constraint::StepResidual;
use crate::resolution::constraint::warm_start::NEW_LOAD_ACCELERATION;
use crate::resolution::constraint_graph::ConstraintGraph;
use crate::resolution::contact_block::Beginning;
use crate::resolution::damping::{Damped, is_damped};
use crate::resolution::direct::DirectSolver;
use crate::resolution::events::{Continuous, Courses, EventScene, Impacts, Seams, Strikes};
use crate::resolution::integrate::{Advance, Kick, Kicks, integrate};
use crate::resolution::islands::{Connections, Islands};
use crate::resolution::joint::{JointSolver, Phase};
use crate::resolution::kernel::{MOST_TURNED, Roll, SweepOver, WarmStart, WarmStartTime};
use crate::resolution::load::{LoadMeasure, Loads};
use crate::resolution::mass_scaling::MassScaling;
use crate::resolution::moving::MovingContacts;
use crate::resolution::projection::Project;
use crate::resolution::scheme::Scheme;
use crate::resolution::tangles::Tangles;

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

/// What it costs to write the compensation of a body back, ns.
const COMPENSATION_COST: usize = 3;

/// Turns of joints and contacts of joined bodies in a phase, at most. Each leaves of what is wrong the share by which a body is
/// lighter by itself than with what hangs on it; what is left is for the next phase, which begins with the impulses of this.
const JOINT_ROUNDS: u32 = 8;

/// Joined bodies are settled when contacts push them by less than this, m/s: a thousandth of what a substep falls.
const SETTLED: f64 = 4e-5;

/// Buffers of the solver, kept from step to step.
#[derive(Debug, Default)]
pub(crate) struct Solver {
    mass_scaling: MassScaling,
    kicks: Kicks,
    damped: Damped,
    pub(crate) impacts: Impacts,
    pub(crate) continuous: Continuous,
    courses: Courses,
    strikes: Strikes,
    pub(crate) blows: Blows,
    moving: MovingContacts,
    seams: Seams,
    direct: DirectSolver,
    /// Whether anything that is swept rolls with resistance.
    rolls: bool,
    tangles: Tangles,
    pub(crate) joints: JointSolver,
}

clone_into_buffers!(Solver { blows, joints } scratch {
    mass_scaling, kicks, damped, impacts, continuous, courses, strikes, moving, seams, direct, rolls, tangles
});

/// The tables that a step changes.
#[derive(Debug)]
pub(crate) struct SolveTables<'a> {
    pub(crate) bodies: &'a mut Bodies,
    pub(crate) contacts: &'a mut Contacts,
    pub(crate) graph: &'a mut ConstraintGraph,
    pub(crate) loads: &'a mut Loads,
    pub(crate) joints: &'a mut Joints,
    pub(crate) broad_phase: &'a BroadPhase,
    pub(crate) mixes: Mixes,
    /// Who does the work.
    pub(crate) executor: Executor<'a>,
}

/// One step: moves the velocities and deltas of all rows, and the impulses of contacts.
///
/// ```text
/// scale inertia    what is pressed harder than substeps can follow turns more slowly in this step
/// repeat substeps:
///     kick h/2     v += h/2 a(x), and damping
///     impacts      what approaches fast enough bounces, each at its time
///     push         half of the last impulses, then joints, so that what they hold is exact after the move, and a sweep that pushes
///                  overlaps apart; stiff islands are solved directly; joined bodies and their contacts in turn
///     seams        circles that roll onto another piece of ground meet it, each at its time
///     continuous   what is off course is swept and meets what is on its way
///     drift h      x += h v; what pushed stiff islands is taken back
///     kick h/2     v += h/2 a(x), and damping
///     refresh      contacts of circles and loaded corners follow the surface
///     relax        the other half of the last impulses; rolling resistance; joints, so that what they hold does not part; a sweep
///                  without bias, with friction; rolling resistance under the load that it found; stiff islands directly, with all that presses;
///                  joined bodies and their contacts in turn
/// untangle         bodies of several shapes that are deep in each other are moved apart, which makes no speed
/// project          in the classic scheme: overlaps are parted by moving bodies
/// ```
///
/// Each half of the last impulses acts with the geometry of its moment: a circle that rolls along a curve is turned by
/// half before and by half after the move, and keeps its speed (H. Andersen, "Rattle", 1983).
pub(crate) fn solve(
    solver: &mut Solver,
    scheme: &Scheme,
    islands: &Islands,
    tables: &mut SolveTables<'_>,
    acceleration: &impl Acceleration,
) -> StepResidual {
    let SolveTables { loads, contacts, graph, bodies, joints, .. } = &mut *tables;
    solver.mass_scaling.begin(loads, contacts, graph, bodies, joints, scheme.substep_time());
    loads.clear();
    solver.prepare(scheme, islands, tables, acceleration);
    for substep in 0..scheme.substeps {
        solver.kick(scheme, tables);
        // What a sweep after the move has found of where bodies are holds until they move again.
        let has_moved = solver.run_impacts(scheme, tables) || (substep > 0 && scheme.relax_iterations == 0);
        solver.push(scheme, tables, has_moved);
        solver.blows.begin_move(tables.graph, scheme.warm_part(), tables.executor.width);
        solver.cross_seams(scheme, tables);
        solver.sweep_those_off_course(scheme, tables);
        solver.drift_and_kick(scheme, tables, acceleration);
        solver.refresh(tables);
        solver.blows.end_move(tables.graph, scheme.warm_part(), tables.executor.width);
        solver.relax(scheme, tables);
        solver.blows.end_substep(tables.graph, tables.executor.width);
    }
    solver.tangles.untangle(tables.graph, &mut tables.bodies.states, scheme.dt);
    for _ in 0..scheme.projections.unwrap_or(0) {
        tables.graph.for_each_swept(tables.executor, &mut tables.bodies.states, &Project::CLASSIC);
    }
    let residual = solver.finish(scheme, tables);
    solver.mass_scaling.end(tables.bodies);
    residual
}

impl Solver {
    /// v += t a, and damping.
    fn kick(&mut self, scheme: &Scheme, tables: &mut SolveTables<'_>) {
        self.integrate(scheme, tables, None, Some(scheme.kick_time()));
    }

    /// x += h v, and the second kick: in one pass, unless something is to be found, or taken back, in between.
    fn drift_and_kick(
        &mut self,
        scheme: &Scheme,
        tables: &mut SolveTables<'_>,
        acceleration: &impl Acceleration,
    ) {
        let drift = Some(scheme.substep_time());
        let kick = scheme.split_kick.then_some(scheme.kick_time());
        if !acceleration.varies() && self.direct.is_empty() {
            return self.integrate(scheme, tables, drift, kick);
        }
        self.integrate(scheme, tables, drift, None);
        if acceleration.varies() {
            self.accelerate(scheme, tables, acceleration);
        }
        self.direct.take_back_push(&mut tables.bodies.states, &mut self.joints);
        self.integrate(scheme, tables, None, kick);
    }

    /// Impacts of contacts that approach fast enough to bounce; whether there were some, which move bodies.
    fn run_impacts(&mut self, scheme: &Scheme, tables: &mut SolveTables<'_>) -> bool {
        self.seams.release(tables.graph);
        if !self.joints.is_empty() {
            self.joints.begin_substep(&tables.bodies.states);
        }
        let Self { impacts, kicks, courses, strikes, blows, .. } = self;
        strikes.begin_substep(tables.bodies.row_count());
        impacts.len() > 0 && impacts.run(&mut event_scene(tables, scheme, kicks, courses, strikes, blows))
    }

    /// Contacts before the bodies move. `has_moved` says that they have since the last sweep.
    fn push(&mut self, scheme: &Scheme, tables: &mut SolveTables<'_>, has_moved: bool) {
        let h = scheme.substep_time();
        self.seams.hold_back(tables.graph, &tables.bodies.states, h);
        if !self.joints.is_empty() {
            self.joints.begin_push(&tables.bodies.states);
        }
        warm_start(WarmStartTime::BeforeMove, scheme, tables);
        self.direct.begin(tables.graph, &tables.bodies.states, Phase::Push, h);
        if !self.joints.is_empty() {
            self.joints.push(scheme, &self.kicks, &mut tables.bodies.states);
        }
        let (graph, states) = (&mut *tables.graph, &mut tables.bodies.states);
        let sweep = scheme.sweep_over(scheme.main_sweep(), has_moved);
        for _ in 0..scheme.iterations {
            graph.for_each_swept(tables.executor, states, &sweep);
        }
        self.direct.solve(states, &mut self.joints);
        self.hold_joints(Phase::Push, scheme, &sweep, tables);
    }

    /// Joints and the contacts of their bodies in turn, until what contacts push joints have passed on.
    fn hold_joints(
        &mut self,
        phase: Phase,
        scheme: &Scheme,
        sweep: &SweepOver,
        tables: &mut SolveTables<'_>,
    ) {
        if self.joints.is_empty() {
            return;
        }
        let states = &mut tables.bodies.states;
        let sweep = SweepOver { have_moved: false, ..sweep.clone() };
        for _ in 0..JOINT_ROUNDS {
            if !self.joints.pass_on(phase, states, SETTLED) {
                break;
            }
            for &contact in self.joints.contacts() {
                tables.graph.run_at(contact, states, &sweep);
            }
            self.direct.solve_again(states, &mut self.joints, SETTLED);
        }
        self.joints.solve_again(phase, scheme, states);
    }

    /// Circles that roll from one piece of ground onto the next during the move.
    fn cross_seams(&mut self, scheme: &Scheme, tables: &mut SolveTables<'_>) {
        let Self { seams, kicks, courses, strikes, blows, .. } = self;
        seams.run(&mut event_scene(tables, scheme, kicks, courses, strikes, blows));
    }

    /// Bodies whose velocities the contacts have changed, so that they may meet others than they were found with.
    fn sweep_those_off_course(&mut self, scheme: &Scheme, tables: &mut SolveTables<'_>) {
        let Self { impacts, continuous, courses, kicks, strikes, blows, .. } = self;
        continuous.run(&mut event_scene(tables, scheme, kicks, courses, strikes, blows), impacts);
        if !self.joints.is_empty() {
            self.joints.solve_again(Phase::Push, scheme, &mut tables.bodies.states);
        }
    }

    /// Contacts after the bodies have moved.
    fn relax(&mut self, scheme: &Scheme, tables: &mut SolveTables<'_>) {
        if scheme.split_kick && scheme.warm_starting {
            warm_start(WarmStartTime::AfterMove, scheme, tables);
        }
        let h = scheme.substep_time();
        self.direct.begin(tables.graph, &tables.bodies.states, Phase::Relax, h);
        self.roll(tables);
        if !self.joints.is_empty() {
            self.joints.relax(scheme, &mut tables.bodies.states);
        }
        for iteration in 0..scheme.relax_iterations {
            let sweep = scheme.sweep_over(scheme.relax_sweep(), iteration == 0);
            tables.graph.for_each_swept(tables.executor, &mut tables.bodies.states, &sweep);
        }
        self.roll(tables);
        self.direct.solve(&mut tables.bodies.states, &mut self.joints);
        if scheme.split_kick {
            let sweep = scheme.sweep_over(scheme.relax_sweep(), false);
            self.hold_joints(Phase::Relax, scheme, &sweep, tables);
        }
        if !self.joints.is_empty() {
            self.joints.end_substep(scheme);
        }
        self.direct.write_back(tables.graph);
    }

    /// A pass over all that rolls with resistance; none where nothing does.
    fn roll(&self, tables: &mut SolveTables<'_>) {
        if self.rolls {
            tables.graph.for_each_swept(tables.executor, &mut tables.bodies.states, &Roll);
        }
    }

    /// Contact geometry that moves within the step, where the bodies are now.
    fn refresh(&self, tables: &mut SolveTables<'_>) {
        let SolveTables { bodies, contacts, graph, executor, .. } = tables;
        self.moving.follow(*executor, contacts, bodies, graph);
    }

    /// Fills the rows of kicks, the constraints, and the contacts that may bounce.
    fn prepare(
        &mut self,
        scheme: &Scheme,
        islands: &Islands,
        tables: &mut SolveTables<'_>,
        acceleration: &impl Acceleration,
    ) {
        self.prepare_kicks(scheme, tables, acceleration);
        self.courses.begin(tables.bodies, scheme.dt, scheme.continuous);
        self.continuous.clear();
        self.joints.prepare(tables.joints, tables.bodies);
        let SolveTables { bodies, contacts, graph, executor, .. } = &mut *tables;
        let from = Beginning { contacts, bodies, dt: scheme.dt, asked: scheme.asked };
        graph.prepare(*executor, from);
        self.gather_special(graph, scheme);
        self.tangles.prepare(bodies, contacts, graph);
        self.blows.take_up_unfinished(contacts, graph);
        self.joints.find_contacts(bodies, contacts, graph);
        self.direct.clear();
        for island in islands.iter() {
            let connections = Connections { contacts: &*tables.contacts, joints: &*tables.joints };
            self.direct.add_island(island, tables.bodies, connections, tables.graph, &self.joints);
        }
    }

    fn prepare_kicks(&mut self, scheme: &Scheme, tables: &SolveTables<'_>, acceleration: &impl Acceleration) {
        let bodies = &*tables.bodies;
        let has_damping = AtomicBool::new(false);
        let (limits, time) = (scheme.limits, scheme.kick_time());
        self.kicks.fill(tables.executor.pool, bodies.row_count(), |row| {
            let Some(slot) = bodies.dynamic_in(row) else { return Kick::default() };
            let (motion, forcing) = (&bodies.motions[slot as usize], &bodies.forcings[slot as usize]);
            if is_damped(forcing) {
                has_damping.store(true, Ordering::Relaxed);
            }
            let steady = steady(bodies, slot, acceleration);
            let angular = forcing.torque * motion.inverse_inertia;
            Kick {
                acceleration: limits.cut_acceleration(steady, time).into(),
                compensation: motion.velocity_compensation.into(),
                angular_acceleration: limits.cut_angular_acceleration(angular, time),
            }
        });
        self.damped.clear();
        if has_damping.into_inner() {
            let dynamic = (1..bodies.row_count()).filter_map(|row| Some((row, bodies.dynamic_in(row)?)));
            let forcings = dynamic.map(|(row, slot)| (row, &bodies.forcings[slot as usize]));
            self.damped.add(forcings.filter(|&(_, forcing)| is_damped(forcing)), scheme.kick_time());
        }
        if acceleration.varies() {
            self.accelerate(scheme, tables, acceleration);
        }
    }

    /// Takes up the contacts of which something special is to be expected within the step.
    fn gather_special(&mut self, graph: &ConstraintGraph, scheme: &Scheme) {
        self.impacts.clear();
        self.moving.clear();
        self.seams.clear();
        self.blows.clear();
        self.rolls = false;
        let Self { impacts, moving, seams, blows, rolls, .. } = self;
        for (index, block) in graph.blocks() {
            let marks = block.marks;
            if marks.bouncy.any() {
                impacts.take_up_block(index, marks.bouncy);
            }
            if marks.asked.any() {
                blows.take_up_block(index, graph, scheme.substeps);
            }
            moving.take_up_block(index, marks, graph);
            if !index.is_solved_directly() {
                *rolls |= block.rolls();
                marks.on_ground.for_each(|place| seams.take_up(index.contact(place), graph));
            }
        }
        self.seams.group();
    }

    /// Finds the accelerations that depend on the place anew.
    fn accelerate(&mut self, scheme: &Scheme, tables: &SolveTables<'_>, acceleration: &impl Acceleration) {
        let bodies = &*tables.bodies;
        self.kicks.accelerate(tables.executor.pool, |row| {
            let slot = bodies.dynamic_in(row)?;
            let varying = acceleration.at(bodies, slot, bodies.states[row].delta_position.to_vec2());
            let sum = steady(bodies, slot, acceleration) + varying;
            Some(scheme.limits.cut_acceleration(sum, scheme.kick_time()))
        });
    }

    /// Moves all bodies on: x += t v over a drift, then v += t a and damping over a kick.
    fn integrate(
        &mut self,
        scheme: &Scheme,
        tables: &mut SolveTables<'_>,
        drift: Option<f32>,
        kick: Option<f32>,
    ) {
        let advance = Advance { drift, kick, limits: scheme.limits };
        integrate(tables.executor, &mut tables.bodies.states, &mut self.kicks, advance);
        if kick.is_some() {
            self.damped.slow_down(&mut tables.bodies.states);
        }
    }

    /// Writes impulses back into the contacts and joints, and compensations back into the bodies.
    fn finish(&mut self, scheme: &Scheme, tables: &mut SolveTables<'_>) -> StepResidual {
        let rows = 1..tables.bodies.row_count();
        self.joints.finish(scheme, tables.joints, &tables.bodies.states);
        let SolveTables { bodies, contacts, graph, loads, executor, .. } = tables;
        self.blows.end_substeps(graph);
        let measure = LoadMeasure::new(scheme.adapts, scheme.dt, scheme.substeps, scheme.asked_substeps);
        loads.outcomes.extend(self.direct.outcomes(bodies, scheme.asked_substeps, measure));
        let residual = graph.finish(*executor, &bodies.states, contacts, measure, loads);
        let motions = Chosen::new(&mut bodies.motions, &bodies.awake);
        executor.pool.run((rows, motions), COMPENSATION_COST, |(rows, mut motions)| {
            for (place, row) in rows.enumerate() {
                motions.get_mut(place).velocity_compensation = self.kicks.compensation(row);
            }
        });
        residual
    }
}

/// One of the warm starts of a substep.
fn warm_start(time: WarmStartTime, scheme: &Scheme, tables: &mut SolveTables<'_>) {
    let start = WarmStart {
        part: scheme.warm_part(),
        fastest_turn: MOST_TURNED / scheme.substep_time(),
        new_load_speed: scheme.warm_part() * NEW_LOAD_ACCELERATION * scheme.substep_time(),
        time,
        is_fitted: scheme.fitted_kernels,
    };
    let (graph, states) = (&mut *tables.graph, &mut tables.bodies.states);
    graph.for_each_swept(tables.executor, states, &start);
}

/// The part of the acceleration of the body in `slot` that stays the same during the step, m/s².
fn steady(bodies: &Bodies, slot: u32, acceleration: &impl Acceleration) -> Vec2 {
    let (motion, forcing) = (&bodies.motions[slot as usize], &bodies.forcings[slot as usize]);
    acceleration.uniform() * forcing.gravity_scale + forcing.force * motion.inverse_mass
}

/// The acceleration by forces of the body in `slot`, where it is as the step begins, m/s².
pub(super) fn acceleration_of(bodies: &Bodies, slot: u32, acceleration: &impl Acceleration) -> Vec2 {
    let varying = if acceleration.varies() { acceleration.at(bodies, slot, Vec2::ZERO) } else { Vec2::ZERO };
    steady(bodies, slot, acceleration) + varying
}

/// The force on the body in `slot`, N: that of [`acceleration_of`], and what turns its velocity with a wheel that it rides on, m ω × v.
pub(crate) fn force_on(bodies: &Bodies, slot: u32, acceleration: &impl Acceleration) -> f32 {
    let state = bodies.state(slot);
    let by_turning = state.velocity.to_vec2() * state.angular_velocity;
    let by_forces = acceleration_of(bodies, slot, acceleration);
    (by_forces.length() + by_turning.length()) / bodies.motions[slot as usize].inverse_mass
}

/// What events happen to.
fn event_scene<'a>(
    tables: &'a mut SolveTables<'_>,
    scheme: &'a Scheme,
    kicks: &'a Kicks,
    courses: &'a mut Courses,
    strikes: &'a mut Strikes,
    blows: &'a mut Blows,
) -> EventScene<'a> {
    let SolveTables { bodies, contacts, graph, joints, broad_phase, mixes, .. } = tables;
    EventScene {
        bodies,
        contacts,
        joints,
        broad_phase,
        mixes: *mixes,
        courses,
        strikes,
        blows,
        kicks,
        graph,
        scheme,
    }
}
