//! Fixed ticks from the time of frames.

use crate::world::World;

/// At most this many ticks per call: after a slow frame the world falls behind instead of making the next
/// frame slower still.
const MOST_TICKS: u32 = 8;

impl World {
    /// Takes as many ticks as fit into `frame_seconds` and what earlier calls left over; returns how many.
    ///
    /// At most 8 per call: time beyond that is dropped, so that a slow frame cannot spiral. Time that is
    /// negative or not finite counts as none.
    pub fn advance(&mut self, frame_seconds: impl Into<f64>) -> u32 {
        let frame_seconds: f64 = frame_seconds.into();
        if frame_seconds.is_finite() && frame_seconds > 0.0 {
            self.unused_time += frame_seconds;
        }
        let tick = self.settings.tick_seconds();
        let mut ticks = 0;
        // Sixty frames of 1/60 s are to make sixty ticks, whatever way the sum is rounded.
        while self.unused_time >= tick * (1.0 - 1e-9) {
            if ticks == MOST_TICKS {
                self.unused_time = 0.0;
                break;
            }
            self.step();
            self.unused_time = (self.unused_time - tick).max(0.0);
            ticks += 1;
        }
        ticks
    }

    /// How far the time given to [`advance`](Self::advance) is between the last tick and the next, 0 to 1:
    /// for drawing bodies between the pose before the last tick (0) and the pose now (1).
    pub fn alpha(&self) -> f32 {
        ((self.unused_time / self.settings.tick_seconds()) as f32).clamp(0.0, 1.0)
    }
}
