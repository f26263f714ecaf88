//! Which width is computed with: chosen once, at run time, by what the processor has.

use crate::compute::Lane;
#[cfg(target_arch = "x86_64")]
use crate::compute::avx2::F32x8;
#[cfg(target_arch = "x86_64")]
use crate::compute::avx512::{F32x16, has_avx512};
use crate::compute::four::F32x4;

/// How many contacts are computed with at a time.
///
/// It affects how long a step takes, not its results. A number that the processor does not support falls back to the next
/// smaller one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Lanes {
    /// As many as the processor can, but fewer where a small world would leave most lanes half empty.
    #[default]
    Auto,
    /// One, as the equations are written.
    One,
    /// Four: SSE2 on x86-64, NEON on AArch64.
    Four,
    /// Eight: AVX2 on x86-64.
    Eight,
    /// Sixteen: AVX-512 on x86-64, where the processor does not lower its clock for it.
    Sixteen,
}

/// A width that the processor has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Width(Kind);

#[derive(Clone, Copy, Debug)]
enum Kind {
    One,
    Four,
    /// Made only where AVX2 was found.
    #[cfg(target_arch = "x86_64")]
    Eight,
    /// Made only where AVX-512 was found.
    #[cfg(target_arch = "x86_64")]
    Sixteen,
}

impl Lanes {
    /// How many contacts it is on this processor: 1, 4, 8 or 16; at most, with [`Lanes::Auto`].
    ///
    /// ```
    /// use rustycs::Lanes;
    ///
    /// assert_eq!(Lanes::One.count(), 1);
    /// assert!(Lanes::Auto.count() >= Lanes::Four.count());
    /// ```
    pub fn count(self) -> usize {
        match self.width().0 {
            Kind::One => 1,
            Kind::Four => F32x4::WIDTH,
            #[cfg(target_arch = "x86_64")]
            Kind::Eight => F32x8::WIDTH,
            #[cfg(target_arch = "x86_64")]
            Kind::Sixteen => F32x16::WIDTH,
        }
    }

    /// The width to compute with where so many numbers at a time wait for no other, one of the `sizes` after the other: one
    /// that is asked for, or the fastest. In small worlds lanes are half empty. Then those of eight are faster than those
    /// of sixteen, if it does not take five thirds as many; one of four takes as long as one of eight.
    pub(crate) fn width_for(self, sizes: impl Iterator<Item = usize>) -> Width {
        let [fours, eights, sixteens] = sizes.fold([0; 3], |[fours, eights, sixteens], size| {
            [fours + size.div_ceil(4), eights + size.div_ceil(8), sixteens + size.div_ceil(16)]
        });
        let fastest = match self {
            Self::Auto if fours == eights => Self::Four,
            Self::Auto if 3 * eights < 5 * sixteens => Self::Eight,
            _ => self,
        };
        fastest.width()
    }

    /// The width that stands for it on this processor.
    pub(crate) fn width(self) -> Width {
        Width(match self {
            Self::One => Kind::One,
            #[cfg(target_arch = "x86_64")]
            Self::Auto | Self::Sixteen if has_avx512() => Kind::Sixteen,
            #[cfg(target_arch = "x86_64")]
            Self::Auto | Self::Sixteen | Self::Eight if is_x86_feature_detected!("avx2") => Kind::Eight,
            Self::Auto | Self::Sixteen | Self::Eight | Self::Four => Kind::Four,
        })
    }
}

/// Work that can be done at any width. `run` is to be `#[inline(always)]`, and so is all that it computes lanes
/// with: only code within the one function that is compiled for AVX2, or AVX-512, becomes that.
pub(crate) trait Job {
    fn run<L: Lane>(self);
}

/// Does the work at the given width.
#[inline(always)]
pub(crate) fn run(width: Width, job: impl Job) {
    match width.0 {
        Kind::One => job.run::<f32>(),
        Kind::Four => job.run::<F32x4>(),
        #[cfg(target_arch = "x86_64")]
        Kind::Eight => {
            debug_assert!(is_x86_feature_detected!("avx2"));
            // SAFETY: `Kind::Eight` is made only where AVX2 was found, and checked above in debug.
            unsafe { run_avx2(job) }
        }
        #[cfg(target_arch = "x86_64")]
        Kind::Sixteen => {
            debug_assert!(has_avx512());
            // SAFETY: `Kind::Sixteen` is made only where AVX-512 was found, and checked above in debug.
            unsafe { run_avx512(job) }
        }
    }
}

/// # Safety
/// The processor has AVX2.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
unsafe fn run_avx2(job: impl Job) {
    job.run::<F32x8>();
}

/// # Safety
/// The processor has AVX-512.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
unsafe fn run_avx512(job: impl Job) {
    job.run::<F32x16>();
}
