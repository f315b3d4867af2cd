//! Critical threads: workers that share the blocks of one phase with the thread that calls.
//!
//! A [`Pool`] holds workers that wait by spinning, so that a phase of a few microseconds is worth sharing. The caller
//! works too, claims blocks like any worker, and waits only for blocks that a worker has claimed, and for these a
//! bounded time. A worker that sleeps, starves, hangs or no longer exists costs the caller time, never an answer.
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
//! `README.md` of this crate tells the protocol, what can go wrong, and why it does not.

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
mod signals;

use std::ops::Range;

#[cfg(not(loom))]
pub use place::{Grant, WorkerStart};
#[cfg(not(loom))]
pub use pool::{LONGEST_FAREWELL, LONGEST_START, Pool, StartError};
#[cfg(not(loom))]
pub use settings::Settings;
#[cfg(not(loom))]
pub use signals::without_signals;

/// Most blocks of one phase.
pub const MAX_BLOCKS: u32 = (1 << 16) - 1;
/// Most workers of one pool.
pub const MAX_WORKERS: usize = 64;

/// What is done in a phase, block by block.
///
/// A job belongs to its pool for the pool's life. What a phase reads is put, before [`Pool::run`], where the job finds
/// it, and what it wrote is there after: everything that the caller wrote before is seen by each block, and everything
/// that a block wrote is seen by the caller once the phase is [`Outcome::Complete`].
pub trait Job: Send + Sync + 'static {
    /// Runs one block. Lane 0 is the caller, 1… are the workers; no two blocks run on one lane at once, so a lane may
    /// own scratch memory. After an abandoned phase that includes the block which is still running: its lane takes no
    /// other before it has returned.
    fn run(&self, block: u32, lane: usize);

    /// Runs neighbouring blocks, which the lane has claimed together. A job to which neighbours cost less together than one by
    /// one says how; as it stands here they run one by one, the last first.
    fn run_neighbors(&self, blocks: Range<u32>, lane: usize) {
        blocks.rev().for_each(|block| self.run(block, lane));
    }
}

/// How a phase ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[must_use]
pub enum Outcome {
    /// Each block has run, once.
    Complete,
    /// A worker kept a block for longer than [`Settings::worker_timeout`](Settings). Blocks may still be running
    /// ([`Pool::is_quiet`] tells); what they write must not be used, and what they read must stay as it is or be
    /// safe to read while it changes.
    Abandoned,
}

/// What one lane did in one phase.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LaneWork {
    /// Blocks that it ran.
    pub blocks: u32,
    /// Time in them, by [`Settings::clock`](Settings), in ns; 0 without a clock.
    pub busy_ns: u64,
}
