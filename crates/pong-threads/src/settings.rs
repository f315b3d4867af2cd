//! Settings with which a pool is started.

use std::time::Duration;

/// Number of workers, their cores and priority, and how long threads wait.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Number of workers wanted beside the caller; 1 by default. Limited to
    /// [`MAX_WORKERS`](crate::MAX_WORKERS), and to the number of cores in the affinity mask of the starting
    /// thread less one core for the caller.
    pub workers: usize,
    /// Allows more workers than cores.
    pub oversubscribe: bool,
    /// Time for which a worker spins for the next phase before it parks; 50 µs by default. To wake a parked
    /// worker takes tens of microseconds and a system call by the caller.
    pub spin: Duration,
    /// Time the caller waits for claimed blocks of workers, once it has no block to run itself; 1 ms by
    /// default. Then the phase is abandoned.
    pub worker_timeout: Duration,
    /// Binds each worker to a core of its own. The first core of the mask is left to the caller, which should
    /// bind itself to it after the pool has started. Off by default.
    pub pin: bool,
    /// With `pin`: the cores of the workers, in order. They may lie outside the affinity mask (cores kept
    /// free for real-time threads), and their number limits the workers. Empty by default: the cores of the
    /// mask after the first.
    pub cores: Vec<usize>,
    /// SCHED_FIFO priority requested for the workers. Without it they keep what the system gives a new
    /// thread: on Linux, the policy of the thread that starts the pool. None by default.
    pub fifo_priority: Option<u8>,
    /// Clock, ns, that measures the time spent in blocks ([`ThreadWork`](crate::ThreadWork)). It is read
    /// before and after the blocks of each claim.
    pub clock: Option<fn() -> u64>,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            workers: 1,
            oversubscribe: false,
            spin: Duration::from_micros(50),
            worker_timeout: Duration::from_millis(1),
            pin: false,
            cores: Vec::new(),
            fifo_priority: None,
            clock: None,
        }
    }
}
