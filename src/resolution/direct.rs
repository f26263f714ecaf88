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
//! before: a point yields to a change of load and not to the load, so that at rest nothing sags (method of multipliers; M. Hestenes, 1969). f is
//! Huber's function, whose slope is the friction, cut off at ±µ λ. What yields to its load as well, as springs and motors do, has a softness
//! beside c k. φ is convex and piecewise quadratic, so Newton's method with a line search finds the minimum in a few steps, each a Cholesky
//! factorization of
//!
//! ```text
//! H = M + Σ Jnᵀ Jn/(c k) + Σ Jtᵀ Jt/(c k_t)      over points that press, and points that stick
//! ```
//!
//! with 3 rows for each body, in an order that keeps rows near those of their neighbours (E. Cuthill & J. McKee,
//! 1969). The limits of friction are held until the minimum is found, then set from the normal impulses, and so on until they stay (a
//! fixed-point iteration: K. Kunisch & G. Stadler, "Generalized Newton methods for the 2D-Signorini contact problem with
//! friction in function space", 2005). To hold them keeps H symmetric and φ convex. There may be two solutions, one in which a body sticks and
//! one in which it slips. What rests has to stay at rest, so the limits begin high: with the greater of the last normal impulse and that of
//! the first Newton step, in which all is held.
//!
//! Some limits go to and fro without end. After some steps they are held where they are: friction that is over its limit takes energy, and
//! heaps of gravel lie still by it. Where one side moves by itself, as a belt does, friction gives energy. So no limit is more than a multiple of
//! all that rests on the bodies of the island.
//!
//! Where walls leave a body too little room, no impulses are enough, and what has not lessened the overlap must not be kept as λ₀. So λ₀ is no more
//! than a multiple of what all bodies of the island can press with, and what is squeezed yields to the rest.
//!
//! Where bodies are joined, the rows of their joints are rows as well, see [`joint`].
//!
//! A substep has two such solves, each repeated where joints answer to it. The one before the move balances half of the forces of the substep
//! and corrects penetration: it says where bodies go. Its impulses are then taken back: a correction is no speed, and the bodies are no longer
//! where they acted. The one after the move finds the impulses under all the forces. It lets no point that bears close a gap: what yields by c k
//! swings with ω² h² = 1/(c k M) under a mass M, and a velocity that follows the gap, v = -s/h, makes such swings grow.
//!
//! Cost: bodies × band², so for chains, towers and small heaps only.

mod contact;
mod joint;
mod newton;
mod row;
mod skyline;

pub(crate) use skyline::work_of_factorization;

use core::ops::Range;

use crate::body::Bodies;
use crate::compute::BodyState;
use crate::math::Vec2;
use crate::resolution::constraint_graph::ConstraintGraph;
use crate::resolution::direct::contact::DirectContact;
use crate::resolution::direct::joint::DirectJoint;
use crate::resolution::direct::newton::{Newton, Part};
use crate::resolution::islands::Connections;
use crate::resolution::joint::{JointSolver, Phase};
use crate::resolution::load::{DirectOutcome, LoadMeasure};

/// The islands that are solved directly.
///
/// In a step: `clear`, and `add_island` for each, once the constraints are there; in each phase of a substep `begin`, `solve`, and where
/// joints have answered `solve_again`; after the drift `take_back_push`; and after the second phase `write_back`.
/// Only the impulses of the second phase are what contacts have borne.
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
}

