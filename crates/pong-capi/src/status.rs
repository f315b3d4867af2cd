//! Status numbers.

use std::ffi::c_char;
use strum::VariantArray;

/// Outcome of a call. The numbers never change and are never used again for something else.
///
/// A call that fails has changed nothing that a later frame can see; pong_last_message() names the thing, the
/// cause and the remedy.
// The names end with a zero byte, for C.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::IntoStaticStr, strum::VariantArray)]
#[strum(serialize_all = "SCREAMING_SNAKE_CASE", prefix = "PONG_STATUS_", suffix = "\0")]
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
    /// The caller's buffer is too small; the message has the required size.
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
    /// The world is destroyed, but a worker had not ended after a second because the system does not run it.
    /// It ends by itself; until then `user` pointers of laws must live, and the library must not be unloaded.
    WorkerLeft = 18,
    /// The system does not give the memory that set-up asks for; the message has its size.
    OutOfMemory = 19,
}

/// Name of a status number as this header spells it; "unknown status" for a number that is none. Lives as long
/// as the library.
#[unsafe(no_mangle)]
pub extern "C" fn pong_status_name(status: i32) -> *const c_char {
    let known = pong_status::VARIANTS.iter().find(|known| **known as i32 == status);
    known.map_or("unknown status\0", <&str>::from).as_ptr().cast()
}

/// Message of the last call of this thread: empty after a success, never NULL. Valid until this thread's next
/// call; calls of other threads do not touch it. This call and pong_status_name() leave it as it is.
#[unsafe(no_mangle)]
pub extern "C" fn pong_last_message() -> *const c_char {
    crate::message::pointer()
}
