//! What this machine can do on one thread, found by trying.

#![allow(unsafe_code, reason = "functions for lanes that the processor has been found to have")]

use std::hint::black_box;
use std::time::Instant;

/// Operations, and bytes, of one try; the best of so many counts.
const OPERATIONS: usize = 1 << 26;
const BYTES: usize = 1 << 28;
const TRIES: usize = 5;

/// Most of what can be done in a second.
#[derive(Clone, Debug)]
pub(in crate::speed) struct Peaks {
    /// Operations on `f32`, in the widest lanes.
    pub(in crate::speed) operations: f64,
    /// By size of a piece of memory, bytes: how many bytes of it are read and written in a second.
    memory: Vec<(usize, f64)>,
}

impl Peaks {
    pub(in crate::speed) fn find() -> Self {
        let sizes = (15..=27).map(|power| 1_usize << power);
        let memory = sizes.map(|size| (size, bytes_per_second(size))).collect();
        Self { operations: operations_per_second(), memory }
    }

    /// Bytes that are read and written in a second, where so many are gone over again and again.
    pub(in crate::speed) fn bandwidth(&self, bytes: f64) -> f64 {
        let holds_them = self.memory.iter().find(|(size, _)| *size as f64 >= bytes);
        holds_them.or(self.memory.last()).expect("some sizes were tried").1
    }
}

fn operations_per_second() -> f64 {
    best(OPERATIONS, || in_widest_lanes(Compute))
}

fn bytes_per_second(size: usize) -> f64 {
    let mut numbers = vec![1.0_f32; size / size_of::<f32>()];
    let rounds = (BYTES / (2 * size)).max(1);
    best(2 * size * rounds, || (0..rounds).for_each(|_| in_widest_lanes(Move(&mut numbers))))
}

/// So much per second, the best of some tries.
fn best(amount: usize, mut work: impl FnMut()) -> f64 {
    let tries = (0..TRIES).map(|_| {
        let clock = Instant::now();
        work();
        amount as f64 / clock.elapsed().as_secs_f64()
    });
    tries.fold(0.0, f64::max)
}

/// Work that is compiled for the lanes of the function that it is done in; `run` is to be `#[inline(always)]`. There are
/// registers for more than `NUMBERS` numbers.
trait Job {
    fn run<const NUMBERS: usize>(self);
}

fn in_widest_lanes(job: impl Job) {
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx512f") {
        // SAFETY: the processor has AVX-512.
        return unsafe { in_avx512(job) };
    } else if is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has AVX2.
        return unsafe { in_avx2(job) };
    }
    job.run::<48>();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f")]
fn in_avx512(job: impl Job) {
    job.run::<256>();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn in_avx2(job: impl Job) {
    job.run::<96>();
}

/// Products and sums, in as many chains as there is room for.
struct Compute;

impl Job for Compute {
    #[inline(always)]
    fn run<const NUMBERS: usize>(self) {
        let (factor, term) = (black_box(0.5_f32), black_box(0.5_f32));
        let mut numbers = [1.0_f32; NUMBERS];
        for _ in 0..OPERATIONS / (2 * NUMBERS) {
            for number in &mut numbers {
                *number = *number * factor + term;
            }
        }
        black_box(numbers);
    }
}

/// One product for each number of a piece of memory.
struct Move<'a>(&'a mut [f32]);

impl Job for Move<'_> {
    #[inline(always)]
    fn run<const NUMBERS: usize>(self) {
        let factor = black_box(1.0_f32);
        self.0.iter_mut().for_each(|number| *number *= factor);
    }
}
