//! Projection of positions: the classic way to part overlapping bodies, after the velocities are done.
//!
//! Each iteration moves the bodies of a contact directly, by a share of the overlap, as if by an impulse
//! on positions (non-linear Gauss-Seidel; E. Catto, "Iterative Dynamics with Temporal Coherence", 2005).

use crate::compute::{Lane, PairStates};
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::contact_block::ContactBlock;
use crate::resolution::integrate::turn;
use crate::resolution::kernel::Kernel;

/// Overlap that the classic scheme leaves, so that contacts persist, m.
const SLOP: f32 = 0.005;

/// Share of the overlap beyond that which one iteration removes, no unit; more overshoots where contacts share bodies.
const SHARE: f32 = 0.2;

/// One iteration of the classic scheme moves no point of a contact farther than this, m.
const LARGEST_CORRECTION: f32 = 0.2;

/// One iteration.
#[derive(Clone, Debug)]
pub(crate) struct Project {
    /// Overlap that is left, m.
    pub(crate) slop: f32,
    /// No point of a contact is moved farther than this, m.
    pub(crate) farthest: f32,
}

impl Project {
    /// That of the classic scheme.
    pub(crate) const CLASSIC: Self = Self { slop: SLOP, farthest: LARGEST_CORRECTION };

    fn project(&self, constraint: &ContactConstraint<f32>, states: &mut PairStates<'_>, place: usize) {
        for point in constraint.points.iter().filter(|point| point.normal_k > 0.0) {
            let [mut a, mut b] = states.gather::<f32>(place);
            let separation = constraint.separation(point, &a, &b);
            let correction = (SHARE * (separation + self.slop)).clamp(-self.farthest, 0.0);
            let impulse = constraint.normal * (-correction / point.normal_k);
            a.delta_position = a.delta_position - impulse * constraint.inverse_mass_a;
            turn(&mut a, -constraint.inverse_inertia_a * point.anchor_a.cross(impulse));
            b.delta_position = b.delta_position + impulse * constraint.inverse_mass_b;
            turn(&mut b, constraint.inverse_inertia_b * point.anchor_b.cross(impulse));
            states.scatter_one(place, &[a, b]);
        }
    }
}

impl Kernel for Project {
    /// Turns bodies, and so looks at one contact after the other.
    #[inline(always)]
    fn run<L: Lane>(&self, block: &mut ContactBlock, states: &mut PairStates<'_>, place: usize) {
        for place in place..place + L::WIDTH {
            self.project(&block.load(place), states, place);
        }
    }
}