#[derive(Clone, Debug)]
struct Island {
    part: Part,
    contacts: Range<usize>,
    joints: Range<usize>,
    /// The greatest [`DirectContact::speed_over_width`] of the last push, 1/s.
    speed_over_width: f64,
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
        let first_contact = self.contacts.len();
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
        let mass_ratio = self.newton.mass_ratio(first_mover..self.states_of_movers.len());
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
                    let newton = &mut self.newton;
                    self.contacts.push(DirectContact::new(
                        contact,
                        home,
                        movers,
                        bodies,
                        joint_solver,
                        mass_ratio,
                        newton,
                    ));
                }
            }
        }
        for &row in &self.states_of_movers[first_mover..] {
            self.mover_of_row[row as usize] = None;
        }
        let part = self.newton.part_from(begin);
        let (contacts, joints) = (first_contact..self.contacts.len(), first_joint..self.joints.len());
        self.islands.push(Island { part, contacts, joints, speed_over_width: 0.0 });
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.islands.is_empty()
    }

    /// How it went in this step, of so many substeps that were asked for, for the bodies of each island.
    pub(crate) fn outcomes(
        &self,
        bodies: &Bodies,
        substeps: u32,
        measure: LoadMeasure,
    ) -> impl Iterator<Item = DirectOutcome> {
        self.islands.iter().flat_map(move |Island { part, speed_over_width, .. }| {
            let work = part.work_per_mover() / substeps as f32;
            self.states_of_movers[part.movers.clone()].iter().map(move |&row| DirectOutcome {
                slot: bodies.slot_of_row(row as usize),
                work,
                is_solved: !part.is_unsolved,
                sag_share: measure.sag(*speed_over_width as f32),
            })
        })
    }

    /// Begins a phase: rows get the geometry of now, and impulses to begin the search with. These do not act yet: the impulses of an impact in
    /// the last substep would throw bodies apart before their joints hold them.
    pub(crate) fn begin(&mut self, graph: &ConstraintGraph, states: &[BodyState], phase: Phase, h: f32) {
        for joint in &self.joints {
            joint.begin(&mut self.newton.rows);
        }
        for contact in &self.contacts {
            contact.fill_rows(&mut self.newton.rows, graph, states, phase, 1.0 / h);
        }
    }

    /// Finds the impulses of contacts, and the velocities with them, for the first time in a phase. Joints have still to answer to how their
    /// bodies turn by that.
    pub(crate) fn solve(&mut self, states: &mut [BodyState], joints: &mut JointSolver) {
        for number in 0..self.islands.len() {
            self.solve_island(number, states, joints, false);
        }
    }

    /// Finds them again for islands whose velocities others have changed since by more than so much, m/s: joints that have answered.
    pub(crate) fn solve_again(&mut self, states: &mut [BodyState], joints: &mut JointSolver, more_than: f64) {
        for number in 0..self.islands.len() {
            if self.fastest_change(number, states) > more_than {
                self.solve_island(number, states, joints, true);
            }
        }
    }

    /// Solves an island; `acted` says that its impulses have acted in this phase.
    fn solve_island(
        &mut self,
        number: usize,
        states: &mut [BodyState],
        joints: &mut JointSolver,
        acted: bool,
    ) {
        let Self { states_of_movers, islands, newton, .. } = self;
        let Island { part, joints: of_island, .. } = &mut islands[number];
        for mover in part.movers.clone() {
            newton.free[mover] = velocity_of(&states[states_of_movers[mover] as usize]).map(f64::from);
        }
        for joint in &self.joints[of_island.clone()] {
            joint.fill_rows(&mut newton.rows, joints, &newton.free);
        }
        if acted {
            newton.take_out_changes(part);
        }
        newton.solve(part);
        for joint in &self.joints[of_island.clone()] {
            joint.hand_over(&newton.rows, joints);
        }
        for mover in part.movers.clone() {
            give(newton.sought[mover].map(|v| v as f32), &mut states[states_of_movers[mover] as usize]);
        }
    }

    /// By how much others have changed the velocities of an island since they were given, m/s: the most of √(v² + r² ω²), r being the radius of
    /// gyration of a body.
    fn fastest_change(&self, number: usize, states: &[BodyState]) -> f64 {
        let of_mover = |mover: usize| {
            let [x, y, w] = self.change_since_given(mover, states).map(f64::from);
            let [mass, _, inertia] = self.newton.masses[mover];
            (x * x + y * y + w * w * inertia / mass).sqrt()
        };
        self.islands[number].part.movers.clone().map(of_mover).fold(0.0, f64::max)
    }

    /// How others have changed the velocity of a mover since it was given.
    fn change_since_given(&self, mover: usize, states: &[BodyState]) -> [f32; 3] {
        let (now, given) =
            (velocity_of(&states[self.states_of_movers[mover] as usize]), self.newton.sought[mover]);
        [0, 1, 2].map(|axis| now[axis] - given[axis] as f32)
    }

    /// Takes the impulses of the first phase out of the velocities when the bodies have moved. What has struck bodies since stays, and what
    /// joints have answered.
    pub(crate) fn take_back_push(&mut self, states: &mut [BodyState], joints: &mut JointSolver) {
        self.note_loads();
        for (mover, &row) in self.states_of_movers.iter().enumerate() {
            let (free, change) = (self.newton.free[mover], self.change_since_given(mover, states));
            give([0, 1, 2].map(|axis| free[axis] as f32 + change[axis]), &mut states[row as usize]);
        }
        self.joints.iter().for_each(|joint| joint.take_back(&self.newton.rows, joints));
    }

    /// Takes note of what the push has loaded each island with.
    fn note_loads(&mut self) {
        let Self { contacts, islands, newton, .. } = self;
        for island in islands {
            let contacts = contacts[island.contacts.clone()].iter();
            let speeds = contacts.map(|contact| contact.speed_over_width(&newton.rows));
            island.speed_over_width = speeds.fold(0.0, f64::max);
        }
    }

    /// Gives the contacts the impulses that were found last.
    pub(crate) fn write_back(&mut self, graph: &mut ConstraintGraph) {
        for contact in &mut self.contacts {
            contact.write_back(&self.newton.rows, graph);
        }
    }
}

/// Along x and y, and of the turn, m/s and rad/s.
fn velocity_of(state: &BodyState) -> [f32; 3] {
    [state.velocity.x, state.velocity.y, state.angular_velocity]
}

/// Gives a body a velocity.
fn give([x, y, w]: [f32; 3], state: &mut BodyState) {
    (state.velocity, state.angular_velocity) = (Vec2::new(x, y).into(), w);
}
