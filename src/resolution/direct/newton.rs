//! Newton's method for rows with bounds, of movers with three velocities each.

use core::ops::Range;

use crate::resolution::direct::row::{
    COMPLIANCE, COMPLIANCE_OF_JOINED, Kind, LEAST_COMPLIANCE, Pair, Row, Slope, TOLERANCE, Triple,
};
use crate::resolution::direct::skyline::{Block, Skyline, work_of_factorization};

/// The mass of an island, in units of its lightest body's, from which the compliance falls: what is pressed that hard
/// would sink in before the impulses have grown, and swing. With much less, rounding weighs as much as loads do.
const STIFF_MASS: f64 = 100.0;

/// Newton steps at most. From the impulses of the last substep one or two are the rule. With a third less, heaps of gravel are left to the
/// sweeps, and overlap by a hundredth of a stone. Few islands that need more come to an end, and a step of the world would be seen to take long.
const MOST_STEPS: usize = 30;

/// Tries at most to find how far to go along a step. Each is a root of the slope, or halves what is left of the way: halves alone come to 1e-6.
const MOST_TRIES: usize = 20;

/// Sweeps over an island that Newton's method did not solve. Fewer leave more small piles awake.
const SWEEPS: usize = 20;

/// Multiplications and divisions of a row in a sweep: six for its speed, three for what it wants, six to push and six to move two bodies.
const WORK_OF_ROW: u64 = 21;

/// For so many Newton steps the limits of friction follow the normal impulses, each time that all is balanced with those from before. Then they
/// are held, so that the steps end. With half as many, gears jam: teeth stick to flanks that press no longer. With half as many again, a car
/// on stones takes half as long again, and gears run no better.
const LIMIT_STEPS: usize = 10;

/// Levers and wedges press so many times harder than all that rests on them, no unit. With a third of it the weight at the end of a lever of
/// 40 : 1 slides off; with three times as much, a box that a press holds by its corner is shot away at 9 m/s.
const LEVERAGE: f64 = 30.0;

/// Friction bears so many times as much as all that rests on the bodies, no unit. With a tenth of it a tonne on slender legs sways on; with twice as
/// much, crates that jam on a belt before a wall go faster than the belt.
const FRICTION_LEVERAGE: f64 = 5.0;

/// A contact that gives way faster than this to a change of its load, m/s, is struck, and the island solved once more without. What gives way to a blow
/// closes on, and to its end opens as fast: a kilogram that falls onto 10 g at a quarter of its speed. With three times as much what falls onto a
/// fifth of its mass comes back at 6 cm/s, with a third a stack of fifty boxes swings by 1 cm for ever.
const MOST_YIELDING: f64 = 0.03;

/// A share of a step that is rounding, no unit.
const ROUNDING: f64 = 1e-9;

/// Movers, pairs and rows of an island, as ranges.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) movers: Range<usize>,
    pairs: Range<usize>,
    rows: Range<usize>,
    compliance: f64,
    /// The same before it falls with the mass of the island.
    full_compliance: f64,
    /// What friction bears at most where its coefficient is 1 or less, N s, by [`FRICTION_LEVERAGE`].
    most_friction: f64,
    /// Whether Newton's method failed in this step. It would fail in the substeps to come too, at the price of [`MOST_STEPS`] factorizations in each
    /// stage, so the rows are swept over until the step ends.
    pub(super) is_unsolved: bool,
    /// Multiplications of a factorization, and of all factorizations and sweeps in this step.
    work_of_factorization: u64,
    work: u64,
}

impl Part {
    /// Multiplications that the solve has taken in this step, for each mover.
    pub(super) fn work_per_mover(&self) -> f32 {
        self.work as f32 / self.movers.len() as f32
    }
}

/// Movers, rows between them, and the buffers of the solve.
#[derive(Clone, Debug, Default)]
pub(super) struct Newton {
    /// Of each mover its mass, kg, twice, and moment of inertia, kg m².
    pub(super) masses: Vec<Triple>,
    /// Velocities without impulses, and those sought.
    pub(super) free: Vec<Triple>,
    pub(super) sought: Vec<Triple>,
    /// What the impulses add to the velocities.
    changes: Vec<Triple>,
    /// The rows of a pair follow each other, and a row of friction comes after the one that bounds it.
    pub(super) rows: Vec<Row>,
    pairs: Vec<Pair>,
    /// Of each mover the first of its part that it shares a row with, counted within the part.
    leftmost: Vec<u32>,
    /// Scratch: what is not balanced of the momentum, then the Newton step.
    step: Vec<Triple>,
    matrix: Skyline,
    /// The movers whose factor that is.
    factorized: Range<usize>,
}

