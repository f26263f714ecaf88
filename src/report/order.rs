//! The observed order of convergence.

use crate::report::result::Row;

/// Rows count from this many times the reference's error on. Nearer to it, what the reference is off by bends
/// the line: a reference of step h/4 makes the slope of a first-order error 1.2 between h and 2h, and 1.05
/// between 4h and 8h.
const WELL_ABOVE: f64 = 10.0;

/// A row as a point: series, ln of the substep (s), ln of the error.
type Point<'a> = (&'a str, f64, f64);

/// Least squares over all series, each with its own intercept: Σ Σ dx dy / Σ Σ dx², with dx and dy from the mean
/// of their series.
pub(super) fn observed<'a>(rows: impl Iterator<Item = &'a Row>) -> Option<f64> {
    let is_good = |row: &&'a Row| row.error > 0.0 && row.error.is_finite();
    let is_well_above = |row: &&'a Row| row.error > WELL_ABOVE * row.reference_error;
    let points: Vec<Point<'_>> = rows
        .filter(is_good)
        .filter(is_well_above)
        .map(|row| {
            let step = row.settings.tick_seconds() / f64::from(row.settings.substeps);
            (row.series.as_str(), step.ln(), row.error.ln())
        })
        .collect();
    // Where every series is one point, they are one series: of substeps.
    slope(&points).or_else(|| slope(&points.iter().map(|&(_, x, y)| ("", x, y)).collect::<Vec<_>>()))
}

fn slope(points: &[Point<'_>]) -> Option<f64> {
    let (mut xy, mut xx) = (0.0, 0.0);
    for &(series, x, y) in points {
        let of_series = || points.iter().filter(|point| point.0 == series);
        let count = of_series().count() as f64;
        let mean_x = of_series().map(|point| point.1).sum::<f64>() / count;
        let mean_y = of_series().map(|point| point.2).sum::<f64>() / count;
        xy += (x - mean_x) * (y - mean_y);
        xx += (x - mean_x) * (x - mean_x);
    }
    // Rounding of the means is far below, a step twice as long far above.
    (xx > 1e-6).then(|| xy / xx)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_is_that_of_all_series_whatever_their_factors() {
        let points: Vec<Point<'_>> =
            [("a", 1.0, 5.0), ("a", 2.0, 7.0), ("b", 1.0, 0.0), ("b", 3.0, 4.0)].into();
        assert!((slope(&points).unwrap() - 2.0).abs() < 1e-12);
        assert_eq!(slope(&points[..1]), None);
        assert_eq!(slope(&[points[0], points[2]]), None);
    }
}
