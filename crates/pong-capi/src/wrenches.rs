//! Wrenches out.

use crate::failure::{Failure, Outcome};
use crate::guard::{get, with_world};
use crate::handle::{Inner, pong_world};
use crate::ids::{pong_interface_id, pong_pair_id};
use crate::pointers::{OutArray, apart, array};
use crate::status::pong_status;
use pong_engine::{EngineError, World};
use pong_geometry::Wrench;

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

/// Copies the wrenches of the last frame on `n` movable groups, N and N m, about the origin of each and along
/// the axes that `frame` names. The arrays must not share memory; with n = 0 they may be NULL.
/// PONG_STATUS_WRONG_PHASE before the first frame; PONG_STATUS_LAW_FAILED after a frame that a law spoilt.
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
        let common = along_common_axes(frame)?;
        inner.check_interfaces(ids)?;
        for (index, id) in ids.iter().enumerate() {
            out.set(index, inner.wrench(*id, common)?);
        }
        Ok(())
    })
}

/// Copies the wrench of the last frame on one movable group. Errors as for pong_get_wrenches().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_wrench(
    world: *const pong_world,
    interface: pong_interface_id,
    frame: pong_reference_frame,
    wrench: *mut pong_wrench,
) -> pong_status {
    get(world, (wrench, "wrench"), |inner| {
        let common = along_common_axes(frame)?;
        inner.wrench(interface, common)
    })
}

/// Copies the wrench of the last frame on the movable group `interface` from its contacts with the movable
/// group `from` alone, about the origin of `interface`. Over all groups that `interface` can touch, these add
/// up to pong_get_wrench(), to rounding. Zero where the two do not touch, their pair is off or a filter keeps
/// them apart. It is summed in this call, so frames pay nothing; allocates nothing. PONG_STATUS_BAD_VALUE: both
/// are the same group, or their Objects are not paired. Otherwise errors as for pong_get_wrenches().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_wrench_from(
    world: *const pong_world,
    interface: pong_interface_id,
    from: pong_interface_id,
    frame: pong_reference_frame,
    wrench: *mut pong_wrench,
) -> pong_status {
    get(world, (wrench, "wrench"), |inner| {
        let common = along_common_axes(frame)?;
        let (on, from) = (interface.id(), from.id());
        let world = inner.framed()?;
        let wrench =
            if common { world.wrench_from_common(on, from)? } else { world.wrench_from(on, from)? };
        Ok((&wrench).into())
    })
}

/// Copies the wrench of the last frame of a pair of Objects: the sum over all its contacts, on the Object that
/// was named first in the pair from the other, about the origin of `about`, a movable group of either Object.
/// PONG_REFERENCE_FRAME_GROUP: along the axes of `about`. The Object named second receives the opposite about
/// the same point. Zero where the two do not touch or the pair is off. It is summed in this call, so frames pay
/// nothing; allocates nothing. PONG_STATUS_BAD_VALUE: `about` is of neither Object, or an Object is paired with
/// itself: call pong_get_wrench_from() for two of its groups. Otherwise errors as for pong_get_wrenches().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_pair_wrench(
    world: *const pong_world,
    pair: pong_pair_id,
    about: pong_interface_id,
    frame: pong_reference_frame,
    wrench: *mut pong_wrench,
) -> pong_status {
    get(world, (wrench, "wrench"), |inner| {
        let common = along_common_axes(frame)?;
        let (pair, about) = (pair.id(), about.id());
        let world = inner.framed()?;
        let wrench =
            if common { world.pair_wrench_common(pair, about)? } else { world.pair_wrench(pair, about)? };
        Ok((&wrench).into())
    })
}

/// Returns true if the wrench is given along the axes of the common frame.
pub(crate) fn along_common_axes(frame: pong_reference_frame) -> Outcome<bool> {
    match frame {
        PONG_REFERENCE_FRAME_GROUP => Ok(false),
        PONG_REFERENCE_FRAME_COMMON => Ok(true),
        _ => {
            let message =
                format!("`frame` is {frame}; give PONG_REFERENCE_FRAME_GROUP or PONG_REFERENCE_FRAME_COMMON");
            Err(Failure::new(pong_status::BadValue, message))
        }
    }
}

impl Inner {
    fn wrench(&self, id: pong_interface_id, common: bool) -> Outcome<pong_wrench> {
        if self.phase.sealed().is_none() {
            self.names.path(id)?;
        }
        let world = self.framed()?;
        let wrench = if common { world.wrench_common(id.id())? } else { world.wrench(id.id())? };
        Ok((&wrench).into())
    }

    /// The world, if it is sealed and no law has failed in its last frame.
    fn framed(&self) -> Outcome<&World> {
        self.law_faults.check()?;
        let cure = "evaluate or step a frame first";
        let too_early = EngineError::WrongPhase { call: "get a wrench", cure };
        Ok(self.phase.sealed().ok_or(too_early)?)
    }
}

impl From<&Wrench> for pong_wrench {
    fn from(wrench: &Wrench) -> Self {
        Self { force: wrench.force.into(), moment: wrench.moment.into() }
    }
}
