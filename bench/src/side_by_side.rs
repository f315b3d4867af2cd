//! Two worlds side by side, on a core each: what two cores can do together at best.
//!
//! Cores may share more than memory: two that are threads of one processor core, or run slower when both are busy, do less
//! together than twice what one does alone. Two worlds that know nothing of each other have no other reason to be slow.

use crate::rig::{Rig, config};
use crate::scenes::Frames;
use pong_engine::WorkerSettings;
use pong_threads::{Job, Outcome, Pool, StartError};
use std::hint::black_box;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// One world for the caller, and one for a worker with a core of its own.
pub struct SideBySide {
    pool: Pool,
    worlds: Arc<Worlds>,
}

/// Both worlds, of which each lane steps its own.
struct Worlds {
    lanes: [Mutex<OnPath>; 2],
    path: Frames,
    /// Frames of the pass that nobody has begun.
    left: AtomicUsize,
}

/// A world, and which frame of the path it has next.
struct OnPath {
    rig: Rig,
    next: usize,
}

impl SideBySide {
    /// Of two worlds of one thread each, and a path of frames that closes; `None` where there is one core.
    ///
    /// # Errors
    /// If the system starts no thread.
    pub fn new(rigs: [Rig; 2], path: Frames) -> Result<Option<Self>, StartError> {
        let lanes = rigs.map(|rig| Mutex::new(OnPath { rig, next: 0 }));
        let worlds = Arc::new(Worlds { lanes, path, left: AtomicUsize::new(0) });
        // A pass is over when all of its frames are.
        let worker_timeout = Duration::from_secs(1);
        let settings = config(2).workers.unwrap_or_default();
        let settings = WorkerSettings { oversubscribe: false, worker_timeout, ..settings };
        let pool = Pool::start(Arc::clone(&worlds) as Arc<dyn Job>, &settings)?;
        Ok((pool.workers() == 1).then_some(Self { pool, worlds }))
    }

    /// As many frames as the path has, shared out: whoever is ready begins the next one of its own world.
    ///
    /// # Panics
    /// If the worker does not come back.
    pub fn pass(&mut self) {
        self.worlds.left.store(self.worlds.path.len(), Relaxed);
        let lanes = self.worlds.lanes.len() as u32;
        assert_eq!(self.pool.run(lanes), Outcome::Complete, "both worlds end their frames");
    }
}

impl Job for Worlds {
    /// Runs frames until none is left: a block for each lane, however few frames it comes in time for.
    fn run(&self, _block: u32, lane: usize) {
        let mut own = self.lanes[lane].lock().unwrap_or_else(PoisonError::into_inner);
        let OnPath { rig, next } = &mut *own;
        while self.left.fetch_update(Relaxed, Relaxed, |left| left.checked_sub(1)).is_ok() {
            black_box(rig.step(&self.path[*next]));
            *next = (*next + 1) % self.path.len();
        }
    }
}
