//! A row of the direct solve: one velocity of one or two bodies that an impulse within bounds is to bring to zero.

use core::ops::Range;

use crate::resolution::direct::skyline::Block;

/// Velocities that rows ask for are found to this much, m/s. Ten times less costs Newton steps that `f32` cannot show; ten
/// times more, and the sag that remains at rest, this over the bias rate, is seen.
pub(super) const TOLERANCE: f64 = 1e-5;

/// Share of its own impulse that a row gives back when the impulse changes, no unit. It makes redundant contacts share their load, as the
/// compliance of the sweeps does. With 1e-2 what is newly loaded sinks in by some tenths of a millimetre, and is lifted out again, which keeps tables
/// on slender legs swaying for ever; with 1e-3 a stone of a heap of gravel trembles at 2 cm/s.
pub(super) const COMPLIANCE: f64 = 4e-3;

/// The same where bodies are joined: joints do not yield, and what contacts bear beside them is not determined. With 4e-3 a drive of 1 MN presses
/// 10 kg twice as deep; with 2e-3 crates in a ring of welds bear more than blows give.
pub(super) const COMPLIANCE_OF_JOINED: f64 = 1e-2;

/// The compliance is never less than this, which is that of joints, and of the last stage where nothing presses yet, or a blow comes: what yields to a
/// change would yield to the whole load there, and a stack of 200 swing by half a metre per second. `f64` has digits for little less.
pub(super) const LEAST_COMPLIANCE: f64 = 1e-6;

/// Rows whose bias, but for how what is not moved goes past, is below this are held in the first Newton step, m/s: where those of wide gaps are
/// held too, or none, more islands are not solved.
const HELD: f64 = 0.1;

/// What a row belongs to, and so what its impulse may be.
#[derive(Clone, Copy, Debug)]
pub(super) enum Kind {
    /// The normal of a contact: it presses with no more than `most`, N s, and does not pull.
    Normal { most: f64 },
    /// The friction of a contact: either way, at most `friction` times the impulse of the row of its `normal`.
    Friction { normal: usize, friction: f64 },
    /// A joint: at least the first and at most the second, N s. Of a motor these are what it is able to, of a rod -∞ and ∞.
    Joint([f64; 2]),
}

/// What belongs to each of the three velocities of a mover: of its centre along x and y, and of its turn.
pub(super) type Triple = [f64; 3];

/// Two movers and the rows between them.
#[derive(Clone, Debug)]
pub(super) struct Pair {
    /// Numbers of the movers: twice the same where impulses do not move the other body.
    pub(super) movers: [usize; 2],
    pub(super) rows: Range<usize>,
}

impl Pair {
    /// What its movers have of what there is for each.
    pub(super) fn of(&self, all: &[Triple]) -> [Triple; 2] {
        self.movers.map(|mover| all[mover])
    }

    /// Adds to what its movers have.
    pub(super) fn add(&self, to: &mut [Triple], what: &[Triple; 2]) {
        for (mover, what) in self.movers.into_iter().zip(what) {
            for (to, what) in to[mover].iter_mut().zip(what) {
                *to += what;
            }
        }
    }
}

/// The scalar product.
pub(super) fn dot(a: Triple, b: Triple) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// What a row does to its two movers, and they to it: u = J v + bias, and v grows by M⁻¹ Jᵀ λ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// J: what u is of the velocities of each; zero of a body that impulses do not move.
    pub(super) jacobian: [Triple; 2],
    /// What of u does not depend on these velocities, m/s.
    pub(super) bias: f64,
    /// By how much it yields to a unit of impulse, as springs and motors do, 1/kg.
    pub(super) softness: f64,
    /// What of the bias is how what impulses do not move goes past, m/s.
    pub(super) carried: f64,
    /// Speed that a unit of impulse gives the row by itself, 1/kg.
    pub(super) k: f64,
    pub(super) kind: Kind,
    /// λ, N s.
    pub(super) impulse: f64,
    /// The range of λ now, N s: of friction it follows the other row.
    pub(super) range: [f64; 2],
    /// Impulse per velocity that the row yields by, 1/(c k + its softness), kg.
    stiffness: f64,
    /// It yields to the change from this impulse, N s.
    pub(super) previous: f64,
    /// With which stiffness and Jacobian it takes part in the matrix: 0 where it does not.
    taken: Taken,
    /// u where it has last responded, m/s.
    speed: f64,
    /// What a Newton step adds to u, m/s.
    speed_of_step: f64,
}

