//! The direct solve: all contacts of a stiff island at once, where sweeps would need thousands.
//!
//! A sweep passes a load on by one body, and to a light body under a heavy one only a little of it: a tower of n
//! boxes needs n² sweeps, a mass ratio of n needs n. Here the velocities v of an island minimize
//!
//! ```text
//! φ(v) = ½ (v - v₀)ᵀ M (v - v₀)  +  Σ p(vn + bias; c k)  +  Σ f(vt; c k_t, µ λ)
//! ```
//!
//! v₀ being the velocities without contacts. p(u; s) = min(u - s λ₀, 0)²/(2s) makes λ = max(0, λ₀ - u/s) the normal
//! impulse. c is a compliance without unit, k what a unit of impulse does to vn, and λ₀ the impulse of the last substep or of the stage
//! before: a point yields to a change of load and not to the load, so that at rest nothing sags (method of multipliers; M. Hestenes, 1969). f is Huber's function, whose slope is
//! the friction, cut off at ±µ λ. φ is convex and piecewise quadratic, so Newton's method with a line search finds the
//! minimum in a few steps, each a Cholesky factorization of
//!
//! ```text
//! H = M + Σ Jnᵀ Jn/(c k) + Σ Jtᵀ Jt/(c k_t)      over points that press, and points that stick
//! ```
//!
//! with 3 rows for each body, in an order that keeps rows near those of their neighbours (E. Cuthill & J. McKee,
//! 1969). The limits of friction follow the normal impulses from step to step (P. Alart & A. Curnier, "A mixed
//! formulation for frictional contact problems prone to Newton like solution methods", 1991, gives the joint method;
//! to hold the limits within a step keeps H symmetric).
//!
//! Cost: bodies × band², so for chains, towers and small heaps only.

mod contact;
mod joint;
mod newton;
mod row;
mod skyline;

use core::ops::Range;

use crate::body::Bodies;
use crate::compute::BodyState;
use crate::math::Vec2;
use crate::resolution::constraint_graph::ConstraintGraph;
use crate::resolution::direct::contact::DirectContact;
use crate::resolution::direct::joint::DirectJoint;
use crate::resolution::direct::newton::{Newton, Part};
use crate::resolution::direct::row::Triple;
use crate::resolution::islands::Connections;
use crate::resolution::joint::{JointSolver, Phase};

/// Where Newton's method does not solve an island of no more bodies than this, that is tried again in the next step: to
/// leave it to the sweeps of [`Tier::Swept`](crate::Tier), 42 of 10,000 random worlds show an overlap of 1 cm, and 1 so. More
/// bodies take more time than that is worth.
const LARGEST_SMALL_ISLAND: usize = 32;

/// The islands that are solved directly.
///
/// In a step: `clear`, and `add_island` for each, once the constraints are there; in each phase of a substep `begin`, `solve`, and where
/// joints have answered `solve_joined`; after the drift `take_back_push`; and in the end `write_back`: only the second phase gives the
/// contacts their impulses.
#[derive(Clone, Debug, Default)]
pub(crate) struct DirectSolver {
    /// The row of each mover among the states.
    states_of_movers: Vec<u32>,
    /// By row of the states, which mover it is.
    mover_of_row: Vec<Option<u32>>,
    contacts: Vec<DirectContact>,
    joints: Vec<DirectJoint>,
    islands: Vec<Island>,
    newton: Newton,
    /// Of each row what it has handed over to a joint in this phase.
    handed: Vec<f64>,
    /// Of each mover its velocities without what it was given in this phase, and those that it was given last.
    without: Vec<[f32; 3]>,
    given: Vec<[f32; 3]>,
}

#[derive(Clone, Debug)]
struct Island {
    part: Part,
    /// Its joints. What they hold has to be known when these are solved, so its contacts begin with what they bore before.
    joints: Range<usize>,
}

impl Island {
    fn is_joined(&self) -> bool {
        self.joints.start < self.joints.end
    }
}

