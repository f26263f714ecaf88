//! Newton's method for rows with bounds, of movers with three velocities each. It knows nothing of contacts.

use core::ops::Range;

use crate::resolution::direct::row::{Bound, Row, Slope, TOLERANCE, Way};
use crate::resolution::direct::skyline::Skyline;

/// Share of its own impulse that a row gives back when the impulse changes, no unit. It makes redundant contacts
/// share their load, as the compliance of the sweeps does, and it damps: a house of cards, rigid to the last digit, trembles
/// until it falls.
const COMPLIANCE: f64 = 1e-2;

/// The mass of an island, in units of its lightest body's, from which the compliance falls: what is pressed that hard
/// would sink in before the impulses have grown, and swing. With much less, rounding weighs as much as loads do.
const STIFF_MASS: f64 = 100.0;

/// The compliance is never less than this, which is that of the last stage where nothing presses yet: what yields to a
/// change would yield to the whole load there, and a stack of 200 swing by half a metre per second. `f64` has digits for
/// little less.
const LEAST_COMPLIANCE: f64 = 1e-6;

/// Newton steps at most, tries to find how far to go along each, and sweeps where they have not come to an end. From the impulses of the last substep one or two
/// are the rule. Few islands that need more come to an end, and a step of the world would be seen to take long; fewer
/// sweeps leave more small piles awake.
const MOST_STEPS: usize = 20;

/// The limits of friction follow the normal impulses in so many Newton steps, then they hold still until the next
/// substep, so that the steps end.
const LIMIT_STEPS: usize = 3;

/// Movers and rows of an island, as ranges.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) movers: Range<usize>,
    rows: Range<usize>,
    compliance: f64,
    /// Whether Newton's method failed in this step. It would fail in the substeps to come too, at the price of many
    /// sweeps, so these are swept.
    pub(super) is_unsolved: bool,
}

impl Part {
    /// Where the velocities of its movers are.
    fn places(&self) -> Range<usize> {
        3 * self.movers.start..3 * self.movers.end
    }
}

/// Movers, rows between them, and the buffers of the solve.
#[derive(Clone, Debug, Default)]
pub(super) struct Newton {
    /// By velocity, three for each mover: its mass, kg, twice, and moment of inertia, kg m².
    pub(super) masses: Vec<f64>,
    /// Velocities without impulses, and those sought.
    pub(super) free: Vec<f64>,
    pub(super) sought: Vec<f64>,
    pub(super) rows: Vec<Row>,
    /// Scratch: the gradient, then the Newton step; what it does to each row; the impulses of the last stage; the first
    /// mover of each row of blocks.
    step: Vec<f64>,
    ways: Vec<Way>,
    found: Vec<f64>,
    leftmost: Vec<u32>,
    matrix: Skyline,
}

impl Newton {
    pub(super) fn clear(&mut self) {
        self.masses.clear();
        self.rows.clear();
    }

    /// All movers and rows from these on, as a part.
    pub(super) fn part_from(&self, mover: usize, row: usize) -> Part {
        let movers = mover..self.masses.len() / 3;
        let masses = || movers.clone().map(|mover| self.masses[3 * mover]);
        let lightest = masses().fold(f64::INFINITY, f64::min);
        let ease = (STIFF_MASS * lightest / masses().sum::<f64>()).min(1.0);
        let compliance = (COMPLIANCE * ease).max(LEAST_COMPLIANCE);
        Part { movers, rows: row..self.rows.len(), compliance, is_unsolved: false }
    }

    /// Finds velocities and impulses of a part: of a stiff one with yielding rows first, which tells quickly which of
    /// them press, and about how hard. Says in the part whether Newton's method came to an end.
    pub(super) fn solve(&mut self, part: &mut Part) {
        self.sought.resize(self.free.len(), 0.0);
        self.follow_impulses(part);
        self.follow_limits(part);
        if self.is_complementary(part) {
            return;
        }
        part.is_unsolved = part.is_unsolved || !self.descend_in_stages(part);
        if part.is_unsolved {
            self.sweep(part);
        }
    }

    /// Whether all rows have what they ask for.
    fn is_complementary(&self, part: &Part) -> bool {
        self.rows[part.rows.clone()].iter().all(|row| row.is_complementary(&self.sought))
    }

    /// Finds the velocities that the impulses bring about, so that momentum is kept whatever the tolerance.
    fn follow_impulses(&mut self, part: &Part) {
        self.sought[part.places()].fill(0.0);
        for row in &self.rows[part.rows.clone()] {
            row.apply(row.impulse, &mut self.sought, |_| 1.0);
        }
        for place in part.places() {
            self.sought[place] = self.free[place] + self.sought[place] / self.masses[place];
        }
    }

    /// Lets the bounds of friction follow the impulses of now.
    fn follow_limits(&mut self, part: &Part) {
        for index in part.rows.clone() {
            self.follow_limit(index);
        }
    }

    fn follow_limit(&mut self, index: usize) {
        let other = self.friction_of(index).map_or(0.0, |other| self.rows[other].impulse);
        self.rows[index].set_range(other);
    }

    /// The row whose impulse bounds that of the one with this index.
    fn friction_of(&self, index: usize) -> Option<usize> {
        match self.rows[index].bound {
            Bound::FrictionOf { row, .. } => Some(row),
            Bound::Range(_) => None,
        }
    }

