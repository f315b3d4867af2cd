//! The workers, the clock, and what a frame cost.

use super::World;
use crate::report::{Clock, MemoryReport, StageTimes, WorkTimes};
use pong_threads::{LaneWork, WorkerStart};

impl World {
    /// Gives the world another clock, in ns, for the stages of its frames ([`stage_times`](Self::stage_times)); the workers
    /// keep the one that they were started with
    /// ([`WorldBuilder::set_clock`](crate::WorldBuilder::set_clock)).
    pub fn set_clock(&mut self, now_ns: fn() -> u64) {
        self.runtime.clock = Clock(Some(now_ns));
    }

    /// How every worker started: its core and priority, or why it has none. Empty without workers.
    pub fn worker_starts(&self) -> &[WorkerStart] {
        self.runtime.worker_starts()
    }

    /// Wakes the workers shortly before a frame: they look for its work until it comes or `at_most` has passed. For
    /// hosts whose frames are further apart than the workers spin. Does nothing without workers.
    pub fn prewake(&mut self, at_most: std::time::Duration) {
        self.runtime.prewake(at_most);
    }

    /// Lets the workers sleep at once, as in a freeze. The next frame wakes them. Does nothing without workers.
    pub fn quiesce(&mut self) {
        self.runtime.quiesce();
    }

    /// Ends the workers, as dropping the world does, and tells how many the system did not run within a second, or as
    /// long as the worker timeout if one is stuck in a block: they end by themselves and keep what they read until then.
    /// Frames are computed by the caller alone from then on.
    pub fn end_workers(&mut self) -> usize {
        self.runtime.end()
    }

    /// What the calling thread (first) and each worker did in the last round of work that they shared. Empty without
    /// workers.
    pub fn lane_work(&self) -> impl Iterator<Item = LaneWork> + '_ {
        self.runtime.lane_work()
    }

    /// Where the time of the last frame's contacts went on the calling thread (first) and on each worker. Zero without a
    /// clock. Rounds that the calling thread did again by itself count for it alone.
    pub fn lane_times(&self) -> impl Iterator<Item = WorkTimes> + '_ {
        self.runtime.lane_times()
    }

    /// Rounds of work since the world was sealed that the calling thread did by itself because a worker did not come
    /// back in time, or had not come back from an earlier round. The results are the same; the time is not.
    pub fn worker_timeouts(&self) -> u64 {
        self.runtime.worker_timeouts()
    }

    /// Time per stage of the last frame, ns; zero without a clock ([`set_clock`](Self::set_clock)).
    pub fn stage_times(&self) -> StageTimes {
        self.runtime.frame.times
    }

    /// Memory that frames have needed against what there is.
    pub fn memory(&self) -> MemoryReport {
        self.runtime.memory_report()
    }
}
