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

/// Size of the largest contact state that this world can save, bytes; fixed when the world is sealed. A buffer of this size,
/// made once, is large enough for ever.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_contact_state_size(world: *const pong_world, size: *mut usize) -> pong_status {
    get(world, (size, "size"), |inner| {
        Ok(inner.phase.frames("ask for the size of the contact state")?.state_size())
    })
}

/// Size of the contact state as it is to be saved now, bytes. It grows and shrinks with the contacts of the last commit, and
/// is mostly far below pong_contact_state_size().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_contact_state_used(world: *const pong_world, size: *mut usize) -> pong_status {
    get(world, (size, "size"), |inner| {
        Ok(inner.phase.frames("ask for the size of the contact state")?.state_used())
    })
}

/// Saves the committed contact state into the caller's buffer of `size` bytes, pong_contact_state_used() or more. It takes
/// the first pong_contact_state_used() bytes; those behind, up to pong_contact_state_size(), become zero. The bytes hold no
/// pointer: write them to a file, keep them, compare them. To save often and fast give no more than is used.
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

/// Restores a contact state that was saved by this world or by one that was built by the same calls: the bytes that saving
/// used, or more of the buffer, up to pong_contact_state_size(). The states of the movable groups are the host's and are
/// not part of it. PONG_STATUS_BAD_STATE_BLOCK: the world keeps the contact state it had.
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
        // The block ends where what is remembered now does.
        let used = world.state_used();
        inner.tell_log(|log| log.restored(&block[..used]));
        Ok(())
    })
}

/// Accepts the states presently set, as pong_commit(), and preloads the bristles between the two Objects of a pair: for the first
/// frame of a run, and after pong_clear_contact_history(). `force` NULL: what moves along what it touches has slid for long and has its
/// kinetic friction, against its present motion. Otherwise friction holds `force`, N, three numbers along the common axes, on the
/// Object that was named first in the pair: as much of it as lies in the contact planes and as sticks. `count`, which may be
/// NULL, tells how many bristles were set; contacts without a bristle or without load have none. Allocates: not in frames.
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
        // For the log it is what a restored contact state is.
        if inner.log.is_some() {
            let mut block = Vec::new();
            inner.phase.frames("preload friction")?.save_state_packed(&mut block);
            inner.tell_log(|log| log.restored(&block));
        }
        out.set(set);
        Ok(())
    })
}
