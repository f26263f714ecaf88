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
mod newton;
mod row;
mod skyline;

use crate::body::Bodies;
use crate::collision::Contacts;
use crate::compute::BodyState;
use crate::math::Vec2;
use crate::resolution::constraint_graph::ConstraintGraph;
pub(crate) use crate::resolution::direct::contact::Aim;
use crate::resolution::direct::contact::DirectContact;
use crate::resolution::direct::newton::{Newton, Part};

/// Where Newton's method does not solve an island of no more bodies than this, that is tried again in the next step: to
/// leave it to the sweeps of [`Tier::Swept`](crate::Tier), 42 of 10,000 random worlds show an overlap of 1 cm, and 1 so. More
/// bodies take more time than that is worth.
const LARGEST_SMALL_ISLAND: usize = 32;

/// The islands that are solved directly.
///
/// In a step: `clear`, and `add_island` for each, once the constraints are there; in a substep `solve` to push, the drift,
/// `restore_free`, a kick, and `solve` to relax, which alone gives the contacts their impulses.
#[derive(Clone, Debug, Default)]
pub(crate) struct DirectSolver {
    /// The row of each mover among the states.
    states_of_movers: Vec<u32>,
    /// By row of the states, which mover it is.
    mover_of_row: Vec<Option<u32>>,
    contacts: Vec<DirectContact>,
    islands: Vec<Part>,
    newton: Newton,
}

impl DirectSolver {
    pub(crate) fn clear(&mut self) {
        self.states_of_movers.clear();
        self.contacts.clear();
        self.islands.clear();
        self.newton.clear();
    }

    /// Takes up an island: the slots of its bodies, in the order of the matrix.
    pub(crate) fn add_island(
        &mut self,
        island: &[u32],
        bodies: &Bodies,
        contacts: &Contacts,
        graph: &ConstraintGraph,
    ) {
        let (first_mover, begin) = (self.states_of_movers.len(), self.newton.end());
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
            for index in contacts.of_body(bodies, slot) {
                let contact = &contacts[index];
                let Some(home) = graph.home(index) else { continue };
                // The ground's row is no mover's.
                let movers = graph.moved_rows(home).map(|row| self.mover_of_row[row as usize]);
                // A contact is in the lists of both its bodies.
                if movers.contains(&None) || slot == contact.slots[0] {
                    let points = contact.manifold.points().len();
                    let speed = bodies.roles.surface_speed(contact.colliders).unwrap_or(0.0);
                    self.contacts.push(DirectContact::new(home, points, movers, speed, &mut self.newton));
                }
            }
        }
        for &row in &self.states_of_movers[first_mover..] {
            self.mover_of_row[row as usize] = None;
        }
        self.islands.push(self.newton.part_from(begin));
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.islands.is_empty()
    }

    /// Rows of the bodies of islands that Newton's method did not solve in this step, but for small ones, which are tried
    /// again in the next.
    pub(crate) fn unsolved_rows(&self) -> impl Iterator<Item = u32> {
        let is_left = |part: &&Part| part.is_unsolved && part.movers.len() > LARGEST_SMALL_ISLAND;
        self.islands
            .iter()
            .filter(is_left)
            .flat_map(|part| self.states_of_movers[part.movers.clone()].iter().copied())
    }

    /// Takes what the contacts gave the bodies in the last solve out of the velocities again; what has struck them since stays.
    pub(crate) fn restore_free(&self, states: &mut [BodyState]) {
        let Newton { free, sought, .. } = &self.newton;
        for (&row, (free, sought)) in self.states_of_movers.iter().zip(free.iter().zip(sought)) {
            let state = &mut states[row as usize];
            let [[free_x, free_y, free_w], [x, y, w]] = [free, sought].map(|all| all.map(|v| v as f32));
            state.velocity.x = free_x + (state.velocity.x - x);
            state.velocity.y = free_y + (state.velocity.y - y);
            state.angular_velocity = free_w + (state.angular_velocity - w);
        }
    }

    /// Finds the velocities with contacts, from those of now, which are without; and the impulses.
    pub(crate) fn solve(&mut self, graph: &mut ConstraintGraph, states: &mut [BodyState], aim: Aim, h: f32) {
        if self.is_empty() {
            return;
        }
        self.newton.free.clear();
        for &row in &self.states_of_movers {
            let state = &states[row as usize];
            let velocity = [state.velocity.x, state.velocity.y, state.angular_velocity];
            self.newton.free.push(velocity.map(f64::from));
        }
        for contact in &self.contacts {
            contact.fill_rows(&mut self.newton.rows, graph, states, aim, 1.0 / h);
        }
        for island in &mut self.islands {
            self.newton.solve(island);
        }
        for (&row, &[x, y, w]) in self.states_of_movers.iter().zip(&self.newton.sought) {
            let state = &mut states[row as usize];
            (state.velocity, state.angular_velocity) = (Vec2::new(x as f32, y as f32).into(), w as f32);
        }
        if aim == Aim::Relax {
            for contact in &self.contacts {
                contact.write_back(&self.newton.rows, graph);
            }
        }
    }
}
