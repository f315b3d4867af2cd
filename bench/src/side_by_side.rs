//! Two independent worlds, on a core each: upper bound of the speed-up by two cores.
//!
//! Cores may share more than memory: two hardware threads of one core, or cores that run slower when both are
//! busy, do together less than twice the work of one. Two independent worlds have no other reason to be slow.

use crate::rig::{Rig, config};
use crate::scenes::Frames;
use pong_engine::WorkerSettings;
use pong_threads::{Job, Outcome, Pool, StartError};
use std::hint::black_box;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// One world for the caller, and one for a worker on its own core.
pub struct SideBySide {
    pool: Pool,
    worlds: Arc<Worlds>,
}

/// Both worlds; each worker index steps its own.
struct Worlds {
    lanes: [Mutex<OnPath>; 2],
    path: Frames,
    /// Frames of the pass that have not begun.
    left: AtomicUsize,
}

/// A world and its next frame of the path.
struct OnPath {
    rig: Rig,
    next: usize,
}

impl SideBySide {
    /// Prepares two worlds of one thread each, and a closed path of frames; `None` on a single core.
    ///
    /// # Errors
    /// The system cannot start a thread.
    pub fn new(rigs: [Rig; 2], path: Frames) -> Result<Option<Self>, StartError> {
        let lanes = rigs.map(|rig| Mutex::new(OnPath { rig, next: 0 }));
        let worlds = Arc::new(Worlds { lanes, path, left: AtomicUsize::new(0) });
        // A pass ends when all of its frames have.
        let worker_timeout = Duration::from_secs(1);
        let settings = config(2).workers.unwrap_or_default();
        let settings = WorkerSettings { oversubscribe: false, worker_timeout, ..settings };
        let pool = Pool::start(Arc::clone(&worlds) as Arc<dyn Job>, &settings)?;
        Ok((pool.workers() == 1).then_some(Self { pool, worlds }))
    }

    /// Runs the frames of the path once, shared dynamically: whoever is ready begins the next one in its own
    /// world.
    ///
    /// # Panics
    /// The worker does not return.
    pub fn pass(&mut self) {
        self.worlds.left.store(self.worlds.path.len(), Relaxed);
        let lanes = self.worlds.lanes.len() as u32;
        assert_eq!(self.pool.run(lanes), Outcome::Complete, "both worlds end their frames");
    }
}

impl Job for Worlds {
    /// Runs frames until none is left: one block per worker, however few frames it gets.
    fn run(&self, _block: u32, lane: usize) {
        let mut own = self.lanes[lane].lock().unwrap_or_else(PoisonError::into_inner);
        let OnPath { rig, next } = &mut *own;
        while self.left.fetch_update(Relaxed, Relaxed, |left| left.checked_sub(1)).is_ok() {
            black_box(rig.step(&self.path[*next]));
            *next = (*next + 1) % self.path.len();
        }
    }
}
