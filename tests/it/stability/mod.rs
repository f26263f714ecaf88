//! Stiff and extreme cases. What must hold in each, and why, is said where they are defined, in `benches/peers/cases`,
//! by the names used here; `cargo run --release -p rustycs-peers -- stability` plays the same ones in other engines
//! too.
//!
//! Those that take long are ignored here, beside a shorter one of their kind; run them with
//! `cargo test --release -p rustycs-tests stability -- --include-ignored`. So are those that rustycs does not meet yet,
//! with the cause.

mod confined;
mod far;
mod forces;
mod long;
mod sizes;
mod speeds;
mod stacks;
mod structures;

use rustycs_cases::Rustycs;
use rustycs_cases::stability::{self, Lab};

/// Fails unless everything holds in these cases.
#[track_caller]
fn hold(names: &[&str]) {
    let cases = stability::all();
    let engine = Rustycs::default();
    let mut broken = Vec::new();
    for name in names {
        let case = cases.iter().find(|case| case.name == *name);
        let case = case.unwrap_or_else(|| panic!("there is no case {name}"));
        let checks = case.play(&mut Lab::new(&engine)).expect("rustycs is asked in every case");
        assert!(!checks.is_empty(), "nothing is asked in {name}");
        for check in checks.iter().filter(|check| !check.holds()) {
            broken.push(format!(
                "{name}: {}: {} {}, not {:?}",
                check.what, check.value, check.unit, check.limit
            ));
        }
    }
    assert!(broken.is_empty(), "\n{}", broken.join("\n"));
}

/// Every case is named by some test in this folder.
#[test]
fn every_case_is_a_test() {
    let texts = [
        include_str!("confined.rs"),
        include_str!("far.rs"),
        include_str!("forces.rs"),
        include_str!("long.rs"),
        include_str!("sizes.rs"),
        include_str!("speeds.rs"),
        include_str!("stacks.rs"),
        include_str!("structures.rs"),
    ];
    for case in stability::all() {
        let name = format!("\"{}\"", case.name);
        assert!(texts.iter().any(|text| text.contains(&name)), "no test plays {name}");
    }
}
