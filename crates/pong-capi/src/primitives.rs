//! Primitives as contacts name them: an Interface and an index.

use crate::failure::Failure;
use crate::guard::{get, with_world};
use crate::handle::pong_world;
use crate::ids::pong_interface_id;
use crate::names::no_such;
use crate::pointers::{Out, text};
use crate::status::pong_status;
use std::ffi::c_char;

/// Number of primitives of a movable group; a mesh is one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_primitive_count(
    world: *const pong_world,
    interface: pong_interface_id,
    count: *mut u32,
) -> pong_status {
    get(world, (count, "count"), |inner| Ok(inner.names.primitives(interface)?.len() as u32))
}

/// Returns the path of a primitive in its model. The text lives as long as the world.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_primitive_path(
    world: *const pong_world,
    interface: pong_interface_id,
    primitive: u32,
    path: *mut *const c_char,
) -> pong_status {
    get(world, (path, "path"), |inner| {
        let paths = inner.names.primitives(interface)?;
        let found = paths.get(primitive as usize);
        Ok(found.ok_or_else(|| no_such("primitive", primitive as usize, paths.len()))?.as_ptr())
    })
}

/// Finds the index of the primitive with this path in its model.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_find_primitive(
    world: *const pong_world,
    interface: pong_interface_id,
    path: *const c_char,
    primitive: *mut u32,
) -> pong_status {
    with_world(world, |inner| {
        let (path, out) = (text(path, "path")?, Out::new(primitive, "primitive")?);
        let paths = inner.names.primitives(interface)?;
        let found = paths.iter().position(|known| known.to_bytes() == path.as_bytes());
        let index = found.ok_or_else(|| {
            let known: Vec<_> = paths.iter().take(MOST_NAMED).map(|known| known.to_string_lossy()).collect();
            let more = if paths.len() > MOST_NAMED { ", …" } else { "" };
            let message = format!("primitive `{path}`: there is none; known: {}{more}", known.join(", "));
            Failure::new(pong_status::UnknownName, message)
        })?;
        out.set(index as u32);
        Ok(())
    })
}

/// Number of primitives that a message lists at most.
const MOST_NAMED: usize = 20;
