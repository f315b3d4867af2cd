//! What the protocol takes from the system: atomics, parking, time. In the models, loom's.
//!
//! The models (`models.rs`) run the protocol's own code on loom's atomics, in every order in which threads can meet.
//! Time does not pass there: a [`Watch`] counts how often it is looked at.

#[cfg(not(loom))]
mod real {
    pub use std::hint::spin_loop;
    pub use std::sync::atomic::AtomicU64;
    pub use std::thread::{Thread, current, park, yield_now};

    /// Looks at a shared word between two looks at the clock. A look with its pause takes 20 to 60 ns.
    pub const LOOKS: u32 = 64;

    /// Mistakes are made in models only.
    pub const fn mutant(_name: &str) -> bool {
        false
    }

    /// Time since it was started.
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

    /// Loom must be told that a thread which looks again waits for another.
    pub fn spin_loop() {
        yield_now();
    }

    pub const LOOKS: u32 = 1;

    /// Whether to make the mistake `name`, to see the models find it: it is named in the environment.
    pub fn mutant(name: &str) -> bool {
        static CHOSEN: std::sync::LazyLock<Option<String>> =
            std::sync::LazyLock::new(|| std::env::var("PONG_THREADS_MUTANT").ok());
        CHOSEN.as_deref() == Some(name)
    }

    /// One nanosecond per look.
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
