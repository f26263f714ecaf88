//! Worlds as they were: for going back in time, and for taking back an edit.

use std::collections::VecDeque;

use rustycs::World;

/// Simulated time between two worlds that are kept, s.
const INTERVAL: f64 = 0.25;
/// Worlds kept at most: ten seconds.
const MOST_WORLDS: usize = 40;
/// Bodies kept at most, in all worlds together: about 100 MB.
const MOST_BODIES: usize = 100_000;

/// A world at a moment.
#[derive(Clone, Debug)]
pub(crate) struct Moment {
    pub(crate) world: World,
    /// Simulated time since the scene began, s.
    pub(crate) seconds: f64,
}

/// The last seconds of a world.
#[derive(Debug, Default)]
pub(crate) struct History {
    moments: VecDeque<Moment>,
}

impl History {
    /// Keeps a world, if the last one kept is old enough.
    pub(crate) fn observe(&mut self, world: &World, seconds: f64) {
        let is_due = self.moments.back().is_none_or(|last| seconds >= last.seconds + INTERVAL);
        if !is_due {
            return;
        }
        let most = (MOST_BODIES / world.body_count().max(1)).clamp(2, MOST_WORLDS);
        while self.moments.len() >= most {
            self.moments.pop_front();
        }
        self.moments.push_back(Moment { world: world.clone(), seconds });
    }

    /// The last world kept from before `seconds`; what came after it is forgotten.
    pub(crate) fn before(&mut self, seconds: f64) -> Option<Moment> {
        while self.moments.back().is_some_and(|last| last.seconds >= seconds) {
            self.moments.pop_back();
        }
        // It stays, as the oldest one is as far back as one can go.
        self.moments.back().cloned()
    }

    /// How far back one can go from a time, s.
    pub(crate) fn reach(&self, seconds: f64) -> f64 {
        self.moments.front().map_or(0.0, |first| (seconds - first.seconds).max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rustycs::Settings;

    #[test]
    fn going_back_ends_at_the_oldest_world() {
        let mut history = History::default();
        let mut world = World::new(Settings::default());
        for tick in 0..120 {
            history.observe(&world, f64::from(tick) / 60.0);
            world.step();
        }
        assert_eq!(history.before(2.0).unwrap().world.ticks(), 105);
        assert_eq!(history.before(1.75).unwrap().world.ticks(), 90);
        for _ in 0..20 {
            let Some(earlier) = history.before(0.1) else { break };
            assert_eq!(earlier.world.ticks(), 0);
        }
    }
}
