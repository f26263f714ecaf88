//! Gaps that are there: of bodies that were joined apart, were moved by hand or struck, or of joints that contradict each other.
//!
//! A push is first solved with the gaps left as they are, and then with gaps that close. Where that takes small ways of the bodies, it is
//! by impulses as all else. Along a chain that is stretched out gaps close by great ways across it: in a substep, at hundreds of metres
//! per second. There the bodies go a part of the way, by a velocity that ends with the move and that no joint bears.

use crate::resolution::joint::JointSolver;
use crate::resolution::joint::plan::Island;
use crate::resolution::joint::row::{CLOSING_SPEED, Phase};
use crate::resolution::joint::solve::{greatest, rows_of};

/// By impulses gaps are closed where no body goes more than so many times as fast as the fastest gap needs by itself, no unit. With ten times, a
/// straight bridge with a light crate gains energy, by rounding; with once, what closes the rounding of a pendulum is not an impulse of
/// its hinge, and it loses energy.
const LEVERAGE: f64 = 3.0;

impl JointSolver {
    /// Adds to the velocities of an island, which leave the gaps as they are, what closes them.
    pub(super) fn close_gaps(&mut self, island: &mut Island) {
        for &place in &island.bodies {
            self.bodies[place as usize].closing = [0.0; 3];
        }
        let most = (LEVERAGE * self.fastest_gap(island)).min(CLOSING_SPEED);
        if most == 0.0 {
            return;
        }
        for row in rows_of(&island.clusters) {
            self.rows[row].unclosed = self.rows[row].impulse;
        }
        for &place in &island.bodies {
            let body = &mut self.bodies[place as usize];
            body.unclosed = body.velocity;
        }
        let before = (island.is_linear, island.diverges);
        island.times.closing = 1.0;
        self.begin_to_close(island);
        self.solve_rows(island, Phase::Push, false);
        let faster = island.bodies.iter().map(|&place| {
            let body = &self.bodies[place as usize];
            body.pace_of([0, 1, 2].map(|index| body.velocity[index] - body.unclosed[index]))
        });
        let fastest = greatest(faster);
        island.times.closing = if fastest.is_finite() { (most / fastest).min(1.0) } else { 0.0 };
        self.end_closing(island, island.times.closing);
        if fastest <= most {
            return;
        }
        (island.is_linear, island.diverges) = before;
        for &place in &island.bodies {
            let body = &mut self.bodies[place as usize];
            if island.times.closing > 0.0 {
                body.closing = [0, 1, 2]
                    .map(|index| island.times.closing * (body.velocity[index] - body.unclosed[index]));
            }
            body.velocity = [0, 1, 2].map(|index| body.unclosed[index] + body.closing[index]);
        }
        for row in rows_of(&island.clusters) {
            self.rows[row].impulse = self.rows[row].unclosed;
        }
    }

    /// How fast the fastest gap of an island could close, as a speed of its bodies, m/s.
    fn fastest_gap(&self, island: &Island) -> f64 {
        let pace = |row: usize| {
            let row = &self.rows[row];
            let speed = row.closing_speed(island.times) * row.coordinate.leverage();
            let turning = |&body: &u32| self.bodies[body as usize].pace_of([0.0, 0.0, speed]);
            if row.coordinate.is_angle() { row.bodies.iter().map(turning).fold(0.0, f64::max) } else { speed }
        };
        rows_of(&island.clusters).map(pace).fold(0.0, f64::max)
    }
}
