//! A phase of the joints: clusters solved one after the other, each by Newton's method with the rows that act.

use crate::resolution::joint::JointSolver;
use crate::resolution::joint::geometry::{Base, JointBody};
use crate::resolution::joint::plan::{Cluster, Island};
use crate::resolution::joint::row::{Phase, Role, Row, Times, is_inside};

/// Steps of Newton's method over a cluster that stands by itself, at most, each time that it is begun. Each takes the rest of the one before times the angle by which bodies turn
/// in a substep; and where bounds are met, finds which. With half as many a disc that swings by its handle on a rope loses its energy; twice as many mend no
/// more.
const MOST_SOLVES: usize = 12;

/// Where the solve in which bodies turn comes to no end, the one in which they go on as they do is left. If it is right to this angle, rad,
/// and this part of the size of the joint, which is not seen, it serves; else the step was too long. Ratchets take turns in being met
/// in steps of any length: with a tenth of this, rows of sixteen take four times as long. If all were taken, strings of discs would part by
/// a millimetre.
const NEARLY: f64 = 1e-4;

/// Where the solve in which bodies turn ends with more than so many times the energy of the one in which they go on as they do, it
/// has found another place for the links, and is given up.
const GAIN: f64 = 1.1;

/// A vector at its bound points the right way if to follow once more moves it by less than this part of its bound, no unit: of the work of friction that
/// makes half its square, which `f32` cannot show.
const POINTING: f64 = 1e-4;

/// A vector that is within its bound by less than this part of it, no unit, is at it: that is rounding.
const ROUNDING: f64 = 1e-9;

/// What is sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Aim {
    /// Where coordinates are after the move.
    Place,
    /// The same, of bodies that go on as they do now.
    Way,
    /// How fast they change.
    Speed,
}

/// Turns of rows with bounds and of those without, where it is not found out which bounds are met. With half as many a machine that falls on its limits
/// explodes; twice as many mend no more.
const TURNS: usize = 8;

/// Sweeps over clusters that share bodies.
const SWEEPS: usize = 4;

impl JointSolver {
    /// Solves a phase.
    pub(super) fn solve_island(&mut self, island: &mut Island, phase: Phase) {
        island.times.closing = 0.0;
        self.begin_to_yield(island);
        self.solve_rows(island, phase, true);
        if phase == Phase::Push {
            self.close_gaps(island);
        }
    }

    /// Solves the rows of a phase, or, where it `is_new` no more, what was pushed since they were solved.
    pub(super) fn solve_rows(&mut self, island: &mut Island, phase: Phase, is_new: bool) {
        let Island { clusters, bodies: members, times, touches, is_linear, diverges, .. } = island;
        let mut problem = self.problem(members, *times, *touches);
        if is_new {
            (*is_linear, *diverges) = (false, false);
            for cluster in clusters.iter_mut() {
                cluster.acted.fill(false);
            }
        }
        if let [cluster] = &mut clusters[..]
            && !cluster.is_swept
        {
            *is_linear = problem.solve(cluster, phase, *is_linear);
            *diverges |= problem.diverges;
            return;
        }
        for _ in 0..SWEEPS {
            for cluster in clusters.iter_mut() {
                problem.look(cluster, if phase == Phase::Push { Aim::Place } else { Aim::Speed });
                problem.step(cluster);
            }
        }
    }

    /// Spreads over an island the changes of velocity that others have made, from those that bodies have kept, by what is linear of the last
    /// step: rows that acted bear what it takes so that their coordinates change as fast as before.
    pub(super) fn spread(&mut self, island: &mut Island) {
        let Island { clusters, bodies: members, times, touches, .. } = island;
        for row in rows_of(clusters) {
            self.rows[row].kept = self.rows[row].impulse;
        }
        let mut problem = self.problem(members, *times, *touches);
        let is_swept = clusters.iter().any(|cluster| cluster.is_swept);
        for _ in 0..if is_swept { SWEEPS } else { 1 } {
            for cluster in clusters.iter_mut() {
                problem.spread_over(cluster);
            }
        }
    }

    fn problem<'a>(&'a mut self, members: &'a [u32], times: Times, touches: bool) -> Problem<'a> {
        let Self { bodies, starts, bases, rows, .. } = self;
        Problem { rows, bodies, starts, bases, members, times, touches, diverges: false }
    }
}

/// The rows of some clusters.
pub(super) fn rows_of(clusters: &[Cluster]) -> impl Iterator<Item = usize> {
    clusters.iter().flat_map(|cluster| &cluster.rows).map(|&row| row as usize)
}

