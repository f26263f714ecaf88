//! A row of the direct solve: one velocity of one or two bodies that an impulse within bounds is to bring to zero.

use crate::resolution::direct::skyline::Skyline;

/// Velocities that rows ask for are found to this much, m/s. Ten times less costs Newton steps that `f32` cannot show; ten
/// times more, and the sag that remains at rest, this over the bias rate, is seen.
pub(super) const TOLERANCE: f64 = 1e-5;

/// Rows that ask for a speed below this are held in the first Newton step, m/s: where those of wide gaps are held too,
/// or none, more islands are not solved.
const HELD: f64 = 0.1;

/// What the impulse of a row may be, N s.
#[derive(Clone, Copy, Debug)]
pub(super) enum Bound {
    /// At least the first and at most the second: of a joint -∞ and ∞, of a motor what it is able to.
    Range([f64; 2]),
    /// Either way, at most `friction` times the impulse of another row.
    FrictionOf { row: usize, friction: f64 },
}

impl Bound {
    /// What presses and does not pull: contacts, ropes, limits.
    pub(super) const AT_LEAST_ZERO: Self = Self::Range([0.0, f64::INFINITY]);
}

/// What a row does to its bodies, and they to it: u = J v + bias, and v grows by M⁻¹ Jᵀ λ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// Numbers of the two bodies; none for what impulses do not move.
    pub(super) movers: [Option<u32>; 2],
    /// J: what u is of the velocities of each.
    pub(super) jacobian: [[f64; 3]; 2],
    /// What of u does not depend on these velocities, m/s.
    pub(super) bias: f64,
    /// Speed that a unit of impulse gives the row by itself, 1/kg.
    pub(super) k: f64,
    pub(super) bound: Bound,
    /// λ, N s.
    pub(super) impulse: f64,
    /// The range of λ now, N s: of friction it follows the other row.
    pub(super) range: [f64; 2],
    /// Impulse per velocity that the row yields by, 1/(c k), kg.
    stiffness: f64,
    /// It yields to the change from this impulse, N s.
    previous: f64,
}

/// u of a row, m/s, and what a step adds to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    speed: f64,
    gain: f64,
}

/// How a sum of functions grows along a way, per part of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slope {
    pub(super) value: f64,
    /// How fast the slope grows itself.
    pub(super) growth: f64,
}

impl Row {
    /// A row between two bodies that asks for nothing yet.
    pub(super) fn new(movers: [Option<u32>; 2], bound: Bound) -> Self {
        Self {
            movers,
            jacobian: [[0.0; 3]; 2],
            bias: 0.0,
            k: 1.0,
            bound,
            impulse: 0.0,
            range: [0.0; 2],
            stiffness: 1.0,
            previous: 0.0,
        }
    }

    /// Bounds the impulse for the Newton step to come, with friction by this impulse of another row, N s.
    pub(super) fn set_range(&mut self, other_impulse: f64) {
        self.range = match self.bound {
            Bound::Range(range) => range,
            Bound::FrictionOf { friction, .. } => [-friction * other_impulse, friction * other_impulse],
        };
    }

    /// Lets the row give back this share of a change of its impulse from that of now.
    pub(super) fn yield_by(&mut self, compliance: f64) {
        self.stiffness = 1.0 / (compliance * self.k);
        self.previous = self.impulse;
    }

    /// The nearest impulse that is within the bounds.
    fn bounded(&self, impulse: f64) -> f64 {
        let [least, greatest] = self.range;
        impulse.max(least).min(greatest)
    }

    /// J times these numbers.
    fn along(&self, velocities: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (jacobian, mover) in self.jacobian.iter().zip(self.movers) {
            if let Some(mover) = mover {
                let of_mover = &velocities[3 * mover as usize..][..3];
                sum += jacobian.iter().zip(of_mover).map(|(entry, velocity)| entry * velocity).sum::<f64>();
            }
        }
        sum
    }

    /// Adds Jᵀ λ to three numbers for each mover, each divided by the `mass` of its place.
    pub(super) fn apply(&self, impulse: f64, to: &mut [f64], mass: impl Fn(usize) -> f64) {
        for (jacobian, mover) in self.jacobian.iter().zip(self.movers) {
            if let Some(mover) = mover {
                let first = 3 * mover as usize;
                for (axis, to) in to[first..first + 3].iter_mut().enumerate() {
                    *to += jacobian[axis] * impulse / mass(first + axis);
                }
            }
        }
    }

    /// u, m/s.
    pub(super) fn speed(&self, velocities: &[f64]) -> f64 {
        self.along(velocities) + self.bias
    }

    /// The impulse with which the row, by itself, gets what it asks for at this speed.
    fn wanted(&self, speed: f64) -> f64 {
        self.bounded(self.impulse - speed / self.k)
    }

    /// Whether the row has what it asks for, to the tolerance, or all that the bounds allow: the complementarity
    /// condition.
    pub(super) fn is_complementary(&self, velocities: &[f64]) -> bool {
        self.k * (self.wanted(self.speed(velocities)) - self.impulse).abs() <= TOLERANCE
    }

    /// Gives the row by itself what it asks for at this speed, as a sweep does.
    pub(super) fn sweep(&mut self, speed: f64, velocities: &mut [f64], masses: &[f64]) {
        let wanted = self.wanted(speed);
        self.apply(wanted - self.impulse, velocities, |place| masses[place]);
        self.impulse = wanted;
    }

    /// The impulse that the row answers a speed with.
    fn answer(&self, speed: f64) -> f64 {
        self.bounded(self.previous - speed * self.stiffness)
    }

    /// Takes up the impulse that the row answers these velocities with.
    pub(super) fn respond(&mut self, velocities: &[f64]) {
        self.impulse = self.answer(self.speed(velocities));
    }

    /// Whether an impulse would change with the speed: it is not at a bound.
    fn yields_at(&self, impulse: f64) -> bool {
        self.range[0] < impulse && impulse < self.range[1]
    }

    /// Whether the impulse of now would change with the speed.
    pub(super) fn yields(&self) -> bool {
        self.yields_at(self.impulse)
    }

    /// Whether the first Newton step takes the row for one that yields, whatever its impulse.
    pub(super) fn is_held(&self) -> bool {
        self.bias < HELD
    }

    /// Speed at these velocities, and what a step adds.
    pub(super) fn way(&self, velocities: &[f64], step: &[f64]) -> Way {
        Way { speed: self.speed(velocities), gain: self.along(step) }
    }

    /// The impulse at the end of a way.
    pub(super) fn impulse_after(&self, way: Way) -> f64 {
        self.answer(way.speed + way.gain)
    }

    /// The slope of what the row adds to φ, at a part of the way.
    pub(super) fn slope(&self, way: Way, part: f64) -> Slope {
        let impulse = self.answer(way.speed + part * way.gain);
        let growth = if self.yields_at(impulse) { way.gain * way.gain * self.stiffness } else { 0.0 };
        Slope { value: -impulse * way.gain, growth }
    }

    /// Adds Jᵀ J/(c k), with the mover `first` in the first rows of the matrix.
    pub(super) fn stiffen(&self, matrix: &mut Skyline, first: u32) {
        let sides = || self.movers.into_iter().zip(&self.jacobian);
        for (mover, left) in sides() {
            for (other, right) in sides() {
                if let (Some(mover), Some(other)) = (mover, other)
                    && other <= mover
                {
                    let corner = [mover, other].map(|mover| 3 * (mover - first) as usize);
                    matrix.add_product(corner, left, right, self.stiffness);
                }
            }
        }
    }
}
