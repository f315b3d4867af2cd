//! Interfaces: where states go in and wrenches come out.

use crate::failure::Failure;
use crate::guard::{get, with_world};
use crate::handle::pong_world;
use crate::ids::{pong_interface_id, pong_object_id};
use crate::pointers::{Out, OutArray, apart, text};
use crate::states::pong_state;
use crate::status::pong_status;
use std::ffi::c_char;

/// Finds the Interface of a movable group: by its path in the model, "root/arm/latch"; by its bare name where
/// only one movable group of the model has it; "" for the root.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_find_interface(
    world: *const pong_world,
    object: pong_object_id,
    path: *const c_char,
    interface: *mut pong_interface_id,
) -> pong_status {
    with_world(world, |inner| {
        let (path, out) = (text(path, "path")?, Out::new(interface, "interface")?);
        out.set(inner.phase.scene().interface(object.id(), path)?.into());
        Ok(())
    })
}

/// Lists all Interfaces of an Object, the root's first: copies the first `capacity`; `count` gets their number.
/// PONG_STATUS_BUFFER_TOO_SMALL if not all fit. With capacity 0 `interfaces` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_list_interfaces(
    world: *const pong_world,
    object: pong_object_id,
    interfaces: *mut pong_interface_id,
    capacity: usize,
    count: *mut usize,
) -> pong_status {
    with_world(world, |inner| {
        apart(("interfaces", interfaces, capacity), ("count", count, 1))?;
        let (mut out, count) =
            (OutArray::new(interfaces, capacity, "interfaces")?, Out::new(count, "count")?);
        let ids = inner.phase.scene().interfaces(object.id())?;
        ids.iter().enumerate().for_each(|(index, id)| out.set(index, (*id).into()));
        count.set(ids.len());
        too_small("interfaces", out.len(), ids.len())
    })
}

/// The refusal of a buffer that is too small, if it is.
pub(crate) fn too_small(what: &str, capacity: usize, count: usize) -> crate::failure::Outcome {
    if count <= capacity {
        return Ok(());
    }
    let message = format!("{what}: there are {count}, the array has room for {capacity}; make it larger");
    Err(Failure::new(pong_status::BufferTooSmall, message))
}

/// Returns the path of an Interface's movable group in its model. The text lives as long as the world.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_interface_path(
    world: *const pong_world,
    interface: pong_interface_id,
    path: *mut *const c_char,
) -> pong_status {
    get(world, (path, "path"), |inner| Ok(inner.names.path(interface)?.as_ptr()))
}

/// Returns the Object that an Interface belongs to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_interface_object(
    world: *const pong_world,
    interface: pong_interface_id,
    object: *mut pong_object_id,
) -> pong_status {
    get(world, (object, "object"), |inner| Ok(inner.names.object_of(interface)?.into()))
}

/// Copies the pose that the model's author gave a movable group, at rest, relative to the frame of the root
/// group: an initial state. It is the identity for the root.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_authored_state(
    world: *const pong_world,
    interface: pong_interface_id,
    state: *mut pong_state,
) -> pong_status {
    with_world(world, |inner| {
        let pose = inner.phase.scene().authored_pose(interface.id())?;
        Out::new(state, "state")?.set(pong_state::from_motion(&pose, &pong_geometry::Twist::zero()));
        Ok(())
    })
}
