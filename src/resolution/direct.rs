//! The direct solve: all contacts of a stiff island at once, where sweeps would need thousands.
//!
//! A sweep passes a load on by one body, and to a light body under a heavy one only a little of it: a tower of n
//! boxes needs n² sweeps, a mass ratio of n needs n. Here the velocities v of an island minimize
//!
//! ```text
//! φ(v) = ½ (v - v₀)ᵀ M (v - v₀)  +  Σ p(vn + bias; c)  +  Σ f(vt; c_t, µ λ)
//! ```
//!
//! v₀ being the velocities without contacts. p(u; c) = min(u - c λ₀, 0)²/(2c) makes λ = max(0, λ₀ - u/c) the normal
//! impulse, λ₀ being that of the last substep or of the stage before: a point yields to a change of load and not to the
//! load, so that at rest nothing sags (method of multipliers; M. Hestenes, 1969). f is Huber's function, whose slope is
//! the friction, cut off at ±µ λ. φ is convex and piecewise quadratic, so Newton's method with a line search finds the
//! minimum in a few steps, each a Cholesky factorization of
//!
//! ```text
//! H = M + Σ Jnᵀ Jn/c + Σ Jtᵀ Jt/c_t      over points that press, and points that stick
//! ```
//!
//! with 3 rows for each body, in an order that keeps rows near those of their neighbours (E. Cuthill & J. McKee,
//! 1969). The limits of friction follow the normal impulses from step to step (P. Alart & A. Curnier, "A mixed
//! formulation for frictional contact problems prone to Newton like solution methods", 1991, gives the joint method;
//! to hold the limits within a step keeps H symmetric).
//!
//! Cost: bodies × band², so for chains, towers and small heaps only.

mod point;
mod skyline;

use core::ops::Range;

use crate::body::{Bodies, NONE};
use crate::collision::Contacts;
use crate::compute::BodyState;
use crate::math::Vec2;
use crate::resolution::constraint_graph::ConstraintGraph;
use crate::resolution::direct::point::{DirectPoint, TOLERANCE};
use crate::resolution::direct::skyline::Skyline;

/// Share of its own impulse that a contact gives back when the impulse changes, no unit. It makes redundant contacts
/// share their load, as the compliance of the sweeps does, and it damps: a house of cards, rigid to the last digit, trembles
/// until it falls.
const COMPLIANCE: f64 = 1e-2;

/// The mass of an island, in units of its lightest body's, from which the compliance falls: what is pressed that hard
/// would sink in before the impulses have grown, and swing. With much less, rounding weighs as much as loads do.
const STIFF_MASS: f64 = 100.0;

/// The compliance is never less than this: `f64` has digits for no more.
const LEAST_COMPLIANCE: f64 = 1e-7;

/// The compliance of the last stage where nothing presses yet: what yields to a change would yield to the whole load, and
/// a stack of 200 swing by half a metre per second.
const FIRST_COMPLIANCE: f64 = 1e-6;

/// Newton steps at most. From the impulses of the last substep one or two are the rule. Few of those that need more
/// come to an end, and a step of the world would be seen to take long.
const NEWTON_STEPS: usize = 20;

/// Sweeps where Newton's method has not come to an end. Fewer leave more small piles awake.
const FALL_BACK_SWEEPS: usize = 20;

/// Where Newton's method does not solve an island of no more bodies than this, that is tried again in the next step: to
/// leave it to the sweeps of [`Tier::Swept`](crate::Tier), 42 of 10,000 random worlds show an overlap of 1 cm, and 1 so. More
/// bodies take more time than that is worth.
const LARGEST_SMALL_ISLAND: usize = 32;

/// The limits of friction follow the normal impulses in so many Newton steps, then they hold still until the next
/// substep, so that the steps end.
const LIMIT_STEPS: usize = 3;

/// Tries to find how far to go along a Newton step.
const LINE_SEARCH_STEPS: usize = 30;

/// A body as the direct solve sees it.
#[derive(Clone, Copy, Debug)]
struct Mover {
    row: u32,
    /// Mass, kg, twice, and moment of inertia, kg m². 1 where it cannot be turned: nothing turns it.
    mass: [f64; 3],
}

