//! Who is better, at default settings and in the same time.
//!
//! What an engine reaches in a time t is the least error among those of its settings that take no longer. Between two
//! settings of a peer's front we draw a straight line (in logarithms) and grant it the error there, though no setting
//! reaches it; our own errors are those of settings that were run.

use rustycs::report::{front, order};

use crate::engine::DEFAULT;
use crate::engine::Fineness;
use crate::error::rows::Row;

/// Errors up to this (parts of the scale of the problem, or m) are rounding: `f32` numbers are 1.2e-7 apart, and a run
/// adds up thousands.
pub(super) const ROUNDING: f64 = 1e-6;
/// An error counts for the order of convergence from this many times the engine's least on: nearer to it the curve
/// bends.
const WELL_ABOVE: f64 = 10.0;
/// Errors from here on are those of another motion, not of this one.
const LOST: f64 = 0.3;
/// Runs that an order needs at least.
const FEWEST: usize = 3;

/// All runs of a problem in one engine.
#[derive(Clone, Debug)]
pub(super) struct Runs<'a> {
    pub(super) engine: &'a str,
    pub(super) rows: Vec<&'a Row>,
    /// Run time (s per simulated second) and error of the rows that are better than every faster one.
    pub(super) front: Vec<[f64; 2]>,
}

/// How the error falls with the length of a substep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Order {
    /// As this power of it.
    Observed(f64),
    /// There is nothing to fall: every error is rounding.
    Rounding,
    /// Too few errors lie on a slope.
    Unknown,
}

impl<'a> Runs<'a> {
    pub(super) fn new(engine: &'a str, rows: Vec<&'a Row>) -> Self {
        let points: Vec<[f64; 2]> = rows.iter().map(|row| [row.run_time[0], row.error]).collect();
        let front = front(&points).into_iter().map(|index| points[index]).collect();
        Self { engine, rows, front }
    }

    /// The row at default settings.
    pub(super) fn default_row(&self) -> Option<&'a Row> {
        self.rows.iter().copied().find(|row| row.fineness == DEFAULT)
    }

    /// The row with the least error, the fastest of equals.
    pub(super) fn best_row(&self) -> Option<&'a Row> {
        let [_, error] = *self.front.last()?;
        self.rows
            .iter()
            .copied()
            .filter(|row| row.error == error)
            .min_by(|one, other| one.run_time[0].total_cmp(&other.run_time[0]))
    }

    /// The least error of settings that take no longer than this, s per simulated second.
    pub(super) fn within(&self, time: f64) -> Option<f64> {
        self.front.iter().rev().find(|point| point[0] <= time).map(|point| point[1])
    }

    /// The same, where settings between those of the front are granted too.
    pub(super) fn granted(&self, time: f64) -> Option<f64> {
        let reached = self.within(time)?;
        let after = self.front.iter().position(|point| point[0] > time);
        let Some(after) = after.filter(|&after| after > 0) else { return Some(reached) };
        let [[t0, e0], [t1, e1]] = [self.front[after - 1], self.front[after]];
        // An error of 0 has no logarithm.
        if e1 <= 0.0 {
            return Some(reached);
        }
        let part = (time / t0).ln() / (t1 / t0).ln();
        Some((e0.ln() + part * (e1 / e0).ln()).exp())
    }

    /// The order of convergence: see [`Order`]. For each number of substeps, rows count from the longest substep on, down to
    /// the best one, or to the first that is not well above the least error of all: what comes after is rounding.
    pub(super) fn order(&self) -> Order {
        let least = self.rows.iter().map(|row| row.error).fold(f64::INFINITY, f64::min);
        if !self.rows.is_empty() && self.rows.iter().all(|row| row.error <= ROUNDING) {
            return Order::Rounding;
        }
        let is_well_above = |row: &Row| row.error > (WELL_ABOVE * least).max(ROUNDING);
        let step = |Fineness { tick_rate, substeps }: Fineness| 1.0 / (tick_rate * f64::from(substeps));
        let mut substeps: Vec<u32> = self.rows.iter().map(|row| row.fineness.substeps).collect();
        substeps.sort_unstable();
        substeps.dedup();
        let mut series = Vec::new();
        for count in substeps {
            let mut rows: Vec<&Row> =
                self.rows.iter().copied().filter(|row| row.fineness.substeps == count).collect();
            rows.sort_by(|one, other| one.fineness.tick_rate.total_cmp(&other.fineness.tick_rate));
            let best = rows.iter().min_by(|one, other| one.error.total_cmp(&other.error));
            let finest = best.map_or(0.0, |row| step(row.fineness));
            let clean = rows.into_iter().take_while(|row| is_well_above(row));
            let falling = clean.filter(|row| row.error < LOST && step(row.fineness) >= finest);
            series.push(falling.map(|row| [step(row.fineness), row.error]).collect::<Vec<_>>());
        }
        if series.iter().map(Vec::len).sum::<usize>() < FEWEST {
            return Order::Unknown;
        }
        order(&series).map_or(Order::Unknown, Order::Observed)
    }
}

