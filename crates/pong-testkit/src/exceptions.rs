//! Floating-point exceptions that code raises, read from the processor's flags: for code that must not rely
//! on ∞ − ∞ or 0/0.
//!
//! A compiler may divide before the branch that excludes zeros, or in unused vector lanes. No result shows
//! it, but a host that traps exceptions stops there.
//!
//! ```
//! let zero = std::hint::black_box(0.0);
//! let divide_by = |divisor: f64| {
//!     std::hint::black_box(zero / divisor);
//! };
//! assert!(pong_testkit::exceptions::are_raised_by(|| divide_by(zero)) || !cfg!(target_arch = "x86_64"));
//! assert!(!pong_testkit::exceptions::are_raised_by(|| divide_by(3.0)));
//! ```
#![allow(unsafe_code)]

/// True if the work does an invalid operation, or divides by zero, on the calling thread. Only on x86-64;
/// false elsewhere.
pub fn are_raised_by(work: impl FnOnce()) -> bool {
    unit::clear();
    fenced(work);
    unit::are_raised()
}

/// Runs the work in a function of its own, so that no arithmetic is moved before or after it.
#[inline(never)]
fn fenced(work: impl FnOnce()) {
    work();
}

#[cfg(target_arch = "x86_64")]
mod unit {
    use std::arch::asm;

    /// Flags of invalid operation and of division by zero.
    const WATCHED: u32 = 0b101;
    /// All flags.
    const FLAGS: u32 = 0b11_1111;

    fn read() -> u32 {
        let mut word: u32 = 0;
        // SAFETY: stores four bytes into the variable.
        unsafe { asm!("stmxcsr [{}]", in(reg) &mut word, options(nostack, preserves_flags)) };
        word
    }

    pub fn clear() {
        let word = read() & !FLAGS;
        // SAFETY: loads four bytes of the variable: the previous environment, without its flags.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &word, options(nostack, readonly)) };
    }

    pub fn are_raised() -> bool {
        read() & WATCHED != 0
    }
}

#[cfg(not(target_arch = "x86_64"))]
mod unit {
    pub fn clear() {}

    pub fn are_raised() -> bool {
        false
    }
}
