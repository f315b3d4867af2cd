//! User data of Objects and primitives: a number of the host's.

use crate::guard::{get, with_world};
use crate::handle::pong_world;
use crate::ids::{pong_interface_id, pong_object_id};
use crate::names::no_such;
use crate::status::pong_status;

/// Keeps a number of the host's with an Object: an index, a pointer. The engine never reads it. May allocate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_set_object_user_data(
    world: *mut pong_world,
    object: pong_object_id,
    user_data: u64,
) -> pong_status {
    with_world(world, |inner| {
        inner.names.object(object)?;
        inner.user_data.objects.insert(object.bits, user_data);
        Ok(())
    })
}

/// Copies the number kept with an Object; 0 if none was set.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_object_user_data(
    world: *const pong_world,
    object: pong_object_id,
    user_data: *mut u64,
) -> pong_status {
    get(world, (user_data, "user_data"), |inner| {
        inner.names.object(object)?;
        Ok(inner.user_data.objects.get(&object.bits).copied().unwrap_or(0))
    })
}

/// Keeps a number of the host's with a primitive of one Object. The engine never reads it. May allocate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_set_primitive_user_data(
    world: *mut pong_world,
    interface: pong_interface_id,
    primitive: u32,
    user_data: u64,
) -> pong_status {
    with_world(world, |inner| {
        inner.check_primitive(interface, primitive)?;
        inner.user_data.primitives.insert((interface.bits, primitive), user_data);
        Ok(())
    })
}

/// Copies the number kept with a primitive; 0 if none was set.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_primitive_user_data(
    world: *const pong_world,
    interface: pong_interface_id,
    primitive: u32,
    user_data: *mut u64,
) -> pong_status {
    get(world, (user_data, "user_data"), |inner| {
        inner.check_primitive(interface, primitive)?;
        let kept = inner.user_data.primitives.get(&(interface.bits, primitive));
        Ok(kept.copied().unwrap_or(0))
    })
}

impl crate::handle::Inner {
    fn check_primitive(&self, interface: pong_interface_id, primitive: u32) -> crate::failure::Outcome {
        let count = self.names.primitives(interface)?.len();
        if (primitive as usize) < count {
            Ok(())
        } else {
            Err(no_such("primitive", primitive as usize, count))
        }
    }
}