/// Bodies and points of an island, as ranges.
#[derive(Clone, Debug)]
struct Part {
    movers: Range<usize>,
    points: Range<usize>,
    compliance: f64,
    /// Whether Newton's method failed in this step. It would fail in the substeps to come too, at the price of many
    /// sweeps, so these are swept.
    is_unsolved: bool,
}

impl Part {
    /// Where the velocities of its bodies are.
    fn places(&self) -> Range<usize> {
        3 * self.movers.start..3 * self.movers.end
    }
}

/// What the solve aims at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Aim {
    /// Before the move: overlaps are pushed apart.
    Push,
    /// After it: nothing approaches.
    Relax,
}

/// The islands that are solved directly, and the buffers for it.
#[derive(Clone, Debug, Default)]
pub(crate) struct DirectSolver {
    movers: Vec<Mover>,
    /// By row, which mover it is, or `NONE`.
    mover_of_row: Vec<u32>,
    points: Vec<DirectPoint>,
    parts: Vec<Part>,
    /// Velocities without contacts, and those sought: three for each mover.
    free: Vec<f64>,
    sought: Vec<f64>,
    /// Scratch: the gradient, then the Newton step; what it does to each point; the first column of each row.
    step: Vec<f64>,
    ways: Vec<[f64; 4]>,
    leftmost: Vec<u32>,
    matrix: Skyline,
}

impl DirectSolver {
    pub(crate) fn clear(&mut self) {
        self.movers.clear();
        self.points.clear();
        self.parts.clear();
    }

