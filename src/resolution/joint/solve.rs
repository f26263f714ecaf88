//! A phase of the joints: clusters solved one after the other, each by Newton's method with the rows that are free.

use crate::resolution::joint::JointSolver;
use crate::resolution::joint::geometry::JointBody;
use crate::resolution::joint::plan::Cluster;
use crate::resolution::joint::row::{Phase, Row, Times};

/// Solves of a cluster that stands by itself, at most. Each takes the rest of the one before times the angle by which bodies turn
/// in a substep; and where bounds are met, finds which.
const MOST_SOLVES: usize = 12;

/// Sweeps over clusters that share bodies.
const SWEEPS: usize = 4;

impl JointSolver {
    pub(super) fn solve_clusters(&mut self, phase: Phase, times: Times) {
        let Self { bodies, bases, rows, clusters, .. } = self;
        let look = |rows: &mut [Row], bodies: &[JointBody], cluster: &Cluster| {
            // The rows of a joint follow each other.
            let mut of_joint = None;
            for &row in &cluster.rows {
                let row = &mut rows[row as usize];
                let [a, b] = row.bodies.map(|body| &bodies[body as usize]);
                if of_joint.is_none_or(|(joint, _)| joint != row.joint) {
                    let after = || bases[row.joint as usize].at(&a.after(times.h), &b.after(times.h));
                    of_joint = Some((row.joint, (phase == Phase::Push).then(after)));
                }
                row.look(a, b, of_joint.as_ref().and_then(|(_, after)| after.as_ref()), times);
            }
        };
        for cluster in clusters.iter_mut() {
            cluster.free.fill(false);
        }
        for sweep in 0..SWEEPS {
            for cluster in clusters.iter_mut() {
                if sweep > 0 && !cluster.is_swept {
                    continue;
                }
                let solves = if cluster.is_swept { 1 } else { MOST_SOLVES };
                for solve in 0..solves {
                    look(rows, bodies, cluster);
                    let excess = cluster.rows.iter().map(|&row| rows[row as usize].excess(times));
                    if solve > 0 && excess.fold(0.0, f64::max) <= 1.0 {
                        break;
                    }
                    step(cluster, rows, bodies, times);
                }
            }
        }
    }
}

/// One solve of the rows that are free, cut to what they may bear.
fn step(cluster: &mut Cluster, rows: &mut [Row], bodies: &mut [JointBody], times: Times) {
    let Cluster { rows: order, factor, free, is_swept } = cluster;
    let is_free = |row: &u32| rows[*row as usize].is_free;
    if !order.iter().any(is_free) {
        return;
    }
    let is_new = order.iter().zip(&*free).any(|(row, was)| is_free(row) != *was);
    if is_new || *is_swept {
        for (row, free) in order.iter().zip(free.iter_mut()) {
            *free = rows[*row as usize].is_free;
        }
        factor.factorize(|row, column| {
            let (j, k) = (&rows[order[row] as usize], &rows[order[column] as usize]);
            if j.is_free && k.is_free { coupling(j, k, row == column, bodies) } else { 0.0 }
        });
    }
    for (x, &row) in factor.x.iter_mut().zip(order.iter()) {
        let row = &rows[row as usize];
        *x = if row.is_free { -row.residual } else { 0.0 };
    }
    factor.solve();
    for (&row, &gain) in order.iter().zip(&factor.x) {
        rows[row as usize].wanted = rows[row as usize].impulse + gain;
    }
    for &row in order.iter() {
        let wanted = wanted(rows, row as usize, times);
        let row = &mut rows[row as usize];
        let cut = row.cut(wanted, times);
        let gain = cut - row.impulse;
        row.impulse = cut;
        for (body, j) in row.bodies.into_iter().zip(row.j) {
            bodies[body as usize].push(j, gain);
        }
    }
}

/// The impulse that a row is to have: of a vector, of no more than its bound in length.
fn wanted(rows: &mut [Row], row: usize, times: Times) -> f64 {
    if rows[row].heads_pair {
        let [x, y] = [row, row + 1].map(|row| {
            let row = &rows[row];
            // What is at its bound follows by itself.
            if row.is_free || row.k <= 0.0 {
                row.wanted
            } else {
                row.impulse - row.residual / (row.k + row.softness)
            }
        });
        let (length, bound) = ((x * x + y * y).sqrt(), rows[row].bound(times));
        let share = if length > bound { bound / length } else { 1.0 };
        (rows[row].wanted, rows[row + 1].wanted) = (x * share, y * share);
    }
    rows[row].wanted
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