impl DirectSolver {
    pub(crate) fn clear(&mut self) {
        self.states_of_movers.clear();
        self.contacts.clear();
        self.joints.clear();
        self.islands.clear();
        self.newton.clear();
    }

    /// Takes up an island: the slots of its bodies, in the order of the matrix.
    pub(crate) fn add_island(
        &mut self,
        island: &[u32],
        bodies: &Bodies,
        connections: Connections<'_>,
        graph: &ConstraintGraph,
        joint_solver: &JointSolver,
    ) {
        let Connections { contacts, joints } = connections;
        let (first_mover, first_joint) = (self.states_of_movers.len(), self.joints.len());
        let begin = self.newton.end();
        self.mover_of_row.resize(bodies.row_count(), None);
        for &slot in island {
            let motion = &bodies.motions[slot as usize];
            let mass = f64::from(motion.inverse_mass).recip();
            let can_turn = motion.inverse_inertia > 0.0;
            // Of what cannot be turned any will do: nothing turns it.
            let inertia = if can_turn { f64::from(motion.inverse_inertia).recip() } else { 1.0 };
            self.mover_of_row[motion.row as usize] = Some(self.states_of_movers.len() as u32);
            self.states_of_movers.push(motion.row);
            self.newton.masses.push([mass, mass, inertia]);
        }
        for &slot in island {
            for index in joints.of_body(slot) {
                let Some((rows, of_bodies)) = joint_solver.rows_of_joint(index) else { continue };
                let movers = of_bodies.map(|row| self.mover_of_row[row as usize]);
                if movers.contains(&None) || slot == joints.all[index].slot_a {
                    self.joints.push(DirectJoint::new(rows, movers, &mut self.newton));
                }
            }
        }
        for &slot in island {
            for index in contacts.of_body(bodies, slot) {
                let contact = &contacts[index];
                let Some(home) = graph.home(index) else { continue };
                // The ground's row is no mover's.
                let movers = graph.moved_rows(home).map(|row| self.mover_of_row[row as usize]);
                // A contact is in the lists of both its bodies.
                if movers.contains(&None) || slot == contact.slots[0] {
                    let points = contact.manifold.points().len();
                    let speed = bodies.roles.surface_speed(contact.colliders).unwrap_or(0.0);
                    let are_joined = joint_solver.connects(contact.slots);
                    self.contacts.push(DirectContact::new(
                        home,
                        points,
                        movers,
                        speed,
                        are_joined,
                        &mut self.newton,
                    ));
                }
            }
        }
        for &row in &self.states_of_movers[first_mover..] {
            self.mover_of_row[row as usize] = None;
        }
        let part = self.newton.part_from(begin);
        self.islands.push(Island { part, joints: first_joint..self.joints.len() });
        self.without.resize(self.states_of_movers.len(), [0.0; 3]);
        self.given.resize(self.states_of_movers.len(), [0.0; 3]);
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.islands.is_empty()
    }

    /// Rows of the bodies of islands that Newton's method did not solve in this step, but for small ones, which are tried
    /// again in the next.
    pub(crate) fn unsolved_rows(&self) -> impl Iterator<Item = u32> {
        let parts = self.islands.iter().map(|island| &island.part);
        parts
            .filter(|part| part.is_unsolved && part.movers.len() > LARGEST_SMALL_ISLAND)
            .flat_map(|part| self.states_of_movers[part.movers.clone()].iter().copied())
    }

    /// Begins a phase, from the constraints of the contacts and the states of the bodies. Where bodies are joined, contacts begin with
    /// what they bore before.
    pub(crate) fn begin(&mut self, graph: &ConstraintGraph, states: &mut [BodyState], phase: Phase, h: f32) {
        self.handed.clear();
        self.handed.resize(self.newton.rows.len(), 0.0);
        let Self { states_of_movers, contacts, islands, newton, without, given, .. } = self;
        for row in &mut newton.rows {
            row.impulse = 0.0;
        }
        for contact in contacts {
            contact.fill_rows(&mut newton.rows, graph, states, phase, 1.0 / h);
        }
        for (given, &row) in given.iter_mut().zip(&*states_of_movers) {
            *given = velocity_of(&states[row as usize]);
        }
        without.copy_from_slice(given);
        for island in islands.iter().filter(|island| island.is_joined()) {
            newton.find_gains(&island.part);
            for mover in island.part.movers.clone() {
                let with_gains =
                    [0, 1, 2].map(|axis| f64::from(given[mover][axis]) + newton.gains[mover][axis]);
                given[mover] = give(with_gains, &mut states[states_of_movers[mover] as usize]);
            }
        }
    }

