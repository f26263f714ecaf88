//! Numbers in lanes: the contact kernel is one text, generic over how many contacts it solves at a time.
//!
//! [`Lane`] is what the kernel computes with. `f32` is the lane of width 1: the reference that every wider
//! lane must agree with bit for bit, which it can because no operation here is fused or estimated. Four numbers
//! are computed with by SSE2 or NEON, eight by AVX2, sixteen by AVX-512. Numbers are stored in [`Column`]s of
//! sixteen, whatever the width.
//!
//! [`run`] is where a width is chosen: a [`Job`] is compiled once per width, all of it inlined into one function
//! that may use the instructions of that width.
//!
//! [`ThreadPool`] divides work among threads, where there are several. Where a slice cannot be divided for it, parts write to
//! what two lists say: [`Chosen`] elements, by a list of indices that takes none twice, and the bodies of [`PairBlocks`],
//! which are divided only after a check that they share none. Both hand out what a part may write, and nothing else.
//!
//! This is the only module with `unsafe` in it, and no safe function of it relies on what its callers do.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod column;
mod columns;
#[cfg(feature = "report")]
mod counted;
mod dispatch;
mod distinct;
mod lane;
#[cfg(target_arch = "aarch64")]
mod neon;
mod pair_blocks;
mod pool;
#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
mod portable;
mod prefetch;
#[cfg_attr(not(feature = "parallel"), path = "alone.rs")]
mod shared_workers;
#[cfg(target_arch = "x86_64")]
mod sse2;
mod state;
#[cfg(feature = "parallel")]
mod sync;
#[cfg(test)]
mod tests;
mod vector;
#[cfg(feature = "parallel")]
mod workers;

#[cfg(target_arch = "aarch64")]
use neon as four;
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
use portable as four;
#[cfg(target_arch = "x86_64")]
use sse2 as four;

// Portable lanes read and write row by row.
#[cfg_attr(not(any(target_arch = "x86_64", target_arch = "aarch64")), allow(unused_imports))]
use column::RowPlace;
pub(crate) use column::{COLUMN, Column, RowPairs};
pub(crate) use columns::{Columns, columns};
#[cfg(feature = "report")]
pub(crate) use counted::{Count, Counted, count};
pub use dispatch::Lanes;
pub(crate) use dispatch::{Job, Width, run};
pub(crate) use distinct::{Chosen, DistinctIndices};
pub(crate) use lane::Lane;
use lane::each_alone;
pub(crate) use pair_blocks::{BlocksOver, PairBlocks, PairStates, RowMarks};
pub(crate) use pool::{ByColumn, Divide, Executor, MOST_THREADS, ThreadPool, lock};
#[cfg(test)]
pub(crate) use portable::F32x4;
pub(crate) use prefetch::{FIRST_LINE, LINE, prefetch, prefetch_lines};
pub(crate) use state::{BodyState, GROUND_ROW};
pub(crate) use vector::{LaneRot, LaneVec2};