/// Errors that are reached in the same time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct InTime {
    /// s per simulated second.
    pub(super) time: f64,
    pub(super) ours: f64,
    /// That of the best peer.
    pub(super) theirs: f64,
}

impl InTime {
    /// Ours as a part of theirs; below 1 we are better. `None` if theirs is rounding, which nothing can be better than.
    pub(super) fn ratio(self) -> Option<f64> {
        (self.theirs > ROUNDING).then(|| self.ours / self.theirs)
    }
}

/// rustycs beside its peers, on one problem.
#[derive(Clone, Debug)]
pub(super) struct Comparison<'a> {
    pub(super) ours: Runs<'a>,
    pub(super) peers: Vec<Runs<'a>>,
}

impl Comparison<'_> {
    /// Our error at default settings, and the least one of the peers at theirs; `None` if we or all peers were not run
    /// there.
    pub(super) fn at_default(&self) -> Option<[f64; 2]> {
        let theirs = self.peers.iter().filter_map(Runs::default_row).map(|row| row.error).reduce(f64::min)?;
        Some([self.ours.default_row()?.error, theirs])
    }

    /// Whether our error at default settings is no larger than the best peer's; what is rounding is as good as any.
    pub(super) fn is_best_at_default(&self) -> Option<bool> {
        self.at_default().map(|[ours, theirs]| ours <= theirs.max(ROUNDING))
    }

    /// What is reached in a time, s per simulated second; `None` if we or all peers have nothing so fast.
    pub(super) fn in_time(&self, time: f64) -> Option<InTime> {
        let theirs = self.peers.iter().filter_map(|peer| peer.granted(time)).reduce(f64::min)?;
        Some(InTime { time, ours: self.ours.within(time)?, theirs })
    }

    /// In the time that each engine takes at its default settings, the comparison that is worst for us.
    pub(super) fn in_default_time(&self) -> Option<InTime> {
        let defaults = self.peers.iter().chain([&self.ours]).filter_map(Runs::default_row);
        worst(defaults.filter_map(|row| self.in_time(row.run_time[0])))
    }

    /// In the time of each setting on the front of a peer, from our fastest setting on, the comparison that is worst
    /// for us.
    pub(super) fn along_the_fronts(&self) -> Option<InTime> {
        let times = self.peers.iter().flat_map(|peer| &peer.front).map(|point| point[0]);
        worst(times.filter_map(|time| self.in_time(time)))
    }
}

