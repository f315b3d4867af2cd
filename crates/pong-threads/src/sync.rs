//! Atomics, parking and time: from the standard library or, in the models, from loom.
//!
//! The models (`models.rs`) run the protocol's own code on loom's atomics, under every interleaving of its
//! threads. Time does not pass there: a [`Watch`] counts how often it is read.

#[cfg(not(loom))]
mod real {
    pub use std::hint::spin_loop;
    pub use std::sync::atomic::AtomicU64;
    pub use std::thread::{Thread, current, park, yield_now};

    /// Number of reads of a shared word between two reads of the clock. One read with its pause takes 20 to
    /// 60 ns.
    pub const LOOKS: u32 = 64;

    /// Returns `false`, because seeded faults exist in models only.
    pub const fn mutant(_name: &str) -> bool {
        false
    }

    /// Stopwatch that starts when it is created.
    pub struct Watch(std::time::Instant);

    impl Watch {
        pub fn start() -> Watch {
            Watch(std::time::Instant::now())
        }

        pub fn elapsed_ns(&self) -> u64 {
            self.0.elapsed().as_nanos() as u64
        }
    }
}

#[cfg(loom)]
mod real {
    pub use loom::sync::atomic::AtomicU64;
    pub use loom::thread::{Thread, current, park, yield_now};

    /// Yields, so that loom knows that a spinning thread waits for another thread.
    pub fn spin_loop() {
        yield_now();
    }

    pub const LOOKS: u32 = 1;

    /// Returns `true` if the environment selects the seeded fault `name`, which the models must find.
    pub fn mutant(name: &str) -> bool {
        static CHOSEN: std::sync::LazyLock<Option<String>> =
            std::sync::LazyLock::new(|| std::env::var("PONG_THREADS_MUTANT").ok());
        CHOSEN.as_deref() == Some(name)
    }

    /// Stopwatch that advances by one nanosecond per read.
    pub struct Watch(std::sync::atomic::AtomicU64);

    impl Watch {
        pub fn start() -> Watch {
            Watch(std::sync::atomic::AtomicU64::new(0))
        }

        pub fn elapsed_ns(&self) -> u64 {
            self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed)
        }
    }
}

pub use real::*;
