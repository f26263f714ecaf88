//! Seconds per step.

use std::time::Instant;

use crate::{Variant, WARM_UP};

/// Steps that are timed together.
const PART: usize = 5;

/// Seconds per step of each world.
pub(crate) fn measure(variants: &[Variant], is_quick: bool) -> Vec<f64> {
    let (rounds, parts) = if is_quick { (2, 4) } else { (9, 12) };
    let mut least = vec![vec![f64::INFINITY; parts]; variants.len()];
    for _ in 0..rounds {
        let mut worlds: Vec<_> = variants.iter().map(Variant::world).collect();
        for world in &mut worlds {
            (0..WARM_UP).for_each(|_| world.step());
        }
        for part in 0..parts {
            for (world, least) in worlds.iter_mut().zip(&mut least) {
                let clock = Instant::now();
                (0..PART).for_each(|_| world.step());
                least[part] = least[part].min(clock.elapsed().as_secs_f64());
            }
        }
    }
    least.iter().map(|parts| parts.iter().sum::<f64>() / (parts.len() * PART) as f64).collect()
}
