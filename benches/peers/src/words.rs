//! What the pages say in the same words.

use std::fmt::Write as _;

use rustycs::report::Unit;

use crate::machine;

/// Lines that say on what machine and with which engines the rows were measured.
pub(crate) fn circumstances(versions: impl IntoIterator<Item = impl AsRef<str>>, text: &mut String) {
    _ = writeln!(text, "- Machine: {}.", machine::name());
    for version in versions {
        _ = writeln!(text, "- {}.", version.as_ref());
    }
}

/// How often a command was given that measured rows, and when first and last.
pub(crate) fn goes<'a>(begun: impl Iterator<Item = &'a str>) -> String {
    let mut times: Vec<&str> = begun.collect();
    times.sort_unstable();
    times.dedup();
    match times.as_slice() {
        [once] => format!("in one go, begun {once}"),
        [first, .., last] => format!("in {} goes, begun {first} to {last}", times.len()),
        [] => String::new(),
    }
}

/// By how much the middle one of several times of the same work is longer than the least, at most in half of the rows.
pub(crate) fn spread(times: impl Iterator<Item = [f64; 2]>) -> String {
    Unit::Part.figure(middle(times.map(|[least, middle]| middle / least - 1.0).collect()))
}

/// The middle one of some values; of an even number of them the upper one of the two in the middle.
///
/// # Panics
/// If there are none.
pub(crate) fn middle(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Names, as a list.
pub(crate) fn list<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    names.into_iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// How many of something hold, and the names of those that do not.
pub(crate) fn tally<'a>(what: &str, verdicts: impl Iterator<Item = (&'a str, bool)>) -> String {
    let verdicts: Vec<(&str, bool)> = verdicts.collect();
    let fails: Vec<&str> = verdicts.iter().filter(|(_, holds)| !holds).map(|(name, _)| *name).collect();
    let all = verdicts.len();
    if fails.is_empty() {
        return format!("all {all} {what}");
    }
    format!("{} of {all} {what}; not on {}", all - fails.len(), list(fails))
}

/// A name that leads to its heading on the page.
pub(crate) fn link(name: &str) -> String {
    // As renderers of Markdown name the place of a heading.
    let anchor: String = name.chars().filter(|c| c.is_alphanumeric() || *c == '-').collect();
    format!("[{name}](#{})", anchor.to_lowercase())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tally_names_what_does_not_hold() {
        let verdicts = [("slide", true), ("roll", false), ("bowl", false)];
        assert_eq!(tally("problems", verdicts.into_iter()), "1 of 3 problems; not on `roll`, `bowl`");
        assert_eq!(tally("problems", verdicts.into_iter().take(1)), "all 1 problems");
    }

    #[test]
    fn goes_are_counted_once_each() {
        assert_eq!(goes(["12:00", "12:00"].into_iter()), "in one go, begun 12:00");
        assert_eq!(goes(["12:00", "11:00", "12:00"].into_iter()), "in 2 goes, begun 11:00 to 12:00");
    }

    #[test]
    fn links_lead_to_the_places_of_headings() {
        assert_eq!(link("kepler-0.5"), "[kepler-0.5](#kepler-05)");
    }

    #[test]
    fn the_spread_is_that_of_the_middle_row() {
        assert_eq!(spread([[1.0, 1.5], [2.0, 2.0], [1.0, 1.1]].into_iter()), Unit::Part.figure(1.1 - 1.0));
        assert_eq!(middle(vec![4.0, 1.0, 3.0, 2.0]), 3.0);
    }
}