/// What a matrix has of a row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Taken {
    jacobian: [Triple; 2],
    stiffness: f64,
}

/// How a sum of functions grows along a way, per part of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slope {
    pub(super) value: f64,
    /// How fast the slope grows itself.
    pub(super) growth: f64,
}

impl Row {
    /// A row that asks for nothing yet.
    pub(super) fn new(kind: Kind) -> Self {
        Self {
            jacobian: [[0.0; 3]; 2],
            bias: 0.0,
            softness: 0.0,
            carried: 0.0,
            k: 1.0,
            kind,
            impulse: 0.0,
            range: [0.0; 2],
            stiffness: 1.0,
            previous: 0.0,
            taken: Taken::default(),
            speed: 0.0,
            speed_of_step: 0.0,
        }
    }

    /// Bounds the impulse for the Newton step to come, with friction by this impulse along the normal, and at most so much, N s, or as many times that
    /// as its coefficient is above 1. In a jam each normal bears what friction adds to the other, and both would grow without end.
    pub(super) fn set_range(&mut self, along_normal: f64, most_friction: f64) {
        self.range = match self.kind {
            Kind::Normal { most } => [0.0, most],
            Kind::Friction { friction, .. } => {
                let most = (friction * along_normal).min(friction.max(1.0) * most_friction);
                [-most, most]
            }
            Kind::Joint(range) => range,
        };
    }

    /// Lets the row give back this share of a change of its impulse from that of now. Joints have the least compliance: with more, they would bring
    /// back each time what the contacts of their bodies have gained by that, and these would bear more and more.
    pub(super) fn yield_by(&mut self, compliance: f64) {
        let compliance = if self.is_of_joint() { LEAST_COMPLIANCE } else { compliance };
        self.stiffness = 1.0 / (compliance * self.k + self.softness);
        self.previous = self.impulse;
    }

    pub(super) fn is_normal(&self) -> bool {
        matches!(self.kind, Kind::Normal { .. })
    }

    pub(super) fn is_of_joint(&self) -> bool {
        matches!(self.kind, Kind::Joint(_))
    }

    /// Of friction the row of the normal that bounds it.
    pub(super) fn normal(&self) -> Option<usize> {
        match self.kind {
            Kind::Friction { normal, .. } => Some(normal),
            Kind::Normal { .. } | Kind::Joint(_) => None,
        }
    }

    /// How fast it gives way to the change of its impulse in this stage, m/s: closing where that has grown, opening where it has fallen; 0 where it
    /// is at a bound.
    pub(super) fn gives_way_by(&self) -> f64 {
        if self.yields() { (self.impulse - self.previous).abs() / self.stiffness } else { 0.0 }
    }

    /// Whether bodies that overlap are to move apart by it.
    pub(super) fn pushes_apart(&self) -> bool {
        self.is_normal() && self.bias < self.carried
    }

    /// How fast it goes the way that its impulse is to stop, at these velocities and with nothing pushed apart, m/s or rad/s. Friction follows.
    pub(super) fn closing(&self, velocities: &[Triple; 2]) -> f64 {
        match self.kind {
            Kind::Normal { .. } => -(self.along(velocities) + self.carried),
            Kind::Friction { .. } => 0.0,
            Kind::Joint([least, greatest]) => {
                let speed = self.speed(velocities);
                if speed < 0.0 && greatest > 0.0 || speed > 0.0 && least < 0.0 { speed.abs() } else { 0.0 }
            }
        }
    }

    /// How much harder a motor can still drive, as an impulse by the root of the mass that it drives, kg^½ m/s; 0 of one without a bound, and
    /// of what is no motor.
    pub(super) fn driving(&self) -> f64 {
        match self.kind {
            Kind::Joint([least, greatest])
                if least < greatest && least.is_finite() && greatest.is_finite() =>
            {
                least.abs().max(greatest) * self.k.sqrt()
            }
            _ => 0.0,
        }
    }

    /// Brings the impulse into its range.
    pub(super) fn keep_within_range(&mut self) {
        self.impulse = self.bounded(self.impulse);
    }

    /// The nearest impulse that is within the bounds.
    fn bounded(&self, impulse: f64) -> f64 {
        let [least, greatest] = self.range;
        impulse.max(least).min(greatest)
    }

    /// J times these numbers.
    fn along(&self, [of_a, of_b]: &[Triple; 2]) -> f64 {
        dot(self.jacobian[0], *of_a) + dot(self.jacobian[1], *of_b)
    }

