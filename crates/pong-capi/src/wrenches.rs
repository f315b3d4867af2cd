//! Wrenches out.

use crate::failure::{Failure, Outcome};
use crate::guard::{get, with_world};
use crate::handle::{Inner, pong_world};
use crate::ids::pong_interface_id;
use crate::pointers::{OutArray, apart, array};
use crate::status::pong_status;
use pong_engine::EngineError;

/// Frame in which a wrench is expressed: PONG_REFERENCE_FRAME_GROUP or PONG_REFERENCE_FRAME_COMMON.
pub type pong_reference_frame = i32;

/// Along the axes of the movable group.
pub const PONG_REFERENCE_FRAME_GROUP: pong_reference_frame = 0;
/// Along the axes of the common frame.
pub const PONG_REFERENCE_FRAME_COMMON: pong_reference_frame = 1;

/// Wrench that the contacts put on a movable group. The moment is about the group's origin in either frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_wrench {
    /// Force, N.
    pub force: [f64; 3],
    /// Moment about the group's origin, N m.
    pub moment: [f64; 3],
}

/// Wrenches of the last frame on `n` movable groups in one call. With n = 0 the arrays may be NULL. They must not share
/// memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_wrenches(
    world: *const pong_world,
    interfaces: *const pong_interface_id,
    frame: pong_reference_frame,
    wrenches: *mut pong_wrench,
    n: usize,
) -> pong_status {
    with_world(world, |inner| {
        apart(("interfaces", interfaces, n), ("wrenches", wrenches, n))?;
        let ids = array(interfaces, n, "interfaces")?;
        let mut out = OutArray::new(wrenches, n, "wrenches")?;
        check_frame(frame)?;
        inner.check_interfaces(ids)?;
        for (index, id) in ids.iter().enumerate() {
            out.set(index, inner.wrench(*id, frame)?);
        }
        Ok(())
    })
}

/// Wrench of the last frame on one movable group.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_wrench(
    world: *const pong_world,
    interface: pong_interface_id,
    frame: pong_reference_frame,
    wrench: *mut pong_wrench,
) -> pong_status {
    get(world, (wrench, "wrench"), |inner| {
        check_frame(frame)?;
        inner.wrench(interface, frame)
    })
}

fn check_frame(frame: pong_reference_frame) -> Outcome {
    if frame == PONG_REFERENCE_FRAME_GROUP || frame == PONG_REFERENCE_FRAME_COMMON {
        return Ok(());
    }
    let message =
        format!("`frame` is {frame}; give PONG_REFERENCE_FRAME_GROUP or PONG_REFERENCE_FRAME_COMMON");
    Err(Failure::new(pong_status::BadValue, message))
}

impl Inner {
    fn wrench(&self, id: pong_interface_id, frame: pong_reference_frame) -> Outcome<pong_wrench> {
        self.law_faults.check()?;
        let common = frame == PONG_REFERENCE_FRAME_COMMON;
        let Some(world) = self.phase.sealed() else {
            self.names.path(id)?;
            let cure = "evaluate or step a frame first";
            return Err(EngineError::WrongPhase { call: "get a wrench", cure }.into());
        };
        let wrench = if common { world.wrench_common(id.id())? } else { world.wrench(id.id())? };
        Ok(pong_wrench { force: wrench.force.into(), moment: wrench.moment.into() })
    }
}
