//! Workers, clock, and costs of a frame.

use super::World;
use crate::report::{Clock, MemoryReport, StageTimes, WorkTimes};
use pong_threads::{ThreadWork, WorkerStart};

impl World {
    /// Gives the world another clock, in ns, for the times of its frames ([`stage_times`](Self::stage_times),
    /// [`thread_times`](Self::thread_times)). The workers measure [`thread_work`](Self::thread_work) with the
    /// clock that they were started with ([`WorldBuilder::set_clock`](crate::WorldBuilder::set_clock)).
    pub fn set_clock(&mut self, now_ns: fn() -> u64) {
        self.runtime.clock = Clock(Some(now_ns));
    }

    /// Start of every worker: its core and priority, or the reason why it has none. Empty without workers.
    pub fn worker_starts(&self) -> &[WorkerStart] {
        self.runtime.worker_starts()
    }

    /// Wakes the workers shortly before a frame. They wait for its work until it comes or `at_most` has
    /// passed. For hosts whose frames are so far apart that the workers would fall asleep in between. Does
    /// nothing without workers.
    pub fn prewake(&mut self, at_most: std::time::Duration) {
        self.runtime.prewake(at_most);
    }

    /// Lets the workers sleep at once, as for a pause. The next frame wakes them. Does nothing without
    /// workers.
    pub fn quiesce(&mut self) {
        self.runtime.quiesce();
    }

    /// Ends the workers, as dropping the world does, and returns the number that did not end in time: within
    /// a second, or within the worker timeout if a worker is stuck in a block. Workers that are late end by
    /// themselves later, and keep the data that they read until then. From then on the caller computes frames
    /// alone.
    pub fn end_workers(&mut self) -> usize {
        self.runtime.end()
    }

    /// Work of the calling thread (first) and of each worker in the last shared round. Empty without workers.
    pub fn thread_work(&self) -> impl Iterator<Item = ThreadWork> + '_ {
        self.runtime.thread_work()
    }

    /// Times of the last frame's contact stage on the calling thread (first) and on each worker, by part.
    /// Zero without a clock. Rounds that the calling thread repeated alone count only for it.
    pub fn thread_times(&self) -> impl Iterator<Item = WorkTimes> + '_ {
        self.runtime.thread_times()
    }

    /// Number of rounds since the seal that the calling thread ran alone because a worker timed out, or was
    /// still stuck from an earlier round. The results are the same; only the time differs.
    pub fn worker_timeouts(&self) -> u64 {
        self.runtime.worker_timeouts()
    }

    /// Time per stage of the last frame, ns; zero without a clock ([`set_clock`](Self::set_clock)).
    pub fn stage_times(&self) -> StageTimes {
        self.runtime.frame.times
    }

    /// Peak use and capacity of memory.
    pub fn memory(&self) -> MemoryReport {
        self.runtime.memory_report()
    }
}
