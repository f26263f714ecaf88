//! On which side of a line a point is, without a doubt.
//!
//! Everything about an outline that has to be right is decided by the sign of one determinant. It is computed in `f64`, and if
//! that is not certain, summed exactly: the products of two `f32` have 48 bits and fit in an `f64` (J. Shewchuk, 1997, "Adaptive
//! precision floating-point arithmetic and fast robust geometric predicates", the sums of expansions).

use core::cmp::Ordering;

use crate::math::Vec2;

/// Rounding of the determinant as a share of the sum of its two products: three roundings of 2⁻⁵³ each, and more than
/// twice as much.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// How the way from a over b to c turns: `Greater` to the left, `Less` to the right, `Equal` where the three are on a line.
///
/// ```text
/// sign of (b - a) × (c - a)
/// ```
pub(super) fn turn(a: Vec2, b: Vec2, c: Vec2) -> Ordering {
    let [ax, ay, bx, by, cx, cy] = [a.x, a.y, b.x, b.y, c.x, c.y].map(f64::from);
    let (left, right) = ((bx - ax) * (cy - ay), (by - ay) * (cx - ax));
    let determinant = left - right;
    if determinant.abs() > ROUNDING * (left.abs() + right.abs()) {
        return determinant.total_cmp(&0.0);
    }
    // The same multiplied out: each product is exact.
    sign_of_sum([ax * by, -ay * bx, bx * cy, -by * cx, cx * ay, -cy * ax])
}

/// The sign of a sum, whatever cancels.
fn sign_of_sum(terms: [f64; 6]) -> Ordering {
    // The sum so far, as numbers of which none overlaps another, the smallest first.
    let mut parts = [0.0; 6];
    for (count, term) in terms.into_iter().enumerate() {
        let mut carried = term;
        for part in &mut parts[..count] {
            (carried, *part) = sum_and_rest(carried, *part);
        }
        parts[count] = carried;
    }
    let largest = parts.iter().rev().find(|part| **part != 0.0).unwrap_or(&0.0);
    largest.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}

/// The rounded sum of two numbers, and what rounding took from it.
fn sum_and_rest(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    let of_a = sum - of_b;
    (sum, (a - of_a) + (b - of_b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::testing::rng;

    /// Whole numbers of up to 24 bits times powers of two: the determinant in `i128` is exact.
    #[test]
    fn the_turn_is_that_of_whole_numbers() {
        let mut rng = rng(1);
        let mut on_a_line = 0;
        for round in 0..100_000 {
            // Few bits give points on a line, many give sums that cancel.
            let bits = 2 + round % 22;
            let mut number = || i128::from(rng.below(1 << bits)) << rng.below(30);
            let mut a = [number(), number()];
            let mut b = [number(), number()];
            let mut c =
                if round % 3 == 0 { [2 * b[0] - a[0], 2 * b[1] - a[1]] } else { [number(), number()] };
            // Beyond 24 bits the coordinates are rounded first.
            for point in [&mut a, &mut b, &mut c] {
                *point = point.map(|x| x as f32 as i128);
            }
            let determinant = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            let exact = |[x, y]: [i128; 2]| Vec2::new(x as f32, y as f32);
            assert_eq!(turn(exact(a), exact(b), exact(c)), determinant.cmp(&0), "{a:?} {b:?} {c:?}");
            on_a_line += u32::from(determinant == 0);
        }
        assert!(on_a_line > 10_000, "{on_a_line}");
    }

    #[test]
    fn coordinates_of_any_size_turn_right() {
        let (small, large) = (1e-5_f32, 1e8_f32);
        let [a, b] = [Vec2::new(-large, -large), Vec2::new(large, large)];
        assert_eq!(turn(a, b, Vec2::new(small, small)), Ordering::Equal);
        assert_eq!(turn(a, b, Vec2::new(small, small.next_up())), Ordering::Greater);
        assert_eq!(turn(a, b, Vec2::new(small, small.next_down())), Ordering::Less);
    }
}
