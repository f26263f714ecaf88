//! Random numbers for the unit tests, so that the library needs no crate even for them.

use core::ops::{Range, RangeInclusive};

/// Random numbers (D. Knuth, "The Art of Computer Programming", vol. 2, 3.3.4: the multiplier of MMIX); the
/// same in every run.
#[derive(Debug)]
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// A whole number from 0 to `end - 1`.
    pub(crate) fn below(&mut self, end: u32) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as u32 % end
    }

    /// A number from `low` to `high`.
    pub(crate) fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * (self.below(1 << 24) as f32 / 16_777_216.0)
    }

    /// A number of a range.
    pub(crate) fn random_range<T>(&mut self, range: impl Draw<T>) -> T {
        range.draw(self)
    }
}

/// A range that numbers can be drawn from.
pub(crate) trait Draw<T> {
    fn draw(self, random: &mut Random) -> T;
}

impl Draw<f32> for Range<f32> {
    fn draw(self, random: &mut Random) -> f32 {
        random.between(self.start, self.end)
    }
}

impl Draw<f64> for Range<f64> {
    fn draw(self, random: &mut Random) -> f64 {
        self.start + (self.end - self.start) * (f64::from(random.below(1 << 31)) / 2_147_483_648.0)
    }
}

impl Draw<usize> for Range<usize> {
    fn draw(self, random: &mut Random) -> usize {
        self.start + random.below((self.end - self.start) as u32) as usize
    }
}

impl Draw<usize> for RangeInclusive<usize> {
    fn draw(self, random: &mut Random) -> usize {
        (*self.start()..*self.end() + 1).draw(random)
    }
}