impl Newton {
    pub(super) fn clear(&mut self) {
        self.masses.clear();
        self.rows.clear();
        self.pairs.clear();
        self.leftmost.clear();
        self.factorized = 0..0;
    }

    /// Adds two movers and the rows between them, which are to be filled; with one mover where impulses do not move the other body.
    pub(super) fn add_pair(&mut self, movers: [Option<u32>; 2], kinds: impl Iterator<Item = Kind>) {
        let first = self.rows.len();
        self.rows.extend(kinds.map(Row::new));
        if let Some(any) = movers[0].or(movers[1]) {
            let movers = movers.map(|mover| mover.unwrap_or(any) as usize);
            self.pairs.push(Pair { movers, rows: first..self.rows.len() });
        }
    }

    /// Where the next part begins.
    pub(super) fn end(&self) -> [usize; 3] {
        [self.masses.len(), self.pairs.len(), self.rows.len()]
    }

    /// All movers, pairs and rows from where the last part came to its [`end`](Self::end), as a part.
    pub(super) fn part_from(&mut self, [mover, pair, row]: [usize; 3]) -> Part {
        let end = self.end();
        let (movers, pairs, rows) = (mover..end[0], pair..end[1], row..end[2]);
        for all in [&mut self.free, &mut self.sought, &mut self.changes, &mut self.step] {
            all.resize(movers.end, [0.0; 3]);
        }
        self.leftmost.extend(0..movers.len() as u32);
        for &Pair { movers: [a, b], .. } in &self.pairs[pairs.clone()] {
            let leftmost = &mut self.leftmost[a.max(b)];
            *leftmost = (*leftmost).min((a.min(b) - mover) as u32);
        }
        let ease = (STIFF_MASS / self.mass_ratio(movers.clone())).min(1.0);
        let is_joined = self.rows[rows.clone()].iter().any(Row::is_of_joint);
        let full_compliance = if is_joined { COMPLIANCE_OF_JOINED } else { COMPLIANCE };
        let compliance = (full_compliance * ease).max(LEAST_COMPLIANCE);
        let work_of_factorization = work_of_factorization(&self.leftmost[movers.clone()]);
        Part {
            movers,
            pairs,
            rows,
            compliance,
            full_compliance,
            most_friction: 0.0,
            is_unsolved: false,
            work_of_factorization,
            work: 0,
        }
    }

    /// The mass of these movers together, in units of the lightest.
    pub(super) fn mass_ratio(&self, movers: Range<usize>) -> f64 {
        let masses = self.masses[movers].iter().map(|&[mass, ..]| mass);
        masses.clone().sum::<f64>() / masses.fold(f64::INFINITY, f64::min)
    }

    /// Finds what the impulses of a part have added to the velocities, if they have acted, and takes it out of the free ones.
    pub(super) fn take_out_changes(&mut self, part: &Part) {
        self.find_changes(part);
        for mover in part.movers.clone() {
            for axis in 0..3 {
                self.free[mover][axis] -= self.changes[mover][axis];
            }
        }
    }

    /// Finds velocities and impulses of a part, and says in it whether Newton's method came to an end.
    pub(super) fn solve(&mut self, part: &mut Part) {
        let load = self.load(part);
        part.most_friction = FRICTION_LEVERAGE * load;
        self.begin_with(part, LEVERAGE * load);
        if self.is_complementary(part) {
            return;
        }
        part.is_unsolved = part.is_unsolved || !self.descend_in_stages(part);
        if part.is_unsolved {
            self.begin_with(part, LEVERAGE * load);
            self.lessen_impulses(part);
            self.sweep(part);
        }
    }

    /// All that rests on the bodies of an island, N s: its mass times how fast its rows close without impulses, and what its motors have left.
    fn load(&self, part: &Part) -> f64 {
        let mass: f64 = self.masses[part.movers.clone()].iter().map(|&[mass, ..]| mass).sum();
        let (mut closing, mut driving) = (0.0_f64, 0.0);
        for pair in &self.pairs[part.pairs.clone()] {
            let velocities = pair.of(&self.free);
            for row in &self.rows[pair.rows.clone()] {
                closing = closing.max(row.closing(&velocities));
                driving += row.driving();
            }
        }
        mass * closing + mass.sqrt() * driving
    }