fn worst(comparisons: impl Iterator<Item = InTime>) -> Option<InTime> {
    let ratio = |comparison: &InTime| comparison.ratio().unwrap_or(0.0);
    comparisons.max_by(|one, other| ratio(one).total_cmp(&ratio(other)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::rows::tests::row;

    /// Rows at default settings and others, from [run time, error].
    fn rows(engine: &str, points: &[[f64; 2]]) -> Vec<Row> {
        points
            .iter()
            .enumerate()
            .map(|(index, &[time, error])| Row {
                engine: engine.into(),
                fineness: if index == 0 {
                    DEFAULT
                } else {
                    Fineness { tick_rate: index as f64, substeps: 1 }
                },
                error,
                run_time: [time; 2],
                ..row()
            })
            .collect()
    }

    fn runs<'a>(engine: &'a str, rows: &'a [Row]) -> Runs<'a> {
        Runs::new(engine, rows.iter().collect())
    }

    #[test]
    fn an_error_is_reached_in_the_time_of_the_settings_that_have_it_and_granted_to_peers_between_them() {
        let rows = rows("peer", &[[1.0, 0.1], [4.0, 0.025], [2.0, 0.2], [100.0, 0.025]]);
        let runs = runs("peer", &rows);
        assert_eq!(runs.front, [[1.0, 0.1], [4.0, 0.025]]);
        assert_eq!(
            [0.9, 1.0, 3.9, 4.0, 1e9].map(|time| runs.within(time)),
            [None, Some(0.1), Some(0.1), Some(0.025), Some(0.025)]
        );
        assert!((runs.granted(2.0).unwrap() - 0.05).abs() < 1e-12, "half way in logarithms");
        assert_eq!([0.5, 5.0].map(|time| runs.granted(time)), [None, Some(0.025)]);
    }

    #[test]
    fn equal_time_takes_the_better_peer_and_the_time_that_is_worst_for_us() {
        let ours = rows("rustycs", &[[2.0, 0.01], [8.0, 0.001]]);
        let (slow, quick) = (rows("slow", &[[10.0, 0.02]]), rows("quick", &[[1.0, 0.4], [4.0, 0.1]]));
        let comparison = Comparison {
            ours: runs("rustycs", &ours),
            peers: vec![runs("slow", &slow), runs("quick", &quick)],
        };
        assert_eq!(comparison.at_default(), Some([0.01, 0.02]));
        assert_eq!(comparison.is_best_at_default(), Some(true));
        assert_eq!(comparison.in_time(1.5), None, "we have nothing so fast");
        // In our 2 s: 0.01 beside 0.2. In 10 s: 0.001 beside 0.02. In 1 s we have nothing.
        let worst = comparison.in_default_time().unwrap();
        assert!((worst.ratio().unwrap() - 0.05).abs() < 1e-12, "{worst:?}");
        // In the 4 s of quick: 0.01 beside 0.1.
        let worst = comparison.along_the_fronts().unwrap();
        assert!((worst.ratio().unwrap() - 0.1).abs() < 1e-12 && worst.time == 4.0, "{worst:?}");
    }

    #[test]
    fn nothing_is_better_than_rounding() {
        let (ours, theirs) = (rows("rustycs", &[[2.0, 5e-7]]), rows("peer", &[[1.0, 1e-7]]));
        let comparison = Comparison { ours: runs("rustycs", &ours), peers: vec![runs("peer", &theirs)] };
        assert_eq!(comparison.is_best_at_default(), Some(true));
        assert_eq!(comparison.in_default_time().unwrap().ratio(), None);
        assert_eq!(comparison.ours.order(), Order::Rounding);
    }

    /// Errors 0.1 (30/f)² + 1e-5, and from 480 Hz on ones that go to and fro by rounding.
    #[test]
    fn the_order_is_that_of_the_part_that_falls() {
        let error = |rate: f64| match rate {
            480.0 => 2e-5,
            960.0 => 3e-3,
            1920.0 => 5e-6,
            _ => 0.1 * (30.0 / rate).powi(2) + 1e-5,
        };
        let rows: Vec<Row> = [30.0, 60.0, 120.0, 240.0, 480.0, 960.0, 1920.0]
            .into_iter()
            .map(|tick_rate| Row {
                fineness: Fineness { tick_rate, substeps: 1 },
                error: error(tick_rate),
                ..row()
            })
            .collect();
        let Order::Observed(order) = runs("peer", &rows).order() else { panic!("there is a slope") };
        assert!((order - 2.0).abs() < 0.01, "{order}");
        assert_eq!(runs("peer", &rows[..1]).order(), Order::Unknown);
        assert_eq!(runs("peer", &[]).order(), Order::Unknown, "of an engine that was not run");
    }
}
