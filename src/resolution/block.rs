//! The two points of a contact, solved together.
//!
//! Solving them one after the other converges slowly where one box stands on another: each impulse turns
//! the box into the other point. Together they are a linear complementarity problem of size two
//! (E. Catto, "Box2D" 2.x block solver, after Cottle, Pang & Stone, "The Linear Complementarity Problem"):
//!
//! ```text
//! find x ≥ 0 with  A x + q ≥ 0  and  x·(A x + q) = 0
//! A = K + diag(γ·k),   q = vn + bias - K x₀,   x₀ the impulses so far
//! ```

use crate::compute::Lane;

/// One row of the problem: `own` x + `other` x' + `scale` q ≥ 0, with x' the unknown of the other row. Any positive
/// multiple of it asks for the same. `own` is between 1e-18 and 1e18, so that products of two are numbers still.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row<L> {
    pub(crate) own: L,
    pub(crate) other: L,
    pub(crate) scale: L,
}

/// Solves the problem of two rows; returns x.
///
/// Let x̂ = -A⁻¹ q, and u what solves each row on its own. Where x̂₂ > 0 the second point presses, and x₁ is x̂₁; else it
/// does not, and x₁ is u₁; 0 if that is negative. The same for x₂. No load is dropped or borne twice by that where
/// neither x̂ is positive: then not both u are, as |a₁₂| is well below √(a₁₁ a₂₂).
///
/// What is left to do once q is known is short, as all else waits for it; and there are two divisions, which take long.
#[inline(always)]
pub(crate) fn solve_pair<L: Lane>([first, second]: [Row<L>; 2], q: [L; 2]) -> [L; 2] {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let product = first.own * second.own;
    let inverse_product = one / product;
    let inverse_determinant = one / (product - first.other * second.other);
    // The adjugate of A, but for its signs.
    let own = [second.own * first.scale, first.own * second.scale];
    let other = [first.other * second.scale, second.other * first.scale];
    let gain_alone = [-(own[0] * inverse_product), -(own[1] * inverse_product)];
    let gain_own = [own[0] * inverse_determinant, own[1] * inverse_determinant];
    let gain_other = [other[0] * inverse_determinant, other[1] * inverse_determinant];

    let alone = [gain_alone[0] * q[0], gain_alone[1] * q[1]];
    let together = [gain_other[0] * q[1] - gain_own[0] * q[0], gain_other[1] * q[0] - gain_own[1] * q[1]];
    [
        L::select(together[1].greater(zero), together[0], alone[0]).max(zero),
        L::select(together[0].greater(zero), together[1], alone[1]).max(zero),
    ]
}

#[cfg(test)]
mod tests {
    use super::{Row, solve_pair};

    /// The conditions of the problem are checked themselves, in a unit in which the matrix is of order 1. There all
    /// numbers are of order 1, so f32 leaves residuals of a few 1e-6 (condition numbers up to 100 here).
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
            let unit = [1e-17, 1.0, 1e17][(random() * 3.0) as usize];
            let row =
                |own: f32, scale: f32| Row { own: own * scale * unit, other: a12 * scale * unit, scale };
            let rows = [row(a11, 0.5 + random()), row(a22, 0.5 + random())];
            let x = solve_pair(rows, q).map(|x| x * unit);
            let w = [a11 * x[0] + a12 * x[1] + q[0], a12 * x[0] + a22 * x[1] + q[1]];
            for i in 0..2 {
                assert!(x[i] >= 0.0 && w[i] > -2e-5 && (x[i] * w[i]).abs() < 5e-4, "{x:?} {w:?}");
            }
        }
    }
}
