//! Rolling resistance: what is lost where a circle rolls on something, as a moment against its spin.
//!
//! For the spin w of b against a, the moments of inertia I, and the impulse λ along the normal in a substep:
//!
//! ```text
//! constraint   w = 0,   effective mass 1/k, k = 1/I_a + 1/I_b
//! moment       |Λ| ≤ 3/2 c r λ,   so that a disc, which takes (m + I/r²) a = 3/2 m a = Λ/(r h), is slowed down by c λ/(m h)
//! ```
//!
//! r is the radius of the disc, or the extent of the other body if that can turn and is smaller: a box on a planet does not roll on a radius of
//! 6,400 km. A circle touches with one point, whose impulse is λ. Only what lies flat on a planet has two, and does not roll; there it is that of
//! the first.
//!
//! As friction does, it makes up for what would turn the circle as far as it goes, and no further: the spin is not turned
//! round. It begins with what it was in the last substep, half before and half after the move, so that a disc on a slope
//! comes to rest, and discs in a heap do not tremble. After the move it is solved for all contacts before the sweep, whose friction answers it,
//! and once more after it, with the load that the sweep has found. Solved contact by contact within the sweep, the friction of the next contacts
//! undoes a part of it, and heaps with discs creep on: of 36 heaps of 300 and 1,000 bodies 26 sleep after twenty seconds, instead of 31.
//!
//! In lanes, for blocks that have a circle with rolling resistance. In what is solved directly it is a row like others.

use crate::body::Motion;
use crate::collision::Contact;
use crate::compute::{BodyState, Lane, columns};
use crate::resolution::constraint::ContactConstraint;

/// How much harder than a moment c r N the same deceleration is for a disc that turns as well as moves, no unit: 1 + I/(m r²).
const OF_A_DISC: f32 = 1.5;

/// Greatest moment of rolling resistance per impulse along the normal of a contact, m; `None` where there is none.
pub(super) fn rolling_arm(contact: &Contact, motions: [&Motion; 2]) -> Option<f32> {
    if !motions.iter().any(|motion| motion.is_round) {
        return None;
    }
    let can_turn = |motion: &Motion| motion.inverse_inertia > 0.0;
    // The size of ground that is not round does not matter: it may be of small pieces.
    let sizes =
        motions.into_iter().filter(|motion| motion.is_round || can_turn(motion)).map(|motion| motion.extent);
    let radius = sizes.fold(f32::INFINITY, f32::min);
    let arm = OF_A_DISC * contact.mixed.rolling_resistance * radius;
    (arm > 0.0 && motions.into_iter().any(can_turn)).then_some(arm)
}

/// What rolls on a contact, or on as many as a lane holds.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Rolling<C> {
    /// Greatest moment per impulse along the normal, m; 0 where nothing rolls.
    pub(crate) arm: C,
    /// What the warm starts begin from: the moment of the last substep, N m s, on b. Once solved, all of this.
    pub(crate) moment: C,
    /// What of that of this substep has acted, N m s.
    pub(crate) acted: C,
}

columns!(Rolling { arm, moment, acted });

impl<L: Lane> Rolling<L> {
    /// Begins a substep, in which nothing has acted yet.
    #[inline(always)]
    pub(crate) fn begin(&mut self) {
        self.acted = L::splat(0.0);
    }

    /// One of the warm starts of a substep: the `part` of what acted in the last one, no unit, as far as the impulse goes that is applied along
    /// the normal, N s. Returns the moment on b, N m s.
    #[inline(always)]
    pub(crate) fn start(&mut self, part: L, applied: L) -> L {
        let greatest = self.arm * applied;
        let moment = (part * self.moment).min(greatest).max(-greatest);
        self.acted = self.acted + moment;
        moment
    }

    /// After the move: stops the spin, as far as the load goes.
    #[inline(always)]
    pub(crate) fn solve(&mut self, constraint: &ContactConstraint<L>, [a, b]: &mut [BodyState<L>; 2]) {
        let greatest = self.arm * constraint.points[0].normal_impulse;
        let k = constraint.inverse_inertia_a + constraint.inverse_inertia_b;
        let can_turn = k.greater(L::splat(0.0));
        let stopping = (a.angular_velocity - b.angular_velocity) / L::select(can_turn, k, L::splat(1.0));
        self.moment = (self.acted + stopping).min(greatest).max(-greatest);
        let change = self.moment - self.acted;
        self.acted = self.moment;
        constraint.turn([change; 2], a, b);
    }
}
