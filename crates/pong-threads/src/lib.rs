//! Worker threads that share the blocks of one phase with the calling thread.
//!
//! The workers of a [`Pool`] wait by spinning, so that it is worth sharing a phase of a few microseconds. The
//! caller claims and runs blocks like a worker. It waits, for a bounded time, only for blocks that a worker
//! has claimed. A worker that sleeps, starves, hangs or no longer exists costs the caller time, but never
//! changes a result.
//!
//! ```
//! use std::sync::{Arc, atomic::{AtomicU32, Ordering}};
//! use pong_threads::{Job, Outcome, Pool, Settings};
//!
//! struct Sum(AtomicU32);
//! impl Job for Sum {
//!     fn run(&self, block: u32, _lane: usize) {
//!         self.0.fetch_add(block, Ordering::Relaxed);
//!     }
//! }
//!
//! let sum = Arc::new(Sum(AtomicU32::new(0)));
//! let settings = Settings { workers: 1, ..Settings::default() };
//! let mut pool = Pool::start(sum.clone(), &settings).unwrap();
//! if pool.run(100) == Outcome::Complete {
//!     assert_eq!(sum.0.load(Ordering::Relaxed), 99 * 100 / 2);
//! }
//! ```
//!
//! The crate's `README.md` describes the protocol, what can go wrong, and why it does no harm.

#![cfg_attr(loom, allow(dead_code))]

mod board;
mod caller;
mod sync;
mod word;
mod worker;

#[cfg(all(loom, test))]
mod models;
#[cfg(not(loom))]
mod place;
#[cfg(not(loom))]
mod pool;
#[cfg(not(loom))]
mod settings;
#[cfg(not(loom))]
pub mod system;

use std::ops::Range;

#[cfg(not(loom))]
pub use place::{Grant, WorkerStart};
#[cfg(not(loom))]
pub use pool::{LONGEST_FAREWELL, LONGEST_START, Pool, StartError};
#[cfg(not(loom))]
pub use settings::Settings;

/// Maximum number of blocks in a phase.
pub const MAX_BLOCKS: u32 = (1 << 16) - 1;
/// Maximum number of workers in a pool.
pub const MAX_WORKERS: usize = 64;

/// Work of a phase, split into blocks.
///
/// A job belongs to its pool for the pool's life. The caller stores the input of a phase in the job before
/// [`Pool::run`] and reads the output from it afterwards. Each block sees everything that the caller wrote
/// before the phase. The caller sees everything that the blocks wrote once the phase is
/// [`Outcome::Complete`].
pub trait Job: Send + Sync + 'static {
    /// Runs one block on thread number `thread`: 0 is the caller, 1… are the workers. A thread runs one block
    /// at a time, so the job may keep scratch memory for each thread. This holds after an abandoned phase
    /// too: a thread whose block still runs takes no other block.
    fn run(&self, block: u32, thread: usize);

    /// Runs neighbouring blocks that thread number `thread` claimed together. The default runs them one by
    /// one, the last first. A job overrides this if neighbours are cheaper together.
    fn run_neighbors(&self, blocks: Range<u32>, thread: usize) {
        blocks.rev().for_each(|block| self.run(block, thread));
    }
}

/// Result of a phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[must_use]
pub enum Outcome {
    /// Every block has run exactly once.
    Complete,
    /// A worker took longer than [`Settings::worker_timeout`](Settings) for its blocks. Its blocks may still
    /// be running until [`Pool::is_quiet`]. Until then their output must not be used, and their input must
    /// not change, or must be safe to read while it changes.
    Abandoned,
}

/// Work that one thread, the caller or a worker, has done in one phase.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ThreadWork {
    /// Number of blocks it ran.
    pub blocks: u32,
    /// Time spent in them, measured by [`Settings::clock`](Settings), in ns; 0 without a clock.
    pub busy_ns: u64,
}
