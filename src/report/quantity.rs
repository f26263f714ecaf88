//! Figures with units.

/// How figures are written, with three significant digits.
///
/// ```
/// use rustycs::report::Unit;
///
/// assert_eq!(Unit::Of("m".into()).figure(0.0123), "12.3 mm");
/// assert_eq!(Unit::Part.figure(0.0012), "0.12 %");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Parts of a whole, as per cent: `0.12 %`, `3.0e-5 %`.
    Part,
    /// Numbers with this unit and the prefix that fits: `12.3 mm`; with an empty one mere numbers.
    Of(String),
}

impl Unit {
    /// A value in words.
    pub fn figure(&self, value: f64) -> String {
        match self {
            Self::Part => part(value),
            Self::Of(unit) => quantity(value, unit),
        }
    }
}

/// Prefixes of units, largest first.
const PREFIXES: [(i32, &str); 7] = [(6, "M"), (3, "k"), (0, ""), (-3, "m"), (-6, "µ"), (-9, "n"), (-12, "p")];

/// 10^exponent.
pub(super) fn power_of_ten(exponent: i32) -> f64 {
    10.0_f64.powi(exponent)
}

/// A quantity with three significant digits: `12.3 mm`, `0.5 %`, `3.2e-7`.
pub(super) fn quantity(value: f64, unit: &str) -> String {
    if !value.is_finite() {
        return "not finite".into();
    }
    if value == 0.0 {
        return if unit.is_empty() { "0".into() } else { format!("0 {unit}") };
    }
    if unit.is_empty() {
        return number(value);
    }
    if !takes_prefix(unit) {
        return format!("{} {unit}", number(value));
    }
    // A figure of 999.6 is 1000 when it is written with three digits.
    let size = value.abs() * 1.0005;
    let (exponent, prefix) =
        PREFIXES.into_iter().find(|&(exponent, _)| size >= power_of_ten(exponent)).unwrap_or(PREFIXES[6]);
    format!("{} {prefix}{unit}", three_digits(value / power_of_ten(exponent)))
}

/// Units that a prefix can stand before: m, s, J, m/s, rad, but not m² or %.
fn takes_prefix(unit: &str) -> bool {
    unit.chars().all(|c| c.is_ascii_alphabetic() || c == '/') && !unit.starts_with("kg")
}

/// A number without unit, three significant digits.
fn number(value: f64) -> String {
    if (1e-3..1e5).contains(&value.abs()) { three_digits(value) } else { format!("{value:.1e}") }
}

/// Three significant digits, without zeros at the end.
fn three_digits(value: f64) -> String {
    let magnitude = value.abs().log10().floor();
    let decimals = (2.0 - magnitude).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

/// A part of a whole as per cent, however small, so that figures of a column and of an axis compare: `0.12 %`,
/// `3.0e-5 %`.
fn part(value: f64) -> String {
    quantity(100.0 * value, "%")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_short_and_have_the_prefix_that_fits() {
        for (value, unit, text) in [
            (0.0123, "m", "12.3 mm"),
            (1e-3, "m", "1 mm"),
            (0.999_9, "m", "1 m"),
            (1e-6, "s", "1 µs"),
            (2.5e-14, "m", "0.025 pm"),
            (5.0, "m²", "5 m²"),
            (0.0, "m", "0 m"),
            (1234.0, "", "1234"),
            (3.24e-7, "", "3.2e-7"),
        ] {
            assert_eq!(quantity(value, unit), text);
        }
        assert_eq!(Unit::Part.figure(0.0123), "1.23 %");
        assert_eq!(Unit::Part.figure(2e-7), "2.0e-5 %");
        assert_eq!(Unit::Part.figure(0.0), "0 %");
        assert_eq!(Unit::Of("s".into()).figure(0.02), "20 ms");
    }
}
