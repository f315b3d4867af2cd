//! Surfaces that move along themselves.

use crate::failure::Failure;
use crate::guard::{get, with_world};
use crate::handle::pong_world;
use crate::ids::pong_interface_id;
use crate::pointers::array;
use crate::status::pong_status;
use pong_engine::SurfaceMotion;

/// Motion of the surface of a movable group along itself, in the frame of the group, as of a belt, a track or a
/// turntable. The shape of the group does not move by it; only friction sees it. At a point p of the surface with the
/// outward unit normal n, the surface moves relative to the group at linear + angular x p + belt x n, of which the
/// part in the contact plane counts. The travels are the integrals of the velocities over time since any instant that
/// the host chooses: they are to the velocities what poses are to twists. Bristles follow the travels.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct pong_surface_motion {
    /// Velocity of the whole surface, m/s: a belt that is seen from one side.
    pub linear_velocity: [f64; 3],
    /// Angular velocity of the surface about the group's origin, rad/s: a turntable.
    pub angular_velocity: [f64; 3],
    /// Axis of the rollers of a belt that runs around the group, times its speed, m/s: along x above and against x
    /// below for the axis y.
    pub belt_velocity: [f64; 3],
    /// Integral of linear_velocity over time, m.
    pub linear_travel: [f64; 3],
    /// Integral of angular_velocity over time, rad.
    pub angular_travel: [f64; 3],
    /// Integral of belt_velocity over time, m.
    pub belt_travel: [f64; 3],
}

/// Sets the motions of the surfaces of `n` movable groups in one call: all of them or, if any is refused, none. They
/// last until they are set again; before the first call no surface moves. Set them as states are set, for every
/// evaluation for which they differ. The world must know before the seal that surfaces may move: set one in set-up,
/// with zeros if need be. With n = 0 the arrays may be NULL. In set-up and in frames. PONG_STATUS_BAD_VALUE: no motion
/// was set in set-up. PONG_STATUS_BAD_STATE: a number is not finite or beyond 1e100. PONG_STATUS_DUPLICATE: a group is
/// named twice.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_set_surface_motions(
    world: *mut pong_world,
    interfaces: *const pong_interface_id,
    motions: *const pong_surface_motion,
    n: usize,
) -> pong_status {
    with_world(world, |inner| {
        let ids = array(interfaces, n, "interfaces")?;
        let motions = array(motions, n, "motions")?;
        inner.check_named_once(ids)?;
        inner.surface_motions.clear();
        inner.surface_motions.extend(ids.iter().zip(motions).map(|(id, motion)| (id.id(), (*motion).into())));
        inner.phase.set_surface_motions(&inner.surface_motions)?;
        // The scratch leaves the world for the call, because the log is part of the same world.
        let moved = std::mem::take(&mut inner.surface_motions);
        inner.log_event(|log| log.surfaces_moved(&moved));
        inner.surface_motions = moved;
        Ok::<(), Failure>(())
    })
}

/// Copies the motion of the surface of a movable group, as it was set last; zero if it was never set.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_surface_motion(
    world: *const pong_world,
    interface: pong_interface_id,
    motion: *mut pong_surface_motion,
) -> pong_status {
    get(world, (motion, "motion"), |inner| Ok((*inner.phase.surface_motion(interface.id())?).into()))
}

/// Conversion between two structs with the fields of a surface motion.
macro_rules! surface_motion_from {
    ($from:ident, $to:ident) => {
        impl From<$from> for $to {
            fn from(motion: $from) -> Self {
                Self {
                    linear_velocity: motion.linear_velocity,
                    angular_velocity: motion.angular_velocity,
                    belt_velocity: motion.belt_velocity,
                    linear_travel: motion.linear_travel,
                    angular_travel: motion.angular_travel,
                    belt_travel: motion.belt_travel,
                }
            }
        }
    };
}

surface_motion_from!(SurfaceMotion, pong_surface_motion);
surface_motion_from!(pong_surface_motion, SurfaceMotion);