    /// Begins with the impulses of now, where no row presses with more than this, N s. What is more holds nothing up: walls that close on a body
    /// wind it up, and it would be shot away when it finds a way out.
    fn begin_with(&mut self, part: &Part, most: f64) {
        let rows = self.rows[part.rows.clone()].iter_mut();
        rows.filter(|row| row.is_normal()).for_each(|row| row.impulse = row.impulse.min(most));
        self.follow_limits(part);
        self.rows[part.rows.clone()].iter_mut().for_each(Row::keep_within_range);
        self.follow_impulses(part);
    }

    /// Whether all rows have what they ask for.
    fn is_complementary(&self, part: &Part) -> bool {
        self.pairs[part.pairs.clone()].iter().all(|pair| {
            let velocities = pair.of(&self.sought);
            self.rows[pair.rows.clone()].iter().all(|row| row.is_complementary(&velocities))
        })
    }

    /// Finds the velocities that the impulses bring about, so that momentum is kept whatever the tolerance.
    fn follow_impulses(&mut self, part: &Part) {
        self.find_changes(part);
        for mover in part.movers.clone() {
            for axis in 0..3 {
                self.sought[mover][axis] = self.free[mover][axis] + self.changes[mover][axis];
            }
        }
    }

    /// Finds what the impulses add to the velocities.
    fn find_changes(&mut self, part: &Part) {
        self.changes[part.movers.clone()].fill([0.0; 3]);
        for pair in &self.pairs[part.pairs.clone()] {
            let mut momenta = [[0.0; 3]; 2];
            for row in &self.rows[pair.rows.clone()] {
                row.apply(row.impulse, &mut momenta);
            }
            pair.add(&mut self.changes, &momenta);
        }
        for mover in part.movers.clone() {
            for axis in 0..3 {
                self.changes[mover][axis] /= self.masses[mover][axis];
            }
        }
    }

    /// Makes the impulses to begin with less, if they would add energy,
    ///
    /// ```text
    /// E(λ) = ½ λᵀ J M⁻¹ Jᵀ λ + λᵀ u₀ > 0,
    /// ```
    ///
    /// u₀ being how fast the sides of the rows go past each other without impulses. Loads that last take energy, as all contacts do. Impulses that
    /// have stopped a collision would throw the bodies apart, now that it is over. The multiple of them with the least E is taken.
    fn lessen_impulses(&mut self, part: &Part) {
        let (mut to_change, mut along) = (0.0, 0.0);
        for mover in part.movers.clone() {
            for axis in 0..3 {
                let (free, mass) = (self.free[mover][axis], self.masses[mover][axis]);
                let change = self.sought[mover][axis] - free;
                to_change += mass * change * change;
                along += mass * change * free;
            }
        }
        along += self.rows[part.rows.clone()].iter().map(|row| row.impulse * row.carried).sum::<f64>();
        if 0.5 * to_change + along > 0.0 {
            let best = (-along / to_change).max(0.0);
            self.rows[part.rows.clone()].iter_mut().for_each(|row| row.impulse *= best);
            self.follow_impulses(part);
        }
    }

    /// Lets the bounds of friction follow the impulses of now.
    fn follow_limits(&mut self, part: &Part) {
        for index in part.rows.clone() {
            self.follow_limit(index, part.most_friction);
        }
    }

    fn follow_limit(&mut self, index: usize, most_friction: f64) {
        let along_normal = self.rows[index].normal().map_or(0.0, |normal| self.rows[normal].impulse);
        self.rows[index].set_range(along_normal, most_friction);
    }