/// Rows and bodies, and how long a step is.
struct Problem<'a> {
    rows: &'a mut [Row],
    bodies: &'a mut [JointBody],
    /// As the substep began, and with what others have pushed them since.
    starts: &'a [JointBody],
    bases: &'a [Base],
    /// Places of the bodies of the island.
    members: &'a [u32],
    times: Times,
    /// Whether contacts push them.
    touches: bool,
    /// Whether neither the solve in which they turn came to an end, nor the other one is near enough.
    diverges: bool,
}

impl Problem<'_> {
    /// Solves a cluster. Before the move what is sought is where bodies will be: first as if they went on as they do now, which
    /// tells what meets its bounds, then as they turn. Where that comes to no end, as bodies turn by too much of a radian, it is
    /// left at the first. Returns whether it was.
    fn solve(&mut self, cluster: &mut Cluster, phase: Phase, is_linear: bool) -> bool {
        if phase == Phase::Relax {
            self.settle(cluster, Aim::Speed);
            return is_linear;
        }
        if is_linear {
            self.settle(cluster, Aim::Way);
            return true;
        }
        if !self.settle(cluster, Aim::Way) {
            return true;
        }
        self.keep(cluster);
        if self.descend(cluster, Aim::Place) && (!self.touches || self.gains_little()) {
            return false;
        }
        self.give_back(cluster);
        self.diverges |= !self.is_nearly_there(cluster);
        // Rows act as they do in what is left.
        self.look(cluster, Aim::Way);
        true
    }

    /// Whether rigid rows, and limits that bore before, will be where they should, but for `NEARLY`, as bodies turn.
    fn is_nearly_there(&mut self, cluster: &Cluster) -> bool {
        self.look(cluster, Aim::Place);
        let mut rows = cluster.rows.iter().map(|&row| &self.rows[row as usize]);
        rows.all(|row| {
            let holds = match row.role {
                Role::Rigid => true,
                Role::Limits(_) => row.acts && row.load != 0.0,
                Role::Spring { .. } | Role::Speed { .. } => false,
            };
            !holds || row.is_within(NEARLY, self.times)
        })
    }

    /// Keeps what was found so far.
    fn keep(&mut self, cluster: &Cluster) {
        for &row in &cluster.rows {
            let row = &mut self.rows[row as usize];
            row.kept = row.impulse;
            for body in row.bodies {
                let body = &mut self.bodies[body as usize];
                body.kept = body.velocity;
            }
        }
    }

    /// Whether what was found since has no more energy than that, but for `GAIN`, or than the bodies had before their joints held them.
    fn gains_little(&self) -> bool {
        let bodies = || self.members.iter().map(|&place| &self.bodies[place as usize]);
        let starts = self.members.iter().map(|&place| &self.starts[place as usize]);
        let start: f64 = starts.map(|body| body.energy_of(body.velocity)).sum();
        let before: f64 = bodies().map(|body| body.energy_of(body.kept)).sum();
        let now: f64 = bodies().map(|body| body.energy_of(body.velocity)).sum();
        now <= (GAIN * before).max(start)
    }

    /// Goes back to what was kept.
    fn give_back(&mut self, cluster: &Cluster) {
        for &row in &cluster.rows {
            let row = &mut self.rows[row as usize];
            row.impulse = row.kept;
            for body in row.bodies {
                let body = &mut self.bodies[body as usize];
                body.velocity = body.kept;
            }
        }
    }

    /// Solves a cluster whatever its bounds do. Where Newton's method does not find out which of them are met, those rows are
    /// solved one by one, in turn with all that are rigid. Returns whether it came to an end.
    fn settle(&mut self, cluster: &mut Cluster, aim: Aim) -> bool {
        self.keep(cluster);
        if self.descend(cluster, aim) {
            return true;
        }
        self.give_back(cluster);
        for _ in 0..TURNS {
            for &row in &cluster.rows {
                self.sweep(row as usize, aim);
            }
            self.look(cluster, aim);
            for &row in &cluster.rows {
                let row = &mut self.rows[row as usize];
                row.acts &= row.role == Role::Rigid;
            }
            self.step(cluster);
        }
        false
    }

    /// Gives a row with bounds, or a vector with its first, by itself what it asks for, as far as they let it.
    fn sweep(&mut self, index: usize, aim: Aim) {
        let is_second = index > 0 && self.rows[index - 1].heads_pair;
        if self.rows[index].role == Role::Rigid || is_second {
            return;
        }
        let vector = index..=index + usize::from(self.rows[index].heads_pair);
        for row in &mut self.rows[vector.clone()] {
            let [a, b] = row.bodies.map(|body| &self.bodies[body as usize]);
            let ahead = (aim == Aim::Way).then(|| row.ahead(a, b, self.times.h));
            row.look(a, b, ahead, self.times);
        }
        follow(&mut self.rows[vector.clone()], self.times);
        for row in vector {
            self.give_wanted(row);
        }
    }

    /// Gives a row the impulse that is wanted of it, as far as its bounds let it.
    fn give_wanted(&mut self, index: usize) {
        let row = &mut self.rows[index];
        let cut = row.cut(row.wanted, self.times);
        let gain = cut - row.impulse;
        row.impulse = cut;
        for (body, j) in row.bodies.into_iter().zip(row.j) {
            self.bodies[body as usize].push(j, gain);
        }
    }

    /// Newton's method with the rows that act. Returns whether it came to an end.
    fn descend(&mut self, cluster: &mut Cluster, aim: Aim) -> bool {
        for solve in 0..=MOST_SOLVES {
            self.look(cluster, aim);
            let excess = cluster.rows.iter().map(|&row| self.rows[row as usize].excess(self.times));
            let excess = greatest(excess);
            if solve > 0 && excess <= 1.0 && (solve == MOST_SOLVES || self.vectors_point(cluster)) {
                return true;
            }
            if solve == MOST_SOLVES || !excess.is_finite() {
                break;
            }
            self.step(cluster);
        }
        false
    }

    /// Whether vectors at their bounds point against what they are off by.
    fn vectors_point(&mut self, cluster: &Cluster) -> bool {
        cluster.rows.iter().all(|&first| {
            let vector = &mut self.rows[first as usize..];
            if !vector[0].heads_pair || vector[0].acts {
                return true;
            }
            let vector = &mut vector[..2];
            follow(vector, self.times);
            let [x, y] = [0, 1].map(|row| vector[row].wanted - vector[row].impulse);
            length(x, y) <= POINTING * vector[0].most(self.times)
        })
    }

    /// Finds by how much the rows of a cluster are off.
    fn look(&mut self, cluster: &Cluster, aim: Aim) {
        // The rows of a joint follow each other.
        let mut of_joint = None;
        for &row in &cluster.rows {
            let row = &mut self.rows[row as usize];
            let [a, b] = row.bodies.map(|body| &self.bodies[body as usize]);
            let h = self.times.h;
            if of_joint.is_none_or(|(joint, _)| joint != row.joint) {
                let after = || self.bases[row.joint as usize].at(&a.after(h), &b.after(h));
                of_joint = Some((row.joint, (aim == Aim::Place).then(after)));
            }
            let ahead = match &of_joint {
                Some((_, Some(after))) => Some(row.value(after)),
                _ => (aim == Aim::Way).then(|| row.ahead(a, b, h)),
            };
            row.look(a, b, ahead, self.times);
        }
        for &row in &cluster.rows {
            if self.rows[row as usize].heads_pair {
                self.look_at_vector(row as usize, aim);
            }
        }
    }

    /// Finds whether the two rows of a vector act: it is within its bound, or is to come back from it.
    fn look_at_vector(&mut self, first: usize, aim: Aim) {
        let [x, y] = [&self.rows[first], &self.rows[first + 1]];
        // After the move springs bear what they bore before.
        let may_act = aim != Aim::Speed || matches!(x.role, Role::Speed { .. });
        let inward = x.own() * x.residual + y.own() * y.residual;
        let acts = may_act
            && x.k > 0.0
            && y.k > 0.0
            && is_inside(length(x.own(), y.own()), (1.0 - ROUNDING) * x.most(self.times), inward);
        (self.rows[first].acts, self.rows[first + 1].acts) = (acts, acts);
    }

    /// The same over a cluster. What meets its bounds acts no more, and the others do without it: as if it still bore what was wanted of
    /// it, they would throw light bodies off.
    fn spread_over(&mut self, cluster: &mut Cluster) {
        for _ in 0..TURNS {
            self.look_at_changes(cluster);
            self.step(cluster);
            let mut is_cut = false;
            for &row in &cluster.rows {
                let row = &mut self.rows[row as usize];
                if row.acts && row.impulse != row.wanted {
                    (row.acts, is_cut) = (false, true);
                }
            }
            if !is_cut {
                break;
            }
        }
    }

    /// Finds how much faster the coordinates of a cluster change than with the velocities and impulses that were kept. What does not act goes on to bear
    /// what it bears: friction at its bound points against the slip, of which this is only the change.
    fn look_at_changes(&mut self, cluster: &Cluster) {
        for &row in &cluster.rows {
            let row = &mut self.rows[row as usize];
            let [a, b] = row.bodies.map(|body| self.bodies[body as usize].change());
            let change = row.speed_of([a, b]) + row.softness * (row.impulse - row.kept);
            row.residual = if row.acts { change } else { 0.0 };
        }
    }

    /// One solve of the rows that act, cut to what they may bear. Vectors at their bounds are given theirs first. What a
    /// vector that acts asks for beyond its bound is cut off, and the other rows are solved anew with what is left: if they bore what goes with the whole, a
    /// hinge would throw off bodies between which friction of a newton is to stop what takes a kilonewton. Of single rows it is cut off in the end.
    fn step(&mut self, cluster: &mut Cluster) {
        self.give_vectors(cluster, |vector, times| {
            let is_at_bound = !vector[0].acts;
            if is_at_bound {
                follow(vector, times);
            }
            is_at_bound
        });
        while cluster.rows.iter().any(|&row| self.rows[row as usize].acts) {
            self.find_wanted(cluster);
            let are_cut = self.give_vectors(cluster, |vector, times| {
                let is_cut = vector[0].acts && shorten(vector, times);
                for row in vector {
                    row.acts &= !is_cut;
                }
                is_cut
            });
            if !are_cut {
                cluster.rows.iter().for_each(|&row| self.give_wanted(row as usize));
                return;
            }
        }
    }

    /// Finds the impulses with which the rows that act are off by nothing.
    fn find_wanted(&mut self, cluster: &mut Cluster) {
        let Self { rows, bodies, .. } = self;
        let Cluster { rows: order, factor, acted, .. } = cluster;
        let is_new = order.iter().zip(&*acted).any(|(row, was)| rows[*row as usize].acts != *was);
        if is_new {
            for (row, acted) in order.iter().zip(acted.iter_mut()) {
                *acted = rows[*row as usize].acts;
            }
            factor.factorize(|row, column| {
                let (j, k) = (&rows[order[row] as usize], &rows[order[column] as usize]);
                if j.acts && k.acts { coupling(j, k, row == column, bodies) } else { 0.0 }
            });
        }
        for (x, &row) in factor.x.iter_mut().zip(order.iter()) {
            let row = &rows[row as usize];
            *x = if row.acts { -row.residual } else { 0.0 };
        }
        factor.solve();
        for (&row, &gain) in order.iter().zip(&factor.x) {
            rows[row as usize].wanted = rows[row as usize].impulse + gain;
        }
    }

    /// Chooses vectors, which do not act then, gives them what is wanted of them, and has all rows take note of how that changes their speeds. Returns
    /// whether one was chosen.
    fn give_vectors(&mut self, cluster: &Cluster, choose: impl Fn(&mut [Row], Times) -> bool) -> bool {
        let heads = || cluster.rows.iter().map(|&first| first as usize);
        let mut any = false;
        for first in heads() {
            any |= self.rows[first].heads_pair && choose(&mut self.rows[first..first + 2], self.times);
        }
        if !any {
            return false;
        }
        self.add_speeds(cluster, -1.0);
        for first in heads() {
            if self.rows[first].heads_pair && !self.rows[first].acts {
                self.give_wanted(first);
                self.give_wanted(first + 1);
            }
        }
        self.add_speeds(cluster, 1.0);
        true
    }

    /// Adds so many times how fast their coordinates change to what the rows of a cluster are off by.
    fn add_speeds(&mut self, cluster: &Cluster, times: f64) {
        for &row in &cluster.rows {
            let row = &mut self.rows[row as usize];
            let [a, b] = row.bodies.map(|body| &self.bodies[body as usize]);
            row.residual += times * row.speed(a, b);
        }
    }
}

