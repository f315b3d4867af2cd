//! Saving and restoring the contact state.

use crate::guard::{Failure, with_world};
use crate::pointers::{Out, OutArray, array};
use crate::status::pong_status;
use crate::world::pong_world;
use std::ffi::c_void;

/// Size of the saved contact state, bytes; fixed when the world is sealed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_contact_state_size(world: *const pong_world, size: *mut usize) -> pong_status {
    // SAFETY: see "Safety of all entries" in lib.rs.
    unsafe {
        with_world(world, |inner| {
            Out::new(size, "size")?.set(inner.world.state_size()?);
            Ok(())
        })
    }
}

/// Saves the committed contact state into the caller's buffer of `size` bytes, of which the first
/// pong_contact_state_size() are written. The bytes hold no pointer: write them to a file, keep them, compare them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_save_contact_state(
    world: *const pong_world,
    buffer: *mut c_void,
    size: usize,
) -> pong_status {
    // SAFETY: see "Safety of all entries" in lib.rs.
    unsafe {
        with_world(world, |inner| {
            let needed = inner.world.state_size()?;
            if size < needed {
                let message =
                    format!("contact state: the buffer has {size} bytes, it takes {needed}; make it larger");
                return Err(Failure::new(pong_status::BufferTooSmall, message));
            }
            let mut out = OutArray::new(buffer.cast::<u8>(), needed, "buffer")?;
            Ok(inner.world.save_state(out.zeroed())?)
        })
    }
}

/// Restores a contact state of exactly pong_contact_state_size() bytes, saved by this world or by one that was
/// built by the same calls. The states of the movable groups are the host's and are not part of it.
/// PONG_STATUS_BAD_STATE_BLOCK: the world keeps the contact state it had.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_restore_contact_state(
    world: *mut pong_world,
    buffer: *const c_void,
    size: usize,
) -> pong_status {
    // SAFETY: see "Safety of all entries" in lib.rs.
    unsafe {
        with_world(world, |inner| {
            let block = array(buffer.cast::<u8>(), size, "buffer")?;
            inner.world.restore_state(block)?;
            inner.tell_log(|log| log.restored(block));
            Ok(())
        })
    }
}
