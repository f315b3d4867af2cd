//! How a run is recorded.

use std::time::Duration;

/// What the frame does when the files are slower than the run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WhenFull {
    /// Waits: for runs that nobody watches.
    #[default]
    Wait,
    /// Leaves whole frames out of the log, counted and marked: for runs in real time.
    Lose,
}

/// How long anyone waits for files that take nothing, unless the host says otherwise: longer than a disk that spins up or
/// a server that restarts takes, shorter than anybody waits for a program to end.
pub const LONGEST_WAIT: Duration = Duration::from_secs(30);

/// How a run is recorded.
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
    /// Whether energies are handed in with every frame.
    pub energies: bool,
    /// Whether a log that lies in the folder may be replaced.
    pub overwrite: bool,
    /// What happens when the files are too slow.
    pub when_full: WhenFull,
    /// Bytes that may wait for the files; raised to what the largest frame takes. `None` for 16 MiB.
    pub buffer_bytes: Option<usize>,
    /// How often what was written is flushed, by default 1 s. A run that is cut off keeps what was flushed.
    pub flush_every: Duration,
    /// How long anyone waits for files that take nothing at all: a frame that waits for room is then lost, and so are all
    /// that follow; a log that is closed then ends where it was flushed. 30 s unless the host says otherwise.
    pub longest_wait: Duration,
    /// Called in the thread that writes the files as it begins: a host whose threads have a real-time priority lowers
    /// that of this one here.
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