/// Finds what a vector by itself is to bear, within its bound.
///
/// At its bound it comes to point against what it is off by, λ = P(λ - u/k), as the two rows have one k: each with its own, friction at the end
/// of a rod would point along the rod, whichever way that end slides. It comes to an end, as no way of the two has more than twice the greater k.
fn follow(vector: &mut [Row], times: Times) {
    let k = vector.iter().map(|row| row.k + row.softness).fold(0.0, f64::max);
    for row in vector.iter_mut() {
        row.wanted = if row.k > 0.0 { row.impulse - row.residual / k } else { row.impulse };
    }
    shorten(vector, times);
}

/// Shortens what is wanted of a vector to its bound; returns whether it was more.
fn shorten(vector: &mut [Row], times: Times) -> bool {
    let [x, y] = vector else { return false };
    let (length, most) = (length(x.wanted - x.taken_back, y.wanted - y.taken_back), x.most(times));
    if length > most {
        for row in [x, y] {
            row.wanted = row.taken_back + most / length * (row.wanted - row.taken_back);
        }
    }
    length > most
}

/// The greatest of numbers of which none is negative; not a number where one of them is none, which `f64::max` would pass over.
pub(super) fn greatest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(0.0, |most: f64, one| if one > most || one.is_nan() { one } else { most })
}

fn length(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// An entry of the matrix.
fn coupling(j: &Row, k: &Row, is_diagonal: bool, bodies: &[JointBody]) -> f64 {
    let mut sum = if is_diagonal { j.softness } else { 0.0 };
    for (body, of_j) in j.bodies.into_iter().zip(j.j) {
        for (other, of_k) in k.bodies.into_iter().zip(k.j) {
            if body == other {
                sum += bodies[body as usize].coupling(of_j, of_k);
            }
        }
    }
    sum
}