    /// Takes up an island: the slots of its bodies, in the order of the matrix.
    pub(crate) fn add_island(
        &mut self,
        island: &[u32],
        bodies: &Bodies,
        contacts: &Contacts,
        graph: &ConstraintGraph,
    ) {
        let (first_mover, first_point) = (self.movers.len(), self.points.len());
        self.mover_of_row.resize(bodies.row_count(), NONE);
        for &slot in island {
            let motion = &bodies.motions[slot as usize];
            let mass = f64::from(motion.inverse_mass).recip();
            let can_turn = motion.inverse_inertia > 0.0;
            let inertia = if can_turn { f64::from(motion.inverse_inertia).recip() } else { 1.0 };
            self.mover_of_row[motion.row as usize] = self.movers.len() as u32;
            self.movers.push(Mover { row: motion.row, mass: [mass, mass, inertia] });
        }
        for &slot in island {
            for index in contacts.of_body(bodies, slot) {
                let contact = &contacts[index];
                let Some(home) = graph.home(index) else { continue };
                // The ground's row is no mover's.
                let movers = graph.moved_rows(home).map(|row| self.mover_of_row[row as usize]);
                // A contact is in the lists of both its bodies.
                if movers.contains(&NONE) || slot == contact.slots[0] {
                    let count = contact.manifold.points().len();
                    self.points.extend((0..count).map(|index| DirectPoint::new(home, index, movers)));
                }
            }
        }
        for mover in &self.movers[first_mover..] {
            self.mover_of_row[mover.row as usize] = NONE;
        }
        let masses = || self.movers[first_mover..].iter().map(|mover| mover.mass[0]);
        let lightest = masses().fold(f64::INFINITY, f64::min);
        let ease = (STIFF_MASS * lightest / masses().sum::<f64>()).min(1.0);
        self.parts.push(Part {
            movers: first_mover..self.movers.len(),
            points: first_point..self.points.len(),
            compliance: (COMPLIANCE * ease).max(LEAST_COMPLIANCE),
            is_unsolved: false,
        });
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// Rows of the bodies of islands that Newton's method did not solve in this step, but for small ones: those are swept
    /// as well here as anywhere.
    pub(crate) fn unsolved_rows(&self) -> impl Iterator<Item = u32> {
        let is_large = |part: &&Part| part.movers.len() > LARGEST_SMALL_ISLAND;
        let unsolved = self.parts.iter().filter(|part| part.is_unsolved).filter(is_large);
        unsolved.flat_map(|part| &self.movers[part.movers.clone()]).map(|mover| mover.row)
    }

    /// Keeps the velocities of now as those without contacts.
    fn keep_free(&mut self, states: &[BodyState]) {
        self.free.clear();
        for mover in &self.movers {
            let state = &states[mover.row as usize];
            self.free.extend([state.velocity.x, state.velocity.y, state.angular_velocity].map(f64::from));
        }
    }

    /// Gives the bodies back the velocities without contacts.
    pub(crate) fn restore_free(&self, states: &mut [BodyState]) {
        write(&self.movers, &self.free, states);
    }

    /// Finds the velocities with contacts, from those of now, which are without; and the impulses.
    pub(crate) fn solve(&mut self, graph: &mut ConstraintGraph, states: &mut [BodyState], aim: Aim, h: f32) {
        if self.is_empty() {
            return;
        }
        self.keep_free(states);
        // Half the forces have acted before the move, all of them after it.
        let share = if aim == Aim::Push { 0.5 } else { 1.0 };
        for point in &mut self.points {
            let rows = graph.rows(point.home);
            let sides = rows.map(|row| &states[row as usize]);
            point.take_up(&graph.constraint(point.home), sides, aim, 1.0 / h);
            if graph.is_pending(point.home)[point.index] {
                point.leave_alone();
            }
            point.impulse = point.impulse.map(|impulse| share * impulse);
        }
        self.sought.resize(self.free.len(), 0.0);
        for part in 0..self.parts.len() {
            let island = self.parts[part].clone();
            self.parts[part].is_unsolved |= !self.solve_island(&island);
        }
        write(&self.movers, &self.sought, states);
        if aim == Aim::Relax {
            for point in &self.points {
                graph.set_impulses(point.home, point.index, point.impulse.map(|impulse| impulse as f32));
            }
        }
    }

    /// Finds velocities and impulses of one island: of a stiff one with yielding points first, which tells quickly
    /// which of them press, and about how hard. Returns whether Newton's method came to an end.
    fn solve_island(&mut self, part: &Part) -> bool {
        for point in &mut self.points[part.points.clone()] {
            point.begin();
        }
        self.follow_impulses(part);
        if self.is_complementary(part) {
            return true;
        }
        if part.is_unsolved {
            self.sweep(part);
            return false;
        }
        let is_stiff = part.compliance < COMPLIANCE;
        let begins = self.points[part.points.clone()].iter().all(DirectPoint::is_unloaded);
        let stages = [
            Some(COMPLIANCE),
            is_stiff.then_some(part.compliance),
            begins.then_some(part.compliance.min(FIRST_COMPLIANCE)),
        ];
        for (number, compliance) in stages.into_iter().flatten().enumerate() {
            for point in &mut self.points[part.points.clone()] {
                point.yield_by(compliance);
            }
            let is_solved = self.descend(part, number == 0);
            for point in &mut self.points[part.points.clone()] {
                point.settle(is_solved);
            }
            self.follow_impulses(part);
            if !is_solved {
                self.sweep(part);
                return false;
            }
        }
        true
    }

    /// Whether all points have what they want.
    fn is_complementary(&self, part: &Part) -> bool {
        self.points[part.points.clone()].iter().all(|point| point.is_complementary(&self.sought))
    }

    /// The fall-back where bodies collide in a heap that Newton's method does not come to grips with: sweeps over the
    /// points, one at a time.
    fn sweep(&mut self, part: &Part) {
        for _ in 0..FALL_BACK_SWEEPS {
            for point in &mut self.points[part.points.clone()] {
                point.sweep(&mut self.sought, |number| self.movers[number].mass);
            }
        }
    }

    /// Finds the velocities that the impulses bring about, so that momentum is kept whatever the tolerance.
    fn follow_impulses(&mut self, part: &Part) {
        self.sought[part.places()].copy_from_slice(&self.free[part.places()]);
        for point in &self.points[part.points.clone()] {
            point.apply(point.impulse, &mut self.sought, |number| self.movers[number].mass);
        }
    }

    /// Goes down φ, step by step, until its gradient is 0. Returns whether it came there.
    fn descend(&mut self, part: &Part, is_first: bool) -> bool {
        for number in 0..NEWTON_STEPS {
            for point in &mut self.points[part.points.clone()] {
                point.respond(&self.sought);
                if (1..LIMIT_STEPS).contains(&number) {
                    point.limit = point.friction * point.impulse[0];
                }
            }
            if self.is_balanced(part) {
                return true;
            }
            // Points that touch are first held, whichever way they would go: a load reaches the ground at once, and
            // not one body further in each step.
            let holds = is_first && number == 0;
            self.assemble(part, holds);
            self.matrix.factorize();
            self.matrix.solve(&mut self.step[part.places()]);
            if holds {
                for point in &mut self.points[part.points.clone()] {
                    point.limit = point.friction * point.held_impulse(&self.sought, &self.step);
                }
            }
            self.go_along_step(part);
        }
        false
    }

    /// Finds the gradient M (v - v₀) - Jᵀ λ, with the sign turned. Returns whether it is 0.
    fn is_balanced(&mut self, part: &Part) -> bool {
        self.step.resize(self.sought.len(), 0.0);
        for place in part.places() {
            self.step[place] = self.mass(place) * (self.free[place] - self.sought[place]);
        }
        for point in &self.points[part.points.clone()] {
            point.push(&mut self.step);
        }
        part.places().all(|place| {
            let tolerance = TOLERANCE * (1.0 + self.sought[place].abs());
            self.step[place].abs() <= self.mass(place) * tolerance
        })
    }

    /// Mass, kg, or moment of inertia, kg m², that belongs to a velocity.
    fn mass(&self, place: usize) -> f64 {
        self.movers[place / 3].mass[place % 3]
    }

    /// H, for the points as they respond now, or with all that touch held.
    fn assemble(&mut self, part: &Part, holds: bool) {
        let first = part.movers.start as u32;
        self.leftmost.clear();
        self.leftmost.extend(0..part.movers.len() as u32);
        for &DirectPoint { movers: [a, b], .. } in &self.points[part.points.clone()] {
            if a != NONE && b != NONE {
                let (low, high) = (a.min(b) - first, a.max(b) - first);
                self.leftmost[high as usize] = self.leftmost[high as usize].min(low);
            }
        }
        self.matrix.reset(self.leftmost.iter().flat_map(|&left| [3 * left; 3]));
        for place in part.places() {
            let number = place - part.places().start;
            self.matrix.add(number, number, self.mass(place));
        }
        for point in &self.points[part.points.clone()] {
            point.stiffen(&mut self.matrix, first, holds);
        }
    }

    /// Goes along the step to where φ is least: where its slope, which grows along the way, is 0. A whole step is
    /// right where no point changes its mind.
    fn go_along_step(&mut self, part: &Part) {
        let points = &self.points[part.points.clone()];
        self.ways.clear();
        self.ways.extend(points.iter().map(|point| point.way(&self.sought, &self.step)));
        let (mut start, mut gain) = (0.0, 0.0);
        for place in part.places() {
            let momentum = self.mass(place) * self.step[place];
            start += momentum * (self.sought[place] - self.free[place]);
            gain += momentum * self.step[place];
        }
        let slope = |share: f64| {
            let of_points = points.iter().zip(&self.ways).map(|(point, way)| point.slope(way, share));
            of_points.fold([start + share * gain, gain], |[slope, growth], of_point| {
                [slope + of_point[0], growth + of_point[1]]
            })
        };
        // The slope is made of straight pieces: from one of them on, the next root is the right one.
        let (mut low, mut high, mut share) = (0.0, 1.0, 1.0);
        let small = 1e-9 * slope(low)[0].abs();
        for _ in 0..LINE_SEARCH_STEPS {
            let [now, growth] = slope(share);
            if now.abs() <= small || (share == 1.0 && now < 0.0) {
                break;
            }
            *(if now > 0.0 { &mut high } else { &mut low }) = share;
            let root = share - now / growth;
            share = if root > low && root < high { root } else { 0.5 * (low + high) };
        }
        for place in part.places() {
            self.sought[place] += share * self.step[place];
        }
    }
}

/// Writes velocities, three for each mover, into the rows.
fn write(movers: &[Mover], velocities: &[f64], states: &mut [BodyState]) {
    for (mover, velocity) in movers.iter().zip(velocities.chunks_exact(3)) {
        let state = &mut states[mover.row as usize];
        state.velocity = Vec2::new(velocity[0] as f32, velocity[1] as f32).into();
        state.angular_velocity = velocity[2] as f32;
    }
}
