//! Arithmetic on eight numbers at a time, with the same bits on every machine.
//!
//! A kernel is written once, generic over a [`Simd`], and [`run`] calls it with the widest [`Simd`] that the
//! machine has. Every operation rounds each lane as the scalar `f64` operation does; nothing is fused and
//! nothing is summed across lanes. So the instruction-set level changes the time, never the result. (The
//! payload of a NaN is not part of the result.)

mod arithmetic;
mod boxes;
mod derivatives;
mod first;
mod functions;
mod lanes;
#[cfg(target_arch = "aarch64")]
mod neon;
mod numbers;
#[cfg(any(target_arch = "aarch64", target_feature = "simd128"))]
mod pairs;
mod portable;
#[cfg(target_feature = "simd128")]
mod simd128;
mod splat;
#[cfg(target_arch = "x86_64")]
mod x86;
#[cfg(target_arch = "x86_64")]
mod x86_boxes;

pub use arithmetic::{Kernel, Simd};
pub use boxes::{BoxSimd, EightBoxes};
pub use derivatives::{Derivatives, Dual};
pub use first::{Finder, First, FirstOf, Found};
pub use lanes::{LANES, LaneBits};
pub use numbers::{Numbers, Vectors};
pub use portable::Portable;
pub use splat::{MODERATE, Splat, is_moderate};

use std::sync::atomic::{AtomicU8, Ordering};

/// Instruction-set level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum Level {
    /// Instructions that every machine of this architecture has.
    Portable = 1,
    /// Two numbers per instruction (every AArch64).
    Neon = 2,
    /// Two numbers per instruction (WebAssembly, compiled with `-C target-feature=+simd128`).
    Simd128 = 3,
    /// Four numbers per instruction (x86-64 with AVX2).
    Avx2 = 4,
    /// Eight numbers per instruction (x86-64 with AVX-512).
    Avx512 = 5,
}

/// Highest level that kernels may use.
static LEVEL: AtomicU8 = AtomicU8::new(Level::Avx512 as u8);

impl Level {
    const ALL: [Self; 5] = [Self::Portable, Self::Neon, Self::Simd128, Self::Avx2, Self::Avx512];

    fn is_available(self) -> bool {
        match self {
            Self::Portable => true,
            Self::Neon => cfg!(target_arch = "aarch64"),
            Self::Simd128 => cfg!(target_feature = "simd128"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => pulp::x86::V3::is_available(),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => pulp::x86::V4::is_available(),
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 | Self::Avx512 => false,
        }
    }

    /// Returns the widest level of this machine.
    pub fn best() -> Self {
        Self::available().max().unwrap_or(Self::Portable)
    }

    /// Returns all levels of this machine, the portable one first.
    pub fn available() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|level| level.is_available())
    }

    /// Returns the name of the level for reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Portable => "portable",
            Self::Neon => "NEON",
            Self::Simd128 => "simd128",
            Self::Avx2 => "AVX2",
            Self::Avx512 => "AVX-512",
        }
    }
}

/// Returns the level at which kernels run: the best of the machine, limited by [`set_level`].
pub fn level() -> Level {
    let most = LEVEL.load(Ordering::Relaxed);
    Level::available().filter(|&level| level as u8 <= most).max().unwrap_or(Level::Portable)
}

/// Returns the name of the level at which kernels run.
pub fn level_name() -> &'static str {
    level().name()
}

/// Sets the highest level that the process may use, and returns the level at which kernels then run.
///
/// This is for comparisons and tests, because results are bit-identical at every level. It may be called at
/// any time from any thread.
pub fn set_level(level: Level) -> Level {
    LEVEL.store(level as u8, Ordering::Relaxed);
    self::level()
}

/// Runs a function at the level in use. Its arguments must be a [`Simd`] and references.
macro_rules! run_at_level {
    ($function:ident($($argument:ident: $kind:ty),*) -> $output:ty) => {{
        struct Work<'a> {
            $($argument: &'a $kind),*
        }
        impl $crate::simd::Kernel for Work<'_> {
            type Output = $output;

            #[inline(always)]
            fn run<S: $crate::simd::Simd>(self, simd: S) -> $output {
                $function(simd, $(self.$argument),*)
            }
        }
        $crate::simd::run(Work { $($argument),* })
    }};
}
pub(crate) use run_at_level;

/// Runs a kernel at the level in use ([`level`]). The dispatch takes a few nanoseconds, so code that would
/// call many small kernels should itself be one kernel.
#[inline(always)]
pub fn run<K: Kernel>(kernel: K) -> K::Output {
    // Without one of the instruction sets below, the portable level is the only one.
    #[allow(unused_variables)]
    let most = LEVEL.load(Ordering::Relaxed);
    #[cfg(target_arch = "x86_64")]
    {
        // The closures are always inlined, so that the kernel is compiled with the instructions of the level.
        if most >= Level::Avx512 as u8
            && let Some(v4) = pulp::x86::V4::try_new()
        {
            return v4.vectorize(
                #[inline(always)]
                || kernel.run(x86::Avx512(v4)),
            );
        }
        if most >= Level::Avx2 as u8
            && let Some(v3) = pulp::x86::V3::try_new()
        {
            return v3.vectorize(
                #[inline(always)]
                || kernel.run(x86::Avx2(v3)),
            );
        }
    }
    #[cfg(target_arch = "aarch64")]
    if most >= Level::Neon as u8
        && let Some(neon) = pulp::aarch64::Neon::try_new()
    {
        return kernel.run(pairs::Pairs(neon));
    }
    #[cfg(target_feature = "simd128")]
    if most >= Level::Simd128 as u8 {
        return kernel.run(pairs::Pairs(simd128::Simd128));
    }
    run_portable(kernel)
}

/// Runs a kernel at the portable level. Not inlined, so that callers of kernels stay small.
#[cfg_attr(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"), inline(never))]
fn run_portable<K: Kernel>(kernel: K) -> K::Output {
    kernel.run(Portable)
}
