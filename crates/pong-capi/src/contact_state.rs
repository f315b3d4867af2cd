//! Saving and restoring the contact state.

use crate::failure::Failure;
use crate::guard::{get, with_world};
use crate::handle::pong_world;
use crate::ids::pong_pair_id;
use crate::pointers::{Out, OutArray, array};
use crate::status::pong_status;
use pong_engine::FrictionPreload;
use pong_geometry::Vec3;
use std::ffi::c_void;

/// Size of the largest contact state that this world can save, bytes; fixed when the world is sealed. A buffer
/// of this size is always large enough. After sealing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_contact_state_size(world: *const pong_world, size: *mut usize) -> pong_status {
    get(world, (size, "size"), |inner| {
        Ok(inner.phase.frames("ask for the size of the contact state")?.state_size())
    })
}

/// Size of the present contact state when saved, bytes. It grows and shrinks with the contacts of the last
/// commit, and is mostly far below pong_contact_state_size(). After sealing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_contact_state_used(world: *const pong_world, size: *mut usize) -> pong_status {
    get(world, (size, "size"), |inner| {
        Ok(inner.phase.frames("ask for the size of the contact state")?.state_used())
    })
}

/// Saves the committed contact state into the caller's buffer of `size` bytes, pong_contact_state_used() or
/// more. The first pong_contact_state_used() bytes are the contact state; the rest, up to
/// pong_contact_state_size(), becomes zero. The bytes hold no pointer: write them to a file, keep them, compare
/// them. To save often and fast give a buffer of pong_contact_state_used() bytes. After sealing.
/// PONG_STATUS_BUFFER_TOO_SMALL: the message has the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_save_contact_state(
    world: *const pong_world,
    buffer: *mut c_void,
    size: usize,
) -> pong_status {
    with_world(world, |inner| {
        let world = inner.phase.frames("save the contact state")?;
        let needed = world.state_used();
        let written = size.min(world.state_size());
        if size < needed {
            let message =
                format!("contact state: the buffer has {size} bytes, it takes {needed}; make it larger");
            return Err(Failure::new(pong_status::BufferTooSmall, message));
        }
        let mut out = OutArray::new(buffer.cast::<u8>(), written, "buffer")?;
        Ok(world.save_state(out.zeroed())?)
    })
}

/// Restores a contact state that was saved by this world or by one built by the same calls: the bytes that
/// saving used, or more of the buffer, up to pong_contact_state_size(). The states of the movable groups are
/// the host's and are not part of it. After sealing. PONG_STATUS_BAD_STATE_BLOCK: the world keeps the contact
/// state it had.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_restore_contact_state(
    world: *mut pong_world,
    buffer: *const c_void,
    size: usize,
) -> pong_status {
    with_world(world, |inner| {
        let block = array(buffer.cast::<u8>(), size, "buffer")?;
        let world = inner.phase.frames_mut("restore the contact state")?;
        world.restore_state(block)?;
        // The logged block ends where the present contact state does.
        let used = world.state_used();
        inner.log_event(|log| log.restored(&block[..used]));
        Ok(())
    })
}

/// Accepts the states presently set, as pong_commit(), and preloads the bristles between the two Objects of a
/// pair: for the first frame of a run, and after pong_clear_contact_history(). With `force` NULL, contacts that
/// slide are preloaded to their kinetic friction, against their present motion, as after a long slide.
/// Otherwise friction holds `force`, N, three numbers along the common axes, on the Object that was named first
/// in the pair: as much of it as lies in the contact planes and as sticks. `count`, which may be NULL, gets the
/// number of bristles that were set; contacts without a bristle or without load have none. After sealing.
/// Errors as for pong_commit(). Allocates: not in frames.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_preload_friction(
    world: *mut pong_world,
    pair: pong_pair_id,
    force: *const f64,
    count: *mut usize,
) -> pong_status {
    with_world(world, |inner| {
        let out = Out::optional(count, "count")?;
        let preload = if force.is_null() {
            FrictionPreload::Sliding
        } else {
            let force = array(force, 3, "force")?;
            FrictionPreload::Holding(Vec3::new(force[0], force[1], force[2]))
        };
        inner.phase.scene().objects_of(pair.id())?;
        inner.phase.frames("preload friction")?;
        let set = inner.commit(|world| world.preload_friction(pair.id(), &preload))?;
        // The log treats it as a restored contact state.
        if inner.log.is_some() {
            let mut block = Vec::new();
            inner.phase.frames("preload friction")?.save_state_packed(&mut block);
            inner.log_event(|log| log.restored(&block));
        }
        out.set(set);
        Ok(())
    })
}
