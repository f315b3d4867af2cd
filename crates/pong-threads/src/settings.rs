//! Settings with which a pool is started.

use std::time::Duration;

/// Settings of a pool: the number of workers, their cores and priority, and how long threads wait.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Number of workers wanted beside the caller; 1 by default. It is limited to
    /// [`MAX_WORKERS`](crate::MAX_WORKERS), and to the number of cores in the affinity mask of the starting
    /// thread, less one core for the caller.
    pub workers: usize,
    /// Allows more workers than cores.
    pub oversubscribe: bool,
    /// Time for which a worker spins for the next phase before it parks; 50 µs by default. To wake a parked
    /// worker takes tens of microseconds, and the caller needs a system call for it.
    pub spin: Duration,
    /// Time for which the caller waits for blocks that workers have claimed, once it has no block to run
    /// itself; 1 ms by default. After this time the phase is abandoned.
    pub worker_timeout: Duration,
    /// If true, each worker is bound to a core of its own. The first core of the affinity mask is left to the
    /// caller, which should bind itself to it after the pool has started. False by default.
    pub pin: bool,
    /// Cores of the workers, in order, used if `pin` is true. They may lie outside the affinity mask (cores
    /// kept free for real-time threads), and their number limits the workers. If empty, as by default, the
    /// workers use the cores of the mask after the first.
    pub cores: Vec<usize>,
    /// SCHED_FIFO priority requested for the workers; none by default. Without it they keep what the system
    /// gives a new thread: on Linux, the policy of the thread that starts the pool.
    pub fifo_priority: Option<u8>,
    /// Clock, in ns, that measures the time spent in blocks ([`ThreadWork`](crate::ThreadWork)). It is read
    /// before and after the blocks of each claim. None by default.
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
