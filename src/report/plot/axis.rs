//! An axis of powers of ten.

use crate::report::quantity::power_of_ten;

/// From values to pixels.
#[derive(Debug)]
pub(super) struct Axis {
    /// log10 of the values at both ends.
    range: [f64; 2],
    /// Pixels at both ends.
    pixels: [f64; 2],
}

/// More named ticks than this do not fit.
const MOST_NAMES: i32 = 8;
/// An axis is at least this long, in decades.
const SHORTEST: f64 = 1.0;
/// Room beyond the last value on each side, as a part of the axis.
const MARGIN: f64 = 0.06;

impl Axis {
    /// An axis that shows all values, which are positive.
    pub(super) fn new(values: impl Iterator<Item = f64>, pixels: [f64; 2]) -> Self {
        let (low, high) = values
            .map(f64::log10)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let room = (0.5 * (SHORTEST - (high - low))).max(MARGIN * (high - low));
        Self { range: [low - room, high + room], pixels }
    }

    /// Pixels of a decade; negative for an axis upward.
    pub(super) fn decade(&self) -> f64 {
        (self.pixels[1] - self.pixels[0]) / (self.range[1] - self.range[0])
    }

    /// Where a value is, px.
    pub(super) fn at(&self, value: f64) -> f64 {
        self.pixels[0] + (value.log10() - self.range[0]) * self.decade()
    }

    /// Values with a line, and whether they have a name.
    pub(super) fn ticks(&self) -> Vec<(f64, bool)> {
        let [low, high] = self.range;
        let decades = low.floor() as i32..=high.ceil() as i32;
        let is_short = high - low < 2.0;
        let every = ((high - low) as i32 / MOST_NAMES + 1).max(1);
        let within = |value: &f64| (low..=high).contains(&value.log10());
        let mut ticks = Vec::new();
        for exponent in decades {
            for digit in [1.0, 2.0, 5.0] {
                let value = digit * power_of_ten(exponent);
                let is_decade = digit == 1.0;
                if within(&value) && (is_short || is_decade) {
                    ticks.push((value, is_short || exponent.rem_euclid(every) == 0));
                }
            }
        }
        ticks
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_has_two_to_nine_names_whatever_its_length() {
        for decades in 0..24 {
            for start in [-9.3, -2.0, 0.4] {
                let ends = [start, start + f64::from(decades)].map(|x: f64| 10.0_f64.powf(x));
                let axis = Axis::new(ends.into_iter(), [0.0, 600.0]);
                let names = axis.ticks().into_iter().filter(|tick| tick.1).count();
                assert!((2..=9).contains(&names), "{names} names over {decades} decades from {start}");
                assert!(ends.iter().all(|&end| (0.0..=600.0).contains(&axis.at(end))));
            }
        }
    }
}
