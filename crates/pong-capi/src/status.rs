//! Status numbers.

use std::ffi::c_char;

/// What became of a call. The numbers never change and are never used again for something else.
///
/// A call that fails has changed nothing that a later frame can see; pong_last_message() tells the thing, the cause
/// and what to do.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum pong_status {
    /// Done.
    Ok = 0,
    /// A pointer that must not be NULL is.
    NullArgument = 1,
    /// An id is zero, stale, or of another world.
    UnknownId = 2,
    /// Nothing has this name; the message lists the names there are.
    UnknownName = 3,
    /// The name or the pair is already there.
    Duplicate = 4,
    /// The call is not allowed before (or after) sealing, or before a frame.
    WrongPhase = 5,
    /// The scene cannot be sealed; the message lists every reason.
    SealFailed = 6,
    /// A state is not finite or its quaternion is not of unit length, or a frame's forces or energies are beyond what a
    /// number holds and the frame does not count; the message names the interface.
    BadState = 7,
    /// A paired movable group has no state yet; the message names the interface.
    UnsetState = 8,
    /// A value that this argument cannot have.
    BadValue = 9,
    /// The bytes are not a contact state of this world.
    BadStateBlock = 10,
    /// The caller's buffer is too small; the message tells the size that is needed.
    BufferTooSmall = 11,
    /// The model has faults; the message has one line for each.
    ModelError = 12,
    /// The configuration was not made by pong_default_config(), or header and library differ.
    Config = 13,
    /// A fault inside the library. The world refuses every further call but pong_destroy_world().
    Panic = 14,
    /// Another call on this world is running: in another thread, or the one that called this law. Nothing was done.
    Busy = 15,
    /// A law given by callback returned a number that is not finite; the message names the law. The frame does
    /// not count: it is not committed.
    LawFailed = 16,
    /// A response log cannot be written; the message names file and cause.
    LogFailed = 17,
    /// The world is destroyed, but a worker had not ended after a second because the system does not run it. It ends by
    /// itself; until then `user` pointers of laws must live, and the library must not be unloaded.
    WorkerLeft = 18,
    /// The system does not give the memory that set-up asks for; the message tells how much.
    OutOfMemory = 19,
}

impl pong_status {
    /// All of them, in order of their numbers.
    pub(crate) const ALL: [Self; 20] = [
        Self::Ok,
        Self::NullArgument,
        Self::UnknownId,
        Self::UnknownName,
        Self::Duplicate,
        Self::WrongPhase,
        Self::SealFailed,
        Self::BadState,
        Self::UnsetState,
        Self::BadValue,
        Self::BadStateBlock,
        Self::BufferTooSmall,
        Self::ModelError,
        Self::Config,
        Self::Panic,
        Self::Busy,
        Self::LawFailed,
        Self::LogFailed,
        Self::WorkerLeft,
        Self::OutOfMemory,
    ];

    fn name(self) -> &'static std::ffi::CStr {
        match self {
            Self::Ok => c"PONG_STATUS_OK",
            Self::NullArgument => c"PONG_STATUS_NULL_ARGUMENT",
            Self::UnknownId => c"PONG_STATUS_UNKNOWN_ID",
            Self::UnknownName => c"PONG_STATUS_UNKNOWN_NAME",
            Self::Duplicate => c"PONG_STATUS_DUPLICATE",
            Self::WrongPhase => c"PONG_STATUS_WRONG_PHASE",
            Self::SealFailed => c"PONG_STATUS_SEAL_FAILED",
            Self::BadState => c"PONG_STATUS_BAD_STATE",
            Self::UnsetState => c"PONG_STATUS_UNSET_STATE",
            Self::BadValue => c"PONG_STATUS_BAD_VALUE",
            Self::BadStateBlock => c"PONG_STATUS_BAD_STATE_BLOCK",
            Self::BufferTooSmall => c"PONG_STATUS_BUFFER_TOO_SMALL",
            Self::ModelError => c"PONG_STATUS_MODEL_ERROR",
            Self::Config => c"PONG_STATUS_CONFIG",
            Self::Panic => c"PONG_STATUS_PANIC",
            Self::Busy => c"PONG_STATUS_BUSY",
            Self::LawFailed => c"PONG_STATUS_LAW_FAILED",
            Self::LogFailed => c"PONG_STATUS_LOG_FAILED",
            Self::WorkerLeft => c"PONG_STATUS_WORKER_LEFT",
            Self::OutOfMemory => c"PONG_STATUS_OUT_OF_MEMORY",
        }
    }
}

/// Name of a status number as this header spells it; "unknown status" for a number that is none. Lives as long
/// as the library.
#[unsafe(no_mangle)]
pub extern "C" fn pong_status_name(status: i32) -> *const c_char {
    let known = pong_status::ALL.into_iter().find(|known| *known as i32 == status);
    known.map_or(c"unknown status", pong_status::name).as_ptr()
}

/// What the last call of this thread had to say: empty after a success, never NULL.
/// Valid until this thread's next call; calls of other threads do not touch it. This call and
/// pong_status_name() leave it as it is.
#[unsafe(no_mangle)]
pub extern "C" fn pong_last_message() -> *const c_char {
    crate::message::pointer()
}
