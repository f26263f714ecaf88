//! How the time of a step grows with the number of bodies: the pile of 1,000 to 16,000 bodies, from the fall
//! until it lies.
//!
//! `cargo bench --bench scaling`, or `-- --quick` for a first look. Sizes are interleaved and the minimum of
//! the rounds counts, since other work on the machine only ever adds time. Ratios carry over from machine to
//! machine; times do not.

use std::time::Instant;

use rustycs::prelude::*;

const SIZES: [usize; 4] = [1000, 3000, 8000, 16_000];
/// Ticks per run: ten seconds, in which the largest pile falls and comes to lie.
const TICKS: usize = 600;

/// Seconds per step of a pile of `count` bodies.
fn seconds_per_step(count: usize, ticks: usize) -> f64 {
    let settings = Settings { sleep: false, ..Settings::default() };
    let mut world = rustycs_scenes::pile::build_with(count, 1, settings);
    let start = Instant::now();
    for _ in 0..ticks {
        world.step();
    }
    start.elapsed().as_secs_f64() / ticks as f64
}

fn main() {
    let is_quick = std::env::args().any(|argument| argument == "--quick");
    let (rounds, ticks) = if is_quick { (1, TICKS / 4) } else { (3, TICKS) };
    let mut best = [f64::INFINITY; SIZES.len()];
    for round in 1..=rounds {
        for (best, count) in best.iter_mut().zip(SIZES) {
            eprintln!("round {round} of {rounds}: {count} bodies ...");
            *best = best.min(seconds_per_step(count, ticks));
        }
    }
    println!("bodies   ms per step   µs per body   time against 1000   n log n would be");
    for (seconds, count) in best.iter().zip(SIZES) {
        let n_log_n = |n: usize| n as f64 * (n as f64).ln();
        println!(
            "{count:6} {:13.3} {:13.3} {:19.2} {:18.2}",
            seconds * 1e3,
            seconds * 1e6 / count as f64,
            seconds / best[0],
            n_log_n(count) / n_log_n(SIZES[0]),
        );
    }
}
