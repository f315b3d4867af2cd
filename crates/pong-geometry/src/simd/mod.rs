//! Eight numbers at a time, in the same bits on every machine.
//!
//! A kernel is written once, over a [`Simd`] that it is handed, and [`run`] gives it the widest one that the machine
//! has. Every operation rounds each of the eight numbers as the plain `f64` operation does, nothing is fused and
//! nothing is summed across lanes: the level changes the time, never the answer. (The payload of a NaN is not part of
//! the answer.)

mod boxes;
mod portable;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use boxes::{BoxSimd, EightBoxes};
pub use portable::Portable;

use std::sync::atomic::{AtomicU8, Ordering};

/// How many numbers are worked on at a time.
pub const LANES: usize = 8;

/// One bit per lane: the lowest is lane 0.
pub type LaneBits = u8;

/// Arithmetic on eight numbers.
///
/// Comparisons with a NaN are false, as they are for `f64`.
#[allow(missing_docs)]
pub trait Simd: BoxSimd {
    /// Eight numbers.
    type Eight: Copy;
    /// Eight truths.
    type Mask: Copy;

    fn splat(self, value: f64) -> Self::Eight;
    fn load(self, values: &[f64; LANES]) -> Self::Eight;
    fn store(self, values: Self::Eight) -> [f64; LANES];
    fn add(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    fn sub(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    fn mul(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    fn div(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    /// `a < b`.
    fn below(self, a: Self::Eight, b: Self::Eight) -> Self::Mask;
    /// `a ≥ b`.
    fn at_least(self, a: Self::Eight, b: Self::Eight) -> Self::Mask;
    /// `a = b`; the two zeros are equal.
    fn equal(self, a: Self::Eight, b: Self::Eight) -> Self::Mask;
    fn bits(self, mask: Self::Mask) -> LaneBits;
    /// `a` where the mask holds, else `b`.
    fn select(self, mask: Self::Mask, a: Self::Eight, b: Self::Eight) -> Self::Eight;
}

/// Work that can be done at any level. Mark `run` and all that it calls with a [`Simd`] `#[inline(always)]`:
/// instructions of a level are used only in what is inlined.
pub trait Kernel {
    /// What it hands back.
    type Output;
    /// Does the work.
    fn run<S: Simd>(self, simd: S) -> Self::Output;
}

/// A set of instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum Level {
    /// What every machine of this architecture has.
    Portable = 1,
    /// Four numbers per instruction (x86-64 with AVX2).
    Avx2 = 2,
    /// Eight numbers per instruction (x86-64 with AVX-512).
    Avx512 = 3,
}

/// The level in use, 0 until the first question.
static LEVEL: AtomicU8 = AtomicU8::new(0);

impl Level {
    const ALL: [Self; 3] = [Self::Portable, Self::Avx2, Self::Avx512];

    /// The widest level that this machine has.
    pub fn best() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if pulp::x86::V4::is_available() {
                return Self::Avx512;
            }
            if pulp::x86::V3::is_available() {
                return Self::Avx2;
            }
        }
        Self::Portable
    }

    /// The levels that this machine has, the portable one first.
    pub fn available() -> impl Iterator<Item = Self> {
        let best = Self::best();
        Self::ALL.into_iter().filter(move |&level| level <= best)
    }

    /// The name, for reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Portable => "portable",
            Self::Avx2 => "AVX2",
            Self::Avx512 => "AVX-512",
        }
    }
}

/// The level that kernels run at: the best that the machine has, or what [`set_level`] chose.
#[inline]
pub fn level() -> Level {
    match LEVEL.load(Ordering::Relaxed) {
        1 => Level::Portable,
        2 => Level::Avx2,
        3 => Level::Avx512,
        _ => set_level(Level::best()),
    }
}

/// The name of the level in use.
pub fn level_name() -> &'static str {
    level().name()
}

/// Chooses the level for the whole process, at most the best that the machine has, and says which it became.
///
/// For comparisons and tests: results are the same bits at every level. May be called at any time from any thread.
pub fn set_level(level: Level) -> Level {
    let level = level.min(Level::best());
    LEVEL.store(level as u8, Ordering::Relaxed);
    level
}

/// Runs a kernel at the level in use. The choice and the call take a few nanoseconds: work that has many small
/// kernels is itself made one.
#[inline(always)]
pub fn run<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    match level() {
        Level::Avx512 => {
            if let Some(v4) = pulp::x86::V4::try_new() {
                return v4.vectorize(x86::With(kernel, x86::Avx512(v4)));
            }
        }
        Level::Avx2 => {
            if let Some(v3) = pulp::x86::V3::try_new() {
                return v3.vectorize(x86::With(kernel, x86::Avx2(v3)));
            }
        }
        Level::Portable => {}
    }
    kernel.run(Portable)
}
