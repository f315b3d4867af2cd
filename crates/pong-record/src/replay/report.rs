//! Result of a replay.

use super::compare::Difference;

/// Result of a replay.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReplayReport {
    /// Frames of the log.
    pub frames: u64,
    /// Frames that were replayed and compared, including the one that differs.
    pub compared: u64,
    /// Contacts of the compared frames.
    pub contacts: u64,
    /// Differences in the first frame that differs: the first of wrenches and the first of contacts.
    pub differences: Vec<Difference>,
    /// Reason why the log cannot be replayed exactly from some frame on, if there is one.
    pub obstacle: Option<Obstacle>,
}

impl ReplayReport {
    /// True if every frame of the log was compared and none differs.
    pub fn agrees(&self) -> bool {
        self.differences.is_empty() && self.compared == self.frames
    }
}

/// Reason why a log cannot be replayed exactly from a frame on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Obstacle {
    /// Frames were lost.
    FramesLost {
        /// The first frame after them.
        frame: u64,
        /// Their number.
        count: u64,
    },
    /// Commits belong to frames that are not in the log.
    CommitsMissed {
        /// The frame before which they were made.
        frame: u64,
        /// Their number.
        count: u32,
    },
    /// Events were lost, or are of a kind that this program does not know.
    EventUnknown {
        /// The frame before which they happened.
        frame: u64,
    },
}

impl Obstacle {
    /// The first frame that cannot be replayed exactly.
    pub fn frame(&self) -> u64 {
        match self {
            Self::FramesLost { frame, .. }
            | Self::CommitsMissed { frame, .. }
            | Self::EventUnknown { frame } => *frame,
        }
    }
}

impl std::fmt::Display for Obstacle {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let s = |count: u64| if count == 1 { "" } else { "s" };
        match self {
            Self::FramesLost { frame, count } => write!(
                f,
                "{count} frame{} before frame {frame} were lost while the log was written; give it a larger buffer or a \
                 faster disk, or let the writer wait",
                s(*count)
            ),
            Self::CommitsMissed { frame, count } => write!(
                f,
                "{count} commit{} before frame {frame} belong to no frame of the log, and friction remembers every one; \
                 record every commit (`pong run --every-step`; in a host, log the frame after each commit)",
                s((*count).into())
            ),
            Self::EventUnknown { frame } => write!(
                f,
                "an event before frame {frame} was lost or is of a kind that this program does not know; record again with \
                 a larger buffer, or use the program that wrote the log"
            ),
        }
    }
}
