//! The Pareto front.

/// A point is on the front if its error is at most this part of that of every cheaper one: what is better by less
/// than the clock's own noise is no better.
const WORTH_IT: f64 = 0.98;

/// Which of some points, given as [cost, error], are on their Pareto front: better than every cheaper one, by 2 %
/// at least. Returns their indices, cheapest first. Points that are not finite are on no front.
///
/// ```
/// assert_eq!(rustycs::report::front(&[[4.0, 1.0], [1.0, 9.0], [2.0, 9.5], [3.0, 2.0]]), [1, 3, 0]);
/// ```
pub fn front(points: &[[f64; 2]]) -> Vec<usize> {
    let is_finite = |&index: &usize| points[index].iter().all(|value| value.is_finite());
    let mut indices: Vec<usize> = (0..points.len()).filter(is_finite).collect();
    indices.sort_by(|&one, &other| {
        let [[cost, error], [other_cost, other_error]] = [points[one], points[other]];
        cost.total_cmp(&other_cost).then(error.total_cmp(&other_error))
    });
    let mut best = f64::INFINITY;
    indices.retain(|&index| {
        let error = points[index][1];
        let is_better = error < WORTH_IT * best;
        if is_better {
            best = error;
        }
        is_better
    });
    indices
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_holds_what_is_worth_its_cost() {
        assert_eq!(front(&[[1.0, 1.0], [2.0, 0.99], [3.0, 0.97]]), [0, 2], "1 % better is no better");
        assert_eq!(front(&[[1.0, 2.0], [1.0, 1.0]]), [1], "of equal cost the better");
        assert_eq!(front(&[[1.0, f64::NAN], [2.0, f64::INFINITY], [3.0, 0.0]]), [2]);
        assert_eq!(front(&[]), Vec::<usize>::new());
    }
}
