//! Proof that the engines are set up to solve the same problem.
//!
//! Each proof is a small scene with a closed form, run so finely that the known errors of the engines do not show
//! and a wrong density, coefficient or step would. It gives a deviation, which must not exceed its limit.

mod proofs;
#[cfg(test)]
mod tests;

use crate::engine::Engine;
use crate::engines;
use proofs::PROOFS;

/// A property that the set-up of every engine must have.
struct Proof {
    /// What must hold, and in what the deviation is measured.
    claim: &'static str,
    /// Largest deviation.
    limit: f64,
    /// Deviation from the closed form, 0 or more.
    deviation: fn(&dyn Engine) -> f64,
}

impl Proof {
    fn holds(&self, deviation: f64) -> bool {
        // NaN fails the comparison.
        deviation <= self.limit
    }
}

/// Prints every proof for every engine.
///
/// # Errors
/// Which of them failed.
pub(crate) fn check() -> Result<(), String> {
    let mut failed = Vec::new();
    println!("{:>10}  {:>9}", "deviation", "limit");
    for engine in engines::all() {
        println!("\n{}", engine.version());
        for proof in PROOFS {
            let deviation = (proof.deviation)(&*engine);
            let verdict = if proof.holds(deviation) { "ok    " } else { "FAILED" };
            println!("{deviation:10.1e}  {:9.1e}  {verdict}  {}", proof.limit, proof.claim);
            if !proof.holds(deviation) {
                failed.push(format!("{}: {}", engine.name(), proof.claim));
            }
        }
    }
    match engines::fair_box2d() {
        Ok(()) => println!("\nBox2D is compiled at -O3 without assertions."),
        Err(reason) => failed.push(reason),
    }
    if failed.is_empty() {
        return Ok(());
    }
    Err(format!("The comparison would not be fair:\n    {}", failed.join("\n    ")))
}