    /// The fall-back where bodies collide in a heap that Newton's method does not come to grips with: sweeps over the
    /// rows, one at a time, but for friction, which goes by the speed from before the row that it follows.
    fn sweep(&mut self, part: &mut Part) {
        part.work += (SWEEPS * part.rows.len()) as u64 * WORK_OF_ROW;
        for _ in 0..SWEEPS {
            let mut speed_before = None;
            for number in part.pairs.clone() {
                let pair = self.pairs[number].clone();
                for index in pair.rows.clone() {
                    let velocities = pair.of(&self.sought);
                    let speed = speed_before.take().unwrap_or_else(|| self.rows[index].speed(&velocities));
                    if index + 1 < pair.rows.end && self.rows[index + 1].normal() == Some(index) {
                        speed_before = Some(self.rows[index + 1].speed(&velocities));
                    }
                    self.follow_limit(index, part.most_friction);
                    let row = &mut self.rows[index];
                    let (change, mut momenta) = (row.sweep(speed), [[0.0; 3]; 2]);
                    row.apply(change, &mut momenta);
                    for (momenta, mover) in momenta.iter_mut().zip(pair.movers) {
                        for (momentum, mass) in momenta.iter_mut().zip(self.masses[mover]) {
                            *momentum /= mass;
                        }
                    }
                    pair.add(&mut self.sought, &momenta);
                }
            }
        }
    }

    /// Goes down φ with the compliance of each stage: where a load begins, with rows that yield much first, which tells quickly which of them press,
    /// and about how hard. Where it begins, or a blow comes, the last stage has [`LEAST_COMPLIANCE`], unless anything is pushed apart: that may be in a
    /// wedge, and a push that must not yield goes along the wedge at any speed. Returns whether it came to an end; if not, impulses and velocities are
    /// those of the last stage that did.
    fn descend_in_stages(&mut self, part: &mut Part) -> bool {
        let begins = self.rows[part.rows.clone()].iter().all(|row| row.impulse == 0.0);
        let eases = begins && part.compliance < part.full_compliance;
        if eases && !self.descend_with(part.full_compliance, part)
            || !self.descend_with(part.compliance, part)
        {
            return false;
        }
        let rows = &self.rows[part.rows.clone()];
        let is_struck = || rows.iter().any(|row| row.is_normal() && row.gives_way_by() > MOST_YIELDING);
        let ends_rigid = (begins || is_struck()) && !rows.iter().any(Row::pushes_apart);
        !ends_rigid || self.descend_with(LEAST_COMPLIANCE, part)
    }

    /// Goes down φ with this compliance. Returns whether it came to an end; if not, impulses are those of before.
    fn descend_with(&mut self, compliance: f64, part: &mut Part) -> bool {
        for row in &mut self.rows[part.rows.clone()] {
            row.yield_by(compliance);
        }
        let is_solved = self.descend(part);
        if !is_solved {
            self.rows[part.rows.clone()].iter_mut().for_each(Row::go_back);
        }
        self.follow_impulses(part);
        is_solved
    }

    /// Goes down φ, step by step, until its gradient is 0, lets the limits of friction follow, and goes on until they stay. Returns whether it
    /// came to an end.
    fn descend(&mut self, part: &mut Part) -> bool {
        for number in 0.. {
            self.respond(part);
            if self.is_balanced(part) {
                if number < LIMIT_STEPS {
                    self.follow_limits(part);
                }
                if self.rows[part.rows.clone()].iter().all(Row::stays) {
                    return true;
                }
                self.respond(part);
            }
            if number == MOST_STEPS {
                break;
            }
            // Rows that touch are first held, whichever way they would go: a load reaches the ground at once, and
            // not one body further in each step.
            let holds = number == 0;
            self.factorize(part, holds);
            self.matrix.solve(&mut self.step[part.movers.clone()]);
            self.look_ahead(part, holds);
            self.go_along_step(part);
        }
        false
    }

    /// Finds the impulses that the velocities are answered with, and the gradient M (v - v₀) - Jᵀ λ, with the sign turned.
    fn respond(&mut self, part: &Part) {
        for mover in part.movers.clone() {
            for axis in 0..3 {
                let missing = self.free[mover][axis] - self.sought[mover][axis];
                self.step[mover][axis] = self.masses[mover][axis] * missing;
            }
        }
        for pair in &self.pairs[part.pairs.clone()] {
            let (velocities, mut momenta) = (pair.of(&self.sought), [[0.0; 3]; 2]);
            for row in &mut self.rows[pair.rows.clone()] {
                row.respond(&velocities);
                row.apply(row.impulse, &mut momenta);
            }
            pair.add(&mut self.step, &momenta);
        }
    }

    /// Whether the gradient is 0.
    fn is_balanced(&self, part: &Part) -> bool {
        part.movers.clone().all(|mover| {
            let (step, sought, masses) = (&self.step[mover], &self.sought[mover], &self.masses[mover]);
            (0..3).all(|axis| step[axis].abs() <= masses[axis] * TOLERANCE * (1.0 + sought[axis].abs()))
        })
    }

