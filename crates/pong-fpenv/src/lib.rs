//! Floating-point environment of calls into a library (libpong, FMUs): the engine's inside, the host's
//! outside.
//!
//! A host may have enabled traps (`feenableexcept`), set another rounding mode, or have tiny numbers flushed
//! to zero. Rust assumes the default environment, and every host has to get the same bits. So every entry
//! point works in the default environment: rounding to nearest, no trap, no flushing. The host's environment,
//! with its exception flags, is restored when the call returns.
//!
//! A thread inherits the environment of the thread that starts it (POSIX). The library starts threads only
//! inside its entry points, so workers have the engine's environment too.
//!
//! The host's contact laws run in the engine's environment on every thread. In the host's environment they
//! would give other bits on the calling thread than on a worker.
//!
//! x86-64 has two floating-point units, SSE and x87. The engine uses only SSE; a contact law of the host may
//! use x87 (`long double`), so the state of both units is saved and restored. On architectures other than
//! x86-64 and AArch64 the environment is left as it is.
//!
//! The module documentation of `crates/pong-engine/src/lib.rs` says which exceptions are faults of the
//! engine.
//!
//! With `--cfg pong_traps`, on x86-64, an invalid operation or a division by zero in the engine ends the
//! program: no code may rely on ∞ − ∞ or 0/0. With `--cfg pong_traps_overflow` an overflow ends it too.
//! Overflow occurs only with input that the engine refuses: it recognises a wrench out of range by its
//! overflow. `ci/traps --long` runs C programs with both options, and a fuzzer's calls, which include such
//! input, with the first. Contact laws of the host run with all exceptions masked.

#![deny(unsafe_op_in_unsafe_fn)]

/// Runs a call in the engine's environment, then restores the host's. The call must not unwind.
pub fn guarded<T>(call: impl FnOnce() -> T) -> T {
    let of_host = unit::read();
    unit::begin();
    let result = fenced(call);
    unit::end(of_host);
    result
}

/// Runs a function of the host inside a call, then sets the engine's environment again, whatever the function
/// changed.
pub fn lent<T>(function: impl FnOnce() -> T) -> T {
    #[cfg(all(pong_traps, target_arch = "x86_64"))]
    unit::mask();
    let result = fenced(function);
    unit::begin();
    result
}

/// Runs `call` in a function that is never inlined, so that the compiler, which does not model the
/// environment, cannot move arithmetic across a change of it.
#[inline(never)]
fn fenced<T>(call: impl FnOnce() -> T) -> T {
    call()
}

#[cfg(target_arch = "x86_64")]
mod unit {
    use std::arch::asm;

