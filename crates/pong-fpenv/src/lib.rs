//! The floating-point environment: the host's outside, the engine's inside. For libraries that a host calls: libpong, FMUs.
//!
//! A host may have switched on traps (`feenableexcept`), another rounding mode, or flushing of tiny numbers to zero. Rust
//! takes it for granted that nobody has, and the numbers of the engine are to be the same bits for every host. So
//! every entry works in the environment that Rust assumes: rounding to nearest, no trap, no flushing. The host's comes
//! back when the call returns, its exception flags as they were.
//!
//! Threads have the environment of the thread that starts them, as POSIX says. The library starts threads inside its
//! entries alone, so workers have the engine's environment too.
//!
//! Laws of the host run in the engine's environment, on every thread alike: in the host's they would give other bits on
//! the calling thread than on a worker.
//!
//! On x86-64 there are two units. The engine uses SSE alone; a law may use x87 (`long double`), which is cared for, too.
//! Other architectures than x86-64 and AArch64 keep what the host has set.
//!
//! Which exceptions are faults of the engine, and which are not, is told in `crates/pong-engine/src/lib.rs`.
//!
//! Built with `--cfg pong_traps`, on x86-64, the engine's environment ends the program at an invalid operation or a division
//! by zero: no code may rely on ∞ − ∞ or 0/0. With `--cfg pong_traps_overflow` an overflow ends it, too, which only input
//! that the engine refuses may cause: a wrench beyond the range of numbers is found by its overflow. `ci/traps --long` runs
//! C programs on a library with both, and a fuzzer's calls, which do hand in such input, on one with the first. Laws of the
//! host are not judged.

#![deny(unsafe_op_in_unsafe_fn)]

/// Runs a call in the engine's environment and puts that of the host back. The call must not unwind.
pub fn guarded<T>(call: impl FnOnce() -> T) -> T {
    let of_host = unit::read();
    unit::begin();
    let result = fenced(call);
    unit::end(of_host);
    result
}

/// Runs a function of the host's from inside a call. What it changes about the environment ends with it.
pub fn lent<T>(function: impl FnOnce() -> T) -> T {
    #[cfg(all(pong_traps, target_arch = "x86_64"))]
    unit::mask();
    let result = fenced(function);
    unit::begin();
    result
}

/// A function of its own, so that the compiler, which knows nothing of environments, moves no arithmetic of the call
/// to before or after it.
#[inline(never)]
fn fenced<T>(call: impl FnOnce() -> T) -> T {
    call()
}

#[cfg(target_arch = "x86_64")]
mod unit {
    use std::arch::asm;

    /// Control and flags of both units.
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
    /// All exceptions masked, rounding to nearest, numbers of 64 bits.
    const X87_CONTROL: u16 = 0x037f;
    /// Bits of the status word of x87 that are flags; the others tell of the stack and of comparisons.
    const X87_FLAGS: u16 = 0x00ff;

    pub fn read() -> Environment {
        let mut sse: u32 = 0;
        // SAFETY: stores four bytes into the variable.
        unsafe { asm!("stmxcsr [{}]", in(reg) &mut sse, options(nostack, preserves_flags)) };
        Environment { sse, x87_control: x87_control(), x87_flags: x87_status() & X87_FLAGS }
    }

    /// What Rust assumes. The flags of x87 stay: with its exceptions masked they mean nothing.
    pub fn begin() {
        set_sse(SSE);
        if x87_control() != X87_CONTROL {
            set_x87_control(X87_CONTROL);
        }
    }

    /// For laws of the host.
    #[cfg(pong_traps)]
    pub fn mask() {
        set_sse(MASKED);
    }

    pub fn end(of_host: Environment) {
        if (x87_status() ^ of_host.x87_flags) & X87_FLAGS != 0 {
            // A law has raised some. Rare, so it may be slow; and before traps are on again.
            set_x87_flags(of_host.x87_flags);
        }
        if x87_control() != of_host.x87_control {
            set_x87_control(of_host.x87_control);
        }
        set_sse(of_host.sse);
    }

    fn set_sse(word: u32) {
        // SAFETY: loads four bytes of the variable: the environment that Rust assumes when a call begins, and the word
        // that the processor gave for the host's when nothing but the return to the host follows.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &word, options(nostack, readonly)) };
    }

    fn x87_control() -> u16 {
        let mut word: u16 = 0;
        // SAFETY: stores two bytes into the variable.
        unsafe { asm!("fnstcw [{}]", in(reg) &mut word, options(nostack, preserves_flags)) };
        word
    }

    fn set_x87_control(word: u16) {
        // SAFETY: loads two bytes of the variable; no arithmetic of Rust's uses this unit.
        unsafe { asm!("fldcw [{}]", in(reg) &word, options(nostack, readonly)) };
    }

    fn x87_status() -> u16 {
        let word: u16;
        // SAFETY: reads a register that every program may read.
        unsafe { asm!("fnstsw ax", out("ax") word, options(nomem, nostack, preserves_flags)) };
        word
    }

    fn set_x87_flags(flags: u16) {
        // The status word is the second of seven; storing them masks all exceptions until they are loaded again.
        let mut words = [0u32; 7];
        // SAFETY: stores 28 bytes into the variable, and loads them again with other flags.
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

    /// FPCR, the control, and FPSR, the flags.
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

    /// What Rust assumes: no exception traps, rounding to nearest, denormal numbers as they are; no flag set.
    pub fn begin() {
        end(Environment(0, 0));
    }

    pub fn end(Environment(control, flags): Environment) {
        // SAFETY: the environment that Rust assumes when a call begins, and what the processor gave for the host's when
        // nothing but the return to the host follows.
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
