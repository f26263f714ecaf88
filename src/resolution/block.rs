//! The two points of a contact, solved together.
//!
//! Solving them one after the other converges slowly where one box stands on another: each impulse turns
//! the box into the other point. Together they are a linear complementarity problem of size two
//! (E. Catto, "Box2D" 2.x block solver, after Cottle, Pang & Stone, "The Linear Complementarity Problem"):
//!
//! ```text
//! find x ≥ 0 with  A x + q ≥ 0  and  x·(A x + q) = 0
//! A = K + diag(leak·k),   q = vn + bias - K x₀,   x₀ the impulses so far
//! ```

use crate::compute::Lane;

/// Solves the problem for the 2×2 matrix with diagonal `a11`, `a22` and off-diagonal `a12`; returns x.
///
/// Both active: x = -A⁻¹ q, if that is not negative. Else one of the two is 0: of the two candidates
/// (x₁, 0) and (0, x₂), each the solution of its own row, the right one leaves no approach at the other
/// point. Taking the one that leaves less also decides when rounding makes neither of them exact, so that
/// no load is ever dropped.
#[inline(always)]
pub(crate) fn solve_pair<L: Lane>(a11: L, a12: L, a22: L, q: [L; 2]) -> [L; 2] {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let inverse_determinant = one / (a11 * a22 - a12 * a12);
    let both =
        [(a12 * q[1] - a22 * q[0]) * inverse_determinant, (a12 * q[0] - a11 * q[1]) * inverse_determinant];

    let [inverse_a11, inverse_a22] = [one / a11, one / a22];
    let first = (zero - q[0] * inverse_a11).max(zero);
    let second = (zero - q[1] * inverse_a22).max(zero);
    let left_at_second = (q[1] + a12 * first) * inverse_a22;
    let left_at_first = (q[0] + a12 * second) * inverse_a11;
    let prefer_first = left_at_second.greater(left_at_first);

    let both_press = L::both(both[0].greater(zero), both[1].greater(zero));
    [
        L::select(both_press, both[0], L::select(prefer_first, first, zero)),
        L::select(both_press, both[1], L::select(prefer_first, zero, second)),
    ]
}

#[cfg(test)]
mod tests {
    use super::solve_pair;

    /// The conditions of the problem are checked themselves. All numbers are of order 1, so f32 leaves
    /// residuals of a few 1e-6 (condition numbers up to 100 here).
    #[test]
    fn the_solution_satisfies_the_complementarity_conditions() {
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 40) as f32 / (1 << 24) as f32
        };
        for _ in 0..100_000 {
            let (a11, a22) = (0.5 + random(), 0.5 + random());
            let a12 = (2.0 * random() - 1.0) * 0.98 * (a11 * a22).sqrt();
            let q = [2.0 * random() - 1.0, 2.0 * random() - 1.0];
            let x = solve_pair(a11, a12, a22, q);
            let w = [a11 * x[0] + a12 * x[1] + q[0], a12 * x[0] + a22 * x[1] + q[1]];
            for i in 0..2 {
                assert!(x[i] >= 0.0 && w[i] > -2e-5 && (x[i] * w[i]).abs() < 5e-4, "{x:?} {w:?}");
            }
        }
    }
}
