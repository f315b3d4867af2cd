//! What a pool is started with.

use std::time::Duration;

/// How many workers, where they run, and how long anyone waits.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Workers wanted beside the caller; 1 by default. There will be no more than the cores left beside the caller's
    /// in the affinity mask of the thread that starts the pool, and never more than [`MAX_WORKERS`](crate::MAX_WORKERS).
    pub workers: usize,
    /// More workers than cores are given all the same.
    pub oversubscribe: bool,
    /// How long a worker looks for the next phase before it parks, a duration; 50 µs by default. A parked worker is woken by
    /// the next phase in tens of microseconds, and the caller pays a system call.
    pub spin: Duration,
    /// How long the caller waits for blocks that workers have claimed, once it has none to run itself; 1 ms by
    /// default. Then the phase is abandoned.
    pub worker_timeout: Duration,
    /// Bind each worker to a core of its own. The first core of the mask is left to the caller, who should bind
    /// itself there after the pool has started. Off by default.
    pub pin: bool,
    /// With `pin`: the cores of the workers, in order. They then may be outside the affinity mask (cores that the
    /// system keeps free for real-time threads), and their number is the limit of the workers. Empty by default: the
    /// cores of the mask after the first.
    pub cores: Vec<usize>,
    /// Ask for SCHED_FIFO with this priority for the workers. Without it they have what the system gives a new
    /// thread: on Linux the policy of the thread that starts the pool. None by default.
    pub fifo_priority: Option<u8>,
    /// A clock in ns, if the time in blocks is to be measured ([`LaneWork`](crate::LaneWork)). Asked before and after
    /// the blocks that a lane claims together.
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
