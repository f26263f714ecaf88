//! What bodies have been through within a substep: each event moves a body and leaves it as one that goes on from there.

use crate::compute::BodyState;
use crate::resolution::integrate::{SpeedLimits, drift_until};

/// What a body has been through in this substep.
#[derive(Clone, Copy, Debug)]
struct Struck {
    /// How many impacts, which are found by contacts.
    impacts: u32,
    /// Time of the last event of any kind, s, and how the body went on from there.
    last: Option<(f32, BodyState)>,
}

impl Struck {
    const NEVER: Self = Self { impacts: 0, last: None };
}

/// The same of all bodies.
#[derive(Clone, Debug, Default)]
pub(crate) struct Strikes {
    by_row: Vec<Struck>,
    /// Rows that were struck in this substep, once for each event.
    rows: Vec<u32>,
}

impl Strikes {
    /// Begins a substep of so many rows.
    pub(crate) fn begin_substep(&mut self, row_count: usize) {
        for row in self.rows.drain(..) {
            self.by_row[row as usize] = Struck::NEVER;
        }
        self.by_row.resize(row_count, Struck::NEVER);
    }

    /// Whether nobody was struck.
    pub(super) fn are_none(&self) -> bool {
        self.rows.is_empty()
    }

    /// Takes note that a body was struck at a time, s, and goes on like this.
    pub(super) fn note(&mut self, row: u32, time: f32, after: BodyState) {
        self.by_row[row as usize].last = Some((time, after));
        self.rows.push(row);
    }

    /// Counts an impact of a body that was struck.
    pub(super) fn count_impact(&mut self, row: u32) {
        self.by_row[row as usize].impacts += 1;
    }

    /// How many impacts a body has been through.
    pub(super) fn impacts(&self, row: u32) -> u32 {
        self.by_row[row as usize].impacts
    }

    /// When a body was struck last, s; 0 if never.
    pub(super) fn last(&self, row: u32) -> f32 {
        self.by_row[row as usize].last.map_or(0.0, |(time, _)| time)
    }

    /// Lets what has changed a body's velocity since it was struck last act from then on; returns when that was, s.
    pub(super) fn resume(&self, row: u32, state: &mut BodyState, limits: SpeedLimits) -> f32 {
        let Some((time, after)) = &self.by_row[row as usize].last else { return 0.0 };
        drift_until(*time, after, state, limits);
        *time
    }
}