    /// Finds the factor of H, for the rows as they respond now, or with all that touch held. The last factor serves again where it is that
    /// of the same rows: in a world with one such island, mostly.
    fn factorize(&mut self, part: &mut Part, holds: bool) {
        let mut is_new = false;
        for index in part.rows.clone() {
            let is_in = self.rows[index].yields() || holds && self.is_held(index);
            is_new |= self.rows[index].take_part(is_in);
        }
        if !is_new && self.factorized == part.movers {
            return;
        }
        self.factorized = part.movers.clone();
        self.assemble(part);
        self.matrix.factorize();
        part.work += part.work_of_factorization;
    }

    /// Whether a row takes part in the first step whatever its impulse: friction where the normal does.
    fn is_held(&self, index: usize) -> bool {
        let row = &self.rows[index];
        match row.kind {
            Kind::Friction { normal, friction } => friction > 0.0 && self.rows[normal].is_held(),
            Kind::Normal { .. } | Kind::Joint(_) => row.is_held(),
        }
    }

    /// H, of the rows that take part.
    fn assemble(&mut self, part: &Part) {
        self.matrix.reset(self.leftmost[part.movers.clone()].iter().copied());
        for (number, masses) in self.masses[part.movers.clone()].iter().enumerate() {
            let block = self.matrix.block_mut(number, number);
            [block[0][0], block[1][1], block[2][2]] = *masses;
        }
        for pair in &self.pairs[part.pairs.clone()] {
            let (mut own, mut between) = ([Block::default(); 2], Block::default());
            for row in &self.rows[pair.rows.clone()] {
                row.stiffen(&mut own, &mut between);
            }
            let [a, b] = pair.movers.map(|mover| mover - part.movers.start);
            self.matrix.add(a, a, &own[0]);
            self.matrix.add(b, b, &own[1]);
            if a != b {
                self.matrix.add(b, a, &between);
            }
        }
    }

    /// Finds what the step does to each row. Where all were held, friction goes by the impulses at its end, or those from before if they are
    /// greater: a house of cards that rests would find another solution, in which cards slip.
    fn look_ahead(&mut self, part: &Part, holds: bool) {
        for pair in &self.pairs[part.pairs.clone()] {
            let step = pair.of(&self.step);
            for row in &mut self.rows[pair.rows.clone()] {
                row.look_ahead(&step);
            }
        }
        if holds {
            for index in part.rows.clone() {
                if let Some(normal) = self.rows[index].normal() {
                    let impulse = self.rows[normal].impulse_after().max(self.rows[normal].previous);
                    self.rows[index].set_range(impulse, part.most_friction);
                }
            }
        }
    }

    /// Goes along the step, no farther than to its end, to where φ is least: where its slope, which grows along the way, is 0. A whole step
    /// is right where no row changes its mind.
    fn go_along_step(&mut self, part: &Part) {
        let rows = &self.rows[part.rows.clone()];
        let mut start = Slope { value: 0.0, growth: 0.0 };
        for mover in part.movers.clone() {
            for axis in 0..3 {
                let momentum = self.masses[mover][axis] * self.step[mover][axis];
                start.value += momentum * (self.sought[mover][axis] - self.free[mover][axis]);
                start.growth += momentum * self.step[mover][axis];
            }
        }
        let slope = |share: f64| {
            let begin = Slope { value: start.value + share * start.growth, ..start };
            rows.iter().fold(begin, |sum, row| {
                let Slope { value, growth } = row.slope(share);
                Slope { value: sum.value + value, growth: sum.growth + growth }
            })
        };
        // The slope is made of straight pieces: from one of them on, the next root is the right one.
        let (mut low, mut high, mut share) = (0.0, 1.0, 1.0);
        for _ in 0..MOST_TRIES {
            let Slope { value, growth } = slope(share);
            if value.abs() <= ROUNDING * growth || (share == 1.0 && value < 0.0) {
                break;
            }
            *(if value > 0.0 { &mut high } else { &mut low }) = share;
            let root = share - value / growth;
            share = if root > low && root < high { root } else { 0.5 * (low + high) };
        }
        for mover in part.movers.clone() {
            for axis in 0..3 {
                self.sought[mover][axis] += share * self.step[mover][axis];
            }
        }
    }
}

#[cfg(test)]
mod tests;
