//! Grants of a platform.

/// Grants of a platform to a real-time program, for `pong doctor` and documents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grants {
    /// Name of the operating system.
    pub system: &'static str,
    /// Binding of a thread to a core: `None` if threads can be bound; otherwise why not, and what helps.
    pub no_binding: Option<&'static str>,
    /// Priority by [`Settings::fifo_priority`](crate::Settings): `None` if it can be asked for; otherwise why not,
    /// and what helps.
    pub no_fifo: Option<&'static str>,
}
