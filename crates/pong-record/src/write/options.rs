//! Options of recording.

use std::time::Duration;

/// Behaviour when the files are slower than the run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WhenFull {
    /// Waits: for unattended runs.
    #[default]
    Wait,
    /// Leaves whole frames out of the log, counted and marked: for runs in real time.
    Lose,
}

/// Default limit of waiting for files that accept nothing: longer than a disk takes to spin up or a server to
/// restart, but short enough for a program that ends.
pub const LONGEST_WAIT: Duration = Duration::from_secs(30);

/// Options of recording.
#[derive(Clone, Debug)]
pub struct RecordOptions {
    /// Name of the run.
    pub name: String,
    /// The program that records, with its version.
    pub writer: String,
    /// Step of the integrator, s, if known.
    pub step: Option<f64>,
    /// Commits from one frame of the log to the next, if they are always the same.
    pub commits_per_frame: Option<u64>,
    /// The integrator, if known.
    pub integrator: Option<String>,
    /// True if energies are given with every frame.
    pub energies: bool,
    /// True if an existing log in the folder may be replaced.
    pub overwrite: bool,
    /// Behaviour when the files are too slow.
    pub when_full: WhenFull,
    /// Most bytes that may wait for the files; raised to the size of the largest frame. `None` for 16 MiB.
    pub buffer_bytes: Option<usize>,
    /// Time between flushes, by default 1 s. A run that is cut off keeps what was flushed.
    pub flush_every: Duration,
    /// Limit of waiting for files that accept nothing at all: beyond it a frame that waits for room is lost,
    /// with all that follow, and a log that is closed ends where it was last flushed. 30 s by default.
    pub longest_wait: Duration,
    /// Called at the start of the thread that writes the files, where a host with real-time threads lowers
    /// its priority.
    pub on_thread_start: Option<fn()>,
}

impl Default for RecordOptions {
    fn default() -> Self {
        Self {
            name: String::new(),
            writer: concat!("pong-record ", env!("CARGO_PKG_VERSION")).to_owned(),
            step: None,
            commits_per_frame: None,
            integrator: None,
            energies: false,
            overwrite: false,
            when_full: WhenFull::Wait,
            buffer_bytes: None,
            flush_every: Duration::from_secs(1),
            longest_wait: LONGEST_WAIT,
            on_thread_start: None,
        }
    }
}
