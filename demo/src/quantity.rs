//! Figures with units, as short as they can be read.

/// A quantity with four significant digits and an SI prefix: `12.35 kJ`, `0.1204 mm`.
pub(crate) fn with_unit(value: f64, unit: &str) -> String {
    const PREFIXES: [(f64, &str); 7] =
        [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n")];
    let size = value.abs();
    // What is below a thousandth of the smallest prefix is rounding.
    if size < 1e-12 {
        return format!("0 {unit}");
    }
    // A figure of 999.96 is already 1000 when it is written with four digits.
    let (scale, prefix) =
        PREFIXES.into_iter().find(|(scale, _)| size >= 0.99995 * scale).unwrap_or(PREFIXES[6]);
    format!("{} {prefix}{unit}", with_four_digits(value / scale))
}

/// A quantity with four significant digits and no prefix, for units that have one already: `0.06691 kg m²`.
pub(crate) fn without_prefix(value: f64, unit: &str) -> String {
    let size = value.abs();
    if size == 0.0 {
        format!("0 {unit}")
    } else if (1e-4..1e6).contains(&size) {
        let decimals = (3 - size.log10().floor() as i32).max(0) as usize;
        format!("{value:.decimals$} {unit}")
    } else {
        format!("{value:.3e} {unit}")
    }
}

/// A number below 1000 with four significant digits.
fn with_four_digits(value: f64) -> String {
    let decimals = match value.abs() {
        size if size >= 99.995 => 1,
        size if size >= 9.9995 => 2,
        _ => 3,
    };
    format!("{value:.decimals$}")
}

/// Milliseconds: `0.412 ms`.
pub(crate) fn milliseconds(seconds: f64) -> String {
    format!("{:.3} ms", seconds * 1e3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prefixes_follow_the_size() {
        assert_eq!(with_unit(12_345.0, "J"), "12.35 kJ");
        assert_eq!(with_unit(-0.000_52, "m"), "-520.0 µm");
        assert_eq!(with_unit(0.0, "J"), "0 J");
        assert_eq!(with_unit(999.96, "J"), "1.000 kJ");
        assert_eq!(with_unit(3e12, "J"), "3000.0 GJ");
        assert_eq!(without_prefix(0.066_912, "kg m²"), "0.06691 kg m²");
        assert_eq!(without_prefix(-1234.56, "kg"), "-1235 kg");
        assert_eq!(without_prefix(2.5e9, "kg"), "2.500e9 kg");
        assert_eq!(milliseconds(0.000_412), "0.412 ms");
    }
}
