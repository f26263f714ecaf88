//! The observed order of convergence.

use crate::report::result::Row;

/// Rows count from this many times the reference's error on. Nearer to it, what the reference is off by bends
/// the line: a reference of step h/4 makes the slope of a first-order error 1.2 between h and 2h, and 1.05
/// between 4h and 8h.
const WELL_ABOVE: f64 = 10.0;

/// The order p of convergence, error ~ step^p, that is observed in runs given as [step, error] (s, any unit).
///
/// Least squares over all series, each with its own factor: Σ Σ dx dy / Σ Σ dx², with dx and dy the differences
/// of the logarithms from the mean of their series. Where every series is a single run, they are one series.
/// Runs without an error above 0, or an infinite one, do not count; `None` if what is left has no two steps.
///
/// ```
/// use rustycs::report::order;
///
/// let second = |step: f64| [step, 3.0 * step * step];
/// let series = [0.1, 0.05, 0.025].map(second).to_vec();
/// assert!((order(&[series]).unwrap() - 2.0).abs() < 1e-9);
/// assert_eq!(order(&[vec![second(0.1)]]), None);
/// ```
pub fn order(series: &[Vec<[f64; 2]>]) -> Option<f64> {
    let is_good = |[step, error]: [f64; 2]| step > 0.0 && error > 0.0 && error.is_finite();
    let logarithms = |runs: &Vec<[f64; 2]>| -> Vec<[f64; 2]> {
        runs.iter().copied().filter(|&run| is_good(run)).map(|run| run.map(f64::ln)).collect()
    };
    let series: Vec<Vec<[f64; 2]>> = series.iter().map(logarithms).collect();
    slope(&series).or_else(|| slope(&[series.concat()]))
}

fn slope(series: &[Vec<[f64; 2]>]) -> Option<f64> {
    let (mut xy, mut xx) = (0.0, 0.0);
    for points in series.iter().filter(|points| !points.is_empty()) {
        let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / points.len() as f64;
        let [mean_x, mean_y] = [mean(0), mean(1)];
        for [x, y] in points {
            xy += (x - mean_x) * (y - mean_y);
            xx += (x - mean_x) * (x - mean_x);
        }
    }
    // Rounding of the means is far below, a step twice as long far above.
    (xx > 1e-6).then(|| xy / xx)
}

/// The order of rows that are well above the error of their reference.
pub(super) fn observed<'a>(rows: impl Iterator<Item = &'a Row>) -> Option<f64> {
    let mut series: Vec<(&str, Vec<[f64; 2]>)> = Vec::new();
    for row in rows.filter(|row| row.error > WELL_ABOVE * row.reference_error) {
        let run = [row.settings.tick_seconds() / f64::from(row.settings.substeps), row.error];
        match series.iter_mut().find(|(name, _)| *name == row.series) {
            Some((_, runs)) => runs.push(run),
            None => series.push((&row.series, vec![run])),
        }
    }
    order(&series.into_iter().map(|(_, runs)| runs).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_is_that_of_all_series_whatever_their_factors() {
        let series = [vec![[1.0, 5.0], [2.0, 7.0]], vec![[1.0, 0.0], [3.0, 4.0]]];
        assert!((slope(&series).unwrap() - 2.0).abs() < 1e-12);
        assert_eq!(slope(&[vec![[1.0, 5.0]]]), None);
        assert_eq!(slope(&[vec![[1.0, 5.0]], vec![[1.0, 0.0]]]), None);
    }

    #[test]
    fn series_of_one_run_are_one_series_and_runs_without_an_error_do_not_count() {
        let cubic = |step: f64| vec![[step, step.powi(3)]];
        assert!((order(&[cubic(1.0), cubic(0.5), cubic(0.1)]).unwrap() - 3.0).abs() < 1e-12);
        let with_bad = vec![[1.0, 1.0], [0.5, 0.0], [0.2, f64::NAN], [0.3, f64::INFINITY], [0.1, 0.01]];
        assert!((order(&[with_bad]).unwrap() - 2.0).abs() < 1e-12);
        assert_eq!(order(&[]), None);
    }
}