    /// Finds the impulses of contacts, and the velocities with them. Joints are still to answer to how their bodies turn by that.
    pub(crate) fn solve(&mut self, states: &mut [BodyState], joints: &mut JointSolver, phase: Phase) {
        for number in 0..self.islands.len() {
            self.solve_island(number, states, joints, phase);
        }
    }

    /// The same of islands whose joints have answered.
    pub(crate) fn solve_joined(&mut self, states: &mut [BodyState], joints: &mut JointSolver, phase: Phase) {
        for number in 0..self.islands.len() {
            if self.islands[number].is_joined() {
                self.solve_island(number, states, joints, phase);
            }
        }
    }

    fn solve_island(
        &mut self,
        number: usize,
        states: &mut [BodyState],
        joints: &mut JointSolver,
        phase: Phase,
    ) {
        self.note_changes(number, states);
        let Self { states_of_movers, islands, newton, given, handed, .. } = self;
        let is_joined = islands[number].is_joined();
        let Island { part, joints: of_island } = &mut islands[number];
        for mover in part.movers.clone() {
            newton.free[mover] = given[mover].map(f64::from);
        }
        for joint in &self.joints[of_island.clone()] {
            joint.fill_rows(&mut newton.rows, joints, phase, &newton.free);
        }
        if is_joined {
            newton.take_out_gains(part);
        }
        newton.solve(part);
        for joint in &self.joints[of_island.clone()] {
            joint.hand_over(&newton.rows, joints, handed);
        }
        for mover in part.movers.clone() {
            given[mover] = give(newton.sought[mover], &mut states[states_of_movers[mover] as usize]);
        }
    }

    /// Takes note of how others have changed the velocities of an island since they were given.
    fn note_changes(&mut self, number: usize, states: &[BodyState]) {
        for mover in self.islands[number].part.movers.clone() {
            let now = velocity_of(&states[self.states_of_movers[mover] as usize]);
            let given = std::mem::replace(&mut self.given[mover], now);
            let without = &mut self.without[mover];
            *without = [0, 1, 2].map(|axis| without[axis] + (now[axis] - given[axis]));
        }
    }

    /// Takes back, when the bodies have moved, what they were given before: what presses in the end is found anew. What has struck bodies
    /// since stays, and what their joints have answered.
    pub(crate) fn take_back_push(&mut self, states: &mut [BodyState], joints: &mut JointSolver) {
        for joint in &self.joints {
            joint.take_back(joints, &self.handed);
        }
        for number in 0..self.islands.len() {
            self.note_changes(number, states);
        }
        for (&row, without) in self.states_of_movers.iter().zip(&self.without) {
            give(without.map(f64::from), &mut states[row as usize]);
        }
    }

    /// Gives the contacts the impulses that were found last.
    pub(crate) fn write_back(&self, graph: &mut ConstraintGraph) {
        for contact in &self.contacts {
            contact.write_back(&self.newton.rows, graph);
        }
    }
}

/// Along x and y, and of the turn, m/s and rad/s.
fn velocity_of(state: &BodyState) -> [f32; 3] {
    [state.velocity.x, state.velocity.y, state.angular_velocity]
}

/// Gives a body a velocity; returns it as the body has it.
fn give(velocity: Triple, state: &mut BodyState) -> [f32; 3] {
    let [x, y, w] = velocity.map(|v| v as f32);
    (state.velocity, state.angular_velocity) = (Vec2::new(x, y).into(), w);
    [x, y, w]
}