    /// The fall-back where bodies collide in a heap that Newton's method does not come to grips with: sweeps over the
    /// rows, one at a time, but for friction, which goes by the speed from before the row that it follows.
    fn sweep(&mut self, part: &Part) {
        for _ in 0..MOST_STEPS {
            let mut speed_before = None;
            for index in part.rows.clone() {
                let speed = speed_before.take().unwrap_or_else(|| self.rows[index].speed(&self.sought));
                if index + 1 < part.rows.end && self.friction_of(index + 1) == Some(index) {
                    speed_before = Some(self.rows[index + 1].speed(&self.sought));
                }
                self.follow_limit(index);
                self.rows[index].sweep(speed, &mut self.sought, &self.masses);
            }
        }
    }

    /// Goes down φ with the compliance of each stage. Returns whether it came to an end; if not, impulses and velocities
    /// are those of the last stage that did.
    fn descend_in_stages(&mut self, part: &Part) -> bool {
        let is_stiff = part.compliance < COMPLIANCE;
        let begins = self.rows[part.rows.clone()].iter().all(|row| row.impulse == 0.0);
        let stages =
            [Some(COMPLIANCE), is_stiff.then_some(part.compliance), begins.then_some(LEAST_COMPLIANCE)];
        let mut is_solved = true;
        for (number, compliance) in stages.into_iter().flatten().enumerate() {
            self.found.clear();
            for row in &mut self.rows[part.rows.clone()] {
                self.found.push(row.impulse);
                row.yield_by(compliance);
            }
            is_solved = self.descend(part, number == 0);
            if !is_solved {
                for (row, &found) in self.rows[part.rows.clone()].iter_mut().zip(&self.found) {
                    row.impulse = found;
                }
            }
            self.follow_impulses(part);
            if !is_solved {
                break;
            }
        }
        is_solved
    }

    /// Goes down φ, step by step, until its gradient is 0. Returns whether it came there.
    fn descend(&mut self, part: &Part, is_first: bool) -> bool {
        for number in 0..MOST_STEPS {
            for row in &mut self.rows[part.rows.clone()] {
                row.respond(&self.sought);
            }
            if (1..LIMIT_STEPS).contains(&number) {
                self.follow_limits(part);
            }
            if self.is_balanced(part) {
                return true;
            }
            // Rows that touch are first held, whichever way they would go: a load reaches the ground at once, and
            // not one body further in each step.
            let holds = is_first && number == 0;
            self.assemble(part, holds);
            self.matrix.factorize();
            self.matrix.solve(&mut self.step[part.places()]);
            self.ways.clear();
            let rows = &self.rows[part.rows.clone()];
            self.ways.extend(rows.iter().map(|row| row.way(&self.sought, &self.step)));
            if holds {
                for index in part.rows.clone() {
                    if let Some(other) = self.friction_of(index) {
                        let way = self.ways[other - part.rows.start];
                        let impulse = self.rows[other].impulse_after(way);
                        self.rows[index].set_range(impulse);
                    }
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
            self.step[place] = self.masses[place] * (self.free[place] - self.sought[place]);
        }
        for row in &self.rows[part.rows.clone()] {
            row.apply(row.impulse, &mut self.step, |_| 1.0);
        }
        part.places().all(|place| {
            let tolerance = TOLERANCE * (1.0 + self.sought[place].abs());
            self.step[place].abs() <= self.masses[place] * tolerance
        })
    }

    /// H, for the rows as they respond now, or with all that touch held.
    fn assemble(&mut self, part: &Part, holds: bool) {
        let first = part.movers.start as u32;
        self.leftmost.clear();
        self.leftmost.extend(0..part.movers.len() as u32);
        for row in &self.rows[part.rows.clone()] {
            if let [Some(a), Some(b)] = row.movers {
                let leftmost = &mut self.leftmost[(a.max(b) - first) as usize];
                *leftmost = (*leftmost).min(a.min(b) - first);
            }
        }
        self.matrix.reset(self.leftmost.iter().flat_map(|&left| [3 * left; 3]));
        for (number, place) in part.places().enumerate() {
            self.matrix.add(number, number, self.masses[place]);
        }
        for index in part.rows.clone() {
            let row = &self.rows[index];
            let is_held = || self.rows[self.friction_of(index).unwrap_or(index)].is_held();
            if row.yields() || holds && is_held() {
                row.stiffen(&mut self.matrix, first);
            }
        }
    }

    /// Goes along the step to where φ is least: where its slope, which grows along the way, is 0. A whole step is
    /// right where no row changes its mind.
    fn go_along_step(&mut self, part: &Part) {
        let rows = &self.rows[part.rows.clone()];
        let mut start = Slope { value: 0.0, growth: 0.0 };
        for place in part.places() {
            let momentum = self.masses[place] * self.step[place];
            start.value += momentum * (self.sought[place] - self.free[place]);
            start.growth += momentum * self.step[place];
        }
        let slope = |share: f64| {
            let begin = Slope { value: start.value + share * start.growth, ..start };
            rows.iter().zip(&self.ways).fold(begin, |sum, (row, &way)| {
                let Slope { value, growth } = row.slope(way, share);
                Slope { value: sum.value + value, growth: sum.growth + growth }
            })
        };
        // The slope is made of straight pieces: from one of them on, the next root is the right one.
        let (mut low, mut high, mut share) = (0.0, 1.0, 1.0);
        let small = 1e-9 * slope(low).value.abs();
        for _ in 0..MOST_STEPS {
            let Slope { value, growth } = slope(share);
            if value.abs() <= small || (share == 1.0 && value < 0.0) {
                break;
            }
            *(if value > 0.0 { &mut high } else { &mut low }) = share;
            let root = share - value / growth;
            share = if root > low && root < high { root } else { 0.5 * (low + high) };
        }
        for place in part.places() {
            self.sought[place] += share * self.step[place];
        }
    }
}

#[cfg(test)]
mod tests;
