//! Objects: instances of models.

use crate::guard::{get, with_world};
use crate::handle::pong_world;
use crate::ids::{pong_model_id, pong_object_id};
use crate::memory::require_for_object;
use crate::pointers::{Out, text};
use crate::status::pong_status;
use std::ffi::c_char;

/// Creates an Object from a model, under a name of its own. Objects of one model are independent. Before
/// sealing. PONG_STATUS_DUPLICATE: the name is taken.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_create_object(
    world: *mut pong_world,
    model: pong_model_id,
    name: *const c_char,
    object: *mut pong_object_id,
) -> pong_status {
    with_world(world, |inner| {
        let (name, out) = (text(name, "name")?, Out::new(object, "object")?);
        require_for_object(inner.names.group_count(model)?)?;
        let builder = inner.phase.set_up("create an object")?;
        let id = builder.create_object(model.id(), name)?;
        let interfaces = builder.scene().interfaces(id)?;
        inner.names.add_object(id, name, model.id(), &interfaces);
        inner.states.reserve(interfaces.len());
        out.set(id.into());
        Ok(())
    })
}

/// Finds the Object with this name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_find_object(
    world: *const pong_world,
    name: *const c_char,
    object: *mut pong_object_id,
) -> pong_status {
    with_world(world, |inner| {
        let (name, out) = (text(name, "name")?, Out::new(object, "object")?);
        out.set(inner.phase.scene().object(name)?.into());
        Ok(())
    })
}

/// Returns the name of an Object. The text lives as long as the world.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_object_name(
    world: *const pong_world,
    object: pong_object_id,
    name: *mut *const c_char,
) -> pong_status {
    get(world, (name, "name"), |inner| Ok(inner.names.object(object)?.as_ptr()))
}

/// Clears the contact state of an Object, after a teleport or a reset: its contacts begin anew, with bristles
/// at zero. After sealing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_clear_contact_history(
    world: *mut pong_world,
    object: pong_object_id,
) -> pong_status {
    with_world(world, |inner| {
        inner.names.object(object)?;
        inner.phase.frames_mut("clear a contact history")?.clear_contact_history(object.id())?;
        inner.log_event(|log| log.forgot(object.id()));
        Ok(())
    })
}