    /// Control words and exception flags of both units.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct Environment {
        /// MXCSR.
        sse: u32,
        x87_control: u16,
        x87_flags: u16,
    }

    /// All exceptions masked, rounding to nearest, denormal numbers as they are, no flag set.
    const MASKED: u32 = 0x1f80;
    /// Masks of invalid operation and division by zero.
    #[cfg(pong_traps)]
    const TRAPPED: u32 = 0x0280;
    /// Mask of overflow.
    #[cfg(pong_traps)]
    const OVERFLOW: u32 = if cfg!(pong_traps_overflow) { 0x0400 } else { 0 };
    #[cfg(pong_traps)]
    const SSE: u32 = MASKED & !(TRAPPED | OVERFLOW);
    #[cfg(not(pong_traps))]
    const SSE: u32 = MASKED;
    /// All exceptions masked, rounding to nearest, 64-bit significand.
    const X87_CONTROL: u16 = 0x037f;
    /// Exception flags in the x87 status word; its other bits describe the stack and comparisons.
    const X87_FLAGS: u16 = 0x00ff;

    pub fn read() -> Environment {
        let mut sse: u32 = 0;
        // SAFETY: stores four bytes into the variable.
        unsafe { asm!("stmxcsr [{}]", in(reg) &mut sse, options(nostack, preserves_flags)) };
        Environment { sse, x87_control: x87_control(), x87_flags: x87_status() & X87_FLAGS }
    }

    /// Sets the environment that Rust assumes. The x87 flags stay: with masked exceptions they have no
    /// effect.
    pub fn begin() {
        set_sse(SSE);
        if x87_control() != X87_CONTROL {
            set_x87_control(X87_CONTROL);
        }
    }

    /// Masks the traps while a law of the host runs.
    #[cfg(pong_traps)]
    pub fn mask() {
        set_sse(MASKED);
    }

    pub fn end(of_host: Environment) {
        if (x87_status() ^ of_host.x87_flags) & X87_FLAGS != 0 {
            // A law of the host has raised x87 flags. They are restored before traps are enabled again. Slow,
            // but rare.
            set_x87_flags(of_host.x87_flags);
        }
        if x87_control() != of_host.x87_control {
            set_x87_control(of_host.x87_control);
        }
        set_sse(of_host.sse);
    }

    fn set_sse(word: u32) {
        // SAFETY: loads four bytes of the variable: the environment that Rust assumes at the start of a call,
        // and the host's own, as read from the processor, when only the return to the host follows.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &word, options(nostack, readonly)) };
    }

    fn x87_control() -> u16 {
        let mut word: u16 = 0;
        // SAFETY: stores two bytes into the variable.
        unsafe { asm!("fnstcw [{}]", in(reg) &mut word, options(nostack, preserves_flags)) };
        word
    }

    fn set_x87_control(word: u16) {
        // SAFETY: loads two bytes of the variable; Rust's arithmetic does not use this unit.
        unsafe { asm!("fldcw [{}]", in(reg) &word, options(nostack, readonly)) };
    }

    fn x87_status() -> u16 {
        let word: u16;
        // SAFETY: reads a register that every program may read.
        unsafe { asm!("fnstsw ax", out("ax") word, options(nomem, nostack, preserves_flags)) };
        word
    }

    fn set_x87_flags(flags: u16) {
        // The x87 environment has seven words; the status word is the second. `fnstenv` masks all exceptions
        // until `fldenv` loads the words again.
        let mut words = [0u32; 7];
        // SAFETY: stores 28 bytes into the variable and loads them again with other flags.
        unsafe {
            asm!("fnstenv [{}]", in(reg) &mut words, options(nostack, preserves_flags));
            words[1] = (words[1] & !u32::from(X87_FLAGS)) | u32::from(flags);
            asm!("fldenv [{}]", in(reg) &words, options(nostack, readonly));
        }
    }
}

#[cfg(target_arch = "aarch64")]
mod unit {
    use std::arch::asm;

    /// FPCR (control) and FPSR (flags).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct Environment(u64, u64);

    pub fn read() -> Environment {
        let (control, flags);
        // SAFETY: reads two registers that every program may read.
        unsafe {
            asm!("mrs {}, fpcr", "mrs {}, fpsr", out(reg) control, out(reg) flags, options(nomem, nostack))
        };
        Environment(control, flags)
    }

    /// Sets the environment that Rust assumes: no traps, rounding to nearest, denormal numbers kept, no flag
    /// set.
    pub fn begin() {
        end(Environment(0, 0));
    }

    pub fn end(Environment(control, flags): Environment) {
        // SAFETY: sets the environment that Rust assumes at the start of a call, and the host's own, as read
        // from the processor, when only the return to the host follows.
        unsafe { asm!("msr fpcr, {}", "msr fpsr, {}", in(reg) control, in(reg) flags, options(nostack)) };
    }
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
mod unit {
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct Environment;

    pub fn read() -> Environment {
        Environment
    }

    pub fn begin() {}

    pub fn end(_: Environment) {}
}

/// The environment of the calling thread, for tests to compare.
pub fn current() -> impl Copy + PartialEq + std::fmt::Debug {
    unit::read()
}