    /// Adds Jᵀ λ to these numbers.
    pub(super) fn apply(&self, impulse: f64, to: &mut [Triple; 2]) {
        for (to, jacobian) in to.iter_mut().zip(&self.jacobian) {
            for (to, entry) in to.iter_mut().zip(jacobian) {
                *to += entry * impulse;
            }
        }
    }

    /// u, m/s.
    pub(super) fn speed(&self, velocities: &[Triple; 2]) -> f64 {
        self.along(velocities) + self.bias
    }

    /// The impulse with which the row, by itself, gets what it asks for at this speed.
    fn wanted(&self, speed: f64) -> f64 {
        self.bounded(self.impulse - (speed + self.softness * self.impulse) / (self.k + self.softness))
    }

    /// Whether the row has what it asks for, to the tolerance, or all that the bounds allow: the complementarity
    /// condition.
    pub(super) fn is_complementary(&self, velocities: &[Triple; 2]) -> bool {
        self.k * (self.wanted(self.speed(velocities)) - self.impulse).abs() <= TOLERANCE
    }

    /// Gives the row by itself what it asks for at this speed, as a sweep does; returns by how much its impulse changes.
    pub(super) fn sweep(&mut self, speed: f64) -> f64 {
        let wanted = self.wanted(speed);
        wanted - std::mem::replace(&mut self.impulse, wanted)
    }

    /// Goes back to the impulse from before it yielded.
    pub(super) fn go_back(&mut self) {
        self.impulse = self.previous;
    }

    /// The impulse that the row answers a speed with.
    fn answer(&self, speed: f64) -> f64 {
        self.bounded(self.previous - (speed + self.softness * self.previous) * self.stiffness)
    }

    /// Takes up the impulse that the row answers these velocities with.
    pub(super) fn respond(&mut self, velocities: &[Triple; 2]) {
        self.speed = self.speed(velocities);
        self.impulse = self.answer(self.speed);
    }

    /// Whether the impulse is still that which the speed is answered with, to the tolerance, when bounds have changed.
    pub(super) fn stays(&self) -> bool {
        self.k * (self.answer(self.speed) - self.impulse).abs() <= TOLERANCE
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
        let ([least, greatest], bias) = (self.range, self.bias - self.carried);
        // What can bear nothing else does not yield.
        least < greatest && (greatest > 0.0 && bias < HELD || least < 0.0 && bias > -HELD)
    }

    /// Takes up what a step from where it has responded will add.
    pub(super) fn look_ahead(&mut self, step: &[Triple; 2]) {
        self.speed_of_step = self.along(step);
    }

    /// The impulse at the end of the step.
    pub(super) fn impulse_after(&self) -> f64 {
        self.answer(self.speed + self.speed_of_step)
    }

    /// The slope of what the row adds to φ, at a share of the step.
    pub(super) fn slope(&self, share: f64) -> Slope {
        let impulse = self.answer(self.speed + share * self.speed_of_step);
        let growth = if self.yields_at(impulse) {
            self.speed_of_step * self.speed_of_step * self.stiffness
        } else {
            0.0
        };
        Slope { value: -impulse * self.speed_of_step, growth }
    }

    /// Has the row take part in the matrix, as it is now, or not. Returns whether that changes the matrix.
    pub(super) fn take_part(&mut self, is_in: bool) -> bool {
        let stiffness = if is_in { self.stiffness } else { 0.0 };
        let taken = Taken { jacobian: self.jacobian, stiffness };
        let changes = taken != self.taken && (is_in || self.taken.stiffness != 0.0);
        self.taken = taken;
        changes
    }

    /// Adds Jᵀ J/(c k + softness) to the blocks of both movers, and to that in the row of the one and the column of the other, if it takes part.
    pub(super) fn stiffen(&self, own: &mut [Block; 2], between: &mut Block) {
        let Taken { jacobian: [a, b], stiffness } = &self.taken;
        if *stiffness == 0.0 {
            return;
        }
        let [stiff_a, stiff_b] = [a, b].map(|jacobian| jacobian.map(|entry| entry * stiffness));
        let [own_a, own_b] = own;
        for (to, left, right) in [(own_a, &stiff_a, a), (own_b, &stiff_b, b), (between, &stiff_b, a)] {
            for (to, left) in to.iter_mut().zip(left) {
                for (to, right) in to.iter_mut().zip(right) {
                    *to += left * right;
                }
            }
        }
    }
}
